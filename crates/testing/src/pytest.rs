//! Tests in Python, and what they are given in the environment.

use super::command::output;
use super::{prebuilt, python, unit};
use crate::places::{program, root};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// An interpreter with the module of the project, the program, which finds libraries and no compiler.
pub fn with_module(interpreter: &Path) -> Command {
    let mut command = Command::new(interpreter);
    prebuilt::finding_no_compiler(python::keeping_modules(&mut command))
        .env("PYTHONPATH", root().join("python"))
        .env("BRINELL", program());
    command
}

/// The same with the FMUs of these scenes: their paths as JSON in `BRINELL_TEST_UNITS`, by the name of the scene.
pub fn with_units(scenes: impl IntoIterator<Item = PathBuf>) -> Command {
    let name = |scene: &Path| scene.file_stem().expect("a scene file has a name").to_string_lossy().into_owned();
    let units: HashMap<_, _> = scenes.into_iter().map(|scene| (name(&scene), unit::export(&scene))).collect();
    let mut command = with_module(&python::python());
    command.env("BRINELL_TEST_UNITS", serde_json::to_string(&units).expect("paths are text"));
    command
}

/// Runs these files of tests/`folder` to their end; what they say.
#[track_caller]
pub fn pytest(interpreter: &mut Command, folder: &str, files: &[impl AsRef<str>]) -> String {
    let folder = root().join("tests").join(folder);
    interpreter.args(["-m", "pytest", "-q", "--tb=short", "-p", "no:cacheprovider"]).current_dir(folder);
    let said = output(interpreter.args(files.iter().map(AsRef::as_ref)));
    assert_eq!(said.status, Some(0), "\n{}{}", said.out, said.err);
    println!("{}", said.out);
    said.out
}
