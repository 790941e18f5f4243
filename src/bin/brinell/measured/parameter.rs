//! The parameters that can be fitted.

use super::Flow;
use crate::scene::{Body, QuasiStatic, Rate};

/// A parameter that a measurement can determine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
#[clap(rename_all = "snake_case")]
pub enum Fit {
    /// Quasi-static yield strength of the softer body [Pa]
    YieldStrength,
    /// Hardening modulus of the softer body [Pa]
    HardeningModulus,
    /// Constant of the rate model: c of johnson-cook, d of cowper-symonds
    Rate,
}

impl Fit {
    /// The name of the parameter in the scene, its unit, and its value.
    ///
    /// # Errors
    /// A sentence if the scene has no such parameter.
    pub fn of(self, flow: &Flow) -> Result<(&'static str, &'static str, f64), String> {
        let rate = |target, impactor| if flow.body == Body::Target { target } else { impactor };
        match (self, flow.rate) {
            (Fit::YieldStrength, _) => Ok((flow.body.yield_strength(), "Pa", flow.hardening.yield_strength)),
            (Fit::HardeningModulus, _) => Ok((flow.body.hardening_modulus(), "Pa", flow.hardening.hardening_modulus)),
            (Fit::Rate, Some(Rate::JohnsonCook { c, .. })) => Ok((rate("target.rate.c", "impactor.rate.c"), "", c)),
            (Fit::Rate, Some(Rate::CowperSymonds { d, .. })) => {
                Ok((rate("target.rate.d", "impactor.rate.d"), "1/s", d))
            }
            (Fit::Rate, None) => {
                Err(format!("--fit rate needs a rate model in the scene: give {}.rate", flow.body.name()))
            }
        }
    }

    /// Whether the logarithm of the parameter is fitted: it is positive, and its errors are ratios.
    pub fn is_logarithmic(self, flow: &Flow) -> bool {
        matches!((self, flow.rate), (Fit::YieldStrength, _) | (Fit::Rate, Some(Rate::CowperSymonds { .. })))
    }

    /// Size of the fitted variable in the unit of the parameter.
    pub fn size(self, modulus: f64) -> f64 {
        if self == Fit::HardeningModulus { modulus } else { 1.0 }
    }

    /// `flow` with this value of the parameter.
    pub fn set(self, flow: Flow, value: f64) -> Flow {
        let QuasiStatic { yield_strength, hardening_modulus } = flow.hardening;
        let with = |yield_strength, hardening_modulus| QuasiStatic { yield_strength, hardening_modulus };
        match (self, flow.rate) {
            (Fit::YieldStrength, _) => Flow { hardening: with(value, hardening_modulus), ..flow },
            (Fit::HardeningModulus, _) => Flow { hardening: with(yield_strength, value), ..flow },
            (Fit::Rate, Some(Rate::JohnsonCook { reference_rate, .. })) => {
                Flow { rate: Some(Rate::JohnsonCook { c: value, reference_rate }), ..flow }
            }
            (Fit::Rate, Some(Rate::CowperSymonds { q, .. })) => {
                Flow { rate: Some(Rate::CowperSymonds { d: value, q }), ..flow }
            }
            (Fit::Rate, None) => flow,
        }
    }
}
