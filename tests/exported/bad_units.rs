//! `brinell check` on files that are not FMUs and on modified FMUs: it ends with status 1 and an error message.
#![cfg(target_os = "linux")]

use crate::command::{Run, empty_folder, run};
use crate::unit;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Copies an FMU member by member. `change` is a Python expression of `name` and `data`; None removes the member.
const REPACK: &str = "
import sys, zipfile
source, goal, change = sys.argv[1:]
with zipfile.ZipFile(source) as old, zipfile.ZipFile(goal, 'w', zipfile.ZIP_DEFLATED) as new:
    for name in old.namelist():
        data = eval(change, {'name': name, 'data': old.read(name)})
        if data is not None:
            new.writestr(name, data)
";

/// The FMU of the default scene, modified.
fn changed(change: &str) -> TempDir {
    let folder = empty_folder();
    let source = unit::export(&unit::scene("steel_ball"));
    let mut python = Command::new("python3");
    python.args(["-c", REPACK]).arg(&source).arg(folder.path().join("unit.fmu")).arg(change);
    let output = python.output().expect("python3 is there");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

/// The run of `check` on `unit.fmu` in `folder`, which must fail.
#[track_caller]
fn refused(folder: &Path) -> Run {
    let run = run(folder, ["check", "unit.fmu"]).with_status(1);
    assert!(!run.err.contains("panicked"), "{run:#?}");
    run
}

/// The message about an FMU that cannot be loaded. It begins with the path of the FMU, and there are no results.
#[track_caller]
fn message(folder: &TempDir) -> String {
    let run = refused(folder.path());
    assert!(run.err.starts_with("brinell: unit.fmu: ") && run.out.is_empty(), "{run:#?}");
    run.err
}

#[track_caller]
fn contains(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "nothing of {part:?} in: {message}");
    }
}

/// Otherwise the tests below could fail just because of the repacking.
#[test]
fn an_fmu_packed_again_without_change_is_still_good() {
    run(changed("data").path(), ["check", "unit.fmu"]).with_status(0);
}

#[test]
fn a_missing_file_is_named_once() {
    let message = message(&empty_folder());
    contains(&message, &["No such file"]);
    assert_eq!(message.matches("unit.fmu").count(), 1, "{message}");
}

#[test]
fn a_text_file_is_no_archive() {
    let folder = empty_folder();
    fs::write(folder.path().join("unit.fmu"), "a text").unwrap();
    contains(&message(&folder), &["no zip archive"]);
}

#[test]
fn an_empty_file_is_no_archive() {
    let folder = empty_folder();
    fs::write(folder.path().join("unit.fmu"), "").unwrap();
    contains(&message(&folder), &["no zip archive"]);
}

#[test]
fn half_an_fmu_is_not_an_archive() {
    let folder = changed("data");
    let path = folder.path().join("unit.fmu");
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    contains(&message(&folder), &["no zip archive"]);
}

#[test]
fn an_archive_without_model_description_is_not_an_fmu() {
    contains(&message(&changed("data if name == 'model.png' else None")), &["modelDescription.xml"]);
}

#[test]
fn a_model_description_that_is_not_xml_is_refused() {
    let change = "b'<fmiModelDescription' if name == 'modelDescription.xml' else data";
    contains(&message(&changed(change)), &["modelDescription.xml can't be read"]);
}

/// Control characters and the two non-characters, literally and as references: other XML parsers reject them.
#[test]
fn a_character_that_xml_cannot_have_is_reported_with_its_place() {
    let description = "description=\"5 mm steel ball on a mild-steel block";
    for (bytes, said) in
        [("\\x01", "U+0001"), ("\\x0b", "U+000B"), ("\\xef\\xbf\\xbe", "U+FFFE"), ("\\xef\\xbf\\xbf", "U+FFFF")]
    {
        let change =
            format!("data.replace(b'{description}', b'{description}{bytes}') if name.endswith('.xml') else data");
        contains(&message(&changed(&change)), &["modelDescription.xml can't be read", said, " at 2:"]);
    }
    for reference in ["&#1;", "&#x1F;", "&#xFFFE;", "&#65535;"] {
        let attribute =
            format!("data.replace(b'{description}', b'{description}{reference}') if name.endswith('.xml') else data");
        contains(&message(&changed(&attribute)), &["modelDescription.xml can't be read", "U+", "steel ball"]);
        let text = format!(
            "data.replace(b'<LogCategories>', b'<LogCategories>{reference}') if name.endswith('.xml') else data"
        );
        contains(&message(&changed(&text)), &["modelDescription.xml can't be read", "U+"]);
    }
}

/// There is a folder for each platform; without any, the message must still be a complete sentence.
#[test]
fn an_fmu_without_library_says_so() {
    let message = message(&changed("None if name.startswith('binaries/') else data"));
    contains(&message, &["no binary for this platform", "64"]);
    assert!(!message.trim_end().ends_with("there is"), "{message}");
}

#[test]
fn an_fmu_for_another_platform_says_for_which() {
    let folder = empty_folder();
    let source = unit::export(&unit::scene("steel_ball"));
    let move_binary = "
import sys, zipfile
with zipfile.ZipFile(sys.argv[1]) as old, zipfile.ZipFile(sys.argv[2], 'w') as new:
    for name in old.namelist():
        parts = name.split('/')
        if parts[0] == 'binaries':
            parts[1] = 'commodore64'
        new.writestr('/'.join(parts), old.read(name))
";
    let mut python = Command::new("python3");
    python.args(["-c", move_binary]).arg(source).arg(folder.path().join("unit.fmu"));
    assert!(python.status().expect("python3 is there").success());
    contains(&message(&folder), &["no binary for this platform", "commodore64"]);
}

/// What the model description says of an FMU that this program can't load.
#[test]
fn a_model_description_of_another_kind_of_unit_is_refused_with_the_reason() {
    for (from, to, said) in [
        ("fmiVersion=\"2.0\"", "fmiVersion=\"3.0\"", &["fmiVersion", "3.0"][..]),
        ("CoSimulation", "ModelExchange", &["CoSimulation", "co-simulation"]),
        ("modelIdentifier=\"steel_ball\"", "modelIdentifier=\"other\"", &["binaries/linux64", "other.so"]),
        ("modelIdentifier=\"steel_ball\"", "modelIdentifier=\"/tmp/steel_ball\"", &["/tmp/steel_ball", "no name"]),
        ("modelIdentifier=\"steel_ball\"", "modelIdentifier=\"../linux64/steel_ball\"", &["no name of a library"]),
    ] {
        let change = format!("data.replace(b'{from}', b'{to}') if name.endswith('.xml') else data");
        contains(&message(&changed(&change)), said);
    }
}

#[test]
fn a_wrong_number_in_the_model_description_is_told_with_its_variable() {
    for (from, to, said) in [
        ("start=\"0.005\"", "start=\"5 mm\"", &["impactor.radius", "start", "5 mm"][..]),
        ("valueReference=\"0\"", "valueReference=\"-1\"", &["indentation_rate", "valueReference", "-1"]),
    ] {
        let change = format!("data.replace(b'{from}', b'{to}') if name.endswith('.xml') else data");
        contains(&message(&changed(&change)), said);
    }
    // white space around a number is allowed
    let change = "data.replace(b'start=\"0.005\"', b'start=\" 0.005 \"') if name.endswith('.xml') else data";
    run(changed(change).path(), ["check", "unit.fmu"]).with_status(0);
}

#[test]
fn a_scene_that_is_not_utf_8_is_not_a_missing_one() {
    contains(&message(&changed("b'\\xe4' + data if name.endswith('scene.toml') else data")), &["scene.toml", "UTF-8"]);
}

/// Each empty file takes a place in the file system.
#[test]
fn an_archive_with_a_million_files_is_not_unpacked() {
    let folder = empty_folder();
    let make = "
import sys, zipfile
with zipfile.ZipFile(sys.argv[1], 'w') as new:
    for number in range(100001):
        new.writestr(f'resources/{number}', '')
";
    let mut python = Command::new("python3");
    assert!(
        python.args(["-c", make]).arg(folder.path().join("unit.fmu")).status().expect("python3 is there").success()
    );
    contains(&message(&folder), &["more than 100000 files"]);
}

#[test]
fn a_library_of_garbage_is_refused() {
    let message = message(&changed("b'garbage' * 1000 if name.endswith('.so') else data"));
    contains(&message, &["the library can't be loaded", "steel_ball.so"]);
}

#[test]
fn a_library_without_the_functions_is_refused_with_the_missing_name() {
    let change = "data.replace(b'fmi2DoStep', b'fmi2DoStop') if name.endswith('.so') else data";
    contains(&message(&changed(change)), &["fmi2DoStep"]);
}

#[test]
fn a_guid_other_than_the_librarys_is_refused() {
    let change =
        "__import__('re').sub(rb'guid=\"[^\"]*\"', b'guid=\"another\"', data) if name.endswith('.xml') else data";
    contains(&message(&changed(change)), &["fmi2Instantiate", "fmuGUID", "modelDescription.xml"]);
}

/// The start values are compiled into the library: a change in the XML does not change the simulation.
#[test]
fn a_start_value_changed_in_the_xml_is_reported_with_both_numbers() {
    let change = "data.replace(b'start=\"0.005\"', b'start=\"0.006\"') if name.endswith('.xml') else data";
    let run = refused(changed(change).path());
    contains(&run.out, &["impactor.radius", "0.006 in the XML", "0.005 in the binary"]);
}

#[test]
fn a_start_value_changed_by_its_last_bit_is_reported() {
    let change =
        "data.replace(b'start=\"0.005\"', b'start=\"0.0050000000000000010\"') if name.endswith('.xml') else data";
    contains(&refused(changed(change).path()).out, &["impactor.radius", "0.005 in the binary"]);
}

#[test]
fn a_wrong_start_value_is_in_the_json_too() {
    let folder = changed("data.replace(b'start=\"0.005\"', b'start=\"0.006\"') if name.endswith('.xml') else data");
    let outcome = run(folder.path(), ["check", "unit.fmu", "--json"]).with_status(1).json();
    assert_eq!(outcome["passed"], false);
    assert_eq!(outcome["wrong_starts"].as_array().map(Vec::len), Some(1), "{outcome}");
}

/// The numbers of the impact come from the scene, those of the simulation from the library.
#[test]
fn a_scene_other_than_the_librarys_does_not_agree() {
    let change = "data.replace(b'unloading = \"contact-radius\"', b'unloading = \"hertz-shift\"') if name.endswith('.toml') else data";
    let run = refused(changed(change).path());
    contains(&run.out, &["NO AGREEMENT"]);
}

#[test]
fn an_fmu_without_scene_says_that_there_is_no_impact_to_run() {
    contains(&message(&changed("None if name.endswith('scene.toml') else data")), &["resources/scene.toml"]);
}

#[test]
fn a_scene_damaged_in_the_archive_is_refused_with_its_place() {
    let change = "b'name = 1' if name.endswith('scene.toml') else data";
    contains(&message(&changed(change)), &["resources/scene.toml:1:8", "text in quotes"]);
}
