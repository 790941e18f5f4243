//! FMUs with friction in tools other than fmpy.
#![cfg(target_os = "linux")]

use crate::every_importer;
use crate::skips;
use crate::unit;
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
