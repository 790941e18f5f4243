//! Ma and Liu: a logarithmic curve that connects Hertz's law and a plastic line with continuous slope.

use super::{Loading, first_above, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{log, sqrt};

/// The loading curve of Ma and Liu, with `x = d/d_y`, `f = F/F_y`:
///
/// | regime | where | `f` |
/// |---|---|---|
/// | elastic (Hertz) | `x < 1` | `x^1.5` |
/// | mixed | `1 <= x < X` | `1 + 1.5 (x - 1) + c (x ln x - x + 1)` |
/// | fully plastic | `X <= x` | `f_p + 1.5 q (x - X)` |
///
/// `q = 2 p_P/p_Y`, with the mean pressure `p_P = 2.85 S` of full plasticity and the peak pressure `p_Y = 1.61 S` of first
/// yield. `c = 1.5 (q - 1)/ln X` makes the slope continuous at `X`; it is also continuous at yield. The law is passive, and the
/// restitution falls monotonically.
///
/// The value of `X` in the paper is not known to this project. The reference value `exp(2 (q - 1))` is the smallest with which
/// the curve stays below Hertz's. The curvature is then continuous at yield too, and full plasticity begins at
/// `E* a/(S R) = 32`, within Johnson's range of 30 to 40. The paper's own unloading law and contact radius are not known
/// either. `a^2 = R d` is this project's choice; with it the closures `contact-radius` and `thornton` are identical.
///
/// Reference: D. Ma, C. S. Liu, *J. Appl. Mech.* 82 (2015) 121006.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct MaLiu {
    /// Peak pressure at yield over the yield strength.
    pub peak_pressure_factor: f64,
    /// Mean pressure in the fully plastic regime over the yield strength.
    pub plastic_pressure_factor: f64,
    /// `X`: start of the fully plastic regime, in yield indentations.
    pub fully_plastic: f64,
}

impl MaLiu {
    /// Pressures as published, `X = exp(2 (2 * 2.85/1.61 - 1))`.
    pub const REFERENCE: MaLiu =
        MaLiu { peak_pressure_factor: 1.61, plastic_pressure_factor: 2.85, fully_plastic: 160.893_932_191_922_47 };

    /// `q`.
    fn slope_ratio(&self) -> f64 {
        2.0 * self.plastic_pressure_factor / self.peak_pressure_factor
    }

    /// `c`.
    fn logarithmic_slope(&self) -> f64 {
        1.5 * (self.slope_ratio() - 1.0) / log(self.fully_plastic)
    }

    /// `f` at `x` on the mixed part.
    fn mixed_force(&self, x: f64) -> f64 {
        1.0 + 1.5 * (x - 1.0) + self.logarithmic_slope() * (x * log(x) - (x - 1.0))
    }

    /// Integral of `f` from 1 to `x` on the mixed part.
    fn mixed_work(&self, x: f64) -> f64 {
        let beyond = x - 1.0;
        // of x ln x - x + 1
        let logarithmic = 0.5 * x * x * log(x) - beyond * (0.75 * beyond + 0.5);
        beyond + 0.75 * beyond * beyond + self.logarithmic_slope() * logarithmic
    }

    /// The line beyond `plastic` \[m\].
    fn line(&self, point: &YieldPoint, plastic: f64) -> Segment {
        Segment {
            lower: plastic,
            upper: LARGEST_INDENTATION,
            origin: plastic,
            constant: self.mixed_force(self.fully_plastic) * point.force,
            linear: 1.5 * self.slope_ratio() * (point.force / point.indentation),
            ..Segment::NOTHING
        }
    }
}

impl Loading for MaLiu {
    fn is_segmented(&self) -> bool {
        false
    }

    /// The peak of Hertz's pressure is 1.5 times its mean.
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.peak_pressure_factor / 1.5)
    }

    /// On the mixed part the tangent, with the slope `1.5 + c ln x` \[F_y/d_y\].
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
        let stiffness = (1.5 + self.logarithmic_slope() * log(x)) * (point.force / point.indentation);
        Segment::tangent(indentation, self.mixed_force(x) * point.force, stiffness)
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        first_above(indentation, [d_y, self.fully_plastic * d_y])
    }

    /// In `F_y d_y`, with `z = x - 1`: `0.4 x^2.5`, then `0.4 + z + 0.75 z^2 + c (x^2 ln(x)/2 - 0.75 z^2 - 0.5 z)`, then the
    /// work of a line.
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
            return elastic.work(d_y) + self.mixed_work(indentation / d_y) * unit;
        }
        elastic.work(d_y) + self.mixed_work(self.fully_plastic) * unit + self.line(&point, plastic).work(indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
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
            "plastic_force" => Some(self.mixed_force(self.fully_plastic)),
            "plastic_slope" => Some(1.5 * self.slope_ratio()),
            _ => None,
        }
    }
}
