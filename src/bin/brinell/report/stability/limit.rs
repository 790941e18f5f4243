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

/// What theory says of a linear spring, as `h sqrt(K/m)`: 0 for a way that is stable at no step, infinity for one that is
/// at every step.
///
/// With `z = h^2 K/m`, indentation `x` and `u = h v`, late force is `x' = x + u`, `u' = u - z x`: both eigenvalues have the
/// modulus `sqrt(1 + z)`. Leap-frog, and `predicted_force` which is the same for a spring, is `x' = x + u`,
/// `u' = u - z x'`: stable to `z = 4`. A unit that knows the mass is exact. Of input derivatives see [`DERIVATIVES`].
///
/// Reference: E. Hairer, C. Lubich, G. Wanner, *Acta Numerica* 12 (2003) 399-450, section 1, for leap-frog.
const THEORY: [(&str, f64); 5] = [
    ("late force", 0.0),
    ("predicted_force", 2.0),
    ("leap-frog", 2.0),
    ("input derivatives", DERIVATIVES),
    ("mass known", f64::INFINITY),
];

/// The limit of input derivatives: the square root of the smallest root of `z^3 - 48 z^2 + 432 z - 576`.
///
/// The step also carries the jerk `j` [times `h^3`], which the unit's slope of the force at the end of a step gives, with
/// the unit's own rate there. With `a = -z x`:
/// `x' = x + u + a/2 + j/6`, `u' = u - z (x + u/2 + a/6 + j/24)` by the mean force, and `j' = -z (u + a + j/2)`. The
/// eigenvalue that leaves the unit circle first does so at -1, where the determinant of the step's matrix plus one is
/// `(576 - 432 z + 48 z^2 - z^3) / 144`.
const DERIVATIVES: f64 = 1.269_862_885_454_414;

/// Growth of a late force's disturbance, as the power of e, for which there must be time: more than `ln GROWTH`. Each step
/// adds `ln(1 + z)/2` to it.
const TIME: f64 = 8.0;

/// Fewest steps over which a disturbance has time to grow: just above its limit, a way's grows slowly.
const STEPS: f64 = 4000.0;

/// What a bounded disturbance doesn't grow to, but just below the limit.
const GROWTH: f64 = 100.0;

/// What theory says of a way, if it says anything.
pub fn theory(way: &str) -> Option<f64> {
    THEORY.iter().find(|(name, _)| *name == way).map(|(_, limit)| *limit)
}

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
    let moment = if way.needs == Needs::Mass { 1e-6 / frequency } else { step };
    contact.start(&[("initial_gap", 0.0)])?;
    contact.set_rate(prediction.max_indentation / moment)?;
    contact.step(moment)?;
    // a bit back, so that the motion is on the elastic way and yields nothing
    contact.set_rate(-0.01 * elastic / moment)?;
    contact.step(moment)?;
    contact.set_rate(0.0)?;
    let mut body = Body::pressed(impact.mass, contact.force()?);
    let disturbance = 1e-6 * elastic * frequency;
    body.speed = disturbance;
    let steps = STEPS.max(2.0 * TIME / (relative * relative).ln_1p()) as u64;
    for _ in 0..steps {
        (way.advance)(contact, &mut body, step)?;
        if body.speed.is_nan() || body.speed.abs() > GROWTH * disturbance {
            return Ok(false);
        }
    }
    Ok(true)
}
