//! The groups of contacts as constants, and what they don't have in common.

use super::{add, list, literal};
use crate::scene::{Group, Scene};
use brinell::contact::Surface;

/// How many contacts there are, in which groups.
pub fn add_groups(text: &mut String, scene: &Scene) {
    let (contacts, groups) = (scene.contact_count(), scene.contacts.len());
    let names = scene.contacts.iter();
    let names = names.map(|group| format!("({:?}, {})", group.name.as_deref().unwrap_or(""), group.count.is_some()));
    let names = list("GROUP_NAMES", "(&str, bool)", "GROUPS", &names.collect::<Vec<_>>());
    add(
        text,
        &format!(
            "/// How many contacts there are.\npub const CONTACTS: usize = {contacts};\n\
             /// How many groups of equal contacts they form.\npub const GROUPS: usize = {groups};\n\
             /// The name of each group, and whether its contacts are counted.\npub {names}"
        ),
    );
    let (group, end) = if groups == 1 {
        ("pub fn group(_contact: usize) -> usize {\n    0\n", "pub fn end(_group: usize) -> usize {\n    CONTACTS\n")
    } else if groups == contacts {
        (
            "pub fn group(contact: usize) -> usize {\n    contact\n",
            "pub fn end(group: usize) -> usize {\n    group + 1\n",
        )
    } else {
        let mut end = 0;
        let ends = scene.contacts.iter().map(|group| {
            end += group.len();
            end.to_string()
        });
        let ends = list("ENDS", "usize", "GROUPS", &ends.collect::<Vec<_>>());
        add(text, &format!("/// The contact behind the last one of each group.\n{ends}"));
        (
            "pub fn group(contact: usize) -> usize {\n    ENDS.partition_point(|&end| end <= contact)\n",
            "pub fn end(group: usize) -> usize {\n    ENDS.get(group).copied().unwrap_or(CONTACTS)\n",
        )
    };
    add(text, &format!("/// The group of a contact.\n{group}}}\n"));
    add(text, &format!("/// The contact behind the last one of a group.\n{end}}}\n"));
}

pub fn add_surface(text: &mut String, scene: &Scene) {
    let name = |group: &Group| match group.surface {
        Surface::Dented => "Surface::Dented".to_string(),
        Surface::Fresh => "Surface::Fresh".to_string(),
    };
    let head = "/// What a new contact of a group meets.\npub fn surface";
    let names: Vec<_> = scene.contacts.iter().map(name).collect();
    add_by_group(text, head, "Surface", ("SURFACES", "What a new contact meets, by group."), &names);
}

pub fn add_density(text: &mut String, scene: &Scene) {
    let value = |group: &Group| group.density.map_or("None".into(), |density| format!("Some({})", literal(density)));
    let head = "/// Density of the target of a group [kg/m^3], if it is known.\npub fn density";
    let values: Vec<_> = scene.contacts.iter().map(value).collect();
    add_by_group(text, head, "Option<f64>", ("DENSITIES", "Density of the target [kg/m^3], by group."), &values);
}

/// A function of the group that begins with `head`: one value for all, or a table with its name and what it says.
fn add_by_group(text: &mut String, head: &str, kind: &str, (name, says): (&str, &str), values: &[String]) {
    let (argument, body) = if values.iter().all(|value| *value == values[0]) {
        ("_group", values[0].clone())
    } else {
        add(text, &format!("/// {says}\n{}", list(name, kind, "GROUPS", values)));
        ("group", format!("{name}.get(group).copied().unwrap_or_default()"))
    };
    add(text, &format!("{head}({argument}: usize) -> {kind} {{\n    {body}\n}}\n"));
}
