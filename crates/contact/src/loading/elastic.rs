//! Elastic contacts with another power than Hertz's: the springs of [rate-dependent laws](crate::damped).

use super::{Loading, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{pow, sqrt};

/// Elastic at any load: `F = F_1 (d/d_1)^n`, with any point `d_1`, `F_1` of the curve. `a^2 = R d` is this project's choice.
///
/// It is a segment for `n = 1` and `n = 1.5`, and has none for another exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Elastic {
    /// Force `F_1` \[N\] at the depth.
    pub force: f64,
    /// The depth `d_1` \[m\] > 0.
    pub depth: f64,
    /// Exponent `n` >= 1 \[-\].
    pub exponent: f64,
}

impl Elastic {
    /// Hertz's law for these bodies.
    pub fn hertz(pair: &Pair) -> Elastic {
        Elastic { force: pair.hertz_stiffness(), depth: 1.0, exponent: hertz::EXPONENT }
    }
}

impl Loading for Elastic {
    fn can_yield(&self) -> bool {
        false
    }

    fn yield_point(&self, _pair: &Pair) -> YieldPoint {
        YieldPoint { indentation: f64::INFINITY, force: f64::INFINITY }
    }

    fn segment(&self, _pair: &Pair, indentation: f64) -> Segment {
        let Elastic { force, depth, exponent } = *self;
        let whole = Segment { upper: LARGEST_INDENTATION, ..Segment::NOTHING };
        if exponent == hertz::EXPONENT {
            return Segment { power: force / (depth * sqrt(depth)), ..whole };
        }
        if exponent == 1.0 {
            return Segment { linear: force / depth, ..whole };
        }
        let depths = indentation / depth;
        let slope = pow(depths, exponent - 1.0);
        Segment::tangent(indentation, slope * depths * force, exponent * slope * (force / depth))
    }

    fn is_segmented(&self) -> bool {
        self.exponent == hertz::EXPONENT || self.exponent == 1.0
    }

    fn scale(&self, pair: &Pair) -> Segment {
        if self.is_segmented() {
            return self.segment(pair, 0.0);
        }
        Segment { upper: LARGEST_INDENTATION, power: self.force / pow(self.depth, self.exponent), ..Segment::NOTHING }
    }

    /// Of a spring that is linear, the power is none.
    fn elastic_exponent(&self) -> f64 {
        if self.is_segmented() { hertz::EXPONENT } else { self.exponent }
    }

    fn next_corner(&self, _pair: &Pair, _indentation: f64) -> f64 {
        LARGEST_INDENTATION
    }

    fn work(&self, _pair: &Pair, indentation: f64) -> f64 {
        self.force * pow(indentation / self.depth, self.exponent) * (indentation / (self.exponent + 1.0))
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, _pair: &Pair, _indentation: f64) -> Regime {
        Regime::Elastic
    }
}
