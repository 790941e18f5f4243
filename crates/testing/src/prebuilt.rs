//! Prebuilt libraries for tests, and FMUs made from them or compiled.

use super::command::{Run, brinell, output};
use crate::places::{build, program, temporary, test_name};
use serde_json::Value;
use std::collections::{BTreeSet, HashMap};
use std::env;
use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex, OnceLock, PoisonError};

/// The folder for all files of this test program.
pub fn folder() -> PathBuf {
    let folder = temporary().join("prebuilt").join(test_name());
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    folder
}

/// A folder with all libraries for this machine, shared by the test programs: the one that lies beside the program, for a system
/// without compiler, otherwise made once.
pub fn store() -> &'static Path {
    static STORE: OnceLock<PathBuf> = OnceLock::new();
    STORE.get_or_init(|| {
        let beside = program().with_file_name("share").join("brinell/prebuilt");
        if beside.is_dir() { beside } else { made_once("all-kinds", &[]) }
    })
}

/// A folder with the library for one contact alone, the quickest to make.
pub fn only_state() -> PathBuf {
    made_once("state", &["--kinds", "state"])
}

/// What the program says of this machine: the folder of its libraries in an FMU, and the target of its compiler.
fn platform() -> &'static Value {
    static PLATFORM: LazyLock<Value> =
        LazyLock::new(|| output(brinell(temporary()).args(["--version", "--json"])).json()["platform"].clone());
    &PLATFORM
}

/// The folder of libraries made by `brinell prebuild` with these arguments. The first test program that needs it
/// makes it once for this build of the program.
pub fn made_once(name: &str, arguments: &[&str]) -> PathBuf {
    let store = temporary().join("prebuilt").join(name);
    fs::create_dir_all(&store).expect("the target folder can be written to");
    let lock = File::create(store.with_extension("lock")).expect("the target folder can be written to");
    lock.lock().expect("the target folder is on a file system with locks");
    let made_by = format!("{} {arguments:?}", build());
    let marker = store.with_extension("made-by");
    if fs::read_to_string(&marker).is_ok_and(|text| text == made_by) {
        return store;
    }
    fs::remove_dir_all(&store).expect("the target folder can be written to");
    prebuild(&store, arguments).with_status(0);
    fs::write(&marker, made_by).expect("the target folder can be written to");
    store
}

/// Makes libraries in the folder `store`.
pub fn prebuild(store: &Path, arguments: &[&str]) -> Run {
    output(brinell(&folder()).arg("prebuild").arg("-o").arg(store).args(arguments))
}

/// The program without any compiler to find, with the libraries in `store`.
pub fn without_compiler(in_folder: &Path, store: &Path) -> Command {
    let mut command = brinell(in_folder);
    command.env_remove("CARGO").env("PATH", "/no/path").env("BRINELL_PREBUILT", store);
    command
}

/// `command`, whose programs find the libraries of the shared store and no compiler: an FMU is made in a hundredth of the time.
pub fn finding_no_compiler(command: &mut Command) -> &mut Command {
    command.env_remove("CARGO").env("PATH", path_without_rust()).env("BRINELL_PREBUILT", store())
}

/// The search path without the folders of Rust. One that has a shell, too, stays.
pub fn path_without_rust() -> OsString {
    let path = env::var_os("PATH").unwrap_or_default();
    let has = |folder: &Path, name: &str| folder.join(name).is_file();
    let folders = env::split_paths(&path).filter(|folder| !has(folder, "rustc") || has(folder, "sh"));
    env::join_paths(folders).expect("they came from a search path")
}

/// The FMU of the scene `text`, compiled or with the libraries in `store`.
pub fn export(text: &str, store: Option<&Path>) -> PathBuf {
    exported(text, store).0
}

/// The FMU of the scene `text` with the libraries in `store`, and the kind of the library.
pub fn export_by_kind(text: &str, store: &Path) -> (PathBuf, String) {
    let (fmu, summary) = exported(text, Some(store));
    let library = summary["made"]["prebuilt"].as_str().expect("it was made from a prebuilt library").into();
    (fmu, library)
}

/// The output of the program for each FMU made in this process, by scene and folder of libraries.
type Made = HashMap<(String, Option<PathBuf>), (PathBuf, Value)>;

/// The FMU of the scene `text`, compiled or with the libraries in `store`, made once per process, with the output of
/// the program.
fn exported(text: &str, store: Option<&Path>) -> (PathBuf, Value) {
    static MADE: LazyLock<Mutex<Made>> = LazyLock::new(Mutex::default);
    let key = (text.to_string(), store.map(Path::to_path_buf));
    // holding the lock makes a second test wait for the result
    let mut all = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    all.entry(key).or_insert_with(|| export_anew(text, store)).clone()
}

/// The same, made again.
pub fn export_anew(text: &str, store: Option<&Path>) -> (PathBuf, Value) {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let folder = folder().join(COUNT.fetch_add(1, Ordering::Relaxed).to_string());
    // left over from an earlier run
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the target folder can be written to");
    fs::write(folder.join("scene.toml"), text).expect("the target folder can be written to");
    let (mut command, way) = match store {
        Some(store) => (without_compiler(&folder, store), "--prebuilt"),
        None => (brinell(&folder), "--compile"),
    };
    // the libraries may be for all platforms
    let platform = platform()["folder"].as_str().expect("a name");
    command.args(["export", "scene.toml", "-o", "unit.fmu", "--json", way, "--platforms", platform]);
    let run = output(&mut command).with_status(0);
    (folder.join("unit.fmu"), run.json())
}

/// The names of the files of `store` for this machine with this ending.
pub fn file(ending: &str) -> String {
    format!("{}.{ending}", platform()["target"].as_str().expect("a name"))
}

/// The list of the libraries in `store`.
pub fn list(store: &Path) -> Value {
    let text = fs::read_to_string(store.join(file("json"))).expect("a list");
    serde_json::from_str(&text).expect("JSON")
}

/// The libraries in `store`, as they are listed.
pub fn libraries(store: &Path) -> Vec<Value> {
    list(store)["libraries"].as_array().expect("a list").clone()
}

/// Their names.
pub fn names(store: &Path) -> BTreeSet<String> {
    let name = |listed: &Value| listed["name"].as_str().expect("a name").into();
    libraries(store).iter().map(name).collect()
}
