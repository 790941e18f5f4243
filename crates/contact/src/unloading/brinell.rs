//! The unloading of the law `brinell`: recovery and path fitted to finite elements.

use super::{Peak, Unloading, residual_after};
use crate::material::Pair;
use crate::segment::Segment;
use libm::sqrt;

/// `F = F_m ((1 + g) s^1.5 - g s^2)` with `s = (d - d_f)/d_e`. The initial slope is `2 E* a_m`, exact for an elastic
/// unloading: `d_e = (3 - g) F_m / (4 E* a_m)`. Near its end the path has Hertz's exponent.
///
/// `g` depends on `psi = 1 - F_m/(K_h d_m^1.5)`, the relative distance of the force below Hertz's:
/// `g = height psi (1 - decline psi^3) / (psi + onset)^(3/4)`. At yield, `g` and its slope are zero.
///
/// The slope of an elastic unloading is `2 E* a` at every point. The contact radius is therefore the stiffness over
/// `2 E*`. Within 0.4 % of `F_m` of the finite-element results at every point of five depths; recovery within 0.8 %,
/// dissipated energy within 0.5 %, restitution within 0.2 %. Fitted for the loading law `brinell` by
/// `data/fit/fit_brinell.py`.
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
    /// The constants from `data/fit/fit_brinell.py`, for a Poisson's ratio of 0.3 of the yielding body and no hardening, whatever
    /// the pair has: [`Paired`](super::Paired) takes account of both. `decline` is chosen by judgement, since only one depth depends on it.
    pub const REFERENCE: Brinell = Brinell { height: 0.6976, onset: 0.0313, decline: 0.7 };

    /// The shape `g` of the path from `peak`.
    pub(super) fn shape(&self, pair: &Pair, peak: &Peak) -> f64 {
        let hertz_force = pair.hertz_stiffness() * (peak.indentation * sqrt(peak.indentation));
        let lag = 1.0 - peak.force / hertz_force;
        // just above yield the two forces differ only by rounding
        self.shape_of(if lag > 0.0 { lag } else { 0.0 })
    }

    /// The shape `g` for this relative distance of the force below Hertz's.
    pub(super) fn shape_of(&self, lag: f64) -> f64 {
        let root = sqrt(lag + self.onset);
        self.height * lag * (1.0 - self.decline * lag * lag * lag) / (root * sqrt(root))
    }
}

/// The path from `peak` to the `residual` indentation \[m\] with this shape `g`.
pub(super) fn path_to(peak: &Peak, residual: f64, shape: f64) -> Segment {
    let recovery = peak.indentation - residual;
    Segment {
        lower: residual,
        upper: peak.indentation,
        origin: residual,
        power: (1.0 + shape) * peak.force / (recovery * sqrt(recovery)),
        square: -shape * peak.force / (recovery * recovery),
        ..Segment::NOTHING
    }
}

impl Unloading for Brinell {
    const SQUARES: bool = true;

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let shape = self.shape(pair, peak);
        let recovery = (3.0 - shape) * peak.force / (4.0 * pair.modulus * peak.contact_radius);
        path_to(peak, residual_after(peak, recovery), shape)
    }

    fn contact_radius(&self, pair: &Pair, _peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        path.stiffness(indentation) / (2.0 * pair.modulus)
    }
}
