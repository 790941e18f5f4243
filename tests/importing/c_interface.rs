//! The FMU called by a C program that is compiled against the standard's headers: see `tests/c/driver.c`.
//!
//! Misuse by a C importer, and guarantees to it, are best tested in C. This file compiles the program, runs it on the FMU of
//! the default scene, and reads its list of checks.
#![cfg(all(target_os = "linux", target_env = "gnu"))]

use crate::prebuilt;
use crate::unit;
use brinell_testing::driver::{
    arguments, assert_good, assert_never_trapped, compile, compile_one, has_valgrind, valgrind,
};
use brinell_testing::kinds::of_each_kind;
use brinell_testing::long::{self, some};
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Least number of checks by the program: fewer would mean that it ended early, or that a part is not called.
const CHECKS: usize = 25;

/// Number of those that count allocations.
const COUNTS: usize = 8;

#[test]
fn a_c_program_finds_everything_in_order() {
    let program = compile("driver", &[]);
    let output = Command::new(program).args(arguments()).output().expect("the program was compiled");
    let checks = assert_good(&output);
    assert!(checks >= CHECKS, "only {checks} checks:\n{}", String::from_utf8_lossy(&output.stdout));
    let counts = String::from_utf8_lossy(&output.stdout).lines().filter(|line| line.contains("memory")).count();
    assert!(counts >= COUNTS, "allocations were not counted");
}

#[test]
fn valgrind_finds_no_wrong_access_and_no_leak() {
    if !has_valgrind() {
        return;
    }
    let program = compile("driver-for-valgrind", &["-DNO_COUNTING"]);
    let output = valgrind("memcheck").arg(program).args(arguments()).output().expect("valgrind is there");
    let checks = assert_good(&output);
    assert!(checks >= CHECKS - 2 * COUNTS, "only {checks} checks:\n{}", String::from_utf8_lossy(&output.stdout));
}

const MOMENTUM: &str = "\"indentation\", \"stiffness\", \"mean_pressure\", \"elastic_energy\", \"dissipated_energy\", \
                        \"impulse\", \"mean_force\", \"predicted_force\", \"work\"";

/// A scene with each loss below yield.
fn losses() -> [PathBuf; 3] {
    let kinds = [
        ("", ", elastic_restitution = 0.9"),
        ("", ", elastic_restitution = \"waves\""),
        (", plate_thickness = 0.01", ""),
    ];
    kinds.map(|(target, law)| {
        let text = format!(
            "name = \"lossy\"\nimpactor = {{ radius = 5e-3 }}\ntarget = {{ material = \"mild steel\"{target} }}\n\
             law = {{ loading = \"brinell\"{law} }}\nfmu = {{ outputs = [{MOMENTUM}] }}\n\
             impact = {{ mass = 4e-3, speed = 1.0 }}\n"
        );
        unit::write_scene("lossy", &text)
    })
}

/// Every scene of the project, each rate-dependent law, each loss, and a law without segments, with every output, compiled and from
/// prebuilt libraries, and every kind of these, in a host that traps.
#[test]
fn a_host_that_traps_floating_point_exceptions_survives_every_kind_of_fmu() {
    let host = compile_one("exceptions");
    let bodies = "impactor = { radius = 5e-3 }\ntarget = { material = \"mild steel\" }\n";
    let mut scenes = unit::scenes();
    scenes.extend(losses());
    for law in ["hunt-crossley", "kelvin-voigt", "tsuji", "kuwabara-kono", "adams-impact", "jackson-green"] {
        let asked = ["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&law);
        let restitution = if asked { "restitution = 0.7\n" } else { "" };
        let text = format!(
            "name = \"trapped\"\n{bodies}law = {{ loading = \"{law}\" }}\nfmu = {{ outputs = [{MOMENTUM}] }}\n\
             impact = {{ mass = 4e-3, speed = 1.0 }}\n"
        );
        let text = text.replace("law = {", &format!("law = {{ {}", restitution.trim().replace("0.7", "0.7,")));
        scenes.push(unit::write_scene(&format!("trapped_{}", law.replace('-', "_")), &text));
    }
    let texts = scenes.iter().map(|scene| fs::read_to_string(scene).expect("a scene"));
    let prebuilt = texts.chain(of_each_kind().into_iter().map(|(_, text)| text));
    // the suite of conformance has traps too
    let compiled = if long::is_asked() { scenes.clone() } else { unit::scenes_to_compile() };
    let compiled: Vec<PathBuf> = compiled.iter().map(|scene| unit::compiled(scene)).collect();
    let prebuilt = some(prebuilt, 3).map(|text| prebuilt::export(&text, Some(prebuilt::store())));
    for fmu in compiled.into_iter().chain(prebuilt) {
        let library = unit::library(&fmu);
        let root = library.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
        let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
        assert_never_trapped(&host, &library, &description, &fmu.display().to_string());
    }
}

/// The program must be able to fail: here its arguments do not match the library.
#[test]
fn the_c_program_fails_for_a_wrong_guid_and_a_wrong_reference() {
    let program = compile("driver-that-fails", &[]);
    for (place, wrong) in [(1, "another"), (3, "1000000"), (2, "1")] {
        let mut wrong_ones = arguments();
        wrong_ones[place] = wrong.into();
        let output = Command::new(&program).args(wrong_ones).output().expect("the program was compiled");
        assert!(!output.status.success(), "argument {place} = {wrong}");
        assert!(String::from_utf8_lossy(&output.stdout).contains("FAIL "), "argument {place} = {wrong}");
    }
}
