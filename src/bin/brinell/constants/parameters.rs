//! The parameters as constants: those that can be set, and where every one has its value from.

use super::{add, list, literal};
use crate::interface::Entry;
use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Causality, Variable};
use std::fmt::Write;

/// What the parameters stand for that a scene hasn't got: a rigid impactor, a flat target, a contact that never yields,
/// no damping.
const ABSENT: [(&str, f64); 6] = [
    ("impactor.youngs_modulus", f64::INFINITY),
    ("impactor.poissons_ratio", 0.0),
    ("target.radius", f64::INFINITY),
    ("target.yield_strength", f64::INFINITY),
    ("restitution", 1.0),
    ("effective_mass", f64::INFINITY),
];

pub fn add_settable(text: &mut String, entries: &[Entry]) {
    let settable: Vec<_> = entries.iter().filter(|entry| entry.variable.causality == Causality::Parameter).collect();
    let mut table =
        format!("/// The parameters that can be set.\npub const SETTABLE: [Settable; {}] = [", settable.len());
    for entry in &settable {
        let Entry { variable, start, .. } = entry;
        let unit = variable.unit.as_deref().unwrap_or("");
        let [start, minimum, maximum] = [*start, variable.minimum, variable.maximum]
            .map(|value| literal(value.expect("a parameter has a start value and limits")));
        write!(
            table,
            "\n    Settable {{ name: {:?}, unit: {unit:?}, start: {start}, minimum: {minimum}, maximum: {maximum} }},",
            entry.name(0)
        )
        .expect("a String takes everything");
    }
    table.push_str(if settable.is_empty() { "];\n" } else { "\n];\n" });
    add(text, &table);
}

/// The variables that a scene can have as parameters.
fn parameters() -> impl Iterator<Item = &'static Variable> {
    table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter)
}

/// Those of them that not all groups have from the same source.
pub fn differing(scene: &Scene) -> impl Iterator<Item = &'static Variable> {
    let own = |variable: &&Variable, group: &Group| group.own.iter().any(|own| own.name == variable.name);
    parameters()
        .filter(move |variable| scene.contacts.len() > 1 && scene.contacts.iter().any(|group| own(variable, group)))
}

pub fn add_parameters(text: &mut String, scene: &Scene) {
    // where each group has its own parameters among those that can be set
    let mut first = scene.settable().count();
    let firsts = scene.contacts.iter().map(|group| {
        let own = group.own.iter().filter(|own| own.settable).count();
        first += own;
        first - own
    });
    let firsts: Vec<usize> = firsts.collect();
    let place = |list: &[Parameter], name: &str| {
        let parameter = list.iter().find(|parameter| parameter.name == name)?;
        let place = list.iter().filter(|other| other.settable).position(|other| other.name == name);
        Some((parameter.value, place))
    };
    let source = |group: usize, name: &str| match place(&scene.contacts[group].own, name) {
        Some((_, Some(place))) => Value::Settable(firsts[group] + place),
        Some((value, None)) => Value::Constant(value),
        None => match place(&scene.parameters, name) {
            Some((_, Some(place))) => Value::Settable(place),
            Some((value, None)) => Value::Constant(value),
            None => {
                let absent = ABSENT.iter().find(|(absent, _)| *absent == name);
                Value::Constant(absent.map_or(f64::NAN, |(_, value)| *value))
            }
        },
    };
    let differing: Vec<_> = differing(scene).map(|variable| variable.rust.as_str()).collect();
    let (mut arms, mut tables) = (String::new(), String::new());
    let mut uses_settable = !differing.is_empty();
    for variable in parameters() {
        let value = if differing.contains(&variable.rust.as_str()) {
            let constant = variable.name.replace('.', "_").to_uppercase();
            let sources = (0..scene.contacts.len()).map(|group| match source(group, &variable.name) {
                Value::Settable(place) => format!("Source::Settable({place})"),
                Value::Constant(value) => format!("Source::Constant({})", literal(value)),
            });
            let sources = list(&constant, "Source", "GROUPS", &sources.collect::<Vec<_>>());
            tables.push_str(&format!("\n/// `{}` by group.\n{sources}", variable.name));
            format!("Source::value({constant}.get(group), settable)")
        } else {
            match source(0, &variable.name) {
                Value::Settable(place) => {
                    uses_settable = true;
                    format!("settable[{place}]")
                }
                Value::Constant(value) => literal(value),
            }
        };
        writeln!(arms, "        Parameter::{} => {value},", variable.rust).expect("a String takes everything");
    }
    text.push_str(&tables);
    let group = if differing.is_empty() { "_group" } else { "group" };
    let settable = if uses_settable { "settable" } else { "_settable" };
    add(
        text,
        &format!(
            "/// The value of any parameter for the contacts of a group: set, or constant in this scene.\n\
             pub fn parameter(parameter: Parameter, {group}: usize, {settable}: &Values) -> f64 {{\n    match parameter {{\n{arms}    }}\n}}\n"
        ),
    );
}

/// Where a parameter has its value from.
enum Value {
    /// Place among those that can be set.
    Settable(usize),
    Constant(f64),
}
