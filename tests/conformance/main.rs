//! The conformance suite: every function of FMI 2.0 co-simulation in every state, with every argument, for every kind of
//! FMU.
//!
//! `table.rs` is the table of allowed calls of the standard as data; `checks/` has the checks. A library is loaded as an
//! importer does it. Each check of an FMU runs in a separate process with a time limit, so a crash and a hang are findings
//! like others.
//!
//! `cargo test --release --test conformance` checks the FMUs of all scenes. The units of every law are checked by
//! `cargo test --release --test conformance -- --ignored every_law --nocapture`.

#[path = "../../src/parallel.rs"]
mod parallel;

mod checks;
mod table;

use brinell_testing::{arithmetic, child, face, importer, judge, long, targets, unit};
use checks::CHECKS;
use face::Face;
use importer::CALLS;
use std::convert::Infallible;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// The longest time for a check of an FMU, on a busy machine.
const LIMIT: Duration = Duration::from_secs(300);

/// The library; the place of the library whose model description applies to it, if it is another; the name of the check;
/// the file for the number of calls.
const LIBRARY: &str = "BRINELL_CONFORMANCE_LIBRARY";
const PLACE: &str = "BRINELL_CONFORMANCE_PLACE";
const CHECK: &str = "BRINELL_CONFORMANCE_CHECK";
const COUNT: &str = "BRINELL_CONFORMANCE_COUNT";

/// Set for a law that returns energy as published, according to the table of laws.
const ACTIVE: &str = "BRINELL_CONFORMANCE_ACTIVE";

/// The process: makes one check, or all of them, of one FMU.
#[test]
#[ignore = "the tests below start it in processes of their own"]
fn worker() {
    let Ok(library) = env::var(LIBRARY) else { return };
    let place = env::var(PLACE).unwrap_or_else(|_| library.clone());
    let mut face = Face::of(Path::new(&library), Path::new(&place));
    face.passive = env::var_os(ACTIVE).is_none();
    match env::var(CHECK) {
        Ok(name) => {
            let check = CHECKS.iter().find(|check| check.name == name);
            (check.unwrap_or_else(|| panic!("no check {name:?}")).run)(&face);
        }
        Err(_) => CHECKS.iter().for_each(|check| {
            println!("check: {}", check.name);
            (check.run)(&face);
        }),
    }
    if let Ok(file) = env::var(COUNT) {
        fs::write(file, CALLS.load(Ordering::Relaxed).to_string()).expect("the target folder can be written to");
    }
}

/// An FMU to check.
struct Target {
    name: String,
    file: PathBuf,
    /// Whether its law never returns energy.
    passive: bool,
}

impl Target {
    fn of_scene(scene: &Path, passive: bool) -> Target {
        let name = scene.file_stem().expect("a name").to_string_lossy().into_owned();
        Target { name, file: unit::compiled(scene), passive }
    }
}

/// Makes all checks of one FMU; returns the number of calls, and what fails.
fn conform_one(Target { name, file, passive }: &Target) -> (u64, Vec<String>) {
    let program = env::current_exe().expect("a test program");
    let scratch = tempfile::tempdir().expect("a folder for temporary files");
    let (log, count) = (scratch.path().join("log"), scratch.path().join("count"));
    let library = unit::library(file);
    let (mut made, mut wrong) = (0, Vec::new());
    for check in CHECKS {
        let mut command: Command = child::worker(&program);
        command.env(LIBRARY, &library).env(CHECK, check.name).env(COUNT, &count);
        if !*passive {
            command.env(ACTIVE, "1");
        }
        match child::run(&mut command, &log, LIMIT) {
            Ok(()) => made += fs::read_to_string(&count).expect("the worker's").parse::<u64>().expect("a number"),
            Err(failure) => wrong.push(format!("{name}, {}: {failure}", check.name)),
        }
    }
    println!("{name}: {made} calls in {} checks", CHECKS.len());
    (made, wrong)
}

/// Makes all checks of each FMU; returns the number of calls.
///
/// # Panics
/// If any of them fails, with all failures.
fn conform<T: Sync>(targets: &[T], target: impl Fn(&T) -> Target + Sync) -> u64 {
    let Ok(results) = parallel::each(targets, |each| Ok::<_, Infallible>(conform_one(&target(each))));
    let all = results.iter().map(|(made, _)| made).sum();
    let wrong: Vec<_> = results.into_iter().flat_map(|(_, wrong)| wrong).collect();
    assert!(wrong.is_empty(), "{} checks fail:\n{}", wrong.len(), wrong.join("\n"));
    println!("{all} calls, {} FMUs, {} checks", targets.len(), CHECKS.len());
    all
}

/// A scene whose steps take so long that a usual run takes its kind from a prebuilt library alone.
const LONG: &str = "slope.toml";

#[test]
fn every_kind_of_fmu_does_what_the_standard_says() {
    let mut scenes = targets::compiled();
    scenes.retain(|scene| long::is_asked() || !scene.ends_with(LONG));
    assert!(conform(&scenes, |scene| Target::of_scene(scene, true)) > 100_000);
}

#[test]
fn every_kind_of_prebuilt_library_does_what_the_standard_says() {
    let target = |(name, file): &(String, PathBuf)| Target {
        name: format!("prebuilt {name}"),
        file: file.clone(),
        passive: true,
    };
    assert!(conform(&targets::from_prebuilt(), target) > 100_000);
}

/// Every function is in the table once.
#[test]
fn the_table_has_all_functions() {
    let mut names: Vec<_> = table::ROWS.iter().map(|row| row.function).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 44);
}

/// A law that an FMU can have.
struct Law {
    name: String,
    /// The unloading law that it was published with.
    unloading: Option<String>,
    passive: bool,
}

fn laws() -> Vec<Law> {
    let output = Command::new(env!("CARGO_BIN_EXE_brinell")).args(["laws", "--json"]).output().expect("the program");
    let all: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let text = |law: &serde_json::Value, key: &str| law[key].as_str().map(String::from);
    let list = |kind: &str| all[kind].as_array().expect("a list of laws").clone();
    let laws = list("loading").into_iter().chain(list("damped"));
    let law = |law: serde_json::Value| Law {
        name: text(&law, "name").expect("a law has a name"),
        unloading: text(&law, "unloading"),
        passive: law["passive"] != serde_json::Value::Bool(false),
    };
    laws.map(law).collect()
}

#[test]
#[ignore = "it exports an FMU for each law: two minutes"]
fn the_fmu_of_every_law_does_what_the_standard_says() {
    let laws = laws();
    assert!(laws.len() >= 35, "{} laws", laws.len());
    assert!(laws.iter().filter(|law| law.passive).count() >= 20, "most laws are passive");
    conform(&laws, |law| Target::of_scene(&targets::scene_of_law(&law.name, law.unloading.as_deref()), law.passive));
}
