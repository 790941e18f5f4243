//! The numbers that a scene gives for all contacts, or for one: of the bodies, or from their materials.

use super::checks::{check_limits, check_range};
use super::file::{Impactor, Target};
use super::{Mistake, Parameter};
use crate::nearest::unknown;
use crate::table::{self, MATERIALS};
use std::ops::{Range, RangeInclusive};
use toml::Spanned;

/// What the contacts of a scene may give themselves, in the order of the table.
const PROPERTIES: [&str; 11] = [
    "impactor.radius",
    "impactor.youngs_modulus",
    "impactor.poissons_ratio",
    "target.radius",
    "target.youngs_modulus",
    "target.poissons_ratio",
    "target.yield_strength",
    DENSITY,
    IMPACTOR_DENSITY,
    MASS,
    "initial_gap",
];

/// A property that the scene gives for all contacts elsewhere.
pub const MASS: &str = "effective_mass";

/// Properties that are no variables of the FMU.
pub const DENSITY: &str = "target.density";
pub const IMPACTOR_DENSITY: &str = "impactor.density";

/// Allowed densities [kg/m^3]: from thin gases to what no solid is.
const DENSITIES: RangeInclusive<f64> = 1e-3..=1e9;

/// The numbers of one level, the whole scene or one contact, each with its place in the file.
pub struct Numbers(Vec<(&'static str, Spanned<f64>)>);

impl Numbers {
    /// Those of a contact that has none for itself.
    pub fn none() -> Numbers {
        Numbers(Vec::new())
    }

    /// An explicit number overrides that of a material.
    pub fn of(
        impactor: &Impactor,
        target: &Target,
        mass: Option<&Spanned<f64>>,
        initial_gap: Option<&Spanned<f64>>,
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
        let given = [
            impactor.radius.clone(),
            impactor.youngs_modulus.clone().or_else(|| of_ball(|material| material.youngs_modulus)),
            impactor.poissons_ratio.clone().or_else(|| of_ball(|material| material.poissons_ratio)),
            target.radius.clone(),
            target.youngs_modulus.clone().or_else(|| of_material(|material| material.youngs_modulus)),
            target.poissons_ratio.clone().or_else(|| of_material(|material| material.poissons_ratio)),
            target.yield_strength.clone().or_else(|| of_material(|material| material.yield_strength)),
            target.density.clone().or_else(|| of_material(|material| material.density)),
            impactor.density.clone().or_else(|| of_ball(|material| material.density)),
            mass.cloned(),
            initial_gap.cloned(),
        ];
        let numbers = PROPERTIES.into_iter().zip(given);
        Ok(Numbers(numbers.filter_map(|(name, value)| Some((name, value?))).collect()))
    }

    pub fn get(&self, name: &str) -> Option<&Spanned<f64>> {
        self.0.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    pub fn remove(&mut self, name: &str) {
        self.0.retain(|(known, _)| *known != name);
    }

    /// As parameters that can be set, where `wanted` says so.
    pub fn parameters(&self, wanted: impl Fn(&str) -> bool) -> Vec<Parameter> {
        let wanted = self.0.iter().filter(|(name, _)| ![DENSITY, IMPACTOR_DENSITY].contains(name) && wanted(name));
        wanted.map(|(name, value)| Parameter::shared(name, *value.get_ref(), true)).collect()
    }
}

fn find_material(name: &Spanned<String>) -> Result<&'static table::Material, Mistake> {
    MATERIALS.iter().find(|material| &material.name == name.get_ref()).ok_or_else(|| {
        let names = MATERIALS.iter().map(|material| material.name.as_str());
        Mistake(name.span(), unknown("material", name.get_ref(), names))
    })
}

/// Refuses a number out of range; `owner` comes before its name in the message.
pub fn check_numbers(numbers: &Numbers, owner: &str) -> Result<(), Mistake> {
    numbers.0.iter().try_for_each(|(name, value)| match *name {
        DENSITY | IMPACTOR_DENSITY => check_range((name, "kg/m^3"), owner, value, DENSITIES),
        _ => check_limits(name, owner, value),
    })
}
