//! Inverse predictions: from a measured dent or rebound to the speed and the yield strength that explain it.

use super::{PredictError, one};
use crate::laws::Choice;
use brinell::contact::impact::Impact;

/// The speed [m/s] at which `mass` [kg] leaves a dent of `dent` [m].
pub fn speed_of_dent(choice: &Choice, mass: f64, dent: f64) -> Result<f64, PredictError> {
    choice.model.elastoplastic().ok_or_else(|| PredictError::NoDent(choice.laws.clone()))?;
    // a speed beyond the range of the law counts as an infinitely deep dent
    let depth = |speed: f64| one(choice, &Impact { mass, speed }).map_or(f64::INFINITY, |p| p.residual_indentation);
    root(("speed", "m/s"), (1e-9, 1e6), ("dent", dent), depth)
}

/// The yield strength [Pa] for which the impact leaves a dent of `dent` [m]: the inverse of the Brinell test.
pub fn strength_of_dent(choice: &Choice, impact: &Impact, dent: f64) -> Result<f64, PredictError> {
    let depth = |yield_strength: f64| {
        let softer = choice.model.with_yield_strength(yield_strength);
        // the dent falls with the strength; a target too soft for the law counts as an infinitely deep dent
        let prediction = softer.and_then(|softer| softer.predict(impact));
        prediction.map_or(f64::NEG_INFINITY, |prediction| -prediction.residual_indentation)
    };
    let modulus = choice.model.pair().modulus;
    root(("yield strength", "Pa"), (1e-7 * modulus, modulus), ("dent", -dent), depth)
}

/// The argument at which the increasing function `of` has the value `goal`, by bisection of its logarithm to rounding.
fn root(
    (what, unit): (&'static str, &'static str),
    (low, high): (f64, f64),
    (name, goal): (&'static str, f64),
    of: impl Fn(f64) -> f64,
) -> Result<f64, PredictError> {
    let none = PredictError::NoSolution { what, unit, low, high, name, value: goal.abs(), of: "m" };
    let (mut below, mut above) = (low, high);
    let exceeds = |argument: f64| of(argument) >= goal;
    if exceeds(below) || !exceeds(above) {
        return Err(none);
    }
    while above > below.next_up() {
        let middle = (below * above).sqrt().clamp(below.next_up(), above.next_down());
        *(if exceeds(middle) { &mut above } else { &mut below }) = middle;
    }
    Ok(above)
}
