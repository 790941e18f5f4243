//! What one key of a scene says about others: the rules of the check, as far as a schema can express them, and what goes with each law.

use super::{complete_constants, object};
use crate::measured::TEST_RATE;
use crate::model::Dampings;
use crate::pairing;
use crate::parameters::{self, LawConstant};
use crate::reading;
use crate::scene::rules::{BODIES, Is, Key, Level, RULES, Rule};
use crate::scene::{GROUND, reserved_names};
use crate::table;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use serde_json::{Value, json};

/// Adds the rules to the `schema` of scenes.
pub fn add(schema: &mut Value) {
    schema["allOf"] = RULES.iter().filter(|rule| rule.body.is_none()).map(of_scene).collect();
    let keys = &mut schema["properties"];
    for body in BODIES {
        let of_table = RULES.iter().filter(|rule| rule.body.as_deref() == Some(body)).map(of_table);
        let of_table: Value = of_table.chain(of_readings()).collect();
        keys[body]["allOf"] = of_table.clone();
        keys["contact"]["items"]["properties"][body]["allOf"] = of_table;
    }
    let contact = &mut keys["contact"]["items"]["properties"];
    contact["name"]["not"] = json!({ "enum": reserved_names() });
    contact["between"]["uniqueItems"] = json!(true);
    for direction in ["normal", "tangent"] {
        contact[direction]["not"] = json!({ "items": { "const": 0 } });
    }
    keys["body"]["items"]["properties"]["name"]["not"] = json!({ "const": GROUND });
    keys["law"]["allOf"] = json!(of_laws());
}

/// A rule about keys of one table.
fn of_table(rule: &Rule) -> Value {
    let any_of = |keys: &[Key]| any(keys.iter().map(|key| is(&key.path, key)));
    let what = any_of(&rule.what);
    implies(all(rule.when.iter().map(|keys| any_of(keys))), if rule.forbids { not(what) } else { what })
}

/// A part of what has to hold of a scene with contacts: one of these of the scene, or one of those of each contact.
#[derive(Clone, Default)]
struct Clause {
    of_scene: Vec<Value>,
    of_contact: Vec<Value>,
    /// Whether the latter holds where a contact has nothing of its own, and so where there are no tables of contacts.
    holds_of_none: bool,
}

/// A rule about keys of the scene and of its contacts. That a body has a key means that the contact has it, or the scene for all; so what
/// has to hold becomes a list of clauses, each of which has parts of the scene and parts of the contacts.
fn of_scene(rule: &Rule) -> Value {
    let is_of_scene = |keys: &&Vec<Key>| keys.iter().all(|key| key.level() == Level::Scene);
    let (once, each): (Vec<_>, Vec<_>) = rule.when.iter().partition(is_of_scene);
    let condition = |keys: &Vec<Key>| {
        let any = any(keys.iter().map(|key| is(&key.path, key)));
        if keys[0].no { not(any) } else { any }
    };
    // a condition that fails is enough, or one of what is needed; a condition of several keys fails if each of them does
    let mut wanted: Vec<Vec<(bool, &Key)>> = match rule.forbids {
        true => rule.what.iter().map(|key| vec![(true, key)]).collect(),
        false => vec![rule.what.iter().map(|key| (false, key)).collect()],
    };
    for keys in each.into_iter().rev() {
        let keys = keys.iter().map(|key| (!key.no, key));
        let or_rest = |key| wanted.iter().map(move |rest| [key].into_iter().chain(rest.iter().copied()).collect());
        wanted = keys.flat_map(or_rest).collect();
    }
    let then = wanted.iter().flat_map(|literals| {
        let mut clauses = vec![Clause::default()];
        literals.iter().for_each(|(is_not, key)| clauses = with(std::mem::take(&mut clauses), *is_not, key));
        clauses
    });
    implies(all(once.into_iter().map(condition)), all(then.map(Clause::schema)))
}

/// The `clauses` with one more part: a `key`, or that it is not so.
fn with(clauses: Vec<Clause>, is_not: bool, key: &Key) -> Vec<Clause> {
    let negated = |value: Value| if is_not { not(value) } else { value };
    let own = if key.level() == Level::Contact { &key.path[1..] } else { &key.path[..] };
    let add_of_scene = |mut clause: Clause| {
        clause.of_scene.push(negated(is(&key.path, key)));
        clause
    };
    let add_of_contact = |mut clause: Clause| {
        clause.of_contact.push(negated(is(own, key)));
        clause.holds_of_none |= is_not;
        clause
    };
    match key.level() {
        Level::Scene => clauses.into_iter().map(add_of_scene).collect(),
        Level::Contact => clauses.into_iter().map(add_of_contact).collect(),
        // neither the contact nor the scene has it
        Level::Body if is_not => {
            clauses.into_iter().flat_map(|clause| [add_of_scene(clause.clone()), add_of_contact(clause)]).collect()
        }
        Level::Body => clauses.into_iter().map(|clause| add_of_contact(add_of_scene(clause))).collect(),
    }
}

impl Clause {
    fn schema(mut self) -> Value {
        if !self.of_contact.is_empty() {
            let each = json!({ "properties": { "contact": { "items": any(self.of_contact) } } });
            self.of_scene.push(if self.holds_of_none { each } else { all([has("contact"), each]) });
        }
        any(self.of_scene)
    }
}

/// The table in which the value at this `path` is as the `key` wants it.
fn is(path: &[String], wanted: &Key) -> Value {
    let values = |names: &[String]| {
        let value = |name: &String| match name.parse() {
            Ok(value) => Value::Bool(value),
            Err(_) => json!(name),
        };
        json!({ "enum": names.iter().map(value).collect::<Vec<_>>() })
    };
    match path {
        [first, rest @ ..] if first == "contacts" => key("contact", json!({ "contains": is(rest, wanted) })),
        [only] => match &wanted.is {
            Is::There => has(only),
            Is::In(names) => key(only, values(names)),
            Is::NotIn(names) => key(only, not(values(names))),
            Is::With(names) => key(only, json!({ "contains": values(names) })),
            Is::Two => key(only, json!({ "type": "array" })),
        },
        [table, rest @ ..] => key(table, is(rest, wanted)),
        [] => json!(true),
    }
}

/// What a reading says of the rate of a body.
fn of_readings() -> [Value; 2] {
    let slow = json!({ "properties": { "rate": { "properties": { "reference_rate": { "const": TEST_RATE } } } } });
    [
        implies(any(["hardness", "tensile_strength", "tensile_test"].map(has)), slow),
        implies(key("hardness", json!({ "pattern": reading::of_impacts() })), not(has("rate"))),
    ]
}

/// What goes with each law, by the table of laws.
fn of_laws() -> Vec<Value> {
    let with = |law: &str, name: &str, so: Vec<Value>| implies(key(law, json!({ "const": name })), all(so));
    let property = |key: &str, so: Value| json!({ "properties": { key: so } });
    let of_loading = AnyLoading::ALL.iter().map(|(name, law)| {
        let misfits = AnyUnloading::ALL.iter().filter(|(other, _)| pairing::check(name, other).is_err());
        let misfits =
            property("unloading", not(json!({ "enum": misfits.map(|(other, _)| other).collect::<Vec<_>>() })));
        let own = constants("loading_parameters", &parameters::constants(law, table::loading_law(name)));
        with("loading", name, vec![own, misfits])
    });
    let of_damped = AnyDamped::ALL.iter().map(|(name, law)| {
        let own = constants("loading_parameters", &parameters::constants(law, table::damped_law(name)));
        let variants = Some(law.dampings()).filter(|variants| !variants.is_empty());
        let damping = variants.map(|variants| property("damping", json!({ "enum": variants })));
        with("loading", name, [own].into_iter().chain(damping).collect())
    });
    let of_unloading = AnyUnloading::ALL.iter().map(|(name, law)| {
        let own = constants("unloading_parameters", &parameters::constants(law, table::unloading_law(name)));
        let made = table::unloading_law(name).made_for.as_ref().map(|made| {
            let published = pairing::published(&made.loading);
            let of = |name: &String| (name.clone(), json!({ "const": parameters::value_of(&published, name) }));
            property("loading_parameters", json!({ "properties": object(made.as_published.iter().map(of)) }))
        });
        with("unloading", name, [own].into_iter().chain(made).collect())
    });
    of_loading.chain(of_damped).chain(of_unloading).collect()
}

/// The constants of a law under this key.
fn constants(key: &str, constants: &[LawConstant]) -> Value {
    let of = |constant: &LawConstant| (constant.name.to_string(), complete_constants(constant));
    let keys = object(constants.iter().map(of));
    json!({ "properties": { key: { "properties": keys, "additionalProperties": false } } })
}

fn has(key: &str) -> Value {
    json!({ "required": [key] })
}

/// A table whose `key` exists, and is so.
fn key(key: &str, so: Value) -> Value {
    json!({ "required": [key], "properties": { key: so } })
}

fn not(what: Value) -> Value {
    json!({ "not": what })
}

fn all(of: impl IntoIterator<Item = Value>) -> Value {
    several("allOf", of.into_iter().collect())
}

fn any(of: impl IntoIterator<Item = Value>) -> Value {
    several("anyOf", of.into_iter().collect())
}

fn several(which: &str, mut of: Vec<Value>) -> Value {
    match of.len() {
        0 => json!(which == "allOf"),
        1 => of.remove(0),
        _ => json!({ which: of }),
    }
}

fn implies(one: Value, other: Value) -> Value {
    json!({ "if": one, "then": other })
}
