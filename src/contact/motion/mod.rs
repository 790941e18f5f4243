//! The motion of a mass that the contact force slows down: a contact that knows the mass.
//!
//! An impact takes some ten microseconds, a step of a multibody tool a millisecond. This module solves `m x'' = m a - F(x)`
//! within the step, however many times the bodies meet in it: from event to event (`bodies`), in flight (`flight`) and on the
//! smooth pieces of the law (`stretch`). There is no time stepping: between two events, the speed is a function of the position
//! (`field`, `turning`), and the time is an integral over the position (`travel`). A `short` motion on one segment needs no
//! integral: it is a sine and a cosine on a `line`, and a power series in time on a `curve`.

mod bodies;
mod curve;
mod field;
mod fit;
mod flight;
mod line;
mod moment;
mod series;
mod short;
mod stretch;
mod travel;
mod turning;

use super::Model;
use super::history::{History, Regime, TooDeep};
use super::loading::Loading;
use super::numbers::largest;
use super::unloading::Unloading;
use bodies::Bodies;
use field::Start;
use flight::Flight;
use stretch::{Ended, Stretch};

/// What drives the two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Effective mass \[kg\] > 0: `1/m = 1/m1 + 1/m2`.
    pub mass: f64,
    /// Closing acceleration by all other forces \[m/s^2\], held over the step.
    pub acceleration: f64,
}

/// Where a step has led.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Closing speed at the end \[m/s\].
    pub speed: f64,
    /// Speed that the contact force alone has taken \[m/s\]: its impulse over the mass. Zero without contact, and never less.
    pub taken: f64,
    /// The work that it took, in evaluations of the force of a segment or of its work; one of a law without segments counts for ten.
    pub evaluations: u32,
    /// The largest indentation on the way \[m\], which a fresh surface forgets.
    pub deepest: f64,
}

/// [`follow`], for the history and the model of a scene.
pub type Follow<H, M> = fn(&mut H, &M, &Drive, f64, f64) -> Result<Outcome, NoMotion>;

/// Why a step could not be followed to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoMotion {
    /// The indentation left the range of the law, or a number isn't finite.
    TooDeep(TooDeep),
    /// It takes more than [`MOST_EVALUATIONS`], for bodies that meet thousands of times and lose something each time; or more than
    /// [`MOST_PERIODS`] of a motion that loses nothing.
    TooLong,
}

impl From<TooDeep> for NoMotion {
    fn from(fault: TooDeep) -> NoMotion {
        NoMotion::TooDeep(fault)
    }
}

/// Evaluations of the force after which a step is given up: some hundredths of a second by laws with segments, at most half a
/// second by others. An impact takes some hundred, by other laws some thousand.
pub const MOST_EVALUATIONS: u32 = 1_000_000;

/// Evaluations that one of a law without segments counts for.
const COSTLY: u32 = 10;

/// Periods of an oscillation, or of rebounds without loss, after which a step is given up: where in the next one it ends is
/// known to a thousandth then.
pub const MOST_PERIODS: f64 = 1e12;

/// A way \[m\] that is none: of smaller ones products lose digits.
const SMALLEST: f64 = 1e-290;

/// Moves the contact through `step` \[s\] > 0 with the closing speed `speed` \[m/s\] at its start.
///
/// # Errors
/// [`NoMotion`]; the history is then somewhere on the way.
pub fn follow<L: Loading, U: Unloading>(
    history: &mut History,
    model: &Model<L, U>,
    drive: &Drive,
    speed: f64,
    step: f64,
) -> Result<Outcome, NoMotion> {
    if let Some(outcome) = at_once(history, drive, speed, step) {
        return Ok(outcome);
    }
    let mut bodies = Bodies::new(history, model, drive, speed, step)?;
    while bodies.go_on()? {}
    bodies.stop()
}

/// The step of bodies that stay in flight, or on one branch of the law, if it is short; otherwise nothing is done.
fn at_once(history: &mut History, drive: &Drive, speed: f64, time: f64) -> Option<Outcome> {
    let Drive { mass, acceleration } = *drive;
    let indentation = history.indentation();
    if history.regime() == Regime::Apart {
        let flight = Flight { speed, acceleration };
        let end = flight.speed_after(time);
        // where they turn they are farther than at the end
        let done = speed * end >= 0.0 && history.advance_on_branch(flight.way(time));
        let deepest = history.max_indentation();
        return done.then_some(Outcome { speed: end, taken: 0.0, evaluations: 0, deepest });
    }
    let (segment, is_loading) = (history.branch(), history.is_loading());
    let inverse_mass = 1.0 / mass;
    let net = acceleration - segment.force(indentation) * inverse_mass;
    let rising = speed > 0.0;
    // a rough answer is enough where the branch is left
    let is_near = segment.contains(indentation + time * (speed + 0.5 * net * time)) && (rising || !is_loading);
    if !is_near || speed == 0.0 {
        return None;
    }
    let (sign, bound) = if rising { (1.0, segment.upper - indentation) } else { (-1.0, indentation - segment.lower) };
    let start = Start { indentation, speed, net, acceleration, inverse_mass, time };
    let (Stretch { way, speed: end, ended, .. }, evaluations) = short::stretch(segment, &start, sign, bound, false)?;
    let done = ended == Ended::WithStep && history.advance_on_branch(way);
    let taken = largest(acceleration * time - (end - speed), 0.0);
    done.then_some(Outcome { speed: end, taken, evaluations, deepest: history.max_indentation() })
}
