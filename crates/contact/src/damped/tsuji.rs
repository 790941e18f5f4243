//! Tsuji, Tanaka and Ishida: the Hertzian spring-dashpot of discrete-element codes.

use super::Damped;
use crate::laws::numbered;
use crate::loading::Elastic;
use crate::losses::{Damper, Form, Growth};
use crate::material::Pair;
use core::f64::consts::PI;
use libm::{exp, log, sqrt};

/// Formula for the damping `alpha` as a function of the required restitution `e`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(u8)]
pub enum TsujiDamping {
    /// `-sqrt(5) ln e/sqrt(pi^2 + ln^2 e)`: exact if the surface could pull until `d = 0`. With `e = 0.5`, the law gives
    /// 0.5503.
    Original,
    /// The polynomial that LAMMPS uses, derived for the full mass of one of two equal spheres. With `e = 0.5`, the law gives
    /// 0.6458.
    Lammps,
    /// For a surface that does not pull: with `e = 0.5`, the law gives 0.50001. A fit for `e` from 0.2 to 0.98. C. Thornton, S.
    /// J. Cummins, P. W. Cleary, *Powder Technology* 233 (2013) 30-46.
    NoTension,
}

numbered!(TsujiDamping);

impl TsujiDamping {
    /// All damping formulas with their names in a scene.
    pub const ALL: [(&'static str, TsujiDamping); 3] = [
        ("original", TsujiDamping::Original),
        ("lammps", TsujiDamping::Lammps),
        ("no-tension", TsujiDamping::NoTension),
    ];

    /// `alpha` for a restitution `e` in (0, 1].
    pub fn alpha(self, e: f64) -> f64 {
        match self {
            TsujiDamping::Original => -sqrt(5.0) * log(e) / sqrt(PI * PI + log(e) * log(e)),
            TsujiDamping::Lammps => polynomial(e, LAMMPS),
            TsujiDamping::NoTension if e >= 1.0 => 0.0,
            TsujiDamping::NoTension => {
                let exponent = e * polynomial(e, NO_TENSION);
                sqrt(6.0) * sqrt(1.0 / (1.0 - (1.0 + e) * (1.0 + e) * exp(exponent)) - 1.0)
            }
        }
    }
}

/// Coefficients in order of increasing power.
const LAMMPS: [f64; 7] = [1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218];

/// Coefficients of `e` to `e^10`, in order of increasing power.
const NO_TENSION: [f64; 10] =
    [-6.918798, -16.41105, 146.8049, -796.4559, 2928.711, -7206.864, 11494.29, -11342.18, 6276.757, -1489.915];

/// The polynomial in `x` with these coefficients, by Horner's rule.
fn polynomial<const COUNT: usize>(x: f64, coefficients: [f64; COUNT]) -> f64 {
    coefficients.into_iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// `F = K_h d^1.5 + alpha sqrt(m K_h) d^0.25 d'`. The restitution does not depend on the speed.
///
/// Reference: Y. Tsuji, T. Tanaka, T. Ishida, *Powder Technology* 71 (1992) 239-250.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Tsuji {
    /// Formula for `alpha`.
    pub damping_factor: TsujiDamping,
}

impl Tsuji {
    /// Uses the damping of the paper.
    pub const REFERENCE: Tsuji = Tsuji { damping_factor: TsujiDamping::Original };
}

impl Damped for Tsuji {
    fn parts(&self, pair: &Pair, restitution: f64, mass: f64) -> (Elastic, Damper) {
        // the stiffness is 1.5 K_h d^0.5
        let factor = self.damping_factor.alpha(restitution) * sqrt(mass / 1.5);
        (Elastic::hertz(pair), Damper { form: Form::Viscous(Growth::Root), factor })
    }

    fn needs_restitution(&self) -> bool {
        true
    }

    fn needs_mass(&self) -> bool {
        true
    }
}
