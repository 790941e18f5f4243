//! Kelvin and Voigt: a linear spring beside a dashpot.

use super::{Damped, Factors, Shape};
use crate::contact::material::Pair;
use core::f64::consts::PI;
use libm::{log, pow, sqrt};

/// `F = k d + c d'` with `c = 2 z sqrt(k m)` and `z = -ln e/sqrt(pi^2 + ln^2 e)`.
///
/// `k = (16/15) sqrt(R) E* (15 m V^2/(16 sqrt(R) E*))^(1/5)` takes up as much energy as Hertz's law when the mass `m` comes
/// with the characteristic speed `V`. The force jumps to `c v` at first touch. `e` would be given if the surface could
/// pull until `d = 0`; it can't, and restitution is higher: asked for 0.5, it is 0.5503 at any speed.
///
/// Reference: T. Schwager, T. Poeschel, *Granular Matter* 9 (2007) 465-469; the stiffness is that of the hysteretic Hooke
/// model of LIGGGHTS.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "exporter", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct KelvinVoigt {
    /// `V` \[m/s\].
    pub characteristic_speed: f64,
}

impl KelvinVoigt {
    /// At 1 m/s: a choice of this project.
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
