//! The groups of contacts, and the differences between them.

use super::{File, list, literal};
use crate::scene::{Group, Scene};
use brinell::contact::Surface;

/// Adds the number of contacts and their groups.
pub fn add_groups(file: &mut File, scene: &Scene) {
    let (contacts, tables) = (scene.contact_count(), scene.contacts.len());
    // contacts that may differ are groups of one
    let groups = if scene.contacts_differ() { contacts } else { tables };
    file.add_item(&format!(
        "/// Number of contacts.\nconst CONTACTS: usize = {contacts};\n\
         /// Number of groups of equal contacts.\nconst GROUPS: usize = {groups};\n"
    ));
    let (group, end) = if groups == 1 {
        (("_contact", "0"), ("_group", "CONTACTS"))
    } else if groups == contacts {
        (("contact", "contact"), ("group", "group + 1"))
    } else {
        (("contact", "table_of(contact)"), ("group", "ENDS.get(group).copied().unwrap_or(CONTACTS)"))
    };
    if tables > 1 && tables < contacts {
        add_tables(file, scene);
    }
    file.add_method(&format!("group({}: usize) -> usize", group.0), group.1);
    file.add_method(&format!("end({}: usize) -> usize", end.0), end.1);
    add_names(file, scene);
}

/// Adds the tables `[[contact]]` of the scene, if some have several contacts.
fn add_tables(file: &mut File, scene: &Scene) {
    let mut end = 0;
    let ends = scene.contacts.iter().map(|group| {
        end += group.len();
        end.to_string()
    });
    let count = scene.contacts.len();
    let ends = list("ENDS", "usize", &count.to_string(), &ends.collect::<Vec<_>>());
    file.add_item(&format!(
        "/// The contact after the last one of each table of the scene.\n{ends}\n\
         /// The table of a contact.\nfn table_of(contact: usize) -> usize {{\n    \
         ENDS.partition_point(|&end| end <= contact)\n}}\n"
    ));
}

/// Adds the names of the contacts.
fn add_names(file: &mut File, scene: &Scene) {
    let name = |group: &Group| (group.name.clone().unwrap_or_default(), group.count.is_some());
    let names: Vec<_> = scene.contacts.iter().map(name).collect();
    let (argument, value) = match names.as_slice() {
        [(name, true)] => ("contact", format!("({name:?}, contact + 1)")),
        [(name, false)] => ("_contact", format!("({name:?}, 0)")),
        _ if names.len() == scene.contact_count() => {
            let names = names.iter().map(|(name, counted)| format!("({name:?}, {})", usize::from(*counted)));
            let names = list("NAMES", "(&str, usize)", "CONTACTS", &names.collect::<Vec<_>>());
            file.add_item(&format!("/// The name of each contact, and its number or 0.\n{names}"));
            ("contact", "NAMES.get(contact).copied().unwrap_or((\"\", 0))".into())
        }
        _ => {
            let names: Vec<_> = names.iter().map(|(name, counted)| format!("({name:?}, {counted})")).collect();
            let names = list("NAMES", "(&str, bool)", &names.len().to_string(), &names);
            file.add_item(&format!("/// The name of each table, and whether its contacts are counted.\n{names}"));
            ("contact", "name_in(&NAMES, &ENDS, table_of(contact), contact)".into())
        }
    };
    file.add_method(&format!("contact_name({argument}: usize) -> (&'static str, usize)"), &value);
}

/// The expression for the table of `group`.
pub fn table_of(scene: &Scene) -> &'static str {
    match scene.contacts_differ() && scene.contacts.len() < scene.contact_count() {
        true => "table_of(group)",
        false => "group",
    }
}

/// The name of the argument for the group, and the expression for the surface that a new contact meets.
pub fn surface(file: &mut File, scene: &Scene) -> (&'static str, String) {
    let name = |group: &Group| match group.surface {
        Surface::Dented => "Surface::Dented".to_string(),
        Surface::Fresh => "Surface::Fresh".to_string(),
    };
    let names: Vec<_> = scene.contacts.iter().map(name).collect();
    by_table(file, "Surface", ("SURFACES", "What a new contact meets, by table."), &names, table_of(scene))
}

pub fn add_density(file: &mut File, scene: &Scene) {
    let value = |group: &Group| group.density.map_or("None".into(), |density| format!("Some({})", literal(density)));
    let values: Vec<_> = scene.contacts.iter().map(value).collect();
    let (group, value) = by_table(
        file,
        "Option<f64>",
        ("DENSITIES", "Density of the target [kg/m^3], by table."),
        &values,
        table_of(scene),
    );
    file.add_method(&format!("density({group}: usize) -> Option<f64>"), &value);
}

/// The argument and the expression for a property of a group: one value for all groups, or a list with a name and a
/// description, from which a group takes the value of its `table`.
fn by_table(
    file: &mut File,
    kind: &str,
    (name, says): (&str, &str),
    values: &[String],
    table: &str,
) -> (&'static str, String) {
    if values.iter().all(|value| *value == values[0]) {
        return ("_group", values[0].clone());
    }
    file.add_item(&format!("/// {says}\n{}", list(name, kind, &values.len().to_string(), values)));
    ("group", format!("{name}.get({table}).copied().unwrap_or_default()"))
}
