//! Johnson: a plastic zone that grows like an expanding cavity, from Hertz's law to full plasticity.

use super::{Loading, constant_pressure, first_above, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use core::f64::consts::PI;
use libm::{exp, log, sqrt};

/// The loading curve of Johnson, with `x = d/d_y`, `f = F/F_y`, `u = 2x - 1`, `z = E* a/(S R)`:
///
/// | regime | where | mean pressure | `f` |
/// |---|---|---|---|
/// | elastic (Hertz) | `x < 1` | `1.1 sqrt(x) S` | `x^1.5` |
/// | elastoplastic, first region | `1 <= u < 4.916` | `1.1 S` | `u` |
/// | elastoplastic, second region | `4.916 <= u < 806.3` | `(2/3) (1 + ln(z/3)) S` | `u (1 + ln(u/4.916)/3.3)` |
/// | fully plastic | `806.3 <= u` | `2.8 S` | `(2.8/1.1) u` |
///
/// From Johnson come yield at 1.1 S, the pressure of the expanding cavity (an incompressible core under the sphere), and full
/// plasticity at about 3 S on an area `a^2 = 2 R d`, without pile-up. He connects them only as pressure against `z`. This
/// project chose two things. The first is the geometry `a^2 = R d_y u`, which continues Hertz's `R d` at yield and tends to
/// `2 R d`. The second is the plateau at 1.1 S from `z = 2.59` to 5.75 (`x = 2.96`), where the cavity formula is still below
/// 1.1 S. The boundaries 4.916 and 806.3 follow from the pressures. The formula reaches 2.8 S only at `z = 73.6`
/// (`x = 403.7`) and 3.0 S at `z = 99.3`; according to the book, full plasticity begins at 30 to 40.
///
/// Force, work and contact radius are continuous. The slope jumps from 1.5 up to 2 at yield and from 2 up to 2.606 at the end
/// of the plateau, and falls from 5.697 to 5.091 at the last boundary.
///
/// **Not passive.** On the plateau the curve is above Hertz's, for `1 < x < 2.618`. With the recovery from the contact radius,
/// an impact of up to 1.59 yield speeds returns more energy than was put in (restitution up to 1.0178). Far beyond yield the
/// restitution tends to Johnson's limit `3.59 (S/E*)^(1/2) (m v^2/(2 S R^3))^(-1/8)` (3.74 for a pressure of 3.0 S).
///
/// Reference: K. L. Johnson, *Contact Mechanics*, Cambridge 1985, sections 6.3 and 11.5.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Johnson {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
    /// Mean pressure in the fully plastic regime over the yield strength.
    pub plastic_pressure_factor: f64,
}

impl Johnson {
    /// Yield at 1.1 S; full plasticity at 2.8 S as in the other laws. Johnson's formula for the restitution uses 3.0.
    pub const REFERENCE: Johnson = Johnson { yield_pressure_factor: 1.1, plastic_pressure_factor: 2.8 };

    /// `u` where the cavity pressure reaches `factor` yield strengths, from `z = 3 exp(1.5 factor - 1)` and
    /// `z = (3 pi/4) p_Y sqrt(u)`. For the pressure at yield, `u` is always above 1.
    fn cavity_border(&self, factor: f64) -> f64 {
        let root = 4.0 / (PI * self.yield_pressure_factor) * exp(1.5 * factor - 1.0);
        root * root
    }

    /// `u` at the start of the second elastoplastic region and of the fully plastic regime.
    fn borders(&self) -> (f64, f64) {
        (self.cavity_border(self.yield_pressure_factor), self.cavity_border(self.plastic_pressure_factor))
    }

    /// The indentations at those boundaries \[m\].
    fn corners(&self, d_y: f64) -> (f64, f64) {
        let (second, plastic) = self.borders();
        (0.5 * (1.0 + second) * d_y, 0.5 * (1.0 + plastic) * d_y)
    }
}

impl Loading for Johnson {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.yield_pressure_factor)
    }

    /// In the second region, the tangent with the slope `2 (1 + (1 + ln(u/u_2))/(3 p_Y))` \[F_y/d_y\].
    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let point = self.yield_point(pair);
        let d_y = point.indentation;
        if indentation < d_y {
            return hertz::segment(pair, d_y);
        }
        let (second, plastic) = self.corners(d_y);
        if indentation < second {
            return constant_pressure(&point, 1.0, d_y, second);
        }
        if indentation >= plastic {
            let ratio = self.plastic_pressure_factor / self.yield_pressure_factor;
            return constant_pressure(&point, ratio, plastic, LARGEST_INDENTATION);
        }
        let u = 2.0 * (indentation / d_y) - 1.0;
        let rise = 1.0 / (3.0 * self.yield_pressure_factor);
        let pressure = 1.0 + rise * log(u / self.borders().0);
        Segment::tangent(indentation, u * pressure * point.force, 2.0 * (pressure + rise) * (point.force / d_y))
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        let (second, plastic) = self.corners(d_y);
        first_above(indentation, [d_y, second, plastic])
    }

    /// In `F_y d_y`: `0.4 x^2.5`; the work of a line; from the boundary `u_2` on, with `q = f/u` and `c = 1/(3 p_Y)`, `(u^2 (q
    /// - c/2) - u_2^2 (1 - c/2))/4`; the work of a line.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let point = self.yield_point(pair);
        let d_y = point.indentation;
        let elastic = hertz::segment(pair, d_y);
        if indentation <= d_y {
            return elastic.work(indentation);
        }
        let (second, plastic) = self.corners(d_y);
        let plateau = constant_pressure(&point, 1.0, d_y, second);
        if indentation <= second {
            return elastic.work(d_y) + plateau.work(indentation);
        }
        let end = if indentation < plastic { indentation } else { plastic };
        let u = 2.0 * (end / d_y) - 1.0;
        let border = self.borders().0;
        let rise = 1.0 / (3.0 * self.yield_pressure_factor);
        let cavity = u * u * (1.0 + rise * (log(u / border) - 0.5)) - border * border * (1.0 - 0.5 * rise);
        let work = elastic.work(d_y) + plateau.work(second) + 0.25 * cavity * (point.force * d_y);
        if indentation < plastic { work } else { work + self.segment(pair, plastic).work(indentation) }
    }

    /// `a^2 = R d` up to yield, `R (2d - d_y)` beyond.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        let beyond = indentation - d_y;
        sqrt(pair.radius * if beyond > 0.0 { indentation + beyond } else { indentation })
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let d_y = self.yield_point(pair).indentation;
        let (second, plastic) = self.corners(d_y);
        if indentation < d_y {
            Regime::Elastic
        } else if indentation < second {
            Regime::ElastoplasticFirst
        } else if indentation < plastic {
            Regime::ElastoplasticSecond
        } else {
            Regime::FullyPlastic
        }
    }

    fn derived(&self, name: &str) -> Option<f64> {
        match name {
            "second_region" => Some(self.borders().0),
            "fully_plastic" => Some(self.borders().1),
            _ => None,
        }
    }
}
