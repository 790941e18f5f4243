//! Hertz: the elastic contact of two spheres.

use super::Loading;
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::sqrt;

/// Elastic contact at any load: `F = K_h d^1.5`, `K_h = (4/3) E* sqrt(R)`, `a^2 = R d`, `W = (2/5) K_h d^2.5`.
///
/// Holds without friction and below the yield point, while the contact radius is small compared with `R`.
///
/// Reference: H. Hertz, *J. reine angew. Math.* 92 (1882) 156; K. L. Johnson, *Contact Mechanics*, 1985, section 4.2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Hertz;

/// The exponent of Hertz's law \[-\].
pub(crate) const EXPONENT: f64 = 1.5;

/// The Hertzian part, up to `upper` \[m\], of any law that begins elastically.
pub(super) fn segment(pair: &Pair, upper: f64) -> Segment {
    Segment { upper, power: pair.hertz_stiffness(), ..Segment::NOTHING }
}

impl Loading for Hertz {
    fn can_yield(&self) -> bool {
        false
    }

    fn yield_point(&self, _pair: &Pair) -> YieldPoint {
        YieldPoint { indentation: f64::INFINITY, force: f64::INFINITY }
    }

    fn segment(&self, pair: &Pair, _indentation: f64) -> Segment {
        segment(pair, LARGEST_INDENTATION)
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        segment(pair, LARGEST_INDENTATION).work(indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, _pair: &Pair, _indentation: f64) -> Regime {
        Regime::Elastic
    }
}
