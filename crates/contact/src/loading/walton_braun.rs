//! Walton and Braun: a spring that is stiffer during unloading.

use super::Loading;
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::sqrt;

/// The loading line of Walton and Braun: `F = k_1 d` from zero.
///
/// There is no elastic part: the contact yields at zero indentation and force. `k_1` is the stiffness factor times the secant
/// `F_y/d_y = K_h sqrt(d_y) = pi R p_m` of Hertz's curve at the point where the mean pressure `p_m` is 1.1 S. With a factor of
/// 1 the line passes through that point; it is above Hertz's curve before it and below it after it. `a^2 = R d` is this
/// project's choice. The law is simple and therefore common in discrete-element codes; it does not describe a real curve.
///
/// It is intended for the unloading law of the same name, with which the restitution is `sqrt(k_1/k_2)` at any speed. The
/// closures based on Hertz's law do not suit it: at small indentations they are softer than the line, and would return more
/// energy than was put in.
///
/// Reference: O. R. Walton, R. L. Braun, *J. Rheology* 30 (1986) 949-980.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct WaltonBraun {
    /// Mean pressure over the yield strength at which Hertz's secant is taken \[-\].
    pub yield_pressure_factor: f64,
    /// `k_1` over that secant \[-\].
    pub stiffness_factor: f64,
}

impl WaltonBraun {
    /// The secant at 1.1 S itself, chosen by this project; the original leaves `k_1` to the user.
    pub const REFERENCE: WaltonBraun = WaltonBraun { yield_pressure_factor: 1.1, stiffness_factor: 1.0 };
}

impl Loading for WaltonBraun {
    fn yield_point(&self, _pair: &Pair) -> YieldPoint {
        YieldPoint { indentation: 0.0, force: 0.0 }
    }

    fn segment(&self, pair: &Pair, _indentation: f64) -> Segment {
        let secant = pair.hertz_stiffness() * sqrt(pair.yield_point(self.yield_pressure_factor).indentation);
        Segment { upper: LARGEST_INDENTATION, linear: self.stiffness_factor * secant, ..Segment::NOTHING }
    }

    /// `W = k_1 d^2/2`.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        self.segment(pair, 0.0).work(indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        sqrt(pair.radius * indentation)
    }

    fn regime(&self, _pair: &Pair, _indentation: f64) -> Regime {
        Regime::ElastoplasticFirst
    }
}
