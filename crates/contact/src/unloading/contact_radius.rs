//! Recovery from the contact radius at the largest load.

use super::{Peak, Unloading, hertzian};
use crate::material::Pair;
use crate::segment::Segment;

/// `d_e = 3 F_m / (4 E* a_m)`: the dent recovers like a Hertz contact with the same force and contact radius.
///
/// The equivalent radius of curvature during unloading is `4 E* a_m^3 / (3 F_m)`. The contact radius is continuous at the peak,
/// and the recovery at yield.
///
/// Reference: K. L. Johnson, *Contact Mechanics*, 1985, section 6.4(b).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct ContactRadius;

impl Unloading for ContactRadius {
    #[inline(always)]
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        hertzian(peak, 0.75 * peak.force / (pair.modulus * peak.contact_radius))
    }
}
