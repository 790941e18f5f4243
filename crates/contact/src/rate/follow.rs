//! The motion of bodies of known mass: each first touch of a surface without a dent finds its strength.

use super::{Factors, History, Model, are_factors};
use crate::impact::Impact;
use crate::loading::Loading;
use crate::motion::{Drive, MOST_EVALUATIONS, NoMotion, Outcome, at_once, follow_to_touch};
use crate::numbers::largest;
use crate::regime::{Regime, TooDeep};
use crate::unloading::Unloading;
use libm::fabs;

/// Largest number of impacts of different speeds in a step.
const MOST_IMPACTS: u32 = 1000;

/// The number of evaluations that a prediction of an impact counts for.
const PREDICTION: u32 = 200;

/// Speeds that differ by less, as a fraction, have the same strength: an elastic rebound returns with its speed but for
/// rounding.
const SAME: f64 = 1e-12;

/// Moves the contact through `step` \[s\] > 0, with the closing speed `speed` \[m/s\] at the start. The strength is found
/// where the bodies touch a surface without a dent, for a free impact of the closing speed. A dent keeps the strength that
/// made it.
///
/// # Errors
/// [`NoMotion`]; the history is then at an intermediate state.
pub fn follow<L: Loading + Copy, U: Unloading + Copy>(
    history: &mut History,
    model: &Model<L, U>,
    drive: &Drive,
    speed: f64,
    step: f64,
) -> Result<Outcome, NoMotion> {
    // most steps need no law
    if let Some(outcome) = at_once(&mut history.plastic, drive, speed, step) {
        return Ok(outcome);
    }
    let mut whole = Outcome { speed, taken: 0.0, evaluations: 0, deepest: 0.0 };
    let mut left = step;
    let mut present = model.at(history.factors);
    for _ in 0..MOST_IMPACTS {
        let (known_speed, known_mass) = (history.speed, history.mass);
        let is_new =
            |speed: f64| drive.mass != known_mass || fabs(speed - known_speed) > SAME * largest(speed, known_speed);
        let (outcome, rest) = follow_to_touch(&mut history.plastic, &present, drive, whole.speed, left, &is_new)?;
        whole.speed = outcome.speed;
        whole.taken += outcome.taken;
        whole.evaluations = whole.evaluations.saturating_add(outcome.evaluations);
        whole.deepest = largest(whole.deepest, outcome.deepest);
        let Some(rest) = rest else { return Ok(whole) };
        let impact = Impact { mass: drive.mass, speed: whole.speed };
        let predictions = history.strengthen(model, &impact)?;
        whole.evaluations = whole.evaluations.saturating_add(PREDICTION * predictions);
        if whole.evaluations > MOST_EVALUATIONS {
            break;
        }
        // most impacts are free
        present = model.at(history.factors).prepared_for(impact.energy());
        left = rest;
    }
    Err(NoMotion::TooLong)
}

impl History {
    /// Finds the strength of an `impact` that may begin within the next step, if the bodies are apart and the surface has no
    /// dent. Where there is none, the strength does not change.
    pub(super) fn meet<L: Loading + Copy, U: Unloading + Copy>(&mut self, model: &Model<L, U>, impact: &Impact) {
        let is_apart = self.plastic.regime() == Regime::Apart && impact.speed > 0.0;
        if is_apart && model.at(self.factors).is_elastic_at(self.plastic.max_indentation()) {
            let before = *self;
            if self.strengthen(model, impact).is_err() {
                *self = before;
            }
        }
    }

    /// Finds the strength of an `impact` that begins now, on a surface without a dent. Returns the number of predictions.
    fn strengthen<L: Loading + Copy, U: Unloading + Copy>(
        &mut self,
        model: &Model<L, U>,
        impact: &Impact,
    ) -> Result<u32, TooDeep> {
        let energy = 0.5 * impact.mass * impact.speed * impact.speed;
        let (factors, predictions) = match model.in_impact(impact) {
            Some(found) => (found.factors, found.steps),
            // an energy without its full precision: the impact is slower than any reference rate
            None if energy < f64::MIN_POSITIVE => (Factors::SLOW, 1),
            None => return Err(TooDeep { indentation: f64::INFINITY }),
        };
        if !are_factors(factors) {
            return Err(TooDeep { indentation: f64::INFINITY });
        }
        self.factors = factors;
        (self.speed, self.mass) = (impact.speed, impact.mass);
        // what another strength took elastically may be beyond the yield point of this one
        self.plastic.forget_elastic();
        Ok(predictions)
    }
}
