//! The Python module in python/brinell: one test for each file in tests/python/.

use crate::prebuilt;
use crate::python;
use crate::unit::{export, scene, write_scene};
use brinell_testing::hostile;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

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
    vec![
        scene("steel_ball"),
        scene("coupled"),
        scene("stack"),
        scene("mass_known"),
        scene("oblique"),
        scene("rough_contacts"),
        scene("two_directions"),
        with("regime", "[fmu]\noutputs = [\"indentation\", \"regime\"]"),
        with("two", &format!("[fmu]\noutputs = {OUTPUTS}\n[coupling]\neffective_mass = 4e-3\n{two}")),
        with(
            "feet",
            &format!(
                "[fmu]\noutputs = {OUTPUTS}\n[coupling]\ninverse_masses = \"input\"\n[[contact]]\nname = \"foot\"\ncount = 3"
            ),
        ),
        with("row", "[fmu]\noutputs = [\"indentation\", \"regime\"]\n[[contact]]\nname = \"bead\"\ncount = 3"),
        with(
            "each",
            &format!(
                "[fmu]\noutputs = {OUTPUTS}\n[coupling]\neffective_mass = 4e-3\n[[contact]]\nname = \"bead\"\ncount = 20\n\
                 parameters_per_contact = [\"target.yield_strength\", \"effective_mass\", \"initial_gap\"]"
            ),
        ),
        with(
            "nothing_settable",
            &format!("[fmu]\noutputs = {OUTPUTS}\nparameters = []\n[coupling]\neffective_mass = 4e-3"),
        ),
        with("without_indentation", "[fmu]\noutputs = []"),
        with(
            "damped",
            "[law]\nloading = \"hunt-crossley\"\nrestitution = 0.6\n[fmu]\noutputs = [\"indentation\", \"mean_force\"]",
        ),
    ]
}

/// The test of hostile FMUs.
const HOSTILE: &str = "test_hostile.py";

/// Runs tests/python/`file` with the FMUs of [`scenes`].
fn pytest(file: &str) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = root.join("tests/python");
    assert!(folder.join(file).is_file(), "there is no tests/python/{file}");
    let units: HashMap<_, _> = scenes()
        .iter()
        .map(|scene| (scene.file_stem().unwrap().to_string_lossy().into_owned(), export(scene)))
        .collect();
    // only the test of hostile FMUs reads them
    let hostile = tempfile::tempdir().expect("a folder for temporary files");
    if file == HOSTILE {
        let all = hostile::write_all(&export(&scene("steel_ball")), hostile.path());
        let said: HashMap<_, _> = all.iter().map(|(path, hostile)| (path, hostile.said)).collect();
        std::fs::write(hostile.path().join("said.json"), serde_json::to_string(&said).unwrap()).unwrap();
    }
    let output = prebuilt::finding_no_compiler(python::keeping_modules(&mut Command::new(python::python())))
        .args(["-m", "pytest", "-q", "--tb=short", "-p", "no:cacheprovider", file])
        .current_dir(folder)
        .env("PYTHONPATH", root.join("python"))
        .env("BRINELL", env!("CARGO_BIN_EXE_brinell"))
        .env("BRINELL_TEST_UNITS", serde_json::to_string(&units).unwrap())
        .env("BRINELL_TEST_SCENES", root.join("scenes"))
        .env("BRINELL_TEST_HOSTILE", hostile.path())
        .output()
        .expect("the virtual environment has an interpreter");
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{file} failed:\n{text}");
    println!("{text}");
}

#[test]
fn a_contact_steps_tells_and_ends() {
    pytest("test_contact.py");
}

#[test]
fn a_hostile_fmu_is_refused_with_the_programs_reason() {
    pytest(HOSTILE);
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
