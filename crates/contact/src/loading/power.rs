//! A power of the indentation beyond yield, for constants fitted by the user.

use super::{Loading, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{pow, sqrt};

/// A free power law, with `x = d/d_y`, `f = F/F_y`:
///
/// | regime | where | `f` |
/// |---|---|---|
/// | elastic (Hertz) | `x < 1` | `x^1.5` |
/// | elastoplastic | `1 <= x` | `1 + k (x - 1)^n` |
///
/// In SI units, `F = F_y + k F_y ((d - d_y)/d_y)^n`. The constants are fitted to a finite-element model or a test. `a^2 = R d`
/// is this project's choice. The force is continuous at yield. The slope drops to zero there for `n > 1`, and is `k` for
/// `n = 1`; `n < 1` is not allowed, because the slope would be infinite. The law is finite up to the largest indentation for
/// `n` up to 1.8.
///
/// Not every pair of `k` and `n` is passive: the curve must stay below Hertz's.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Power {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
    /// `k`: force in excess of the yield force at twice the yield indentation \[F_y\].
    pub coefficient: f64,
    /// `n` >= 1 \[-\].
    pub exponent: f64,
}

impl Power {
    /// Yield at a mean pressure of 1.6 S, the onset that such laws use in the literature. `k = 1.5` and `n = 1.2` are
    /// placeholders that keep the curve below Hertz's; they describe no material.
    pub const REFERENCE: Power = Power { yield_pressure_factor: 1.6, coefficient: 1.5, exponent: 1.2 };
}

impl Loading for Power {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.yield_pressure_factor)
    }

    /// Beyond yield, the tangent with the slope `k n (x - 1)^(n-1)` \[F_y/d_y\].
    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let point = self.yield_point(pair);
        if indentation < point.indentation {
            return hertz::segment(pair, point.indentation);
        }
        let beyond = (indentation - point.indentation) / point.indentation;
        let slope = self.coefficient * pow(beyond, self.exponent - 1.0);
        let stiffness = self.exponent * slope * (point.force / point.indentation);
        Segment::tangent(indentation, (1.0 + slope * beyond) * point.force, stiffness)
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        if indentation < d_y { d_y } else { LARGEST_INDENTATION }
    }

    /// In `F_y d_y`: `0.4 x^2.5`, then `0.4 + (x-1) + k (x-1)^(n+1)/(n+1)`.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let point = self.yield_point(pair);
        let d_y = point.indentation;
        let elastic = hertz::segment(pair, d_y);
        if indentation <= d_y {
            return elastic.work(indentation);
        }
        let beyond = (indentation - d_y) / d_y;
        let mean_force = 1.0 + self.coefficient * pow(beyond, self.exponent) / (self.exponent + 1.0);
        elastic.work(d_y) + beyond * mean_force * (point.force * d_y)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        if indentation < self.yield_point(pair).indentation { Regime::Elastic } else { Regime::ElastoplasticFirst }
    }
}
