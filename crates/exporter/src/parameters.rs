//! The constants of a law: their list, and the law with the constants of a scene.

use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::nearest::unknown;
use crate::numbers::{in_message, out_of_range};
use crate::table;
use crate::units;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// A table of constants in a scene.
pub type ConstantTable = Spanned<BTreeMap<Spanned<String>, Spanned<toml::Value>>>;

/// A constant of a law with its value, for output.
#[derive(Clone, Debug, Serialize)]
pub struct LawConstant {
    pub name: &'static str,
    pub value: f64,
    pub unit: &'static str,
    pub minimum: f64,
    pub maximum: f64,
    pub description: &'static str,
}

/// The fields of a serialized law. An enum of laws is a table with one entry, whose key is the name of the variant. A law
/// without constants has no fields.
fn fields(law: &mut Value) -> Option<&mut Map<String, Value>> {
    let Value::Object(outer) = law else { return None };
    let is_enum = outer.len() == 1 && outer.values().all(|value| value.is_object() || value.is_null());
    if is_enum { outer.values_mut().next().and_then(Value::as_object_mut) } else { Some(outer) }
}

fn serialized(law: &impl Serialize) -> Value {
    serde_json::to_value(law).expect("a law is made of numbers")
}

/// The constant `name` of `law`; `None` if there is none, or if it is a list.
pub fn value_of(law: &impl Serialize, name: &str) -> Option<f64> {
    fields(&mut serialized(law))?.get(name)?.as_f64()
}

/// The constant `name` of `law`, or all its numbers if it is a list; `None` if there is none.
pub fn numbers_of(law: &impl Serialize, name: &str) -> Option<Vec<f64>> {
    match fields(&mut serialized(law))?.get(name)? {
        Value::Array(list) => list.iter().map(Value::as_f64).collect(),
        number => Some(vec![number.as_f64()?]),
    }
}

/// `law` with the `given` constants instead of its own.
///
/// # Errors
/// The first name that is not a number of the law.
pub fn with_parameters<T: Serialize + DeserializeOwned>(law: &T, given: &[(String, f64)]) -> Result<T, String> {
    let mut tree = serialized(law);
    for (name, value) in given {
        match fields(&mut tree).and_then(|fields| fields.get_mut(name)) {
            Some(field) if field.is_number() => *field = Value::from(*value),
            _ => return Err(name.clone()),
        }
    }
    Ok(serde_json::from_value(tree).expect("numbers in place of numbers"))
}

/// The constants of `law` that a scene can change, in the order of the `table`.
pub fn constants(law: &impl Serialize, table: &'static table::Law) -> Vec<LawConstant> {
    let constant = |parameter: &'static table::LawParameter| {
        let value = value_of(law, &parameter.name).expect("a test compares the table with the laws");
        let table::LawParameter { name, unit, minimum, maximum, description, .. } = parameter;
        LawConstant { name, value, unit, minimum: *minimum, maximum: *maximum, description }
    };
    table.parameters.iter().map(constant).collect()
}

/// The law with the constants under `key` ("law.loading") of the scene. They are checked individually and against each other.
pub fn apply<T: Serialize + DeserializeOwned>(
    law: T,
    key: &str,
    given: Option<&ConstantTable>,
    table: &'static table::Law,
) -> Result<T, Mistake> {
    let Some(given) = given else { return Ok(law) };
    let given = given.get_ref();
    let mut checked = Vec::new();
    for (name, value) in given {
        let number = check_one(key, name, value, table)?;
        checked.push((name.get_ref().clone(), number));
    }
    let law = with_parameters(&law, &checked).expect("the table names the law's own constants");
    for parameter in &table.parameters {
        let Some(below) = &parameter.below else { continue };
        let value = |name: &str| value_of(&law, name).expect("the table names the law's own constants");
        let (small, large) = (value(&parameter.name), value(below));
        let mut mentioned = given.keys().filter(|name| *name.get_ref() == parameter.name || name.get_ref() == below);
        if let Some(name) = mentioned.next().filter(|_| small >= large) {
            let [small, large] = [small, large].map(in_message);
            let message = format!("{key}_parameters.{} = {small} must be below {below} = {large}", parameter.name);
            return Err(Mistake(given[name].span(), message));
        }
    }
    Ok(law)
}

/// The number that the scene gives for the constant `name`.
fn check_one(
    key: &str,
    name: &Spanned<String>,
    value: &Spanned<toml::Value>,
    table: &table::Law,
) -> Result<f64, Mistake> {
    let asked = name.get_ref();
    let law = &table.name;
    if table.fixed.contains(asked) {
        let message =
            format!("{key}_parameters.{asked} belongs to the fit of `{law}` as a whole; a scene can't change it");
        return Err(Mistake(name.span(), message));
    }
    let Some(parameter) = table.parameters.iter().find(|parameter| parameter.name == *asked) else {
        let message = match table.parameters.as_slice() {
            [] => format!("unknown parameter `{asked}` of {key} = \"{law}\", which has none"),
            all => {
                unknown(&format!("parameter of {key} = \"{law}\""), asked, all.iter().map(|other| other.name.as_str()))
            }
        };
        return Err(Mistake(name.span(), message));
    };
    let number = match value.get_ref() {
        toml::Value::Float(number) => *number,
        toml::Value::Integer(number) => *number as f64,
        other => {
            let wrong = |why: &str| Mistake(value.span(), format!("{key}_parameters.{asked} = {other}{why}"));
            let with_unit = other.as_str().and_then(|text| units::with_unit(text, &parameter.unit));
            let with_unit = with_unit.ok_or_else(|| wrong(" is not a number"))?;
            with_unit.map_err(|why| wrong(&format!(": {why}")))?
        }
    };
    let table::LawParameter { minimum, maximum, unit, .. } = parameter;
    if !(*minimum..=*maximum).contains(&number) {
        let message = format!("{key}_parameters.{asked} {}", out_of_range(number, &(*minimum..=*maximum), unit));
        return Err(Mistake(value.span(), message));
    }
    Ok(number)
}
