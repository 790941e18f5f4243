//! The compilers for all platforms, if available, and the test programs that cargo builds.

use crate::command::{brinell, output};
use crate::places::{root, temporary};
use crate::python;
use serde_json::Value;
use std::collections::BTreeMap;
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};

/// The folder of the toolchain: that of `BRINELL_TOOLCHAIN`, or one below `target`. With
/// `BRINELL_PLATFORMS=all`, it is downloaded if missing, about 100 MB. `None`, with a message that no test runner hides, if
/// there is none.
pub fn toolchain() -> Option<PathBuf> {
    let folder = folder_of("BRINELL_TOOLCHAIN", "toolchain");
    fetch_if_wanted(&folder, &[]);
    if folder.join("packages.json").is_file() {
        return Some(folder);
    }
    let why = format!("there is no toolchain in {}; BRINELL_PLATFORMS=all fetches it (100 MB)", folder.display());
    super::skips::skipped("libraries for other platforms", &why);
    None
}

/// The same, if it makes C source too.
pub fn toolchain_for_c() -> Option<PathBuf> {
    let folder = toolchain()?;
    if folder.join("usr/bin/wasm2c").is_file() {
        return Some(folder);
    }
    super::skips::skipped("C source", "the toolchain has no wasm2c; BRINELL_PLATFORMS=all fetches a new one (100 MB)");
    None
}

/// The folder of the prebuilt libraries for these platforms, made once in a process; `None` without a toolchain to make them.
pub fn store(platforms: &'static str) -> Option<PathBuf> {
    static MADE: Mutex<BTreeMap<&str, PathBuf>> = Mutex::new(BTreeMap::new());
    let toolchain = if platforms.contains("c-code") { toolchain_for_c()? } else { toolchain()? };
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let store = made.entry(platforms).or_insert_with(|| {
        let place = temporary().join("prebuilt").join(platforms);
        let mut command = brinell(temporary());
        command.env("BRINELL_TOOLCHAIN", toolchain).args(["prebuild", "--platforms", platforms, "-o"]).arg(&place);
        output(&mut command).with_status(0);
        place
    });
    Some(store.clone())
}

/// The folder that the environment `variable` names, or `name` below `target`.
fn folder_of(variable: &str, name: &str) -> PathBuf {
    let named = env::var_os(variable).filter(|value| !value.is_empty()).map(PathBuf::from);
    named.unwrap_or_else(|| temporary().join(name))
}

/// Downloads what is missing of the toolchain in `folder`, if `BRINELL_PLATFORMS` is `all`.
fn fetch_if_wanted(folder: &Path, options: &[&str]) {
    if env::var_os("BRINELL_PLATFORMS").is_some_and(|value| value == "all") {
        let script = root().join("packaging/toolchain.py");
        let status = Command::new(python::INSTALLED).arg(script).arg(folder).args(options).status();
        assert!(status.expect("the tests need Python").success(), "the toolchain can't be fetched");
    }
}

/// `cargo COMMAND` for whole programs of another `target`: with the installed Rust if it has its standard library, otherwise with the
/// toolchain in the folder of `BRINELL_STD_TOOLCHAIN`, or one below `target`, which compiles that library.
///
/// # Errors
/// What is missing.
pub fn cargo_for(target: &str, command: &str) -> Result<Command, String> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(root()).args([command, "--release", "--locked", "--target", target]);
    // flags for programs of this machine
    cargo.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    if has_standard_library(target) {
        return Ok(cargo);
    }
    let folder = folder_of("BRINELL_STD_TOOLCHAIN", "toolchain-std");
    fetch_if_wanted(&folder, &["--std", "--targets"]);
    if !folder.join("usr/lib/rustlib/src").is_dir() {
        let folder = folder.display();
        return Err(format!(
            "the installed Rust has no standard library for {target} (`rustup target add {target}`), and there is no toolchain in \
             {folder}; BRINELL_PLATFORMS=all fetches it (140 MB)"
        ));
    }
    // cargo takes its unstable option of any release then
    cargo.env("RUSTC", folder.join("usr/bin/rustc")).env("RUSTC_BOOTSTRAP", "1");
    cargo.args(["-Z", "build-std=std,panic_unwind,test,proc_macro"]);
    Ok(cargo)
}

/// Whether the installed Rust has the standard library of `target`.
fn has_standard_library(target: &str) -> bool {
    let rustc = Path::new(env!("CARGO")).with_file_name("rustc");
    let output = Command::new(rustc).args(["--print", "target-libdir", "--target", target]).output();
    let Ok(output) = output else { return false };
    let folder = String::from_utf8_lossy(&output.stdout).trim().to_string();
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    files.into_iter().any(|file| file.file_name().to_string_lossy().starts_with("libstd-"))
}

/// A test program.
pub struct TestProgram {
    /// The name of its file in `tests/`, or of the crate.
    pub name: String,
    pub file: PathBuf,
    /// The folder of its package, in which cargo runs it.
    pub package: PathBuf,
}

/// The test programs that `cargo` builds, a call of `cargo test`, which isn't to run them.
pub fn test_programs(cargo: &mut Command) -> Vec<TestProgram> {
    cargo.args(["--no-run", "--message-format=json-render-diagnostics"]).stderr(Stdio::inherit());
    let output = cargo.output().expect("cargo runs this test");
    assert!(output.status.success(), "{cargo:?} fails: {}", output.status);
    let messages = String::from_utf8(output.stdout).expect("UTF-8");
    let messages = messages.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let program = |message: Value| {
        let is_test = message["profile"]["test"] == true;
        let file = message["executable"].as_str().filter(|_| is_test)?.into();
        let manifest = Path::new(message["manifest_path"].as_str()?);
        let name = message["target"]["name"].as_str()?.into();
        Some(TestProgram { name, file, package: manifest.parent()?.into() })
    };
    messages.filter_map(program).collect()
}
