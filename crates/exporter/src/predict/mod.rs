//! Predictions of impacts by energy balance, or by integrating the motion.

pub mod answer;
pub mod axis;
pub mod constants;
pub mod notes;
pub mod oblique;
pub mod spread;
pub mod sweep;
pub mod time_history;

use crate::bisection::border;
use crate::laws::{self, Choice};
use crate::layout;
pub use crate::model::{GRAVITY, speed_of_height};
use crate::model::{NoEnergy, check_energy};
use crate::numbers::{in_message, out_of_range, quantity, significant};
use crate::pairing;
use crate::rods::Waves;
use crate::scene::{Body, Scene};
use crate::table;
use crate::validity::{self, Beyond};
use brinell_contact::Loading;
use brinell_contact::Pair;
use brinell_contact::Regime;
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::losses::{AnyLoss, Plate};
use std::error::Error;

/// An impact without a prediction.
#[derive(Debug, thiserror::Error)]
pub enum PredictError {
    #[error("{name} = {} must be positive and finite", in_message(*.value))]
    NotPositive { name: &'static str, value: f64 },
    #[error(
        "the law {law} can't be evaluated for an impact of {} at {}: it is too hard",
        quantity(*.mass, "kg"), quantity(*.speed, "m/s")
    )]
    Beyond { law: String, mass: f64, speed: f64 },
    #[error(
        "an impact of {} at {} would make a contact of {} radius by the law {law}, and the size of the smaller body is {}: no contact \
         is wider than its body",
        quantity(*.mass, "kg"), quantity(*.speed, "m/s"), quantity(*.radius, "m"), quantity(*.size, "m")
    )]
    TooWide { law: String, mass: f64, speed: f64, radius: f64, size: f64 },
    #[error("{0}")]
    Energy(#[from] NoEnergy),
    #[error("no {what} from {} to {} explains {name} = {}", quantity(*.low, .unit), quantity(*.high, .unit), quantity(*.value, .of))]
    NoSolution {
        what: &'static str,
        unit: &'static str,
        low: f64,
        high: f64,
        name: &'static str,
        value: f64,
        of: &'static str,
    },
    #[error("restitution = {} must be above 0 and at most 1", in_message(*.0))]
    Restitution(f64),
    #[error("nothing explains restitution = {}: {searched}", in_message(*.goal))]
    NoRebound { goal: f64, searched: String },
    #[error("the law {0} is rate-dependent: it leaves no dent and has no yield strength to look for")]
    NoDent(String),
    #[error("{0}")]
    Varied(String),
    #[error("angle = {} must be above -90 and below 90 degrees from the normal", in_message(*.0))]
    Angle(f64),
    #[error("spin = {} rad/s must be finite", in_message(*.0))]
    Spin(f64),
    #[error("friction {}", out_of_range(*value, allowed, ""))]
    Coefficient { value: f64, allowed: std::ops::RangeInclusive<f64> },
    #[error("{name} = {} {unit}: the tables [[body]] of the scene say that of its bodies; leave it out", in_message(*.value))]
    OfBodies { name: &'static str, value: f64, unit: &'static str },
    #[error("the law {law} doesn't support friction: {why}")]
    NoFriction { law: String, why: String },
    #[error("the scene has no friction: give it [friction] coefficient, or --friction, such as --friction 0.1")]
    NoCoefficient,
    #[error("--{0} belongs to an oblique impact: add --angle DEGREES, --spin RAD/S or a sweep over one of them")]
    NotOblique(&'static str),
}

/// Rejects numbers that are not positive and finite.
pub fn positive(name: &'static str, value: f64) -> Result<f64, PredictError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(PredictError::NotPositive { name, value }) }
}

/// The speed \[m/s\] of a `mass` \[kg\] with this kinetic energy \[J\].
pub fn speed_of_energy(mass: f64, energy: f64) -> f64 {
    (2.0 * energy / mass).sqrt()
}

/// The prediction for `choice`.
pub fn one(choice: &Choice, impact: &Impact) -> Result<Prediction, PredictError> {
    let beyond = || PredictError::Beyond { law: choice.laws.clone(), mass: impact.mass, speed: impact.speed };
    choice.model.predict(impact).ok_or_else(beyond)
}

/// Rejects a `prediction` of `impact` by `law` on the contacts of `group` in which the contact is as wide as the smaller body.
///
/// # Errors
/// [`PredictError::TooWide`]
pub fn check_width(
    scene: &Scene,
    group: usize,
    law: &str,
    impact: &Impact,
    prediction: &Prediction,
) -> Result<(), PredictError> {
    let (radius, size) = (prediction.max_contact_radius, scene.smaller_radius(group));
    let Impact { mass, speed } = *impact;
    if radius >= size { Err(PredictError::TooWide { law: law.into(), mass, speed, radius, size }) } else { Ok(()) }
}

/// What the law of `scene` is, and what the law of scenes that name none says of the same impact.
///
/// # Errors
/// As for [`one`] and [`laws::choose`].
pub fn by_the_default_law(scene: &Scene) -> Result<String, Box<dyn Error>> {
    let choices = laws::choose(scene, &[pairing::DEFAULT_LOADING.to_string()])?;
    let said = one(&choices[0], &scene.impact_of(0))?;
    let title = |name| &table::loading_law(name).title;
    let text = format!(
        "This scene has the law {} ({}). Without [law] it has {} ({}), which predicts {}, a dent of {} and a restitution of {}.",
        scene.laws.loading().0,
        title(scene.laws.loading().0),
        pairing::DEFAULT_LOADING,
        title(pairing::DEFAULT_LOADING),
        quantity(said.max_force, "N"),
        quantity(said.residual_indentation, "m"),
        significant(said.restitution, 4)
    );
    Ok(layout::paragraph("  ", &text))
}

/// The limits of validity that this impact at `speed` \[m/s\] exceeds on the first contact of `scene`, which has the bodies `pair`.
pub fn beyond(scene: &Scene, pair: &Pair, speed: f64, prediction: &Prediction) -> Vec<Beyond> {
    let bodies = (pair, scene.size(0));
    let limits =
        validity::beyond(bodies, scene.line_size(0), scene.contacts[0].density, prediction.max_contact_radius, speed);
    let of_shape = |beyond| match beyond {
        Beyond::Size { ratio, .. } if scene.contacts[0].ellipse.is_some() => Beyond::HalfAxis(ratio),
        beyond => beyond,
    };
    let waves = Waves::of(scene, speed).and_then(|waves| waves.beyond(prediction));
    let plate = match scene.loss_of(0) {
        Some(AnyLoss::Plate(Plate { thickness, .. })) => {
            let own = scene.group_value(0, Body::Target.yield_strength());
            let strength = own.unwrap_or(pair.yield_strength);
            validity::bends(thickness, strength, prediction.max_force)
        }
        _ => None,
    };
    limits.into_iter().map(of_shape).chain(waves).chain(plate).collect()
}

/// A quantity of an impact: name, value, unit.
pub type Quantity = (&'static str, f64, &'static str);

/// The quantities of a prediction.
pub fn quantities(prediction: &Prediction) -> [Quantity; 9] {
    [
        ("largest force", prediction.max_force, "N"),
        ("largest indentation", prediction.max_indentation, "m"),
        ("largest contact radius", prediction.max_contact_radius, "m"),
        ("dent", prediction.residual_indentation, "m"),
        ("restitution", prediction.restitution, ""),
        ("kinetic energy", prediction.energy, "J"),
        ("energy lost", energy_lost(prediction), "J"),
        ("loading time", prediction.loading_time, "s"),
        ("unloading time", prediction.unloading_time, "s"),
    ]
}

/// Dissipated energy \[J\].
pub fn energy_lost(prediction: &Prediction) -> f64 {
    let lost = prediction.energy - prediction.rebound_energy;
    // energies that differ only by rounding
    if lost.abs() <= 8.0 * f64::EPSILON * prediction.energy { 0.0 } else { lost }
}

/// The speeds \[m/s\] at which an impact enters each further regime of `choice`.
pub fn onsets(choice: &Choice, mass: f64) -> Vec<(Regime, f64)> {
    let mut onsets = Vec::new();
    let Some(model) = choice.model.elastoplastic() else { return onsets };
    let (law, pair) = (model.loading, model.pair);
    let at = |indentation| law.regime(&pair, indentation);
    let (mut below, mut corner) = (0.0, law.next_corner(&pair, 0.0));
    while corner < brinell_contact::LARGEST_INDENTATION {
        while at(corner) != at(below) {
            let regime = at(below);
            below = border((below, corner), |indentation| at(indentation) != regime);
            onsets.push((at(below), (2.0 * law.work(&pair, below) / mass).sqrt()));
        }
        (below, corner) = (corner, law.next_corner(&pair, corner));
    }
    onsets
}

/// The method of the predictions for these laws, in words.
pub fn methods(choices: &[Choice]) -> &'static str {
    let mut methods: Vec<_> = choices.iter().map(|choice| choice.model.method()).collect();
    methods.dedup();
    match methods.as_slice() {
        [method] => method,
        // both kinds of laws
        _ => "by energy balance, for rate-dependent laws by integrating the motion",
    }
}
