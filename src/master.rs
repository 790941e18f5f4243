//! A contact of an FMU in the hands of a master.

use crate::importer::{Archive, Description, ImportError, Instance, Unit};
use brinell_exporter::master::Coupled;

/// A tangential direction: value references of its rate and of its force, and the component of the motion along it.
type Direction = (u32, u32, f64);

/// The tangential variables of FMUs with one and with two directions: what is behind their names, and the component of the
/// motion, which is along one line.
const DIRECTIONS: [(&str, f64); 3] = [("", 1.0), ("[1]", 0.8), ("[2]", -0.6)];

/// A contact in the hands of a master. It counts the calls.
pub struct Contact<'a> {
    pub instance: Instance<'a>,
    description: &'a Description,
    /// Parameters that differ from the start values of the FMU.
    parameters: Vec<(u32, f64)>,
    rate: u32,
    force: u32,
    // outputs that another FMU may not have
    mean_force: Option<u32>,
    predicted_force: Option<u32>,
    /// Of a contact with friction.
    directions: Vec<Direction>,
    /// What precedes the names of its variables.
    prefix: String,
    /// Time of the co-simulation, and its start time [s].
    time: f64,
    start_time: f64,
    /// Number of calls since the start.
    pub calls: u64,
    /// Largest closing speed since the start [m/s].
    pub fastest: f64,
}

impl<'a> Contact<'a> {
    /// The contact whose variables have this `prefix`. Every start sets those of these `parameters` that the FMU has.
    pub fn new(
        archive: &'a Archive,
        unit: &'a Unit,
        prefix: &str,
        parameters: &[(&str, f64)],
    ) -> Result<Contact<'a>, ImportError> {
        let description = &archive.description;
        let real = |name: &str| description.real(&format!("{prefix}{name}"));
        let known = |(name, value): &(&str, f64)| Some((description.real(name).ok()?, *value));
        let direction = |(index, component): &(&str, f64)| {
            let both = ["rate", "force"].map(|name| real(&format!("tangential_{name}{index}")).ok());
            Some((both[0]?, both[1]?, *component))
        };
        Ok(Contact {
            instance: unit.instantiate()?,
            description,
            parameters: parameters.iter().filter_map(known).collect(),
            rate: real("indentation_rate")?,
            force: real("force")?,
            mean_force: real("mean_force").ok(),
            predicted_force: real("predicted_force").ok(),
            directions: DIRECTIONS.iter().filter_map(direction).collect(),
            prefix: prefix.into(),
            time: 0.0,
            start_time: 0.0,
            calls: 0,
            fastest: 0.0,
        })
    }

    /// Restarts with these parameters, by their whole names; the others have the values of the scene.
    pub fn start(&mut self, parameters: &[(&str, f64)]) -> Result<(), ImportError> {
        self.instance.call("fmi2Reset")?;
        self.instance.setup_experiment(0.0)?;
        self.instance.call("fmi2EnterInitializationMode")?;
        for (reference, value) in &self.parameters {
            self.instance.set_real(*reference, *value)?;
        }
        for (name, value) in parameters {
            self.instance.set_real(self.description.real(name)?, *value)?;
        }
        self.instance.call("fmi2ExitInitializationMode")?;
        (self.time, self.start_time, self.calls, self.fastest) = (0.0, 0.0, 0, 0.0);
        Ok(())
    }

    /// Restarts with the bodies `gap` [m] apart. If the FMU has no such parameter, one `step` [s] moves the bodies apart.
    pub fn start_apart(&mut self, gap: f64, step: f64) -> Result<(), ImportError> {
        if self.description.real("initial_gap").is_ok() {
            return self.start(&[("initial_gap", gap)]);
        }
        self.start(&[])?;
        self.set_rate(-gap / step)?;
        self.step(step)?;
        (self.start_time, self.calls) = (self.time, 0);
        Ok(())
    }

    /// Time since the start [s].
    pub fn elapsed(&self) -> f64 {
        self.time - self.start_time
    }

    /// Makes a step [s] at a closing and a tangential speed [m/s]; the two forces at its end [N].
    pub fn step_obliquely(&mut self, (closing, slip): (f64, f64), step: f64) -> Result<(f64, f64), ImportError> {
        self.set_rate(closing)?;
        for (rate, _, component) in &self.directions {
            self.instance.set_real(*rate, component * slip)?;
        }
        self.step(step)?;
        let mut pull = 0.0;
        for (_, force, component) in &self.directions {
            pull += component * self.instance.real(*force)?;
        }
        Ok((self.force()?, pull))
    }

    /// Another output of the contact, which isn't counted.
    pub fn output(&mut self, name: &str) -> Result<f64, ImportError> {
        self.instance.real(self.description.real(&format!("{}{name}", self.prefix))?)
    }
}

impl Coupled for Contact<'_> {
    type Error = ImportError;

    fn set_rate(&mut self, rate: f64) -> Result<(), Self::Error> {
        self.calls += 1;
        self.fastest = self.fastest.max(rate);
        self.instance.set_real(self.rate, rate)
    }

    fn set_derivatives(&mut self, derivatives: &[f64]) -> Result<(), Self::Error> {
        self.calls += 1;
        self.instance.set_input_derivatives(self.rate, derivatives)
    }

    fn step(&mut self, step: f64) -> Result<(), Self::Error> {
        self.calls += 1;
        self.instance.do_step(self.time, step)?;
        self.time += step;
        Ok(())
    }

    fn force(&mut self) -> Result<f64, Self::Error> {
        self.calls += 1;
        self.instance.real(self.force)
    }

    fn force_slope(&mut self) -> Result<f64, Self::Error> {
        self.calls += 1;
        self.instance.output_derivative(self.force)
    }

    fn mean_force(&mut self) -> Result<f64, Self::Error> {
        self.calls += 1;
        self.instance.real(self.mean_force.ok_or_else(|| ImportError::Variable("mean_force".into()))?)
    }

    fn predicted_force(&mut self) -> Result<f64, Self::Error> {
        self.calls += 1;
        self.instance.real(self.predicted_force.ok_or_else(|| ImportError::Variable("predicted_force".into()))?)
    }
}
