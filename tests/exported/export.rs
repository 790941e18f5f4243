//! The command line from the user's point of view: exit status, results, the FMU and its library.

use crate::command::{assert_same, compile, contents, empty_folder, exported, run, scene};
use crate::unit;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

#[test]
fn a_wrong_call_ends_with_2_and_shows_the_usage() {
    let folder = empty_folder();
    for arguments in
        [&["export"][..], &["exprt"], &["check"], &["export", "a", "b"], &["--colour"], &["check", "-o", "x"]]
    {
        let run = run(folder.path(), arguments).with_status(2);
        assert!(run.err.contains("Usage:") && run.out.is_empty(), "{arguments:?}: {run:#?}");
    }
    assert!(contents(folder.path()).is_empty());
}

#[test]
fn help_and_version_go_to_standard_output() {
    let folder = empty_folder();
    let help = run(folder.path(), ["--help"]).with_status(0);
    assert!(help.out.contains("export") && help.out.contains("check") && help.err.is_empty(), "{help:#?}");
    let version = run(folder.path(), ["--version"]).with_status(0);
    assert_eq!(version.out.lines().next(), Some(concat!("brinell ", env!("CARGO_PKG_VERSION"))));
}

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

#[test]
fn json_has_the_keys_that_programs_read() {
    let folder = empty_folder();
    let keys = |json: &serde_json::Value| json.as_object().expect("an object").keys().cloned().collect::<BTreeSet<_>>();
    let export =
        compile(folder.path(), ["export", scene("steel_ball").to_str().unwrap(), "--json"]).with_status(0).json();
    let left_out = ["left_out", "left_out_laws", "left_out_features", "absent", "constants"];
    for key in ["fmu", "guid", "size", "library_size", "imports", "variables", "variable_count"].iter().chain(&left_out)
    {
        assert!(keys(&export).contains(*key), "no {key} in {export}");
    }
    let check = run(folder.path(), ["check", "steel_ball.fmu", "--json"]).with_status(0).json();
    for key in ["fmu", "platforms", "variables", "impact", "step", "rows", "wrong_starts", "passed"] {
        assert!(keys(&check).contains(key), "no {key} in {check}");
    }
    for key in ["quantity", "unit", "predicted", "simulated", "difference"] {
        assert!(keys(&check["rows"][0]).contains(key), "no {key} in {check}");
    }
    let materials = run(folder.path(), ["materials", "--json"]).with_status(0).json();
    assert!(materials[0]["youngs_modulus"].as_f64().is_some_and(|modulus| modulus > 1e9), "{materials}");
}

/// The source tree contains the constants of the default scene, so that the library can be built and tested without an export.
#[test]
fn the_constants_in_the_source_are_those_of_the_default_scene() {
    let folder = empty_folder();
    let constants = run(folder.path(), ["constants", scene("steel_ball").to_str().unwrap()]).with_status(0);
    let source = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/unit/src/exported.rs")).unwrap();
    assert!(constants.out == source, "crates/unit/src/exported.rs is not what the exporter writes:\n{}", constants.out);
}

#[test]
fn an_fmu_is_written_to_the_requested_path_and_replaces_an_older_one() {
    let folder = empty_folder();
    fs::create_dir(folder.path().join("units")).unwrap();
    fs::write(folder.path().join("units/ball.fmu"), "an older unit").unwrap();
    let source = scene("steel_ball");
    let run = compile(folder.path(), ["export", source.to_str().unwrap(), "-o", "units/ball.fmu"]).with_status(0);
    assert!(run.out.starts_with("units/ball.fmu\n"), "{run:#?}");
    assert_eq!(contents(folder.path()), ["units"]);
    assert_eq!(contents(&folder.path().join("units")), ["ball.fmu"]);
    assert_same(&fs::read(folder.path().join("units/ball.fmu")).unwrap(), &exported(|command| command));
}

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let folder = empty_folder();
    fs::write(folder.path().join("file"), "").unwrap();
    fs::create_dir(folder.path().join("folder.fmu")).unwrap();
    // the superuser, as in containers, can write to a folder without write permission; these paths fail for everyone
    for path in ["missing/unit.fmu", "file/unit.fmu", "folder.fmu"] {
        let run = run(folder.path(), ["export", scene("steel_ball").to_str().unwrap(), "-o", path]).with_status(1);
        assert!(run.err.contains(&format!("brinell: {path}: ")) && run.out.is_empty(), "{run:#?}");
        assert_eq!(contents(folder.path()), ["file", "folder.fmu"], "files were left");
    }
}
