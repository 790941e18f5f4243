//! Errors in scenes: the message gives the place, the error and the allowed values, and no file changes.

mod beginners;
mod contacts;
mod friction;
mod laws;
mod schema;
mod shared_bodies;

use brinell_testing::{command, refusal};
use command::{contents, empty_folder, run};
use std::fs;

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

/// A scene without errors, to be modified.
const SCENE: &str = "\
name = \"ball\"
[impactor]
radius = 5e-3
[target]
youngs_modulus = 206e9
poissons_ratio = 0.3
yield_strength = 300e6
";

/// Exports `bytes`, which are refused: the message, after a look at what the schema says of them.
#[track_caller]
fn message_of(bytes: &[u8]) -> String {
    let message = refusal::message_of(bytes);
    if let Ok(text) = str::from_utf8(bytes) {
        schema::agrees(text, &message);
    }
    message
}

/// Exports the marked scene: the message must name the marked place and contain `parts`.
#[track_caller]
fn refused_text(marked: &str, parts: &[&str]) {
    let message = refusal::refused_text(marked, parts);
    schema::agrees(&marked.replacen('§', "", 1), &message);
}

/// Exports the good scene with `from` replaced by `to`: the message must name the marked place and contain `parts`.
#[track_caller]
fn refused(from: &str, to: &str, parts: &[&str]) {
    assert!(SCENE.contains(from), "the scene has no {from:?} to alter");
    refused_text(&SCENE.replacen(from, to, 1), parts);
}

/// Exports the good scene with `more` appended.
#[track_caller]
fn refused_with(more: &str, parts: &[&str]) {
    refused_text(&format!("{SCENE}\n{more}"), parts);
}

#[test]
fn two_radii_go_with_no_friction_and_no_law_of_round_contacts() {
    let ellipse = "target]\nradius = [0.02, \"flat\"]";
    schema::accepts(&SCENE.replacen("target]", ellipse, 1));
    for (more, words) in [
        ("friction = § { coefficient = 0.1 }", "[friction] doesn't go with two radii"),
        ("law.loading = §\"thornton\"", "is a law of round contacts"),
        ("law.elastic_restitution = §\"waves\"", "an ellipse has a number"),
    ] {
        let text = SCENE.replacen("target]", ellipse, 1).replacen("[impactor]", &format!("{more}\n[impactor]"), 1);
        refused_text(&text.replacen("§ ", "§", 1), &[words]);
    }
    refused("5e-3", "§[5e-3]", &["a list of 1"]);
    refused("5e-3\n", "§[5e-3, 8e-3]\nlength = 0.1\nshape = \"cylinder\"\n", &["is a list under a cylinder"]);
    refused("5e-3\n", "§[5e-3, 8e-3]\n", &["give impact.mass"]);
}

#[test]
fn the_scene_that_the_tests_alter_is_good() {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    run(folder.path(), ["constants", "scene.toml"]).with_status(0);
}

#[test]
fn an_unknown_key_is_refused_in_each_table() {
    refused(
        "name",
        "§colour = 1\nname",
        &["`colour`", "`name`", "`impactor`", "`target`", "`law`", "`fmu`", "`impact`", "`contact`"],
    );
    refused("[impactor]", "[impactor]\n§mass = 1", &["`mass`", "[impact] has a mass", "`material`", "`radius`"]);
    refused(
        "[target]",
        "[target]\n§HRC = 58",
        &["`HRC`", "hardness = \"200 HBW 10/3000\"", "\"58 HRC\"", "`material`", "`density`", "`surface`"],
    );
    refused_with("[law]\n§laoding = \"hertz\"", &["`laoding`", "`loading`", "`unloading`", "`passivity_guard`"]);
    refused_with("[fmu]\n§inputs = []", &["`inputs`", "`outputs`", "`parameters`", "`initial_gap`"]);
    refused_with(
        "[impact]\nmass = 1\nspeed = 1\n§angle = 1",
        &["`angle` is not supported", "along the normal", "`mass`", "`speed`"],
    );
}

#[test]
fn an_unknown_table_is_refused() {
    refused_with("[§colour]\nred = 1", &["`colour`", "`law`"]);
}

#[test]
fn an_unknown_name_is_refused_with_the_known_ones() {
    refused("yield_strength = 300e6", "material = §\"cheese\"", &["material", "`cheese`", "`mild steel`"]);
    refused_with("[law]\nloading = §\"kelvin\"", &["law.loading", "`kelvin`", "`hertz`", "`big-alabo`"]);
    refused_with("[law]\nunloading = §\"kelvin\"", &["law.unloading", "`kelvin`", "`contact-radius`", "`thornton`"]);
    refused_with("[fmu]\noutputs = [\"work\", §\"forse\"]", &["output", "`forse`", "`force`", "`regime`"]);
    refused_with("[fmu]\nparameters = [§\"yield\"]", &["parameter", "`yield`", "`target.yield_strength`"]);
}

#[test]
fn an_unknown_surface_is_refused_with_its_key() {
    refused("[target]", "[target]\nsurface = §\"old\"", &["`old`", "`dented`", "`fresh`", "surface"]);
}

/// A rigid impactor has no modulus and a flat target has no radius that could be set.
#[test]
fn a_parameter_that_the_scene_has_not_got_cannot_be_settable() {
    refused_with("[fmu]\nparameters = [§\"target.radius\"]", &["`target.radius`", "`impactor.radius`"]);
    refused_with("[fmu]\nparameters = [§\"impactor.youngs_modulus\"]", &["`impactor.youngs_modulus`"]);
}

#[test]
fn a_wrong_type_is_refused_with_its_key() {
    refused("\"ball\"", "§3", &["name", "a whole number", "text in quotes"]);
    refused("5e-3", "§\"wide\"", &["radius", "\"wide\"", "expected a number"]);
    refused("300e6", "§true", &["yield_strength", "true or false"]);
    refused_with("[fmu]\noutputs = §\"force\"", &["outputs", "\"force\""]);
    refused_with("[fmu]\noutputs = [§1]", &["outputs", "a whole number", "text in quotes"]);
    refused_with("[impact]\nmass = §\"heavy\"\nspeed = 1", &["mass", "\"heavy\""]);
}

/// `f64` is a term of Rust, not of scene files.
#[test]
fn a_wrong_type_is_refused_in_the_words_of_the_user() {
    let message = message_of(SCENE.replacen("5e-3", "\"wide\"", 1).as_bytes());
    assert!(message.contains("number") && !message.contains("f64"), "{message}");
}

#[test]
fn a_missing_key_or_table_is_refused() {
    refused("name = \"ball\"\n", "§", &["missing", "`name`"]);
    refused("[impactor]\nradius = 5e-3", "§[impactor]", &["missing", "`radius`"]);
    refused("name = \"ball\"\n[impactor]\nradius = 5e-3\n", "§name = \"ball\"\n", &["missing", "`impactor`"]);
    refused("[target]\nyoungs_modulus = 206e9\n", "§[target]\n", &["`youngs_modulus`", "`material`", "`mild steel`"]);
    refused_with("§[impact]\nmass = 1", &["missing", "`speed`"]);
}

#[test]
fn a_name_that_is_no_identifier_is_refused() {
    for name in ["4ball", "steel ball", "", "kugelstoß", "a-b", "a/b", "../ball", "a.b"] {
        let value = format!("{name:?}");
        refused("\"ball\"", &format!("§{value}"), &["name = ", &value, "letters, digits and `_`"]);
    }
}

/// FMI asks for a C identifier, which importers may compile into their own code, in C or C++.
#[test]
fn a_name_that_is_a_keyword_of_c_or_cpp_is_refused() {
    for name in ["double", "restrict", "_Bool", "class", "xor"] {
        refused("\"ball\"", &format!("§{name:?}"), &["name = ", name, "a keyword of C or C++", "call it otherwise"]);
    }
}

/// `nul.dll` can't be unpacked on Windows.
#[test]
fn a_name_reserved_for_a_device_on_windows_is_refused() {
    for name in ["con", "NUL", "Aux", "prn", "com1", "LPT9", "com0"] {
        refused("\"ball\"", &format!("§{name:?}"), &["name = ", name, "device on Windows"]);
    }
}

/// Such an FMU was exported and passed the check, but no XML parser could read it.
#[test]
fn a_character_that_xml_cannot_have_is_refused_by_its_key() {
    for (escape, said) in [
        ("\\u0001", "U+0001"),
        ("\\u001B", "U+001B"),
        ("\\uFFFE", "U+FFFE"),
        ("\\uFFFF", "U+FFFF"),
        ("\u{fffe}", "U+FFFE"),
    ] {
        let description = format!("description = §\"steel{escape} ball\"\nname");
        refused("name", &description, &["description has ", said, "character 6", "XML doesn't allow"]);
        let author = description.replacen("description", "author", 1);
        refused("name", &author, &["author has ", said, "character 6", "XML doesn't allow"]);
        refused("\"ball\"", &format!("§\"ball{escape}\""), &["name = ", "letters, digits and `_`"]);
        let contact = format!("[[contact]]\nname = §\"left{escape}\"");
        refused_with(&contact, &["name = ", "letters, digits and `_`"]);
    }
}

#[test]
fn a_material_number_finds_the_name_and_another_alloy_isnt_suggested() {
    for (asked, said) in [
        ("Steel 1.4301", "its name here is `stainless steel 304`"),
        (
            "1.3505",
            "several conditions, whose strengths differ: say which, `bearing steel 52100, hardened` or `bearing",
        ),
        ("AISI 4340", "say which, `steel AISI 4340, 30 HRC` or `steel AISI 4340, tempered at 205 C`"),
        ("steel 1.2379", "unknown material `steel 1.2379`, expected"),
    ] {
        refused("[target]\n", &format!("[target]\nmaterial = §\"{asked}\"\n"), &[asked, said]);
    }
}

/// Each name and each alias of one material is that material.
#[test]
fn a_material_has_other_names_and_warns_where_it_is_no_metal() {
    let folder = empty_folder();
    let predicted = |material: &str| {
        let text = SCENE.replace(
            "youngs_modulus = 206e9\npoissons_ratio = 0.3\nyield_strength = 300e6",
            &format!("material = \"{material}\""),
        );
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0)
    };
    let listed = run(folder.path(), ["materials", "--json"]).with_status(0).json();
    let listed = listed.as_array().unwrap();
    let texts = |value: &serde_json::Value| {
        value.as_array().unwrap().iter().map(|text| text.as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    let all: Vec<String> = listed.iter().flat_map(|material| texts(&material["aliases"])).collect();
    for material in listed {
        let name = material["name"].as_str().unwrap();
        let by_name = predicted(name);
        // steel and aluminium without a condition have no strength, and the scene gives none
        let is_asked = ["steel", "aluminium"].contains(&name);
        let is_silent = material["warning"].is_null() && !is_asked;
        assert_eq!(by_name.err.is_empty(), is_silent, "{name}: {}", by_name.err);
        for alias in
            texts(&material["aliases"]).iter().filter(|alias| all.iter().filter(|other| other == alias).count() == 1)
        {
            assert_eq!(predicted(alias).json()["laws"], by_name.json()["laws"], "{alias}");
        }
    }
    let said = predicted("glass").err.replace("\n         ", " ");
    assert!(said.contains("target.material = \"glass\": it is brittle and has no yield strength here"), "{said}");
}

#[test]
fn a_number_out_of_range_is_refused_with_the_range() {
    for (from, to, key, value) in [
        ("5e-3", "-5e-3", "impactor.radius", "-0.005"),
        ("5e-3", "0", "impactor.radius", "0"),
        ("5e-3", "nan", "impactor.radius", "NaN"),
        ("5e-3", "inf", "impactor.radius", "inf"),
        ("206e9", "-206e9", "target.youngs_modulus", "-2.06e11"),
        ("206e9", "inf", "target.youngs_modulus", "inf"),
        ("0.3", "0.75", "target.poissons_ratio", "0.75"),
        ("0.3", "-1.0", "target.poissons_ratio", "-1"),
        ("0.3", "nan", "target.poissons_ratio", "NaN"),
        ("300e6", "0", "target.yield_strength", "0"),
        ("300e6", "-0.0", "target.yield_strength", "-0"),
        ("300e6", "nan", "target.yield_strength", "NaN"),
        ("300e6", "inf", "target.yield_strength", "inf"),
    ] {
        let said = format!("{key} = {value} ");
        refused(from, &format!("§{to}"), &[&said, "out of range", "allowed is", " to "]);
    }
    for (value, said) in
        [("0", "0"), ("-0.0", "-0"), ("-7850", "-7850"), ("nan", "NaN"), ("inf", "inf"), ("1e10", "1e10")]
    {
        let parts = ["allowed is 0.001 to 1e9 kg/m^3"];
        let key = format!("target.density = {} ", said);
        refused("[target]", &format!("[target]\ndensity = §{value}"), &[&key, parts[0]]);
    }
    refused_with("[fmu]\ninitial_gap = §nan", &["initial_gap = NaN", "allowed is", "to"]);
    refused_with("[fmu]\ninitial_gap = §1e7", &["initial_gap = 10000000", "allowed is", "to"]);
    for (value, said) in [("0", "0"), ("-1e-3", "-0.001"), ("nan", "NaN"), ("inf", "inf"), ("1e31", "1e31")] {
        for key in ["step_size", "stop_time"] {
            let said = format!("fmu.{key} = {said} is out of range");
            refused_with(&format!("[fmu]\n{key} = §{value}"), &[&said, "allowed is 1e-30 to 1e30 s"]);
        }
    }
}

#[test]
fn a_stop_time_before_the_end_of_the_first_step_is_refused() {
    let parts = ["fmu.stop_time = 0.001 s", "before the end of the first step", "fmu.step_size = 0.01 s"];
    refused_with("[fmu]\nstep_size = 0.01\nstop_time = §1e-3", &parts);
}

#[test]
fn a_target_that_the_impactor_does_not_fit_is_refused() {
    for (radius, said) in [("-4e-3", "-0.004"), ("-5e-3", "-0.005"), ("0", "0"), ("-0.0", "-0")] {
        let said = format!("target.radius = {said} does not fit impactor.radius = 0.005");
        refused("[target]", &format!("[target]\nradius = §{radius}"), &[&said, "wider"]);
    }
    refused("[target]", "[target]\nradius = §nan", &["target.radius = NaN", "allowed is"]);
    refused("[target]", "[target]\nradius = §inf", &["target.radius = inf", "allowed is"]);
}

/// Radii of the impactor are limited to 1e-12 m; a target of 1e-300 m caused a panic.
#[test]
fn a_target_of_no_size_is_refused() {
    refused("[target]", "[target]\nradius = §1e-300", &["target.radius = 1e-300"]);
    refused("[target]", "[target]\nradius = §5e-324", &["target.radius = 5e-324"]);
}

#[test]
fn half_an_elastic_impactor_is_refused() {
    for property in ["youngs_modulus = §70e9", "poissons_ratio = §0.3"] {
        refused("5e-3", &format!("5e-3\n{property}"), &["impactor", "both", "`youngs_modulus`", "`poissons_ratio`"]);
    }
}

#[test]
fn laws_that_do_not_go_together_are_refused() {
    refused_with("[law]\nloading = \"hertz\"\nunloading = §\"thornton\"", &["law.unloading", "thornton", "hertz"]);
    refused("yield_strength = 300e6\n", "[law]\nloading = §\"big-alabo\"", &["big-alabo", "target.yield_strength"]);
    refused("yield_strength = 300e6\n", "[law]\nunloading = §\"thornton\"", &["law.unloading", "thornton"]);
}

#[test]
fn a_guard_of_a_law_that_has_none_is_refused_with_those_that_have_one() {
    let law = "[law]\nloading = \"kogut-etsion\"\nunloading = \"etsion\"\npassivity_guard = §true";
    let with = ["`contact-radius`", "`thornton`", "`original-radius`", "`deformed-radius`"];
    refused_with(law, &[&["\"etsion\" has no passivity guard"][..], &with].concat());
    refused_with("[law]\nloading = \"hertz\"\npassivity_guard = §true", &["law.passivity_guard", "hertz"]);
    refused_with("[law]\npassivity_guard = §\"yes\"", &["passivity_guard", "\"yes\"", "true or false"]);
}

#[test]
fn an_impact_without_motion_or_mass_is_refused() {
    for mass in ["0", "-1.0", "nan", "inf"] {
        refused_with(&format!("[impact]\nmass = §{mass}\nspeed = 1"), &["impact.mass = ", "positive and finite"]);
    }
    for speed in ["0.0", "-1.0", "nan", "inf"] {
        refused_with(&format!("[impact]\nmass = 1\nspeed = §{speed}"), &["impact.speed = ", "positive and finite"]);
    }
}

/// The message blamed the law: "drives the bodies deeper than the law can be evaluated".
#[test]
fn an_impact_with_next_to_no_energy_is_refused_without_blaming_the_law() {
    let parts = ["kinetic energy", "mass = 1e-30 kg", "speed = 1e-150 m/s", "can't be computed with"];
    refused_with("§[impact]\nmass = 1e-30\nspeed = 1e-150", &parts);
}

#[test]
fn an_impact_too_hard_for_the_law_is_refused_with_its_numbers() {
    refused_with("§[impact]\nmass = 1e300\nspeed = 1e200", &["impact", "mass = 1e300", "speed = 1e200", "deep"]);
}

#[test]
fn a_file_that_is_not_toml_is_refused() {
    refused("= 206e9", "=§= 206e9", &["="]);
    refused("\"ball\"", "\"ball§", &["\""]);
    refused_with("radius§", &["="]);
    refused_with("[§impactor]\nradius = 1", &["duplicate"]);
}

#[test]
fn a_missing_file_is_named() {
    let folder = empty_folder();
    let run = run(folder.path(), ["export", "no such.toml"]).with_status(1);
    assert!(run.err.starts_with("brinell: no such.toml: ") && run.err.contains(&command::missing()), "{run:#?}");
    assert!(contents(folder.path()).is_empty());
}

#[test]
fn a_folder_instead_of_a_scene_is_named() {
    let folder = empty_folder();
    fs::create_dir(folder.path().join("scenes")).unwrap();
    let run = run(folder.path(), ["export", "scenes"]).with_status(1);
    assert!(run.err.starts_with("brinell: scenes: "), "{run:#?}");
}
