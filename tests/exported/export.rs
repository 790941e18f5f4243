//! What an export makes and says: of the scenes of the project, and of what is left out.

use crate::command::{compile, contents, empty_folder, run, scene};
use crate::unit;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

#[test]
fn without_arguments_the_default_scene_is_exported_and_checked() {
    let folder = empty_folder();
    let first = compile(folder.path(), [] as [&str; 0]).with_status(0);
    assert_eq!(contents(folder.path()), ["steel_ball.fmu"]);
    for part in ["steel_ball.fmu", "predicted", "simulated", "largest force", "restitution", "agreement within"] {
        assert!(first.out.contains(part), "nothing of {part:?} in {first:#?}");
    }
    // both laws by their names, and what the recommended one says of this impact
    let words = first.out.split_whitespace().collect::<Vec<_>>().join(" ");
    let (_, end) = words.split_once("This scene has the law ").expect("a sentence about the law");
    let scene = scene("steel_ball").display().to_string();
    let said = run(folder.path(), ["predict", &scene, "--laws", "brinell"]).with_status(0).out;
    for name in ["largest force", "depth of the dent", "restitution"] {
        let value =
            said.lines().find_map(|line| line.trim().strip_prefix(name)).expect("a line of the prediction").trim();
        assert!(end.contains(value), "no {name} of {value} in {end}");
    }
    assert!(end.starts_with("big-alabo (Big-Alabo, Harrison and Cartmell). Without [law] it has brinell ("), "{end}");
}

#[test]
fn every_scene_is_exported_and_agrees_with_its_prediction() {
    let compiled = unit::scenes_to_compile();
    for path in unit::scenes().into_iter().chain(unit::scenes_in("scenes/shapes")) {
        let folder = empty_folder();
        let arguments = [OsStr::new("--json"), OsStr::new("export"), path.as_os_str()];
        let export = match compiled.contains(&path) {
            true => compile(folder.path(), arguments),
            false => run(folder.path(), arguments),
        };
        let export = export.with_status(0).json();
        let unit = export["fmu"].as_str().expect("the path of the unit");
        assert_eq!(contents(folder.path()), [unit]);
        assert_eq!(fs::metadata(folder.path().join(unit)).unwrap().len(), export["size"].as_u64().unwrap());
        let check = run(folder.path(), ["check", unit, "--json"]).with_status(0).json();
        assert_eq!(check["passed"], true, "{check}");
        // a rate-dependent law leaves no dent to compare; friction adds tangential restitution, spin and friction work
        let rows = match unit {
            "damped.fmu" => 4,
            "oblique.fmu" | "rough_contacts.fmu" | "two_directions.fmu" => 8,
            // the impulses of both contacts
            "stack.fmu" | "inverse_masses.fmu" => 2,
            // those of three contacts along the normal and in two directions
            "slope.fmu" => 9,
            _ => 5,
        };
        let contacts = check["contacts"].as_array().cloned().unwrap_or_else(|| vec![check.clone()]);
        for contact in contacts {
            assert_eq!(contact["rows"].as_array().expect("rows").len(), rows, "{check}");
        }
        assert_eq!(check["variables"], export["variable_count"]);
    }
}

/// Every feature is either included or omitted.
#[test]
fn every_feature_is_listed_as_included_or_omitted() {
    let folder = empty_folder();
    let list =
        |value: &serde_json::Value| -> BTreeSet<String> { serde_json::from_value(value.clone()).expect("names") };
    let told = |name: &str| {
        let scene = scene(name).display().to_string();
        compile(folder.path(), ["export", &scene, "--json"]).with_status(0).json()
    };
    let [default, everything, elastic] = ["steel_ball", "everything", "elastic"].map(told);
    let all = |unit: &serde_json::Value| &list(&unit["variables"]) | &list(&unit["left_out"]);
    assert_eq!(all(&default), all(&everything));
    assert_eq!(all(&default), all(&elastic));
    for unit in [&default, &everything, &elastic] {
        assert!(list(&unit["variables"]).is_disjoint(&list(&unit["left_out"])), "{unit}");
        assert!(list(&unit["constants"]).is_subset(&list(&unit["left_out"])), "{unit}");
        assert!(list(&unit["absent"]).is_disjoint(&list(&unit["constants"])), "{unit}");
    }
    let laws = run(folder.path(), ["laws", "--json"]).with_status(0).json();
    let known = |kind: &str| -> BTreeSet<String> {
        laws[kind].as_array().unwrap().iter().map(|law| law["name"].as_str().unwrap().to_string()).collect()
    };
    let but = |kind: &str, name: &str| &known(kind) - &BTreeSet::from([name.to_string()]);
    let left_out = &default["left_out_laws"];
    assert_eq!(list(&left_out["loading"]), but("loading", "big-alabo"));
    assert_eq!(list(&left_out["unloading"]), but("unloading", "contact-radius"));
    assert_eq!(list(&elastic["left_out_laws"]["unloading"]), known("unloading"), "an elastic contact has no unloading");
    assert!(list(&elastic["absent"]).contains("target.yield_strength"), "{elastic}");
    assert!(list(&elastic["constants"]).contains("impactor.radius"), "{elastic}");
}

/// Letters of any language, quotation marks, tabs, line ends, and the placeholders of the GUID.
#[test]
fn a_description_of_any_other_characters_is_exported_and_checked() {
    let folder = empty_folder();
    let description = r#"Kugelsto\u00df \u2014 \u7403 \U0001f600 \ufffd <&>' \t\r\n \"GUID to come\""#;
    let text = fs::read_to_string(scene("elastic")).unwrap();
    let (before, after) = text.split_once("glass bead on a glass plate, elastic").expect("its description");
    fs::write(folder.path().join("scene.toml"), format!("{before}{description}{after}")).unwrap();
    run(folder.path(), ["export", "scene.toml"]).with_status(0);
    run(folder.path(), ["check", "elastic.fmu"]).with_status(0);
}

/// The source tree has those of the default scene, so that the library can be built and tested without an export.
#[test]
fn the_constants_and_the_kind_in_the_source_are_those_of_the_default_scene() {
    let folder = empty_folder();
    for (command, file) in [("constants", "exported"), ("kind", "kind")] {
        let written = run(folder.path(), [command, scene("steel_ball").to_str().unwrap()]).with_status(0).out;
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/unit/src").join(file).with_extension("rs");
        assert!(written == fs::read_to_string(path).unwrap(), "{file}.rs is not what the program writes:\n{written}");
    }
}
