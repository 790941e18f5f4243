//! Johnson: a plastic zone that grows like an expanding cavity, from Hertz's law to full plasticity.

use super::{Loading, constant_pressure, first_above, hertz};
use crate::contact::history::{LARGEST_INDENTATION, Regime};
use crate::contact::material::{Pair, YieldPoint};
use crate::contact::segment::Segment;
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
/// Johnson's are yield at 1.1 S, the pressure of the expanding cavity (an incompressible core under the sphere), and full
/// plasticity at about 3 S on an area `a^2 = 2 R d`, without pile-up. He joins them for pressure against `z` only. This
/// project's are the other two: the geometry `a^2 = R d_y u`, which continues Hertz's `R d` at yield and tends to `2 R d`; and
/// the plateau at 1.1 S, from `z = 2.59` up to 5.75 (`x = 2.96`), where the formula of the cavity is still below 1.1 S. The
/// borders 4.916 and 806.3 follow from the pressures. The formula reaches 2.8 S at `z = 73.6` only (`x = 403.7`; 3.0 S at
/// `z = 99.3`), where the book says that full plasticity begins at 30 to 40.
///
/// Force, work and contact radius are continuous. The slope jumps from 1.5 up to 2 at yield and from 2 up to 2.606 where the
/// plateau ends, and falls from 5.697 to 5.091 at the last border.
///
/// **Not passive.** On the plateau the curve is above Hertz's, for `1 < x < 2.618`. With the recovery from the contact radius
/// a contact gives back more than was put in up to 1.59 yield speeds (restitution up to 1.0178). Far beyond yield
/// restitution tends to Johnson's limit `3.59 (S/E*)^(1/2) (m v^2/(2 S R^3))^(-1/8)` (3.74 for a pressure of 3.0 S).
///
/// Reference: K. L. Johnson, *Contact Mechanics*, Cambridge 1985, sections 6.3 and 11.5.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "exporter", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Johnson {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
    /// Mean pressure in the fully plastic regime over the yield strength.
    pub plastic_pressure_factor: f64,
}

impl Johnson {
    /// Yield at 1.1 S; full plasticity at 2.8 S as in the other laws. Johnson's formula for restitution has 3.0.
    pub const REFERENCE: Johnson = Johnson { yield_pressure_factor: 1.1, plastic_pressure_factor: 2.8 };

    /// `u` where the pressure of the cavity reaches `factor` yield strengths: `z = 3 exp(1.5 factor - 1)`, and
    /// `z = (3 pi/4) p_Y sqrt(u)`. Above 1 for the pressure at yield, whatever it is.
    fn cavity_border(&self, factor: f64) -> f64 {
        let root = 4.0 / (PI * self.yield_pressure_factor) * exp(1.5 * factor - 1.0);
        root * root
    }

    /// `u` where the second elastoplastic region and the fully plastic regime begin.
    fn borders(&self) -> (f64, f64) {
        (self.cavity_border(self.yield_pressure_factor), self.cavity_border(self.plastic_pressure_factor))
    }

    /// The indentations of those borders \[m\].
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

    /// In the second region the tangent, with the slope `2 (1 + (1 + ln(u/u_2))/(3 p_Y))` \[F_y/d_y\].
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

    /// In `F_y d_y`: `0.4 x^2.5`, a line's, then with `q = f/u` from the border `u_2` on
    /// `(u^2 (q - c/2) - u_2^2 (1 - c/2))/4` with `c = 1/(3 p_Y)`, a line's.
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

    /// `a^2 = R d`, beyond yield `R (2d - d_y)`.
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
