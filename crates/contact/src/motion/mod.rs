//! The motion of bodies of known mass under the contact force.
//!
//! An impact takes some tens of microseconds, a step of a multibody tool about a millisecond. This module solves
//! `m x'' = m a - F(x)` within the step, however many times the bodies touch in it: from event to event (`integrator`), in flight
//! (`flight`) and on the smooth pieces of the law (`stretch`). There is no time stepping: between two events, the speed is a
//! function of the position (`field`, `turning`), and the time is an integral over the position (`travel`). A `short` motion on
//! one segment needs no integral: it is a sine and a cosine on a `line`, and a power series in time on a `curve`.

mod curve;
mod field;
mod fit;
pub(crate) mod flight;
mod integrator;
mod line;
mod moment;
mod moments;
mod series;
mod short;
mod stretch;
mod travel;
mod turning;

use super::Model;
use super::history::History;
use super::impact::Impact;
use super::loading::Loading;
use super::regime::{Regime, TooDeep};
use super::unloading::Unloading;
use crate::numerics::largest;
use core::borrow::Borrow;
use field::Start;
use field::{Ended, Stretch};
use flight::Flight;
use integrator::Integrator;

/// The inputs of the motion of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExternalLoad {
    /// Effective mass \[kg\] > 0: `1/m = 1/m1 + 1/m2`.
    pub mass: f64,
    /// Closing acceleration by all forces except the contact force \[m/s^2\], constant over the step.
    pub acceleration: f64,
}

/// The result of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Closing speed at the end \[m/s\].
    pub speed: f64,
    /// Closing speed removed by the contact force \[m/s\]: its impulse over the mass. It is zero without contact, and never
    /// negative.
    pub speed_removed: f64,
    /// Number of evaluations of the force of a segment or of its work. An evaluation of a law without segments counts as ten.
    pub evaluations: u32,
    /// The largest indentation during the step \[m\], which a fresh surface forgets.
    pub deepest: f64,
}

/// The type of [`follow`] for the history and the model of a scene.
pub type Follow<H, M> = fn(&mut H, &M, &ExternalLoad, f64, f64) -> Result<Outcome, NoMotion>;

/// The reason why a step could not be computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoMotion {
    /// The indentation left the range of the law, or a number is not finite.
    TooDeep(TooDeep),
    /// The step takes more than [`MOST_EVALUATIONS`], as for bodies that touch thousands of times and lose energy each time, or
    /// more than [`MOST_PERIODS`] of a lossless motion.
    TooLong,
}

impl From<TooDeep> for NoMotion {
    fn from(fault: TooDeep) -> NoMotion {
        NoMotion::TooDeep(fault)
    }
}

/// Largest number of evaluations of the force in a step. This takes a few hundredths of a second for laws with segments and at
/// most half a second for others. An impact takes a few hundred evaluations, with laws without segments a few thousand.
pub const MOST_EVALUATIONS: u32 = 1_000_000;

/// The number of evaluations that one evaluation of a law without segments counts for.
pub(crate) const COSTLY: u32 = 10;

/// Largest number of impacts in a step that find strengths of their own.
const MOST_IMPACTS: u32 = 1000;

/// Largest number of periods of an oscillation, or of lossless rebounds, in a step. The phase at the end is then known to a
/// thousandth of a period.
pub const MOST_PERIODS: f64 = 1e12;

/// Shorter distances \[m\] count as zero, because their products lose digits.
const SMALLEST: f64 = 1e-290;

/// A contact whose elastoplastic part a motion follows, between bodies of a model `M`.
pub trait PlasticContact<M>: Copy {
    /// The loading law.
    type Loading: Loading;

    /// The unloading law.
    type Unloading: Unloading;

    /// The elastoplastic part of a model, or one of the contact's own.
    type PlasticModel<'a>: Borrow<Model<Self::Loading, Self::Unloading>>
    where
        M: 'a;

    /// The elastoplastic part of the model, as it is for this contact.
    fn plastic_model<'a>(&self, model: &'a M) -> Self::PlasticModel<'a>;

    /// The elastoplastic state.
    fn plastic(&self) -> &History;

    /// The same to change.
    fn plastic_mut(&mut self) -> &mut History;

    /// Whether an `impact` on a surface without a dent has a strength of its own, other than that of the last one.
    #[inline(always)]
    fn is_new(&self, _impact: &Impact) -> bool {
        false
    }

    /// Finds the strength of an `impact` that begins now and [is new](PlasticContact::is_new), on a surface without a dent. Returns the
    /// model for this impact, and the number of evaluations that it took.
    ///
    /// # Errors
    /// [`TooDeep`] outside the range of the law.
    fn strengthen<'a>(&mut self, model: &'a M, _impact: &Impact) -> Result<(Self::PlasticModel<'a>, u32), TooDeep> {
        Ok((self.plastic_model(model), 0))
    }
}

impl<L: Loading, U: Unloading> PlasticContact<Model<L, U>> for History {
    type Loading = L;
    type Unloading = U;
    type PlasticModel<'a>
        = &'a Model<L, U>
    where
        Model<L, U>: 'a;

    fn plastic_model<'a>(&self, model: &'a Model<L, U>) -> &'a Model<L, U> {
        model
    }

    fn plastic(&self) -> &History {
        self
    }

    fn plastic_mut(&mut self) -> &mut History {
        self
    }
}

/// Moves the contact through `step` \[s\] > 0, with the closing speed `speed` \[m/s\] at the start.
///
/// # Errors
/// [`NoMotion`]; the contact is then at an intermediate state.
pub fn follow<C: PlasticContact<M>, M>(
    contact: &mut C,
    model: &M,
    load: &ExternalLoad,
    speed: f64,
    step: f64,
) -> Result<Outcome, NoMotion> {
    if let Some(outcome) = at_once(contact.plastic_mut(), load, speed, step) {
        return Ok(outcome);
    }
    let mut whole = Outcome { speed, speed_removed: 0.0, evaluations: 0, deepest: 0.0 };
    let (mut left, mut plastic, mut known) = (step, contact.plastic_model(model), *contact);
    for _ in 0..MOST_IMPACTS {
        let mut bodies = Integrator::new(contact.plastic_mut(), plastic.borrow(), load, whole.speed, left)?;
        let is_new = |speed: f64| known.is_new(&Impact { mass: load.mass, speed });
        let mut touch = bodies.before_touch(is_new);
        while touch.is_none() && bodies.go_on()? {
            touch = bodies.before_touch(is_new);
        }
        let Outcome { speed, speed_removed, evaluations, deepest } = bodies.stop()?;
        whole.speed_removed += speed_removed;
        whole.evaluations = whole.evaluations.saturating_add(evaluations);
        (whole.speed, whole.deepest) = (speed, largest(whole.deepest, deepest));
        let Some((speed, rest)) = touch else { return Ok(whole) };
        let (found, spent) = contact.strengthen(model, &Impact { mass: load.mass, speed })?;
        whole.evaluations = whole.evaluations.saturating_add(spent);
        if whole.evaluations > MOST_EVALUATIONS {
            break;
        }
        (left, plastic, known) = (rest, found, *contact);
    }
    Err(NoMotion::TooLong)
}

/// The time \[s\] from the touch of an untouched surface to the largest indentation; `None` if it is not shorter than `longest` \[s\].
pub(crate) fn time_to_turn<L: Loading, U: Unloading>(
    model: &Model<L, U>,
    load: &ExternalLoad,
    speed: f64,
    longest: f64,
) -> Option<f64> {
    let mut history = History::start(model, 0.0).ok()?;
    let mut bodies = Integrator::new(&mut history, model, load, speed, longest).ok()?;
    while bodies.go_on().ok()? {
        if let Some(left) = bodies.after_turn() {
            return Some(longest - left);
        }
    }
    None
}

/// The step of bodies that stay in flight or on one branch of the law, if it is short. Otherwise it changes nothing.
pub(crate) fn at_once(history: &mut History, load: &ExternalLoad, speed: f64, time: f64) -> Option<Outcome> {
    let ExternalLoad { mass, acceleration } = *load;
    let indentation = history.indentation();
    if history.regime() == Regime::Apart {
        let flight = Flight { speed, acceleration };
        let end = flight.speed_after(time);
        // if the bodies turn, the turning point is farther than the end
        let done = speed * end >= 0.0 && history.advance_on_branch(flight.way(time));
        let deepest = history.max_indentation();
        return done.then_some(Outcome { speed: end, speed_removed: 0.0, evaluations: 0, deepest });
    }
    let (segment, is_loading) = (history.branch(), history.is_loading());
    let inverse_mass = 1.0 / mass;
    let net = acceleration - segment.force(indentation) * inverse_mass;
    let rising = speed > 0.0;
    // a rough estimate is enough to decide whether the branch is left
    let is_near = segment.contains(indentation + time * (speed + 0.5 * net * time)) && (rising || !is_loading);
    if !is_near || speed == 0.0 {
        return None;
    }
    let (sign, bound) = if rising { (1.0, segment.upper - indentation) } else { (-1.0, indentation - segment.lower) };
    let start = Start { indentation, speed, net, acceleration, inverse_mass, time };
    let (Stretch { way, speed: end, gain, ended, .. }, evaluations) =
        short::stretch(segment, &start, sign, bound, false)?;
    let done = ended == Ended::WithStep && history.advance_on_branch(way);
    let speed_removed = largest(acceleration * time - gain, 0.0);
    done.then_some(Outcome { speed: end, speed_removed, evaluations, deepest: history.max_indentation() })
}
