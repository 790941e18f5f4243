//! Vu-Quoc and Zhang: the contact radius is the sum of an elastic and a plastic part.

use super::{Loading, hertz};
use crate::material::{Pair, YieldPoint};
use crate::numerics::quadrature::logarithmic_integral;
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{cbrt, sqrt};

/// The loading curve of Vu-Quoc and Zhang, driven by the force; `f = F/F_y`, `x = d/d_y`, `a_y = sqrt(R d_y)`:
///
/// | regime | where | curve | `a/a_y` |
/// |---|---|---|---|
/// | elastic (Hertz) | `f < 1` | `x = f^(2/3)` | `f^(1/3)` |
/// | elastoplastic | `1 <= f` | `x = (f^(1/3) + A (f - 1))^2 / (1 + B (f - 1))` | `f^(1/3) + A (f - 1)` |
///
/// Yield begins at a largest pressure of 1.61 S. The elastic radius `f^(1/3)` continues as Hertz's, the plastic radius is
/// linear in the force, and the denominator is the growth of the radius of curvature. `A = C_a F_y/a_y` and `B = K_c F_y` were
/// fitted to finite elements for one pair (R = 0.1 m, E = 70 GPa, nu = 0.3, S = 100 MPa: C_a = 2.33e-7 m/N, K_c = 2.69e-4 1/N,
/// F_y = 36.447 N, a_y = 0.32877 mm). Here `A` and `B` are the constants, so the normalised curve is the same for every pair.
///
/// Force and contact radius are continuous; the slope falls from 1.5 to 1.41 F_y/d_y at yield. The fit ends at about 40 F_y.
/// Beyond that, `F` tends to `(B/A^2) x` F_y, an unlimited pressure. The law is passive with its own unloading law.
///
/// Reference: L. Vu-Quoc, X. Zhang, *Proc. R. Soc. A* 455 (1999) 4013-4044; L. Vu-Quoc, X. Zhang, L. Lesburg, *J. Appl. Mech.* 67
/// (2000) 363-371.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct VuQuocZhang {
    /// Largest pressure at yield over the yield strength \[-\].
    pub peak_pressure_factor: f64,
    /// `A`: plastic contact radius for each `F_y` beyond yield \[a_y\].
    pub plastic_radius: f64,
    /// `B`: relative growth of the radius of curvature for each `F_y` beyond yield \[-\].
    pub curvature: f64,
}

impl VuQuocZhang {
    /// The constants of the published fit.
    pub const REFERENCE: VuQuocZhang = VuQuocZhang {
        peak_pressure_factor: 1.61,
        plastic_radius: 0.025_830_303_916_555_01,
        curvature: 0.009_804_263_625_242_24,
    };

    /// `x` and `dx/dg` at `g = f^(1/3)` >= 1.
    fn indentation(&self, g: f64) -> (f64, f64) {
        let beyond = (g - 1.0) * (g * g + g + 1.0);
        let radius = g + self.plastic_radius * beyond;
        let growth = 1.0 + self.curvature * beyond;
        let x = radius / growth * radius;
        let square = 3.0 * g * g;
        let relative = 2.0 * (1.0 + self.plastic_radius * square) / radius - self.curvature * square / growth;
        (x, x * relative)
    }

    /// `g = f^(1/3)` at `x >= 1`, by Newton's method; `x` lies between the second and third power of `g`.
    fn root_of_force(&self, x: f64) -> f64 {
        let asymptote = 1.0 + cbrt(x * self.curvature) / cbrt(self.plastic_radius * self.plastic_radius);
        let hertz = sqrt(x);
        let mut g = if hertz < asymptote { hertz } else { asymptote };
        for _ in 0..40 {
            let (at, slope) = self.indentation(g);
            let next = g - (at - x) / slope;
            let next = if next > 1.0 { next } else { 1.0 };
            let change = (next - g).abs();
            g = next;
            // the method squares the relative error: another iteration would change nothing
            if change <= 1e-9 * g {
                break;
            }
        }
        let (at, slope) = self.indentation(g);
        let polished = g - (at - x) / slope;
        if polished > 1.0 { polished } else { 1.0 }
    }
}

impl Loading for VuQuocZhang {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        pair.yield_point(self.peak_pressure_factor / 1.5)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let YieldPoint { indentation: d_y, force: f_y } = self.yield_point(pair);
        if indentation < d_y {
            return hertz::segment(pair, d_y);
        }
        let g = self.root_of_force(indentation / d_y);
        let (_, slope) = self.indentation(g);
        Segment::tangent(indentation, f_y * (g * g * g), f_y / d_y * (3.0 * g * g / slope))
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        if indentation < d_y { d_y } else { LARGEST_INDENTATION }
    }

    /// `0.4 F_y d_y` up to yield, then the integral of `g^3 dx/dg` over `ln g`.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let YieldPoint { indentation: d_y, force: f_y } = self.yield_point(pair);
        let elastic = hertz::segment(pair, d_y);
        if indentation <= d_y {
            return elastic.work(indentation);
        }
        let end = self.root_of_force(indentation / d_y);
        let plastic = logarithmic_integral(1.0, end, &|g: f64| g * g * g * self.indentation(g).1);
        elastic.work(d_y) + f_y * d_y * plastic
    }

    /// As published.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_y = self.yield_point(pair).indentation;
        if indentation < d_y {
            return sqrt(pair.radius * indentation);
        }
        let g = self.root_of_force(indentation / d_y);
        sqrt(pair.radius * d_y) * (g + self.plastic_radius * ((g - 1.0) * (g * g + g + 1.0)))
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        if indentation < self.yield_point(pair).indentation { Regime::Elastic } else { Regime::ElastoplasticFirst }
    }
}
