//! Errors in scenes of several contacts: the message names the contact, the place and the allowed values.

use super::command::{empty_folder, run};
use super::refused_text;
use std::fs;

/// Two contacts without errors.
const SCENE: &str = "\
name = \"vice\"

[impactor]
radius = 5e-3

[target]
material = \"mild steel\"

[[contact]]
name = \"left\"

[[contact]]
name = \"right\"
count = 3
";

/// Exports the good scene with `from` replaced by `to`: the message must name the marked place and contain `parts`.
#[track_caller]
fn refused(from: &str, to: &str, parts: &[&str]) {
    assert_eq!(SCENE.matches(from).count(), 1, "the scene has not one {from:?} to alter");
    refused_text(&SCENE.replacen(from, to, 1), parts);
}

/// The same with `line` added to the contact `left`.
#[track_caller]
fn refused_in_left(line: &str, parts: &[&str]) {
    refused("\"left\"\n", &format!("\"left\"\n{line}\n"), parts);
}

#[test]
fn the_scene_that_the_tests_alter_is_good() {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    run(folder.path(), ["predict", "scene.toml"]).with_status(0);
}

#[test]
fn an_unknown_key_of_a_contact_is_refused_with_the_known_ones() {
    let keys = [
        "`colour`",
        "`name`",
        "`count`",
        "`impactor`",
        "`target`",
        "`initial_gap`",
        "`effective_mass`",
        "`parameters_per_contact`",
    ];
    refused_in_left("§colour = 1", &keys);
    refused_in_left("impactor = { §mass = 1 }", &["`mass`", "`radius`", "`youngs_modulus`", "`poissons_ratio`"]);
    refused_in_left("target = { §hard = 1 }", &["`hard`", "`material`", "`yield_strength`", "`surface`"]);
    let words = ["contact `left`: target.plate_thickness belongs to [target], for all contacts"];
    refused_in_left("target = { plate_thickness = §0.01 }", &words);
    refused_in_left(
        "target = { hardness = §\"200 HK\" }",
        &["contact `left`: target.hardness = \"200 HK\": a hardness is"],
    );
    refused_in_left("target = { surface = §\"old\" }", &["`old`", "`dented`", "`fresh`"]);
    refused_in_left("target = { material = §\"cheese\" }", &["material", "`cheese`", "`mild steel`"]);
    refused_in_left("[contact.§law]\nloading = \"hertz\"", &["`law`", "`target`"]);
}

#[test]
fn a_contact_without_a_name_is_refused() {
    refused("[[contact]]\nname = \"left\"", "§[[contact]]", &["missing", "`name`"]);
}

#[test]
fn a_contact_whose_name_is_no_identifier_is_refused() {
    for name in ["4left", "left anvil", "", "a.b", "a[1]"] {
        let value = format!("{name:?}");
        refused("\"left\"", &format!("§{value}"), &["name = ", &value, "letters, digits and `_`"]);
    }
}

#[test]
fn two_contacts_of_one_name_are_refused() {
    refused("\"right\"", "§\"left\"", &["name = \"left\" is taken by another contact"]);
}

/// `target.force` next to `target.radius` would belong to no contact.
#[test]
fn a_contact_named_like_a_variable_is_refused_with_the_names_in_use() {
    for name in ["target", "impactor", "initial_gap", "force", "regime"] {
        let said = format!("name = \"{name}\" belongs to a variable");
        refused("\"left\"", &format!("§\"{name}\""), &[&said, "`target`", "`impactor`", "`initial_gap`"]);
    }
}

#[test]
fn a_count_out_of_range_is_refused_with_the_range() {
    for count in ["0", "-1", "100001"] {
        let said = format!("count = {count} is out of range: allowed is 1 to 100000");
        refused("count = 3", &format!("count = §{count}"), &[&said]);
    }
    refused("count = 3", "count = §2.5", &["2.5", "a whole number"]);
    refused("count = 3", "count = §\"many\"", &["\"many\"", "a whole number"]);
}

#[test]
fn too_many_contacts_in_total_are_refused() {
    let scene = SCENE.replacen("\"left\"", "\"left\"\ncount = 60000", 1);
    let scene =
        scene.replacen("[[contact]]\nname = \"right\"\ncount = 3", "§[[contact]]\nname = \"right\"\ncount = 40001", 1);
    refused_text(&scene, &["contact `right`", "100001 contacts in all", "100000"]);
}

#[test]
fn an_empty_list_of_contacts_is_refused() {
    let (before, _) = SCENE.split_once("[impactor]").unwrap();
    let scene = format!("{before}contact = §[]\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n");
    refused_text(&scene, &["empty", "leave it out"]);
}

#[test]
fn a_number_of_a_contact_out_of_range_is_refused_with_its_variable_and_the_range() {
    for (line, said) in [
        ("impactor = { radius = §-5e-3 }", "left.impactor.radius = -0.005 "),
        ("impactor = { radius = §nan }", "left.impactor.radius = NaN "),
        ("target = { yield_strength = §0 }", "left.target.yield_strength = 0 "),
        ("target = { density = §0 }", "left.target.density = 0 "),
        ("target = { poissons_ratio = §0.75 }", "left.target.poissons_ratio = 0.75 "),
        ("target = { youngs_modulus = §inf }", "left.target.youngs_modulus = inf "),
        ("initial_gap = §1e7", "left.initial_gap = 10000000 "),
    ] {
        refused_in_left(line, &[said, "out of range", "allowed is", " to "]);
    }
}

/// Even if no contact uses it.
#[test]
fn a_number_of_the_scene_that_every_contact_replaces_is_checked_too() {
    let scene = "name = \"unit\"\n[impactor]\nradius = §-1.0\n[target]\nmaterial = \"mild steel\"\n[[contact]]\n\
                 name = \"left\"\nimpactor = { radius = 1e-3 }\n";
    refused_text(scene, &["impactor.radius = -1 is out of range"]);
}

#[test]
fn a_missing_property_of_a_contact_is_named_with_the_contact() {
    let marked = SCENE.replacen("[[contact]]", "§[[contact]]", 1);
    let without = |table: &str| marked.replacen(table, "", 1);
    let radius = without("[impactor]\nradius = 5e-3\n");
    refused_text(&radius, &["contact `left`", "impactor.radius is missing", "[impactor]"]);
    let target = without("[target]\nmaterial = \"mild steel\"\n");
    refused_text(&target, &["contact `left`", "`youngs_modulus` and `poissons_ratio`", "`material`", "`mild steel`"]);
    // half a target is not enough, and the other half in another contact does not help
    let half = target.replacen("\"right\"", "\"right\"\ntarget = { material = \"mild steel\" }", 1);
    refused_text(&half, &["contact `left`", "`material`"]);
}

#[test]
fn half_an_elastic_impactor_of_a_contact_is_refused() {
    for property in ["youngs_modulus = §70e9", "poissons_ratio = §0.3"] {
        let parts = ["contact `left`", "both", "`youngs_modulus`", "`poissons_ratio`"];
        refused_in_left(&format!("impactor = {{ {property} }}"), &parts);
    }
}

#[test]
fn half_a_rod_of_a_contact_is_refused() {
    let needs = ["contact `left`", "target.length = 0.1 needs target.area"];
    refused_in_left("target = { length = §0.1 }", &needs);
    let needs = ["contact `left`", "impactor.length = 0.1 needs impactor.youngs_modulus"];
    refused_in_left("impactor = { length = §0.1, area = 1e-4 }", &needs);
    refused_in_left("target = { length = 0.1, area = §0 }", &["left.target.area = 0 ", "out of range"]);
}

#[test]
fn a_target_that_the_impactor_of_a_contact_does_not_fit_is_refused() {
    let said = ["contact `left`", "target.radius = -0.004 does not fit impactor.radius = 0.005", "wider"];
    refused_in_left("target = { radius = §-4e-3 }", &said);
    // all contacts share the socket, but not the ball
    let socket = SCENE.replacen("[target]", "[target]\nradius = §-6e-3", 1);
    let scene = socket.replacen("count = 3", "impactor = { radius = 7e-3 }", 1);
    refused_text(&scene, &["contact `right`", "target.radius = -0.006 does not fit impactor.radius = 0.007"]);
}

#[test]
fn one_contact_without_yield_strength_among_others_is_refused() {
    let scene = SCENE.replacen(
        "[target]\nmaterial = \"mild steel\"",
        "[target]\nyoungs_modulus = 2e11\npoissons_ratio = 0.3",
        1,
    );
    let scene = scene.replacen("\"left\"", "\"left\"\ntarget = { yield_strength = 3e8 }", 1);
    let marked = scene.replacen("[[contact]]\nname = \"right\"", "§[[contact]]\nname = \"right\"", 1);
    refused_text(&marked, &["contact `right`", "\"brinell\"", "target.yield_strength", "every contact"]);
    // an elastic law needs none
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), format!("{scene}[law]\nloading = \"hertz\"\n")).unwrap();
    run(folder.path(), ["predict", "scene.toml"]).with_status(0);
}

#[test]
fn an_impact_too_hard_for_one_contact_is_refused_with_its_name() {
    let scene = SCENE.replacen("count = 3", "impactor = { radius = 1e-12 }", 1);
    let scene = format!("{scene}§[impact]\nmass = 1e180\nspeed = 1e11\n");
    refused_text(&scene, &["contact `right`", "deeper", "mass = 1e180"]);
}

#[test]
fn constants_of_a_law_are_tried_on_the_bodies_of_every_contact() {
    // on mild steel this is a valid law, but not on a material a hundred times as hard
    let law = "[law]\nloading = \"ghaednia\"\nloading_parameters = §{ hardness_loss = 1.4 }\n";
    let scene = SCENE.replacen("count = 3", "target = { yield_strength = 3e10 }", 1);
    let parts = ["contact `right`", "with these parameters the loading force falls at"];
    refused_text(&format!("{scene}{law}"), &parts);
}

#[test]
fn a_settable_parameter_is_one_of_all_contacts_or_of_one_with_its_name() {
    let own = SCENE.replacen("\"left\"", "\"left\"\ntarget = { yield_strength = 4e8 }", 1);
    let known = ["`impactor.radius`", "`target.yield_strength`", "`left.target.yield_strength`"];
    for wrong in
        ["right.target.yield_strength", "left.impactor.radius", "left", "yield_strength", "right[1].initial_gap"]
    {
        let said = format!("unknown parameter `{wrong}`");
        let parts = [&[said.as_str()][..], &known].concat();
        refused_text(&format!("{own}[fmu]\nparameters = [\"impactor.radius\", §\"{wrong}\"]\n"), &parts);
    }
}

/// A parameter of all contacts that every contact overrides is not a parameter of the FMU.
#[test]
fn a_parameter_that_every_contact_replaces_cannot_be_settable() {
    let scene = SCENE.replacen("\"left\"", "\"left\"\ninitial_gap = 1e-3", 1);
    let scene = scene.replacen("count = 3", "initial_gap = 0.0", 1);
    let marked = format!("{scene}[fmu]\nparameters = [§\"initial_gap\"]\n");
    refused_text(&marked, &["unknown parameter `initial_gap`", "`left.initial_gap`", "`right.initial_gap`"]);
}

#[test]
fn parameters_per_contact_are_parameters_of_the_contact() {
    let known = ["contact `left`", "`impactor.radius`", "`target.yield_strength`", "`initial_gap`"];
    for name in ["hardness", "target.density", "impactor.youngs_modulus", "restitution", "effective_mass", "left"] {
        let unknown = format!("unknown parameter `{name}`");
        refused_in_left(
            &format!("parameters_per_contact = [§\"{name}\"]"),
            &[&[unknown.as_str()], &known[..]].concat(),
        );
    }
    refused_in_left("parameters_per_contact = §\"initial_gap\"", &["parameters_per_contact"]);
    let input = "\n[coupling]\neffective_mass = 4e-3\ninputs = [\"effective_mass\"]\n\n[[contact]]\nname = \"left\"\n\
                 parameters_per_contact = [§\"effective_mass\"]\n";
    refused("\n[[contact]]\nname = \"left\"\n", input, &["contact `left`", "effective_mass is an input"]);
    let names = "[\"initial_gap\", §\"target.yield_strength\"]";
    refused("count = 3", &format!("count = 5001\nparameters_per_contact = {names}"), &["10002", "allowed are 10000"]);
}

#[test]
fn a_mass_of_a_contact_is_refused_where_the_fmu_does_not_know_it() {
    refused_in_left("effective_mass = §2e-3", &["contact `left`", "effective_mass", "[coupling]"]);
    for mass in ["0.0", "-1.0", "1e31", "nan"] {
        let coupling = "\n[coupling]\neffective_mass = 4e-3\n\n[[contact]]\nname = \"left\"\n";
        let scene = format!("{coupling}effective_mass = §{mass}\n");
        refused("\n[[contact]]\nname = \"left\"\n", &scene, &["left.effective_mass"]);
    }
}
