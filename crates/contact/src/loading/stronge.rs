//! Stronge: a mean pressure that grows with the logarithm of the indentation until the contact is fully plastic.

use super::{Loading, constant_pressure, first_above, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{exp, log, sqrt};

/// The loading curve of Stronge, with `x = d/d_y`, `f = F/F_y`, `u = 2x - 1`, `c = 1/(3 p_Y)`:
///
/// | regime | where | `f` |
/// |---|---|---|
/// | elastic (Hertz) | `x < 1` | `x^1.5` |
/// | elastoplastic | `1 <= x < x_p` | `u (1 + c ln u)` |
/// | fully plastic | `x_p <= x` | `(p_P/p_Y) u` |
///
/// `p_Y = 1.1` and `p_P = 2.8` are the mean pressures over the yield strength. Beyond yield, `a^2 = R d_y u`.
/// `x_p = (1 + exp(3 (p_P - p_Y)))/2 = 82.511` follows from the pressures, so the force is continuous; the published value of
/// 84 would leave a jump of 0.2 %.
///
/// **Not passive.** The slope jumps from 1.5 up to 2.606 at yield (and falls from 5.697 to 5.091 at `x_p`), and the curve is
/// above Hertz's for `1 < x < 15.4`. With the recovery from the contact radius, an impact of up to 7.95 yield speeds returns
/// more energy than was put in (restitution up to 1.154), and the residual indentation is negative up to about 5 d_y. The law
/// is implemented as published, for comparison. [`BigAlabo`](super::BigAlabo) has the same limit far beyond yield.
///
/// Reference: W. J. Stronge, *Impact Mechanics*, Cambridge 2000, section 6.3.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Stronge {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
    /// Mean pressure in the fully plastic regime over the yield strength.
    pub plastic_pressure_factor: f64,
}

impl Stronge {
    /// The constants as published: 1.1 S and 2.8 S.
    pub const REFERENCE: Stronge = Stronge { yield_pressure_factor: 1.1, plastic_pressure_factor: 2.8 };

    /// `x_p`: the point where the mean pressure `p_Y + ln(u)/3` reaches `p_P`.
    fn fully_plastic(&self) -> f64 {
        0.5 * (1.0 + exp(3.0 * (self.plastic_pressure_factor - self.yield_pressure_factor)))
    }

    /// `c`.
    fn logarithmic_slope(&self) -> f64 {
        1.0 / (3.0 * self.yield_pressure_factor)
    }

    /// The line beyond `plastic` \[m\].
    fn line(&self, point: &YieldPoint, plastic: f64) -> Segment {
        let ratio = self.plastic_pressure_factor / self.yield_pressure_factor;
        constant_pressure(point, ratio, plastic, LARGEST_INDENTATION)
    }
}

impl Loading for Stronge {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.yield_pressure_factor)
    }

    /// On the elastoplastic part, the tangent with the slope `2 (1 + c + c ln u)` \[F_y/d_y\].
    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let point = self.yield_point(pair);
        if indentation < point.indentation {
            return hertz::segment(pair, point.indentation);
        }
        let plastic = self.fully_plastic() * point.indentation;
        if indentation >= plastic {
            return self.line(&point, plastic);
        }
        let u = 2.0 * (indentation / point.indentation) - 1.0;
        let slope = self.logarithmic_slope();
        let logarithm = slope * log(u);
        let stiffness = 2.0 * (1.0 + slope + logarithm) * (point.force / point.indentation);
        Segment::tangent(indentation, u * (1.0 + logarithm) * point.force, stiffness)
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        first_above(indentation, [d_y, self.fully_plastic() * d_y])
    }

    /// In `F_y d_y`: `0.4 x^2.5`, then `0.4 + ((u^2 - 1) + c (u^2 ln u - (u^2 - 1)/2))/4`, then the work of a line.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let point = self.yield_point(pair);
        let d_y = point.indentation;
        let elastic = hertz::segment(pair, d_y);
        if indentation <= d_y {
            return elastic.work(indentation);
        }
        let plastic = self.fully_plastic() * d_y;
        let end = if indentation < plastic { indentation } else { plastic };
        let u = 2.0 * (end / d_y) - 1.0;
        // u^2 - 1
        let square = 4.0 * ((end - d_y) / d_y) * (end / d_y);
        let elastoplastic = 0.25 * (square + self.logarithmic_slope() * (u * u * log(u) - 0.5 * square));
        let work = elastic.work(d_y) + elastoplastic * (point.force * d_y);
        if indentation < plastic { work } else { work + self.line(&point, plastic).work(indentation) }
    }

    /// `a^2 = R d` up to yield, `R (2d - d_y)` beyond.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        let beyond = indentation - d_y;
        sqrt(pair.radius * if beyond > 0.0 { indentation + beyond } else { indentation })
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let d_y = self.yield_point(pair).indentation;
        if indentation < d_y {
            Regime::Elastic
        } else if indentation < self.fully_plastic() * d_y {
            Regime::ElastoplasticFirst
        } else {
            Regime::FullyPlastic
        }
    }

    fn derived(&self, name: &str) -> Option<f64> {
        match name {
            "fully_plastic" => Some(self.fully_plastic()),
            _ => None,
        }
    }
}
