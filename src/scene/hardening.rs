//! Yield strength and hardening of a body, from any of the ways to specify them.

use super::error::Mistake;
use super::file::{Impactor, PowerLawTable, Target};
use super::power_law;
use super::softer::Body;
use crate::numbers::in_message;
use toml::Spanned;

/// Yield strength and hardening modulus [Pa], each with its position in the file.
#[derive(Default)]
pub struct Flow {
    pub yield_strength: Option<Spanned<f64>>,
    pub hardening_modulus: Option<Spanned<f64>>,
}

/// What a scene says about the flow stress of a body.
pub struct Given<'a> {
    body: Body,
    yield_strength: Option<&'a Spanned<f64>>,
    hardening_modulus: Option<&'a Spanned<f64>>,
    tangent_modulus: Option<&'a Spanned<f64>>,
    power_law: Option<&'a Spanned<PowerLawTable>>,
}

impl Given<'_> {
    pub fn impactor(impactor: &Impactor) -> Given<'_> {
        Given {
            body: Body::Impactor,
            yield_strength: impactor.yield_strength.as_ref(),
            hardening_modulus: impactor.hardening_modulus.as_ref(),
            tangent_modulus: impactor.tangent_modulus.as_ref(),
            power_law: impactor.power_law.as_ref(),
        }
    }

    pub fn target(target: &Target) -> Given<'_> {
        Given {
            body: Body::Target,
            yield_strength: target.yield_strength.as_ref(),
            hardening_modulus: target.hardening_modulus.as_ref(),
            tangent_modulus: target.tangent_modulus.as_ref(),
            power_law: target.power_law.as_ref(),
        }
    }

    /// Whether the scene gives anything.
    pub fn is_any(&self) -> bool {
        self.numbers().iter().any(|(_, value)| value.is_some()) || self.power_law.is_some()
    }

    fn numbers(&self) -> [(&'static str, Option<&Spanned<f64>>); 3] {
        [
            ("yield_strength", self.yield_strength),
            ("hardening_modulus", self.hardening_modulus),
            ("tangent_modulus", self.tangent_modulus),
        ]
    }

    /// The flow stress for this Young's modulus. It is given by two numbers, by a tangent modulus `E_t = H/(1 + H/E)`, or by a
    /// power law; placeholders represent the power law until the impact is known.
    pub fn flow(&self, youngs_modulus: Option<&Spanned<f64>>) -> Result<Flow, Mistake> {
        if let Some(table) = self.power_law {
            self.check_alone()?;
            let line = power_law::placeholder(&power_law::check(self.body, table)?);
            let at = |value| Some(Spanned::new(table.span(), value));
            return Ok(Flow { yield_strength: at(line.yield_strength), hardening_modulus: at(line.hardening_modulus) });
        }
        let hardening_modulus = match self.tangent_modulus {
            Some(tangent) => Some(self.of_tangent(tangent, youngs_modulus)?),
            None => self.hardening_modulus.cloned(),
        };
        Ok(Flow { yield_strength: self.yield_strength.cloned(), hardening_modulus })
    }

    /// Rejects numbers in addition to a power law.
    fn check_alone(&self) -> Result<(), Mistake> {
        let others = self.numbers();
        let Some((name, value)) = others.iter().find_map(|(name, value)| Some((name, (*value)?))) else {
            return Ok(());
        };
        let body = self.body.name();
        let message = format!(
            "{body}.{name} and {body}.power_law say the same: yield strength and hardening follow from the power law"
        );
        Err(Mistake(value.span(), message))
    }

    /// The hardening modulus for a `tangent` modulus.
    fn of_tangent(
        &self,
        tangent: &Spanned<f64>,
        youngs_modulus: Option<&Spanned<f64>>,
    ) -> Result<Spanned<f64>, Mistake> {
        let body = self.body.name();
        let wrong = |message: String| Err(Mistake(tangent.span(), message));
        if self.hardening_modulus.is_some() {
            return wrong(format!(
                "{body}.tangent_modulus and {body}.hardening_modulus say the same: give one of them"
            ));
        }
        let Some(modulus) = youngs_modulus.map(|modulus| *modulus.get_ref()) else {
            return wrong(format!("{body}.tangent_modulus needs {body}.youngs_modulus, or a material"));
        };
        let given = *tangent.get_ref();
        // NaN is outside every range
        if !(0.0..modulus).contains(&given) {
            return wrong(format!(
                "{body}.tangent_modulus = {} is out of range: allowed is 0 to below youngs_modulus = {} Pa",
                in_message(given),
                in_message(modulus)
            ));
        }
        Ok(Spanned::new(tangent.span(), given / (1.0 - given / modulus)))
    }
}

/// Rejects keys in the bodies of the contact `name` that apply to all contacts.
pub fn check_contact(name: &str, impactor: &Impactor, target: &Target) -> Result<(), Mistake> {
    let keys = [
        ("impactor", "power_law", impactor.power_law.as_ref().map(Spanned::span)),
        ("impactor", "rate", impactor.rate.as_ref().map(Spanned::span)),
        ("target", "power_law", target.power_law.as_ref().map(Spanned::span)),
        ("target", "rate", target.rate.as_ref().map(Spanned::span)),
        ("target", "plate_thickness", target.plate_thickness.as_ref().map(Spanned::span)),
    ];
    match keys.into_iter().find_map(|(body, key, span)| Some((body, key, span?))) {
        Some((body, key, span)) => {
            Err(Mistake(span, format!("contact `{name}`: {body}.{key} belongs to [{body}], for all contacts")))
        }
        None => Ok(()),
    }
}
