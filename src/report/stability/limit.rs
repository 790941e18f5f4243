//! The largest step that keeps a pressed body at rest.

use super::{RANGE, Setting};
use crate::importer::ImportError;
use crate::report::contact::Contact;
use crate::report::ways::{Body, Needs, Way};

/// The stability limit of a way, as `h sqrt(K/m)`.
#[derive(Clone, Copy)]
pub enum Limit {
    /// Unstable even at the smallest step.
    None,
    Upto(f64),
    /// Stable at every step.
    Every,
}

/// Growth of a disturbance by a delayed force, as a power of e, that the run must allow: more than `ln GROWTH`. Each
/// step adds `ln(1 + z)/2`.
const TIME: f64 = 8.0;

/// Minimum number of steps for a disturbance to grow: just above the limit it grows slowly.
const STEPS: f64 = 4000.0;

/// A bounded disturbance stays below this factor, except just below the limit.
const GROWTH: f64 = 100.0;

/// The largest step for which `way` is stable, by bisection.
pub fn find(contact: &mut Contact, way: &Way, setting: &Setting) -> Result<Limit, ImportError> {
    let (mut low, mut high) = RANGE;
    if !stays(contact, way, setting, low)? {
        return Ok(Limit::None);
    }
    if stays(contact, way, setting, high)? {
        return Ok(Limit::Every);
    }
    for _ in 0..20 {
        let middle = (low * high).sqrt();
        if stays(contact, way, setting, middle)? { low = middle } else { high = middle }
    }
    Ok(Limit::Upto(low))
}

/// Whether a body keeps to a small motion about the deepest indentation, into which a constant load presses it.
fn stays(contact: &mut Contact, way: &Way, setting: &Setting, relative: f64) -> Result<bool, ImportError> {
    let Setting { impact, prediction, frequency, .. } = setting;
    let step = relative / frequency;
    let elastic = prediction.max_indentation - prediction.residual_indentation;
    // an FMU that moves the mass itself goes to that position before any force can change it
    let moment = if matches!(way.needs, Needs::Mass | Needs::LateMass) { 1e-6 / frequency } else { step };
    contact.start(&[("initial_gap", 0.0)])?;
    contact.set_rate(prediction.max_indentation / moment)?;
    contact.step(moment)?;
    // a little back: the motion is then elastic and does not yield
    contact.set_rate(-0.01 * elastic / moment)?;
    contact.step(moment)?;
    contact.set_rate(0.0)?;
    let mut body = Body::pressed(impact.mass, contact.force()?);
    if way.needs == Needs::LateMass {
        body.owed = contact.mean_force()?;
    }
    let disturbance = 1e-6 * elastic * frequency;
    body.speed += disturbance;
    let steps = STEPS.max(2.0 * TIME / (relative * relative).ln_1p()) as u64;
    for _ in 0..steps {
        (way.advance)(contact, &mut body, step)?;
        // with a delayed force, the speed of the body differs from that of the motion
        let speed = if way.needs == Needs::LateMass { contact.output("closing_speed")? } else { body.speed };
        if speed.is_nan() || speed.abs() > GROWTH * disturbance {
            return Ok(false);
        }
    }
    Ok(true)
}
