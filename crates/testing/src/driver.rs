//! The C program of `tests/c`, which uses an FMU as an importer in C does.

use super::command::output;
use super::face::attribute;
use super::{python, skips, unit};
use crate::places::{root, temporary};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The files of the program.
const SOURCES: [&str; 4] = ["driver.c", "instances.c", "memory.c", "counting.c"];

/// The exit status of valgrind for its own errors.
const VALGRIND_ERROR: i32 = 9;

/// Compiles the program as `name` with additional `options`.
pub fn compile(name: &str, options: &[&str]) -> PathBuf {
    // the compiler must not replace functions of the program by its knowledge of calloc and free
    let own = [
        "-D_POSIX_C_SOURCE=200809L",
        "-g",
        "-pthread",
        "-rdynamic",
        "-fno-builtin-malloc",
        "-fno-builtin-calloc",
        "-fno-builtin-free",
    ];
    compiled(name, &[&own, options].concat(), &SOURCES)
}

/// Compiles the program of one file `tests/c/NAME.c`.
pub fn compile_one(name: &str) -> PathBuf {
    compiled(name, &[], &[&format!("{name}.c")])
}

/// Compiles a program of these files of `tests/c`.
fn compiled(name: &str, options: &[&str], sources: &[&str]) -> PathBuf {
    let program = temporary().join(name);
    let mut compiler = Command::new("cc");
    compiler
        .args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror", "-I"])
        .arg(python::site_packages_file("fmpy/c-code"));
    compiler.args(options).arg("-o").arg(&program);
    output(compiler.args(sources.iter().map(|source| root().join("tests/c").join(source))).args(["-ldl", "-lm"]))
        .with_status(0);
    program
}

/// Runs an FMU in `host`, the program of `tests/c/exceptions.c`, which traps floating-point exceptions.
///
/// # Panics
/// If it traps one, or a call fails.
#[track_caller]
pub fn assert_never_trapped(host: &Path, library: &Path, description: &str, what: &str) {
    let elements = || description.split("<ScalarVariable").skip(1);
    let of =
        |causality: &'static str| elements().filter(move |element| attribute(element, "causality") == Some(causality));
    let outputs = of("output").filter(|element| element.contains("<Real"));
    let outputs = outputs.filter_map(|element| attribute(element, "valueReference").map(str::to_string));
    let has = |what: &str| description.contains(what);
    let derivatives = match () {
        () if has("canInterpolateInputs=\"true\"") => "d",
        () if has("maxOutputDerivativeOrder=\"0\"") => "p",
        () if has("name=\"lossy\"") || has("modelName=\"lossy\"") => "l",
        () => "-",
    };
    // the rates come first; other inputs keep their values
    let rates = of("input").filter(|element| element.contains("indentation_rate\"")).count();
    let mut run = Command::new(host);
    run.arg(library).arg(attribute(description, "guid").expect("a unit has a GUID")).arg(rates.to_string());
    let output = run.arg(derivatives).args(outputs.take(40)).output().expect("the program was compiled");
    assert!(output.status.success(), "{what}: {}", output.status);
}

/// The scene of the FMU on which the program runs.
pub fn scene() -> PathBuf {
    unit::steel_ball_with_regime()
}

/// The program's arguments: the library of the FMU of [`scene`], its GUID, and four value references.
pub fn arguments() -> Vec<String> {
    let library = unit::library(&unit::compiled(&scene()));
    let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
    let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
    let guid = attribute(&description, "guid").expect("a unit has a GUID");
    let variables = ["indentation_rate", "force", "target.yield_strength", "regime"];
    let references = variables.map(|name| {
        let mut elements = description.split("<ScalarVariable").skip(1);
        let element = elements.find(|element| attribute(element, "name") == Some(name));
        let element = element.unwrap_or_else(|| panic!("the unit has no {name}"));
        attribute(element, "valueReference").expect("every variable has a reference")
    });
    let path = library.to_str().expect("a path of plain characters");
    [path, guid].into_iter().chain(references).map(str::to_string).collect()
}

/// Verifies the list of checks; returns their number.
#[track_caller]
pub fn assert_good(output: &Output) -> usize {
    let list = String::from_utf8_lossy(&output.stdout);
    let failed: Vec<_> = list.lines().filter(|line| !line.starts_with("ok ")).collect();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(failed.is_empty() && output.status.success(), "{}: {failed:#?}\n{errors}", output.status);
    list.lines().count()
}

/// Whether valgrind is installed; a message says if it isn't.
pub fn has_valgrind() -> bool {
    let has = Command::new("valgrind").arg("--version").output().is_ok();
    if !has {
        skips::skipped("the memory checker", "valgrind isn't installed (Debian and Ubuntu: apt install valgrind)");
    }
    has
}

/// valgrind with one of its tools, which fails where it finds something.
pub fn valgrind(tool: &str) -> Command {
    let mut valgrind = Command::new("valgrind");
    valgrind.arg(format!("--tool={tool}")).arg(format!("--error-exitcode={VALGRIND_ERROR}")).arg("--quiet");
    if tool == "memcheck" {
        valgrind.arg("--leak-check=full");
    }
    valgrind
}
