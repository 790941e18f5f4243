//! Approximates power-law hardening by linear hardening, over the strains of the scene's impact.

use super::error::Mistake;
use super::file::PowerLawTable;
use super::softer::Body;
use brinell_contact::rate::FIRST_STRAIN;
use serde::Serialize;
use toml::Spanned;

/// The flow stress `sigma = K eps_p^n`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// `K` [Pa].
    pub coefficient: f64,
    /// `n`.
    pub exponent: f64,
}

/// The linear approximation of a power law.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Linear {
    /// The largest plastic strain in the approximation.
    pub strain: f64,
    /// `S` [Pa].
    pub yield_strength: f64,
    /// `H` [Pa].
    pub hardening_modulus: f64,
    /// Relative error of the flow stress at the largest strain.
    pub error: f64,
}

impl PowerLaw {
    /// The straight line `S + H eps_p` closest to the power law from zero strain to `strain`, by least squares.
    pub fn up_to(&self, strain: f64) -> Linear {
        let PowerLaw { coefficient, exponent: n } = *self;
        let stress = coefficient * libm::pow(strain, n);
        let scale = stress / ((n + 1.0) * (n + 2.0));
        let (yield_strength, rise) = (2.0 * (1.0 - n) * scale, 6.0 * n * scale);
        let error = (yield_strength + rise) / stress - 1.0;
        Linear { strain, yield_strength, hardening_modulus: rise / strain, error }
    }
}

/// The power law of a `body` of the scene.
pub fn check(body: Body, table: &Spanned<PowerLawTable>) -> Result<PowerLaw, Mistake> {
    let PowerLawTable { coefficient, exponent } = table.get_ref();
    let owner = format!("{}.power_law.", body.name());
    super::limits::check_range(("coefficient", "Pa"), &owner, coefficient, 1e-6..=1e18)?;
    super::limits::check_range(("exponent", ""), &owner, exponent, 0.0..=0.9)?;
    Ok(PowerLaw { coefficient: *coefficient.get_ref(), exponent: *exponent.get_ref() })
}

/// Placeholders for the power law until the impact is known.
pub fn placeholder(law: &PowerLaw) -> Linear {
    law.up_to(FIRST_STRAIN)
}
