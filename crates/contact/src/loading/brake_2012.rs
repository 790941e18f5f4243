//! Brake 2012: a cubic between Hertz and the plastic line.

use super::{Loading, first_above, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use core::f64::consts::PI;
use libm::{atan, sqrt};

/// The loading curve of Brake 2012, with `p_H = 2.8 S`, `F_p = K_h d_p^1.5`, `h = (d - d_y)/(d_p - d_y)`, `L = d_p - d_y`:
///
/// | regime | where | `F` |
/// |---|---|---|
/// | elastic (Hertz) | `d < d_y` | `K_h d^1.5` |
/// | elastoplastic | `d_y <= d < d_p` | `(2h^3-3h^2+1) F_y + (h^3-2h^2+h) L F'_y + (-2h^3+3h^2) F_p + (h^3-h^2) L F'_p` |
/// | fully plastic | `d_p <= d` | `F_p + F'_p (d - d_p)`, `F'_p = 2 pi R p_H` |
///
/// Yield follows von Mises: `d_y = R (pi p_0/(2 E*))^2`, with `p_0` of [`first_yield`]. Force and slope are continuous
/// everywhere. This project reconstructed the law from descriptions of the paper, in two variants. In
/// [`TANGENT`](Brake2012::TANGENT), the plastic line begins where Hertz's curve has the slope of the line,
/// `d_p = R (pi p_H/E*)^2`: the curve is Hertz's followed by its tangent, except that the cubic is up to 4 % below Hertz's in
/// between (nu = 0.3). In [`LINE`](Brake2012::LINE), the line begins where Hertz's mean pressure is the hardness,
/// `d_p = R (3 pi p_H/(4 E*))^2`: the curve bends upwards there, above Hertz's, and the closure
/// [`Thornton`](crate::unloading::Thornton) gives negative dents. With that closure neither variant is passive: for a
/// Poisson's ratio of 0 or more, the restitution reaches 1.009 and 1.093. The descriptions do not give the contact radius;
/// `a^2 = R d` is this project's choice.
///
/// Reference: M. R. W. Brake, *Int. J. Solids Struct.* 49 (2012) 3129-3141.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Brake2012 {
    /// Brinell pressure over the yield strength.
    pub hardness_factor: f64,
    /// Hertz's mean pressure where the plastic line begins, over the Brinell pressure \[-\]: 4/3 ("tangent") or 1 ("line").
    pub plastic_start: f64,
}

/// Largest Hertz pressure over the yield strength \[-\] at which the contact begins to yield on its axis, after von Mises.
///
/// `p_0/S = 1/max_z |s_z - s_r|`, with `s_r - s_z = 1.5/(1 + z^2) - (1 + nu) (1 - z atan(1/z))`. The depth `z` is in contact
/// radii, stresses are in units of `p_0`. Newton's method finds the position of the maximum; an error of the position has only
/// a second-order effect.
///
/// Reference: K. L. Johnson, *Contact Mechanics*, 1985, eq. 3.45 and section 6.1.
pub fn first_yield(poissons_ratio: f64) -> f64 {
    let bulk = 1.0 + poissons_ratio;
    // within 1e-3 for 0 <= nu <= 0.5, and close enough elsewhere
    let mut depth = 0.382 + 0.332 * poissons_ratio;
    for _ in 0..6 {
        let square = 1.0 + depth * depth;
        let slope = bulk * (atan(1.0 / depth) - depth / square) - 3.0 * depth / (square * square);
        let curvature =
            (12.0 * depth * depth - 3.0 * square) / (square * square * square) - 2.0 * bulk / (square * square);
        depth -= slope / curvature;
    }
    1.0 / (1.5 / (1.0 + depth * depth) - bulk * (1.0 - depth * atan(1.0 / depth)))
}

/// The cubic and the line for one pair of bodies.
struct Borders {
    yielding: YieldPoint,
    plastic: YieldPoint,
    yield_slope: f64,
    plastic_slope: f64,
}

impl Borders {
    /// `F`, `dF/dd` and the work from `d_y`, on the cubic.
    fn cubic(&self, indentation: f64) -> (f64, f64, f64) {
        let length = self.plastic.indentation - self.yielding.indentation;
        let h = (indentation - self.yielding.indentation) / length;
        // F_y + h (p + h (q + h r))
        let rise = self.plastic.force - self.yielding.force;
        let (start, end) = (length * self.yield_slope, length * self.plastic_slope);
        let (p, q, r) = (start, 3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise);
        let force = self.yielding.force + h * (p + h * (q + h * r));
        let slope = (p + h * (2.0 * q + h * 3.0 * r)) / length;
        let work = length * h * (self.yielding.force + h * (p / 2.0 + h * (q / 3.0 + h * r / 4.0)));
        (force, slope, work)
    }
}

impl Brake2012 {
    /// The variant "tangent", with a hardness of 2.8 S.
    pub const TANGENT: Brake2012 = Brake2012 { hardness_factor: 2.8, plastic_start: 4.0 / 3.0 };
    /// The variant "line", with a hardness of 2.8 S.
    pub const LINE: Brake2012 = Brake2012 { hardness_factor: 2.8, plastic_start: 1.0 };
    /// The variant whose curve does not bend upwards.
    pub const REFERENCE: Brake2012 = Brake2012::TANGENT;

    fn borders(&self, pair: &Pair) -> Borders {
        let yielding = self.yield_point(pair);
        Borders {
            yielding,
            plastic: pair.yield_point(self.plastic_start * self.hardness_factor),
            yield_slope: 1.5 * pair.hertz_stiffness() * sqrt(yielding.indentation),
            plastic_slope: 2.0 * PI * pair.radius * self.hardness_factor * pair.yield_strength,
        }
    }
}

impl Loading for Brake2012 {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(first_yield(pair.poissons_ratio) / 1.5)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let borders = self.borders(pair);
        if indentation < borders.yielding.indentation {
            return hertz::segment(pair, borders.yielding.indentation);
        }
        let YieldPoint { indentation: origin, force: constant } = borders.plastic;
        if indentation < origin {
            let (force, slope, _) = borders.cubic(indentation);
            return Segment::tangent(indentation, force, slope);
        }
        let linear = borders.plastic_slope;
        Segment { lower: origin, upper: LARGEST_INDENTATION, origin, constant, linear, ..Segment::NOTHING }
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let borders = self.borders(pair);
        first_above(indentation, [borders.yielding.indentation, borders.plastic.indentation])
    }

    /// The integrals of the three polynomials.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let borders = self.borders(pair);
        let elastic = hertz::segment(pair, borders.yielding.indentation);
        let plastic = borders.plastic.indentation;
        if indentation <= borders.yielding.indentation {
            return elastic.work(indentation);
        }
        let yielded = elastic.work(borders.yielding.indentation);
        if indentation <= plastic {
            return yielded + borders.cubic(indentation).2;
        }
        yielded + borders.cubic(plastic).2 + self.segment(pair, plastic).work(indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let borders = self.borders(pair);
        if indentation < borders.yielding.indentation {
            Regime::Elastic
        } else if indentation < borders.plastic.indentation {
            Regime::ElastoplasticFirst
        } else {
            Regime::FullyPlastic
        }
    }
}
