//! Hunt and Crossley, with the damping factors of later authors.

use super::Damped;
use crate::laws::numbered;
use crate::loading::Elastic;
use crate::losses::{Damper, Form};
use crate::material::Pair;
use libm::{exp, log, log1p};

/// Formula for the damping factor `chi` as a function of the required restitution `e`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(u8)]
pub enum DampingFactor {
    /// The root of `(1 + chi)/(1 - chi e) = exp(chi (1 + e))`. The law then gives the restitution `e` to rounding.
    Exact,
    /// `3 (1 - e)/2`. K. H. Hunt, F. R. E. Crossley, *J. Appl. Mech.* 42 (1975) 440-445.
    HuntCrossley,
    /// `3 (1 - e^2)/4`. H. M. Lankarani, P. E. Nikravesh, *J. Mech. Des.* 112 (1990) 369-376.
    LankaraniNikravesh,
    /// `3 (1 - e)/4`. T. W. Lee, A. C. Wang, *J. Mech. Transm. Autom. Des.* 105 (1983) 534-543.
    LeeWang,
    /// `6 (1 - e)/((2e - 1)^2 + 3)`. R. G. Herbert, D. C. McWhannell, *J. Eng. Ind.* 99 (1977) 792-798.
    HerbertMcwhannell,
    /// `0.75 (1 - e^2) exp(2 (1 - e))`. Q. Zhiying, L. Qishao, *J. Dyn. Control* 4 (2006) 294-298.
    ZhiyingQishao,
    /// `(1 - e^2)/e`. Y. Gonthier et al., *Multibody Syst. Dyn.* 11 (2004) 209-233.
    Gonthier,
    /// `8 (1 - e)/(5 e)`. P. Flores et al., *Multibody Syst. Dyn.* 25 (2011) 357-375.
    Flores,
    /// `3 (1 - e)/(2 e)`. S. Hu, X. Guo, *Multibody Syst. Dyn.* 35 (2015) 447-464.
    HuGuo,
}

numbered!(DampingFactor);

impl DampingFactor {
    /// All factors with their names in a scene.
    pub const ALL: [(&'static str, DampingFactor); 9] = [
        ("exact", DampingFactor::Exact),
        ("hunt-crossley", DampingFactor::HuntCrossley),
        ("lankarani-nikravesh", DampingFactor::LankaraniNikravesh),
        ("lee-wang", DampingFactor::LeeWang),
        ("herbert-mcwhannell", DampingFactor::HerbertMcwhannell),
        ("zhiying-qishao", DampingFactor::ZhiyingQishao),
        ("gonthier", DampingFactor::Gonthier),
        ("flores", DampingFactor::Flores),
        ("hu-guo", DampingFactor::HuGuo),
    ];

    /// `chi` for a restitution `e` in (0, 1].
    pub fn chi(self, e: f64) -> f64 {
        match self {
            DampingFactor::Exact => exact(e),
            DampingFactor::HuntCrossley => 1.5 * (1.0 - e),
            DampingFactor::LankaraniNikravesh => 0.75 * (1.0 - e * e),
            DampingFactor::LeeWang => 0.75 * (1.0 - e),
            DampingFactor::HerbertMcwhannell => 6.0 * (1.0 - e) / ((2.0 * e - 1.0) * (2.0 * e - 1.0) + 3.0),
            DampingFactor::ZhiyingQishao => 0.75 * (1.0 - e * e) * exp(2.0 * (1.0 - e)),
            DampingFactor::Gonthier => (1.0 - e * e) / e,
            DampingFactor::Flores => 1.6 * (1.0 - e) / e,
            DampingFactor::HuGuo => 1.5 * (1.0 - e) / e,
        }
    }
}

/// The root of `ln(1 + chi) - ln(1 - chi e) = chi (1 + e)` in `(0, 1/e)`, by bisection; zero for `e = 1`.
///
/// The left side is larger between the root and `1/e`, so only the trivial root at zero must be excluded. At the lower start
/// the difference is negative: `chi^2 (e^2 - 1)/2 < 0` to leading order.
fn exact(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1.0 / e);
    for _ in 0..HALVINGS {
        let chi = 0.5 * (low + high);
        let rest = 1.0 - chi * e;
        let beyond = if rest > 0.0 { log1p(chi) - log(rest) > chi * (1.0 + e) } else { true };
        if beyond {
            high = chi;
        } else {
            low = chi;
        }
    }
    0.5 * (low + high)
}

/// Enough for every digit of a root that is at least 1e-3 of its bracket.
const HALVINGS: u32 = 64;

/// `F = K_h d^1.5 (1 + chi d'/v0)`, with the closing speed `v0` at first touch.
///
/// With the [exact](DampingFactor::Exact) factor, the restitution is `e` at any speed. The force begins and ends at zero.
///
/// Reference: K. H. Hunt, F. R. E. Crossley, *J. Appl. Mech.* 42 (1975) 440-445. The restitution that each factor gives follows
/// from `(1 + chi)/(1 - chi e) = exp(chi (1 + e))`, which holds for any exponent of the indentation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct HuntCrossley {
    /// Formula for `chi`.
    pub damping_factor: DampingFactor,
}

impl HuntCrossley {
    /// Uses the exact factor.
    pub const REFERENCE: HuntCrossley = HuntCrossley { damping_factor: DampingFactor::Exact };
}

impl Damped for HuntCrossley {
    fn parts(&self, pair: &Pair, restitution: f64, _mass: f64) -> (Elastic, Damper) {
        let damper = Damper { form: Form::Proportional, factor: self.damping_factor.chi(restitution) };
        (Elastic::hertz(pair), damper)
    }

    fn needs_restitution(&self) -> bool {
        true
    }
}
