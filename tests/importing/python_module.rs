//! The Python module in python/brinell: tests/python/. What takes more packages: engines.rs.

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

#[test]
fn contacts_and_the_program_in_python_do_what_they_say_and_refuse_what_the_program_refuses() {
    let folder = tempfile::tempdir().expect("a folder for temporary files");
    let all = hostile::write_all(&export(&scene("steel_ball")), folder.path());
    let said: HashMap<_, _> = all.iter().map(|(path, hostile)| (path, hostile.said)).collect();
    std::fs::write(folder.path().join("said.json"), serde_json::to_string(&said).unwrap()).unwrap();
    let topics = ["contact", "friction", "hostile", "program", "several_contacts", "states_and_threads"];
    let files = topics.map(|topic| format!("test_{topic}.py"));
    pytest::pytest(pytest::with_units(scenes()).env("BRINELL_TEST_HOSTILE", folder.path()), "python", &files);
}
