//! Brake 2015: the elastic response fades while the plastic one grows.

use super::brake_2012::first_yield;
use super::{Loading, hertz};
use crate::material::{Pair, YieldPoint};
use crate::numerics::dual::Dual;
use crate::numerics::quadrature::{gauss, graded_integral};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use core::f64::consts::PI;
use libm::sqrt;

/// The loading curve of Brake 2015 without hardening (`n = 2`, `xi = 0`), with `p_H = 2.8 S`, `d_p = R (3 pi p_H/(4 E*))^2`,
/// `s = (d - d_y)/(d_p - d_y)`:
///
/// | regime | where | `F` |
/// |---|---|---|
/// | elastic (Hertz) | `d < d_y` | `F_H = K_h d^1.5` |
/// | transitional | `d_y <= d` | `F_H sech(s) + F_P (1 - sech(s))`, `F_P = pi R p_H (2 d - d_p)` |
///
/// Yield is that of [`Brake2012`](super::Brake2012). Force and slope are continuous. This project reconstructed the law from
/// descriptions of the paper, which do not contain its hardening (`n > 2`). The curve exceeds Hertz's between about 4 and 12
/// d_y. There the closure [`Thornton`](crate::unloading::Thornton) gives negative dents, and an impact gains energy:
/// the restitution reaches 1.050. The descriptions do not give the contact radius; `a^2 = R d` is this project's choice.
///
/// Reference: M. R. W. Brake, *Int. J. Solids Struct.* 62 (2015) 104-123.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Brake2015 {
    /// Brinell pressure over the yield strength.
    pub hardness_factor: f64,
}

/// `s` beyond which the elastic response is below rounding.
const FADED: f64 = 60.0;

impl Brake2015 {
    /// A hardness of 2.8 S.
    pub const REFERENCE: Brake2015 = Brake2015 { hardness_factor: 2.8 };

    /// `d_p` \[m\].
    fn plastic(&self, pair: &Pair) -> f64 {
        pair.yield_point(self.hardness_factor).indentation
    }

    /// `pi R p_H` \[N/m\].
    fn plastic_slope(&self, pair: &Pair) -> f64 {
        PI * pair.radius * self.hardness_factor * pair.yield_strength
    }

    /// `F_H` and `F_P` \[N\], with their slopes.
    fn parts(&self, pair: &Pair, d_p: f64, indentation: f64) -> [Dual; 2] {
        let d = Dual::variable(indentation);
        let root = sqrt(indentation);
        let hertz = pair.hertz_stiffness() * Dual { value: indentation * root, slope: 1.5 * root };
        [hertz, self.plastic_slope(pair) * (2.0 * d - Dual::constant(d_p))]
    }

    /// `(F_H - F_P) sech(s)` \[N\] with its slope with respect to `d`; the arguments contain `d_y` and `d_p`.
    fn elastic_part(&self, pair: &Pair, borders: (f64, f64), indentation: f64) -> Dual {
        let (d_y, d_p) = borders;
        let s = (indentation - d_y) / (d_p - d_y);
        if s > FADED {
            return Dual::constant(0.0);
        }
        let [hertz, plastic] = self.parts(pair, d_p, indentation);
        (hertz - plastic) * Dual { value: s, slope: 1.0 / (d_p - d_y) }.sech()
    }
}

impl Loading for Brake2015 {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(first_yield(pair.poissons_ratio) / 1.5)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let d_y = self.yield_point(pair).indentation;
        if indentation < d_y {
            return hertz::segment(pair, d_y);
        }
        let d_p = self.plastic(pair);
        let [hertz, plastic] = self.parts(pair, d_p, indentation);
        let s = Dual { value: (indentation - d_y) / (d_p - d_y), slope: 1.0 / (d_p - d_y) };
        // a sum of two parts of which each is exact: F_P alone may be some ten times as large as the force
        let force = match s.value > FADED {
            true => plastic,
            false => hertz * s.sech() + plastic * s.one_less_sech(),
        };
        Segment::tangent(indentation, force.value, force.slope)
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        if indentation < d_y { d_y } else { LARGEST_INDENTATION }
    }

    /// The plastic part alone is `pi R p_H (d^2 - d_y^2 - d_p (d - d_y))`. The rest is integrated over `s`, panel by panel,
    /// until it has faded.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        if indentation <= d_y {
            return hertz::segment(pair, d_y).work(indentation);
        }
        let d_p = self.plastic(pair);
        let length = d_p - d_y;
        let plastic = self.plastic_slope(pair) * ((indentation - d_y) * (indentation + d_y - d_p));
        let integrand = |s: f64| self.elastic_part(pair, (d_y, d_p), d_y + s * length).value;
        let end = (indentation - d_y) / length;
        let end = if end < FADED { end } else { FADED };
        let mut elastic = graded_integral(0.0, if end < 1.0 { end } else { 1.0 }, &integrand);
        let mut from = 1.0;
        while from < end {
            let to = if from + 1.0 < end { from + 1.0 } else { end };
            elastic += gauss(from, to, &integrand);
            from = to;
        }
        hertz::segment(pair, d_y).work(d_y) + plastic + length * elastic
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        if indentation < self.yield_point(pair).indentation { Regime::Elastic } else { Regime::ElastoplasticFirst }
    }
}
