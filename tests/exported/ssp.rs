//! `brinell ssp` from the user's point of view; tests/fmpy/test_ssp.py examines the packages.

use crate::command::{self, Run, assert_same, contents, empty_folder, run, scene};
use crate::unit;
use std::fs;
use std::path::Path;

#[test]
fn a_system_is_written_to_the_current_folder_and_its_contents_are_listed() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let said = run(folder.path(), ["ssp", &scene]).with_status(0);
    assert_eq!(contents(folder.path()), ["steel_ball.ssp"]);
    for part in
        ["steel_ball.ssp", "`contact`", "inputs      indentation_rate", "outputs     force, ", "target.yield_strength"]
    {
        assert!(said.out.contains(part), "{part}: {said:#?}");
    }
    let json = run(folder.path(), ["ssp", &scene, "--json", "-o", "other.ssp"]).with_status(0).json();
    assert_eq!(json["ssp"], "other.ssp");
    assert_eq!(json["inputs"], serde_json::json!(["indentation_rate"]));
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(json["size"], bytes("other.ssp").len());
    assert_same(&bytes("steel_ball.ssp"), &bytes("other.ssp"));
}

#[test]
fn a_wrong_name_or_scene_is_reported_and_nothing_is_written() {
    let folder = empty_folder();
    let scene = scene("steel_ball").display().to_string();
    let said = run(folder.path(), ["ssp", &scene, "-o", "ball.zip"]).with_status(2);
    assert_eq!(said.err, "brinell: ball.zip: the name must end in .ssp\n");
    let text = fs::read_to_string(&scene).unwrap().replace("mild steel", "cheese");
    fs::write(folder.path().join("wrong.toml"), text).unwrap();
    let said = run(folder.path(), ["ssp", "wrong.toml"]).with_status(1);
    assert!(said.err.contains("wrong.toml:9:") && said.err.contains("cheese"), "{said:#?}");
    assert_eq!(contents(folder.path()), ["wrong.toml"]);
}

/// `brinell ssp` of the ball that knows its mass, together with an FMU `other` of two contacts.
fn with_other(folder: &Path, arguments: &[&str]) -> Run {
    fs::copy(unit::export(&unit::scene("two_contacts")), folder.join("other.fmu")).unwrap();
    let scene = scene("mass_known").display().to_string();
    run(folder, ["ssp", &scene, "--with", "other.fmu"].iter().chain(arguments))
}

#[test]
fn other_fmus_are_packed_with_the_contact_and_connected_to_it() {
    let folder = empty_folder();
    let connections = ["other.left.force=contact.indentation_rate", "contact.force=other.right.indentation_rate"];
    with_other(folder.path(), &["--connect", connections[0], "--connect", connections[1]]).with_status(0);
    let mut archive = zip_of(&folder.path().join("mass_known.ssp"));
    let text = archive.remove("SystemStructure.ssd").map(|bytes| String::from_utf8(bytes).unwrap()).unwrap();
    let from =
        r#"startElement="other" startConnector="left.force" endElement="contact" endConnector="indentation_rate""#;
    let to =
        r#"startElement="contact" startConnector="force" endElement="other" endConnector="right.indentation_rate""#;
    assert!(text.contains(from) && text.contains(to), "{text}");
    assert_eq!(text.matches("<ssd:Connection ").count(), 2);
    // variables of the other FMU that are not connected are not listed
    assert!(!text.contains("right.force"), "{text}");
    assert_eq!(archive["resources/other.fmu"], fs::read(folder.path().join("other.fmu")).unwrap());
}

/// The files of an archive by name.
fn zip_of(path: &Path) -> std::collections::HashMap<String, Vec<u8>> {
    let folder = path.with_extension("");
    let mut python = std::process::Command::new("python3");
    command::output(python.args(["-m", "zipfile", "-e"]).args([path, &folder])).with_status(0);
    let names = ["SystemStructure.ssd", "resources/mass_known.ssv", "resources/mass_known.fmu", "resources/other.fmu"];
    names.into_iter().map(|name| (name.to_string(), fs::read(folder.join(name)).expect(name))).collect()
}

#[test]
fn a_wrong_connection_is_reported_with_the_possible_ones() {
    let cases = [
        ("contact.force", "--connect contact.force: write a connection as FMU.OUTPUT=FMU.INPUT"),
        ("force=other.force", "write a connection as FMU.OUTPUT=FMU.INPUT"),
        ("mass.rate=contact.indentation_rate", "there is no FMU `mass`; the system has contact, other"),
        ("other.left.x=contact.indentation_rate", "other has no output `left.x` of type Real; it has left.force, "),
        ("other.left.regime=contact.indentation_rate", "other has no output `left.regime` of type Real"),
        ("other.left.force=contact.force", "contact has no input `force` of type Real; it has indentation_rate"),
    ];
    for (connection, message) in cases {
        let folder = empty_folder();
        let said = with_other(folder.path(), &["--connect", connection]).with_status(2);
        assert!(said.err.contains(connection) && said.err.contains(message), "{connection}: {said:#?}");
        assert_eq!(contents(folder.path()), ["other.fmu"]);
    }
    let folder = empty_folder();
    let twice = ["--connect", "other.left.force=contact.indentation_rate"].repeat(2);
    let said = with_other(folder.path(), &twice).with_status(2);
    assert!(said.err.contains("the input contact.indentation_rate is already connected"), "{said:#?}");
}

#[test]
fn an_fmu_that_cannot_be_part_of_a_system_is_refused_by_name() {
    let folder = empty_folder();
    let said = with_other(folder.path(), &["--with", "other.fmu"]).with_status(1);
    assert!(said.err.contains("other.fmu: the system already has an FMU `other`"), "{said:#?}");
    for name in ["contact.fmu", "mass_known.fmu"] {
        fs::copy(folder.path().join("other.fmu"), folder.path().join(name)).unwrap();
        let said = with_other(folder.path(), &["--with", name]).with_status(1);
        assert!(said.err.contains(&format!("{name}: the system already has an FMU")), "{said:#?}");
    }
    fs::copy(folder.path().join("other.fmu"), folder.path().join("a.b.fmu")).unwrap();
    let said = with_other(folder.path(), &["--with", "a.b.fmu"]).with_status(1);
    assert!(said.err.contains("would be called `a.b`; only letters, digits"), "{said:#?}");
    let said = with_other(folder.path(), &["--with", "missing.fmu"]).with_status(1);
    assert!(said.err.contains("missing.fmu: "), "{said:#?}");
    fs::write(folder.path().join("text.fmu"), "text").unwrap();
    let said = with_other(folder.path(), &["--with", "text.fmu"]).with_status(1);
    assert!(said.err.contains("text.fmu: it is no zip archive"), "{said:#?}");
}
