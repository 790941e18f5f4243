//! Recovery of the sphere with its original radius.

use super::{Peak, Unloading, hertzian};
use crate::material::Pair;
use crate::segment::Segment;
use libm::cbrt;

/// `d_e = (F_m / K_h)^(2/3)`: Hertz's law with the undeformed radius, shifted to the residual indentation.
///
/// Simple and widely used. At high speed, its restitution falls as `v^(-1/6)` instead of Johnson's `v^(-1/4)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct OriginalRadius;

impl Unloading for OriginalRadius {
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let root = cbrt(peak.force / pair.hertz_stiffness());
        hertzian(peak, root * root)
    }
}
