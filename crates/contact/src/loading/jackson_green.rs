//! Jackson and Green: a hardness that falls with the contact radius.

use super::{Loading, hertz};
use crate::material::{Pair, YieldPoint};
use crate::numerics::dual::Dual;
use crate::numerics::quadrature::logarithmic_integral;
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{exp, pow, sqrt};

/// The loading curve of Jackson and Green, with `C = 1.295 exp(0.736 nu)`, `d_c = (pi C S/(2 E*))^2 R`, `F_c = K_h d_c^1.5`,
/// `y = d/d_c`, `B = 0.14 exp(23 S/E*)`:
///
/// | regime | where | `F/F_c` | `(a/R)^2` |
/// |---|---|---|---|
/// | elastic (Hertz) | `y < 1.9` | `y^1.5` | `d/R` |
/// | elastoplastic | `1.9 <= y` | `exp(-y^(5/12)/4) y^1.5 + (4 H/(C S)) (1 - exp(-y^(5/9)/25)) y` | `(d/R) (y/1.9)^B` |
///
/// with the hardness `H/S = 2.84 (1 - exp(-0.82 (a/R)^-0.7))`, which falls from 2.84. In the paper yielding begins at `y = 1`
/// but has no effect up to 1.9; here the contact counts as elastic until then.
///
/// The contact radius is continuous. The force jumps up by 0.47 % at `y = 1.9` (nu = 0.3), as published. The jump takes no
/// work, so unloading from just beyond it may return 0.47 % too much. From `nu = 0.323` on, the force jumps down. The dent of
/// the fitted law [`Jackson`](crate::unloading::Jackson) also jumps; with it, no energy is gained from `nu = 0.02` on.
/// The fit is for a deformable sphere under a rigid flat.
///
/// Reference: R. L. Jackson, I. Green, *J. Tribol.* 127 (2005) 343-354.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct JacksonGreen {
    /// `C` at `nu = 0`: the largest pressure at yield over the yield strength \[-\].
    pub yield_constant: f64,
    /// Rate at which `ln C` grows with Poisson's ratio.
    pub yield_growth: f64,
    /// Start of the elastoplastic formula \[d_c\].
    pub transition: f64,
    /// `B` for a yield strength of zero.
    pub area_exponent: f64,
    /// Rate at which `ln B` grows with `S/E*`.
    pub area_growth: f64,
    /// Hardness over the yield strength for a small contact \[-\].
    pub hardness_factor: f64,
}

/// The scales of the laws with this yield criterion, for one pair of bodies.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    /// `C`.
    pub peak: f64,
    /// `B`.
    pub exponent: f64,
    /// `d_c` and `F_c`.
    pub unit: YieldPoint,
    /// Start of the elastoplastic formula \[m\].
    pub transition: f64,
}

impl Scale {
    /// `F_p/F_c` at `y`, for a hardness given in yield strengths: the elastic part fades, the plastic part grows.
    pub fn force(&self, y: Dual, hardness: Dual) -> Dual {
        let fading = (-0.25 * y.power(5.0 / 12.0)).exp();
        let growing = (0.04 * y.power(5.0 / 9.0)).saturation();
        fading * y.power(1.5) + (4.0 / self.peak) * hardness * growing * y
    }

    /// `(a/R)` of the area law.
    pub fn radius(&self, y: Dual, pair: &Pair, transition: f64) -> Dual {
        let growth = 0.5 * self.exponent;
        let size = sqrt(self.unit.indentation / pair.radius) * pow(transition, -growth);
        size * y.power(0.5 + growth)
    }
}

impl JacksonGreen {
    /// The constants as published.
    pub const REFERENCE: JacksonGreen = JacksonGreen {
        yield_constant: 1.295,
        yield_growth: 0.736,
        transition: 1.9,
        area_exponent: 0.14,
        area_growth: 23.0,
        hardness_factor: 2.84,
    };

    pub(super) fn scale(&self, pair: &Pair) -> Scale {
        let peak = self.yield_constant * exp(self.yield_growth * pair.poissons_ratio);
        let exponent = self.area_exponent * exp(self.area_growth * pair.yield_strength / pair.modulus);
        let unit = pair.yield_point(peak / 1.5);
        Scale { peak, exponent, unit, transition: self.transition * unit.indentation }
    }

    /// `d_c` and `F_c`, the units of the law.
    pub fn unit(&self, pair: &Pair) -> YieldPoint {
        self.scale(pair).unit
    }

    /// Force beyond the transition \[N\], with its slope with respect to `y`.
    fn plastic_force(&self, scale: &Scale, pair: &Pair, y: f64) -> Dual {
        let y = Dual::variable(y);
        let radius = scale.radius(y, pair, self.transition);
        let hardness = self.hardness_factor * (0.82 * radius.power(-0.7)).saturation();
        scale.unit.force * scale.force(y, hardness)
    }
}

impl Loading for JacksonGreen {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        let indentation = self.scale(pair).transition;
        YieldPoint { indentation, force: pair.hertz_stiffness() * (indentation * sqrt(indentation)) }
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let scale = self.scale(pair);
        if indentation < scale.transition {
            return hertz::segment(pair, scale.transition);
        }
        let d_c = scale.unit.indentation;
        let Dual { value, slope } = self.plastic_force(&scale, pair, indentation / d_c);
        Segment::tangent(indentation, value, slope / d_c)
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let transition = self.scale(pair).transition;
        if indentation < transition { transition } else { LARGEST_INDENTATION }
    }

    /// Hertz's up to the transition. Beyond it there is no closed form, and the force is integrated over `ln y`.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let scale = self.scale(pair);
        let elastic = hertz::segment(pair, scale.transition);
        if indentation <= scale.transition {
            return elastic.work(indentation);
        }
        let d_c = scale.unit.indentation;
        let force = |y: f64| self.plastic_force(&scale, pair, y).value;
        let plastic = logarithmic_integral(self.transition, indentation / d_c, &force);
        elastic.work(scale.transition) + d_c * plastic
    }

    fn work_between(&self, pair: &Pair, low: f64, high: f64) -> Option<f64> {
        let scale = self.scale(pair);
        let d_c = scale.unit.indentation;
        let force = |y: f64| self.plastic_force(&scale, pair, y).value;
        (low >= scale.transition).then(|| d_c * logarithmic_integral(low / d_c, high / d_c, &force))
    }

    /// As published.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let scale = self.scale(pair);
        if indentation < scale.transition {
            return sqrt(pair.radius * indentation);
        }
        let y = Dual::constant(indentation / scale.unit.indentation);
        pair.radius * scale.radius(y, pair, self.transition).value
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        if indentation < self.scale(pair).transition { Regime::Elastic } else { Regime::ElastoplasticFirst }
    }
}
