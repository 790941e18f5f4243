//! `brinell ssp` from the user's point of view; tests/fmpy/test_ssp.py examines the packages.

use crate::archive;
use crate::command::{Run, assert_same, contents, empty_folder, run, scene};
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

/// `brinell ssp` of the ball that knows its mass, together with an FMU `other` of two contacts.
fn with_other(folder: &Path, arguments: &[&str]) -> Run {
    fs::copy(unit::export(&unit::scene("two_contacts")), folder.join("other.fmu")).unwrap();
    let scene = scene("mass_known").display().to_string();
    run(folder, ["ssp", &scene, "--with", "other.fmu"].iter().chain(arguments))
}

/// Writes an FMU without a library to `path`, with an input and an output in each of these units: an attribute of Real, and the
/// definition of the unit.
fn with_units(path: &Path, units: &[(&str, &str)]) {
    let mut definitions = String::new();
    let mut variables = String::new();
    for (index, (unit, definition)) in units.iter().enumerate() {
        definitions += &format!("<Unit name=\"{unit}\">{definition}</Unit>");
        for (kind, causality) in [("in", "input"), ("out", "output")] {
            let unit = if unit.is_empty() { String::new() } else { format!(" unit=\"{unit}\"") };
            variables += &format!(
                "<ScalarVariable name=\"{kind}{index}\" valueReference=\"{index}\" causality=\"{causality}\"><Real{unit}/></ScalarVariable>"
            );
        }
    }
    let description = format!(
        "<fmiModelDescription fmiVersion=\"2.0\" guid=\"g\"><CoSimulation modelIdentifier=\"mass\"/>\
         <UnitDefinitions>{definitions}</UnitDefinitions><ModelVariables>{variables}</ModelVariables></fmiModelDescription>"
    );
    archive::write(path, [("modelDescription.xml", description)]);
}

const UNITS: [(&str, &str); 8] = [
    ("m/s", "<BaseUnit m=\"1\" s=\"-1\"/>"),
    ("mm/s", "<BaseUnit m=\"1\" s=\"-1\" factor=\"1e-3\"/>"),
    ("J", "<BaseUnit kg=\"1\" m=\"2\" s=\"-2\"/>"),
    ("m/s2", "<BaseUnit m=\"1\" s=\"-2\"/>"),
    ("rad/s", "<BaseUnit rad=\"1\" s=\"-1\"/>"),
    ("m/s, shifted", "<BaseUnit m=\"1\" s=\"-1\" offset=\"1\"/>"),
    ("knots", ""),
    ("", ""),
];

/// `brinell ssp` of the ball that knows its mass, with the FMU of all units, connected in this way.
fn connected(folder: &Path, connection: &str) -> Run {
    with_units(&folder.join("mass.fmu"), &UNITS);
    let scene = scene("mass_known").display().to_string();
    run(folder, ["ssp", &scene, "--with", "mass.fmu", "--connect", connection])
}

#[test]
fn connections_of_other_quantities_and_other_units_are_refused_with_both_units_and_unknown_units_are_warned_of() {
    let between = "can't be compared";
    let cases = [
        (
            "mass.out1=contact.indentation_rate",
            2,
            &["mass.out1 [mm/s]", "contact.indentation_rate [m/s]", "1000 times"][..],
        ),
        ("mass.out2=contact.indentation_rate", 2, &["mass.out2 [J]", "contact.indentation_rate [m/s]", "quantities"]),
        ("mass.out3=contact.indentation_rate", 2, &["mass.out3 [m/s2]", "[m/s]", "different quantities"]),
        ("mass.out4=contact.indentation_rate", 2, &["mass.out4 [rad/s]", "[m/s]", "different quantities"]),
        ("mass.out5=contact.indentation_rate", 2, &["[m/s, shifted]", "[m/s]", "the zeros differ"]),
        ("contact.force=mass.in2", 2, &["contact.force [N]", "mass.in2 [J]", "different quantities"]),
        ("mass.out1=mass.in0", 2, &["mass.out1 [mm/s]", "mass.in0 [m/s]", "1000 times"]),
        (
            "mass.out6=contact.indentation_rate",
            0,
            &["warning: ", "mass.out6 [knots] and contact.indentation_rate [m/s]", between],
        ),
        ("mass.out7=contact.indentation_rate", 0, &["warning: ", "mass.out7 (no unit) and contact", between]),
        ("mass.out0=contact.indentation_rate", 0, &[]),
    ];
    for (connection, status, parts) in cases {
        let folder = empty_folder();
        let said = connected(folder.path(), connection).with_status(status);
        let words = said.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(parts.iter().all(|part| words.contains(part)), "{connection}: {words}");
        assert_eq!(words.contains("warning"), status == 0 && !parts.is_empty(), "{connection}: {words}");
        assert_eq!(contents(folder.path()).len(), if status == 0 { 2 } else { 1 }, "{connection}");
    }
}

#[test]
fn other_fmus_are_packed_with_the_contact_and_connected_to_it() {
    let folder = empty_folder();
    connected(folder.path(), "mass.out0=contact.indentation_rate").with_status(0);
    let system = folder.path().join("mass_known.ssp");
    let text = archive::text(&system, "SystemStructure.ssd");
    let ends = r#"startElement="mass" startConnector="out0" endElement="contact" endConnector="indentation_rate""#;
    assert!(text.contains(ends), "{text}");
    assert_eq!(text.matches("<ssd:Connection ").count(), 1);
    // the connector of the other FMU has its unit; variables that are not connected are not listed
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains(r#"<ssd:Connector name="out0" kind="output"> <ssc:Real unit="m/s"/>"#), "{text}");
    assert!(!text.contains("out1"), "{text}");
    let packed: Vec<_> = archive::files(&system).into_iter().map(|(name, _)| name).collect();
    for name in ["resources/mass_known.ssv", "resources/mass_known.fmu"] {
        assert!(packed.contains(&name.to_string()), "{packed:?}");
    }
    let (_, bytes) =
        archive::files(&system).into_iter().find(|(name, _)| name == "resources/mass.fmu").expect("it is packed");
    assert_eq!(bytes, fs::read(folder.path().join("mass.fmu")).unwrap());
}

/// Tools read the definition that belongs to the name.
#[test]
fn a_unit_of_another_fmu_with_the_name_of_another_unit_is_listed_by_itself() {
    let folder = empty_folder();
    let base = "<BaseUnit m=\"1\" s=\"-1\" factor=\"1e-3\"/>";
    with_units(&folder.path().join("mass.fmu"), &[("m/s", base)]);
    let scene = scene("mass_known").display().to_string();
    run(folder.path(), ["ssp", &scene, "--with", "mass.fmu", "--connect", "mass.out0=mass.in0"]).with_status(0);
    let text = archive::text(&folder.path().join("mass_known.ssp"), "SystemStructure.ssd");
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for (name, kind) in [("in0", "input"), ("out0", "output")] {
        let connector = format!(r#"<ssd:Connector name="{name}" kind="{kind}"> <ssc:Real unit="m/s (mass)"/>"#);
        assert!(words.contains(&connector), "{text}");
    }
    assert!(words.contains(r#"<ssc:Unit name="m/s"> <ssc:BaseUnit m="1" s="-1"/>"#), "{text}");
    let of_mass = words.split_once(r#"<ssc:Unit name="m/s (mass)">"#).expect("it is listed").1;
    assert!(of_mass.split("/>").next().unwrap().contains("factor="), "{text}");
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
    with_units(&folder.path().join("mass.fmu"), &UNITS);
    let scene = scene("mass_known").display().to_string();
    let twice = ["--connect", "mass.out0=contact.indentation_rate"].repeat(2);
    let said = run(folder.path(), ["ssp", &scene, "--with", "mass.fmu"].iter().chain(&twice)).with_status(2);
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
