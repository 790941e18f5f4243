//! What a run of the tests skips. tests/z_skipped.rs prints it at the end of the run.

use crate::places::{temporary, test_name};
use std::fs;
use std::io::{Write as _, stderr};
use std::path::PathBuf;
use std::time::Duration;

/// The folder with a file for each program of tests that skips something.
fn folder() -> PathBuf {
    temporary().join("skipped")
}

/// Records that `what` could not be tested, and the reason, and prints it past the harness, which hides the output of a test that
/// passes.
pub fn skipped(what: &str, why: &str) {
    let line = format!("SKIPPED: {what}: {why}\n");
    let _ = stderr().write_all(line.as_bytes());
    fs::create_dir_all(folder()).expect("the target folder can be written to");
    let file = folder().join(test_name());
    let file = fs::OpenOptions::new().create(true).append(true).open(file);
    // one write for each line: tests are threads, and they may write at the same time
    file.and_then(|mut file| file.write_all(line.as_bytes())).expect("the target folder can be written to");
}

/// An empty file as old as the run.
const BEGUN: &str = "begun";

/// Forgets what earlier runs have skipped, and begins to count the time.
pub fn begin() {
    let _ = fs::remove_dir_all(folder());
    fs::create_dir_all(folder()).expect("the target folder can be written to");
    fs::write(folder().join(BEGUN), "").expect("the target folder can be written to");
}

/// Time since the run has begun; `None` if it was for one program.
pub fn elapsed() -> Option<Duration> {
    fs::metadata(folder().join(BEGUN)).ok()?.modified().ok()?.elapsed().ok()
}

/// All lines so far, each once.
pub fn all() -> Vec<String> {
    let files = fs::read_dir(folder()).into_iter().flatten().flatten();
    let texts = files.filter_map(|file| fs::read_to_string(file.path()).ok());
    let mut lines: Vec<String> = texts.flat_map(|text| text.lines().map(String::from).collect::<Vec<_>>()).collect();
    lines.sort();
    lines.dedup();
    lines
}
