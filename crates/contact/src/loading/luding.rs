//! Luding: a spring whose unloading stiffness grows with the depth, up to a limit beyond which it is elastic again.

use super::{Loading, WaltonBraun, first_above, work_over_segments};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::sqrt;

/// The loading curve of Luding without cohesion:
///
/// | regime | where | `F` |
/// |---|---|---|
/// | elastoplastic | `d < d*` | `k_1 d` |
/// | limit | `d* <= d` | `k_1 d* + k_2 (d - d*)` |
///
/// With `d* = k_2/(k_2 - k_1) phi 2R`, the deepest dent is `phi 2R`. Beyond `d*` there is no further yielding: unloading
/// follows the same line. The regime there is the second elastoplastic region, because the energy lost below `d*` stays lost.
/// `k_1` and `a^2 = R d`, this project's choice, are those of [`WaltonBraun`]. There is no elastic part. The force is
/// continuous; the slope jumps up from `k_1` to `k_2` at `d*`. The law is passive with the unloading law of the same name, and
/// must be combined with it.
///
/// Reference: S. Luding, *Granular Matter* 10 (2008) 235-246, section 2.3, with `k_c = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Luding {
    /// Mean pressure over the yield strength at which Hertz's secant is taken \[-\].
    pub yield_pressure_factor: f64,
    /// `k_1` over that secant \[-\].
    pub stiffness_factor: f64,
    /// `k_2/k_1` > 1 \[-\].
    pub stiffness_ratio: f64,
    /// `phi`: depth of the deepest dent over the diameter `2R` \[-\].
    pub limit_depth: f64,
}

impl Luding {
    /// `k_1` as for [`WaltonBraun`] and `k_2 = 4 k_1` are this project's choice; the original leaves them to the user.
    /// `phi = 0.05` is the example of the paper.
    pub const REFERENCE: Luding =
        Luding { yield_pressure_factor: 1.1, stiffness_factor: 1.0, stiffness_ratio: 4.0, limit_depth: 0.05 };

    /// `d*` \[m\] for these constants.
    pub fn limit(pair: &Pair, stiffness_ratio: f64, limit_depth: f64) -> f64 {
        stiffness_ratio / (stiffness_ratio - 1.0) * (limit_depth * (2.0 * pair.radius))
    }
}

impl Loading for Luding {
    fn yield_point(&self, _pair: &Pair) -> YieldPoint {
        YieldPoint { indentation: 0.0, force: 0.0 }
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let Luding { yield_pressure_factor, stiffness_factor, .. } = *self;
        let soft = WaltonBraun { yield_pressure_factor, stiffness_factor }.segment(pair, indentation);
        let limit = Luding::limit(pair, self.stiffness_ratio, self.limit_depth);
        if indentation < limit {
            return Segment { upper: limit, ..soft };
        }
        Segment {
            lower: limit,
            upper: LARGEST_INDENTATION,
            origin: limit,
            constant: soft.linear * limit,
            linear: self.stiffness_ratio * soft.linear,
            ..Segment::NOTHING
        }
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        first_above(indentation, [Luding::limit(pair, self.stiffness_ratio, self.limit_depth)])
    }

    /// `W = k_1 d^2/2`, then the work of a line.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        work_over_segments(self, pair, indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let limit = Luding::limit(pair, self.stiffness_ratio, self.limit_depth);
        if indentation < limit { Regime::ElastoplasticFirst } else { Regime::ElastoplasticSecond }
    }
}
