//! `brinell report --peer`: other FMUs in the same picture.
#![cfg(target_os = "linux")]

use crate::command::{self, Run, empty_folder, run, scene};
use brinell_testing::unit;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// The model description of the spring in `c/peer.c`; `version` is the FMI version.
fn description(version: &str, variables: &[(&str, &str)]) -> String {
    let variable = |(reference, (name, causality)): (usize, &(&str, &str))| {
        format!(
            "<ScalarVariable name=\"{name}\" valueReference=\"{reference}\" causality=\"{causality}\"><Real/></ScalarVariable>"
        )
    };
    format!(
        "<fmiModelDescription fmiVersion=\"{version}\" modelName=\"spring\" guid=\"{{spring}}\">\
         <CoSimulation modelIdentifier=\"spring\"/><ModelVariables>{}</ModelVariables></fmiModelDescription>",
        variables.iter().enumerate().map(variable).collect::<String>()
    )
}

/// The features of the spring.
const SPRING: [(&str, &str); 2] = [("indentation_rate", "input"), ("force", "output")];

/// Compiles the spring with `option` and packs it with `xml` as `spring.fmu` in `folder`.
fn pack(folder: &Path, option: &str, xml: &str) -> PathBuf {
    let binaries = folder.join("binaries/linux64");
    fs::create_dir_all(&binaries).unwrap();
    fs::write(folder.join("modelDescription.xml"), xml).unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c/peer.c");
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-O2", "-Wall", "-Wextra", "-Werror", option, "-o"]);
    command::output(compiler.arg(binaries.join("spring.so")).arg(source)).with_status(0);
    let mut zip = Command::new("python3");
    zip.args(["-m", "zipfile", "-c", "spring.fmu", "binaries", "modelDescription.xml"]).current_dir(folder);
    command::output(&mut zip).with_status(0);
    folder.join("spring.fmu")
}

/// A quick report of `name` with these peers, and its data, if it succeeds.
fn report(name: &str, peers: &[&Path]) -> (Run, TempDir, Value) {
    let folder = empty_folder();
    let scene = scene(name).display().to_string();
    let mut arguments = vec!["report".to_string(), scene, "--quick".into(), "-o".into(), "report".into()];
    for peer in peers {
        arguments.extend(["--peer".into(), peer.display().to_string()]);
    }
    let run = run(folder.path(), arguments);
    let data = fs::read_to_string(folder.path().join("report/report.json")).unwrap_or_else(|_| "null".into());
    (run, folder, serde_json::from_str(&data).expect("JSON"))
}

/// The rows of `table` for a way to couple an FMU.
fn rows<'a>(data: &'a Value, table: &str, unit: &str, way: &str) -> Vec<&'a Value> {
    let all = data[table].as_array().unwrap_or_else(|| panic!("no table {table}"));
    all.iter().filter(|row| row["unit"] == unit && row["way"] == way).collect()
}

fn numbers(rows: &[&Value], key: &str) -> Vec<f64> {
    rows.iter().map(|row| row[key].as_f64().unwrap_or(f64::NAN)).collect()
}

/// The scene `mass_known` with another `name`, and with the law of the scene that it is a peer of.
fn with_the_law_of_the_ball(name: &str) -> String {
    let text = fs::read_to_string(scene("mass_known")).unwrap().replacen("mass_known", name, 1);
    text + "\n[law]\nloading = \"big-alabo\"\n"
}

#[test]
fn the_same_fmu_as_a_peer_gives_the_same_numbers_bit_for_bit() {
    let own = unit::export(&scene("steel_ball"));
    let named = own.with_file_name("twin.fmu");
    fs::copy(&own, &named).unwrap();
    let known = unit::export(&unit::write_scene("mass_known", &with_the_law_of_the_ball("mass_known")));
    let (run, _folder, data) = report("steel_ball", &[&named, &known]);
    run.with_status(0);
    for (unit, way) in [("twin", "late force"), ("twin", "leap-frog"), ("mass_known", "mass known")] {
        let (own, peer) = (rows(&data, "precision", "steel_ball", way), rows(&data, "precision", unit, way));
        assert_eq!(own.len(), 8, "2 to 256 steps per contact by {way}");
        for key in ["error_of_restitution", "error_of_largest_force", "error_of_dent", "error_of_contact_time"] {
            assert_eq!(numbers(&own, key), numbers(&peer, key), "{key} of {unit} by {way}");
        }
    }
    // neither supports the other ways
    assert!(rows(&data, "precision", "twin", "predicted_force").is_empty());
    assert!(rows(&data, "precision", "mass_known", "leap-frog").is_empty());
}

/// Its mean force applies to the next step.
#[test]
fn a_peer_for_the_jacobi_scheme_is_stepped_accordingly() {
    let text = with_the_law_of_the_ball("at_once").replacen("[coupling]", "[coupling]\nmaster = \"parallel\"", 1);
    let peer = unit::export(&unit::write_scene("at_once", &text));
    let (run, _folder, data) = report("steel_ball", &[&peer]);
    run.with_status(0);
    assert!(rows(&data, "precision", "at_once", "mass known").is_empty());
    let rows = rows(&data, "precision", "at_once", "mass known, parallel");
    assert_eq!(rows.len(), 8, "2 to 256 steps per contact");
    let errors = numbers(&rows, "error_of_restitution");
    assert!(errors.iter().all(|error| error.abs() < 1e-9), "{errors:?}");
}

#[test]
fn an_fmu_from_another_exporter_runs_with_its_own_features() {
    let folder = empty_folder();
    let spring = pack(folder.path(), "-DPLAIN", &description("2.0", &SPRING));
    let (run, _folder, data) = report("elastic", &[&spring]);
    run.with_status(0);
    // a spring returns all energy, as the elastic scene does; its rebound has the order of the method
    for (way, order) in [("late force", 1.0), ("leap-frog", 2.0)] {
        let fitted = rows(&data, "orders", "spring", way)[0]["order"].as_f64().expect("a fitted order");
        assert!((fitted - order).abs() < 0.3, "{way}: order {fitted} instead of {order}");
    }
    // its law differs
    let force = numbers(&rows(&data, "precision", "spring", "leap-frog"), "error_of_largest_force");
    assert!(force.iter().all(|error| *error > 0.05), "{force:?}");
    let orders = data["orders"].as_array().unwrap();
    assert_eq!(orders.iter().filter(|row| row["unit"] == "spring").count(), 2, "{orders:?}");
    assert!(!data["summary"].to_string().contains("spring"), "a peer is not recommended: {}", data["summary"]);
}

#[test]
fn a_peer_that_cannot_be_run_is_named_with_the_reason_and_nothing_is_written() {
    let folder = empty_folder();
    let missing = folder.path().join("missing.fmu");
    let refused = |peer: &Path, parts: &[&str]| {
        let (run, folder, _) = report("steel_ball", &[peer]);
        let run = run.with_status(1);
        let file = peer.display().to_string();
        for part in parts.iter().copied().chain([file.as_str(), "the other unit"]) {
            assert!(run.err.contains(part), "nothing of {part:?} in {run:#?}");
        }
        assert!(run.out.is_empty() && command::contents(folder.path()).is_empty(), "{run:#?}");
    };
    refused(&missing, &[&command::missing()]);
    let packed = |option: &str, xml: &str| {
        let folder = empty_folder();
        (pack(folder.path(), option, xml), folder)
    };
    let (peer, _folder) = packed("-DPLAIN", &description("3.0", &SPRING));
    refused(&peer, &["fmiVersion", "3.0", "2.0"]);
    let (peer, _folder) = packed("-DPLAIN", &description("2.0", &[("indentation_rate", "input"), ("f", "output")]));
    refused(&peer, &["no Real variable force", "needed are indentation_rate, force"]);
    let (peer, _folder) = packed("-DPLAIN", &description("2.0", &SPRING).replace("{spring}", "{else}"));
    refused(&peer, &["fmi2Instantiate gave no instance"]);
    let (peer, _folder) = packed("-DREFUSES_SHORT_STEPS", &description("2.0", &SPRING));
    refused(&peer, &["fmi2DoStep returned status 3"]);
    let (peer, _folder) = packed("-DPLAIN", &description("2.0", &SPRING).replace("CoSimulation", "ModelExchange"));
    refused(&peer, &["no co-simulation unit"]);
}
