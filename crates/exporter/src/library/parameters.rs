//! The parameters: those that can be set, and the origin of every value.

use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Causality, Variable};
use brinell_fmu::scene::variable::Source;

/// The initial value of the parameter `name` for the contacts of a group.
pub fn start_value(scene: &Scene, group: usize, name: &str) -> f64 {
    let without_effect = || {
        let found = brinell_fmu::scene::Parameter::ALL.into_iter().find(|(known, _)| *known == name);
        found.map_or(f64::NAN, |(_, parameter)| parameter.without_effect())
    };
    scene.group_value(group, name).unwrap_or_else(without_effect)
}

/// The first contact of `group`.
pub fn first_contact(scene: &Scene, group: &Group) -> usize {
    scene.contacts.iter().take_while(|other| other.name != group.name).map(Group::size).sum()
}

/// The variables that can be parameters of a scene, in the order of the library's enum.
pub fn parameters() -> impl Iterator<Item = &'static Variable> {
    table::VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter)
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
    pub fn get(&self, group: usize, name: &str) -> Option<Source> {
        if let Some(value) = self.scene.constant_of_ball(group, name) {
            return Some(Source::Constant(value));
        }
        let ((first, contact), group) = (self.firsts[group], &self.scene.contacts[group]);
        if let Some((parameter, place)) = find(&group.own, name, |own| group.variables_of(own)) {
            return Some(match parameter.settable {
                // for a contact before these, the index is below zero
                true if group.variables_of(parameter) > 1 => {
                    Source::PerContact((first + place) as isize - contact as isize)
                }
                true => Source::Settable(first + place),
                false => Source::Constant(parameter.value),
            });
        }
        let (parameter, place) = find(&self.scene.parameters, name, |_| 1)?;
        Some(if parameter.settable { Source::Settable(place) } else { Source::Constant(parameter.value) })
    }
}

/// The parameter `name` of a list, and the number of settable values before it. `values` gives the number for each parameter.
fn find<'a>(list: &'a [Parameter], name: &str, values: impl Fn(&Parameter) -> usize) -> Option<(&'a Parameter, usize)> {
    let place = list.iter().position(|parameter| parameter.name == name)?;
    let before = list[..place].iter().filter(|other| other.settable).map(values).sum();
    Some((&list[place], before))
}
