//! The Python module in python/brinell: one test for each file in tests/python/.

use crate::pytest;
use crate::unit::{export, scene, write_scene};
use brinell_testing::hostile;
use std::collections::HashMap;
use std::path::PathBuf;

const BODIES: &str =
    "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[impact]\nmass = 4e-3\nspeed = 1.0\n";
const OUTPUTS: &str = r#"["indentation", "residual_indentation", "elastic_energy", "dissipated_energy", "mean_force"]"#;

/// A scene of the usual bodies with these lines appended.
fn with(name: &str, more: &str) -> PathBuf {
    write_scene(name, &format!("name = \"{name}\"\n{BODIES}{more}\n"))
}

/// Every kind of FMU that the module treats differently.
fn scenes() -> Vec<PathBuf> {
    let two = "[[contact]]\nname = \"left\"\ninitial_gap = 0.0\n[[contact]]\nname = \"right\"\ninitial_gap = 1e-5\n";
    let known = format!("[fmu]\noutputs = {OUTPUTS}\n[coupling]\neffective_mass = 4e-3\n");
    let mut scenes: Vec<_> =
        ["steel_ball", "coupled", "stack", "mass_known", "oblique", "rough_contacts", "two_directions"]
            .map(scene)
            .into();
    scenes.extend([
        with("regime", "[fmu]\noutputs = [\"indentation\", \"regime\"]"),
        with("two", &format!("{known}{two}")),
        with(
            "feet",
            &format!("[fmu]\noutputs = {OUTPUTS}\n[coupling]\ninverse_masses = \"input\"\n[[contact]]\nname = \"foot\"\ncount = 3"),
        ),
        with("row", "[fmu]\noutputs = [\"indentation\", \"regime\"]\n[[contact]]\nname = \"bead\"\ncount = 3"),
        with(
            "each",
            &format!(
                "{known}[[contact]]\nname = \"bead\"\ncount = 20\n\
                 parameters_per_contact = [\"target.yield_strength\", \"effective_mass\", \"initial_gap\"]"
            ),
        ),
        with("nothing_settable", &known.replace("[coupling]", "parameters = []\n[coupling]")),
        with("without_indentation", "[fmu]\noutputs = []"),
        with(
            "damped",
            "[law]\nloading = \"hunt-crossley\"\nrestitution = 0.6\n[fmu]\noutputs = [\"indentation\", \"mean_force\"]",
        ),
    ]);
    scenes
}

/// Runs tests/python/`file` with the FMUs of [`scenes`].
fn pytest(file: &str) {
    pytest::pytest(&mut pytest::with_units(scenes()), "python", &[file]);
}

#[test]
fn a_contact_steps_tells_and_ends() {
    pytest("test_contact.py");
}

#[test]
fn a_hostile_fmu_is_refused_with_the_programs_reason() {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let all = hostile::write_all(&export(&scene("steel_ball")), folder.path());
    let said: HashMap<_, _> = all.iter().map(|(path, hostile)| (path, hostile.said)).collect();
    std::fs::write(folder.path().join("said.json"), serde_json::to_string(&said).unwrap()).unwrap();
    let mut python = pytest::with_units([]);
    pytest::pytest(python.env("BRINELL_TEST_HOSTILE", folder.path()), "python", &["test_hostile.py"]);
}

#[test]
fn a_contact_with_friction_takes_a_tangential_rate() {
    pytest("test_friction.py");
}

#[test]
fn several_contacts_are_arrays() {
    pytest("test_several_contacts.py");
}

#[test]
fn states_threads_and_many_at_once() {
    pytest("test_states_and_threads.py");
}

#[test]
fn the_program_answers_as_numbers_and_arrays() {
    pytest("test_program.py");
}
