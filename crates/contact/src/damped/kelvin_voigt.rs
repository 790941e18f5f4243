//! Kelvin and Voigt: a linear spring in parallel with a dashpot.

use super::Damped;
use crate::loading::Elastic;
use crate::losses::{Damper, Form, Growth};
use crate::material::Pair;
use core::f64::consts::PI;
use libm::{log, pow, sqrt};

/// `F = k d + c d'` with `c = 2 z sqrt(k m)` and `z = -ln e/sqrt(pi^2 + ln^2 e)`.
///
/// `k = (16/15) sqrt(R) E* (15 m V^2/(16 sqrt(R) E*))^(1/5)`: without damping, a mass `m` with the characteristic speed `V`
/// reaches the same largest indentation as with Hertz's law. The force jumps to `c v` at first touch. The restitution would be
/// `e` if the surface could pull until `d = 0`. It cannot, so the restitution is higher: 0.5503 instead of 0.5, at any speed.
///
/// Reference: T. Schwager, T. Poeschel, *Granular Matter* 9 (2007) 465-469. The stiffness is that of the hysteretic Hooke model
/// of LIGGGHTS.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct KelvinVoigt {
    /// Characteristic speed `V` \[m/s\].
    pub characteristic_speed: f64,
}

impl KelvinVoigt {
    /// 1 m/s, chosen by this project.
    pub const REFERENCE: KelvinVoigt = KelvinVoigt { characteristic_speed: 1.0 };
}

impl Damped for KelvinVoigt {
    fn parts(&self, pair: &Pair, restitution: f64, mass: f64) -> (Elastic, Damper) {
        let hertz = 16.0 / 15.0 * sqrt(pair.radius) * pair.modulus;
        let speed = self.characteristic_speed;
        let stiffness = hertz * pow(mass * speed * speed / hertz, 0.2);
        let decrement = -log(restitution);
        let ratio = decrement / sqrt(PI * PI + decrement * decrement);
        let factor = 2.0 * ratio * sqrt(stiffness * mass);
        let spring = Elastic { force: stiffness, depth: 1.0, exponent: 1.0 };
        (spring, Damper { form: Form::Viscous(Growth::Constant), factor })
    }

    fn needs_restitution(&self) -> bool {
        true
    }

    fn needs_mass(&self) -> bool {
        true
    }
}
