//! Scenes of cylinders: what they need, and FMUs that agree with the predictions.

use crate::command::{empty_folder, run};
use crate::written::Written;
use brinell_testing::long::some;
use std::fs;

/// A scene of a roller, with these keys of its bodies and these other lines.
fn scene(impactor: &str, target: &str, more: &str) -> String {
    format!(
        "name = \"unit\"\nimpactor = {{ shape = \"cylinder\", {impactor} }}\ntarget = {{ {target} }}\n\
         impact = {{ mass = 0.05, speed = 0.5 }}\n{more}"
    )
}

const ROLLER: &str = "radius = \"10 mm\", length = \"20 mm\", material = \"bearing steel 52100, hardened\"";
const PLATE: &str = "material = \"mild steel\", thickness = \"40 mm\"";
const OUTPUTS: &str = "fmu = { outputs = [\"work\", \"dissipated_energy\", \"contact_radius\", \"residual_indentation\", \"mean_pressure\", \"contact_area\"] }\n";

/// What predict says, as JSON.
fn predicted(text: &str) -> serde_json::Value {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0).json()
}

fn number(text: &str, name: &str) -> f64 {
    predicted(text)["laws"][0][name].as_f64().unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn an_fmu_of_cylinders_agrees_with_the_prediction() {
    let folder = empty_folder();
    let cases = [
        (ROLLER, PLATE, ""),
        (
            ROLLER,
            "radius = \"30 mm\", material = \"steel AISI 4340, 30 HRC\", yield_strength = \"900 MPa\", hardening_modulus = \"2 GPa\"",
            "",
        ),
        (
            "radius = 0.01, length = 0.02",
            "material = \"aluminium 6061-T6\", thickness = 0.02, base = \"bonded\"",
            "coupling = { effective_mass = 0.05 }\n",
        ),
        (
            ROLLER,
            "material = \"mild steel\", radius = \"-14 mm\", thickness = \"10 mm\"",
            "coupling = { effective_mass = 0.05 }\n",
        ),
        (ROLLER, PLATE, "law = { elastic_restitution = 0.9 }\n"),
        (
            "radius = 0.01, length = 0.02, material = \"brass\", yield_strength = 1e8",
            "material = \"mild steel\"",
            "law = { size_constant = 11.5 }\n",
        ),
    ];
    for (impactor, target, more) in some(cases, 2) {
        let impactor = impactor.replace("\"brass\"", "\"cartridge brass C260, half hard\"");
        fs::write(folder.path().join("scene.toml"), scene(&impactor, target, &format!("{more}{OUTPUTS}"))).unwrap();
        run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
    }
}

#[test]
fn a_compiled_library_has_the_law_of_its_cylinders_alone() {
    let rust = Written::of(&scene(ROLLER, PLATE, "")).rust;
    assert!(rust.contains("contact::loading::Line, contact::unloading::Line"), "{rust}");
    assert!(!rust.contains("Paired"), "{rust}");
}

#[test]
fn a_roller_that_is_twice_as_long_and_heavy_does_the_same() {
    let one = scene(ROLLER, PLATE, "");
    let two = one.replace("20 mm", "40 mm").replace("mass = 0.05", "mass = 0.1");
    for name in ["restitution", "largest_indentation", "dent", "loading_time", "largest_contact_radius"] {
        let [one, two] = [&one, &two].map(|text| number(text, name));
        assert!((one / two - 1.0).abs() < 1e-9, "{name}: {one} and {two}");
    }
    let [one, two] = [&one, &two].map(|text| number(text, "largest_force"));
    assert!((2.0 * one / two - 1.0).abs() < 1e-9, "{one} and {two}");
}

#[test]
fn the_constant_of_a_plate_is_that_of_its_layer() {
    let said = |target: &str| {
        let notes = predicted(&scene("radius = 0.01, length = 0.02", target, ""))["notes"].to_string();
        let constant = notes.split("C = ").nth(1).unwrap_or_else(|| panic!("{notes}"));
        constant.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    let strength = 300e6;
    let modulus: f64 = 206e9 / 0.91;
    let half_width = 2.0 * 0.01 * 1.7937 * strength / modulus;
    for (base, k) in [("smooth", 0.2966), ("bonded", -0.053)] {
        let target = "youngs_modulus = 206e9, poissons_ratio = 0.3, yield_strength = 300e6, thickness = 0.04";
        let expected = 2.0 * (0.08 / half_width).ln() + k;
        let found = said(&format!("{target}, base = \"{base}\""));
        assert!((found / expected - 1.0).abs() < 1e-3, "{base}: {found}, not {expected}");
    }
}

#[test]
fn a_roller_without_a_mass_is_solid() {
    let text = scene(ROLLER, PLATE, "").replace("mass = 0.05, ", "");
    let mass = predicted(&text)["mass"].as_f64().unwrap();
    assert!((mass / (7810.0 * std::f64::consts::PI * 1e-4 * 0.02) - 1.0).abs() < 0.01, "{mass}");
}

#[test]
fn equal_rollers_are_one_scene() {
    let contacts = "[[contact]]\nname = \"left\"\n[[contact]]\nname = \"right\"\nimpactor = { yield_strength = 1e9 }\n";
    predicted(&scene(ROLLER, PLATE, contacts));
}

#[test]
fn commands_of_balls_say_so() {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene(ROLLER, PLATE, "")).unwrap();
    for (arguments, words) in [
        (vec!["hardness", "scene.toml", "--load", "1kN"], "the scene a cylinder"),
        (vec!["translate", "scene.toml", "--for", "mujoco"], "the scene has a cylinder"),
        (vec!["predict", "scene.toml", "--laws", "brinell"], "is a law of balls"),
        (vec!["predict", "scene.toml", "--sweep", "impactor.radius=0.01:0.02:3"], "the constant C"),
    ] {
        let said = run(folder.path(), arguments.iter().copied());
        assert!(said.err.contains(words), "{arguments:?}: {}", said.err);
    }
    run(folder.path(), ["predict", "scene.toml", "--laws", "all"]).with_status(0);
    run(folder.path(), ["curve", "scene.toml", "-o", "curve.csv"]).with_status(0);
}
