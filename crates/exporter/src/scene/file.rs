//! The contents of a scene file: tables and keys, without interpretation.

use super::parser_words;
use crate::mistake::Mistake;
use crate::parameters::ConstantTable;
use brinell_contact::Surface;
use serde::Deserialize;
use std::ops::Range;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    pub name: Spanned<String>,
    pub description: Option<Spanned<String>>,
    pub author: Option<Spanned<String>>,
    pub impactor: Option<Spanned<Impactor>>,
    pub target: Option<Spanned<BodyTable>>,
    #[serde(default)]
    pub law: LawTable,
    #[serde(default)]
    pub fmu: Fmu,
    pub impact: Option<Spanned<ImpactTable>>,
    pub friction: Option<Spanned<FrictionTable>>,
    pub coupling: Option<Spanned<CouplingTable>>,
    pub body: Option<Spanned<Vec<Spanned<SharedBodyTable>>>>,
    pub contact: Option<Spanned<Vec<Spanned<ContactTable>>>>,
}

/// One of the two bodies: `[target]`, and with fewer keys [`Impactor`].
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct BodyTable {
    pub material: Option<Spanned<String>>,
    pub youngs_modulus: Option<Spanned<f64>>,
    pub poissons_ratio: Option<Spanned<f64>>,
    pub yield_strength: Option<Spanned<f64>>,
    pub hardening_modulus: Option<Spanned<f64>>,
    pub tangent_modulus: Option<Spanned<f64>>,
    pub power_law: Option<Spanned<PowerLawTable>>,
    pub rate: Option<Spanned<RateTable>>,
    pub density: Option<Spanned<f64>>,
    pub length: Option<Spanned<f64>>,
    pub area: Option<Spanned<f64>>,
    pub radius: Option<Spanned<f64>>,
    pub plate_thickness: Option<Spanned<f64>>,
    pub surface: Option<SurfaceName>,
}

/// The keys of `[impactor]`, which is no plate and has no surface that remembers, in the order of messages.
#[derive(Deserialize)]
#[serde(remote = "BodyTable", deny_unknown_fields, expecting = "a table")]
struct ImpactorKeys {
    pub material: Option<Spanned<String>>,
    pub radius: Option<Spanned<f64>>,
    pub youngs_modulus: Option<Spanned<f64>>,
    pub poissons_ratio: Option<Spanned<f64>>,
    pub yield_strength: Option<Spanned<f64>>,
    pub hardening_modulus: Option<Spanned<f64>>,
    pub tangent_modulus: Option<Spanned<f64>>,
    pub power_law: Option<Spanned<PowerLawTable>>,
    pub rate: Option<Spanned<RateTable>>,
    pub density: Option<Spanned<f64>>,
    pub length: Option<Spanned<f64>>,
    pub area: Option<Spanned<f64>>,
    #[serde(skip)]
    plate_thickness: Option<Spanned<f64>>,
    #[serde(skip)]
    surface: Option<SurfaceName>,
}

/// `[impactor]`.
#[derive(Default, Deserialize)]
pub struct Impactor(#[serde(with = "ImpactorKeys")] pub BodyTable);

/// How the flow stress grows with the strain rate.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RateTable {
    pub model: Spanned<String>,
    pub c: Option<Spanned<f64>>,
    pub reference_rate: Option<Spanned<f64>>,
    pub d: Option<Spanned<f64>>,
    pub q: Option<Spanned<f64>>,
}

/// Flow stress `coefficient eps_p^exponent`.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PowerLawTable {
    pub coefficient: Spanned<f64>,
    pub exponent: Spanned<f64>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceName {
    Dented,
    Fresh,
}

impl From<SurfaceName> for Surface {
    fn from(name: SurfaceName) -> Surface {
        match name {
            SurfaceName::Dented => Surface::Dented,
            SurfaceName::Fresh => Surface::Fresh,
        }
    }
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LawTable {
    pub loading: Option<Spanned<String>>,
    pub loading_parameters: Option<ConstantTable>,
    pub unloading: Option<Spanned<String>>,
    pub restitution: Option<Spanned<f64>>,
    pub elastic_restitution: Option<Spanned<toml::Value>>,
    pub damping: Option<Spanned<String>>,
    pub unloading_parameters: Option<ConstantTable>,
    pub passivity_guard: Option<Spanned<bool>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fmu {
    #[serde(default)]
    pub outputs: Vec<Spanned<String>>,
    pub names: Option<NamesName>,
    pub parameters: Option<Vec<Spanned<String>>>,
    pub initial_gap: Option<Spanned<f64>>,
    pub step_size: Option<Spanned<f64>>,
    pub stop_time: Option<Spanned<f64>>,
    pub standalone: Option<bool>,
    pub input_derivatives: Option<Spanned<bool>>,
}

/// The naming convention of variables for importers.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NamesName {
    /// Flat names, in which dots have no meaning.
    Flat,
    /// Structured names: dots and brackets form a tree.
    Structured,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CouplingTable {
    /// Required unless the contacts share bodies.
    pub effective_mass: Option<Spanned<f64>>,
    pub inverse_masses: Option<Spanned<InverseMassesName>>,
    pub master: Option<MasterName>,
    #[serde(default)]
    pub inputs: Vec<Spanned<String>>,
}

/// Where the inverse masses of contacts that share bodies come from, if the scene has no bodies.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum InverseMassesName {
    Input,
}

/// Friction of all contacts.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrictionTable {
    pub coefficient: Spanned<f64>,
    pub directions: Option<Spanned<i64>>,
}

/// Friction of one contact.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnFriction {
    pub coefficient: Option<Spanned<f64>>,
}

/// The order in which an importer steps FMUs.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MasterName {
    /// The contact first; its force is applied over the same step.
    Serial,
    /// All at the same time.
    Parallel,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImpactTable {
    /// Without a mass, that of a solid ball or of the rod is used if the impactor has a density.
    pub mass: Option<Spanned<f64>>,
    pub speed: Spanned<f64>,
    pub watch: Option<bool>,
}

/// A body that contacts share.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct SharedBodyTable {
    pub name: Spanned<String>,
    pub mass: Spanned<f64>,
    /// One number, three or six.
    pub inertia: Option<Spanned<toml::Value>>,
}

/// One contact, or `count` equal contacts, with the values that differ from the tables above.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct ContactTable {
    pub name: Spanned<String>,
    pub count: Option<Spanned<i64>>,
    pub between: Option<Spanned<Vec<Spanned<String>>>>,
    pub direction: Option<Spanned<i64>>,
    pub normal: Option<Spanned<Vec<f64>>>,
    pub arms: Option<Spanned<Vec<Spanned<Vec<f64>>>>>,
    pub tangent: Option<Spanned<Vec<f64>>>,
    #[serde(default)]
    pub impactor: Impactor,
    #[serde(default)]
    pub target: BodyTable,
    pub initial_gap: Option<Spanned<f64>>,
    pub effective_mass: Option<Spanned<f64>>,
    #[serde(default)]
    pub friction: OwnFriction,
    #[serde(default)]
    pub parameters_per_contact: Vec<Spanned<String>>,
}

impl SceneFile {
    /// Reads the `text` of a scene.
    ///
    /// # Errors
    /// Text that is not TOML, has a wrong type, or is unknown, with its place.
    pub fn read(text: &str) -> Result<SceneFile, Mistake> {
        let mistake = |span: Range<usize>, message: &str| {
            let line = text[..span.start].rfind('\n').map_or(0, |end| end + 1);
            let line = text[line..].lines().next().unwrap_or_default().trim();
            Mistake(span.clone(), parser_words::words(message, line, &text[span]))
        };
        let file: SceneFile =
            toml::from_str(text).map_err(|error| mistake(error.span().unwrap_or(0..0), error.message()))?;
        // whether this key is required, the parser doesn't know
        match &file.coupling {
            Some(table) if file.body.is_none() && table.get_ref().has_no_mass() => {
                Err(mistake(table.span(), "missing field `effective_mass`"))
            }
            _ => Ok(file),
        }
    }
}

impl CouplingTable {
    fn has_no_mass(&self) -> bool {
        self.effective_mass.is_none() && self.inverse_masses.is_none()
    }
}
