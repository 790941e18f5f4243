//! FMUs with several contacts: the summary of an export, and their check.

use crate::command::{empty_folder, run};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// The beginning of a scene, and its impact.
const STEEL: &str = "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";
const IMPACT: &str = "[impact]\nmass = 4e-3\nspeed = 1.0\n";

/// The summary of the export of a scene, and the result of its check.
#[track_caller]
fn exported(scene: &Path) -> (Value, Value) {
    let folder = empty_folder();
    let scene = scene.to_str().unwrap();
    let export = run(folder.path(), ["export", scene, "-o", "unit.fmu", "--json"]).with_status(0).json();
    let check = run(folder.path(), ["check", "unit.fmu", "--json"]).with_status(0).json();
    (export, check)
}

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name).with_extension("toml")
}

#[test]
fn every_group_is_listed_with_its_own_values() {
    let (export, _) = exported(&scene("many_contacts"));
    let edge = json!({ "impactor.radius": 3e-3, "impactor.youngs_modulus": 4e11, "impactor.poissons_ratio": 0.29 });
    assert_eq!(
        export["contacts"],
        json!([
            { "name": "bead", "count": 1000, "own": {}, "parameters_per_contact": [], "passivity_guard": null },
            { "name": "edge", "count": null, "own": edge, "parameters_per_contact": [], "passivity_guard": null },
        ])
    );
    let variables = ["bead[1..1000].indentation_rate", "edge.indentation_rate", "bead[1..1000].force", "edge.force"];
    assert_eq!(export["variables"], json!([&variables[..], &["target.yield_strength"]].concat()));
    assert_eq!(export["variable_count"], 2 * 1001 + 1);
    let constants = export["constants"].as_array().unwrap();
    for name in ["impactor.radius", "edge.impactor.radius", "initial_gap"] {
        assert!(constants.contains(&json!(name)), "no {name} in {constants:?}");
    }
}

#[test]
fn an_fmu_with_many_contacts_is_summarized_in_few_lines() {
    let folder = empty_folder();
    let told = run(folder.path(), ["export", scene("many_contacts").to_str().unwrap()]).with_status(0).out;
    assert!(told.lines().count() < 30 && told.len() < 3000, "{told}");
    for part in ["bead[1..1000]", "1000  as the scene", "impactor.radius = 0.003", "2003: "] {
        assert!(told.contains(part), "nothing of {part:?} in {told}");
    }
}

#[test]
fn the_impact_meets_the_first_contact_of_every_group() {
    let (export, check) = exported(&scene("many_contacts"));
    assert_eq!(check["passed"], true, "{check}");
    assert_eq!(check["variables"], export["variable_count"]);
    assert!(check.get("rows").is_none(), "the rows belong to the contacts: {check}");
    let contacts = check["contacts"].as_array().unwrap();
    let names: Vec<_> =
        contacts.iter().map(|contact| (contact["contact"].as_str().unwrap(), &contact["count"])).collect();
    assert_eq!(names, [("bead[1]", &json!(1000)), ("edge", &Value::Null)]);
    assert!(contacts.iter().all(|contact| contact["rows"].as_array().unwrap().len() == 5), "{check}");
}

/// A gap that cannot be set is crossed first; a contact that starts indented is not moved.
#[test]
fn contacts_with_constant_gaps_are_checked_too() {
    let folder = empty_folder();
    let scene = format!(
        "{STEEL}[fmu]\nparameters = []\n\
         [[contact]]\nname = \"near\"\n[[contact]]\nname = \"far\"\ninitial_gap = 1e-3\n\
         [[contact]]\nname = \"pressed\"\ninitial_gap = -1e-6\n{IMPACT}"
    );
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let (_, check) = exported(&folder.path().join("scene.toml"));
    assert_eq!(check["passed"], true, "{check}");
    let rows = |index: usize| check["contacts"][index]["rows"].as_array().unwrap().len();
    assert_eq!([rows(0), rows(1), rows(2)], [5, 5, 0], "{check}");
    assert!(check["contacts"][2]["skipped"].as_str().unwrap().contains("pressed in"), "{check}");
}

/// The guard acts on the bodies of each contact; the text about the FMU covers all of them.
#[test]
fn a_guarded_fmu_states_where_the_guard_acts_on_each_contact() {
    let folder = empty_folder();
    let scene = format!(
        "{STEEL}[law]\nloading = \"ghaednia\"\nunloading = \"contact-radius\"\n\
         passivity_guard = true\n[[contact]]\nname = \"soft\"\n[[contact]]\nname = \"hard\"\n\
         target = {{ yield_strength = 3e9 }}\n{IMPACT}"
    );
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let (export, check) = exported(&folder.path().join("scene.toml"));
    assert_eq!(check["passed"], true, "{check}");
    let ranges =
        |value: &Value| -> Vec<(f64, f64)> { serde_json::from_value(value["passivity_guard"].clone()).unwrap() };
    let (all, own) = (ranges(&export), [&export["contacts"][0], &export["contacts"][1]].map(ranges));
    assert_ne!(own[0], own[1], "the law depends on the bodies");
    for (from, to) in own.concat() {
        assert!(all.iter().any(|range| range.0 <= from && to <= range.1), "{from} to {to} is not in {all:?}");
    }
    assert!(all.is_sorted() && all.windows(2).all(|pair| pair[0].1 < pair[1].0), "{all:?}");
}

/// No scene specifies which bodies two contacts share.
#[test]
fn contacts_whose_bodies_the_fmu_moves_come_with_a_note_on_shared_bodies() {
    let folder = tempfile::tempdir().unwrap();
    let bodies = "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";
    let coupling = "[coupling]\neffective_mass = 4e-3\n";
    let contacts = "[[contact]]\nname = \"left\"\n[[contact]]\nname = \"right\"\n";
    for (name, text, told) in [
        ("chain", format!("name = \"chain\"\n{bodies}{coupling}{contacts}"), true),
        ("ball", format!("name = \"ball\"\n{bodies}{coupling}"), false),
        ("walls", format!("name = \"walls\"\n{bodies}{contacts}"), false),
    ] {
        std::fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
        let arguments = ["export", &format!("{name}.toml"), "-o", &format!("{name}.fmu")];
        let printed = run(folder.path(), arguments).with_status(0).out;
        let page = run(folder.path(), [&arguments[..], &["--json"]].concat()).with_status(0).json();
        assert_eq!(printed.contains("a body that two contacts share"), told, "{printed}");
        assert_eq!(page["shared_bodies"].is_string(), told, "{page}");
    }
}

#[test]
fn values_of_each_contact_are_listed_and_checked() {
    let folder = empty_folder();
    let scene = format!(
        "{STEEL}[fmu]\nparameters = []\n[coupling]\neffective_mass = 4e-3\n[[contact]]\nname = \"bead\"\ncount = 12\n\
         parameters_per_contact = [\"effective_mass\", \"initial_gap\"]\n\
         [[contact]]\nname = \"light\"\neffective_mass = 1e-3\n{IMPACT}"
    );
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let (export, check) = exported(&folder.path().join("scene.toml"));
    assert_eq!(export["contacts"][0]["parameters_per_contact"], json!(["effective_mass", "initial_gap"]));
    assert_eq!(export["contacts"][0]["own"], json!({ "effective_mass": 4e-3, "initial_gap": 0.0 }));
    let variables = export["variables"].as_array().unwrap();
    for name in ["bead[1..12].effective_mass", "bead[1..12].initial_gap"] {
        assert!(variables.contains(&json!(name)), "no {name} in {variables:?}");
    }
    assert_eq!(export["variable_count"], 3 * 13 + 2 * 12);
    // the impact on the light contact is with its own mass
    assert_eq!(check["passed"], true, "{check}");
    let forces = [0, 1].map(|index| check["contacts"][index]["rows"][0]["predicted"].as_f64().unwrap());
    assert!(forces[1] < 0.7 * forces[0], "{check}");
    let told = run(folder.path(), ["export", "scene.toml"]).with_status(0).out;
    let words = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("effective_mass = 0.004 for each") && told.lines().count() < 45, "{told}");
}
