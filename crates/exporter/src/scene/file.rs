//! The contents of a scene file: tables and keys, without interpretation.

use super::parser_words;
use crate::layout::shortened;
use crate::mistake::Mistake;
use crate::parameters::ConstantTable;
use crate::table::VARIABLES;
use crate::units;
use brinell_contact::Surface;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

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
    pub hardness: Option<Spanned<toml::Value>>,
    pub tensile_strength: Option<Spanned<f64>>,
    pub hardening_exponent: Option<Spanned<f64>>,
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
    pub hardness: Option<Spanned<toml::Value>>,
    pub tensile_strength: Option<Spanned<f64>>,
    pub hardening_exponent: Option<Spanned<f64>>,
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
    pub speed: Option<Spanned<f64>>,
    pub drop_height: Option<Spanned<f64>>,
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
        let (tree, numbers) = parsed(text)?;
        // it borrows the numbers from here on
        let mut tree = tree;
        tree.get_mut().iter_mut().for_each(|(_, value)| put(value, &numbers));
        let file = SceneFile::deserialize(Deserializer::from(tree)).map_err(|error| of_parser(text, &error))?;
        // whether this key is required, the parser doesn't know
        match &file.coupling {
            Some(table) if file.body.is_none() && table.get_ref().has_no_mass() => {
                Err(in_words(text, table.span(), "missing field `effective_mass`"))
            }
            _ => Ok(file),
        }
    }
}

/// The mistake of this `message` of the parser about a place in the `text`.
fn in_words(text: &str, span: Range<usize>, message: &str) -> Mistake {
    let line = text[..span.start].rfind('\n').map_or(0, |end| end + 1);
    let line = text[line..].lines().next().unwrap_or_default().trim();
    Mistake(span.clone(), parser_words::words(message, line, &text[span]))
}

fn of_parser(text: &str, error: &toml::de::Error) -> Mistake {
    in_words(text, error.span().unwrap_or(0..0), error.message())
}

/// The tree of the `text`, and the numbers with a unit in it.
fn parsed(text: &str) -> Result<(Spanned<DeTable<'_>>, InSi), Mistake> {
    let tree = DeTable::parse(text).map_err(|error| of_parser(text, &error))?;
    let mut numbers = InSi::new();
    numbers_in("", tree.get_ref(), &mut numbers)?;
    Ok((tree, numbers))
}

/// The `text` of a scene with all numbers in SI units: a bare number in place of each text with a unit.
///
/// # Errors
/// Text that is not TOML, and a wrong unit, with its place.
pub fn in_si(text: &str) -> Result<String, Mistake> {
    let (mut made, mut end) = (String::new(), 0);
    for (start, (until, number)) in parsed(text)?.1 {
        made = made + &text[end..start] + &number;
        end = until;
    }
    Ok(made + &text[end..])
}

/// The SI unit of the number `key` in a table that is called `table`, or `""` at the top. Dimensionless numbers have none.
fn unit_of(table: &str, key: &str) -> Option<&'static str> {
    match (table, key) {
        // a law has its own constants
        ("loading_parameters" | "unloading_parameters", _) => None,
        ("power_law", "coefficient") | (_, "tangent_modulus" | "tensile_strength") => Some("Pa"),
        ("rate", "d" | "reference_rate") => Some("1/s"),
        (_, "density") => Some("kg/m^3"),
        (_, "mass") => Some("kg"),
        (_, "speed") => Some("m/s"),
        (_, "length" | "drop_height" | "arms") => Some("m"),
        (_, "step_size" | "stop_time") => Some("s"),
        (_, "area") => Some("m^2"),
        (_, "inertia") => Some("kg.m^2"),
        _ => {
            let is_key = |name: &str| name.rsplit('.').next() == Some(key);
            VARIABLES.iter().find(|variable| is_key(&variable.name)).and_then(|variable| variable.unit.as_deref())
        }
    }
}

/// Numbers in SI units as TOML writes them, with the end of the text with a unit for which each stands, by its beginning.
type InSi = BTreeMap<usize, (usize, String)>;

/// Finds the numbers with a unit, such as `"5 mm"`, in a `table` at this `path`.
fn numbers_in(path: &str, table: &DeTable, found: &mut InSi) -> Result<(), Mistake> {
    table.iter().try_for_each(|(key, value)| {
        let key = key.get_ref();
        let unit = unit_of(path.rsplit('.').next().unwrap_or_default(), key);
        let path = if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
        number_in(&path, unit, value, found)
    })
}

/// The same in a `value`, which is a number in this `unit`, a list, or a table.
fn number_in(
    path: &str,
    unit: Option<&'static str>,
    value: &Spanned<DeValue>,
    found: &mut InSi,
) -> Result<(), Mistake> {
    let text = match (value.get_ref(), unit) {
        (DeValue::Table(table), _) => return numbers_in(path, table, found),
        (DeValue::Array(list), _) => return list.iter().try_for_each(|value| number_in(path, unit, value, found)),
        (DeValue::String(text), Some(unit)) => (text, unit),
        _ => return Ok(()),
    };
    let (text, unit) = text;
    let wrong = |why| Mistake(value.span(), format!("{path} = \"{}\": {why}", shortened(text)));
    if let Some(comma) = units::decimal_comma(text) {
        return Err(wrong(comma));
    }
    let number = units::with_unit(text, unit).transpose().map_err(wrong)?;
    found.extend(number.map(|number| (value.span().start, (value.span().end, format!("{number:e}")))));
    Ok(())
}

/// Puts the `numbers` in place of their texts in this `value`.
fn put<'text>(value: &mut Spanned<DeValue<'text>>, numbers: &'text InSi) {
    let number = numbers.get(&value.span().start);
    match value.get_mut() {
        DeValue::Table(table) => table.iter_mut().for_each(|(_, value)| put(value, numbers)),
        DeValue::Array(list) => list.iter_mut().for_each(|value| put(value, numbers)),
        text @ DeValue::String(_) => {
            if let Some((_, number)) = number {
                *text = DeValue::parse(number).expect("a number of TOML").into_inner();
            }
        }
        _ => {}
    }
}

impl CouplingTable {
    fn has_no_mass(&self) -> bool {
        self.effective_mass.is_none() && self.inverse_masses.is_none()
    }
}
