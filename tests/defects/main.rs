//! Deliberate mistakes, each of which the tests must find.
//!
//! `defects.toml` lists them. They are made in a copy of the sources, from which the libraries of FMUs and the programs of tests are
//! built, and the cheapest test that must fail is run for each. If it passes, all other tests that load a library are run, too. A
//! mistake that no test finds is a failure of this test, and so is one that no longer applies to the sources, or does not compile.
//!
//! `cargo test --release --test defects find_every -- --ignored --nocapture` makes all of them;
//! `BRINELL_DEFECTS=TEXT,TEXT` makes those with one of these texts in the name or the file.
#![cfg(all(target_os = "linux", target_env = "gnu"))]

mod matrix;
mod planted;

use brinell_testing::{child, driver, rebuilt, suites, toolchain, unit};
use driver::{arguments, has_valgrind, valgrind};
use rebuilt::{Sources, Way};
use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;
use suites::{Subject, Suites};
use toolchain::TestProgram;

/// Cargo builds the program before these tests; without its feature they do not compile.
const _: &str = env!("CARGO_BIN_EXE_brinell");

/// The longest time for a test of one library.
const LIMIT: Duration = Duration::from_secs(120);

/// The longest time for a program of tests; one that hangs has found the mistake.
const LIMIT_OF_PROGRAM: Duration = Duration::from_secs(1200);

/// The random scripts for a mistake that its own test has not found.
const SCRIPTS: &str = "fuzz: 1000";

/// A mistake. The head of `defects.toml` explains the keys.
struct Defect {
    /// Its place on the list, from 1.
    number: u32,
    name: String,
    file: String,
    old: String,
    new: String,
    scene: String,
    test: String,
    alone: bool,
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
    let read = |(place, entry): (usize, &toml::Value)| {
        let number = u32::try_from(place + 1).expect("a short list");
        let [name, file, old, new, scene, test] =
            ["name", "file", "old", "new", "scene", "test"].map(|key| text(entry, key));
        let alone = entry.get("alone").is_some_and(|alone| alone.as_bool() == Some(true));
        Defect { number, name, file, old, new, scene, test, alone }
    };
    list.iter().enumerate().map(read).collect()
}

/// Those with one of the texts of `BRINELL_DEFECTS` in the name or the file; all without it.
fn chosen(all: &[Defect]) -> Vec<&Defect> {
    let wanted = env::var("BRINELL_DEFECTS").unwrap_or_default();
    let is_wanted =
        |defect: &&Defect| wanted.split(',').any(|text| defect.name.contains(text) || defect.file.contains(text));
    all.iter().filter(is_wanted).collect()
}

/// The tests, and the sources with all mistakes that can be switched on.
struct Tests {
    suites: Suites,
    sources: Sources,
    /// The numbers of the mistakes that can.
    switched: HashSet<u32>,
    /// The libraries with them by their scenes, and the places of those of the FMUs.
    libraries: RefCell<HashMap<String, (PathBuf, PathBuf)>>,
    /// The test programs with them.
    programs: HashMap<String, TestProgram>,
    /// The C program, which counts memory and uses it up, and the same without that for valgrind.
    program: PathBuf,
    plain_program: PathBuf,
}

impl Tests {
    /// The tests for these mistakes, which are planted; `programs` are those of tests in Rust.
    fn of(defects: &[&Defect], programs: &BTreeSet<&str>) -> Tests {
        let sources = Sources::copied("defects");
        let switched = planted::plant(&sources, defects);
        let mut programs = if programs.is_empty() { Vec::new() } else { sources.test_programs(programs) };
        for program in &mut programs {
            // a build with a mistake alone has the same place
            let kept = program.file.with_file_name(format!("all_{}", program.name));
            fs::copy(&program.file, &kept).expect("the target folder can be written to");
            program.file = kept;
        }
        Tests {
            suites: Suites::build(),
            switched,
            libraries: RefCell::default(),
            programs: programs.into_iter().map(|program| (program.name.clone(), program)).collect(),
            program: driver::compile("driver-for-defects", &[]),
            plain_program: driver::compile("driver-for-defects-in-valgrind", &["-DNO_COUNTING"]),
            sources,
        }
    }

    /// The library of a scene, with all mistakes that can be switched on, and the place of that of its FMU.
    fn library(&self, name: &str) -> Result<(PathBuf, PathBuf), String> {
        if let Some(made) = self.libraries.borrow().get(name) {
            return Ok(made.clone());
        }
        let place = self.sources.use_scene(&scene(name));
        let made = (self.sources.library(&format!("all_{}", name.replace(' ', "_")), &Way::default())?, place);
        self.libraries.borrow_mut().insert(name.into(), made.clone());
        Ok(made)
    }

    /// Runs a `test` on a library with the mistake of this `number`, if it has it.
    ///
    /// # Errors
    /// What it finds.
    fn run(&self, test: &str, (library, place): &(PathBuf, PathBuf), number: u32) -> Result<(), String> {
        let environment = &[(planted::VARIABLE, number.to_string())];
        let subject = Subject { library, place, environment, limit: LIMIT };
        match test.split_once(": ") {
            Some(("conformance", check)) => self.suites.conform(&subject, Some(check).filter(|check| *check != "all")),
            Some(("fuzz", count)) => self.suites.fuzz(&subject, count.parse().expect("a number of scripts")),
            None if test == "c program" => self.call(Command::new(&self.program), &subject),
            None => {
                let mut tool = valgrind(test);
                tool.arg(&self.plain_program);
                self.call(tool, &subject)
            }
            Some(_) => panic!("no test {test:?}"),
        }
    }

    /// Runs the C program by this `command`.
    fn call(&self, mut command: Command, subject: &Subject) -> Result<(), String> {
        let mut arguments = arguments();
        arguments[0] = subject.library.to_str().expect("a path of plain characters").into();
        command.args(arguments).envs(subject.environment.iter().map(|(name, value)| (name, value)));
        let log = self.program.with_extension("log");
        child::run(&mut command, &log, Duration::from_secs(600)).map_err(|failure| failure.to_string())
    }

    /// Runs the tests of a program that are about `topic`, with a mistake or without.
    fn run_program(&self, program: &TestProgram, topic: &str, number: u32) -> Result<(), String> {
        let mut command = Command::new(&program.file);
        command.current_dir(&program.package).arg(topic).env(planted::VARIABLE, number.to_string());
        child::run(&mut command, &self.program.with_extension("log"), LIMIT_OF_PROGRAM)
            .map_err(|failure| failure.to_string())
    }

    /// What `build` makes of the sources with a mistake that can't be switched on.
    fn built<T>(&self, defect: &Defect, build: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
        self.sources.changed((&defect.file, &defect.old, &defect.new), build)
    }

    /// The library of the mistake's scene with it, and the place of that of its FMU.
    fn library_for(&self, defect: &Defect) -> Result<(PathBuf, PathBuf), String> {
        if self.switched.contains(&defect.number) {
            return self.library(&defect.scene);
        }
        let place = self.sources.use_scene(&scene(&defect.scene));
        Ok((self.built(defect, || self.sources.library("defect", &Way::default()))?, place))
    }

    /// Calls `run` with each of the `programs`, which has the mistake or can be told to have it.
    fn with_programs(&self, defect: &Defect, programs: &[&str], mut run: impl FnMut(&TestProgram)) {
        if self.switched.contains(&defect.number) {
            return programs.iter().for_each(|name| run(&self.programs[*name]));
        }
        let built = self.built(defect, || Ok(self.sources.test_programs(programs))).expect("the mistake applies");
        built.iter().for_each(run);
    }

    /// Makes the mistake and returns the test that finds it.
    ///
    /// # Errors
    /// Why none does.
    fn find(&self, defect: &Defect) -> Result<String, String> {
        if let Some((program, topic)) = defect.program() {
            let mut result = Ok(());
            self.with_programs(defect, &[program], |program| {
                result = self.run_program(program, topic, defect.number);
            });
            return if result.is_err() { Ok(defect.test.clone()) } else { Err(format!("{} passes", defect.test)) };
        }
        let library = self.library_for(defect)?;
        if self.run(&defect.test, &library, defect.number).is_err() {
            return Ok(defect.test.clone());
        }
        for test in ["conformance: all", SCRIPTS] {
            if let Err(said) = self.run(test, &library, defect.number) {
                return Ok(format!("{test}, not {}:\n{said}", defect.test));
            }
        }
        Err("no test finds it".into())
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
            Some((program, topic)) => tests.run_program(&tests.programs[program], topic, 0),
            None => tests.library(&defect.scene).and_then(|library| tests.run(&defect.test, &library, 0)),
        };
        result.unwrap_or_else(|said| panic!("{} fails without a mistake, for {}: {said}", defect.test, defect.scene));
    }
}

#[test]
#[ignore = "it builds libraries and programs with mistakes: a quarter of an hour"]
fn the_tests_find_every_deliberate_mistake() {
    let all = defects();
    let needs_valgrind = |defect: &Defect| ["memcheck", "helgrind"].contains(&&*defect.test);
    let valgrind = has_valgrind();
    let (made, skipped): (Vec<_>, Vec<_>) =
        chosen(&all).into_iter().partition(|defect| valgrind || !needs_valgrind(defect));
    let tests = Tests::of(&made, &made.iter().filter_map(|defect| Some(defect.program()?.0)).collect());
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
    let (mut names, mut switched) = (HashSet::new(), 0);
    for defect in &all {
        assert!(names.insert(&defect.name), "{} is listed twice", defect.name);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(&defect.file);
        let text =
            fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {}: {error}", defect.name, defect.file));
        let count = text.matches(&defect.old).count();
        assert_eq!(count, 1, "{}: {} has the text to replace {count} times", defect.name, defect.file);
        assert_ne!(defect.old, defect.new, "{}", defect.name);
        switched += usize::from(planted::body_around(&text, defect).is_some());
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
    assert!(switched * 10 >= all.len() * 8, "only {switched} of {} mistakes need no build of their own", all.len());
}
