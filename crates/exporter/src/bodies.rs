//! The bodies of a contact, as words and numbers.

use crate::scene::{Body, Scene};
use crate::table;

/// Descriptions of the two bodies in the contacts of `group`: "a rigid sphere", "a half-space".
pub fn words(scene: &Scene, group: usize) -> (String, String) {
    let value = |name| scene.group_value(group, name);
    let is_rigid = value("impactor.youngs_modulus").is_none();
    if let Some(elliptic) = &scene.contacts[group].ellipse {
        let [impactor, target] = Body::ALL.map(|body| elliptic.radii_of(body));
        let kind = if is_rigid { "a rigid body" } else { "an elastic body" };
        return (format!("{kind} with radii of {impactor}"), format!("one of {target}"));
    }
    let impactor = if is_rigid { "a rigid sphere" } else { "an elastic sphere" };
    let target = match value("target.radius") {
        None => "a half-space",
        Some(radius) if radius < 0.0 => "a spherical socket",
        Some(_) => "a sphere",
    };
    (impactor.into(), target.into())
}

/// The parameters of the contacts of `group`, including those shared by all contacts, in the order of the table: name, value,
/// unit.
pub fn numbers(scene: &Scene, group: usize) -> Vec<(&'static str, f64, &'static str)> {
    let names = table::VARIABLES.iter().filter(|variable| variable.causality == table::Causality::Parameter);
    let number = |variable: &'static table::Variable| {
        let value = scene.group_value(group, &variable.name)?;
        Some((variable.name.as_str(), value, variable.unit.as_deref().unwrap_or("")))
    };
    names.filter_map(number).collect()
}

/// The first contact with its name, if it has one: "the first contact, <code>bead\[1\]</code>".
pub fn first_contact(scene: &Scene) -> Option<String> {
    let first = &scene.contacts[0];
    first.name.is_some().then(|| format!("the first contact, <code>{}</code>", first.prefix(0).trim_end_matches('.')))
}
