//! An FMU in another importer: the `fmi` crate must read it and get the same bits as fmpy.

use brinell_testing::fmi_crate::{forces_by_fmi_crate, output_of};
use brinell_testing::places::temporary;
use brinell_testing::python;
use brinell_testing::unit;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Steps of the history.
const STEPS: u32 = 3000;

/// Loads, unloads and loads deeper, with rates and steps that change from line to line: a few visits to each branch of the law,
/// at times that no decimal number of steps gives.
fn history() -> PathBuf {
    let mut text = String::new();
    for index in 0..STEPS {
        let phase = f64::from(index) * 0.013;
        let rate = 0.3 * phase.sin() + 0.08;
        let step = 1e-7 * (1.0 + 0.5 * (1.7 * phase).cos());
        text += &format!("{rate:?} {step:?}\n");
    }
    let path = temporary().join("second_importer_history.txt");
    fs::write(&path, text).expect("the target folder can be written to");
    path
}

/// The forces of each of these FMUs.
fn forces_by_fmpy(units: &[PathBuf], history: &Path) -> String {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fmpy/force_bits.py");
    let mut command = Command::new(python::python());
    output_of(python::keeping_modules(command.arg(script).arg(history).args(units)))
}

#[test]
fn the_fmi_crate_and_fmpy_get_the_same_bits() {
    let history = history();
    let units: Vec<_> = unit::scenes().iter().map(|scene| unit::export(scene)).collect();
    let by_fmpy = forces_by_fmpy(&units, &history);
    let by_fmpy: Vec<_> = by_fmpy.lines().collect();
    assert_eq!(by_fmpy.len(), units.len() * STEPS as usize);
    for (unit, by_fmpy) in units.iter().zip(by_fmpy.chunks(STEPS as usize)) {
        let by_fmi_crate = forces_by_fmi_crate(unit, &history);
        let by_fmi_crate: Vec<_> = by_fmi_crate.lines().collect();
        assert_eq!(by_fmi_crate.len(), STEPS as usize);
        let different = by_fmi_crate.iter().zip(by_fmpy).position(|(one, other)| one != other);
        if let Some(step) = different {
            panic!("{}: step {step}: {} and {}", unit.display(), by_fmi_crate[step], by_fmpy[step]);
        }
        // two importers that both read zeros would also agree
        let pressed = by_fmi_crate.iter().filter(|bits| **bits != "0000000000000000").count();
        assert!(pressed > 1000, "{}: in contact for {pressed} steps only", unit.display());
    }
}
