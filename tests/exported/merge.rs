//! `brinell merge`: FMUs of one scene are joined, others are rejected.

use crate::archive::{self, replaced};
use crate::command::{self, Run, contents, empty_folder, missing, run};
use crate::unit;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The files of an FMU by name.
type Files = BTreeMap<String, Vec<u8>>;

/// Writes a copy of the FMU at `from` with changed files to `to`.
fn changed(from: &Path, to: &Path, change: impl FnOnce(&mut Files)) {
    let mut files = archive::files(from).into_iter().collect();
    change(&mut files);
    archive::write(to, files);
}

/// The result of `merge` for the FMU of the default scene, `a.fmu`, and a modified copy of it, `b.fmu`.
fn merge(change: impl FnOnce(&mut Files)) -> (Run, Vec<String>) {
    let folder = empty_folder();
    let [a, b] = ["a.fmu", "b.fmu"].map(|name| folder.path().join(name));
    fs::copy(unit::export(&unit::scene("steel_ball")), &a).unwrap();
    changed(&a, &b, change);
    let said = run(folder.path(), ["merge", "a.fmu", "b.fmu", "-o", "c.fmu"]);
    (said, contents(folder.path()))
}

#[track_caller]
fn assert_refused(change: impl FnOnce(&mut Files), parts: &[&str]) {
    let (said, left) = merge(change);
    let said = said.with_status(1);
    for part in ["a.fmu", "b.fmu"].iter().chain(parts) {
        assert!(said.err.contains(part), "no {part:?} in {said:#?}");
    }
    assert_eq!(said.err.lines().count(), 1, "{said:#?}");
    assert_eq!(left, ["a.fmu", "b.fmu"], "something was written");
}

/// The name of the library.
fn library(files: &Files) -> String {
    files.keys().find(|name| name.starts_with("binaries/")).expect("an FMU has a library").clone()
}

/// Gives the library another name.
fn rename_library(files: &mut Files, name: &str) {
    let bytes = files.remove(&library(files)).expect("it was found");
    files.insert(name.into(), bytes);
}

/// The library of the other platform is a renamed copy: `merge` does not look into it.
fn moved(files: &mut Files) {
    rename_library(files, "binaries/other/x.so");
}

#[test]
fn the_libraries_of_both_are_in_one() {
    let folder = empty_folder();
    let [a, b] = ["a.fmu", "b.fmu"].map(|name| folder.path().join(name));
    fs::copy(unit::export(&unit::scene("steel_ball")), &a).unwrap();
    changed(&a, &b, moved);
    let json = run(folder.path(), ["merge", "b.fmu", "a.fmu", "-o", "c.fmu", "--json"]).with_status(0).json();
    let platforms: Vec<_> = json["platforms"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    assert_eq!(platforms.len(), 2);
    assert_eq!(platforms[1], "other", "folders that FMI 2.0 knows come first: {platforms:?}");
    assert_eq!(json["size"], fs::metadata(folder.path().join("c.fmu")).unwrap().len());
    run(folder.path(), ["check", "c.fmu"]).with_status(0);
    // the order of the FMUs and duplicates do not matter, and a single FMU does not change
    run(folder.path(), ["merge", "a.fmu", "b.fmu", "a.fmu", "-o", "d.fmu"]).with_status(0);
    run(folder.path(), ["merge", "a.fmu", "a.fmu", "-o", "e.fmu"]).with_status(0);
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    command::assert_same(&read("c.fmu"), &read("d.fmu"));
    command::assert_same(&read("a.fmu"), &read("e.fmu"));
}

#[test]
fn different_guids_are_reported() {
    let other = |files: &mut Files| {
        moved(files);
        let text = String::from_utf8(files["modelDescription.xml"].clone()).unwrap();
        let (before, rest) = text.split_once("guid=\"").unwrap();
        let (_, after) = rest.split_once('"').unwrap();
        files.insert("modelDescription.xml".into(), format!("{before}guid=\"another\"{after}").into());
    };
    assert_refused(other, &["are not of one scene", "GUIDs are", "and another"]);
}

#[test]
fn different_descriptions_with_the_same_guid_are_reported() {
    let other = |files: &mut Files| {
        moved(files);
        let text = String::from_utf8(files["modelDescription.xml"].clone()).unwrap();
        files.insert("modelDescription.xml".into(), (text.replacen("max=", "nominal=", 1) + " ").into());
    };
    assert_refused(other, &["differ in modelDescription.xml"]);
}

#[test]
fn two_libraries_for_one_platform_are_reported() {
    let longer = |files: &mut Files| files.get_mut(&library(files)).expect("it was found").push(b'x');
    assert_refused(longer, &["both have files for", "which differ"]);
    // not just another name of the library
    let renamed = |files: &mut Files| rename_library(files, &(library(files) + ".so"));
    assert_refused(renamed, &["both have files for", "which differ"]);
}

#[test]
fn another_file_that_differs_is_reported() {
    let other = |files: &mut Files| {
        moved(files);
        files.get_mut("resources/scene.toml").expect("the scene").push(b'#');
    };
    assert_refused(other, &["differ in resources/scene.toml"]);
}

/// They would be written to other places than where they are read, in every tool that unpacks the result.
#[test]
fn a_name_that_leads_elsewhere_is_refused_and_never_copied() {
    for name in ["../../../evil.txt", "binaries/win64/../../../evil.txt", "/evil.txt", "resources//evil.txt"] {
        let (said, left) = merge(|files| {
            moved(files);
            files.insert(name.into(), b"evil".into());
        });
        let said = said.with_status(1);
        assert!(said.err.contains("b.fmu: ") && said.err.contains(&format!("{name:?}")), "{name}: {said:#?}");
        assert_eq!(left, ["a.fmu", "b.fmu"], "{name}: something was written");
    }
}

/// A tool that unpacks them takes the first or the last.
#[test]
fn a_file_that_is_there_twice_is_refused_by_merge_and_check() {
    let folder = empty_folder();
    let a = folder.path().join("a.fmu");
    let mut files = archive::files(&unit::export(&unit::scene("steel_ball")));
    files.push(("model.pnG".into(), Vec::new()));
    archive::write(&a, files);
    // no library writes a name twice
    fs::write(&a, replaced(&fs::read(&a).unwrap(), b"model.pnG", b"model.png")).unwrap();
    for call in [&["merge", "a.fmu", "a.fmu", "-o", "c.fmu"][..], &["check", "a.fmu"]] {
        let said = run(folder.path(), call).with_status(1);
        assert!(said.err.contains("a.fmu: two files in it have the same name"), "{said:#?}");
    }
    assert_eq!(contents(folder.path()), ["a.fmu"]);
}

#[test]
fn a_file_that_is_not_an_fmu_is_reported_by_name() {
    let folder = empty_folder();
    fs::copy(unit::export(&unit::scene("steel_ball")), folder.path().join("a.fmu")).unwrap();
    fs::write(folder.path().join("text.fmu"), "text").unwrap();
    changed(&folder.path().join("a.fmu"), &folder.path().join("empty.fmu"), Files::clear);
    for (other, reason) in
        [("text.fmu", "no zip archive"), ("empty.fmu", "modelDescription.xml is missing"), ("missing.fmu", &*missing())]
    {
        let said = run(folder.path(), ["merge", "a.fmu", other, "-o", "c.fmu"]).with_status(1);
        assert!(said.err.contains(other) && said.err.contains(reason), "{said:#?}");
    }
    assert_eq!(contents(folder.path()), ["a.fmu", "empty.fmu", "text.fmu"]);
    run(folder.path(), ["merge", "a.fmu", "-o", "c.fmu"]).with_status(2);
}
