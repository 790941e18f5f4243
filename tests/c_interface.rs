//! The FMU called by a C program that is compiled against the standard's headers: see `tests/c/driver.c`.
//!
//! Misuse by a C importer, and guarantees to it, are best tested in C. This file compiles the program, runs it on the FMU of
//! the default scene, and reads its list of checks.
#![cfg(all(target_os = "linux", target_env = "gnu"))]

#[path = "support/python.rs"]
mod python;
#[path = "support/skips.rs"]
mod skips;
#[path = "support/unit.rs"]
mod unit;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

/// The files of the program.
const SOURCES: [&str; 5] = ["driver.c", "null_pointers.c", "instances.c", "memory.c", "counting.c"];

/// Least number of checks by the program: fewer would mean that it ended early, or that a part is not called.
const CHECKS: usize = 130;

/// Number of those that count allocations.
const COUNTS: usize = 8;

/// The exit status of valgrind for its own errors.
const VALGRIND_ERROR: i32 = 9;

/// The folder of the standard's headers, which are part of fmpy.
fn headers() -> String {
    let program = "import fmpy, os; print(os.path.join(os.path.dirname(fmpy.__file__), 'c-code'))";
    let output = Command::new(python::python()).args(["-c", program]).output().expect("python can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).trim().into()
}

/// Compiles the program as `name` with additional `options`.
fn compile(name: &str, options: &[&str]) -> PathBuf {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c");
    let mut compiler = Command::new("cc");
    compiler.args(["-std=c11", "-D_POSIX_C_SOURCE=200809L", "-O1", "-g", "-Wall", "-Wextra", "-Werror", "-pthread"]);
    // the compiler must not replace functions of the program by its knowledge of calloc and free
    compiler.args(["-rdynamic", "-fno-builtin-malloc", "-fno-builtin-calloc", "-fno-builtin-free", "-I"]);
    compiler.arg(headers()).args(options).arg("-o").arg(&program);
    compiler.args(SOURCES.map(|source| folder.join(source))).args(["-ldl", "-lm"]);
    let output = compiler.output().expect("there is a C compiler");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    program
}

/// The program's arguments: the library, its GUID, and four value references.
static ARGUMENTS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let library = unit::library(&unit::export(&unit::steel_ball_with_regime()));
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
});

fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    element.split_once(&format!(" {name}=\""))?.1.split('"').next()
}

/// Verifies the list of checks; returns their number.
#[track_caller]
fn assert_good(output: &Output) -> usize {
    let list = String::from_utf8_lossy(&output.stdout);
    let failed: Vec<_> = list.lines().filter(|line| !line.starts_with("ok ")).collect();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(failed.is_empty() && output.status.success(), "{}: {failed:#?}\n{errors}", output.status);
    list.lines().count()
}

#[test]
fn a_c_program_finds_everything_in_order() {
    let program = compile("driver", &[]);
    let output = Command::new(program).args(&*ARGUMENTS).output().expect("the program was compiled");
    let checks = assert_good(&output);
    assert!(checks >= CHECKS, "only {checks} checks:\n{}", String::from_utf8_lossy(&output.stdout));
    let counts = String::from_utf8_lossy(&output.stdout).lines().filter(|line| line.contains("memory")).count();
    assert!(counts >= COUNTS, "allocations were not counted");
}

#[test]
fn valgrind_finds_no_wrong_access_and_no_leak() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        return skips::skipped("the C program under valgrind", "there is no valgrind");
    }
    let program = compile("driver-for-valgrind", &["-DNO_COUNTING"]);
    let mut valgrind = Command::new("valgrind");
    valgrind.arg(format!("--error-exitcode={VALGRIND_ERROR}")).args(["--leak-check=full", "--quiet"]);
    let output = valgrind.arg(program).args(&*ARGUMENTS).output().expect("valgrind is there");
    let checks = assert_good(&output);
    assert!(checks >= CHECKS - 2 * COUNTS, "only {checks} checks:\n{}", String::from_utf8_lossy(&output.stdout));
}

/// Every scene of the project, each rate-dependent law, and a law without segments, with every output, in a host that traps.
#[test]
fn a_host_that_traps_floating_point_exceptions_survives_every_kind_of_fmu() {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("exceptions");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c/exceptions.c");
    let mut compiler = Command::new("cc");
    compiler.args(["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror", "-I"]).arg(headers()).arg(source);
    let output = compiler.arg("-o").arg(&program).args(["-ldl", "-lm"]).output().expect("there is a C compiler");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bodies = "impactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n";
    let momentum = "\"indentation\", \"stiffness\", \"mean_pressure\", \"elastic_energy\", \"dissipated_energy\", \
                    \"impulse\", \"mean_force\", \"predicted_force\"";
    let mut scenes = unit::scenes();
    for law in ["hunt-crossley", "kelvin-voigt", "tsuji", "kuwabara-kono", "adams-impact", "jackson-green"] {
        let asked = ["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&law);
        let restitution = if asked { "restitution = 0.7\n" } else { "" };
        let text = format!(
            "name = \"trapped\"\n{bodies}law = {{ loading = \"{law}\" }}\nfmu = {{ outputs = [{momentum}] }}\n\
             impact = {{ mass = 4e-3, speed = 1.0 }}\n"
        );
        let text = text.replace("law = {", &format!("law = {{ {}", restitution.trim().replace("0.7", "0.7,")));
        scenes.push(unit::write_scene(&format!("trapped_{}", law.replace('-', "_")), &text));
    }
    for scene in scenes {
        let library = unit::library(&unit::export(&scene));
        let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
        let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
        let elements = || description.split("<ScalarVariable").skip(1);
        let of = |causality: &'static str| {
            elements().filter(move |element| attribute(element, "causality") == Some(causality))
        };
        let outputs = of("output").filter(|element| element.contains("<Real"));
        let outputs = outputs.filter_map(|element| attribute(element, "valueReference").map(str::to_string));
        let derivatives = description.contains("canInterpolateInputs=\"true\"");
        let mut run = Command::new(&program);
        // the rates come first; other inputs keep their values
        let rates = of("input").filter(|element| element.contains("indentation_rate\"")).count();
        run.arg(&library).arg(attribute(&description, "guid").unwrap()).arg(rates.to_string());
        run.arg(if derivatives { "d" } else { "-" }).args(outputs.take(40));
        let output = run.output().expect("the program was compiled");
        assert!(output.status.success(), "{}: {}", scene.display(), output.status);
    }
}

/// The program must be able to fail: here its arguments do not match the library.
#[test]
fn the_c_program_fails_for_a_wrong_guid_and_a_wrong_reference() {
    let program = compile("driver-that-fails", &[]);
    for (place, wrong) in [(1, "another"), (3, "1000000"), (2, "1")] {
        let mut arguments = ARGUMENTS.clone();
        arguments[place] = wrong.into();
        let output = Command::new(&program).args(arguments).output().expect("the program was compiled");
        assert!(!output.status.success(), "argument {place} = {wrong}");
        assert!(String::from_utf8_lossy(&output.stdout).contains("FAIL "), "argument {place} = {wrong}");
    }
}
