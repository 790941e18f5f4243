//! The tables in `modelDescription/`, as data: variables, units, materials, laws.

use serde::Deserialize;
use serde::de::IgnoredAny;
use std::sync::LazyLock;

/// A variable that a unit can have; see `modelDescription/variables.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variable {
    pub name: String,
    /// Variant of the library's enum.
    pub rust: String,
    #[serde(default)]
    pub r#type: Type,
    pub causality: Causality,
    pub unit: Option<String>,
    pub display_unit: Option<String>,
    pub minimum: Option<f64>,
    pub maximum: Option<f64>,
    /// Parameters that the value before the first step follows.
    #[serde(default)]
    pub depends_on: Vec<String>,
    pub nominal_from: Option<String>,
    #[serde(default)]
    pub follows_rate: Follows,
    pub description: String,
    /// The values of an enumeration, counted from 0.
    #[serde(default)]
    pub items: Vec<Item>,
    /// What is said instead in units of another kind.
    #[serde(default)]
    pub instead: Vec<Instead>,
}

/// A value of an enumeration.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Item {
    pub name: String,
    pub description: String,
}

/// What is said of a variable in units of one kind.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instead {
    pub of: Kind,
    pub description: String,
    /// It may be negative, whatever the table says.
    #[serde(default)]
    pub negative: bool,
}

/// A kind of unit in which variables mean something else.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The force depends on the rate.
    RateDependent,
    /// The unit knows the mass, and its master steps all units at once.
    Parallel,
    /// The unit knows the mass, and has an input for the acceleration.
    AccelerationInput,
    /// The unit knows the mass.
    MassKnown,
    /// Its laws can give back more than they took.
    MakesEnergy,
    /// Its laws lose less where the dent is deeper.
    LosesLess,
}

impl Variable {
    /// What is said of the variable in a unit of these `kinds`.
    pub fn description(&self, kinds: &[Kind]) -> &str {
        self.instead(kinds).map_or(&self.description, |instead| &instead.description)
    }

    /// Its smallest value in a unit of these `kinds`.
    pub fn minimum(&self, kinds: &[Kind]) -> Option<f64> {
        self.minimum.filter(|_| !self.instead(kinds).is_some_and(|instead| instead.negative))
    }

    fn instead(&self, kinds: &[Kind]) -> Option<&Instead> {
        self.instead.iter().find(|instead| kinds.contains(&instead.of))
    }
}

/// Whether an output follows the rate at the same instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Follows {
    #[default]
    Never,
    /// Where the law does.
    WithLaw,
    /// Before the first step only.
    AtStart,
    Always,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Type {
    #[default]
    Real,
    /// Read as an integer.
    Enumeration,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Causality {
    Input,
    Output,
    Parameter,
}

/// A unit with its SI exponents; see `modelDescription/units.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unit {
    pub name: String,
    #[serde(default)]
    pub kg: i32,
    #[serde(default)]
    pub m: i32,
    #[serde(default)]
    pub s: i32,
    pub display: Vec<DisplayUnit>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DisplayUnit {
    pub name: String,
    pub factor: f64,
}

/// A built-in material; see `modelDescription/materials.toml`.
#[derive(Debug, Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    pub name: String,
    /// [Pa]
    pub youngs_modulus: f64,
    pub poissons_ratio: f64,
    /// [Pa]
    pub yield_strength: f64,
    /// [kg/m^3]
    pub density: f64,
    pub source: String,
}

/// What the documentation says of a law; see `modelDescription/laws.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Law {
    pub name: String,
    /// What the law is in Rust, and whether it has a form with the passivity guard: for `build/laws.rs`.
    #[serde(rename = "rust")]
    _rust: IgnoredAny,
    #[serde(default, rename = "guarded")]
    _guarded: IgnoredAny,
    /// How exact the tangential force is, or why there is none: for the library in Rust. No FMU has friction yet.
    #[serde(default, rename = "friction_error")]
    _friction_error: IgnoredAny,
    #[serde(default, rename = "friction_error_of")]
    _friction_error_of: IgnoredAny,
    #[serde(default, rename = "no_friction")]
    _no_friction: IgnoredAny,
    pub title: String,
    pub formulas: Vec<String>,
    pub notes: String,
    /// In which range the law was made, or holds; of loading laws.
    #[serde(default)]
    pub validity: String,
    pub reference: String,
    /// The unloading law that a loading law was published with, if it was with one.
    pub unloading: Option<String>,
    /// Why a loading law goes with no other unloading law.
    pub no_other_unloading: Option<String>,
    /// Whether a loading law is above Hertz's curve in places.
    #[serde(default)]
    pub above_hertz: bool,
    /// Whether an unloading law lowers Hertz's curve to the largest load.
    #[serde(default)]
    pub lowers_hertz: bool,
    /// The one loading law that an unloading law goes with.
    pub made_for: Option<MadeFor>,
    /// Whether the force of a loading law jumps, and by which part its contact radius falls: for the tests.
    #[serde(default, rename = "jumps")]
    _jumps: IgnoredAny,
    #[serde(default, rename = "radius_falls_by")]
    _radius_falls_by: IgnoredAny,
    /// Whether the normalised curve of a loading law depends on `E*/S`.
    #[serde(default)]
    pub depends_on_modulus_ratio: bool,
    /// Of a loading law that makes energy.
    pub energy: Option<MakesEnergy>,
    /// What a scene can change.
    #[serde(default)]
    pub parameters: Vec<LawParameter>,
    /// Constants that belong together, so that a scene can't change them.
    #[serde(default)]
    pub fixed: Vec<String>,
}

/// The loading law that an unloading law was made for.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MadeFor {
    pub loading: String,
    /// What the unloading law did with it: "was fitted to".
    pub because: String,
    /// Constants that both have, and that must be the same.
    #[serde(default)]
    pub same: Vec<String>,
    /// Constants of the loading law that the unloading law takes as published.
    #[serde(default)]
    pub as_published: Vec<String>,
}

/// Where a loading law makes energy, and how much.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MakesEnergy {
    pub why: String,
    /// The largest with the unloading law that it was published with, or else contact-radius, of targets with a Poisson's
    /// ratio from 0 on.
    pub restitution: f64,
    /// Of targets with a Poisson's ratio below 0.
    pub auxetic_restitution: f64,
    /// Unloading laws with which it makes none.
    pub passive: Vec<PassiveWith>,
}

/// An unloading law with which a loading law makes no energy.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PassiveWith {
    pub unloading: String,
    /// From which Poisson's ratio of the target on; none if it is so for all.
    pub from_poissons_ratio: Option<f64>,
}

/// A constant of a law that a scene can change.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawParameter {
    pub name: String,
    /// Empty for a pure number.
    #[serde(default)]
    pub unit: String,
    pub minimum: f64,
    pub maximum: f64,
    /// The parameter of the same law that it must be below.
    pub below: Option<String>,
    pub description: String,
}

#[derive(Deserialize)]
struct Variables {
    variable: Vec<Variable>,
}

#[derive(Deserialize)]
struct Units {
    unit: Vec<Unit>,
}

#[derive(Deserialize)]
struct Materials {
    material: Vec<Material>,
}

#[derive(Deserialize)]
struct Laws {
    loading: Vec<Law>,
    unloading: Vec<Law>,
    damped: Vec<Law>,
}

/// The tables are part of the program: a mistake in one is a mistake in the program, which every test would show.
const PART_OF_THE_PROGRAM: &str = "the program's own tables are well-formed";

/// Every variable there can be.
pub static VARIABLES: LazyLock<Vec<Variable>> = LazyLock::new(|| {
    let text = include_str!("../../../modelDescription/variables.toml");
    toml::from_str::<Variables>(text).expect(PART_OF_THE_PROGRAM).variable
});

/// Every unit.
pub static UNITS: LazyLock<Vec<Unit>> = LazyLock::new(|| {
    let text = include_str!("../../../modelDescription/units.toml");
    toml::from_str::<Units>(text).expect(PART_OF_THE_PROGRAM).unit
});

/// Every built-in material.
pub static MATERIALS: LazyLock<Vec<Material>> = LazyLock::new(|| {
    let text = include_str!("../../../modelDescription/materials.toml");
    toml::from_str::<Materials>(text).expect(PART_OF_THE_PROGRAM).material
});

static LAWS: LazyLock<Laws> = LazyLock::new(|| {
    let text = include_str!("../../../modelDescription/laws.toml");
    toml::from_str(text).expect(PART_OF_THE_PROGRAM)
});

/// What is said of the loading law `name`.
pub fn loading_law(name: &str) -> &'static Law {
    LAWS.loading.iter().find(|law| law.name == name).expect(PART_OF_THE_PROGRAM)
}

/// What is said of the unloading law `name`.
pub fn unloading_law(name: &str) -> &'static Law {
    LAWS.unloading.iter().find(|law| law.name == name).expect(PART_OF_THE_PROGRAM)
}

/// What is said of the rate-dependent law `name`.
pub fn damped_law(name: &str) -> &'static Law {
    LAWS.damped.iter().find(|law| law.name == name).expect(PART_OF_THE_PROGRAM)
}

/// The variable `name`.
pub fn variable(name: &str) -> &'static Variable {
    VARIABLES.iter().find(|variable| variable.name == name).expect(PART_OF_THE_PROGRAM)
}
