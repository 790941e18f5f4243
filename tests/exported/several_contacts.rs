//! FMUs with several contacts: their summary and check, and messages that name a contact. That each contact does what it
//! does alone: `any_scene.rs`.

use crate::command::{empty_folder, run};
use crate::loaded::{ERROR, OK, Unit};
use crate::unit::{self, write_scene};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

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

/// The same of the scene `text`.
#[track_caller]
fn exported_text(text: &str) -> (Value, Value) {
    exported(&write_scene("unit", text))
}

#[test]
fn every_group_is_listed_with_its_own_values() {
    let (export, check) = exported(&unit::scene("many_contacts"));
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
    let folder = empty_folder();
    let told = run(folder.path(), ["export", unit::scene("many_contacts").to_str().unwrap()]).with_status(0).out;
    assert!(told.lines().count() < 30 && told.len() < 3000, "{told}");
    for part in ["bead[1..1000]", "1000  as the scene", "impactor.radius = 0.003", "2003: "] {
        assert!(told.contains(part), "nothing of {part:?} in {told}");
    }
    // the impact meets the first contact of every group
    assert_eq!((&check["passed"], &check["variables"]), (&json!(true), &export["variable_count"]), "{check}");
    assert!(check.get("rows").is_none(), "the rows belong to the contacts: {check}");
    let contacts = check["contacts"].as_array().unwrap();
    let names = contacts.iter().map(|contact| (contact["contact"].as_str().unwrap(), &contact["count"]));
    assert_eq!(names.collect::<Vec<_>>(), [("bead[1]", &json!(1000)), ("edge", &Value::Null)]);
    assert!(contacts.iter().all(|contact| contact["rows"].as_array().unwrap().len() == 5), "{check}");
}

/// A gap that cannot be set is crossed first; a contact that starts indented is not moved.
#[test]
fn contacts_with_constant_gaps_are_checked_too() {
    let scene = format!(
        "{STEEL}[fmu]\nparameters = []\n\
         [[contact]]\nname = \"near\"\n[[contact]]\nname = \"far\"\ninitial_gap = 1e-3\n\
         [[contact]]\nname = \"pressed\"\ninitial_gap = -1e-6\n{IMPACT}"
    );
    let (_, check) = exported_text(&scene);
    assert_eq!(check["passed"], true, "{check}");
    let rows = |index: usize| check["contacts"][index]["rows"].as_array().unwrap().len();
    assert_eq!([rows(0), rows(1), rows(2)], [5, 5, 0], "{check}");
    assert!(check["contacts"][2]["skipped"].as_str().unwrap().contains("pressed in"), "{check}");
}

/// No scene specifies which bodies two contacts share.
#[test]
fn contacts_whose_bodies_the_fmu_moves_come_with_a_note_on_shared_bodies() {
    let folder = empty_folder();
    let bodies = "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";
    let coupling = "[coupling]\neffective_mass = 4e-3\n";
    let contacts = "[[contact]]\nname = \"left\"\n[[contact]]\nname = \"right\"\n";
    for (name, text, told) in [
        ("chain", format!("name = \"chain\"\n{bodies}{coupling}{contacts}"), true),
        ("ball", format!("name = \"ball\"\n{bodies}{coupling}"), false),
        ("walls", format!("name = \"walls\"\n{bodies}{contacts}"), false),
    ] {
        fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
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
    fs::write(folder.path().join("scene.toml"), &scene).unwrap();
    let (export, check) = exported_text(&scene);
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

/// Step size of the simulations [s].
const STEP: f64 = 1e-6;

/// An FMU with these further lines.
fn load(name: &str, more: &str) -> Unit {
    let outputs = "[fmu]\noutputs = [\"indentation\", \"dissipated_energy\", \"mean_force\"]\n";
    Unit::load(&write_scene(name, &format!("{}{outputs}{more}", STEEL.replace("unit", name))))
}

#[test]
fn a_refused_step_names_the_contact_and_moves_none() {
    // a fitted law, which ends before the deepest indentation if the target is nearly as strong as stiff
    let strong = "target = { youngs_modulus = 91e9, poissons_ratio = 0.3, yield_strength = 1e11 }\n";
    let groups = format!("[[contact]]\nname = \"left\"\n[[contact]]\nname = \"row\"\ncount = 3\n{strong}");
    let unit = load("refusing", &format!("[law]\nloading = \"jackson-green\"\nunloading = \"jackson\"\n{groups}"));
    let instance = unit.ready();
    assert_eq!((instance.set(&[0, 1, 2, 3], &[1.3, 2.0, 0.7, 0.4]), instance.step(0.0, STEP)), (OK, OK));
    let before = instance.bits();
    assert_eq!(instance.set(&[0, 1, 2, 3], &[1.0, -1.0, 1e3, 2.0]), OK);
    assert_eq!(instance.step(STEP, 1.0), ERROR);
    let message = instance.message();
    assert!(message.contains("row[2]: the indentation would become"), "{message}");
    // but for the rates, which come first
    assert_eq!(instance.bits()[4..], before[4..]);
}

/// Contacts with and without their own parameters in several tables.
fn mixed() -> Unit {
    let row = "[[contact]]\nname = \"row\"\ncount = 3\nparameters_per_contact = [\"target.yield_strength\", \"effective_mass\", \"initial_gap\"]\n";
    let others = "[[contact]]\nname = \"left\"\neffective_mass = 2e-3\n[[contact]]\nname = \"last\"\ncount = 1\n\
                  parameters_per_contact = [\"target.yield_strength\"]\n[[contact]]\nname = \"right\"\nparameters_per_contact = [\"target.yield_strength\"]\n";
    load(
        "mixed",
        &format!("[coupling]\neffective_mass = 4e-3\n[[contact]]\nname = \"plain\"\ncount = 2\n{row}{others}"),
    )
}

#[test]
fn a_value_that_is_refused_names_its_contact() {
    let unit = mixed();
    let mut instance = unit.instantiate();
    for (name, value, words) in [
        ("row[2].target.yield_strength", -1.0, "row[2]: target.yield_strength = -1"),
        ("row[3].effective_mass", 0.0, "row[3]: effective_mass = 0"),
        ("row[1].initial_gap", f64::NAN, "row[1]: initial_gap = NaN"),
        ("last[1].target.yield_strength", 1e99, "last[1].target.yield_strength = "),
        ("left.effective_mass", -2.0, "left.effective_mass = -2"),
        ("right.target.yield_strength", 0.0, "right.target.yield_strength = 0"),
    ] {
        let before = instance.real_of(name);
        assert_eq!(instance.set(&[before], &[value]), ERROR, "{name}");
        let message = instance.message();
        assert!(message.contains(words) && message.contains("allowed is"), "{message}");
        instance.reset();
    }
    // between steps only the masses can be set, one for each contact
    let mut instance = unit.ready();
    for name in ["effective_mass", "row[1].effective_mass", "row[3].effective_mass", "left.effective_mass"] {
        instance.set_one(name, 7e-3);
        assert_eq!(instance.real(name), 7e-3);
    }
    assert_eq!(instance.real("row[2].effective_mass"), 4e-3);
    assert_eq!(instance.set(&[instance.real_of("row[3].initial_gap")], &[0.0]), ERROR);
    let message = instance.message();
    assert!(
        message.contains("row[3]: initial_gap can't be set") || message.contains("row[3]: the parameter"),
        "{message}"
    );
}

#[test]
fn bodies_that_do_not_fit_name_their_contact() {
    let own = "parameters_per_contact = [\"impactor.radius\"]";
    let socket = "[[contact]]\nname = \"row\"\ncount = 4\ntarget = { radius = -6e-3 }\n";
    let unit = load("socket", &format!("{socket}{own}\n"));
    let mut instance = unit.instantiate();
    instance.set_one("row[3].impactor.radius", 7e-3);
    instance.enter_initialization();
    assert_eq!(instance.exit(), ERROR);
    let message = instance.message();
    assert!(message.contains("row[3]: impactor.radius = 0.007 m does not fit target.radius = -0.006 m"), "{message}");
}
