//! Yield strength and hardening of a target, from any of the ways to specify them.

use super::Mistake;
use super::file::Target;
use super::power_law;
use toml::Spanned;

/// Yield strength and hardening modulus [Pa], each with its position in the file.
#[derive(Default)]
pub struct Flow {
    pub yield_strength: Option<Spanned<f64>>,
    pub hardening_modulus: Option<Spanned<f64>>,
}

/// The flow stress of `target` for this Young's modulus. It is given by two numbers, by a tangent modulus
/// `E_t = H/(1 + H/E)`, or by a power law; placeholders represent the power law until the impact is known.
pub fn of(target: &Target, youngs_modulus: Option<&Spanned<f64>>) -> Result<Flow, Mistake> {
    if let Some(table) = &target.power_law {
        check_alone(target)?;
        let line = power_law::placeholder(&power_law::check(table)?);
        let at = |value| Some(Spanned::new(table.span(), value));
        return Ok(Flow { yield_strength: at(line.yield_strength), hardening_modulus: at(line.hardening_modulus) });
    }
    let hardening_modulus = match &target.tangent_modulus {
        Some(tangent) => Some(of_tangent(target, tangent, youngs_modulus)?),
        None => target.hardening_modulus.clone(),
    };
    Ok(Flow { yield_strength: target.yield_strength.clone(), hardening_modulus })
}

/// Rejects numbers in addition to a power law.
fn check_alone(target: &Target) -> Result<(), Mistake> {
    let others = [
        ("yield_strength", &target.yield_strength),
        ("hardening_modulus", &target.hardening_modulus),
        ("tangent_modulus", &target.tangent_modulus),
    ];
    let Some((name, value)) = others.iter().find_map(|(name, value)| Some((name, value.as_ref()?))) else {
        return Ok(());
    };
    let message = format!(
        "target.{name} and target.power_law say the same: yield strength and hardening follow from the power law"
    );
    Err(Mistake(value.span(), message))
}

/// The hardening modulus for a `tangent` modulus.
fn of_tangent(
    target: &Target,
    tangent: &Spanned<f64>,
    youngs_modulus: Option<&Spanned<f64>>,
) -> Result<Spanned<f64>, Mistake> {
    let wrong = |message: String| Err(Mistake(tangent.span(), message));
    if target.hardening_modulus.is_some() {
        return wrong("target.tangent_modulus and target.hardening_modulus say the same: give one of them".into());
    }
    let Some(modulus) = youngs_modulus.map(|modulus| *modulus.get_ref()) else {
        return wrong("target.tangent_modulus needs target.youngs_modulus, or a material".into());
    };
    let given = *tangent.get_ref();
    // NaN is outside every range
    if !(0.0..modulus).contains(&given) {
        return wrong(format!(
            "target.tangent_modulus = {given:?} is out of range: allowed is 0.0 to below youngs_modulus = {modulus:?} Pa"
        ));
    }
    Ok(Spanned::new(tangent.span(), given / (1.0 - given / modulus)))
}

/// Rejects keys in the target of the contact `name` that apply to all contacts.
pub fn check_contact(name: &str, target: &Target) -> Result<(), Mistake> {
    let power_law = target.power_law.as_ref().map(|table| ("power_law", table.span()));
    let rate = target.rate.as_ref().map(|table| ("rate", table.span()));
    let plate = target.plate_thickness.as_ref().map(|thickness| ("plate_thickness", thickness.span()));
    match power_law.or(rate).or(plate) {
        Some((key, span)) => {
            Err(Mistake(span, format!("contact `{name}`: target.{key} belongs to [target], for all contacts")))
        }
        None => Ok(()),
    }
}
