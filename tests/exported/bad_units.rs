//! `brinell check` on files that are not FMUs and on modified FMUs: it ends with status 1 and an error message.

use crate::archive::{self, replaced};
use crate::command::{Run, contents, empty_folder, missing, run};
use crate::hostile::{Seen, write_all};
use crate::unit;
use std::env::consts::DLL_SUFFIX;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// The FMU of the default scene; `change` gives each of its files new bytes, or leaves it out.
fn changed(change: impl FnMut(&str, Vec<u8>) -> Option<Vec<u8>>) -> TempDir {
    let folder = empty_folder();
    archive::changed(&unit::export(&unit::scene("steel_ball")), &folder.path().join("unit.fmu"), change);
    folder
}

/// The same with `new` in place of `old` in the files whose names have this `ending`.
fn with(ending: &str, old: &str, new: impl AsRef<[u8]>) -> TempDir {
    changed(|name, bytes| {
        Some(if name.ends_with(ending) { replaced(&bytes, old.as_bytes(), new.as_ref()) } else { bytes })
    })
}

/// The same with `text` as the file `name`.
fn with_text(name: &str, text: &str) -> TempDir {
    changed(|other, bytes| Some(if other == name { text.into() } else { bytes }))
}

fn is_library(name: &str) -> bool {
    name.starts_with("binaries/")
}

/// The text of an FMU's scene.
const SCENE: &str = "resources/scene.toml";

/// Ending of the model description.
const XML: &str = ".xml";

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

#[test]
fn a_missing_file_is_named_once() {
    let message = message(&empty_folder());
    contains(&message, &[&*missing()]);
    assert_eq!(message.matches("unit.fmu").count(), 1, "{message}");
}

/// A folder with a file of these bytes as `unit.fmu`.
fn with_file(bytes: impl AsRef<[u8]>) -> TempDir {
    let folder = empty_folder();
    fs::write(folder.path().join("unit.fmu"), bytes).unwrap();
    folder
}

#[test]
fn what_is_no_fmu_of_this_kind_is_refused_with_the_reason() {
    let good = fs::read(unit::export(&unit::scene("steel_ball"))).unwrap();
    let many = empty_folder();
    // each empty file takes a place in the file system
    archive::write(&many.path().join("unit.fmu"), (0..=100_000).map(|number| (format!("resources/{number}"), [])));
    let garbage = |name: &str, bytes| Some(if is_library(name) { b"garbage".repeat(1000) } else { bytes });
    let library = format!("steel_ball{DLL_SUFFIX}");
    let name = "modelIdentifier=\"steel_ball\"";
    let description = archive::text(&unit::export(&unit::scene("steel_ball")), "modelDescription.xml");
    let guid = description
        .split("guid=\"")
        .nth(1)
        .and_then(|rest| rest.split('"').next())
        .expect("an FMU has one")
        .to_string();
    for (folder, parts) in [
        (with_file("a text"), &["no zip archive"][..]),
        (with_file(""), &["no zip archive"]),
        (with_file(&good[..good.len() / 2]), &["no zip archive"]),
        (many, &["more than 100000 files"]),
        (changed(|name, bytes| (name == "model.png").then_some(bytes)), &["modelDescription.xml"]),
        (with_text("modelDescription.xml", "<fmiModelDescription"), &["modelDescription.xml can't be read"]),
        (with(XML, "fmiVersion=\"2.0\"", "fmiVersion=\"3.0\""), &["fmiVersion", "3.0"]),
        (with(XML, "CoSimulation", "ModelExchange"), &["CoSimulation", "co-simulation"]),
        (with(XML, name, "modelIdentifier=\"other\""), &["binaries", &format!("other{DLL_SUFFIX}")]),
        (with(XML, name, "modelIdentifier=\"/tmp/steel_ball\""), &["/tmp/steel_ball", "no name"]),
        (with(XML, name, "modelIdentifier=\"../linux64/steel_ball\""), &["no name of a library"]),
        (changed(garbage), &[&library, " can't be loaded: "]),
        (with(DLL_SUFFIX, "fmi2DoStep", "fmi2DoStop"), &["fmi2DoStep"]),
        (with(SCENE, "name", b"\xe4"), &["scene.toml", "UTF-8"]),
        (changed(|name, bytes| (name != SCENE).then_some(bytes)), &["resources/scene.toml"]),
        (with_text(SCENE, "name = 1"), &["resources/scene.toml:1:8", "text in quotes"]),
        (with(XML, "start=\"0.005\"", "start=\"5 mm\""), &["impactor.radius", "start", "5 mm"]),
        (with(XML, "valueReference=\"0\"", "valueReference=\"-1\""), &["indentation_rate", "valueReference", "-1"]),
        (with(XML, &guid, "another"), &["fmi2Instantiate", "fmuGUID", "modelDescription.xml"]),
    ] {
        contains(&message(&folder), parts);
    }
}

/// The start values are compiled into the library: a change in the XML does not change the simulation.
#[test]
fn a_start_value_changed_in_the_xml_is_reported_with_both_numbers() {
    let folder = with(XML, "start=\"0.005\"", "start=\"0.006\"");
    contains(&refused(folder.path()).out, &["impactor.radius", "0.006 in the XML", "0.005 in the binary"]);
    let outcome = run(folder.path(), ["check", "unit.fmu", "--json"]).with_status(1).json();
    assert_eq!((&outcome["passed"], outcome["wrong_starts"].as_array().map(Vec::len)), (&false.into(), Some(1)));
    // by its last bit
    let folder = with(XML, "start=\"0.005\"", "start=\"0.0050000000000000010\"");
    contains(&refused(folder.path()).out, &["impactor.radius", "0.005 in the binary"]);
}

/// Control characters and the two non-characters, literally and as references: other XML parsers reject them.
#[test]
fn a_character_that_xml_cannot_have_is_reported_with_its_place() {
    let description = "description=\"5 mm steel ball on a mild-steel block";
    for (character, said) in [("\u{1}", "U+0001"), ("\u{b}", "U+000B"), ("\u{fffe}", "U+FFFE"), ("\u{ffff}", "U+FFFF")]
    {
        let folder = with(XML, description, format!("{description}{character}"));
        contains(&message(&folder), &["modelDescription.xml can't be read", said, " at 2:"]);
    }
    for reference in ["&#1;", "&#x1F;", "&#xFFFE;", "&#65535;"] {
        let attribute = with(XML, description, format!("{description}{reference}"));
        contains(&message(&attribute), &["modelDescription.xml can't be read", "U+", "steel ball"]);
        let text = with(XML, "<LogCategories>", format!("<LogCategories>{reference}"));
        contains(&message(&text), &["modelDescription.xml can't be read", "U+"]);
    }
}

/// There is a folder for each platform; without any, the message must still be a complete sentence.
#[test]
fn an_fmu_without_library_or_for_another_platform_says_so() {
    let message_of_none = message(&changed(|name, bytes| (!is_library(name)).then_some(bytes)));
    contains(&message_of_none, &["no binary for this platform", "64"]);
    assert!(!message_of_none.trim_end().ends_with("there is"), "{message_of_none}");
    let folder = empty_folder();
    let source = unit::export(&unit::scene("steel_ball"));
    let moved = archive::files(&source).into_iter().map(|(name, bytes)| match name.strip_prefix("binaries/") {
        Some(rest) => (format!("binaries/commodore64/{}", rest.rsplit('/').next().expect("a name")), bytes),
        None => (name, bytes),
    });
    archive::write(&folder.path().join("unit.fmu"), moved);
    contains(&message(&folder), &["no binary for this platform", "commodore64"]);
}

/// What is packed again without a change is good; white space around a number is allowed.
#[test]
fn an_fmu_of_another_form_is_still_good() {
    run(changed(|_, bytes| Some(bytes)).path(), ["check", "unit.fmu"]).with_status(0);
    run(with(XML, "start=\"0.005\"", "start=\" 0.005 \"").path(), ["check", "unit.fmu"]).with_status(0);
}

/// Nothing is written outside, nothing grows beyond what is allowed, and each command that sees what is wrong says it.
#[test]
fn a_hostile_fmu_is_refused_by_every_command_that_reads_it() {
    let folder = empty_folder();
    let good = unit::export(&unit::scene("steel_ball"));
    let scene = unit::scene("steel_ball").display().to_string();
    let all = write_all(&good, folder.path());
    let before = contents(folder.path());
    for (path, hostile) in &all {
        let name = path.file_name().unwrap().to_str().unwrap();
        let calls = [
            (vec!["check", name], true),
            (
                vec!["ssp", &scene, "--with", name, "-o", "out.ssp"],
                matches!(hostile.seen, Seen::InArchive | Seen::InDescription),
            ),
            (vec!["predict", name], hostile.seen == Seen::InArchive && hostile.bytes.starts_with(b"PK\x03\x04")),
            (vec!["si", name], hostile.seen == Seen::InArchive && hostile.bytes.starts_with(b"PK\x03\x04")),
        ];
        for (call, _) in calls.iter().filter(|(_, sees)| *sees) {
            let said = run(folder.path(), call).with_status(1).err;
            assert!(said.contains(name) && said.contains(hostile.said), "{}: {call:?}: {said}", hostile.name);
        }
    }
    assert_eq!(contents(folder.path()), before, "something was written");
    assert!(all.len() > 25, "{}", all.len());
}

/// It would be read into memory by some commands, and takes no place on the disk.
#[test]
fn a_file_that_is_larger_than_any_fmu_is_not_read() {
    let folder = empty_folder();
    fs::File::create(folder.path().join("unit.fmu")).unwrap().set_len(10_000_000_000_000).unwrap();
    let scene = unit::scene("steel_ball").display().to_string();
    for call in [&["check", "unit.fmu"][..], &["ssp", &scene, "--with", "unit.fmu", "-o", "out.ssp"]] {
        let said = run(folder.path(), call).with_status(1).err;
        assert!(said.contains("unit.fmu: it has 10000000 MB; allowed for an FMU is 2000 MB"), "{call:?}: {said}");
    }
}

/// The numbers of the impact come from the scene, those of the simulation from the library.
#[test]
fn a_scene_other_than_the_librarys_does_not_agree() {
    let run = refused(with(SCENE, "unloading = \"contact-radius\"", "unloading = \"hertz-shift\"").path());
    contains(&run.out, &["NO AGREEMENT"]);
}
