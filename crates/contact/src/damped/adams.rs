//! The IMPACT function of Adams, MotionSolve and SolidWorks Motion.

use super::{Damped, Factors, Shape};
use crate::material::Pair;
use libm::{pow, sqrt};

/// `F = k d^n + c STEP(d) d'` with `STEP = u^2 (3 - 2u)`, `u = min(d/d_p, 1)`.
///
/// In those tools, the user sets `k`, and so may a scene. Otherwise it follows from the bodies: `k d_p^n` is the stiffness factor times
/// Hertz's force at `d_p`, the indentation at which the damping is full.
///
/// Reference: the IMPACT and STEP functions in the help of Altair MotionSolve and SolidWorks Motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Adams {
    /// `k` as it is typed in those tools \[N/m^n\]; 0 if it follows from the bodies.
    pub stiffness: f64,
    /// Force at the damping depth over Hertz's force there \[-\].
    pub stiffness_factor: f64,
    /// Exponent `n` >= 1 \[-\].
    pub exponent: f64,
    /// Full damping `c` \[N.s/m\].
    pub full_damping: f64,
    /// Damping depth `d_p` \[m\].
    pub damping_depth: f64,
}

impl Adams {
    /// Hertz's force, and a damping that describes no material. The user should set all four.
    pub const REFERENCE: Adams =
        Adams { stiffness: 0.0, stiffness_factor: 1.0, exponent: 1.5, full_damping: 100.0, damping_depth: 1e-5 };
}

impl Damped for Adams {
    fn factors(&self, pair: &Pair, _restitution: f64, _mass: f64) -> Factors {
        let depth = self.damping_depth;
        let elastic = if self.stiffness > 0.0 {
            self.stiffness * pow(depth, self.exponent)
        } else {
            self.stiffness_factor * pair.hertz_stiffness() * (depth * sqrt(depth))
        };
        Factors { elastic, damping: self.full_damping }
    }

    fn elastic(&self, d: f64) -> Shape {
        let depths = d / self.damping_depth;
        let value = pow(depths, self.exponent);
        let slope = self.exponent * pow(depths, self.exponent - 1.0) / self.damping_depth;
        Shape { value, slope, integral: value * d / (self.exponent + 1.0) }
    }

    fn damping(&self, d: f64) -> Shape {
        let depth = self.damping_depth;
        let u = d / depth;
        if u < 1.0 {
            let integral = depth * u * u * u * (1.0 - 0.5 * u);
            Shape { value: u * u * (3.0 - 2.0 * u), slope: 6.0 * u * (1.0 - u) / depth, integral }
        } else {
            Shape { value: 1.0, slope: 0.0, integral: d - 0.5 * depth }
        }
    }

    /// For `n < 2`, `u^(n-2)/(3 - 2u)` falls up to `u = 1.5 (2 - n)/(3 - n)` and rises from there.
    fn borders(&self) -> [f64; 2] {
        let n = self.exponent;
        let lowest = if n < 2.0 { 1.5 * (2.0 - n) / (3.0 - n) } else { 0.0 };
        [self.damping_depth * lowest, self.damping_depth]
    }
}
