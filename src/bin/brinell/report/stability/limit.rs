//! The largest step that keeps a pressed body at rest.

use super::{RANGE, Setting};
use crate::importer::ImportError;
use crate::report::unit::Contact;
use crate::report::ways::{Body, Needs, Way};

/// Up to which step a way is stable, as `h sqrt(K/m)`.
#[derive(Clone, Copy)]
pub enum Limit {
    /// Not even at the smallest step that was tried.
    None,
    Upto(f64),
    /// At every step that was tried.
    Every,
}

/// Growth of a late force's disturbance, as the power of e, for which there must be time: more than `ln GROWTH`. Each step
/// adds `ln(1 + z)/2` to it.
const TIME: f64 = 8.0;

/// Fewest steps over which a disturbance has time to grow: just above its limit, a way's grows slowly.
const STEPS: f64 = 4000.0;

/// What a bounded disturbance doesn't grow to, but just below the limit.
const GROWTH: f64 = 100.0;

/// The largest step at which `way` is stable, by bisection.
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

/// Whether a body that a constant load presses into the deepest indentation keeps to a small motion about it.
fn stays(contact: &mut Contact, way: &Way, setting: &Setting, relative: f64) -> Result<bool, ImportError> {
    let Setting { impact, prediction, frequency, .. } = setting;
    let step = relative / frequency;
    let elastic = prediction.max_indentation - prediction.residual_indentation;
    // a unit that moves the mass itself is taken where it must be before any force can change that
    let moment = if matches!(way.needs, Needs::Mass | Needs::LateMass) { 1e-6 / frequency } else { step };
    contact.start(&[("initial_gap", 0.0)])?;
    contact.set_rate(prediction.max_indentation / moment)?;
    contact.step(moment)?;
    // a bit back, so that the motion is on the elastic way and yields nothing
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
        // the speed of a body whose force is on its way isn't that of the motion
        let speed = if way.needs == Needs::LateMass { contact.output("closing_speed")? } else { body.speed };
        if speed.is_nan() || speed.abs() > GROWTH * disturbance {
            return Ok(false);
        }
    }
    Ok(true)
}
