//! `brinell merge`: FMUs of one scene are joined, others are rejected.

use crate::command::{self, Run, contents, empty_folder, output, run};
use crate::unit;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Writes a modified copy of the FMU at `from` to `to`. `change` is Python code that works on `files`, a dictionary of bytes by
/// name.
fn changed(from: &Path, to: &Path, change: &str) {
    let script = format!(
        "import sys, zipfile\n\
         with zipfile.ZipFile(sys.argv[1]) as archive:\n    files = {{name: archive.read(name) for name in archive.namelist()}}\n\
         library = next(name for name in files if name.startswith('binaries/'))\n\
         {change}\n\
         with zipfile.ZipFile(sys.argv[2], 'w') as archive:\n    for name, data in files.items(): archive.writestr(name, data)\n"
    );
    output(Command::new("python3").args(["-c", &script]).args([from, to])).with_status(0);
}

/// The result of `merge` for the FMU of the default scene, `a.fmu`, and a modified copy of it, `b.fmu`.
fn merge(change: &str) -> (Run, Vec<String>) {
    let folder = empty_folder();
    let [a, b] = ["a.fmu", "b.fmu"].map(|name| folder.path().join(name));
    fs::copy(unit::export(&unit::scene("steel_ball")), &a).unwrap();
    changed(&a, &b, change);
    let said = run(folder.path(), ["merge", "a.fmu", "b.fmu", "-o", "c.fmu"]);
    (said, contents(folder.path()))
}

#[track_caller]
fn assert_refused(change: &str, parts: &[&str]) {
    let (said, left) = merge(change);
    let said = said.with_status(1);
    for part in ["a.fmu", "b.fmu"].iter().chain(parts) {
        assert!(said.err.contains(part), "{change}: no {part:?} in {said:#?}");
    }
    assert_eq!(said.err.lines().count(), 1, "{said:#?}");
    assert_eq!(left, ["a.fmu", "b.fmu"], "{change}: something was written");
}

/// The library of the other platform is a renamed copy: `merge` does not look into it.
const MOVED: &str = "files['binaries/other/x.so'] = files.pop(library)";

#[test]
fn the_libraries_of_both_are_in_one() {
    let folder = empty_folder();
    let [a, b] = ["a.fmu", "b.fmu"].map(|name| folder.path().join(name));
    fs::copy(unit::export(&unit::scene("steel_ball")), &a).unwrap();
    changed(&a, &b, MOVED);
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
    assert_refused(
        &format!(
            "{MOVED}\nimport re\nfiles['modelDescription.xml'] = \
             re.sub(b'guid=\"[^\"]*\"', b'guid=\"another\"', files['modelDescription.xml'])"
        ),
        &["are not of one scene", "GUIDs are", "and another"],
    );
}

#[test]
fn different_descriptions_with_the_same_guid_are_reported() {
    assert_refused(
        &format!(
            "{MOVED}\nfiles['modelDescription.xml'] = files['modelDescription.xml'].replace(b'max=', b'nominal=', 1) + b' '"
        ),
        &["differ in modelDescription.xml"],
    );
}

#[test]
fn two_libraries_for_one_platform_are_reported() {
    assert_refused("files[library] += b'x'", &["both have files for", "which differ"]);
    // not just another name of the library
    assert_refused("files[library + '.so'] = files.pop(library)", &["both have files for", "which differ"]);
}

#[test]
fn another_file_that_differs_is_reported() {
    assert_refused(&format!("{MOVED}\nfiles['resources/scene.toml'] += b'#'"), &["differ in resources/scene.toml"]);
}

/// They would be written to other places than where they are read, in every tool that unpacks the result.
#[test]
fn a_name_that_leads_elsewhere_is_refused_and_never_copied() {
    for name in ["../../../evil.txt", "binaries/win64/../../../evil.txt", "/evil.txt", "resources//evil.txt"] {
        let (said, left) = merge(&format!("{MOVED}\nfiles['{name}'] = b'evil'"));
        let said = said.with_status(1);
        assert!(said.err.contains("b.fmu: ") && said.err.contains(&format!("{name:?}")), "{name}: {said:#?}");
        assert_eq!(left, ["a.fmu", "b.fmu"], "{name}: something was written");
    }
}

/// Python's archives take a name twice; a tool that unpacks them takes the first or the last.
#[test]
fn a_file_that_is_there_twice_is_refused_by_merge_and_check() {
    let folder = empty_folder();
    let a = folder.path().join("a.fmu");
    fs::copy(unit::export(&unit::scene("steel_ball")), &a).unwrap();
    let twice =
        "import sys, zipfile\nwith zipfile.ZipFile(sys.argv[1], 'a') as archive: archive.writestr('model.png', b'')";
    output(Command::new("python3").args(["-W", "ignore", "-c", twice]).arg(&a)).with_status(0);
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
    changed(&folder.path().join("a.fmu"), &folder.path().join("empty.fmu"), "files.clear()");
    for (other, reason) in [
        ("text.fmu", "no zip archive"),
        ("empty.fmu", "modelDescription.xml is missing"),
        ("missing.fmu", "No such file"),
    ] {
        let said = run(folder.path(), ["merge", "a.fmu", other, "-o", "c.fmu"]).with_status(1);
        assert!(said.err.contains(other) && said.err.contains(reason), "{said:#?}");
    }
    assert_eq!(contents(folder.path()), ["a.fmu", "empty.fmu", "text.fmu"]);
    run(folder.path(), ["merge", "a.fmu", "-o", "c.fmu"]).with_status(2);
}
