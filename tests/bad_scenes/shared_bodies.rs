//! Errors in scenes whose contacts share bodies: the message names the body or the contact, the place and the allowed values.

use super::command::{empty_folder, run};
use super::refused_text;
use std::fs;

/// A row of two balls before a wall, without errors.
const SCENE: &str = "\
name = \"row\"

[impactor]
radius = 5e-3

[target]
material = \"mild steel\"

[[body]]
name = \"front\"
mass = 0.1

[[body]]
name = \"rear\"
mass = 0.2

[[contact]]
name = \"wall\"
between = [\"front\", \"ground\"]

[[contact]]
name = \"link\"
between = [\"rear\", \"front\"]
direction = 1
";

/// A box on an edge of two feet, without errors.
const BOX: &str = "\
name = \"edge\"

[impactor]
radius = 5e-3

[target]
material = \"mild steel\"

[[body]]
name = \"box\"
mass = 0.3
inertia = [1.2e-4, 2.6e-4, 3.5e-4]

[[contact]]
name = \"left\"
between = [\"box\", \"ground\"]
normal = [0, 0, -1]
arms = [[-0.04, 0, -0.025], []]

[[contact]]
name = \"right\"
between = [\"ground\", \"box\"]
normal = [0, 0, 1]
arms = [[], [0.04, 0, -0.025]]
";

/// A scene whose masses are inputs, without errors.
const INPUTS: &str = "\
name = \"inputs\"

[impactor]
radius = 5e-3

[target]
material = \"mild steel\"

[coupling]
inverse_masses = \"input\"

[[contact]]
name = \"left\"

[[contact]]
name = \"right\"
";

/// Exports the good `scene` with `from` replaced by `to`: the message must name the marked place and contain `parts`.
#[track_caller]
fn refused(scene: &str, from: &str, to: &str, parts: &[&str]) {
    assert_eq!(scene.matches(from).count(), 1, "the scene has not one {from:?} to alter");
    refused_text(&scene.replacen(from, to, 1), parts);
}

#[test]
fn the_scenes_that_the_tests_alter_are_good() {
    for scene in [SCENE, BOX, INPUTS] {
        let folder = empty_folder();
        fs::write(folder.path().join("scene.toml"), scene).unwrap();
        run(folder.path(), ["predict", "scene.toml"]).with_status(0);
        run(folder.path(), ["constants", "scene.toml"]).with_status(0);
    }
}

#[test]
fn an_unknown_or_missing_key_of_a_body_is_refused() {
    refused(SCENE, "mass = 0.1", "mass = 0.1\n§masss = 1", &["`masss`", "did you mean `mass`", "`name`", "`inertia`"]);
    refused(SCENE, "[[body]]\nname = \"front\"", "§[[body]]", &["missing", "`name`"]);
    refused(SCENE, "[[body]]\nname = \"front\"\nmass = 0.1", "§[[body]]\nname = \"front\"", &["missing", "`mass`"]);
    refused(SCENE, "mass = 0.1", "mass = §\"100 m\"", &["body.mass = \"100 m\": m is a length; a mass has"]);
    refused(SCENE, "[[body]]\nname = \"front\"", "[[§bodies]]\nname = \"front\"", &["`bodies`", "did you mean `body`"]);
    refused(
        SCENE,
        "direction = 1",
        "§directions = 1",
        &["`directions`", "did you mean `direction`?", "`between`", "`arms`"],
    );
}

#[test]
fn a_name_of_a_body_is_an_identifier_and_its_own() {
    for name in ["4front", "front ball", "", "a.b"] {
        let value = format!("§{name:?}");
        refused(SCENE, "name = \"front\"", &format!("name = {value}"), &["name = ", "letters, digits and `_`"]);
    }
    refused(SCENE, "name = \"rear\"", "name = §\"front\"", &["name = \"front\" is taken by another body"]);
    refused(SCENE, "name = \"rear\"", "name = §\"ground\"", &["name = \"ground\"", "never moves", "always there"]);
}

#[test]
fn a_mass_of_a_body_that_is_none_is_refused_with_the_range() {
    for (mass, said) in [("0", "0"), ("-0.1", "-0.1"), ("nan", "NaN"), ("inf", "inf"), ("1e31", "1e31")] {
        let said = format!("body `front`: mass = {said} is out of range");
        refused(SCENE, "mass = 0.1", &format!("mass = §{mass}"), &[&said, "allowed is 1e-30 to 1e30 kg"]);
    }
}

#[test]
fn an_inertia_of_another_form_is_refused_with_the_forms() {
    let forms = ["one number (a ball)", "three (principal, along x, y, z)", "six (xx, yy, zz, xy, xz, yz)"];
    for (inertia, said) in [
        ("\"round\"", "inertia = \"round\" is no number"),
        ("[1e-4, true, 1e-4]", "inertia[2] = true is no number"),
        ("[]", "inertia = [] has 0 numbers"),
        ("[1e-4, 2e-4]", "inertia = [0.0001, 0.0002] has 2 numbers"),
        ("[[1e-4, 0, 0], [0, 1e-4, 0], [0, 0, 1e-4]]", "inertia[1] as a list is no number"),
    ] {
        let parts = [&["body `box`: ", said][..], &forms].concat();
        refused(BOX, "[1.2e-4, 2.6e-4, 3.5e-4]", &format!("§{inertia}"), &parts);
    }
}

#[test]
fn an_inertia_that_no_body_has_is_refused() {
    for (inertia, said) in [
        ("0", "inertia = 0 is out of range"),
        ("-1e-4", "inertia = -0.0001 is out of range"),
        ("[1e-4, 0, 1e-4]", "inertia[2] = 0 is out of range"),
        ("[1e-4, 1e-4, nan]", "inertia[3] = NaN is out of range"),
        ("[1e-4, 1e-4, 1e-4, 0, inf, 0]", "inertia[5] = inf is out of range"),
    ] {
        refused(
            BOX,
            "[1.2e-4, 2.6e-4, 3.5e-4]",
            &format!("§{inertia}"),
            &["body `box`: ", said, "allowed is", "kg m^2"],
        );
    }
    for tensor in ["[1, 1, 1, 1, 0, 0]", "[1, 1, 1, 0, -2, 0]", "[2, 3, 4, 1, 1, 3.5]", "[3, 3, 3, -1.5, -1.5, -1.5]"] {
        let parts = ["body `box`: inertia = ", "is not positive definite", "allowed are", "xy^2 < xx yy"];
        refused(BOX, "[1.2e-4, 2.6e-4, 3.5e-4]", &format!("§{tensor}"), &parts);
    }
}

#[test]
fn a_body_without_a_contact_and_bodies_without_contacts_are_refused() {
    let wall = "[[contact]]\nname = \"wall\"";
    let lonely = format!("§[[body]]\nname = \"lonely\"\nmass = 1\n{wall}");
    refused(SCENE, wall, &lonely, &["body `lonely` is in no contact", "`between`"]);
    let (bodies, _) = SCENE.split_once("[[contact]]").unwrap();
    refused_text(&bodies.replacen("[[body]]", "§[[body]]", 1), &["[[body]]", "need tables [[contact]]", "`between`"]);
    let (before, after) = (SCENE.split_once("[[body]]").unwrap().0, SCENE.split_once("[[contact]]").unwrap().1);
    let empty = format!("body = §[]\n{before}[[contact]]{after}");
    refused_text(&empty, &["list of bodies is empty", "name and mass"]);
}

#[test]
fn every_contact_is_between_two_bodies_that_exist() {
    let link = "between = [\"rear\", \"front\"]\ndirection = 1\n";
    refused(
        SCENE,
        &format!("[[contact]]\nname = \"link\"\n{link}"),
        "§[[contact]]\nname = \"link\"\n",
        &["contact `link`", "`between` is missing", "[[body]]"],
    );
    let between = "[\"rear\", \"front\"]";
    refused(
        SCENE,
        between,
        "[\"rear\", §\"frot\"]",
        &["contact `link`: unknown body `frot`; did you mean `front`? Expected one of `ground`, `front`, `rear`"],
    );
    for (wrong, said) in [
        ("[]", "between = [] must name two bodies"),
        ("[\"rear\"]", "between = [\"rear\"] must name two bodies"),
        ("[\"rear\", \"front\", \"ground\"]", "between = [\"rear\", \"front\", \"ground\"] must name two bodies"),
        ("[\"rear\", \"rear\"]", "between = [\"rear\", \"rear\"] must name two different bodies"),
        ("[\"ground\", \"ground\"]", "between = [\"ground\", \"ground\"] must name two different bodies"),
    ] {
        refused(SCENE, between, &format!("§{wrong}"), &["contact `link`: ", said]);
    }
    refused(SCENE, between, "§\"front\"", &["this is text, expected a list in `between = \"front\"`"]);
}

#[test]
fn what_a_contact_says_of_bodies_needs_bodies() {
    let text = |key: &str| INPUTS.replacen("\"left\"\n", &format!("\"left\"\n{key}\n"), 1);
    for (key, name) in [
        ("between = §[\"a\", \"b\"]", "between"),
        ("direction = §1", "direction"),
        ("normal = §[0, 0, 1]", "normal"),
        ("arms = §[[], []]", "arms"),
    ] {
        let said = format!("contact `left`: {name} ");
        let inputs = "coupling.inverse_masses = \"input\"";
        refused_text(&text(key), &[&said, "has no effect", inputs]);
        let without = text(key).replacen("[coupling]\ninverse_masses = \"input\"\n", "", 1);
        refused_text(&without, &[&said, "needs tables [[body]]", "the scene has none"]);
    }
}

#[test]
fn a_direction_that_is_none_is_refused() {
    for direction in ["0", "2", "-2"] {
        let said = format!("contact `link`: direction = {direction} is out of range: allowed are 1");
        refused(SCENE, "direction = 1", &format!("direction = §{direction}"), &[&said, "and -1"]);
    }
    refused(SCENE, "direction = 1", "direction = §0.5", &["a number with a fraction", "a whole number", "direction"]);
}

#[test]
fn lines_and_normals_are_not_mixed() {
    refused(
        BOX,
        "normal = [0, 0, -1]\narms = [[-0.04, 0, -0.025], []]",
        "direction = §1",
        &["contact `left`: direction = 1 doesn't go with `normal`", "each contact"],
    );
    refused(
        BOX,
        "normal = [0, 0, -1]",
        "normal = [0, 0, -1]\ndirection = §-1",
        &["contact `left`: direction = -1", "`normal`"],
    );
    refused(
        BOX,
        "[[contact]]\nname = \"right\"\nbetween = [\"ground\", \"box\"]\nnormal = [0, 0, 1]\n",
        "§[[contact]]\nname = \"right\"\nbetween = [\"ground\", \"box\"]\n",
        &["contact `right`: `normal` is missing", "another contact"],
    );
    refused(SCENE, "direction = 1", "arms = §[[], []]", &["contact `link`: arms need `normal`", "one line"]);
}

#[test]
fn a_normal_without_a_direction_is_refused() {
    for (normal, said) in [
        ("[0, 0, 0]", "[0, 0, 0]"),
        ("[0.0, -0.0, 0.0]", "[0, -0, 0]"),
        ("[0, 1]", "[0, 1]"),
        ("[0, 0, 1, 0]", "[0, 0, 1, 0]"),
        ("[]", "[]"),
        ("[0, nan, 1]", "[0, NaN, 1]"),
        ("[0, inf, 1]", "[0, inf, 1]"),
    ] {
        let said = format!("contact `left`: normal = {said} is no direction");
        refused(BOX, "[0, 0, -1]", &format!("§{normal}"), &[&said, "three finite numbers x, y, z", "not all zero"]);
    }
    refused(BOX, "[0, 0, -1]", "§3", &["a whole number", "a list", "normal"]);
    refused(BOX, "[0, 0, -1]", "[0, 0, §\"down\"]", &["text", "a number", "normal"]);
}

#[test]
fn arms_that_are_none_are_refused() {
    let arms = "[[-0.04, 0, -0.025], []]";
    refused(BOX, arms, "§[[-0.04, 0, -0.025]]", &["contact `left`: arms has 1 vectors", "two", "`between`"]);
    for (arm, said) in [
        ("[0, 1]", "arms[1] = [0, 1]"),
        ("[0, 0, 0, 0]", "arms[1] = [0, 0, 0, 0]"),
        ("[nan, 0, 0]", "arms[1] = [NaN, 0, 0]"),
        ("[0, 2e6, 0]", "arms[1] = [0, 2000000, 0]"),
    ] {
        let said = format!("contact `left`: {said} is no arm");
        refused(BOX, arms, &format!("[§{arm}, []]"), &[&said, "three numbers from -1e6 to 1e6 m"]);
    }
    refused(
        BOX,
        arms,
        "[[-0.04, 0, -0.025], §[0, 0, 0.1]]",
        &["contact `left`: arms[2] = [0, 0, 0.1]", "\"ground\" never moves and takes no arm", "allowed is []"],
    );
}

#[test]
fn a_force_that_turns_a_body_needs_its_inertia() {
    let without = BOX.replacen("inertia = [1.2e-4, 2.6e-4, 3.5e-4]\n", "", 1);
    let parts =
        ["arms[1] = [-0.04, 0, -0.025] isn't parallel to the normal", "turns the body `box`", "give its inertia"];
    refused(&without, "[[-0.04, 0, -0.025], []]", "[§[-0.04, 0, -0.025], []]", &parts);
}

#[test]
fn a_counted_contact_has_no_bodies() {
    refused(
        SCENE,
        "direction = 1",
        "count = §3",
        &["contact `link`: count = 3 doesn't go with bodies", "two of its own"],
    );
}

#[test]
fn a_second_mass_is_refused() {
    let table = "[[body]]\nname = \"front\"";
    for (scene, from, more, why) in [
        (SCENE, table, format!("[coupling]\neffective_mass = §4e-3\n{table}"), "the tables [[body]]"),
        (SCENE, table, format!("[coupling]\ninputs = [§\"effective_mass\"]\n{table}"), "the tables [[body]]"),
        (SCENE, table, format!("[impact]\nmass = §4e-3\nspeed = 1\n{table}"), "the tables [[body]]"),
        (SCENE, "direction = 1", "effective_mass = §4e-3".into(), "the tables [[body]]"),
        (INPUTS, "\"input\"", "\"input\"\neffective_mass = §4e-3".into(), "coupling.inverse_masses"),
        (INPUTS, "\"input\"", "\"input\"\ninputs = [§\"effective_mass\"]".into(), "coupling.inverse_masses"),
        (INPUTS, "\"left\"", "\"left\"\neffective_mass = §4e-3".into(), "coupling.inverse_masses"),
    ] {
        let said = if more.contains("inputs") {
            "coupling.inputs = [\"effective_mass\"]: the"
        } else {
            "mass = 0.004 is a second mass: the"
        };
        refused(scene, from, &more, &[said, &format!("the masses are those of {why}"), "leave it out"]);
    }
}

#[test]
fn masses_come_from_bodies_or_from_inputs() {
    refused(
        SCENE,
        "[[body]]\nname = \"front\"",
        "[coupling]\ninverse_masses = §\"input\"\n[[body]]\nname = \"front\"",
        &["coupling.inverse_masses = \"input\" doesn't go with tables [[body]]", "leave one of them out"],
    );
    refused(INPUTS, "\"input\"", "§\"inputs\"", &["`inputs`; did you mean `input`?", "`inverse_masses = \"inputs\"`"]);
    refused(INPUTS, "\"input\"", "§[1, 0, 1]", &["text in quotes", "inverse_masses"]);
    // without any mass the message is that of a unit that knows one
    refused(
        INPUTS,
        "[coupling]\ninverse_masses = \"input\"",
        "§[coupling]\nmaster = \"serial\"",
        &["missing `effective_mass` in `[coupling]`"],
    );
}

#[test]
fn more_contacts_than_a_matrix_is_made_for_are_refused() {
    let many = INPUTS.replacen("\"right\"\n", "\"right\"\ncount = 256\n", 1);
    refused(&many, "\"input\"", "§\"input\"", &["there are 257 contacts", "allowed are 256"]);
    let mut text = SCENE.replacen("[[body]]", "§[[body]]", 1);
    for index in 0..255 {
        text += &format!("[[contact]]\nname = \"more_{index}\"\nbetween = [\"front\", \"rear\"]\n");
    }
    refused_text(&text, &["there are 257 contacts", "allowed are 256"]);
}

#[test]
fn an_effective_mass_beyond_its_limits_is_refused_with_its_contact() {
    let light = SCENE.replacen("mass = 0.1", "mass = 1e-30", 1).replacen("mass = 0.2", "mass = 1e-30", 1);
    let link = "[[contact]]\nname = \"link\"";
    let parts =
        ["contact `link`: the effective mass of its bodies = 5e-31 is out of range", "allowed is 1e-30 to 1e30 kg"];
    refused(&light, link, &format!("§{link}"), &parts);
}

#[test]
fn laws_of_the_rate_are_refused() {
    for (scene, table) in [(SCENE, "[[body]]\nname = \"front\""), (INPUTS, "[coupling]")] {
        let with = |more: &str| format!("{more}{table}");
        let law = "[law]\nloading = §\"tsuji\"\nrestitution = 0.5\n";
        refused(
            scene,
            table,
            &with(law),
            &["law.loading = \"tsuji\"", "share bodies", "follows from one mass", "\"hertz\""],
        );
    }
}

/// Without friction it is no mistake.
#[test]
fn a_strength_at_the_rate_is_refused_with_friction() {
    let inputs = INPUTS.replacen("[coupling]", "[friction]\ncoefficient = 0.3\n\n[coupling]", 1);
    for scene in [rough_box(), inputs] {
        let rate = "rate = §{ model = \"johnson-cook\", c = 0.014, reference_rate = 1.0 }";
        let text = scene.replacen("\"mild steel\"\n", &format!("\"mild steel\"\n{rate}\n"), 1);
        refused_text(&text, &["target.rate", "share bodies and have friction", "yield_strength"]);
        let hard = "radius = 5e-3\nmaterial = \"titanium Ti-6Al-4V\"\nyield_strength = 9e8\n";
        let text = scene.replacen("radius = 5e-3\n", &format!("{hard}{rate}\n"), 1);
        refused_text(&text, &["impactor.rate", "share bodies and have friction", "yield_strength"]);
    }
}

/// The box with friction, without errors.
fn rough_box() -> String {
    let more = "[friction]\ncoefficient = 0.3\n\n[[body]]";
    let text = BOX.replacen("[[body]]", more, 1).replace("normal = ", "tangent = [1, 0, 0]\nnormal = ");
    let arms = "arms = [[-0.04, 0, -0.025], []]";
    assert!(text.contains(arms));
    text
}

#[test]
fn contacts_with_friction_need_a_tangent_across_their_normal() {
    let rough = rough_box();
    let left = "name = \"left\"\nbetween = [\"box\", \"ground\"]\ntangent = [1, 0, 0]\n";
    let with = |tangent: &str| left.replace("tangent = [1, 0, 0]\n", tangent);
    let missing = &format!("§[[contact]]\n{}", with(""));
    refused(
        &rough,
        &format!("[[contact]]\n{left}"),
        missing,
        &["contact `left`", "`tangent` is missing", "[friction]"],
    );
    for (tangent, shown) in [
        ("[0, 0, 1]", "[0, 0, 1]"),
        ("[1, 0, 1e-3]", "[1, 0, 0.001]"),
        ("[0, 0, 0]", "[0, 0, 0]"),
        ("[1, 0]", "[1, 0]"),
        ("[nan, 0, 0]", "[NaN, 0, 0]"),
    ] {
        let given = with(&format!("tangent = §{tangent}\n"));
        refused(
            &rough,
            left,
            &given,
            &["contact `left`", &format!("tangent = {shown}"), "right angles", "three finite"],
        );
    }
    // without friction it has no effect
    let smooth = rough.replace("[friction]\ncoefficient = 0.3\n", "");
    refused(
        &smooth,
        left,
        &with("tangent = §[1, 0, 0]\n"),
        &["contact `left`", "tangent has no effect without [friction]"],
    );
    // a row of balls has no tangents
    let row = SCENE.replacen("[[body]]", "[friction]\ncoefficient = 0.3\n\n[[body]]", 1);
    refused(
        &row,
        "[[contact]]\nname = \"wall\"",
        "§[[contact]]\nname = \"wall\"",
        &["contact `wall`", "`normal` is missing"],
    );
}

#[test]
fn a_body_that_friction_turns_needs_its_inertia() {
    let rough = rough_box().replace("inertia = [1.2e-4, 2.6e-4, 3.5e-4]\n", "");
    let below = rough.replace("[-0.04, 0, -0.025]", "[0, 0, -0.025]").replace("[0.04, 0, -0.025]", "[0, 0, -0.025]");
    refused(
        &below,
        "arms = [[0, 0, -0.025], []]",
        "arms = [§[0, 0, -0.025], []]",
        &["contact `left`", "the normal or the tangent", "give its inertia"],
    );
}

#[test]
fn outputs_of_the_motion_need_shared_bodies() {
    let text = |output: &str| {
        format!(
            "name = \"alone\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[friction]\n\
             coefficient = 0.3\n[fmu]\noutputs = [§\"{output}\"]\n"
        )
    };
    for output in ["tangential_speed", "tangential_impulse_moment"] {
        refused_text(&text(output), &[&format!("the output {output}"), "share bodies", "[[body]]"]);
    }
}
