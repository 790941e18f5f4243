//! Ghaednia, Brake, Berryhill and Jackson: bilinear hardening.

use super::jackson_green::{JacksonGreen, Scale};
use super::{Loading, hertz};
use crate::material::{Pair, YieldPoint};
use crate::numerics::dual::Dual;
use crate::numerics::quadrature::logarithmic_integral;
use crate::numerics::saturation;
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use core::f64::consts::PI;
use libm::{exp, log, sqrt};

/// The loading curve of Ghaednia et al. for a target that hardens with the tangent modulus `E_t = t E`. `d_c`, `F_c`, `C`, `B`
/// and `y` are those of [`JacksonGreen`]:
///
/// | regime | where | `F` |
/// |---|---|---|
/// | elastic (Hertz) | `y < 1.9` | `K_h d^1.5` |
/// | elastoplastic | `1.9 <= y` | `F_p + (K_h d^1.5 - F_p) (1 - exp(-3.3 t))` |
///
/// ```text
/// F_p = F_c (exp(-y^(5/12)/4) y^1.5 + (4 H/(C S)) (1 - exp(-y^(5/9)/25)) y)
/// H/S = 2.84 - 0.92 (1 - cos(pi a/R))
/// a   = a_e + (a_p - a_e) exp(U),  a_e = sqrt(R d),  a_p = sqrt(R d (y/1.9)^B)
/// U   = -2 sqrt(E/S) t^(1 - (d - d_c)/R) / ((4 - 3 exp(-2 sqrt(E/S) t)) (1 - t))
/// ```
///
/// `E` is Young's modulus of the target, and `0 < t < 1`. The formula for the hardness holds for `0 <= a <= R`. Where `a`
/// exceeds `R`, far beyond any physical meaning of the law, the hardness keeps its value at `a = R` (1.0 S), with continuous
/// slope, instead of rising again.
///
/// The contact radius is continuous. The force jumps up by 0.44 % at `y = 1.9` (nu = 0.3), as published. With the closure
/// [`Thornton`](crate::unloading::Thornton), an impact that just yields therefore gains energy: the restitution
/// reaches 1.0044, and 1.070 for `nu = 0`. From `nu = 0.323` on, the force jumps down and no energy is gained.
///
/// Reference: H. Ghaednia, M. R. W. Brake, M. Berryhill, R. L. Jackson, *J. Tribol.* 141 (2019) 031402.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Ghaednia {
    /// Tangent modulus over Young's modulus, `t` \[-\].
    pub hardening: f64,
    /// Hardness over the yield strength for a small contact \[-\].
    pub hardness_factor: f64,
    /// Half of the decrease of the hardness from a small contact to `a = R`, over the yield strength \[-\].
    pub hardness_loss: f64,
    /// Rate at which the force approaches Hertz's with increasing `t` \[-\].
    pub hardening_rate: f64,
}

impl Ghaednia {
    /// The constants as published, for a hardening of 2 %.
    pub const REFERENCE: Ghaednia =
        Ghaednia { hardening: 0.02, hardness_factor: 2.84, hardness_loss: 0.92, hardening_rate: 3.3 };

    fn scale(&self, pair: &Pair) -> Scale {
        JacksonGreen::REFERENCE.scale(pair)
    }

    /// `a/R` beyond the transition, with its slope with respect to `y`.
    fn radius(&self, scale: &Scale, pair: &Pair, y: f64) -> Dual {
        let y = Dual::variable(y);
        let relative = scale.unit.indentation / pair.radius;
        let elastic = sqrt(relative) * y.power(0.5);
        let plastic = scale.radius(y, pair, JacksonGreen::REFERENCE.transition);
        // a target that is nearly as strong as stiff: the fit has ended before this point
        if !plastic.value.is_finite() {
            return plastic;
        }
        let root = 2.0 * sqrt(pair.youngs_modulus / pair.yield_strength);
        let size = root / ((4.0 - 3.0 * exp(-root * self.hardening)) * (1.0 - self.hardening));
        let depth = log(self.hardening) * (Dual::constant(1.0 + relative) - relative * y);
        // beyond exp(9), about 8000, the plastic radius no longer contributes, and U would overflow
        if depth.value > 9.0 {
            return elastic;
        }
        elastic + (plastic - elastic) * (-size * depth.exp()).exp()
    }

    /// Force beyond the transition \[N\], with its slope with respect to `y`.
    fn plastic_force(&self, scale: &Scale, pair: &Pair, y: f64) -> Dual {
        let radius = self.radius(scale, pair, y);
        // where the radius overflows, the force does too
        let wide = radius.value >= 1.0 && radius.value.is_finite();
        let cosine = if wide { Dual::constant(-1.0) } else { (PI * radius).cos() };
        let hardness = Dual::constant(self.hardness_factor - self.hardness_loss) + self.hardness_loss * cosine;
        let y = Dual::variable(y);
        let plastic = scale.force(y, hardness);
        let share = saturation(self.hardening_rate * self.hardening);
        scale.unit.force * (plastic + share * (y.power(1.5) - plastic))
    }

    /// The indentation where `a = R` \[m\], by bisection: `a` grows with the indentation and is at least `sqrt(R d)`.
    fn full_radius(&self, scale: &Scale, pair: &Pair) -> f64 {
        let d_c = scale.unit.indentation;
        let (mut low, mut high) = (scale.transition, pair.radius);
        let within = low < high && self.radius(scale, pair, low / d_c).value < 1.0;
        if !within {
            return scale.transition;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if self.radius(scale, pair, middle / d_c).value < 1.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}

impl Loading for Ghaednia {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        JacksonGreen::REFERENCE.yield_point(pair)
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
        let scale = self.scale(pair);
        if indentation < scale.transition {
            return scale.transition;
        }
        let full = self.full_radius(&scale, pair);
        if indentation < full { full } else { LARGEST_INDENTATION }
    }

    /// Hertz's up to the transition. Beyond it there is no closed form, and the force is integrated over `ln y`, in two parts
    /// that meet at `a = R`.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let scale = self.scale(pair);
        let elastic = hertz::segment(pair, scale.transition);
        if indentation <= scale.transition {
            return elastic.work(indentation);
        }
        let d_c = scale.unit.indentation;
        let force = |y: f64| self.plastic_force(&scale, pair, y).value;
        let (full, start) = (self.full_radius(&scale, pair), JacksonGreen::REFERENCE.transition);
        let plastic = if full > scale.transition && full < indentation {
            logarithmic_integral(start, full / d_c, &force)
                + logarithmic_integral(full / d_c, indentation / d_c, &force)
        } else {
            logarithmic_integral(start, indentation / d_c, &force)
        };
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
        pair.radius * self.radius(&scale, pair, indentation / scale.unit.indentation).value
    }

    /// From `a = R` on, the hardness is constant and the regime is fully plastic.
    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let scale = self.scale(pair);
        if indentation < scale.transition {
            Regime::Elastic
        } else if indentation < self.full_radius(&scale, pair) {
            Regime::ElastoplasticFirst
        } else {
            Regime::FullyPlastic
        }
    }

    fn derived(&self, name: &str) -> Option<f64> {
        match name {
            "transition" => Some(JacksonGreen::REFERENCE.transition),
            _ => None,
        }
    }
}
