//! Messages about FMUs of thousands of contacts and about numbers of hundreds of digits: they stay short.

use crate::command::{Run, empty_folder, run, scene};
use std::fs;
use tempfile::TempDir;

const BODIES: &str = "[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n";

/// A folder with the scene of 2000 contacts that have their own strengths, with these lines of `[fmu]`.
fn two_thousand(fmu: &str) -> TempDir {
    let folder = empty_folder();
    let contact = |index| format!("[[contact]]\nname = \"bead_{index}\"\ntarget.yield_strength = {index}e6\n");
    let contacts: String = (1..=2000).map(contact).collect();
    let text = format!("name = \"beads\"\n{BODIES}[fmu]\n{fmu}\n{contacts}");
    fs::write(folder.path().join("beads.toml"), text).unwrap();
    folder
}

/// The message of a failed run, which must be short and contain `parts`.
#[track_caller]
fn short(run: &Run, parts: &[&str]) {
    assert_ne!(run.status, Some(0), "{run:#?}");
    let said = format!("{}{}", run.out, run.err);
    assert!(said.len() < 1500, "{} bytes: {said}", said.len());
    for part in parts {
        assert!(said.contains(part), "nothing of {part:?} in: {said}");
    }
    let digits = said.split(|c: char| !c.is_ascii_digit()).map(str::len).max();
    assert!(digits < Some(30), "a number of {digits:?} digits: {said}");
}

#[test]
fn a_typo_among_two_thousand_contacts_is_told_with_the_nearest_names() {
    let folder = two_thousand("parameters = [\"bead_777.target.yeild_strength\"]");
    let refused = run(folder.path(), ["export", "beads.toml"]).with_status(1);
    let meant = "did you mean `bead_777.target.yield_strength`?";
    short(&refused, &["unknown parameter `bead_777.target.yeild_strength`", meant, "the nearest of 20"]);
}

#[test]
fn a_wrong_connection_among_two_thousand_contacts_is_told_with_the_nearest_names() {
    let folder = two_thousand("");
    run(folder.path(), ["export", &scene("steel_ball").display().to_string(), "-o", "other.fmu"]).with_status(0);
    let connection = "contact.bead_1234.forse=other.indentation_rate";
    let refused =
        run(folder.path(), ["ssp", "beads.toml", "--with", "other.fmu", "--connect", connection]).with_status(2);
    short(&refused, &["no output `bead_1234.forse` of type Real", "bead_1234.force", "and 1980 more"]);
}

#[test]
fn numbers_of_three_hundred_digits_are_written_with_a_power_of_ten() {
    let folder = empty_folder();
    let ball = scene("steel_ball").display().to_string();
    for (option, value) in [("--mass", "1e300"), ("--speed", "1e300"), ("--energy", "-1e300"), ("--speed", "-1e-300")] {
        let arguments = ["predict", &ball, &format!("{option}={value}")];
        let said = run(folder.path(), arguments);
        if said.status == Some(0) {
            assert!(!said.out.contains(&"0".repeat(30)), "{option} {value}: {said:#?}");
        } else {
            short(&said, &["e"]);
        }
    }
    for radius in ["1e300", "-1e300", "1e-300", "1e308"] {
        let text = format!("name = \"a\"\n{}", BODIES.replace("5e-3", radius));
        fs::write(folder.path().join("a.toml"), text).unwrap();
        short(&run(folder.path(), ["export", "a.toml"]).with_status(1), &["a.toml:3:", radius]);
    }
}
