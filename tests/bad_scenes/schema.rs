//! What the JSON Schema says of bad scenes.

use brinell_testing::schema::mistakes;
use brinell_testing::{python, skips};
use std::process::Command;
use std::sync::LazyLock;

/// Whether there is a Python that validates; the first test program asks for one. In Wine there is none, and the program is tested
/// without the schema.
static HAS_VALIDATOR: LazyLock<bool> = LazyLock::new(|| {
    let has = Command::new(python::INSTALLED).arg("--version").output().is_ok();
    if !has {
        skips::skipped("what the schema says of bad scenes", "there is no Python");
    }
    has
});

/// Mistakes that no schema can express, by a part of their message, and why.
const OF_NO_SCHEMA: &[(&str, &str)] = &[
    ("NaN", "JSON has no such number"),
    ("impact.mass = inf", "JSON has no such number"),
    ("impact.speed = inf", "JSON has no such number"),
    ("normal = [0, inf, 1]", "JSON has no such number"),
    ("has several conditions", "a material of one's own may have any name"),
    ("may be several materials", "a material of one's own may have any name"),
    ("unknown material `", "a material of one's own may have any name"),
    ("must be the same in law.loading_parameters", "it compares two numbers"),
    ("is before the end of the first step", "it compares two numbers"),
    ("must be below", "it compares two numbers"),
    ("does not fit impactor.radius", "it compares two numbers"),
    ("HRC is out of range", "the number is part of a text"),
    ("HRB is out of range", "the number is part of a text"),
    ("HBW is out of range", "the number is part of a text"),
    ("HV is out of range", "the number is part of a text"),
    ("\"1e400 m/s\": the number is too large", "the number is part of a text"),
    ("the dent's diameter would be", "it is computed"),
    ("HRB is converted by a table for steel", "it depends on the numbers of a material"),
    ("the hardness of a soft metal depends on the load", "it depends on the numbers of a material"),
    ("how it changes to that of an impact is known for steel", "it depends on the numbers of a material"),
    ("the law can be evaluated", "it is computed"),
    ("no contact is wider than its body; ", "it is computed"),
    ("the size of the smaller body is 5 um: no contact is wider than its body", "it is computed"),
    ("is no parameter of an ellipse", "which parameters a scene has depends on its materials and contacts"),
    ("times apart: allowed is", "it compares two numbers"),
    ("don't touch in one point", "it compares two numbers"),
    ("along y = 0 is out of range", "it is between two signs"),
    ("the impactor has to bulge", "it compares two numbers"),
    ("where no law holds", "it is computed"),
    ("Give the thickness of the wall around the bore", "the constant C may be given instead"),
    ("law.loading = \"line\" doesn't go with", "the law follows from the length"),
    ("is no parameter of a cylinder", "which parameters a scene has depends on its materials and contacts"),
    ("is no copy of that of the first contact", "it compares two contacts"),
    ("allowed is 0 to below youngs_modulus", "it compares two numbers"),
    ("needs reference_rate", "beside a hardness it needs none"),
    ("under a slow load the impactor is the softer body", "it is computed"),
    ("it can't be computed with", "it is computed"),
    ("with these parameters the", "it is computed"),
    ("unknown parameter `effective_mass`", "which parameters a scene has depends on its materials and contacts"),
    (
        "unknown parameter `impactor.youngs_modulus`",
        "which parameters a scene has depends on its materials and contacts",
    ),
    ("unknown parameter `target.radius`", "which parameters a scene has depends on its materials and contacts"),
    ("unknown parameter `initial_gap`", "which parameters a scene has depends on its materials and contacts"),
    ("unknown parameter `restitution`", "which parameters a scene has depends on its materials and contacts"),
    ("unknown parameter `left.impactor.radius`", "which parameters a scene has depends on its materials and contacts"),
    (
        "unknown parameter `right.target.yield_strength`",
        "which parameters a scene has depends on its materials and contacts",
    ),
    ("for every contact", "a material may have no strength"),
    ("is not positive definite", "it is computed"),
    ("the unit has the power", "it compares a unit with another number"),
    ("has no effect beside stiffness", "beside a stiffness of zero it has"),
    ("isn't parallel to", "it is computed"),
    ("tangent = [0, 0, 1] is no direction", "it is computed"),
    ("tangent = [1, 0, 0.001] is no direction", "it is computed"),
    ("the effective mass of its bodies", "it is computed"),
    ("contacts in all: allowed", "it is a sum"),
    ("there are 257 contacts", "it is a sum"),
    ("values per contact: allowed", "it is a sum"),
    ("is in no contact", "it compares names in two lists"),
    ("is taken by another", "it compares names in two lists"),
    ("unknown body", "it compares names in two lists"),
    ("never moves and takes no arm", "it compares names in two lists"),
];

/// Whether the schema judges the `text` of a scene as the program does, which has said this `message`, unless no schema can.
///
/// # Errors
/// What it says otherwise.
pub fn agrees(text: &str, message: &str) -> Result<(), String> {
    if !*HAS_VALIDATOR {
        return Ok(());
    }
    // what is no TOML is no matter of a schema
    let Some(found) = mistakes(text) else { return Ok(()) };
    let beyond = OF_NO_SCHEMA.iter().find(|(part, _)| message.contains(part)).map(|(_, why)| *why);
    let is_good = message.is_empty() || message.starts_with("warning: ");
    match (found.is_empty(), is_good, beyond) {
        (true, true, _) | (false, false, None) | (true, false, Some(_)) => Ok(()),
        (true, false, None) => Err("the schema accepts what is refused".into()),
        (false, _, why) => Err(format!("{}, but the schema says {found:?}", why.unwrap_or("it is good"))),
    }
}
