//! The constants of a law: their list, and the law with the constants of a scene.

use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::nearest::{one_of, unknown};
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
    check_typed_stiffness(&law, key, given)?;
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

/// The constants of the function IMPACT that stand for the same thing, and the exponent of both.
const TYPED: &str = "stiffness";
const FACTOR: &str = "stiffness_factor";
const EXPONENT: &str = "exponent";

/// The units of a stiffness with an exponent, and of a damping.
const STIFFNESS: &str = "N/m^n";
const DAMPING: &str = "N.s/m";

/// The pattern, for JSON Schema, of texts with another unit of multibody tools in place of this `unit`, if there are such.
pub fn pattern_of_a_spring(unit: &str) -> Option<&'static str> {
    match unit {
        STIFFNESS => Some(r"^\s*\+?[0-9.]+(?:[eE][+-]?[0-9]+)?\s*N/mm?(?:\^[0-9.]+)?\s*$"),
        DAMPING => Some(r"^\s*\+?[0-9.]+(?:[eE][+-]?[0-9]+)?\s*N[.* ]s/mm?\s*$"),
        _ => None,
    }
}

/// Rejects a typed stiffness beside a factor, and one whose unit has another exponent than `law`.
fn check_typed_stiffness(
    law: &impl Serialize,
    key: &str,
    given: &BTreeMap<Spanned<String>, Spanned<toml::Value>>,
) -> Result<(), Mistake> {
    let of = |name: &str| given.iter().find(|(known, _)| known.get_ref() == name).map(|(_, value)| value);
    let (Some(typed), Some(exponent)) = (of(TYPED), value_of(law, EXPONENT)) else { return Ok(()) };
    if let Some(factor) = of(FACTOR).filter(|_| value_of(law, TYPED).is_some_and(|stiffness| stiffness > 0.0)) {
        let message = format!("{key}_parameters.{FACTOR} has no effect beside {TYPED}, which is the stiffness itself");
        return Err(Mistake(factor.span(), message));
    }
    let power = typed.get_ref().as_str().and_then(spring_unit).map(|(.., power)| power);
    match power.filter(|power| *power != exponent) {
        Some(power) => {
            let [power, exponent] = [power, exponent].map(in_message);
            let message = format!(
                "{key}_parameters.{TYPED} = {}: the unit has the power {power}, but {EXPONENT} = {exponent}; they must be the same",
                typed.get_ref()
            );
            Err(Mistake(typed.span(), message))
        }
        None => Ok(()),
    }
}

/// The number in SI units of a stiffness or damping `text` with a unit that multibody tools have, such as `1e5 N/mm^2.2` or
/// `10 N.s/mm`; `None` for other texts, and for constants with another SI `unit`.
fn in_units_of_a_spring(text: &str, unit: &str) -> Option<Result<f64, String>> {
    let (words, usual) = match unit {
        STIFFNESS => ("a stiffness", ["N/m^1.5", "N/mm^1.5"]),
        DAMPING => ("a damping", ["N.s/m", "N.s/mm"]),
        _ => return None,
    };
    let allowed = || Err(format!("{words} has a unit like {}", one_of(&usual)));
    let Some((number, seconds, power)) = spring_unit(text) else { return Some(allowed()) };
    if seconds != (unit == DAMPING) || seconds && power != 1.0 {
        return Some(allowed());
    }
    Some(Ok(number))
}

/// The number in newtons, metres and seconds of such a text; whether there are seconds; and the power of the length.
fn spring_unit(text: &str) -> Option<(f64, bool, f64)> {
    let (number, unit) =
        text.trim().split_once(' ').or_else(|| text.trim().split_at_checked(text.trim().find('N')?))?;
    let (above, below) = unit.trim().split_once('/')?;
    let seconds = match above {
        "N" => false,
        "N.s" | "N s" | "N*s" => true,
        _ => return None,
    };
    let (length, power) = below.split_once('^').map_or((below, None), |(length, power)| (length, Some(power)));
    let power = power.map_or(Ok(1.0), str::parse::<f64>).ok()?;
    let scale = match length {
        "m" => 1.0,
        "mm" => libm::pow(1e3, power),
        _ => return None,
    };
    Some((number.trim().parse::<f64>().ok()? * scale, seconds, power))
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
            let with_unit = other.as_str().and_then(|text| {
                in_units_of_a_spring(text, &parameter.unit).or_else(|| units::with_unit(text, &parameter.unit))
            });
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
