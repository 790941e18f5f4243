//! The scene as text and as values.

use crate::Refused;
use brinell_exporter::mistake::SceneError;
use brinell_exporter::own_curve::{self, Rows};
use brinell_exporter::pairing::DEFAULT_LOADING;
use brinell_exporter::scene::{self, ReferencedFiles, Scene, quantity_of};
use brinell_exporter::tension::{self, Curve, Specimen};
use brinell_exporter::{reading, units};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::path::Path;
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, RawString, Table, TableLike};

/// The key of a reading with its scale.
const HARDNESS: &str = "hardness";

/// The name of the scene in messages.
const PATH: &str = "scene.toml";

/// A question about the scene with this text.
#[derive(Deserialize)]
pub struct Asked {
    pub text: String,
}

/// The scene with this `text`, and warnings about its numbers. No file lies beside it.
///
/// # Errors
/// [`Refused`] with the place of the mistake.
pub fn scene(text: &str) -> Result<(Scene, Vec<SceneError>), Refused> {
    Scene::parse_with_files(text, Path::new(PATH), &ReferencedFiles::default())
        .map_err(|error| Refused { message: error.to_string(), mistakes: placed(text, &error) })
}

/// A mistake with its place: line and column from 1, and the part of the text \[UTF-16 units\].
fn placed(text: &str, error: &SceneError) -> Vec<Value> {
    let SceneError::Wrong { line, column, span, message, .. } = error else { return Vec::new() };
    let units = |end: usize| text.get(..end).unwrap_or(text).encode_utf16().count();
    vec![
        json!({ "line": line, "column": column, "from": units(span.start), "to": units(span.end), "message": message }),
    ]
}

/// The values of the scene, its mistakes, warnings about its numbers, and what it can't have beside what it has.
pub fn check(asked: &Asked) -> Value {
    let text = &asked.text;
    let values = text.parse::<toml::Table>().ok().map(|table| json_of(&toml::Value::Table(table)));
    let (mistakes, warnings, loading) = match scene(text) {
        Ok((scene, warnings)) => {
            (Vec::new(), warnings.iter().flat_map(|warning| placed(text, warning)).collect(), scene.laws.name())
        }
        Err(refused) => (refused.mistakes, Vec::new(), DEFAULT_LOADING),
    };
    let mut quantities = Map::new();
    values.iter().for_each(|values| find_quantities(("", ""), "", values, &mut quantities));
    json!({
        "values": values, "quantities": quantities, "mistakes": mistakes, "warnings": warnings, "files": scene::files_named(text),
        "closed": scene::closed(text, loading),
    })
}

/// Finds the texts in the `value` of this key that are numbers with a unit or a hardness: their parts, as a form shows them, by their
/// paths.
fn find_quantities((table, key): (&str, &str), path: &str, value: &Value, found: &mut Map<String, Value>) {
    let below = |name: &str| if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
    match value {
        Value::Object(entries) => {
            entries.iter().for_each(|(name, value)| find_quantities((key, name), &below(name), value, found));
        }
        Value::Array(list) => list.iter().enumerate().for_each(|(index, value)| {
            find_quantities((table, key), &below(&index.to_string()), value, found);
        }),
        Value::String(text) => found.extend(parts((table, key), text).map(|parts| (path.into(), parts))),
        _ => {}
    }
}

/// Number and unit, or scale, of the `text` of a key.
fn parts((table, key): (&str, &str), text: &str) -> Option<Value> {
    if key == HARDNESS {
        let (digits, unit) = reading::shown(text)?;
        return Some(json!({ "digits": digits, "unit": unit }));
    }
    let shown = units::shown(text, quantity_of(table, key).unit?)?;
    Some(json!({ "digits": shown.digits, "unit": shown.unit, "size": shown.size, "number": shown.number }))
}

/// The scene with what the bytes of a table are: a tensile test of its target, in place of another strength, or else depth and force, as
/// its loading curve.
///
/// # Errors
/// What is wrong with the table as either.
pub fn table(asked: &Asked, bytes: &[u8]) -> Result<Value, Refused> {
    let edits = match tension::read(bytes, &Specimen::default()) {
        Ok(test) => tensile_test(test),
        Err(no_test) => match own_curve::read(bytes) {
            Ok(rows) => loading_curve(&rows),
            Err(no_curve) => return Err(format!("no tensile test: {no_test}; no loading curve: {no_curve}").into()),
        },
    };
    Ok(json!({ "text": edited(&asked.text, &edits)? }))
}

fn tensile_test(test: Curve) -> Vec<Edit> {
    let (strains, stresses): (Vec<f64>, Vec<f64>) = test.points.into_iter().unzip();
    let strain = if test.is_plastic { "plastic_strain" } else { "true_strain" };
    let mut edits: Vec<Edit> = STRENGTHS.iter().map(|key| Edit::of(&["target", key], Value::Null)).collect();
    edits.push(Edit::of(&["target", "tensile_test"], json!({ strain: strains, "true_stress": stresses })));
    edits
}

fn loading_curve(rows: &Rows) -> Vec<Edit> {
    let mut edits: Vec<Edit> = OF_LAW.iter().map(|key| Edit::of(&["law", key], Value::Null)).collect();
    edits.push(Edit::of(&["law", "loading"], json!({ "table": rows })));
    edits
}

/// The keys of another loading law. An older curve may have columns that a new one lacks.
const OF_LAW: [&str; 7] =
    ["loading", "unloading", "loading_parameters", "unloading_parameters", "passivity_guard", "restitution", "damping"];

/// The keys that say how strong a body is.
const STRENGTHS: [&str; 8] = [
    "yield_strength",
    "hardening_modulus",
    "tangent_modulus",
    "power_law",
    "hardness",
    "tensile_strength",
    "hardening_exponent",
    "tensile_test",
];

/// A value of TOML as JSON. Dates and numbers that JSON doesn't know are texts.
fn json_of(value: &toml::Value) -> Value {
    match value {
        toml::Value::String(text) => json!(text),
        toml::Value::Integer(number) => json!(number),
        toml::Value::Float(number) if number.is_finite() => json!(number),
        toml::Value::Boolean(flag) => json!(flag),
        toml::Value::Array(values) => values.iter().map(json_of).collect(),
        toml::Value::Table(table) => table.iter().map(|(key, value)| (key.clone(), json_of(value))).collect(),
        other => json!(other.to_string()),
    }
}

/// A commented scene.
#[derive(Deserialize)]
pub struct New {
    name: String,
}

/// A scene to start from.
pub fn new(asked: &New) -> Result<Value, Refused> {
    scene::check_name(&asked.name)?;
    Ok(json!({ "text": scene::new_scene(&asked.name) }))
}

/// Changes to the text of a scene.
#[derive(Deserialize)]
pub struct Edits {
    text: String,
    edits: Vec<Edit>,
}

/// A key that gets a value, or is removed.
#[derive(Deserialize)]
pub struct Edit {
    path: Vec<Step>,
    #[serde(default)]
    value: Value,
    /// What somebody types for it, in place of a value.
    typed: Option<Typed>,
}

/// What is typed in a field, with the unit or the scale beside it.
#[derive(Deserialize)]
struct Typed {
    text: String,
    #[serde(default)]
    unit: String,
    /// Whether the scene has a number without a unit, which stays one where that is exact.
    #[serde(default)]
    bare: bool,
}

impl Typed {
    /// What the scene gets for it. A comma is a decimal sign, as one value has no list; what is no number with its unit stays as it is
    /// typed, so that the scene's message is about it.
    fn value(&self, table: &str, key: &str) -> Value {
        // the digits behind a comma are yet to come
        let text = self.text.trim().trim_end_matches(',');
        let pointed = units::pointed(text).unwrap_or(text.into());
        let number = pointed.replace('_', "").parse::<f64>().ok().filter(|number| number.is_finite());
        if text.is_empty() {
            return Value::Null;
        }
        let whole = if number.is_some() { format!("{pointed} {}", self.unit) } else { text.into() };
        let whole = whole.trim();
        match (quantity_of(table, key).unit, number) {
            _ if key == HARDNESS => match reading::shown(whole) {
                Some((digits, scale)) => json!(format!("{digits} {scale}")),
                None => json!(whole),
            },
            (None, Some(number)) => pointed.parse::<i64>().map_or(json!(number), |number| json!(number)),
            (None, None) => json!(text),
            (Some(unit), _) => match units::shown(whole, unit) {
                Some(shown) => match units::bare(&shown).filter(|_| self.bare) {
                    Some(number) => json!(number),
                    None => json!(format!("{} {}", shown.digits, shown.unit)),
                },
                // a unit of a law
                None if number.is_some() && units::shown(&format!("1 {unit}"), unit).is_none() => json!(number),
                None => json!(whole),
            },
        }
    }
}

/// A step towards a key: into a table, or to an element of an array of tables.
#[derive(Deserialize)]
#[serde(untagged)]
enum Step {
    Element(usize),
    Key(String),
}

/// The text with all edits made.
pub fn edit(asked: &Edits) -> Result<Value, Refused> {
    Ok(json!({ "text": edited(&asked.text, &asked.edits)? }))
}

/// `text` with `edits`. Comments and the order of keys stay.
pub fn edited(text: &str, edits: &[Edit]) -> Result<String, Refused> {
    let mut document: DocumentMut = text.parse().map_err(|error| format!("the text is no TOML: {error}"))?;
    for Edit { path, value, typed } in edits {
        let mut keys =
            path.iter().rev().filter_map(|step| if let Step::Key(key) = step { Some(key.as_str()) } else { None });
        let (key, table) = (keys.next().unwrap_or_default(), keys.next().unwrap_or_default());
        let typed = typed.as_ref().map(|typed| typed.value(table, key));
        change(document.as_table_mut(), path, typed.as_ref().unwrap_or(value))?;
    }
    Ok(document.to_string())
}

impl Edit {
    /// The key at this path gets `value`.
    pub fn of(path: &[&str], value: Value) -> Edit {
        Edit { path: path.iter().map(|key| Step::Key((*key).into())).collect(), value, typed: None }
    }

    /// The `key` of a table `[[contact]]` gets `value`.
    pub fn of_contact(index: usize, key: &str, value: Value) -> Edit {
        Edit {
            path: vec![Step::Key("contact".into()), Step::Element(index), Step::Key(key.into())],
            value,
            typed: None,
        }
    }
}

/// Makes one edit below `table`.
fn change(table: &mut dyn TableLike, path: &[Step], value: &Value) -> Result<(), String> {
    let [Step::Key(key), rest @ ..] = path else { return Err("a path must lead to keys".into()) };
    match rest {
        [] => set(table, key, value),
        [Step::Element(index), rest @ ..] => {
            if table.get(key).is_none() {
                table.insert(key, Item::ArrayOfTables(ArrayOfTables::new()));
            }
            let items = table.get_mut(key).and_then(Item::as_array_of_tables_mut);
            let items = items.ok_or_else(|| format!("`{key}` is no array of tables"))?;
            if rest.is_empty() && value.is_null() {
                if *index < items.len() {
                    items.remove(*index);
                }
                if items.is_empty() {
                    table.remove(key);
                }
                return Ok(());
            }
            if *index == items.len() {
                items.push(Table::new());
            }
            let item = items.get_mut(*index).ok_or_else(|| format!("`{key}` has no element {index}"))?;
            if rest.is_empty() { fill(item, value) } else { change(item, rest, value) }
        }
        [Step::Key(_), ..] => {
            if table.get(key).is_none() {
                if value.is_null() {
                    return Ok(());
                }
                table.insert(key, Item::Table(Table::new()));
            }
            let below = table.get_mut(key).and_then(Item::as_table_like_mut);
            change(below.ok_or_else(|| format!("`{key}` is no table"))?, rest, value)
        }
    }
}

/// Sets a key, or removes it. What stands before and behind the value stays.
fn set(table: &mut dyn TableLike, key: &str, value: &Value) -> Result<(), String> {
    if value.is_null() {
        table.remove(key);
        return Ok(());
    }
    if let Value::Object(entries) = value
        && table.get(key).is_none()
        && !table.is_dotted()
        && !entries.is_empty()
    {
        table.insert(key, Item::Table(Table::new()));
    }
    if let (Value::Object(_), Some(below)) = (value, table.get_mut(key).and_then(Item::as_table_like_mut)) {
        return fill(below, value);
    }
    let mut new = toml_of(value)?;
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => {
            *new.decor_mut() = old.decor().clone();
            *old = new;
        }
        None => {
            // the space before the brace of an inline table stays there
            let last =
                table.iter_mut().last().and_then(|(_, item)| item.as_value_mut().map(toml_edit::Value::decor_mut));
            if let Some(last) = last
                && let Some(space) = last.suffix().and_then(RawString::as_str).filter(|text| text.trim().is_empty())
            {
                let space = space.to_string();
                last.set_suffix("");
                new.decor_mut().set_suffix(space);
                new.decor_mut().set_prefix(" ");
            }
            table.insert(key, Item::Value(new));
        }
    }
    Ok(())
}

/// Sets the keys of an object in a table.
fn fill(table: &mut dyn TableLike, value: &Value) -> Result<(), String> {
    let Value::Object(entries) = value else { return Err("a table takes an object".into()) };
    entries.iter().try_for_each(|(key, value)| set(table, key, value))
}

/// A value of JSON as TOML.
fn toml_of(value: &Value) -> Result<toml_edit::Value, String> {
    let inline = |entries: &Map<String, Value>| {
        let mut table = InlineTable::new();
        for (key, value) in entries {
            table.insert(key, toml_of(value)?);
        }
        Ok::<_, String>(table)
    };
    Ok(match value {
        Value::Bool(flag) => (*flag).into(),
        Value::Number(number) => match number.as_i64() {
            Some(number) => number.into(),
            None => number.as_f64().ok_or("a number that is none")?.into(),
        },
        Value::String(text) => text.as_str().into(),
        Value::Array(values) => {
            let values = values.iter().map(toml_of).collect::<Result<Vec<_>, _>>()?;
            toml_edit::Value::Array(values.into_iter().collect())
        }
        Value::Object(entries) => inline(entries)?.into(),
        Value::Null => return Err("a value within a value can't be removed".into()),
    })
}
