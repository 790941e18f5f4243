//! The motion of bodies under one contact with a loss: that of contacts that [share](crate::shared) bodies, for a single one.

use super::history::History;
use super::{Loss, Model};
use crate::loading::Loading;
use crate::motion::{ExternalLoad, NoMotion, Outcome};
use crate::numerics::largest;
use crate::regime::TooDeep;
use crate::shared::{self, InverseMasses, Refused, SharedContact, Work};
use crate::unloading::Unloading;

/// Moves one `contact` through `step` \[s\], of bodies with this inverse mass \[1/kg\], acceleration \[m/s^2\] and closing speed \[m/s\].
/// Returns the closing speed at the end, the number of evaluations, and the working memory, which has the impulse.
///
/// # Errors
/// [`NoMotion`]; the contact is then unchanged.
pub(super) fn alone<M, C: SharedContact<M>>(
    contact: &mut C,
    model: &M,
    (inverse_mass, acceleration, speed): (f64, f64, f64),
    step: f64,
) -> Result<(f64, u32, Work<C>), NoMotion> {
    let (mut work, mut rates, entries) = ([Work::new(*contact)], [speed], [inverse_mass]);
    let (contacts, masses) = (core::slice::from_mut(contact), InverseMasses::single(&entries));
    let outcome = shared::follow(contacts, |_| model, &masses, &[acceleration], &mut rates, &mut work, step);
    let ([rate], [work]) = (rates, work);
    match outcome {
        Ok(outcome) => Ok((rate, outcome.evaluations, work)),
        Err(Refused::TooDeep(_, deep)) => Err(NoMotion::TooDeep(deep)),
        Err(Refused::Sizes | Refused::TooLong { .. }) => Err(NoMotion::TooLong),
    }
}

/// Moves the contact through `step` \[s\] > 0, with the closing speed `speed` \[m/s\] at the start.
///
/// # Errors
/// [`NoMotion`]; the contact is then unchanged.
pub fn follow<C: SharedContact<M>, M>(
    contact: &mut C,
    model: &M,
    load: &ExternalLoad,
    speed: f64,
    step: f64,
) -> Result<Outcome, NoMotion> {
    let inverse_mass = 1.0 / load.mass;
    let (speed, evaluations, work) = alone(contact, model, (inverse_mass, load.acceleration, speed), step)?;
    let speed_removed = largest(work.impulse() * inverse_mass, 0.0);
    Ok(Outcome { speed, speed_removed, evaluations, deepest: work.deepest() })
}

/// Moves the contact on a plate through `step` \[s\] of bodies that close at `rate` \[m/s\], whatever the force. Returns its impulse
/// \[N.s\].
///
/// # Errors
/// [`TooDeep`] outside the range of the law, and for a step that would take too many evaluations; the history is then unchanged.
pub(super) fn driven<L: Loading, U: Unloading, K: Loss>(
    history: &mut History<K>,
    model: &Model<L, U, K>,
    rate: f64,
    step: f64,
) -> Result<f64, TooDeep> {
    let from = history.plastic().indentation();
    match alone(history, model, (0.0, 0.0, rate), step) {
        Ok((_, _, work)) => Ok(work.impulse()),
        Err(NoMotion::TooDeep(deep)) => Err(deep),
        Err(NoMotion::TooLong) => Err(TooDeep { indentation: from + rate * step }),
    }
}
