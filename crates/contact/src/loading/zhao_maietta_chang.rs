//! Zhao, Maietta and Chang: contact area and mean pressure, each with a smooth transition from elastic to fully plastic.

use super::{Loading, first_above, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{log, sqrt};

/// The loading curve of Zhao, Maietta and Chang, with `x = d/d_y`, `f = F/F_y`, `h = (x - 1)/(x_p - 1)`:
///
/// | regime | where | `f` | `a^2` |
/// |---|---|---|---|
/// | elastic (Hertz) | `x < 1` | `x^1.5` | `R d` |
/// | elastoplastic | `1 <= x < x_p` | `x (1 + 3h^2 - 2h^3) (1 + b ln x)` | `R d (1 + 3h^2 - 2h^3)` |
/// | fully plastic | `x_p <= x` | `(2/k) x` | `2 R d` |
///
/// `x_p = 54`; `k = 1.1/2.8` is the mean pressure at yield over the hardness, and `b = (1 - k)/(k ln x_p)`. The mean pressure
/// grows with `ln x` from 1.1 S to 2.8 S, and the area along a cubic from Hertz's to that of a blunt indenter. Force and
/// contact radius are continuous; the slope falls from 1.5 to 1.387 at yield and from 5.866 to 5.091 at `x_p`. The law is
/// passive. With the recovery from the contact radius, the restitution is not monotone between 32 and 69 yield speeds.
///
/// Derived for the asperities of rough surfaces. The paper uses `k = 0.4`.
///
/// Reference: Y. Zhao, D. M. Maietta, L. Chang, *J. Tribology* 122 (2000) 86-93.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct ZhaoMaiettaChang {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
    /// Mean pressure in the fully plastic regime (the hardness) over the yield strength \[-\].
    pub plastic_pressure_factor: f64,
    /// `x_p`: start of the fully plastic regime, in yield indentations.
    pub fully_plastic: f64,
}

impl ZhaoMaiettaChang {
    /// Pressures of 1.1 S and 2.8 S as in the other laws; 54 as published.
    pub const REFERENCE: ZhaoMaiettaChang =
        ZhaoMaiettaChang { yield_pressure_factor: 1.1, plastic_pressure_factor: 2.8, fully_plastic: 54.0 };

    /// `b`.
    fn logarithmic_slope(&self) -> f64 {
        (self.plastic_pressure_factor / self.yield_pressure_factor - 1.0) / log(self.fully_plastic)
    }

    /// `g = 1 + 3h^2 - 2h^3` at `x` on the elastoplastic part, and `dg/dx`.
    fn area_ratio(&self, x: f64) -> (f64, f64) {
        let length = self.fully_plastic - 1.0;
        let h = (x - 1.0) / length;
        (1.0 + h * h * (3.0 - 2.0 * h), 6.0 * h * (1.0 - h) / length)
    }

    /// Integral of `x g (1 + b ln x)` from 1 to `x`, with `g` as a polynomial in `x`.
    fn elastoplastic_work(&self, x: f64) -> f64 {
        let length = self.fully_plastic - 1.0;
        let (square, cube) = (3.0 / (length * length), 2.0 / (length * length * length));
        let coefficients = [1.0 + square + cube, -2.0 * square - 3.0 * cube, square + 3.0 * cube, -cube];
        let slope = self.logarithmic_slope();
        let logarithm = log(x);
        let (mut integral, mut power, mut exponent) = (0.0, x * x, 2.0);
        for coefficient in coefficients {
            // of x^n (1 + b ln x) with n = exponent - 1; at 1 it is (1 - b/exponent)/exponent
            let at_yield = 1.0 - slope / exponent;
            integral += coefficient * (power * (at_yield + slope * logarithm) - at_yield) / exponent;
            power *= x;
            exponent += 1.0;
        }
        integral
    }

    /// The line beyond `plastic` \[m\].
    fn line(&self, point: &YieldPoint, plastic: f64) -> Segment {
        let ratio = 2.0 * self.plastic_pressure_factor / self.yield_pressure_factor;
        Segment {
            lower: plastic,
            upper: LARGEST_INDENTATION,
            origin: plastic,
            constant: ratio * self.fully_plastic * point.force,
            linear: ratio * (point.force / point.indentation),
            ..Segment::NOTHING
        }
    }
}

impl Loading for ZhaoMaiettaChang {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.yield_pressure_factor)
    }

    /// On the elastoplastic part, the tangent with the slope `(g + x dg/dx) (1 + b ln x) + b g` \[F_y/d_y\].
    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let point = self.yield_point(pair);
        if indentation < point.indentation {
            return hertz::segment(pair, point.indentation);
        }
        let plastic = self.fully_plastic * point.indentation;
        if indentation >= plastic {
            return self.line(&point, plastic);
        }
        let x = indentation / point.indentation;
        let (ratio, ratio_slope) = self.area_ratio(x);
        let slope = self.logarithmic_slope();
        let pressure = 1.0 + slope * log(x);
        let stiffness = (ratio + x * ratio_slope) * pressure + slope * ratio;
        Segment::tangent(indentation, x * ratio * pressure * point.force, stiffness * (point.force / point.indentation))
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        first_above(indentation, [d_y, self.fully_plastic * d_y])
    }

    /// In `F_y d_y`: `0.4 x^2.5`, then powers of `x` up to the fifth, each with `1 + b ln x - b/n`, then the work of a line.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let point = self.yield_point(pair);
        let d_y = point.indentation;
        let elastic = hertz::segment(pair, d_y);
        if indentation <= d_y {
            return elastic.work(indentation);
        }
        let unit = point.force * d_y;
        let plastic = self.fully_plastic * d_y;
        if indentation < plastic {
            return elastic.work(d_y) + self.elastoplastic_work(indentation / d_y) * unit;
        }
        let line = self.line(&point, plastic).work(indentation);
        elastic.work(d_y) + self.elastoplastic_work(self.fully_plastic) * unit + line
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        let ratio = if indentation <= d_y {
            1.0
        } else if indentation < self.fully_plastic * d_y {
            self.area_ratio(indentation / d_y).0
        } else {
            2.0
        };
        sqrt(pair.radius * indentation * ratio)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let d_y = self.yield_point(pair).indentation;
        if indentation < d_y {
            Regime::Elastic
        } else if indentation < self.fully_plastic * d_y {
            Regime::ElastoplasticFirst
        } else {
            Regime::FullyPlastic
        }
    }

    fn derived(&self, name: &str) -> Option<f64> {
        match name {
            "logarithmic_slope" => Some(self.logarithmic_slope()),
            _ => None,
        }
    }
}
