//! The numbers that a scene gives for all contacts, or for one contact: directly, or by a material.

use super::error::Mistake;
use super::file::{Impactor, Target};
use super::group::Parameter;
use super::hardening::{Flow, Given};
use super::limits::{check_limits, check_range};
use crate::layout::shortened;
use crate::nearest::unknown;
use crate::table::{self, MATERIALS};
use std::ops::{Range, RangeInclusive};
use toml::Spanned;

/// The properties that a contact may override, in the order of the table.
const PROPERTIES: [&str; 15] = [
    "impactor.radius",
    "impactor.youngs_modulus",
    "impactor.poissons_ratio",
    IMPACTOR_STRENGTH,
    IMPACTOR_HARDENING,
    "target.radius",
    "target.youngs_modulus",
    "target.poissons_ratio",
    "target.yield_strength",
    HARDENING,
    DENSITY,
    IMPACTOR_DENSITY,
    MASS,
    "initial_gap",
    FRICTION,
];

/// A property that the scene gives elsewhere for all contacts.
pub const MASS: &str = "effective_mass";

/// A property that every contact has as soon as the scene gives it for all.
pub const FRICTION: &str = "friction.coefficient";

/// Properties that only some laws use.
pub const HARDENING: &str = "target.hardening_modulus";
pub const IMPACTOR_HARDENING: &str = "impactor.hardening_modulus";

/// A property that is a parameter only where the impactor may yield.
pub const IMPACTOR_STRENGTH: &str = "impactor.yield_strength";

/// Properties that are not variables of the FMU.
pub const DENSITY: &str = "target.density";
pub const IMPACTOR_DENSITY: &str = "impactor.density";

/// Allowed densities [kg/m^3]: from thin gases to beyond any solid.
const DENSITIES: RangeInclusive<f64> = 1e-3..=1e9;

/// The numbers at one level, the whole scene or one contact, with their places in the file.
pub struct Numbers {
    values: Vec<(&'static str, Spanned<f64>)>,
    /// Whether the scene gives the strength of the impactor at this level, rather than by a material.
    pub gives_impactor_strength: bool,
    /// Whether the impactor may be the softer body, so that its strength is a parameter.
    pub impactor_may_yield: bool,
}

impl Numbers {
    /// Those of a contact without its own numbers.
    pub fn none() -> Numbers {
        Numbers { values: Vec::new(), gives_impactor_strength: false, impactor_may_yield: false }
    }

    /// An explicit number overrides that of a material.
    pub fn of(
        impactor: &Impactor,
        target: &Target,
        mass: Option<&Spanned<f64>>,
        initial_gap: Option<&Spanned<f64>>,
        friction: Option<&Spanned<f64>>,
        shared: Option<&Numbers>,
    ) -> Result<Numbers, Mistake> {
        let find = |name: &Option<Spanned<String>>| match name {
            Some(name) => Ok(Some((find_material(name)?, name.span()))),
            None => Ok(None),
        };
        let (of_impactor, of_target) = (find(&impactor.material)?, find(&target.material)?);
        let from = |material: &Option<(&table::Material, Range<usize>)>, value: fn(&table::Material) -> f64| {
            let (material, span) = material.as_ref()?;
            Some(Spanned::new(span.clone(), value(material)))
        };
        let of_material = |value| from(&of_target, value);
        let of_ball = |value| from(&of_impactor, value);
        let modulus = target.youngs_modulus.clone().or_else(|| of_material(|material| material.youngs_modulus));
        let youngs_modulus = modulus.as_ref().or_else(|| shared?.get("target.youngs_modulus"));
        let Flow { yield_strength, hardening_modulus } = Given::target(target).flow(youngs_modulus)?;
        let modulus_of_ball = impactor.youngs_modulus.clone().or_else(|| of_ball(|material| material.youngs_modulus));
        let given_for_ball = Given::impactor(impactor);
        let of_shared = || shared?.get("impactor.youngs_modulus");
        let ball = given_for_ball.flow(modulus_of_ball.as_ref().or_else(of_shared))?;
        let given = [
            impactor.radius.clone(),
            modulus_of_ball,
            impactor.poissons_ratio.clone().or_else(|| of_ball(|material| material.poissons_ratio)),
            ball.yield_strength.or_else(|| of_ball(|material| material.yield_strength)),
            ball.hardening_modulus,
            target.radius.clone(),
            modulus,
            target.poissons_ratio.clone().or_else(|| of_material(|material| material.poissons_ratio)),
            yield_strength.or_else(|| of_material(|material| material.yield_strength)),
            hardening_modulus,
            target.density.clone().or_else(|| of_material(|material| material.density)),
            impactor.density.clone().or_else(|| of_ball(|material| material.density)),
            mass.cloned(),
            initial_gap.cloned(),
            friction.cloned(),
        ];
        let numbers = PROPERTIES.into_iter().zip(given);
        Ok(Numbers {
            values: numbers.filter_map(|(name, value)| Some((name, value?))).collect(),
            gives_impactor_strength: given_for_ball.is_any() || impactor.rate.is_some(),
            impactor_may_yield: false,
        })
    }

    pub fn get(&self, name: &str) -> Option<&Spanned<f64>> {
        self.values.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    pub fn remove(&mut self, name: &str) {
        self.values.retain(|(known, _)| *known != name);
    }

    /// The numbers as parameters; those that satisfy `wanted` can be set.
    pub fn parameters(&self, wanted: impl Fn(&str) -> bool) -> Vec<Parameter> {
        let is_parameter = |name: &str| match name {
            DENSITY | IMPACTOR_DENSITY => false,
            IMPACTOR_STRENGTH | IMPACTOR_HARDENING => self.impactor_may_yield,
            _ => true,
        };
        let wanted = self.values.iter().filter(|(name, _)| is_parameter(name) && wanted(name));
        wanted.map(|(name, value)| Parameter::shared(name, *value.get_ref(), true)).collect()
    }
}

fn find_material(name: &Spanned<String>) -> Result<&'static table::Material, Mistake> {
    MATERIALS.iter().find(|material| &material.name == name.get_ref()).ok_or_else(|| {
        let asked = name.get_ref();
        let has_number =
            |material: &&table::Material| material.number.as_ref().is_some_and(|number| asked.contains(number));
        if let Some(material) = MATERIALS.iter().find(has_number) {
            let message = format!("unknown material `{}`; its name here is `{}`", shortened(asked), material.name);
            return Mistake(name.span(), message);
        }
        let names = MATERIALS.iter().map(|material| material.name.as_str());
        Mistake(name.span(), unknown("material", asked, names))
    })
}

/// Rejects a number outside its range. `owner` precedes its name in the message.
pub fn check_numbers(numbers: &Numbers, owner: &str) -> Result<(), Mistake> {
    numbers.values.iter().try_for_each(|(name, value)| match *name {
        DENSITY | IMPACTOR_DENSITY => check_range((name, "kg/m^3"), owner, value, DENSITIES),
        _ => check_limits(name, owner, value),
    })
}
