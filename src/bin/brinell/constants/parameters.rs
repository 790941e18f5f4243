//! The parameters as constants: those that can be set, and where every one has its value from.

use super::{File, list, literal};
use crate::interface::{Entry, is_tunable};
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

/// The value of the parameter `name` for the contacts of a group, before anyone sets it.
pub fn start_value(scene: &Scene, group: usize, name: &str) -> f64 {
    let absent = || ABSENT.iter().find(|(absent, _)| *absent == name).map_or(f64::NAN, |(_, value)| *value);
    scene.group_value(group, name).unwrap_or_else(absent)
}

pub fn add_settable(file: &mut File, scene: &Scene, entries: &[Entry]) {
    let settable: Vec<_> = entries.iter().filter(|entry| entry.variable.causality == Causality::Parameter).collect();
    let number = |value: Option<f64>| literal(value.expect("a parameter has a start value and limits"));
    let mut table = format!("/// The parameters that can be set.\nstatic SETTABLE: [Settable; {}] = [", settable.len());
    for entry in &settable {
        let variable = entry.variable;
        let unit = variable.unit.as_deref().unwrap_or("");
        let [minimum, maximum] = [variable.minimum, variable.maximum].map(number);
        write!(
            table,
            "\n    Settable {{ name: {:?}, unit: {unit:?}, minimum: {minimum}, maximum: {maximum} }},",
            entry.name(0)
        )
        .expect("a String takes everything");
    }
    table.push_str(if settable.is_empty() { "];\n" } else { "\n];\n" });
    file.add_item(&table);
    file.add_method("settable(index: usize) -> Option<Settable>", "SETTABLE.get(index).copied()");
    let tunable = settable.iter().position(|entry| is_tunable(scene, &entry.variable.name));
    if let Some(place) = tunable {
        file.add_method("is_tunable(index: usize) -> bool", &format!("index == {place}"));
    }
    let starts: Vec<_> = settable.iter().map(|entry| number(entry.start)).collect();
    let line = format!("[{}]", starts.join(", "));
    let starts = if line.len() < 90 { line } else { format!("[\n    {},\n]", starts.join(",\n    ")) };
    file.add_method("start_values() -> Self::Values", &starts);
}

/// The variables that a scene can have as parameters, in the order of the library's enum.
pub fn parameters() -> impl Iterator<Item = &'static Variable> {
    table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter)
}

/// Those of them that not all groups have from the same source.
pub fn differing(scene: &Scene) -> impl Iterator<Item = &'static Variable> {
    let own = |variable: &&Variable, group: &Group| group.own.iter().any(|own| own.name == variable.name);
    parameters()
        .filter(move |variable| scene.contacts.len() > 1 && scene.contacts.iter().any(|group| own(variable, group)))
}

pub fn add_parameters(file: &mut File, scene: &Scene) {
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
            None => Value::Constant(start_value(scene, group, name)),
        },
    };
    let differing: Vec<_> = differing(scene).map(|variable| variable.rust.as_str()).collect();
    let mut arms = String::new();
    let mut uses_settable = !differing.is_empty();
    for variable in parameters() {
        let value = if differing.contains(&variable.rust.as_str()) {
            let constant = variable.name.replace('.', "_").to_uppercase();
            let sources = (0..scene.contacts.len()).map(|group| match source(group, &variable.name) {
                Value::Settable(place) => format!("Source::Settable({place})"),
                Value::Constant(value) => format!("Source::Constant({})", literal(value)),
            });
            let sources = list(&constant, "Source", "GROUPS", &sources.collect::<Vec<_>>());
            file.add_item(&format!("/// `{}` by group.\n{sources}", variable.name));
            format!("Source::value({constant}.get(group), values)")
        } else {
            match source(0, &variable.name) {
                Value::Settable(place) => {
                    uses_settable = true;
                    format!("values[{place}]")
                }
                Value::Constant(value) => literal(value),
            }
        };
        writeln!(arms, "    Parameter::{} => {value},", variable.rust).expect("a String takes everything");
    }
    let group = if differing.is_empty() { "_group" } else { "group" };
    let values = if uses_settable { "values" } else { "_values" };
    file.add_method(
        &format!("parameter(parameter: Parameter, {group}: usize, {values}: &Self::Values) -> f64"),
        &format!("match parameter {{\n{arms}}}"),
    );
}

/// Where a parameter has its value from.
enum Value {
    /// Place among those that can be set.
    Settable(usize),
    Constant(f64),
}
