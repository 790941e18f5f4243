//! Messages about FMUs of thousands of contacts and about numbers of hundreds of digits: they stay short.

use crate::archive::{self, replaced};
use crate::command::{Run, empty_folder, run, scene};
use std::fs;
use std::path::Path;
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
fn a_long_word_or_line_of_a_scene_is_shortened() {
    let folder = empty_folder();
    let long = "x".repeat(100_000);
    let words = format!("radius = 5e-3\nsurface = \"{long}\"");
    for text in [
        format!("name = \"a\"\n{BODIES}[law]\nloading = \"{long}\"\n"),
        format!("name = \"a\"\n{BODIES}[fmu]\noutputs = [\"{long}\"]\n"),
        format!("name = \"a\"\n{long} = 1\n{BODIES}"),
        format!("name = \"a\"\n{}", BODIES.replace("radius = 5e-3", &words)),
        format!("name = \"a\"\n{}", BODIES.replace("5e-3", &format!("\"{long}\""))),
        format!("name = \"{long}é\"\n{BODIES}"),
    ] {
        fs::write(folder.path().join("a.toml"), text).unwrap();
        short(&run(folder.path(), ["export", "a.toml"]).with_status(1), &["a.toml:"]);
    }
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

/// Each contact has a gap of its own, and all of them are others in the XML.
#[test]
fn of_many_wrong_start_values_the_first_are_listed() {
    let folder = empty_folder();
    let text = format!(
        "name = \"row\"\n{BODIES}[[contact]]\nname = \"bead\"\ncount = 3000\ninitial_gap = 0.25\n\
         parameters_per_contact = [\"initial_gap\"]\n"
    );
    fs::write(folder.path().join("row.toml"), text).unwrap();
    run(folder.path(), ["export", "row.toml", "-o", "row.fmu"]).with_status(0);
    change_starts(folder.path());
    let refused = run(folder.path(), ["check", "wrong.fmu"]).with_status(1);
    assert!(refused.out.len() < 6000, "{} bytes: {}", refused.out.len(), refused.out);
    assert!(refused.out.contains("0.75 in the XML, 0.25 in the binary"), "{}", refused.out);
    assert!(refused.out.contains("and 2980 more (--json lists all)"), "{}", refused.out);
    let all = run(folder.path(), ["check", "wrong.fmu", "--json"]).with_status(1).json();
    assert_eq!(all["wrong_starts"].as_array().map(Vec::len), Some(3000));
}

/// Copies row.fmu to wrong.fmu with other gaps in the XML.
fn change_starts(folder: &Path) {
    archive::changed(&folder.join("row.fmu"), &folder.join("wrong.fmu"), |name, bytes| {
        let is_description = name.ends_with(".xml");
        Some(if is_description { replaced(&bytes, b"start=\"0.25\"", b"start=\"0.75\"") } else { bytes })
    });
}
