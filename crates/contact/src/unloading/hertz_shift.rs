//! Hertz's curve, lowered so that it passes through the peak.

use super::{Peak, Unloading, hertzian};
use crate::material::Pair;
use crate::segment::Segment;
use libm::{cbrt, sqrt};

/// `F = F_m - K_h (d_m^1.5 - d^1.5)`, which is zero at `d_f = (d_m^1.5 - F_m/K_h)^(2/3)`.
///
/// This is not a pure power of `d - d_f`: the stiffness at the residual indentation is not zero. Where the loading law lies
/// above Hertz's curve, the curve is not shifted.
///
/// Reference: A. S. Yigit, A. P. Christoforou, *Composites Engineering* 4 (1994) 1143-1152.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct HertzShift;

impl Unloading for HertzShift {
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let stiffness = pair.hertz_stiffness();
        let hertz_force = stiffness * (peak.indentation * sqrt(peak.indentation));
        let difference = hertz_force - peak.force;
        let lowered_by = if difference > 0.0 { difference } else { 0.0 };
        let root = cbrt(lowered_by / stiffness);
        // rounded up by a few units in the last place: the difference of two large numbers must not become a tension there
        let residual = root * root * (1.0 + 4.0 * f64::EPSILON);
        if residual >= peak.indentation {
            return hertzian(peak, 0.0);
        }
        Segment {
            lower: residual,
            upper: peak.indentation,
            constant: 0.0 - lowered_by,
            power: stiffness,
            ..Segment::NOTHING
        }
    }
}
