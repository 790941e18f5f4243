//! Recovery of a sphere whose radius of curvature the load has changed.

use super::{Peak, Unloading, hertzian};
use crate::material::Pair;
use crate::segment::Segment;
use core::f64::consts::PI;
use libm::{cbrt, sqrt};

/// `d_e = (3 F_m / (4 E* sqrt(R_d)))^(2/3)` with `R_d = (4 E* / (3 F_m)) ((2 F_m + F_y) / (2 pi p_y))^1.5`.
///
/// `R_d` is Thornton's radius of the deformed surface for a limiting pressure `p_y`. It is exact only on his own loading line.
/// With another loading law and `p_y = 1.6 S`, the recovery jumps at yield (to a dent of 0.0153 d_y with
/// [`BigAlabo`](crate::loading::BigAlabo)); the force is continuous.
///
/// Reference: C. Thornton, Z. Ning, *Powder Technology* 99 (1998) 154-162; used by A. Big-Alabo, P. Harrison,
/// M. P. Cartmell, *Computers & Structures* 151 (2015) 20-29.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct DeformedRadius {
    /// Limiting pressure `p_y` over the yield strength \[-\].
    pub pressure_factor: f64,
}

impl DeformedRadius {
    /// `p_y = 1.6 S`.
    pub const REFERENCE: DeformedRadius = DeformedRadius { pressure_factor: 1.6 };
}

impl Unloading for DeformedRadius {
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let pressure = self.pressure_factor * pair.yield_strength;
        let square = (2.0 * peak.force + peak.yield_force) / (2.0 * PI * pressure);
        let hertzian_cube = 0.75 * peak.force / pair.modulus;
        let radius = square * sqrt(square) / hertzian_cube;
        let root = cbrt(hertzian_cube / sqrt(radius));
        hertzian(peak, root * root)
    }
}
