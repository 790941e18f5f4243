//! Yigit and Christoforou: Hertz's law, continued by its tangent at yield.

use super::thornton::line;
use super::{Loading, hertz, work_over_segments};
use crate::material::{Pair, YieldPoint};
use crate::regime::Regime;
use crate::segment::Segment;
use libm::sqrt;

/// The loading curve of Yigit and Christoforou, with `x = d/d_y`, `f = F/F_y`:
///
/// | regime | where | `f` |
/// |---|---|---|
/// | elastic (Hertz) | `x < 1` | `x^1.5` |
/// | elastoplastic | `1 <= x` | `1 + 1.5 (x - 1)` |
///
/// In SI units, the line is `F = F_y + K_y (d - d_y)` with `K_y = 1.5 K_h sqrt(d_y)`. Force and slope are continuous at yield.
/// It is the line of [`Thornton`](super::Thornton) from another yield point, `d_y = 0.68 pi^2 R (S/E*)^2`. The law is passive,
/// and the restitution falls monotonically. There is no stiffening in the fully plastic regime (300 F_y at 200 d_y, where other
/// laws give about 1000).
///
/// In the paper, unloading follows Hertz's curve, lowered: [`HertzShift`](crate::unloading::HertzShift). That law
/// needs no contact radius. `a^2 = R d` is this project's choice; with it the closures `contact-radius` and `thornton` are
/// identical.
///
/// Reference: A. S. Yigit, A. P. Christoforou, *Composites Engineering* 4 (1994) 1143-1152.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct YigitChristoforou {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
}

impl YigitChristoforou {
    /// Mean pressure of 1.1 S at yield: the "0.68 pi^2" of the paper is `(3 pi 1.1/4)^2 = 0.680625 pi^2`.
    pub const REFERENCE: YigitChristoforou = YigitChristoforou { yield_pressure_factor: 1.1 };
}

impl Loading for YigitChristoforou {
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.yield_pressure_factor)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let point = self.yield_point(pair);
        if indentation < point.indentation { hertz::segment(pair, point.indentation) } else { line(pair, &point) }
    }

    /// In `F_y d_y`: `0.4 x^2.5`, then `0.4 + (x-1) + 0.75 (x-1)^2`.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        work_over_segments(self, pair, indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        if indentation < self.yield_point(pair).indentation { Regime::Elastic } else { Regime::ElastoplasticFirst }
    }
}
