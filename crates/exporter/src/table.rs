//! The tables in `modelDescription/`, as data: variables, units, materials, laws.

mod law;
pub mod names;

pub use law::{Law, LawParameter};

use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_fmu::scene::{Integer, Parameter, Real};
use names::{first, lists};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::LazyLock;

/// A variable of FMUs; see `modelDescription/variables.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variable {
    pub name: String,
    #[serde(default)]
    pub r#type: Type,
    pub causality: Causality,
    pub unit: Option<String>,
    pub display_unit: Option<String>,
    pub minimum: Option<f64>,
    pub maximum: Option<f64>,
    /// Parameters on which the value before the first step depends.
    #[serde(default)]
    pub depends_on: Vec<String>,
    pub nominal_from: Option<String>,
    #[serde(default)]
    pub follows_rate: Follows,
    /// Whether an output also depends on the tangential rate at the same instant: on both, or before the first step on its own.
    #[serde(default)]
    pub follows_tangential_rate: Follows,
    /// Whether it belongs to FMUs with friction only.
    #[serde(default)]
    pub friction: bool,
    /// The variable of which it is the second direction.
    pub second_of: Option<String>,
    /// Whether an output belongs to a whole step, and changes at communication points only.
    #[serde(default)]
    pub held: bool,
    pub description: String,
    /// The values of an enumeration, counted from 0.
    #[serde(default)]
    pub items: Vec<Item>,
    /// Other descriptions in FMUs of other kinds.
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

/// The description of a variable in FMUs of one kind.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instead {
    pub of: Feature,
    pub description: String,
    /// It may be negative, whatever the table says.
    #[serde(default)]
    pub negative: bool,
}

/// A kind of FMU in which variables have another meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// The force depends on the rate.
    RateDependent,
    /// Its inputs have no derivatives, as the scene wants it.
    HeldInputs,
    /// The FMU knows the mass, and its importer steps all FMUs at once.
    Parallel,
    /// The FMU knows the mass, and has an input for the acceleration.
    AccelerationInput,
    /// The FMU knows the mass.
    MassKnown,
    /// Its laws can return more energy than they took.
    MakesEnergy,
    /// Its laws can leave a dent above the original surface.
    DentsAboveSurface,
    /// Its laws dissipate less energy where the dent is deeper.
    LosesLess,
    /// It finds the strength of each impact.
    FindsStrength,
    /// It moves bodies that share contacts with friction.
    SharedFriction,
}

impl Variable {
    /// The description of the variable in an FMU of these `kinds`.
    pub fn description(&self, kinds: &[Feature]) -> &str {
        self.instead(kinds).map_or(&self.description, |instead| &instead.description)
    }

    /// Its minimum in an FMU of these `kinds`.
    pub fn minimum(&self, kinds: &[Feature]) -> Option<f64> {
        self.minimum.filter(|_| !self.instead(kinds).is_some_and(|instead| instead.negative))
    }

    /// The variable in the library.
    pub fn symbol(&self) -> Symbol {
        fn named<T: Copy>(name: &str, all: &[(&str, T)]) -> T {
            all.iter().find(|(known, _)| *known == name).expect(PART_OF_THE_PROGRAM).1
        }
        match (self.causality, self.r#type) {
            (Causality::Parameter, _) => Symbol::Parameter(named(&self.name, &Parameter::ALL)),
            (_, Type::Enumeration) => Symbol::Integer(named(&self.name, &Integer::ALL)),
            (_, Type::Real) => Symbol::Real(named(&self.name, &Real::ALL)),
        }
    }

    fn instead(&self, kinds: &[Feature]) -> Option<&Instead> {
        self.instead.iter().find(|instead| kinds.contains(&instead.of))
    }
}

/// A variable in the library. Its text is that of the variant, as in Rust.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    Real(Real),
    Integer(Integer),
    Parameter(Parameter),
}

impl std::fmt::Display for Symbol {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Symbol::Real(variable) => write!(to, "{variable:?}"),
            Symbol::Integer(variable) => write!(to, "{variable:?}"),
            Symbol::Parameter(parameter) => write!(to, "{parameter:?}"),
        }
    }
}

/// Whether an output depends on the rate at the same instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Follows {
    #[default]
    Never,
    /// If the law does.
    WithLaw,
    /// Only before the first step.
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

/// A physical unit with its SI exponents; see `modelDescription/units.toml`.
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

/// What a metal is, as far as a reading depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Class {
    /// Steel with a ferritic, pearlitic or martensitic structure, for which conversions between hardness scales are made.
    Steel,
    /// Austenitic steel.
    Austenitic,
    /// Aluminium and its alloys.
    Aluminium,
    /// Any other metal.
    Other,
}

/// A material, built in or of one's own; see `modelDescription/materials.toml`.
#[derive(Clone, Debug, Deserialize, JsonSchema, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Its name in scenes.
    pub name: String,
    /// Its other names, some of which belong to several conditions of an alloy.
    #[serde(default)]
    pub aliases: Vec<String>,
    /// What it is, if Young's modulus doesn't say it.
    pub class: Option<Class>,
    /// Young's modulus.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Yield strength, if the material has one.
    pub yield_strength: Option<f64>,
    /// Flow stress through yield and tensile strength, from which its strength follows.
    pub tension: Option<Tension>,
    /// A hardness, from which its strength follows.
    pub hardness: Option<String>,
    /// `n` of the hardening that goes with the hardness, if it isn't that of the class.
    pub hardening_exponent: Option<f64>,
    /// Density.
    pub density: f64,
    /// What to say wherever it is used.
    pub warning: Option<String>,
    /// Where its numbers are from.
    #[serde(default)]
    pub source: String,
}

impl Material {
    /// Whether it has this name or alias.
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || self.aliases.iter().any(|alias| alias.eq_ignore_ascii_case(name.trim()))
    }
}

/// The flow stress `K eps^n` of a tensile test.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, serde::Serialize)]
#[serde(deny_unknown_fields)]
pub struct Tension {
    /// `K`.
    pub coefficient: f64,
    /// `n`.
    pub exponent: f64,
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
struct LawTables {
    loading: Vec<Law>,
    unloading: Vec<Law>,
    damped: Vec<Law>,
}

/// The tables are part of the program. A mistake in one is a defect of the program, which every test would show.
const PART_OF_THE_PROGRAM: &str = "the program's own tables are well-formed";

// the table describes exactly the variables of the library, those of each type in their order
const _: () = assert!(lists(
    brinell_tables::VARIABLES,
    "[[variable]]",
    [&first(&Parameter::ALL), &first(&Integer::ALL), &first(&Real::ALL)]
));

/// All variables.
pub static VARIABLES: LazyLock<Vec<Variable>> =
    LazyLock::new(|| toml::from_str::<Variables>(brinell_tables::VARIABLES).expect(PART_OF_THE_PROGRAM).variable);

/// All units.
pub static UNITS: LazyLock<Vec<Unit>> =
    LazyLock::new(|| toml::from_str::<Units>(brinell_tables::UNITS).expect(PART_OF_THE_PROGRAM).unit);

/// All built-in materials.
pub static MATERIALS: LazyLock<Vec<Material>> =
    LazyLock::new(|| toml::from_str::<Materials>(brinell_tables::MATERIALS).expect(PART_OF_THE_PROGRAM).material);

// the table describes exactly the laws of the library, in their order
const _: () = {
    assert!(lists(brinell_tables::LAWS, "[[loading]]", [&first(&AnyLoading::ALL)]));
    assert!(lists(brinell_tables::LAWS, "[[unloading]]", [&first(&AnyUnloading::ALL)]));
    assert!(lists(brinell_tables::LAWS, "[[damped]]", [&first(&AnyDamped::ALL)]));
};

static LAWS: LazyLock<LawTables> = LazyLock::new(|| toml::from_str(brinell_tables::LAWS).expect(PART_OF_THE_PROGRAM));

/// The outputs of contacts that share bodies alone.
pub const OF_SHARED: [&str; 3] = ["impulse_moment", "tangential_impulse_moment", "tangential_speed"];

/// The entries of the laws that a scene names under `law.loading`: elastoplastic and rate-dependent ones.
pub fn loading_laws() -> Vec<&'static Law> {
    LAWS.loading.iter().chain(&LAWS.damped).collect()
}

/// The entries of the unloading laws.
pub fn unloading_laws() -> Vec<&'static Law> {
    LAWS.unloading.iter().collect()
}

/// The entry of the loading law `name`.
pub fn loading_law(name: &str) -> &'static Law {
    LAWS.loading.iter().find(|law| law.name == name).expect(PART_OF_THE_PROGRAM)
}

/// The entry of the unloading law `name`.
pub fn unloading_law(name: &str) -> &'static Law {
    LAWS.unloading.iter().find(|law| law.name == name).expect(PART_OF_THE_PROGRAM)
}

/// The entry of the rate-dependent law `name`.
pub fn damped_law(name: &str) -> &'static Law {
    LAWS.damped.iter().find(|law| law.name == name).expect(PART_OF_THE_PROGRAM)
}

/// The variable `name`.
pub fn variable(name: &str) -> &'static Variable {
    VARIABLES.iter().find(|variable| variable.name == name).expect(PART_OF_THE_PROGRAM)
}
