//! The FMU that a report steps: the scene's first contact, with the outputs for one kind of coupling.

use super::ways::Needs;
use crate::importer::{Archive, Description, ImportError, Instance, Unit};
use crate::scene::{Body, Both, Coupling, Group, Parameter, Scene};
use crate::table::VARIABLES;

/// Outputs that a report reads, whatever the scene and the coupling.
const OUTPUTS: [&str; 3] = ["indentation", "residual_indentation", "dissipated_energy"];

/// The first contact of `scene` alone, for a kind of coupling; all its parameters can be set.
pub fn first_contact(scene: &Scene, needs: Needs) -> Scene {
    let mass = matches!(needs, Needs::Mass | Needs::LateMass).then_some(scene.impact_of(0).mass);
    let more: &[&str] = match needs {
        Needs::Force | Needs::Friction => &[],
        Needs::PredictedForce => &["predicted_force"],
        Needs::MeanForce | Needs::Mass => &["mean_force"],
        Needs::LateMass => &["mean_force", "closing_speed"],
    };
    let mut parameters: Vec<Parameter> = Vec::new();
    // in the order of the table, like the parameters of every scene
    // the other ways move bodies along the normal only
    let friction = needs == Needs::Friction;
    for name in
        VARIABLES.iter().filter(|variable| friction || !variable.friction).map(|variable| variable.name.as_str())
    {
        let shared = scene.parameters.iter().find(|parameter| parameter.name == name);
        let Some(found) = scene.contacts[0].own.iter().find(|own| own.name == name).or(shared) else { continue };
        parameters.push(Parameter::shared(found.name, found.value, true));
    }
    if let (Some(value), None) = (mass, scene.group_value(0, "effective_mass")) {
        // it precedes the gap, which every contact has
        let gap = parameters.iter().position(|parameter| parameter.name == "initial_gap").unwrap_or(parameters.len());
        parameters.insert(gap, Parameter::shared("effective_mass", value, true));
    }
    // a body with its own strength has no power law
    let own = |body: Body| scene.contacts[0].own.iter().any(|own| own.name == body.yield_strength());
    let power_laws = Both {
        impactor: scene.power_laws.impactor.filter(|_| !own(Body::Impactor)),
        target: scene.power_laws.target.filter(|_| !own(Body::Target)),
    };
    let unit = Scene {
        name: scene.name.clone(),
        description: scene.description.clone(),
        parameters,
        contacts: vec![Group { name: None, count: None, own: Vec::new(), ..scene.contacts[0].clone() }],
        outputs: OUTPUTS
            .iter()
            .chain(more)
            .chain(friction.then_some(&"tangential_force"))
            .map(|name| (*name).to_string())
            .collect(),
        loading: scene.loading,
        unloading: scene.unloading,
        damped: scene.damped,
        loss: scene.loss,
        passivity_guard: scene.passivity_guard,
        yield_strength: scene.yield_strength,
        power_laws,
        rates: scene.rates,
        quasi_static: vec![scene.quasi_static[0]],
        factors: vec![1.0],
        coupling: mass.map(|_| Coupling { parallel: needs == Needs::LateMass, ..Coupling::default() }),
        directions: usize::from(friction),
        impact: scene.impact_of(0),
        predictions: vec![scene.predictions[0]],
        input_derivatives: true,
        watches: false,
        structured_names: false,
        standalone: false,
        impact_is_assumed: scene.impact_is_assumed,
        text: scene.text.clone(),
    };
    // a unit with a mass finds the strength by itself, the others have it as a parameter
    unit.with_strengths_for(None).expect("the scene has been predicted")
}

/// A contact in the hands of a co-simulation algorithm; it counts the calls.
pub struct Contact<'a> {
    instance: Instance<'a>,
    description: &'a Description,
    /// Parameters that differ from the start values of the FMU.
    parameters: Vec<(u32, f64)>,
    rate: u32,
    force: u32,
    // outputs that another FMU may not have
    mean_force: Option<u32>,
    predicted_force: Option<u32>,
    /// Time of the co-simulation, and its start time [s].
    time: f64,
    start_time: f64,
    /// Number of calls since the start.
    pub calls: u64,
    /// Largest closing speed since the start [m/s].
    pub fastest: f64,
}

impl<'a> Contact<'a> {
    /// A contact of the FMU. Every start sets those of these `parameters` that the FMU has.
    pub fn new(archive: &'a Archive, unit: &'a Unit, parameters: &[(&str, f64)]) -> Result<Contact<'a>, ImportError> {
        let description = &archive.description;
        let known = |(name, value): &(&str, f64)| Some((description.real(name).ok()?, *value));
        Ok(Contact {
            instance: unit.instantiate()?,
            description,
            parameters: parameters.iter().filter_map(known).collect(),
            rate: description.real("indentation_rate")?,
            force: description.real("force")?,
            mean_force: description.real("mean_force").ok(),
            predicted_force: description.real("predicted_force").ok(),
            time: 0.0,
            start_time: 0.0,
            calls: 0,
            fastest: 0.0,
        })
    }

    /// Restarts with these parameters; the others have the values of the scene.
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

    /// Enables warnings, including those already logged.
    pub fn ask_for_warnings(&mut self) -> Result<(), ImportError> {
        self.instance.take_warnings();
        self.instance.ask_for_warnings()
    }

    /// The warnings since they were enabled.
    pub fn warnings(&mut self) -> Vec<String> {
        self.instance.take_warnings()
    }

    /// Time since the start [s].
    pub fn elapsed(&self) -> f64 {
        self.time - self.start_time
    }

    /// Sets the closing speed [m/s].
    pub fn set_rate(&mut self, rate: f64) -> Result<(), ImportError> {
        self.calls += 1;
        self.fastest = self.fastest.max(rate);
        self.instance.set_real(self.rate, rate)
    }

    /// Sets the relative tangential speed of the contact points [m/s].
    pub fn set_tangential_rate(&mut self, rate: f64) -> Result<(), ImportError> {
        self.calls += 1;
        self.instance.set_real(self.description.real("tangential_rate")?, rate)
    }

    /// Sets the derivatives of the closing speed for the next step: [m/s^2], [m/s^3].
    pub fn set_derivatives(&mut self, derivatives: &[f64]) -> Result<(), ImportError> {
        self.calls += 1;
        self.instance.set_input_derivatives(self.rate, derivatives)
    }

    /// Makes a step [s].
    pub fn step(&mut self, step: f64) -> Result<(), ImportError> {
        self.calls += 1;
        self.instance.do_step(self.time, step)?;
        self.time += step;
        Ok(())
    }

    /// The force at the end of the step [N].
    pub fn force(&mut self) -> Result<f64, ImportError> {
        self.calls += 1;
        self.instance.real(self.force)
    }

    /// The time derivative of the force at the end of the step [N/s].
    pub fn force_slope(&mut self) -> Result<f64, ImportError> {
        self.calls += 1;
        self.instance.output_derivative(self.force)
    }

    /// The mean force over the step [N].
    pub fn mean_force(&mut self) -> Result<f64, ImportError> {
        self.calls += 1;
        self.instance.real(self.mean_force.ok_or_else(|| ImportError::Variable("mean_force".into()))?)
    }

    /// The force that the FMU predicts for the end of the next step [N].
    pub fn predicted_force(&mut self) -> Result<f64, ImportError> {
        self.calls += 1;
        self.instance.real(self.predicted_force.ok_or_else(|| ImportError::Variable("predicted_force".into()))?)
    }

    /// Another output of the FMU.
    pub fn output(&mut self, name: &str) -> Result<f64, ImportError> {
        self.instance.real(self.description.real(name)?)
    }
}
