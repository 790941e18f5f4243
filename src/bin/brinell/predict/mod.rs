//! `brinell predict`: what an impact will do, by energy balance, and the same turned round.

pub mod command;
mod inverse;
mod page;
mod rebound;
pub mod sweep;

use crate::laws::Choice;
use crate::numbers::digits;
use crate::validity;
use brinell::contact::Loading;
use brinell::contact::impact::{Impact, Prediction};
use serde_json::{Value, json};
use std::fmt::Write;

/// Standard gravity [m/s^2].
const GRAVITY: f64 = 9.80665;

/// An impact that nothing can be said of.
#[derive(Debug, thiserror::Error)]
pub enum PredictError {
    #[error("{name} = {value} must be positive and finite")]
    NotPositive { name: &'static str, value: f64 },
    #[error("the impact of {} kg at {} m/s is beyond what the law {law} can be evaluated for", digits(*.mass), digits(*.speed))]
    Beyond { law: String, mass: f64, speed: f64 },
    #[error("{0}")]
    Energy(#[from] NoEnergy),
    #[error("no {what} between {low:e} and {high:e} explains {name} = {value}")]
    NoSolution { what: &'static str, low: f64, high: f64, name: &'static str, value: f64 },
    #[error("restitution = {0} must be above 0 and at most 1")]
    Restitution(f64),
    #[error("nothing explains restitution = {goal}: {searched}")]
    NoRebound { goal: f64, searched: String },
    #[error("the law {0} depends on the rate: it leaves no dent and has no yield strength that could explain one")]
    NoDent(String),
    #[error("--sweep {0}: expected `speed FROM:TO`, in m/s, with 0 < FROM < TO")]
    Sweep(String),
}

/// Refuses what isn't positive and finite.
pub fn positive(name: &'static str, value: f64) -> Result<f64, PredictError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(PredictError::NotPositive { name, value }) }
}

/// A kinetic energy so small that it has lost digits already.
#[derive(Debug, thiserror::Error)]
#[error(
    "the kinetic energy of mass = {} kg at speed = {} m/s is {} J: it can't be computed with below {} J",
    digits(.0.mass), digits(.0.speed), digits(energy(.0)), digits(f64::MIN_POSITIVE)
)]
pub struct NoEnergy(Impact);

/// Kinetic energy [J].
fn energy(impact: &Impact) -> f64 {
    0.5 * impact.mass * impact.speed * impact.speed
}

/// Refuses an impact for which no law is to blame: its energy is too small a number.
///
/// # Errors
/// [`NoEnergy`]
pub fn check_energy(impact: &Impact) -> Result<(), NoEnergy> {
    if energy(impact) < f64::MIN_POSITIVE { Err(NoEnergy(*impact)) } else { Ok(()) }
}

/// The speed [m/s] of `mass` [kg] with a kinetic energy [J].
pub fn speed_of_energy(mass: f64, energy: f64) -> f64 {
    (2.0 * energy / mass).sqrt()
}

/// The speed [m/s] after a fall from `height` [m].
pub fn speed_of_height(height: f64) -> f64 {
    (2.0 * GRAVITY * height).sqrt()
}

/// The prediction for `choice`.
pub fn one(choice: &Choice, impact: &Impact) -> Result<Prediction, PredictError> {
    let beyond = || PredictError::Beyond { law: choice.name.clone(), mass: impact.mass, speed: impact.speed };
    choice.model.predict(impact).ok_or_else(beyond)
}

/// The quantities of a prediction: name, value, unit.
fn quantities(prediction: &Prediction) -> [(&'static str, f64, &'static str); 9] {
    let lost = prediction.energy - prediction.rebound_energy;
    // energies that agree to rounding
    let lost = if lost.abs() <= 8.0 * f64::EPSILON * prediction.energy { 0.0 } else { lost };
    [
        ("largest force", prediction.max_force, "N"),
        ("largest indentation", prediction.max_indentation, "m"),
        ("largest contact radius", prediction.max_contact_radius, "m"),
        ("dent", prediction.residual_indentation, "m"),
        ("restitution", prediction.restitution, ""),
        ("kinetic energy", prediction.energy, "J"),
        ("energy lost", lost, "J"),
        ("loading time", prediction.loading_time, "s"),
        ("unloading time", prediction.unloading_time, "s"),
    ]
}

/// The speeds [m/s] at which the contact first yields and becomes fully plastic on `choice`, where it does.
fn onsets(choice: &Choice, mass: f64) -> Vec<(i32, f64)> {
    let mut onsets = Vec::new();
    let Some(model) = choice.model.elastoplastic() else { return onsets };
    let (law, pair) = (model.loading, model.pair);
    let mut regime = law.regime(&pair, 0.0) as i32;
    let mut corner = law.next_corner(&pair, 0.0);
    while corner < brinell::contact::history::LARGEST_INDENTATION {
        let above = law.regime(&pair, corner) as i32;
        if above != regime {
            onsets.push((above, (2.0 * law.work(&pair, corner) / mass).sqrt()));
            regime = above;
        }
        corner = law.next_corner(&pair, corner);
    }
    onsets
}

/// How the predictions by these laws are made, in words.
fn methods(choices: &[Choice]) -> &'static str {
    let mut methods: Vec<_> = choices.iter().map(|choice| choice.model.method()).collect();
    methods.dedup();
    match methods.as_slice() {
        [method] => method,
        // of two kinds of laws: which is which
        _ => "by energy balance; of rate-dependent laws by integrating the motion",
    }
}

/// The predictions as a table for people, with warnings; `density` is that of the target [kg/m^3], if it is known.
pub fn text(choices: &[Choice], impact: &Impact, density: Option<f64>) -> Result<String, PredictError> {
    let mut text = format!("impact of {} kg at {} m/s, {}\n\n", impact.mass, impact.speed, methods(choices));
    let predictions = choices.iter().map(|choice| one(choice, impact)).collect::<Result<Vec<_>, _>>()?;
    let add = |text: &mut String, line: std::fmt::Arguments| text.write_fmt(line).expect("a String takes everything");
    add(&mut text, format_args!("{:<24}", ""));
    for choice in choices {
        add(&mut text, format_args!("{:>22}", choice.name));
    }
    for quantity in 0..quantities(&predictions[0]).len() {
        let (name, _, unit) = quantities(&predictions[0])[quantity];
        add(&mut text, format_args!("\n{name:<24}"));
        for prediction in &predictions {
            add(&mut text, format_args!("{:>22.6e}", quantities(prediction)[quantity].1));
        }
        add(&mut text, format_args!(" {unit}"));
    }
    add(&mut text, format_args!("\n{:<24}", "regime reached"));
    for prediction in &predictions {
        add(&mut text, format_args!("{:>22}", prediction.regime as i32));
    }
    for choice in choices {
        for (regime, speed) in onsets(choice, impact.mass) {
            add(&mut text, format_args!("\n{}: regime {regime} begins at {speed:.6e} m/s", choice.name));
        }
    }
    for (choice, prediction) in choices.iter().zip(&predictions) {
        for warning in validity::warnings(&choice.model.pair(), density, prediction, impact.speed) {
            add(&mut text, format_args!("\nwarning: {}: {warning}", choice.name));
        }
    }
    text.push_str("\n\nregimes: 1 elastic, 2 and 3 elastoplastic, 4 fully plastic\n");
    Ok(text)
}

/// The same for a program.
pub fn as_json(choices: &[Choice], impact: &Impact, density: Option<f64>) -> Result<Value, PredictError> {
    let mut laws = Vec::new();
    for choice in choices {
        let prediction = one(choice, impact)?;
        let mut law = json!({ "law": choice.name, "regime": prediction.regime as i32 });
        for (name, value, _) in quantities(&prediction) {
            law[name.replace(' ', "_")] = json!(value);
        }
        law["onsets"] = onsets(choice, impact.mass)
            .into_iter()
            .map(|(regime, speed)| json!({ "regime": regime, "speed": speed }))
            .collect();
        law["warnings"] = json!(validity::warnings(&choice.model.pair(), density, &prediction, impact.speed));
        laws.push(law);
    }
    Ok(json!({ "mass": impact.mass, "speed": impact.speed, "laws": laws }))
}
