//! Which tests find which mistakes: `matrix.csv`, a line for each mistake and program.
//!
//! Of the programs in Rust all tests that fail are listed, of the conformance suite the first check. A test whose claim others say as
//! well, and that no mistake needs, may go; a mistake that none finds any more brings its test back. `BRINELL_DEFECTS` chooses
//! mistakes here as well, and `BRINELL_PROGRAMS` programs; all other lines stay as they are.

use super::{Defect, LIMIT_OF_PROGRAM, Tests, chosen, defects, planted};
use brinell_testing::{child, toolchain::TestProgram};
use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The programs that need no FMU, and what a mistake must be in to be found by them.
const PROGRAMS: [(&str, &[&str]); 3] = [
    ("physics", &["crates/contact/"]),
    ("instances", &["crates/contact/", "crates/fmu/"]),
    ("c_functions", &["crates/contact/", "crates/fmu/"]),
];

/// For a name and a program, the tests that fail.
type Matrix = BTreeMap<(String, String), Vec<String>>;

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/defects/matrix.csv")
}

fn read() -> Matrix {
    let text = fs::read_to_string(path()).unwrap_or_default();
    let cells = |line: &str| line.split(',').map(String::from).collect::<Vec<_>>();
    let line = |line: &str| match &*cells(line) {
        [name, program, found] => ((name.clone(), program.clone()), found.split(' ').map(String::from).collect()),
        _ => panic!("matrix.csv: {line}"),
    };
    text.lines().skip(1).map(line).collect()
}

fn write(matrix: &Matrix) {
    let line =
        |((name, program), found): (&(String, String), &Vec<String>)| format!("{name},{program},{}\n", found.join(" "));
    let text = "mistake,program,tests that find it\n".to_string() + &matrix.iter().map(line).collect::<String>();
    fs::write(path(), text).expect("the folder of the tests can be written to");
}

impl Tests {
    /// The tests of `program` that fail with a mistake.
    fn failing(&self, program: &TestProgram, defect: &Defect) -> Vec<String> {
        let mut command = Command::new(&program.file);
        command.current_dir(&program.package).env(planted::VARIABLE, defect.number.to_string());
        let log = self.program.with_extension("log");
        let Err(failure) = child::run(&mut command, &log, LIMIT_OF_PROGRAM) else { return Vec::new() };
        let said = fs::read_to_string(log).unwrap_or_default();
        let failed = said.lines().filter_map(|line| line.strip_prefix("test ")?.strip_suffix(" ... FAILED"));
        let mut failed: Vec<String> = failed.map(String::from).collect();
        match failure {
            child::Failure::Hang { .. } => failed.push("(no end)".into()),
            child::Failure::Ended { .. } if failed.is_empty() => failed.push("(crash)".into()),
            child::Failure::Ended { .. } => failed.sort(),
        }
        failed
    }

    /// The first check of the conformance suite that fails with a mistake.
    fn failing_check(&self, defect: &Defect) -> Option<String> {
        let library = self.library_for(defect).expect("the mistake applies");
        let said = self.run("conformance: all", &library, defect.number).err()?;
        let name = said.lines().rev().find_map(|line| line.strip_prefix("check: ")).unwrap_or("(crash)");
        Some(name.replace(' ', "_"))
    }

    /// What finds a mistake, by program.
    fn finders(&self, defect: &Defect, programs: &[&str]) -> BTreeMap<String, Vec<String>> {
        let mut all = BTreeMap::new();
        self.with_programs(defect, programs, |program| {
            all.insert(program.name.clone(), self.failing(program, defect));
        });
        if !defect.scene.is_empty() {
            all.insert("conformance".into(), self.failing_check(defect).into_iter().collect());
        }
        all
    }
}

#[test]
#[ignore = "it runs three programs for each mistake: hours"]
fn the_matrix_of_mistakes_and_tests_is_written() {
    let wanted = env::var("BRINELL_PROGRAMS").unwrap_or_default();
    let is_wanted = |name: &str| wanted.is_empty() || wanted.split(',').any(|one| one == name);
    let programs: BTreeSet<&str> = PROGRAMS.iter().map(|(name, _)| *name).filter(|name| is_wanted(name)).collect();
    let all = defects();
    let chosen = chosen(&all);
    let tests = Tests::of(&chosen, &programs);
    for defect in chosen {
        let may_find = |(_, parts): &&(&str, &[&str])| parts.iter().any(|part| defect.file.starts_with(part));
        let programs: Vec<&str> =
            PROGRAMS.iter().filter(may_find).map(|(name, _)| *name).filter(|name| is_wanted(name)).collect();
        let mut matrix = read();
        for (program, found) in tests.finders(defect, &programs) {
            println!("{}: {} of {program}", defect.name, found.len());
            matrix.insert((defect.name.replace(',', ""), program), found);
        }
        matrix.retain(|_, found| !found.is_empty());
        write(&matrix);
    }
    tell_what_only_one_test_finds(&read());
}

fn tell_what_only_one_test_finds(matrix: &Matrix) {
    let mut finders: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for ((name, _), found) in matrix {
        finders.entry(name).or_default().extend(found.iter().map(String::as_str));
    }
    for (name, found) in finders.iter().filter(|(_, found)| found.len() == 1) {
        println!("only {} finds: {name}", found[0]);
    }
}

/// Every mistake of the matrix is on the list, and a test that finds it is still there.
#[test]
fn a_mistake_of_the_matrix_has_a_test_that_finds_it() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let names: BTreeSet<String> = defects().iter().map(|defect| defect.name.replace(',', "")).collect();
    let mut is_found: BTreeMap<String, bool> = BTreeMap::new();
    for ((name, program), found) in read() {
        assert!(names.contains(&name), "matrix.csv: {name:?} is not in defects.toml");
        let there = found.iter().any(|test| test.starts_with('(') || is_there(&tests, &program, test));
        *is_found.entry(name).or_default() |= there;
    }
    let lost: Vec<_> = is_found.iter().filter(|(_, found)| !**found).map(|(name, _)| name).collect();
    assert!(
        lost.is_empty(),
        "all tests that found these mistakes are gone: {lost:?}; write a test for them, and their lines anew"
    );
}

/// Whether the test `name`, with its modules, is in the sources of `program`.
fn is_there(tests: &Path, program: &str, name: &str) -> bool {
    if program == "conformance" {
        let checks = fs::read_to_string(tests.join("conformance/checks/mod.rs")).unwrap_or_default();
        return checks.contains(&format!("check(\"{}\"", name.replace('_', " ")));
    }
    let parts: Vec<&str> = name.split("::").collect();
    let (test, modules) = parts.split_last().expect("a name");
    let folder = tests.join(program);
    let file = match modules {
        [] if folder.is_dir() => folder.join("main.rs"),
        [] => folder.with_extension("rs"),
        _ => folder.join(modules.join("/")).with_extension("rs"),
    };
    fs::read_to_string(file).is_ok_and(|text| text.contains(&format!("fn {test}(")))
}
