//! The IMPACT function of Adams, MotionSolve and SolidWorks Motion.

use super::Damped;
use crate::loading::Elastic;
use crate::losses::{Damper, Form, Growth};
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
    fn parts(&self, pair: &Pair, _restitution: f64, _mass: f64) -> (Elastic, Damper) {
        let (depth, exponent) = (self.damping_depth, self.exponent);
        let force = if self.stiffness > 0.0 {
            self.stiffness * pow(depth, exponent)
        } else {
            self.stiffness_factor * pair.hertz_stiffness() * (depth * sqrt(depth))
        };
        // for n < 2, `u^(n-2)/(3 - 2u)` falls up to this u, and rises from there
        let lowest = if exponent < 2.0 { 1.5 * (2.0 - exponent) / (3.0 - exponent) } else { 0.0 };
        let growth = Growth::Step { depth, lowest: depth * lowest };
        (Elastic { force, depth, exponent }, Damper { form: Form::Viscous(growth), factor: self.full_damping })
    }
}
