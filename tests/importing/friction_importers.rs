//! FMUs with friction in a C program, and in tools other than fmpy.
#![cfg(target_os = "linux")]

use crate::every_importer;
use crate::skips;
use crate::unit;
use brinell_testing::driver::{assert_good, attribute, headers};
use brinell_testing::loaded::{OK, Unit};
use brinell_testing::places::temporary;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const STEP: f64 = 1e-6;

/// Rates of each step [m/s]: into the block, to and fro, and out again; the tangential motion turns.
fn history() -> Vec<[f64; 3]> {
    let rates = |index: u32| {
        let phase = f64::from(index);
        [0.2 * (0.21 * phase).sin() + 0.01, 0.3 * (0.13 * phase).cos(), 0.25 * (0.17 * phase).sin()]
    };
    (0..200).map(rates).collect()
}

/// The C program with the variables of this scene whose names have these endings.
fn run_in_c(scene: &str, components: &[&str]) {
    let program = temporary().join("friction");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c/friction.c");
    let mut compiler = Command::new("cc");
    compiler.args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror", "-I"]).arg(headers()).arg(source);
    let output = compiler.arg("-o").arg(&program).args(["-ldl", "-lm"]).output().expect("there is a C compiler");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let library = unit::library(&unit::export(&unit::scene(scene)));
    let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
    let reference = |name: &str| {
        let mut elements = description.split("<ScalarVariable").skip(1);
        let element = elements.find(|element| attribute(element, "name") == Some(name));
        let element = element.unwrap_or_else(|| panic!("the unit has no {name}"));
        attribute(element, "valueReference").expect("every variable has a reference").to_string()
    };
    let mut arguments = vec![attribute(&description, "guid").expect("a unit has a GUID").to_string()];
    arguments.extend(["indentation_rate", "force", "friction.coefficient"].map(reference));
    for component in components {
        arguments.extend(["tangential_rate", "tangential_force"].map(|name| reference(&format!("{name}{component}"))));
    }
    let output = Command::new(&program).arg(&library).args(arguments).output().expect("the program was compiled");
    assert!(assert_good(&output) >= 9, "{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
fn a_c_program_steps_saves_and_restores_units_with_friction() {
    run_in_c("oblique", &[""]);
    run_in_c("two_directions", &["[1]", "[2]"]);
}

/// The forces after each step through the C interface [N].
fn reference() -> Vec<[f64; 3]> {
    let unit = Unit::load(&unit::scene("two_directions"));
    let mut instance = unit.ready();
    let forces = history().into_iter().enumerate().map(|(index, rates)| {
        for (name, rate) in ["indentation_rate", "tangential_rate[1]", "tangential_rate[2]"].into_iter().zip(rates) {
            instance.set_one(name, rate);
        }
        assert_eq!(instance.step(index as f64 * STEP, STEP), OK);
        ["force", "tangential_force[1]", "tangential_force[2]"].map(|name| instance.real(name))
    });
    forces.collect()
}

#[test]
fn other_importers_get_the_forces_of_the_c_interface() {
    let folder = temporary().join("friction_importers");
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    let lines = history().into_iter().map(|[normal, one, two]| format!("{normal:?} {one:?} {two:?}\n"));
    fs::write(folder.join("history.txt"), lines.collect::<String>()).expect("the target folder can be written to");
    let importers = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/importers");
    let expected = reference();
    assert!(expected.iter().any(|[force, ..]| *force == 0.0) && expected.iter().any(|[_, one, _]| *one < 0.0));
    let most = expected.iter().map(|[force, ..]| *force).fold(0.0, f64::max);
    for tool in ["libcosim", "ecos"] {
        let python = match every_importer::interpreter_of(tool) {
            Ok(python) => python,
            Err(reason) => {
                skips::skipped(&format!("friction in {tool}"), &reason);
                continue;
            }
        };
        let result: PathBuf = folder.join(tool).with_extension("json");
        let _ = fs::remove_file(&result);
        let mut process = Command::new(&python);
        process.arg(importers.join("friction.py")).arg(tool).arg(unit::export(&unit::scene("two_directions")));
        let output = process.arg(folder.join("history.txt")).arg(&result).output().expect("an interpreter");
        assert!(output.status.success(), "{tool}: {}", String::from_utf8_lossy(&output.stderr));
        let found: Vec<[f64; 3]> = serde_json::from_slice(&fs::read(&result).expect("a result")).expect("forces");
        assert_eq!(found.len(), expected.len(), "{tool}");
        for (step, (found, expected)) in found.into_iter().zip(&expected).enumerate() {
            for (part, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                // the clock of a tool may count nanoseconds, and one may decide which of the springs are merged
                let allowed = if part == 0 { 1e-9 * (1.0 + expected.abs()) } else { 1e-4 * most };
                assert!((found - expected).abs() <= allowed, "{tool}, step {step}: {found:e} {expected:e}");
            }
        }
    }
}
