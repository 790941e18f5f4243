//! Typical values of the variables, for solvers that scale by them, and a suitable step size and stop time for a scene.

use crate::numbers::one_digit;
use crate::scene::Scene;
use crate::table::Variable;
use brinell_contact::impact::Prediction;

/// Typical values of one group of contacts.
#[derive(Clone, Copy)]
pub struct Nominal {
    prediction: Prediction,
    /// Area of the contact of the prediction \[m^2\].
    area: f64,
    /// Stiffness \[N/m\].
    stiffness: f64,
    /// Speed of the scene's impact \[m/s\].
    speed: f64,
    /// Coefficient of friction; 1 if it is zero.
    friction: f64,
}

/// The typical values of each group.
pub fn of(scene: &Scene) -> Vec<Nominal> {
    scene.by_bodies(|group| {
        let prediction = scene.predictions[group];
        let model = scene.any_model_of(group);
        let stiffness = model.stiffness(prediction.max_indentation);
        let area = model.area(prediction.max_contact_radius);
        let friction =
            scene.group_value(group, "friction.coefficient").filter(|friction| *friction > 0.0).unwrap_or(1.0);
        Nominal { prediction, area, stiffness, speed: scene.impact.speed, friction }
    })
}

impl Nominal {
    /// The typical value of `variable`, if its entry in the table names one.
    pub fn get(&self, variable: &Variable) -> Option<f64> {
        let Prediction { max_force, max_indentation, max_contact_radius, energy, .. } = self.prediction;
        let size = match variable.nominal_from.as_deref()? {
            "max_force" => max_force,
            "max_indentation" => max_indentation,
            "max_contact_radius" => max_contact_radius,
            "max_mean_pressure" => max_force / self.area,
            "max_stiffness" => self.stiffness,
            "energy" => energy,
            "speed" => self.speed,
            "max_friction" => self.friction * max_force,
            "tangential_momentum" => self.friction * 2.0 * energy / self.speed,
            "momentum" => 2.0 * energy / self.speed,
            // an impulse of this size acts for half of the time
            "moment" => energy / self.speed * self.prediction.contact_time(),
            other => unreachable!("variables.toml names the nominal size {other}, which nobody computes"),
        };
        // a typical value is neither zero nor infinite
        Some(one_digit(size, f64::round)).filter(|nominal| nominal.is_normal())
    }
}

/// Step size and stop time that an importer may take if its user says nothing else.
pub struct Experiment {
    /// Step size \[s\].
    pub step: f64,
    /// Stop time \[s\].
    pub stop: f64,
}

/// Steps per contact for an importer that couples by the force. For the impact of the default scene, the restitution is then accurate
/// to 2 % if the force comes one step late, and to 1e-5 with leap-frog.
const STEPS_PER_CONTACT: f64 = 256.0;

/// Part of the sphere's radius by which the bodies of an FMU that knows the mass move in a step. The contact is right at any step,
/// but the importer moves the bodies by what it knows, and is off by up to this distance in a step with an impact.
const TRAVEL: f64 = 0.1;

/// Longest step of such an FMU \[s\]: slow bodies have other motions, such as a fall, that need a millisecond.
const LONGEST_STEP: f64 = 1e-3;

/// Least number of steps, unless the scene gives both times.
const FEWEST_STEPS: f64 = 500.0;

/// Step size and stop time of the scene, or for its impact on its first contact, which ends before the stop time.
pub fn experiment(scene: &Scene) -> Experiment {
    let (contact_time, speed) = (scene.predictions[0].contact_time(), scene.impact.speed);
    let value = |name| scene.group_value(0, name).unwrap_or(0.0).max(0.0);
    let longest = match &scene.coupling {
        Some(_) => {
            let radius = scene.group_value(0, "impactor.radius").unwrap_or_else(|| scene.smaller_radius(0));
            (TRAVEL * radius / speed).min(LONGEST_STEP)
        }
        None => contact_time / STEPS_PER_CONTACT,
    };
    let step = scene.step_size.unwrap_or_else(|| {
        one_digit(scene.stop_time.map_or(longest, |stop| longest.min(stop / FEWEST_STEPS)), |mantissa| match mantissa {
            m if m >= 5.0 => 5.0,
            m if m >= 2.0 => 2.0,
            _ => 1.0,
        })
    });
    let stop = scene.stop_time.unwrap_or_else(|| {
        let impact = 2.0 * contact_time + value("initial_gap") / speed;
        one_digit(impact.max(FEWEST_STEPS * step), f64::ceil)
    });
    Experiment { step, stop }
}
