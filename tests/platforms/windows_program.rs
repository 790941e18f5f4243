//! The program for Windows, run with Wine: its output and its exports equal those of this system, byte by byte.
//!
//! The program comes from the archive made by `packaging/release.py windows-x86_64`. Wine is the program in the variable WINE,
//! otherwise Debian's, unpacked in the target folder as for the tests of other systems.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

use crate::command;
use crate::programs::Program;
use crate::python;
use crate::systems;
use brinell_testing::places::temporary;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// The program. Wine below version 9 has no bcryptprimitives.dll, and gets a replacement.
static WINDOWS: LazyLock<Program> = LazyLock::new(|| {
    let program = Program::unpacked("windows-x86_64", ("zip", ".exe"), wine);
    if program.there(Path::new("."), ["--version"]).status != Some(0) {
        let compiler = python::target_folder().join("packaging/bin/x86_64-w64-mingw32-gcc");
        let compiler = if compiler.is_file() { compiler } else { "x86_64-w64-mingw32-gcc".into() };
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c/bcryptprimitives.c");
        let mut compile = Command::new(compiler);
        compile.args(["-shared", "-O1"]).arg(source).arg("-ladvapi32");
        compile.arg("-o").arg(program.folder.join("bin/bcryptprimitives.dll"));
        command::output(&mut compile).with_status(0);
    }
    program
});

/// The program that starts Wine.
static WINE: LazyLock<PathBuf> = LazyLock::new(|| match std::env::var_os("WINE") {
    Some(named) => named.into(),
    None => systems::wine().unwrap_or_else(|why| panic!("there is no Wine: {why}")).0,
});

/// A call of the program at `path`.
fn wine(path: &Path) -> Command {
    let mut command = Command::new(&*WINE);
    command.arg(path);
    command.env("WINEPREFIX", temporary().join("wine")).env("WINEDEBUG", "-all");
    command.env("WINEDLLOVERRIDES", "mscoree,mshtml=").env_remove("DISPLAY");
    command
}

#[test]
#[ignore = "takes Wine and the archive for Windows: cargo test --release --test platforms windows_program -- --ignored"]
fn it_knows_its_platform() {
    WINDOWS.knows_its_platform("win64");
}

#[test]
#[ignore = "takes Wine and the archive for Windows"]
fn it_says_the_same_of_every_scene() {
    WINDOWS.says_the_same_of_every_scene();
}

#[test]
#[ignore = "takes Wine and the archive for Windows"]
fn what_it_writes_is_the_same() {
    WINDOWS.writes_the_same();
}

#[test]
#[ignore = "takes Wine and the archive for Windows"]
fn it_exports_the_same_unit_and_checks_it() {
    WINDOWS.exports_the_same_unit_and_checks_it("x86_64-pc-windows-msvc");
}
