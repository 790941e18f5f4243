//! Which tests in Rust find which mistakes: `matrix.csv`, a line for each mistake and program.
//!
//! A test whose claim others say as well, and that no mistake needs, may go; a mistake that none finds any more brings its
//! test back. `BRINELL_DEFECTS` chooses mistakes here as well, and `BRINELL_PROGRAMS` programs; all other lines stay as they are.

use super::{chosen, defects};
use brinell_testing::{child, rebuilt::Sources};
use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The programs that need no FMU, and what a mistake must be in to be found by them.
const PROGRAMS: [(&str, &[&str]); 3] = [
    ("physics", &["crates/contact/"]),
    ("instances", &["crates/contact/", "crates/fmu/"]),
    ("c_functions", &["crates/contact/", "crates/fmu/"]),
];

/// The longest time for a program; one that hangs has found the mistake.
const LIMIT: Duration = Duration::from_secs(1200);

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

/// The tests of `program`, a file, that fail.
fn failing(program: &Path, log: &Path) -> Vec<String> {
    let mut command = Command::new(program);
    command.current_dir(program.parent().expect("a folder"));
    let Err(failure) = child::run(&mut command, log, LIMIT) else { return Vec::new() };
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

#[test]
#[ignore = "it compiles and runs three programs for each mistake: hours"]
fn the_matrix_of_mistakes_and_tests_is_written() {
    let sources = Sources::copied("matrix");
    let log = sources.beside("log");
    let wanted = env::var("BRINELL_PROGRAMS").unwrap_or_default();
    for defect in chosen(&defects()) {
        let may_find = |(name, parts): &&(&str, &[&str])| {
            name.contains(&*wanted) && parts.iter().any(|part| defect.file.starts_with(part))
        };
        let programs: Vec<&str> = PROGRAMS.iter().filter(may_find).map(|(name, _)| *name).collect();
        let before = sources.replace(&defect.file, &defect.old, &defect.new).expect("the mistake applies");
        let files = sources.test_programs(&programs);
        sources.restore(&defect.file, &before);
        let mut matrix = read();
        for program in files {
            let found = failing(&program.file, &log);
            println!("{}: {} of {}", defect.name, found.len(), program.name);
            matrix.insert((defect.name.replace(',', ""), program.name), found);
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
