//! The unloading of the law `brinell`: recovery and path fitted to finite elements.

use super::{Peak, Recovery, Unloading, path_of_shape, residual_after};
use crate::loading;
use crate::loading::two_bodies::{Construction, OwnCurve, Together, Yielding};
use crate::material::Pair;
use crate::material::large_strain::recovery_factor;
use crate::material::strength::{Strength, area_factor, held, slope_factor};
use crate::segment::Segment;
use libm::sqrt;

/// `F = F_m ((1 + g) s^1.5 - g s^2)` with `s = (d - d_f)/d_e`. The initial slope is `2 E* a_m`, exact for an elastic
/// unloading: `d_e = (3 - g) F_m / (4 E* a_m)`. Near its end the path has Hertz's exponent.
///
/// `g` depends on `psi = 1 - F_m/(K_h d_m^1.5)`, the relative distance of the force below Hertz's:
/// `g = height psi (1 - decline psi^3) / (psi + onset)^(3/4)`. At yield, `g` and its slope are zero.
///
/// The slope of an elastic unloading is `2 E* a` at every point. The contact radius is therefore proportional to the stiffness. Within 0.4 % of `F_m` of the finite-element results at every point of five depths; recovery within 0.8 %,
/// dissipated energy within 0.5 %, restitution within 0.2 %. Fitted for the loading law `brinell` by
/// `data/fit/fit_brinell.py`.
///
/// **Two bodies.** With the loading law [`Paired`](crate::loading::Paired), hardening and other Poisson's ratios change recovery and shape
/// of each body that yields. Alone under a rigid sphere, a body has, in units of its yield point, `k = d/d_Y` and `phi = F/F_Y`:
///
/// - dent `k_f = (k - u^2 r(k/u^2))/(1 + 1.584 h)`, with the recovery `r` of the law itself and the strength `u` of the dent;
/// - shape `g_i = 3 (1 - (k - k_f) sqrt(beta)/phi)`: a slope `2 E* b` at the peak with `b^2 = R d_Y beta`,
///   `beta = u^2 A(k/u^2) (phi/(u^3 Phi(k/u^2)))^-1.111`. `b` is the contact radius to some percent.
///
/// Relative to what the plain formula gives for it, this is a factor `c_i` of the recovery and a difference of the shape. Two bodies
/// have the sums of both, weighted with `E*/E_i`: recovery `c (3 - g) F_m/(4 E* a_m)`, shape `g` between 0 and 0.75. So a single body
/// under a rigid sphere, and two equal ones, have exactly its own recovery and shape. [Large strain](mod@crate::material::large_strain) makes the
/// recovery of each body smaller.
///
/// Rigid sphere: within 0.9 % of `F_m` of the finite-element curves in `data/truth/materials`, restitution within 0.6 %. Two bodies: see
/// [`two_bodies`](crate::loading::two_bodies).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Brinell {
    /// Size of `g`.
    pub height: f64,
    /// How soon after yield `g` rises.
    pub onset: f64,
    /// How `g` falls again for deep dents, where unloading yields in reverse.
    pub decline: f64,
}

impl Brinell {
    /// The constants from `data/fit/fit_brinell.py`, for a Poisson's ratio of 0.3 of the yielding body and no hardening.
    /// `decline` is chosen by judgement, since only one depth depends on it.
    pub const REFERENCE: Brinell = Brinell { height: 0.6976, onset: 0.0313, decline: 0.7 };

    /// The shape `g` of the path from `peak`.
    fn shape(&self, pair: &Pair, peak: &Peak) -> f64 {
        let hertz_force = pair.hertz_stiffness() * (peak.indentation * sqrt(peak.indentation));
        self.shape_of(1.0 - peak.force / hertz_force)
    }

    /// The shape `g` for this relative distance of the force below Hertz's.
    fn shape_of(&self, lag: f64) -> f64 {
        // just above yield the two forces differ only by rounding
        let lag = if lag > 0.0 { lag } else { 0.0 };
        let root = sqrt(lag + self.onset);
        self.height * lag * (1.0 - self.decline * lag * lag * lag) / (root * sqrt(root))
    }

    /// What the hardening and the Poisson's ratio of a body at its own depth `k` change, for a force of `ratio` times its own.
    fn of_body(&self, body: Option<&Yielding>, k: Option<f64>, ratio: f64) -> Recovery {
        let (Some(body), Some(k)) = (body, k.filter(|&k| k > 1.0)) else { return Recovery::NONE };
        let Some(strength) = &body.strength else { return Recovery::NONE };
        let OwnCurve { force, area, .. } = body.curve(&LOADING, k);
        let (phi, area) = (ratio * force, area_factor(ratio) * area);
        let plain_shape = self.shape_of(1.0 - phi / (k * sqrt(k)));
        let plain = (1.0 - plain_shape / 3.0) * phi / sqrt(area);
        let (recovery, shape) = self.own(strength, k, phi);
        Recovery { factor: recovery / plain, difference: shape - plain_shape }
    }

    /// Recovery in yield depths, and shape, of a body under a rigid sphere.
    fn own(&self, strength: &Strength, k: f64, phi: f64) -> (f64, f64) {
        let u = strength.of_dent(k);
        let scaled = k / (u * u);
        let ((force, _), (area, _)) = (LOADING.force_and_slope(scaled), LOADING.area_and_slope(scaled));
        let shape = self.shape_of(1.0 - force / (scaled * sqrt(scaled)));
        let plain = (1.0 - shape / 3.0) * force / sqrt(area);
        let recovery = k - (k - u * u * plain) / strength.dent_divisor();
        let beta = u * u * area * slope_factor(phi / (u * u * u * force));
        (recovery, held(3.0 * (1.0 - recovery * sqrt(beta) / phi)))
    }
}

/// Constants of the matching loading law, in units of the yield point. A scene cannot change them.
const LOADING: loading::Brinell = loading::Brinell::REFERENCE;

impl Unloading for Brinell {
    const SQUARES: bool = true;

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let plain = self.shape(pair, peak);
        let recovery = (3.0 - plain) * peak.force / (4.0 * pair.modulus * peak.contact_radius);
        let residual = residual_after(peak, peak.recovery.factor * recovery);
        let shape = held(plain + peak.recovery.difference);
        path_of_shape(peak, residual, shape)
    }

    fn contact_radius(&self, _pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        peak.contact_radius * (path.stiffness(indentation) / path.stiffness(path.upper))
    }

    fn recovery(&self, bodies: &Construction<'_>, from: &Together) -> Recovery {
        let Together { depths: [soft_depth, hard_depth], strains, ratio, .. } = *from;
        let soft = self.of_body(Some(&bodies.soft), soft_depth, ratio);
        let hard = self.of_body(bodies.hard.as_ref(), hard_depth, ratio);
        let [of_soft, of_hard] = bodies.compliances();
        let [soft_factor, hard_factor] = strains.map(recovery_factor);
        Recovery {
            factor: of_soft * soft.factor * soft_factor + of_hard * hard.factor * hard_factor,
            difference: of_soft * soft.difference + of_hard * hard.difference,
        }
    }
}
