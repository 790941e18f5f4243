//! Isotropic hardening: the flow stress of a material over its plastic strain.

use libm::pow;

/// Linear hardening: the flow stress is `S + H eps_p`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hardening {
    /// `S`, the yield strength \[Pa\] > 0; infinite for a body that doesn't yield.
    pub yield_strength: f64,
    /// `H`, the hardening modulus \[Pa\], zero at least.
    pub hardening_modulus: f64,
}

impl Hardening {
    /// The same at a flow stress of `factor` times this one, at every strain.
    pub fn times(self, factor: f64) -> Hardening {
        let Hardening { yield_strength, hardening_modulus } = self;
        Hardening { yield_strength: factor * yield_strength, hardening_modulus: factor * hardening_modulus }
    }
}

/// The hardening modulus `H = E_t/(1 - E_t/E)` \[Pa\] of a material with this tangent modulus `E_t` \[Pa\] of the stress over
/// the whole strain, from 0 to below Young's modulus `E` \[Pa\]: elastic and plastic strains add, so that `1/E_t = 1/E + 1/H`.
pub fn modulus_of_tangent(tangent_modulus: f64, youngs_modulus: f64) -> f64 {
    debug_assert!((0.0..youngs_modulus).contains(&tangent_modulus));
    tangent_modulus / (1.0 - tangent_modulus / youngs_modulus)
}

/// The flow stress `sigma = K eps_p^n`.
///
/// Reference: J. H. Hollomon, *Trans. AIME* 162 (1945) 268-290.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// `K`, the flow stress at a strain of 1 \[Pa\] > 0.
    pub coefficient: f64,
    /// `n` \[-\], from 0 to below 1.
    pub exponent: f64,
}

/// The straight line in place of a power law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StraightLine {
    /// The largest plastic strain for which it stands \[-\].
    pub strain: f64,
    /// `S` \[Pa\].
    pub yield_strength: f64,
    /// `H` \[Pa\].
    pub hardening_modulus: f64,
    /// Relative error of the flow stress at the largest strain \[-\].
    pub error: f64,
}

impl PowerLaw {
    /// The straight line `S + H eps_p` closest to the power law from zero strain to `strain` \[-\] > 0, by least squares.
    pub fn up_to(&self, strain: f64) -> StraightLine {
        let PowerLaw { coefficient, exponent: n } = *self;
        let stress = coefficient * pow(strain, n);
        let scale = stress / ((n + 1.0) * (n + 2.0));
        let (yield_strength, rise) = (2.0 * (1.0 - n) * scale, 6.0 * n * scale);
        let error = (yield_strength + rise) / stress - 1.0;
        StraightLine { strain, yield_strength, hardening_modulus: rise / strain, error }
    }
}

impl StraightLine {
    /// The hardening along this line.
    pub fn hardening(&self) -> Hardening {
        Hardening { yield_strength: self.yield_strength, hardening_modulus: self.hardening_modulus }
    }
}
