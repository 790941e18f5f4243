//! The parameters as constants: those that can be set, and the origin of every value.

use super::groups::table_of;
use super::{File, list, literal};
use crate::interface::{Entry, is_tunable};
use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Causality, Variable};
use std::fmt::Write;

/// What the parameters stand for that a scene hasn't got: a rigid impactor, a flat target, bodies that never yield
/// or don't harden, no damping, no loss below yield, no friction.
const ABSENT: [(&str, f64); 12] = [
    ("impactor.youngs_modulus", f64::INFINITY),
    ("impactor.poissons_ratio", 0.0),
    ("impactor.yield_strength", f64::INFINITY),
    ("impactor.hardening_modulus", 0.0),
    ("target.radius", f64::INFINITY),
    ("target.yield_strength", f64::INFINITY),
    ("target.hardening_modulus", 0.0),
    ("restitution", 1.0),
    ("effective_mass", f64::INFINITY),
    ("elastic_restitution", 1.0),
    ("target.plate_thickness", f64::INFINITY),
    ("friction.coefficient", 0.0),
];

/// The initial value of the parameter `name` for the contacts of a group.
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
            "\n    Settable {{ name: {:?}.as_bytes(), unit: {unit:?}.as_bytes(), minimum: {minimum}, maximum: {maximum} }},",
            // with several values, the contact is named before
            if entry.count == 1 { entry.name(0) } else { variable.name.clone() }
        )
        .expect("a String takes everything");
    }
    table.push_str(if settable.is_empty() { "];\n" } else { "\n];\n" });
    file.add_item(&table);
    let starts: Vec<_> = settable.iter().map(|entry| number(entry.start)).collect();
    let per_contact = settable.iter().any(|entry| entry.count > 1);
    if per_contact {
        add_runs(file, scene, &settable);
        file.add_item(&format!(
            "/// Start values of the parameters.\n{}",
            list("STARTS", "f64", "SETTABLE.len()", &starts)
        ));
    }
    let found = match per_contact {
        true => "let (place, contact) = run_of(&RUNS, index)?;\nSome((*SETTABLE.get(place)?, contact))",
        false => "SETTABLE.get(index).map(|settable| (*settable, None))",
    };
    file.add_method("settable(index: usize) -> Option<(Settable, Option<usize>)>", found);
    add_tunable(file, scene, &settable);
    let line = format!("[{}]", starts.join(", "));
    let starts = match line.len() {
        _ if per_contact => "spread(&RUNS, &STARTS)".into(),
        ..90 => line,
        _ => format!("[\n    {},\n]", starts.join(",\n    ")),
    };
    file.add_method("start_values() -> Self::Values", &starts);
}

/// Adds the number of values of each `settable` parameter, and their contacts.
fn add_runs(file: &mut File, scene: &Scene, settable: &[&Entry]) {
    let mut end = 0;
    let runs = settable.iter().map(|entry| {
        end += entry.count;
        let first = entry.group.filter(|_| entry.count > 1).map(|group| first_contact(scene, group));
        format!("Run {{ end: {end}, first_contact: {first:?} }}")
    });
    let runs = list("RUNS", "Run", "SETTABLE.len()", &runs.collect::<Vec<_>>());
    file.add_item(&format!("/// The values of each parameter.\n{runs}"));
    file.add_item(&format!("/// Number of values that can be set.\nconst VALUES: usize = {end};\n"));
}

/// The first contact of `group`.
fn first_contact(scene: &Scene, group: &Group) -> usize {
    scene.contacts.iter().take_while(|other| other.name != group.name).map(Group::len).sum()
}

/// Adds which of the `settable` parameters can be set between steps.
fn add_tunable(file: &mut File, scene: &Scene, settable: &[&Entry]) {
    let mut begin = 0;
    let places = settable.iter().filter_map(|entry| {
        begin += entry.count;
        is_tunable(scene, &entry.variable.name).then(|| (begin - entry.count)..begin)
    });
    let places: Vec<_> = places.collect();
    let test = match places.as_slice() {
        [] => return,
        [only] if only.len() == 1 => format!("index == {}", only.start),
        [only] => format!("({only:?}).contains(&index)"),
        _ => {
            let ranges: Vec<_> = places.iter().map(|range| format!("({}, {})", range.start, range.end)).collect();
            let ranges = list("TUNABLE", "(usize, usize)", &ranges.len().to_string(), &ranges);
            file.add_item(&format!("/// Ranges of the values that can be set between steps.\n{ranges}"));
            "TUNABLE.iter().any(|&(begin, end)| (begin..end).contains(&index))".into()
        }
    };
    file.add_method("is_tunable(index: usize) -> bool", &test);
}

/// The variables that can be parameters of a scene, in the order of the library's enum.
pub fn parameters() -> impl Iterator<Item = &'static Variable> {
    table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter)
}

/// The parameters whose values come from different sources in different groups.
pub fn differing(scene: &Scene) -> impl Iterator<Item = &'static Variable> {
    let own = |variable: &&Variable, group: &Group| group.own.iter().any(|own| own.name == variable.name);
    parameters()
        .filter(move |variable| scene.contacts.len() > 1 && scene.contacts.iter().any(|group| own(variable, group)))
}

pub fn add_parameters(file: &mut File, scene: &Scene) {
    let sources = Sources::of(scene);
    let differing: Vec<_> = differing(scene).map(|variable| variable.rust.as_str()).collect();
    let mut arms = String::new();
    let (mut uses_settable, mut uses_group) = (!differing.is_empty(), !differing.is_empty());
    for variable in parameters() {
        let value = if differing.contains(&variable.rust.as_str()) {
            let constant = variable.name.replace('.', "_").to_uppercase();
            let sources = (0..scene.contacts.len()).map(|group| match sources.get(group, &variable.name) {
                Value::Settable(place) => format!("Source::Settable({place})"),
                // for a contact before these, the index would be below zero
                Value::PerContact(place) => format!("Source::PerContact({}_usize.wrapping_sub({}))", place.0, place.1),
                Value::Constant(value) => format!("Source::Constant({})", literal(value)),
            });
            let sources = list(&constant, "Source", &scene.contacts.len().to_string(), &sources.collect::<Vec<_>>());
            file.add_item(&format!("/// `{}` by table.\n{sources}", variable.name));
            format!("Source::value({constant}.get({}), group, values)", table_of(scene))
        } else {
            match sources.get(0, &variable.name) {
                Value::Settable(place) => {
                    uses_settable = true;
                    format!("values[{place}]")
                }
                Value::PerContact((place, _)) => {
                    (uses_settable, uses_group) = (true, true);
                    format!("values.get(group + {place}).copied().unwrap_or(f64::NAN)")
                }
                Value::Constant(value) => literal(value),
            }
        };
        writeln!(arms, "    Parameter::{} => {value},", variable.rust).expect("a String takes everything");
    }
    let group = if uses_group { "group" } else { "_group" };
    let values = if uses_settable { "values" } else { "_values" };
    file.add_method(
        &format!("parameter(parameter: Parameter, {group}: usize, {values}: &Self::Values) -> f64"),
        &format!("match parameter {{\n{arms}}}"),
    );
}

/// The source of the value of each parameter.
struct Sources<'a> {
    scene: &'a Scene,
    /// For each group, the index of its first own value among the settable values, and its first contact.
    firsts: Vec<(usize, usize)>,
}

impl Sources<'_> {
    fn of(scene: &Scene) -> Sources<'_> {
        let (mut value, mut contact) = (scene.settable().count(), 0);
        let firsts = scene.contacts.iter().map(|group| {
            let first = (value, contact);
            value += group.own.iter().filter(|own| own.settable).map(|own| group.variables_of(own)).sum::<usize>();
            contact += group.len();
            first
        });
        Sources { scene, firsts: firsts.collect() }
    }

    /// The source of the parameter `name` for the contacts of `group`.
    fn get(&self, group: usize, name: &str) -> Value {
        let ((first, contact), group) = (self.firsts[group], &self.scene.contacts[group]);
        if let Some((parameter, place)) = find(&group.own, name, |own| group.variables_of(own)) {
            return match parameter.settable {
                true if group.variables_of(parameter) > 1 => Value::PerContact((first + place, contact)),
                true => Value::Settable(first + place),
                false => Value::Constant(parameter.value),
            };
        }
        match find(&self.scene.parameters, name, |_| 1) {
            Some((parameter, place)) if parameter.settable => Value::Settable(place),
            Some((parameter, _)) => Value::Constant(parameter.value),
            None => {
                let absent = ABSENT.iter().find(|(absent, _)| *absent == name);
                Value::Constant(absent.map_or(f64::NAN, |(_, value)| *value))
            }
        }
    }
}

/// The parameter `name` of a list, and the number of settable values before it. `values` gives the number for each parameter.
fn find<'a>(list: &'a [Parameter], name: &str, values: impl Fn(&Parameter) -> usize) -> Option<(&'a Parameter, usize)> {
    let place = list.iter().position(|parameter| parameter.name == name)?;
    let before = list[..place].iter().filter(|other| other.settable).map(values).sum();
    Some((&list[place], before))
}

/// The source of the value of a parameter.
enum Value {
    /// Index among the settable values.
    Settable(usize),
    /// Index of the first settable value, and its contact: each contact has its own value.
    PerContact((usize, usize)),
    Constant(f64),
}
