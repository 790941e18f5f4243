//! The importer of tests/importers/src: the `fmi` crate.

use super::python;
use crate::places::root;
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// The output of `command`; the test fails with its error message if it fails.
pub fn output_of(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?} can't be started: {error}"));
    assert!(output.status.success(), "{command:?} failed:\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("the importers print ASCII")
}

/// The program, built in a folder of its own.
static PROGRAM: LazyLock<PathBuf> = LazyLock::new(|| {
    let target = python::target_folder().join("second-importer");
    // the crate needs bindgen, which loads libclang; that from PyPI lacks the compiler's own headers
    let headers = output_of(Command::new("cc").arg("-print-file-name=include"));
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command
        .args(["build", "--quiet", "--release", "--locked", "--manifest-path"])
        .arg(root().join("tests/importers/Cargo.toml"))
        .env("CARGO_TARGET_DIR", &target)
        .env_remove("CARGO_BUILD_TARGET")
        .env("LIBCLANG_PATH", python::site_packages_file("clang/native"))
        .env("BINDGEN_EXTRA_CLANG_ARGS", format!("-I{}", headers.trim()));
    output_of(&mut command);
    target.join("release/second-importer").with_extension(env::consts::EXE_EXTENSION)
});

/// The forces over `history` with the `fmi` crate, as bits.
pub fn forces_by_fmi_crate(unit: &Path, history: &Path) -> String {
    output_of(Command::new(&*PROGRAM).args([unit, history]))
}
