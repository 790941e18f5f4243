//! A straight unloading line, stiffer than the loading.

use super::{Peak, Unloading, straight};
use crate::material::Pair;
use crate::segment::Segment;

/// `F = k_2 (d - d_f)` with `d_f = d_m (1 - k_1/k_2)`, where `k_1 = F_m/d_m` is the secant at the largest load.
///
/// On the loading line of Walton and Braun, `k_1` is the stiffness of that line and `k_2` is a constant. The restitution is
/// then `sqrt(k_1/k_2)` at any speed. With another loading law, `k_2` is proportional to the secant, and the dent jumps from
/// zero to `d_y (1 - k_1/k_2)` at yield; the force is continuous.
///
/// Reference: O. R. Walton, R. L. Braun, *J. Rheology* 30 (1986) 949-980.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct WaltonBraun {
    /// `k_2/k_1` > 1 \[-\].
    pub stiffness_ratio: f64,
}

impl WaltonBraun {
    /// `k_2 = 4 k_1`, which gives a restitution of 0.5. This project chose the value; the original leaves it to the user.
    pub const REFERENCE: WaltonBraun = WaltonBraun { stiffness_ratio: 4.0 };
}

impl Unloading for WaltonBraun {
    fn path(&self, _pair: &Pair, peak: &Peak) -> Segment {
        straight(peak, peak.indentation * (1.0 - 1.0 / self.stiffness_ratio))
    }
}
