//! Kuwabara and Kono: a viscoelastic Hertz contact.

use super::Damped;
use crate::loading::Elastic;
use crate::losses::{Damper, Form, Growth};
use crate::material::Pair;

/// `F = K_h (d^1.5 + 1.5 A sqrt(d) d')`, with a relaxation time `A` of the material.
///
/// The restitution falls with the speed: `e = 1 - 1.730173 s + ...` with `s = A (K_h/m)^0.4 v^0.2`.
///
/// Reference: G. Kuwabara, K. Kono, *Jpn. J. Appl. Phys.* 26 (1987) 1230-1233; N. V. Brilliantov et al., *Phys. Rev. E* 53
/// (1996) 5382-5392.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct KuwabaraKono {
    /// Relaxation time `A` \[s\].
    pub relaxation_time: f64,
}

impl KuwabaraKono {
    /// One microsecond, chosen by this project. The user should set the value of the material.
    pub const REFERENCE: KuwabaraKono = KuwabaraKono { relaxation_time: 1e-6 };
}

impl Damped for KuwabaraKono {
    fn parts(&self, pair: &Pair, _restitution: f64, _mass: f64) -> (Elastic, Damper) {
        (Elastic::hertz(pair), Damper { form: Form::Viscous(Growth::Stiffness), factor: self.relaxation_time })
    }
}
