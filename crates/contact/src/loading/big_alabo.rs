//! Big-Alabo, Harrison and Cartmell: elastic, elastoplastic in two regions, fully plastic.

use super::{Loading, hertz, work_over_segments};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{log, sqrt};

/// The loading curve of Big-Alabo et al., with `x = d/d_y`, `f = F/F_y`:
///
/// | regime | where | `f` |
/// |---|---|---|
/// | elastic (Hertz) | `x < 1` | `x^1.5` |
/// | elastoplastic, first region | `1 <= x < x_tep` | `(x - 1)^1.5 + 1` |
/// | elastoplastic, second region | `x_tep <= x < x_p` | `k_l (x - x_tep) + f_tep` |
/// | fully plastic | `x_p <= x` | `k_p (x - x_p) + f_p` |
///
/// `k_l = 1.5 sqrt(x_tep - 1)`; `f_tep` and `f_p` follow from continuity. The force is continuous everywhere, and the slope at
/// `x_tep`. The slope drops from 1.5 to zero at yield and from 5.394 to 5.091 at `x_p`; both are properties of the published
/// curve.
///
/// Reference: A. Big-Alabo, P. Harrison, M. P. Cartmell, *Computers & Structures* 151 (2015) 20-29.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct BigAlabo {
    /// Mean pressure at yield over the yield strength.
    pub yield_pressure_factor: f64,
    /// Mean pressure in the fully plastic regime over the yield strength.
    pub plastic_pressure_factor: f64,
    /// `x_tep`: start of the second elastoplastic region, in yield indentations.
    pub second_region: f64,
    /// `x_p`: start of the fully plastic regime, in yield indentations.
    pub fully_plastic: f64,
    /// `k_p`: slope of the fully plastic regime \[F_y/d_y\].
    pub plastic_slope: f64,
}

/// The curve in multiples of `d_y` and `F_y`.
struct Normalised {
    second_force: f64,
    second_slope: f64,
    plastic_force: f64,
}

impl BigAlabo {
    /// The constants as published: pressures 1.1 S and 2.8 S, boundaries 13.93 and 82.5.
    ///
    /// `x_p = 82.5` is the point of full plasticity of Stronge (*Impact Mechanics*, 2000, section 6.3). At 13.93 (unrounded:
    /// 13.938), a line with continuous slope begins that meets Stronge's plastic line at `x_p`. The paper's introduction does
    /// not give `k_p`. It follows from a constant pressure of 2.8 S on an area `pi R d_y (2x - 1)`:
    /// `k_p = 2 * 2.8/1.1 = 5.0909`.
    pub const REFERENCE: BigAlabo = BigAlabo {
        yield_pressure_factor: 1.1,
        plastic_pressure_factor: 2.8,
        second_region: 13.93,
        fully_plastic: 82.5,
        plastic_slope: 2.0 * 2.8 / 1.1,
    };

    fn normalised(&self) -> Normalised {
        let from_yield = self.second_region - 1.0;
        let second_slope = 1.5 * sqrt(from_yield);
        let second_force = from_yield * sqrt(from_yield) + 1.0;
        let plastic_force = second_slope * (self.fully_plastic - self.second_region) + second_force;
        Normalised { second_force, second_slope, plastic_force }
    }
}

impl Loading for BigAlabo {
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.yield_pressure_factor)
    }

    #[inline(never)]
    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        self.branch(pair, &self.yield_point(pair), indentation).0
    }

    /// In `F_y d_y`: `0.4 x^2.5`, then `0.4 + (x-1) + 0.4 (x-1)^2.5`, then `w_tep + f_tep (x-x_tep) + k_l (x-x_tep)^2/2`, then
    /// `w_p + f_p (x-x_p) + k_p (x-x_p)^2/2`: the complete pieces below `indentation` plus the last, partial one.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        work_over_segments(self, pair, indentation)
    }

    /// `a^2 = F/(pi p_m)`, with the mean pressure `p_m/S = 1.1 sqrt(x)` up to yield and `min(1.1 + ln(2x-1)/3, 2.8)` beyond.
    /// Beyond yield, `a^2` is at least `R d_y`, so `a` is continuous and does not decrease.
    ///
    /// The paper's introduction gives no contact radius. The logarithm is the mean pressure of Stronge (*Impact Mechanics*,
    /// 2000, section 6.3), which is 1.1 S at yield and 2.8 S at `x_p`.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let point = self.yield_point(pair);
        let force = self.segment(pair, indentation).force(indentation);
        self.radius_at(pair, &point, indentation, force)
    }

    #[inline(never)]
    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        self.branch(pair, &self.yield_point(pair), indentation).1
    }

    #[inline]
    fn branch(&self, pair: &Pair, point: &YieldPoint, indentation: f64) -> (Segment, Regime) {
        let YieldPoint { indentation: d_y, force: f_y } = *point;
        if indentation < d_y {
            return (hertz::segment(pair, d_y), Regime::Elastic);
        }
        let (second, plastic) = (self.second_region * d_y, self.fully_plastic * d_y);
        if indentation < second {
            let power = pair.hertz_stiffness();
            let segment = Segment { lower: d_y, upper: second, origin: d_y, constant: f_y, power, ..Segment::NOTHING };
            return (segment, Regime::ElastoplasticFirst);
        }
        let Normalised { second_force, second_slope, plastic_force } = self.normalised();
        let slope_unit = f_y / d_y;
        // the two straight lines
        let (origin, upper, force, slope, regime) = if indentation < plastic {
            (second, plastic, second_force, second_slope, Regime::ElastoplasticSecond)
        } else {
            (plastic, LARGEST_INDENTATION, plastic_force, self.plastic_slope, Regime::FullyPlastic)
        };
        let (constant, linear) = (force * f_y, slope * slope_unit);
        (Segment { lower: origin, upper, origin, constant, linear, ..Segment::NOTHING }, regime)
    }

    #[inline]
    fn radius_at(&self, pair: &Pair, point: &YieldPoint, indentation: f64, force: f64) -> f64 {
        let d_y = point.indentation;
        if indentation <= d_y {
            return sqrt(pair.radius * indentation);
        }
        let logarithmic = self.yield_pressure_factor + log(2.0 * (indentation / d_y) - 1.0) / 3.0;
        let factor =
            if logarithmic < self.plastic_pressure_factor { logarithmic } else { self.plastic_pressure_factor };
        let area = force / (core::f64::consts::PI * factor * pair.yield_strength);
        let area_at_yield = pair.radius * d_y;
        sqrt(if area > area_at_yield { area } else { area_at_yield })
    }

    fn derived(&self, name: &str) -> Option<f64> {
        match name {
            "second_force" => Some(self.normalised().second_force),
            "second_slope" => Some(self.normalised().second_slope),
            "plastic_force" => Some(self.normalised().plastic_force),
            _ => None,
        }
    }
}
