//! The parameters: those that can be set, and the origin of every value.

use super::{File, list, literal};
use crate::interface::{Entry, is_tunable};
use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Causality, Variable};

/// The initial value of the parameter `name` for the contacts of a group.
pub fn start_value(scene: &Scene, group: usize, name: &str) -> f64 {
    scene.group_value(group, name).unwrap_or_else(|| without_effect(name))
}

/// The value of the parameter `name` in a scene that hasn't got it.
fn without_effect(name: &str) -> f64 {
    let found = brinell_fmu::scene::Parameter::ALL.into_iter().find(|(known, _)| *known == name);
    found.map_or(f64::NAN, |(_, parameter)| parameter.without_effect())
}

/// Adds the parameters that can be set: their values by contact if contacts have own ones, and which can be set between steps.
pub fn add_settable(file: &mut File, scene: &Scene, entries: &[Entry]) {
    let settable: Vec<_> = entries.iter().filter(|entry| entry.variable.causality == Causality::Parameter).collect();
    let number = |value: Option<f64>| literal(value.expect("a parameter has a start value and limits"));
    let row = |entry: &&Entry| {
        // with several values, the contact is named before
        let name = if entry.count == 1 { entry.name(0) } else { entry.variable.name.clone() };
        let unit = entry.variable.unit.as_deref().unwrap_or("");
        let [minimum, maximum, start] = [entry.variable.minimum, entry.variable.maximum, entry.start].map(number);
        format!("{name:?} {unit:?} [{minimum}, {maximum}] = {start}")
    };
    file.add_rows("settable", settable.iter().map(row));
    let mut end = 0;
    let ends = settable.iter().map(|entry| {
        end += entry.count;
        end
    });
    let ends: Vec<usize> = ends.collect();
    let all = || settable.iter().zip(&ends);
    if settable.iter().any(|entry| entry.count > 1) {
        let run = |(entry, end): (&&Entry, &usize)| {
            let first = entry.group.filter(|_| entry.count > 1).map(|group| first_contact(scene, group));
            format!("({end}, {first:?})")
        };
        file.add("runs", list(all().map(run)));
    }
    let tunable = all().filter(|(entry, _)| is_tunable(scene, &entry.variable.name));
    let tunable: Vec<_> = tunable.map(|(entry, end)| format!("{}..{end}", end - entry.count)).collect();
    if !tunable.is_empty() {
        file.add("tunable", list(tunable));
    }
}

/// The first contact of `group`.
pub fn first_contact(scene: &Scene, group: &Group) -> usize {
    scene.contacts.iter().take_while(|other| other.name != group.name).map(Group::size).sum()
}

/// The variables that can be parameters of a scene, in the order of the library's enum.
pub fn parameters() -> impl Iterator<Item = &'static Variable> {
    table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter)
}

/// The parameters whose values come from different sources in different groups.
fn differing(scene: &Scene) -> impl Iterator<Item = &'static Variable> {
    let own = |variable: &&Variable, group: &Group| group.own.iter().any(|own| own.name == variable.name);
    parameters()
        .filter(move |variable| scene.contacts.len() > 1 && scene.contacts.iter().any(|group| own(variable, group)))
}

/// Adds the source of the value of each parameter that has an effect.
pub fn add_sources(file: &mut File, scene: &Scene) {
    let sources = Sources::of(scene);
    let differing: Vec<_> = differing(scene).map(|variable| variable.name.as_str()).collect();
    let source = |variable: &Variable| {
        let found = if differing.contains(&variable.name.as_str()) {
            let sources = (0..scene.contacts.len()).map(|group| sources.get(group, &variable.name));
            let source = |source: Option<Value>| match source {
                Some(Value::Settable(place)) => format!("Settable({place})"),
                // for a contact before these, the index would be below zero
                Some(Value::PerContact((place, first))) => format!("PerContact({})", place as isize - first as isize),
                Some(Value::Constant(value)) => format!("Constant({})", literal(value)),
                None => format!("Constant({})", literal(without_effect(&variable.name))),
            };
            format!("tables {}", list(sources.map(source)))
        } else {
            match sources.get(0, &variable.name)? {
                Value::Settable(place) => format!("set {place}"),
                Value::PerContact((place, _)) => format!("own {place}"),
                Value::Constant(value) => format!("constant {}", literal(value)),
            }
        };
        Some(format!("{}: {found}", variable.symbol()))
    };
    file.add_rows("parameters", parameters().filter_map(source));
}

/// The source of the value of each parameter.
pub struct Sources<'a> {
    scene: &'a Scene,
    /// For each group, the index of its first own value among the settable values, and its first contact.
    firsts: Vec<(usize, usize)>,
}

impl Sources<'_> {
    pub fn of(scene: &Scene) -> Sources<'_> {
        let (mut value, mut contact) = (scene.settable().count(), 0);
        let firsts = scene.contacts.iter().map(|group| {
            let first = (value, contact);
            value += group.own.iter().filter(|own| own.settable).map(|own| group.variables_of(own)).sum::<usize>();
            contact += group.size();
            first
        });
        Sources { scene, firsts: firsts.collect() }
    }

    /// The source of the parameter `name` for the contacts of `group`, if they have it.
    pub fn get(&self, group: usize, name: &str) -> Option<Value> {
        let ((first, contact), group) = (self.firsts[group], &self.scene.contacts[group]);
        if let Some((parameter, place)) = find(&group.own, name, |own| group.variables_of(own)) {
            return Some(match parameter.settable {
                true if group.variables_of(parameter) > 1 => Value::PerContact((first + place, contact)),
                true => Value::Settable(first + place),
                false => Value::Constant(parameter.value),
            });
        }
        let (parameter, place) = find(&self.scene.parameters, name, |_| 1)?;
        Some(if parameter.settable { Value::Settable(place) } else { Value::Constant(parameter.value) })
    }
}

/// The parameter `name` of a list, and the number of settable values before it. `values` gives the number for each parameter.
fn find<'a>(list: &'a [Parameter], name: &str, values: impl Fn(&Parameter) -> usize) -> Option<(&'a Parameter, usize)> {
    let place = list.iter().position(|parameter| parameter.name == name)?;
    let before = list[..place].iter().filter(|other| other.settable).map(values).sum();
    Some((&list[place], before))
}

/// The source of the value of a parameter.
pub enum Value {
    /// Index among the settable values.
    Settable(usize),
    /// Index of the first settable value, and its contact: each contact has its own value.
    PerContact((usize, usize)),
    Constant(f64),
}
