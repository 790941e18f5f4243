//! Thornton: Hertz's law, then a line along which the contact pressure is limited.

use super::{Loading, hertz, work_over_segments};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::sqrt;

/// The loading curve of Thornton, with `x = d/d_y`, `f = F/F_y`:
///
/// | regime | where | `f` |
/// |---|---|---|
/// | elastic (Hertz) | `x < 1` | `x^1.5` |
/// | fully plastic | `1 <= x` | `1 + 1.5 (x - 1)` |
///
/// In SI units, the line is `F = F_y + pi R p_y (d - d_y)`; `a^2 = R d` on both parts. Force and slope are continuous at yield.
/// The law is passive with its own closure, [`Thornton`](crate::unloading::Thornton). The restitution falls
/// monotonically; far beyond yield it is `e = 1.185 (v_y/v)^(1/4)`.
///
/// No pressure in the contact exceeds `p_y`. With `p_y = 1.6 S` the force is far too low at large indentations (290 F_y at 200
/// d_y, where other laws give about 1000), and users raise `p_y` up to 2.8 S to compensate. Without adhesion.
///
/// Reference: C. Thornton, *J. Appl. Mech.* 64 (1997) 383-386; C. Thornton, Z. Ning, *Powder Technology* 99 (1998) 154-162.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Thornton {
    /// Limiting contact pressure `p_y` over the yield strength \[-\]. It is the peak of Hertz's pressure at yield.
    pub peak_pressure_factor: f64,
}

impl Thornton {
    /// `p_y = 1.6 S`.
    pub const REFERENCE: Thornton = Thornton { peak_pressure_factor: 1.6 };
}

/// The line that continues Hertz's curve at `point` with the same slope, `1.5 K_h sqrt(d_y) = pi R p_y`.
pub(super) fn line(pair: &Pair, point: &YieldPoint) -> Segment {
    Segment {
        lower: point.indentation,
        upper: LARGEST_INDENTATION,
        origin: point.indentation,
        constant: point.force,
        linear: 1.5 * pair.hertz_stiffness() * sqrt(point.indentation),
        ..Segment::NOTHING
    }
}

impl Loading for Thornton {
    /// The peak of Hertz's pressure is 1.5 times its mean.
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.peak_pressure_factor / 1.5)
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
        if indentation < self.yield_point(pair).indentation { Regime::Elastic } else { Regime::FullyPlastic }
    }
}
