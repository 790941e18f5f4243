//! The unloading of the law `brinell` for a target that hardens, or with a Poisson's ratio other than 0.3.

use super::brinell::path_to;
use super::{Brinell, Peak, Unloading, residual_after};
use crate::loading;
use crate::material::Pair;
use crate::segment::Segment;
use crate::strength::{Strength, held, slope_factor};
use libm::{cbrt, sqrt};

/// [`Brinell`] with the effective [`Strength`] of the material, in units of its yield point, `k = d/d_Y` and `phi = F/F_Y`:
///
/// - dent `k_f = (k - u^2 r(k/u^2))/(1 + 1.584 h)`, with the recovery `r` of the law itself and the strength `u` of
///   the dent;
/// - shape `g = 3 (1 - (k - k_f) sqrt(beta)/phi)`, between 0 and 0.75: a slope `2 E* b` at the peak with
///   `b^2 = R d_Y beta`, `beta = u^2 A(k/u^2) (phi/(u^3 Phi(k/u^2)))^-1.111`. `b` is the contact radius to some percent.
///
/// The contact radius on the path is proportional to the stiffness. Within 0.9 % of `F_m` of the finite-element
/// curves in `data/truth/materials`, restitution within 0.6 %. Made for the loading law
/// [`Strengthened`](crate::loading::Strengthened). Without hardening and with a Poisson's ratio of 0.3 it
/// equals the law `brinell` bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Strengthened {
    /// The law for a perfectly plastic target.
    pub law: Brinell,
    /// Hardening modulus of the target \[Pa\].
    pub hardening_modulus: f64,
}

/// Constants of the matching loading law, in units of the yield point. A scene cannot change them.
const LOADING: loading::Brinell = loading::Brinell::REFERENCE;

impl Strengthened {
    /// The elastic recovery of the law itself for `x >= 1` \[d_y\], with the force there.
    fn recovery(&self, x: f64, force: f64, area: f64) -> f64 {
        let lag = 1.0 - force / (x * sqrt(x));
        let shape = self.law.shape_of(if lag > 0.0 { lag } else { 0.0 });
        (1.0 - shape / 3.0) * force / sqrt(area)
    }
}

impl Unloading for Strengthened {
    const SQUARES: bool = true;

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let Some(strength) = Strength::of(pair, self.hardening_modulus) else { return self.law.path(pair, peak) };
        let root = cbrt(peak.yield_force / pair.hertz_stiffness());
        let unit = root * root;
        let (k, phi) = (peak.indentation / unit, peak.force / peak.yield_force);
        let u = strength.of_dent(k);
        let scaled = k / (u * u);
        let ((force, _), area) = (LOADING.force_and_slope(scaled), LOADING.area(scaled));
        let dent = (k - u * u * self.recovery(scaled, force, area)) / strength.dent_divisor();
        let residual = residual_after(peak, peak.indentation - dent * unit);
        let recovery = peak.indentation - residual;
        let beta = u * u * area * slope_factor(phi / (u * u * u * force));
        let shape = held(3.0 * (1.0 - recovery / unit * sqrt(beta) / phi));
        path_to(peak, residual, shape)
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        match Strength::of(pair, self.hardening_modulus) {
            Some(_) => peak.contact_radius * (path.stiffness(indentation) / path.stiffness(path.upper)),
            None => self.law.contact_radius(pair, peak, path, indentation),
        }
    }

    fn strengthened_by(self, factor: f64) -> Strengthened {
        Strengthened { hardening_modulus: factor * self.hardening_modulus, ..self }
    }
}
