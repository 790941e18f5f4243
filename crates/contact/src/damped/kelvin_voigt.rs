//! Kelvin and Voigt: a linear spring in parallel with a dashpot.

use super::{Damped, Factors, Shape};
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
    fn factors(&self, pair: &Pair, restitution: f64, mass: f64) -> Factors {
        let hertz = 16.0 / 15.0 * sqrt(pair.radius) * pair.modulus;
        let speed = self.characteristic_speed;
        let elastic = hertz * pow(mass * speed * speed / hertz, 0.2);
        let decrement = -log(restitution);
        let ratio = decrement / sqrt(PI * PI + decrement * decrement);
        Factors { elastic, damping: 2.0 * ratio * sqrt(elastic * mass) }
    }

    fn needs_restitution(&self) -> bool {
        true
    }

    fn needs_mass(&self) -> bool {
        true
    }

    fn elastic(&self, d: f64) -> Shape {
        Shape { value: d, slope: 1.0, integral: 0.5 * d * d }
    }

    fn damping(&self, d: f64) -> Shape {
        Shape { value: 1.0, slope: 0.0, integral: d }
    }
}
