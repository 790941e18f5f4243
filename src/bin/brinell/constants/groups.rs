//! The groups of contacts, and what they don't have in common.

use super::{File, list, literal};
use crate::scene::{Group, Scene};
use brinell::contact::Surface;

/// How many contacts there are, in which groups.
pub fn add_groups(file: &mut File, scene: &Scene) {
    let (contacts, groups) = (scene.contact_count(), scene.contacts.len());
    file.add_item(&format!(
        "/// How many contacts there are.\nconst CONTACTS: usize = {contacts};\n\
         /// How many groups of equal contacts they form.\nconst GROUPS: usize = {groups};\n"
    ));
    let (group, end) = if groups == 1 {
        (("_contact", "0"), ("_group", "CONTACTS"))
    } else if groups == contacts {
        (("contact", "contact"), ("group", "group + 1"))
    } else {
        let mut end = 0;
        let ends = scene.contacts.iter().map(|group| {
            end += group.len();
            end.to_string()
        });
        let ends = list("ENDS", "usize", "GROUPS", &ends.collect::<Vec<_>>());
        file.add_item(&format!("/// The contact behind the last one of each group.\n{ends}"));
        (
            ("contact", "ENDS.partition_point(|&end| end <= contact)"),
            ("group", "ENDS.get(group).copied().unwrap_or(CONTACTS)"),
        )
    };
    file.add_method(&format!("group({}: usize) -> usize", group.0), group.1);
    file.add_method(&format!("end({}: usize) -> usize", end.0), end.1);
    let name = |group: &Group| format!("({:?}, {})", group.name.as_deref().unwrap_or(""), group.count.is_some());
    let names: Vec<_> = scene.contacts.iter().map(name).collect();
    let (argument, value) = match names.as_slice() {
        [only] => ("_group", only.clone()),
        _ => {
            let names = list("GROUP_NAMES", "(&str, bool)", "GROUPS", &names);
            file.add_item(&format!("/// The name of each group, and whether its contacts are counted.\n{names}"));
            ("group", "GROUP_NAMES.get(group).copied().unwrap_or((\"\", true))".into())
        }
    };
    file.add_method(&format!("group_name({argument}: usize) -> (&'static str, bool)"), &value);
}

/// The name of the argument that says the group, and what a new contact of it meets.
pub fn surface(file: &mut File, scene: &Scene) -> (&'static str, String) {
    let name = |group: &Group| match group.surface {
        Surface::Dented => "Surface::Dented".to_string(),
        Surface::Fresh => "Surface::Fresh".to_string(),
    };
    let names: Vec<_> = scene.contacts.iter().map(name).collect();
    by_group(file, "Surface", ("SURFACES", "What a new contact meets, by group."), &names)
}

pub fn add_density(file: &mut File, scene: &Scene) {
    let value = |group: &Group| group.density.map_or("None".into(), |density| format!("Some({})", literal(density)));
    let values: Vec<_> = scene.contacts.iter().map(value).collect();
    let (group, value) =
        by_group(file, "Option<f64>", ("DENSITIES", "Density of the target [kg/m^3], by group."), &values);
    file.add_method(&format!("density({group}: usize) -> Option<f64>"), &value);
}

/// The argument and the expression of something of a group: one value for all, or a table with its name and what it says.
fn by_group(file: &mut File, kind: &str, (name, says): (&str, &str), values: &[String]) -> (&'static str, String) {
    if values.iter().all(|value| *value == values[0]) {
        return ("_group", values[0].clone());
    }
    file.add_item(&format!("/// {says}\n{}", list(name, kind, "GROUPS", values)));
    ("group", format!("{name}.get(group).copied().unwrap_or_default()"))
}
