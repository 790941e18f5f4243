//! The unloading of the law `brinell` for any two bodies.

use super::brinell::path_to;
use super::{Brinell, Peak, Unloading, residual_after};
use crate::large_strain::recovery_factor;
use crate::loading;
use crate::material::Pair;
use crate::segment::Segment;
use crate::strength::{Strength, area_factor, held, slope_factor};
use crate::two_bodies::{Construction, OwnCurve, Together, TwoBodies, Yielding};
use libm::sqrt;

/// [`Brinell`] with contact radius and effective modulus of two bodies, for the loading law [`Paired`](crate::loading::Paired).
///
/// Hardening and other Poisson's ratios change recovery and shape of each body that yields. Alone under a rigid sphere, a body has, in
/// units of its yield point, `k = d/d_Y` and `phi = F/F_Y`:
///
/// - dent `k_f = (k - u^2 r(k/u^2))/(1 + 1.584 h)`, with the recovery `r` of the law itself and the strength `u` of the dent;
/// - shape `g_i = 3 (1 - (k - k_f) sqrt(beta)/phi)`: a slope `2 E* b` at the peak with `b^2 = R d_Y beta`,
///   `beta = u^2 A(k/u^2) (phi/(u^3 Phi(k/u^2)))^-1.111`. `b` is the contact radius to some percent.
///
/// Relative to what the plain formula gives for it, this is a factor `c_i` of the recovery and a difference of the shape. Two bodies
/// have the sums of both, weighted with `E*/E_i`: recovery `c (3 - g) F_m/(4 E* a_m)`, shape `g'` between 0 and 0.75. So a single body
/// under a rigid sphere, and two equal ones, have exactly its own recovery and shape.
///
/// The contact radius on the path is proportional to the stiffness. Rigid sphere: within 0.9 % of `F_m` of the finite-element curves in
/// `data/truth/materials`, restitution within 0.6 %. Two bodies: see [`two_bodies`](crate::two_bodies). [Large
/// strain](mod@crate::large_strain) makes the recovery of each body smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Paired {
    /// The law of one body under a rigid sphere.
    pub law: Brinell,
    /// Hardening of the softer body, and the harder body.
    pub bodies: TwoBodies,
}

/// Constants of the matching loading law, in units of the yield point. A scene cannot change them.
const LOADING: loading::Brinell = loading::Brinell::REFERENCE;

/// Recovery and shape of a body by itself, relative to those of the plain formula.
struct Correction {
    /// Factor of the recovery.
    factor: f64,
    /// Difference of the shapes.
    difference: f64,
}

impl Correction {
    const NONE: Correction = Correction { factor: 1.0, difference: 0.0 };
}

impl Paired {
    /// The shape for a force of `phi` times the yield force at `k` yield depths.
    fn shape(&self, k: f64, phi: f64) -> f64 {
        let lag = 1.0 - phi / (k * sqrt(k));
        self.law.shape_of(if lag > 0.0 { lag } else { 0.0 })
    }

    /// What the hardening and the Poisson's ratio of a body at its own depth `k` change, for a force of `ratio` times its own.
    fn correction(&self, body: Option<&Yielding>, k: Option<f64>, ratio: f64) -> Correction {
        let (Some(body), Some(k)) = (body, k.filter(|&k| k > 1.0)) else { return Correction::NONE };
        let Some(strength) = &body.strength else { return Correction::NONE };
        let OwnCurve { force, area, .. } = body.curve(&LOADING, k);
        let (phi, area) = (ratio * force, area_factor(ratio) * area);
        let plain_shape = self.shape(k, phi);
        let plain = (1.0 - plain_shape / 3.0) * phi / sqrt(area);
        let (recovery, shape) = self.own(strength, k, phi);
        Correction { factor: recovery / plain, difference: shape - plain_shape }
    }

    /// Recovery in yield depths, and shape, of a body under a rigid sphere.
    fn own(&self, strength: &Strength, k: f64, phi: f64) -> (f64, f64) {
        let u = strength.of_dent(k);
        let scaled = k / (u * u);
        let ((force, _), (area, _)) = (LOADING.force_and_slope(scaled), LOADING.area_and_slope(scaled));
        let plain = (1.0 - self.shape(scaled, force) / 3.0) * force / sqrt(area);
        let recovery = k - (k - u * u * plain) / strength.dent_divisor();
        let beta = u * u * area * slope_factor(phi / (u * u * u * force));
        (recovery, held(3.0 * (1.0 - recovery * sqrt(beta) / phi)))
    }
}

impl Unloading for Paired {
    const SQUARES: bool = true;

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let bodies = Construction::of(&LOADING, pair, &self.bodies);
        let plain = self.law.shape(pair, peak);
        let recovery = (3.0 - plain) * peak.force / (4.0 * pair.modulus * peak.contact_radius);
        let force = peak.force / (pair.radius * pair.radius);
        let Together { depths: [soft_depth, hard_depth], strains, ratio, .. } =
            bodies.at_indentation(peak.indentation / pair.radius, force);
        let soft = self.correction(Some(&bodies.soft), soft_depth, ratio);
        let hard = self.correction(bodies.hard.as_ref(), hard_depth, ratio);
        let [of_soft, of_hard] = [bodies.soft.modulus, bodies.hard_modulus].map(|modulus| pair.modulus / modulus);
        let [soft_factor, hard_factor] = strains.map(recovery_factor);
        let factor = of_soft * soft.factor * soft_factor + of_hard * hard.factor * hard_factor;
        let shape = held(plain + of_soft * soft.difference + of_hard * hard.difference);
        path_to(peak, residual_after(peak, factor * recovery), shape)
    }

    fn contact_radius(&self, _pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        peak.contact_radius * (path.stiffness(indentation) / path.stiffness(path.upper))
    }

    fn strengthened_by(self, factor: f64, others: f64) -> Paired {
        Paired { bodies: self.bodies.strengthened_by(factor, others), ..self }
    }
}
