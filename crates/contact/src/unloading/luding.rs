//! A straight unloading line whose stiffness grows with the largest indentation, up to a limit.

use super::{Peak, Unloading, straight};
use crate::loading::Luding as LoadingLaw;
use crate::material::Pair;
use crate::segment::Segment;

/// `F = k_2(d_m) (d - d_f)`, with `k_1 = F_m/d_m` and the limit `d*` of [the loading law](LoadingLaw):
///
/// | largest indentation | stiffness | `d_f` |
/// |---|---|---|
/// | `d_m < d*` | `k_2(d_m) = k_1 + (k_2 - k_1) d_m/d*` | `d_m (1 - k_1/k_2(d_m))` |
/// | `d* <= d_m` | `k_2` | `2 R phi` |
///
/// The restitution is `sqrt(k_1/k_2(d_m))` below `d*`: 1 for the softest touch, falling with the speed. Stiffness and dent are
/// continuous at `d*`. The law must be combined with the loading law of the same name and the same `k_2/k_1` and `phi`. The
/// force never pulls: the cohesive branch of the original is omitted.
///
/// Reference: S. Luding, *Granular Matter* 10 (2008) 235-246, section 2.3, with `k_c = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Luding {
    /// `k_2/k_1` > 1 at the limit and beyond \[-\].
    pub stiffness_ratio: f64,
    /// `phi`: depth of the deepest dent over the diameter `2R` \[-\].
    pub limit_depth: f64,
}

impl Luding {
    /// The constants of the loading law.
    pub const REFERENCE: Luding = Luding {
        stiffness_ratio: LoadingLaw::REFERENCE.stiffness_ratio,
        limit_depth: LoadingLaw::REFERENCE.limit_depth,
    };
}

impl Unloading for Luding {
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let limit = LoadingLaw::limit(pair, self.stiffness_ratio, self.limit_depth);
        let residual = if peak.indentation < limit {
            // k_2(d_m)/k_1 - 1
            let excess = (self.stiffness_ratio - 1.0) * (peak.indentation / limit);
            peak.indentation * (excess / (1.0 + excess))
        } else {
            self.limit_depth * (2.0 * pair.radius)
        };
        straight(peak, residual)
    }
}
