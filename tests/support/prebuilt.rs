//! Prebuilt libraries for tests, and FMUs that are made from them or compiled.
#![allow(dead_code, reason = "each test file uses what it needs")]

use super::command::{Run, brinell, output};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The folder for everything that is made here.
pub fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("prebuilt").join(env!("CARGO_CRATE_NAME"));
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    folder
}

/// The laws that every run of the tests takes; all kinds of libraries are made for them.
pub const LAWS: [&str; 3] = ["big-alabo", "hunt-crossley/exact", "hunt-crossley/flores"];

/// A folder with the libraries of [`LAWS`], made once per process.
pub fn store() -> &'static Path {
    static STORE: OnceLock<PathBuf> = OnceLock::new();
    STORE.get_or_init(|| {
        let store = folder().join("store");
        prebuild(&store, &["--laws", &LAWS.join(",")]).with_status(0);
        store
    })
}

/// Makes libraries in the folder `store`.
pub fn prebuild(store: &Path, arguments: &[&str]) -> Run {
    output(brinell(&folder()).arg("prebuild").arg("-o").arg(store).args(arguments))
}

/// The program where no compiler can be found, with the libraries in `store`.
pub fn without_compiler(in_folder: &Path, store: &Path) -> Command {
    let mut command = brinell(in_folder);
    command.env_remove("CARGO").env("PATH", "/no/path").env("BRINELL_PREBUILT", store);
    command
}

/// The FMU of the scene `text`, compiled or with the libraries in `store`.
pub fn export(text: &str, store: Option<&Path>) -> PathBuf {
    exported(text, store).0
}

/// The FMU of the scene `text` with the libraries in `store`, and the kind of the library.
pub fn export_by_kind(text: &str, store: &Path) -> (PathBuf, String) {
    let (fmu, summary) = exported(text, Some(store));
    let library = summary["made"]["prebuilt"].as_str().expect("it was made from a prebuilt library");
    let kind = library.split(' ').next_back().expect("LAWS KIND").into();
    (fmu, kind)
}

fn exported(text: &str, store: Option<&Path>) -> (PathBuf, Value) {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let folder = folder().join(COUNT.fetch_add(1, Ordering::Relaxed).to_string());
    // whatever an earlier run has left
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    fs::write(folder.join("scene.toml"), text).expect("the target folder can be written to");
    let (mut command, way) = match store {
        Some(store) => (without_compiler(&folder, store), "--prebuilt"),
        None => (brinell(&folder), "--compile"),
    };
    let run = output(command.args(["export", "scene.toml", "-o", "unit.fmu", "--json", way])).with_status(0);
    (folder.join("unit.fmu"), run.json())
}

/// The list of the libraries in `store`.
pub fn list(store: &Path) -> Value {
    let text = fs::read_to_string(store.join("linux64.json")).expect("a list");
    serde_json::from_str(&text).expect("JSON")
}
