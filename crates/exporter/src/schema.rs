//! The JSON Schema (draft 2020-12) of scene files. Keys, types and words are those of the types that read a scene; units and ranges those of
//! the checks; names those of the tables.

mod rules;

use crate::model::Dampings;
use crate::pairing::TABLE;
use crate::parameters::{self, LawConstant};
use crate::reading;
use crate::scene::{
    FLAT, IDENTIFIER, INPUTS, OF_ALL_CONTACTS, PRODUCT, RATE_MODELS, SceneFile, WAVES, is_no_name, quantity_of,
};
use crate::table::{self, Causality, MATERIALS, VARIABLES, Variable};
use crate::{units, xml};
use brinell_contact::damped::AnyDamped;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};
use std::ops::RangeInclusive;

/// The schema of scenes. Its extensions: `x-unit`, the SI unit of a bare number; `x-units`, units that a number in quotes may have;
/// `x-default`, what holds without the key, in words; `x-taplo`, a line for each value of an enumeration.
pub fn schema() -> Value {
    let mut schema = documented();
    each_text(&mut schema, &|text| *text = without_links(text));
    schema
}

/// The schema whose descriptions have links to pages of the guide.
pub fn documented() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
    let mut schema = settings.into_generator().into_root_schema_for::<SceneFile>().into();
    complete(&mut schema, "");
    let target = schema["properties"]["target"]["properties"].clone();
    borrow_words(&mut schema["properties"]["impactor"]["properties"], &target);
    let of_all = schema["properties"].clone();
    for body in ["impactor", "target"] {
        let own = &mut schema["properties"]["contact"]["items"]["properties"][body]["properties"];
        *own = of_all[body]["properties"].clone();
        let own = own.as_object_mut().expect("keys");
        own.retain(|key, _| !OF_ALL_CONTACTS.contains(&key.as_str()));
        own.values_mut().for_each(|key| {
            key.as_object_mut().expect("a schema").remove("default");
            key["x-default"] = json!(format!("that of `[{body}]`"));
        });
    }
    schema["properties"]["name"]["not"] = is_no_name();
    rules::add(&mut schema);
    schema["title"] = json!("Scene of Brinell");
    schema
}

/// Gives `keys` without a description what the same keys of `others` say.
fn borrow_words(keys: &mut Value, others: &Value) {
    for (key, schema) in keys.as_object_mut().expect("keys") {
        for word in ["description", "x-default", "examples"] {
            // a table has the words of its type
            let has_own = schema.get(word).is_some() && schema.get("properties").is_none();
            if !has_own && others[key].get(word).is_some() {
                schema[word] = others[key][word].clone();
            }
        }
    }
}

/// Completes the `schema` of the key at this `path`: `.contact.impactor.radius`.
fn complete(schema: &mut Value, path: &str) {
    let Value::Object(object) = schema else { return };
    simplify(object);
    if let Some(Value::Object(keys)) = object.get_mut("properties") {
        keys.iter_mut().for_each(|(key, schema)| complete(schema, &format!("{path}.{key}")));
    }
    if let Some(items) = object.get_mut("items") {
        complete(items, path);
    }
    let (tables, key) = path.rsplit_once('.').unwrap_or_default();
    let table = tables.rsplit('.').next().unwrap_or_default();
    if object.get("type") == Some(&json!("number")) {
        number(object, table, key);
    }
    form(object, table, key);
}

/// Leaves out what TOML has not got and what says nothing, and writes each enumeration as a list with a line for each value.
fn simplify(schema: &mut Map<String, Value>) {
    schema.remove("format");
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|name| name != "null");
        if let [only] = types.as_slice() {
            schema["type"] = only.clone();
        }
    }
    if let Some(Value::Array(values)) = schema.get_mut("enum") {
        values.retain(|value| !value.is_null());
    }
    if let Some(Value::Array(mut ways)) = schema.remove("anyOf") {
        ways.retain(|way| way["type"] != "null");
        for (key, value) in ways.remove(0).as_object().expect("a schema") {
            schema.entry(key.clone()).or_insert(value.clone());
        }
        return simplify(schema);
    }
    if let Some(Value::Array(values)) = schema.remove("oneOf") {
        let text = |value: &Value, key: &str| value[key].as_str().unwrap_or_default().to_string();
        let values = values.iter().map(|value| (text(value, "const"), text(value, "description")));
        enumerate(schema, values.collect());
    }
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.replace('\n', " ");
    }
}

/// Makes the schema one of these values, each with a line about it.
fn enumerate(schema: &mut Map<String, Value>, values: Vec<(String, String)>) {
    let (names, lines): (Vec<_>, Vec<_>) = values.into_iter().unzip();
    schema.insert("type".into(), json!("string"));
    schema.insert("enum".into(), json!(names));
    if lines.iter().any(|line| !line.is_empty()) {
        schema.insert("x-taplo".into(), json!({ "docs": { "enumValues": lines } }));
    }
}

/// A number with its range, and the texts that stand for one.
fn number(schema: &mut Map<String, Value>, table: &str, key: &str) {
    let quantity = quantity_of(table, key);
    quantify(schema, quantity.unit, &quantity.allowed);
}

/// A number in this unit, with these limits.
fn quantify(schema: &mut Map<String, Value>, unit: Option<&str>, allowed: &RangeInclusive<f64>) {
    limit(schema, allowed);
    let Some(unit) = unit else { return };
    schema.insert("x-unit".into(), json!(unit));
    if let Some((pattern, usual)) = units::pattern(unit, *allowed.start() < 0.0) {
        schema.insert("type".into(), json!(["number", "string"]));
        schema.insert("pattern".into(), json!(pattern));
        schema.insert("x-units".into(), json!(usual));
    }
}

/// The schema of a constant of a law.
fn complete_constants(constant: &LawConstant) -> Value {
    let LawConstant { value, unit, minimum, maximum, description, .. } = constant;
    let mut schema = json!({ "type": "number", "default": value, "description": description });
    let schema = schema.as_object_mut().expect("an object");
    quantify(schema, Some(*unit).filter(|unit| !unit.is_empty()), &(*minimum..=*maximum));
    if let Some(pattern) = parameters::pattern_of_a_spring(unit) {
        schema.extend([("type".into(), json!(["number", "string"])), ("pattern".into(), json!(pattern))]);
    }
    Value::Object(std::mem::take(schema))
}

fn object(keys: impl Iterator<Item = (String, Value)>) -> Value {
    Value::Object(keys.collect())
}

/// The bounds of a number.
fn limit(schema: &mut Map<String, Value>, allowed: &RangeInclusive<f64>) {
    let bounds = [
        ("exclusiveMinimum", Some(0.0).filter(|_| *allowed.start() == f64::MIN_POSITIVE)),
        ("minimum", Some(*allowed.start()).filter(|least| ![f64::MIN, f64::MIN_POSITIVE].contains(least))),
        ("maximum", Some(*allowed.end()).filter(|most| *most != f64::MAX)),
    ];
    schema.extend(bounds.into_iter().filter_map(|(key, bound)| Some((key.into(), json!(bound?)))));
}

/// The names that a text may be, each with a line about it, if they are known.
fn names(table: &str, key: &str) -> Option<Vec<(String, String)>> {
    let plain = |names: &[&str]| names.iter().map(|name| ((*name).to_string(), String::new())).collect();
    let of_laws = |laws: Vec<&table::Law>| laws.iter().map(|law| (law.name.clone(), law.title.clone())).collect();
    Some(match (table, key) {
        ("law", "loading") => of_laws(table::loading_laws().into_iter().filter(|law| law.name != TABLE).collect()),
        ("law", "unloading") => of_laws(table::unloading_laws()),
        ("law", "damping") => plain(&AnyDamped::ALL.iter().flat_map(|(_, law)| law.dampings()).collect::<Vec<_>>()),
        ("fmu", "outputs") => {
            variables(Causality::Output).map(|output| (output.name.clone(), output.description.clone())).collect()
        }
        ("coupling", "inputs") => plain(&INPUTS),
        ("rate", "model") => plain(&RATE_MODELS),
        _ => return None,
    })
}

/// The name of a law, or a table with the name of a file.
fn own_curve(schema: &mut Map<String, Value>) {
    let names: Map<String, Value> = ["enum", "x-taplo"].iter().filter_map(|key| schema.remove_entry(*key)).collect();
    schema.insert("type".into(), json!(["string", "object"]));
    let table = json!({
        "type": "object", "required": [TABLE], "additionalProperties": false,
        "properties": { (TABLE): { "type": ["string", "object"], "description": "The name of a file." } },
    });
    // of a mistyped name is said which names there are; with `anyOf`, only that it fits nowhere
    schema.insert("if".into(), json!({ "type": "object" }));
    schema.insert("then".into(), table);
    schema.insert("else".into(), names.into());
}

fn variables(causality: Causality) -> impl Iterator<Item = &'static Variable> {
    VARIABLES.iter().filter(move |variable| variable.causality == causality && variable.second_of.is_none())
}

/// The forms of a text, and of what has several forms.
fn form(schema: &mut Map<String, Value>, table: &str, key: &str) {
    let is_list = schema.get("type") == Some(&json!("array"));
    if let Some(values) = names(table, key).filter(|_| !is_list) {
        enumerate(schema, values);
        if (table, key) == ("law", "loading") {
            own_curve(schema);
        }
        return;
    }
    let more = match (table, key) {
        // a ball, the principal axes, or the tensor
        ("body", "inertia") if is_list => {
            let mut product = json!({ "type": "number" });
            number(product.as_object_mut().expect("a schema"), table, PRODUCT);
            let moment = std::mem::replace(&mut schema["items"], product);
            let mut all = moment.clone();
            all["type"] = json!(["number", "array", "string"]);
            let tensor = json!({ "minItems": 6, "maxItems": 6 });
            all["anyOf"] =
                json!([{ "type": ["number", "string"] }, { "items": moment, "minItems": 3, "maxItems": 3 }, tensor]);
            all
        }
        // the vector of an arm, or none
        ("contact", "arms") if is_list && schema["items"].get("items").is_none() => {
            json!({ "anyOf": [{ "maxItems": 0 }, { "minItems": 3, "maxItems": 3 }] })
        }
        ("fmu" | "contact", "parameters" | "parameters_per_contact") if !is_list => {
            let names: Vec<_> = variables(Causality::Parameter).map(|variable| variable.name.as_str()).collect();
            let any = names.join("|").replace('.', r"\.");
            let owner = if table == "fmu" { r"(?:[A-Za-z_]\w*\.)?" } else { "" };
            json!({ "pattern": format!("^{owner}(?:{any})$"), "examples": names })
        }
        // the principal radii
        ("impactor" | "target", "radius") => {
            let mut one = json!({ "type": "number" });
            // either may be hollow
            number(one.as_object_mut().expect("a schema"), "target", key);
            let items = json!({ "anyOf": [one, { "const": FLAT }] });
            json!({ "type": ["number", "string", "array"], "items": items, "minItems": 2, "maxItems": 2 })
        }
        // those of one's own have other names
        ("impactor" | "target", "material") => {
            let names: Vec<_> = MATERIALS.iter().map(|material| material.name.as_str()).collect();
            json!({ "anyOf": [{ "enum": names }, { "type": "string" }] })
        }
        ("law", "elastic_restitution") => {
            json!({ "type": ["number", "string"], "pattern": format!("^{WAVES}$") })
        }
        // the name of a file
        (_, "tensile_test") | ("tensile_test", "curve") => json!({ "type": ["object", "string"] }),
        ("law", "loading_parameters" | "unloading_parameters") => {
            json!({ "additionalProperties": { "type": ["number", "string"] } })
        }
        ("" | "body" | "contact", "name") => json!({ "pattern": IDENTIFIER }),
        ("", "description" | "author") => json!({ "pattern": xml::ALLOWED }),
        (_, "hardness") => json!({ "pattern": reading::pattern() }),
        _ => return,
    };
    let Value::Object(more) = more else { return };
    schema.extend(more);
}

/// Changes all descriptions and defaults in words.
fn each_text(schema: &mut Value, change: &impl Fn(&mut String)) {
    match schema {
        Value::Object(object) => object.iter_mut().for_each(|(key, value)| match value {
            Value::String(text) if key == "description" || key == "x-default" => change(text),
            value => each_text(value, change),
        }),
        Value::Array(list) => list.iter_mut().for_each(|value| each_text(value, change)),
        _ => {}
    }
}

/// The `text` with the words of its links alone: those to pages of the guide mean nothing elsewhere.
pub fn without_links(text: &str) -> String {
    let mut parts = text.split("](");
    let mut plain = parts.next().unwrap_or_default().to_string();
    for part in parts {
        if let Some(place) = plain.rfind('[') {
            plain.remove(place);
        }
        plain += part.split_once(')').map_or(part, |(_, after)| after);
    }
    plain
}
