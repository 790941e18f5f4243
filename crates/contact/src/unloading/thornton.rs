//! Recovery from the ratio of the force to Hertz's force.

use super::{Peak, Unloading, hertzian};
use crate::material::Pair;
use crate::segment::Segment;
use libm::sqrt;

/// `d_e = d_m F_m / (K_h d_m^1.5)`: the recovery of [`super::ContactRadius`] for a contact radius of `sqrt(R d_m)`.
///
/// Reference: C. Thornton, *J. Appl. Mech.* 64 (1997) 383-386; M. R. W. Brake, *Int. J. Solids Struct.* 49 (2012) 3129-3141,
/// uses the same closure.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Thornton;

impl Unloading for Thornton {
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        hertzian(peak, peak.force / (pair.hertz_stiffness() * sqrt(peak.indentation)))
    }
}
