//! The importer of tests/importers/src: the `fmi` crate.

use super::python;
use crate::places::root;
use std::env;
use std::path::Path;
use std::process::Command;

/// The output of `command`; the test fails with its error message if it fails.
pub fn output_of(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?} can't be started: {error}"));
    assert!(output.status.success(), "{command:?} failed:\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("the importers print ASCII")
}

/// The forces over `history` with the `fmi` crate, as bits. Its package is built in a separate folder.
pub fn forces_by_fmi_crate(unit: &Path, history: &Path) -> String {
    // the crate needs bindgen, which loads libclang; that from PyPI lacks the compiler's own headers
    let headers = output_of(Command::new("cc").arg("-print-file-name=include"));
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command
        .args(["run", "--quiet", "--release", "--locked", "--manifest-path"])
        .arg(root().join("tests/importers/Cargo.toml"))
        .arg("--")
        .args([unit, history])
        .env("CARGO_TARGET_DIR", python::target_folder().join("second-importer"))
        .env("LIBCLANG_PATH", python::site_packages_file("clang/native"))
        .env("BINDGEN_EXTRA_CLANG_ARGS", format!("-I{}", headers.trim()));
    output_of(&mut command)
}
