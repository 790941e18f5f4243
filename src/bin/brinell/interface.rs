//! The variables that a scene's unit has, in order: the one list from which XML, constants and documentation are made.

use crate::scene::Scene;
use crate::table::{Causality, VARIABLES, Variable};
use brinell::contact::damped::Damped;
use brinell::contact::impact::Prediction;
use std::f64::consts::PI;

/// A variable of a unit; its place in the list is its value reference.
pub struct Entry {
    pub variable: &'static Variable,
    /// For the input and the parameters.
    pub start: Option<f64>,
    /// Places of the parameters, and of the input, that the value before the first step follows.
    pub dependencies: Vec<usize>,
    /// Place of the input that the value follows at the same instant.
    pub follows: Option<usize>,
    pub nominal: Option<f64>,
}

/// The variables of the scene's unit.
pub fn entries(scene: &Scene) -> Vec<Entry> {
    let chosen = |variable: &Variable| match variable.causality {
        Causality::Input => true,
        Causality::Output => variable.name == "force" || scene.outputs.contains(&variable.name),
        Causality::Parameter => scene.settable().any(|parameter| parameter.name == variable.name),
    };
    let variables: Vec<&'static Variable> = VARIABLES.iter().filter(|variable| chosen(variable)).collect();
    let nominals = Nominals::of(scene);
    // a damping that waits for the first touch is none before the first step
    let damped_from_the_start = scene.damped.is_some_and(|(_, law)| !law.scaled_by_touch());
    let entry = |variable: &&'static Variable| {
        let depends = |other: &Variable| {
            other.causality == Causality::Parameter
                && (damped_from_the_start || other.name != "restitution")
                && variable.depends_on.iter().any(|name| name == "*" || *name == other.name)
        };
        let dependencies = variables.iter().enumerate().filter(|(_, other)| depends(other)).map(|(place, _)| place);
        let start = match variable.causality {
            Causality::Input => Some(0.0),
            Causality::Output => None,
            Causality::Parameter => scene.value(&variable.name),
        };
        let input = || variables.iter().position(|other| other.causality == Causality::Input);
        let follows = (scene.damped.is_some() && variable.follows_rate).then(input).flatten();
        let dependencies: Vec<_> = follows.into_iter().filter(|_| damped_from_the_start).chain(dependencies).collect();
        Entry { variable, start, dependencies, follows, nominal: nominals.get(variable) }
    };
    variables.iter().map(entry).collect()
}

/// What the scene's impact will do.
pub fn prediction(scene: &Scene) -> Prediction {
    scene.any_model().predict(&scene.impact).expect("a checked scene has a prediction")
}

/// Typical sizes, for solvers that scale by them.
struct Nominals {
    prediction: Prediction,
    stiffness: f64,
}

impl Nominals {
    fn of(scene: &Scene) -> Nominals {
        let prediction = prediction(scene);
        let stiffness = scene.any_model().stiffness(prediction.max_indentation);
        Nominals { prediction, stiffness }
    }

    fn get(&self, variable: &Variable) -> Option<f64> {
        let Prediction { max_force, max_indentation, max_contact_radius, energy, .. } = self.prediction;
        let size = match variable.nominal_from.as_deref()? {
            "max_force" => max_force,
            "max_indentation" => max_indentation,
            "max_contact_radius" => max_contact_radius,
            "max_mean_pressure" => max_force / (PI * max_contact_radius * max_contact_radius),
            "max_stiffness" => self.stiffness,
            "energy" => energy,
            other => unreachable!("variables.toml names the nominal size {other}, which nobody computes"),
        };
        Some(one_digit(size, f64::round))
    }
}

/// `value` > 0 with one significant digit, its mantissa rounded by `round`.
pub fn one_digit(value: f64, round: fn(f64) -> f64) -> f64 {
    let exponent = value.log10().floor() as i32;
    let mantissa = round(value / 10f64.powi(exponent));
    // through text, so that the result is the number that a person would write
    format!("{mantissa}e{exponent}").parse().expect("a number and an exponent")
}

/// Step and stop time that suit the scene.
pub struct Experiment {
    /// [s]
    pub step: f64,
    /// [s]
    pub stop: f64,
}

/// How many steps of a contact a plain master should make at least: the error of its restitution is then below 1 %.
const STEPS_PER_CONTACT: f64 = 256.0;

/// Step and stop time that suit the scene's impact: the contact takes 256 steps, and ends before the stop.
pub fn experiment(scene: &Scene) -> Experiment {
    let contact_time = prediction(scene).contact_time();
    let step = one_digit(contact_time / STEPS_PER_CONTACT, |mantissa| match mantissa {
        m if m >= 5.0 => 5.0,
        m if m >= 2.0 => 2.0,
        _ => 1.0,
    });
    let gap = scene.value("initial_gap").unwrap_or(0.0).max(0.0);
    let stop = one_digit(2.0 * contact_time + gap / scene.impact.speed, f64::ceil);
    Experiment { step, stop }
}
