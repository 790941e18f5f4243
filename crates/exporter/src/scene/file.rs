//! The contents of a scene file: tables and keys, without interpretation.

use super::beside::{self, Beside, OwnMaterial};
use super::parser_words;
use crate::layout::shortened;
use crate::mistake::Mistake;
use crate::parameters::ConstantTable;
use crate::table::{Material, VARIABLES};
use crate::{tension, units};
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
    pub material: Option<Vec<Spanned<Material>>>,
    /// The materials of the scene's own, and those of tables beside it that it uses.
    #[serde(skip)]
    pub(super) own: Vec<OwnMaterial>,
    /// The text with what it uses of the files beside it.
    #[serde(skip)]
    pub(super) alone: String,
}

/// A table of materials of one's own.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialsFile {
    #[serde(default)]
    pub material: Vec<Spanned<Material>>,
}

impl MaterialsFile {
    /// Reads the `text` of such a table.
    ///
    /// # Errors
    /// As for [`SceneFile::read`].
    pub fn read(text: &str) -> Result<MaterialsFile, Mistake> {
        deserialized(text, &BTreeMap::new())
    }
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
    pub tensile_test: Option<Spanned<TensileTestTable>>,
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
    pub tensile_test: Option<Spanned<TensileTestTable>>,
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

/// A tensile test: two numbers, or a curve. The name of a file stands for its curve.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct TensileTestTable {
    pub proof_stress: Option<Spanned<f64>>,
    pub tensile_strength: Option<Spanned<f64>>,
    pub true_strain: Option<Spanned<Vec<f64>>>,
    pub plastic_strain: Option<Spanned<Vec<f64>>>,
    pub true_stress: Option<Spanned<Vec<f64>>>,
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
    /// Reads the `text` of a scene, with what lies `beside` it.
    ///
    /// # Errors
    /// Text that is not TOML, has a wrong type, or is unknown, with its place.
    pub fn read(text: &str, beside: &Beside) -> Result<SceneFile, Mistake> {
        let mut file: SceneFile = deserialized(text, &beside.files)?;
        file.own =
            beside::check(file.material.take().unwrap_or_default())?.into_iter().map(OwnMaterial::of_scene).collect();
        file.alone = with_curves(text, &beside.files)?;
        let taken = beside::take_in(&mut file, &beside.materials);
        if !taken.is_empty() {
            file.alone = format!("{}\n{taken}", file.alone.trim_end());
            // a list in the text can't go on in tables
            deserialized::<SceneFile>(&file.alone, &BTreeMap::new()).map_err(|_| {
                let message = "the scene has `material` in another form than tables [[material]], to which those of materials.toml can't be added";
                Mistake(0..0, message.into())
            })?;
        }
        // whether this key is required, the parser doesn't know
        match &file.coupling {
            Some(table) if file.body.is_none() && table.get_ref().has_no_mass() => {
                Err(in_words(text, table.span(), "missing field `effective_mass`"))
            }
            _ => Ok(file),
        }
    }

    /// The names of the materials of all bodies.
    pub fn materials_used(&self) -> impl Iterator<Item = &Spanned<String>> {
        let impactor = self.impactor.iter().map(|impactor| &impactor.get_ref().0);
        let contacts = self.contact.iter().flat_map(|contacts| contacts.get_ref()).map(Spanned::get_ref);
        let of_contacts = contacts.flat_map(|contact| [&contact.impactor.0, &contact.target]);
        let bodies = impactor.chain(self.target.iter().map(Spanned::get_ref)).chain(of_contacts);
        bodies.filter_map(|body| body.material.as_ref())
    }
}

/// The tables of this `text`, with the `files` that it names.
fn deserialized<T: for<'a> Deserialize<'a>>(text: &str, files: &Files) -> Result<T, Mistake> {
    let (tree, values) = parsed(text, files)?;
    // it borrows the values from here on
    let mut tree = tree;
    tree.get_mut().iter_mut().for_each(|(_, value)| put(value, &values));
    T::deserialize(Deserializer::from(tree)).map_err(|error| of_parser(text, &error))
}

/// The bytes of files by the name that a scene gives them.
type Files = BTreeMap<String, Result<Vec<u8>, String>>;

/// The key of a tensile test, which may be the name of a file.
const TEST: &str = "tensile_test";

/// The names of files in the `text` of a scene. None, if it is no TOML.
pub fn files_named(text: &str) -> Vec<String> {
    fn named(value: &DeValue, key: &str, found: &mut Vec<String>) {
        match value {
            DeValue::Table(table) => {
                table.iter().for_each(|(key, value)| named(value.get_ref(), key.get_ref(), found));
            }
            DeValue::Array(list) => list.iter().for_each(|value| named(value.get_ref(), key, found)),
            DeValue::String(name) if key == TEST => found.push(name.to_string()),
            _ => {}
        }
    }
    let mut found = Vec::new();
    // most scenes name none, and may be large
    if !text.contains(TEST) {
        return found;
    }
    let tree = DeTable::parse(text);
    tree.iter().flat_map(|tree| tree.get_ref().iter()).for_each(|(key, value)| {
        named(value.get_ref(), key.get_ref(), &mut found);
    });
    found
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

/// The tree of the `text`, and the values that stand for texts in it: numbers with a unit, and files.
fn parsed<'text>(text: &'text str, files: &Files) -> Result<(Spanned<DeTable<'text>>, InSi), Mistake> {
    let tree = DeTable::parse(text).map_err(|error| of_parser(text, &error))?;
    let mut found = Found { files, values: InSi::new() };
    found.in_table("", tree.get_ref())?;
    Ok((tree, found.values))
}

/// The `text` with the `values` in place of the texts for which they stand.
fn with_values(text: &str, values: InSi) -> String {
    let (mut made, mut end) = (String::new(), 0);
    for (start, (until, value)) in values {
        made = made + &text[end..start] + &value;
        end = until;
    }
    made + &text[end..]
}

/// The `text` of a scene with all numbers in SI units, and all files taken in: a bare number in place of each text with a unit.
///
/// # Errors
/// Text that is not TOML, and a wrong unit, with its place.
pub fn in_si(text: &str, files: &Files) -> Result<String, Mistake> {
    Ok(with_values(text, parsed(text, files)?.1))
}

/// The `text` of a scene with curves in place of the names of `files`.
fn with_curves(text: &str, files: &Files) -> Result<String, Mistake> {
    if files.is_empty() {
        return Ok(text.into());
    }
    let values = parsed(text, files)?.1.into_iter().filter(|(_, (_, value))| value.starts_with('{'));
    Ok(with_values(text, values.collect()))
}

/// The SI unit of the number `key` in a table that is called `table`, or `""` at the top. Dimensionless numbers have none.
fn unit_of(table: &str, key: &str) -> Option<&'static str> {
    match (table, key) {
        // a law has its own constants
        ("loading_parameters" | "unloading_parameters", _) => None,
        ("power_law" | "tension", "coefficient")
        | (_, "tangent_modulus" | "tensile_strength" | "proof_stress" | "true_stress") => Some("Pa"),
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

/// Numbers in SI units and curves as TOML writes them, with the end of the text for which each stands, by its beginning.
type InSi = BTreeMap<usize, (usize, String)>;

/// What stands for texts of a scene.
struct Found<'a> {
    files: &'a Files,
    values: InSi,
}

impl Found<'_> {
    /// Finds the texts with a value, such as `"5 mm"`, in a `table` at this `path`.
    fn in_table(&mut self, path: &str, table: &DeTable) -> Result<(), Mistake> {
        table.iter().try_for_each(|(key, value)| {
            let key = key.get_ref();
            let unit = unit_of(path.rsplit('.').next().unwrap_or_default(), key);
            let path = if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
            if let (TEST, DeValue::String(name)) = (key.as_ref(), value.get_ref()) {
                let wrong = |why| Mistake(value.span(), format!("{path} = \"{}\": {why}", shortened(name)));
                let curve = self.curve(name).map_err(wrong)?;
                self.values.insert(value.span().start, (value.span().end, curve));
                return Ok(());
            }
            self.in_value(&path, unit, value)
        })
    }

    /// The same in a `value`, which is a number in this `unit`, a list, or a table.
    fn in_value(&mut self, path: &str, unit: Option<&'static str>, value: &Spanned<DeValue>) -> Result<(), Mistake> {
        let (text, unit) = match (value.get_ref(), unit) {
            (DeValue::Table(table), _) => return self.in_table(path, table),
            (DeValue::Array(list), _) => return list.iter().try_for_each(|value| self.in_value(path, unit, value)),
            (DeValue::String(text), Some(unit)) => (text, unit),
            _ => return Ok(()),
        };
        let wrong = |why| Mistake(value.span(), format!("{path} = \"{}\": {why}", shortened(text)));
        if let Some(comma) = units::decimal_comma(text) {
            return Err(wrong(comma));
        }
        let number = units::with_unit(text, unit).transpose().map_err(wrong)?;
        self.values.extend(number.map(|number| (value.span().start, (value.span().end, format!("{number:e}")))));
        Ok(())
    }

    /// The curve of a tensile test in the file `name`, as a table of a scene.
    fn curve(&self, name: &str) -> Result<String, String> {
        match self.files.get(name) {
            Some(Ok(bytes)) => Ok(tension::read(bytes)?.in_toml()),
            Some(Err(why)) => Err(why.clone()),
            None => Err("the file isn't at hand; give the points as true_strain and true_stress, or proof_stress and tensile_strength".into()),
        }
    }
}

/// Puts the `values` in place of their texts in this `value`.
fn put<'text>(value: &mut Spanned<DeValue<'text>>, values: &'text InSi) {
    let found = values.get(&value.span().start);
    match value.get_mut() {
        DeValue::Table(table) => table.iter_mut().for_each(|(_, value)| put(value, values)),
        DeValue::Array(list) => list.iter_mut().for_each(|value| put(value, values)),
        text @ DeValue::String(_) => {
            if let Some((_, found)) = found {
                *text = DeValue::parse(found).expect("a value of TOML").into_inner();
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
