//! Deliberate mistakes, each of which the tests must find.
//!
//! `defects.toml` lists them. Each is made in a copy of the sources, the library of an FMU is built from it, and the
//! cheapest test that must fail is run. If it passes, all other tests that load a library are run, too. A mistake that
//! no test finds is a failure of this test, and so is one that no longer applies to the sources, or does not compile.
//!
//! `cargo test --release --test defects find_every -- --ignored --nocapture` makes all of them;
//! `BRINELL_DEFECTS=TEXT,TEXT` makes those with one of these texts in the name or the file.
#![cfg(all(target_os = "linux", target_env = "gnu"))]

mod matrix;

use brinell_testing::{child, driver, rebuilt, suites, unit};
use driver::{arguments, has_valgrind, valgrind};
use rebuilt::{Sources, Way};
use std::collections::HashSet;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;
use suites::{Subject, Suites};

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

/// The longest time for a test of one library.
const LIMIT: Duration = Duration::from_secs(120);

/// Number of random scripts for a mistake that its own test has not found.
const SCRIPTS: u64 = 1000;

/// A mistake. The head of `defects.toml` explains the keys.
struct Defect {
    name: String,
    file: String,
    old: String,
    new: String,
    scene: String,
    test: String,
}

impl Defect {
    /// The program of tests in Rust that must fail, and its topic; an empty topic is all of them.
    fn program(&self) -> Option<(&str, &str)> {
        let named = self.test.strip_prefix("test: ")?;
        Some(named.split_once(' ').unwrap_or((named, "")))
    }
}

fn defects() -> Vec<Defect> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/defects/defects.toml");
    let table: toml::Table = fs::read_to_string(path).expect("the list").parse().expect("the list is well-formed");
    let list = table["defect"].as_array().expect("a list of mistakes");
    let text = |entry: &toml::Value, key: &str| {
        entry.get(key).and_then(toml::Value::as_str).map(String::from).unwrap_or_default()
    };
    let read = |entry: &toml::Value| {
        let [name, file, old, new, scene, test] =
            ["name", "file", "old", "new", "scene", "test"].map(|key| text(entry, key));
        Defect { name, file, old, new, scene, test }
    };
    list.iter().map(read).collect()
}

/// Those with one of the texts of `BRINELL_DEFECTS` in the name or the file; all without it.
fn chosen(all: &[Defect]) -> Vec<&Defect> {
    let wanted = env::var("BRINELL_DEFECTS").unwrap_or_default();
    let is_wanted =
        |defect: &&Defect| wanted.split(',').any(|text| defect.name.contains(text) || defect.file.contains(text));
    all.iter().filter(is_wanted).collect()
}

/// The tests.
struct Tests {
    suites: Suites,
    sources: Sources,
    /// The C program, which counts memory and uses it up, and the same without that for valgrind.
    program: PathBuf,
    plain_program: PathBuf,
}

impl Tests {
    /// Runs a `test` on `library`, that of the FMU at `place`.
    ///
    /// # Errors
    /// What it finds.
    fn run(&self, test: &str, library: &Path, place: &Path) -> Result<(), String> {
        let subject = Subject { library, place, environment: &[], limit: LIMIT };
        match test.split_once(": ") {
            Some(("conformance", check)) => self.suites.conform(&subject, Some(check)),
            Some(("fuzz", count)) => self.suites.fuzz(&subject, count.parse().expect("a number of scripts")),
            None if test == "c program" => self.call(Command::new(&self.program), library),
            None => {
                let mut tool = valgrind(test);
                tool.arg(&self.plain_program);
                self.call(tool, library)
            }
            Some(_) => panic!("no test {test:?}"),
        }
    }

    /// Runs the C program by this `command`.
    fn call(&self, mut command: Command, library: &Path) -> Result<(), String> {
        let mut arguments = arguments();
        arguments[0] = library.to_str().expect("a path of plain characters").into();
        command.args(arguments);
        let log = self.program.with_extension("log");
        child::run(&mut command, &log, Duration::from_secs(600)).map_err(|failure| failure.to_string())
    }

    /// Makes the mistake and returns the test that finds it.
    ///
    /// # Errors
    /// Why none does.
    fn find(&self, defect: &Defect) -> Result<String, String> {
        if let Some((program, topic)) = defect.program() {
            let before = self.sources.replace(&defect.file, &defect.old, &defect.new)?;
            let result = self.sources.test(program, topic);
            self.sources.restore(&defect.file, &before);
            return match result {
                Err(said) if said.contains("test result: FAILED") => Ok(defect.test.clone()),
                Err(said) => Err(said),
                Ok(()) => Err(format!("{} passes", defect.test)),
            };
        }
        let scene = scene(&defect.scene);
        let place = self.sources.use_scene(&scene);
        let before = self.sources.replace(&defect.file, &defect.old, &defect.new)?;
        let library = self.sources.library("defect", &Way::default());
        self.sources.restore(&defect.file, &before);
        let library = library?;
        if self.run(&defect.test, &library, &place).is_err() {
            return Ok(defect.test.clone());
        }
        let subject = Subject { library: &library, place: &place, environment: &[], limit: LIMIT };
        if let Err(said) = self.suites.conform(&subject, None) {
            return Ok(format!("conformance, not {}:\n{said}", defect.test));
        }
        match self.suites.fuzz(&subject, SCRIPTS) {
            Err(said) => Ok(format!("fuzz, not {}:\n{said}", defect.test)),
            Ok(()) => Err("no test finds it".into()),
        }
    }
}

/// The scene `name`: of the project, or of those of the suites.
fn scene(name: &str) -> PathBuf {
    if name == "fresh" {
        return unit::write_scene(name, FRESH);
    }
    if name == "with regime" { driver::scene() } else { unit::scene(name) }
}

/// A contact that forgets its dents, with the energies.
const FRESH: &str = "name = \"fresh\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\nsurface = \"fresh\"\n\
                     [fmu]\noutputs = [\"indentation\", \"work\", \"elastic_energy\", \"dissipated_energy\"]\n";

/// The tests pass without a mistake; otherwise they would find every one.
fn assert_good_without_a_mistake(tests: &Tests, defects: &[&Defect]) {
    let mut done = HashSet::new();
    for defect in defects.iter().filter(|defect| done.insert((&defect.scene, &defect.test))) {
        let result = match defect.program() {
            Some((program, topic)) => tests.sources.test(program, topic),
            None => {
                let place = tests.sources.use_scene(&scene(&defect.scene));
                let name = format!("good_{}", defect.scene.replace(' ', "_"));
                let library = tests.sources.library(&name, &Way::default());
                library.and_then(|library| tests.run(&defect.test, &library, &place))
            }
        };
        result.unwrap_or_else(|said| panic!("{} fails without a mistake, for {}: {said}", defect.test, defect.scene));
    }
}

#[test]
#[ignore = "it builds a library for each mistake: a quarter of an hour"]
fn the_tests_find_every_deliberate_mistake() {
    let all = defects();
    let needs_valgrind = |defect: &Defect| ["memcheck", "helgrind"].contains(&&*defect.test);
    let valgrind = has_valgrind();
    let (made, skipped): (Vec<_>, Vec<_>) =
        chosen(&all).into_iter().partition(|defect| valgrind || !needs_valgrind(defect));
    let program = driver::compile("driver-for-defects", &[]);
    let plain_program = driver::compile("driver-for-defects-in-valgrind", &["-DNO_COUNTING"]);
    let tests = Tests { suites: Suites::build(), sources: Sources::copied("defects"), program, plain_program };
    assert_good_without_a_mistake(&tests, &made);
    let mut missed = Vec::new();
    for defect in &made {
        match tests.find(defect) {
            Ok(test) => println!("found: {} ({test})", defect.name),
            Err(reason) => {
                println!("MISSED: {}: {reason}", defect.name);
                missed.push(format!("{}: {reason}", defect.name));
            }
        }
    }
    for defect in &skipped {
        println!("skipped: {}, since there is no valgrind", defect.name);
    }
    println!("{} of {} mistakes found", made.len() - missed.len(), made.len());
    assert!(missed.is_empty(), "{} mistakes are not found:\n{}", missed.len(), missed.join("\n"));
}

/// The list is checked in every run; only the libraries take long.
#[test]
fn every_deliberate_mistake_applies_to_the_sources() {
    let all = defects();
    assert!(all.len() >= 30, "{} mistakes", all.len());
    let mut names = HashSet::new();
    for defect in &all {
        assert!(names.insert(&defect.name), "{} is listed twice", defect.name);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&defect.file);
        let text =
            fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {}: {error}", defect.name, defect.file));
        let count = text.matches(&defect.old).count();
        assert_eq!(count, 1, "{}: {} has the text to replace {count} times", defect.name, defect.file);
        assert_ne!(defect.old, defect.new, "{}", defect.name);
        if let Some((program, topic)) = defect.program() {
            let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
            let file = if topic.is_empty() { tests.join(program) } else { tests.join(program).join(topic) };
            assert!(file.with_extension("rs").is_file(), "{}: there is no {}", defect.name, defect.test);
            let main = fs::read_to_string(tests.join(program).join("main.rs")).unwrap_or_default();
            assert!(!main.contains("CARGO_BIN_EXE"), "{}: {program} needs the program", defect.name);
            continue;
        }
        let is_suite = ["conformance: ", "fuzz: "].iter().any(|kind| defect.test.starts_with(kind));
        let is_program = ["c program", "memcheck", "helgrind"].contains(&&*defect.test);
        assert!(is_suite || is_program, "{}: {}", defect.name, defect.test);
    }
}
