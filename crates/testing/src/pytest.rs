//! Tests in Python on existing FMUs.

use super::{prebuilt, python};
use crate::places::{program, root};
use std::collections::HashMap;
use std::path::PathBuf;
use std::process::Command;

/// Runs the files of these topics in tests/fmpy/ with `units`. They get their paths as JSON in the variable BRINELL_TEST_UNITS, by
/// the name of the scene, and the program in BRINELL_TEST_PROGRAM.
pub fn pytest(topics: &[&str], units: &HashMap<String, PathBuf>) {
    let folder = root().join("tests/fmpy");
    let output = prebuilt::finding_no_compiler(python::keeping_modules(&mut Command::new(python::python())))
        .args(["-m", "pytest", "-q", "--tb=short", "-p", "no:cacheprovider"])
        .args(topics.iter().map(|topic| format!("test_{topic}.py")))
        .current_dir(folder)
        .env("BRINELL_TEST_UNITS", serde_json::to_string(units).unwrap())
        .env("BRINELL_TEST_PROGRAM", program())
        .output()
        .expect("the virtual environment has an interpreter");
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{topics:?} failed:\n{text}");
    println!("{text}");
}
