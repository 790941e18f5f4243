//! Scenes of bodies with two radii: FMUs that agree with the predictions, and their limits.

use crate::both_ways::Both;
use crate::command::{empty_folder, run};
use crate::physics::Random;
use crate::prebuilt::store;
use std::fs;

/// A scene of an impactor and a target, with these other lines.
fn scene(impactor: &str, target: &str, more: &str) -> String {
    format!("name = \"unit\"\nimpactor = {{ {impactor} }}\ntarget = {{ {target} }}\n{more}")
}

const IMPACT: &str = "impact = { mass = 0.02, speed = 0.3 }\n";
const BALL: &str = "radius = \"5 mm\", material = \"bearing steel 52100, hardened\"";
const RACEWAY: &str = "radius = [\"15 mm\", \"-5.2 mm\"], material = \"mild steel\"";
const OUTPUTS: &str = "fmu = { outputs = [\"work\", \"dissipated_energy\", \"contact_radius\", \"residual_indentation\", \"mean_pressure\"] }\n";

/// What predict says, as JSON.
fn predicted(text: &str) -> serde_json::Value {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), text).unwrap();
    run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0).json()
}

const NUMBERS: [&str; 5] = ["largest_force", "largest_indentation", "largest_contact_radius", "dent", "restitution"];

/// The scenes have the same impact, within this part.
#[track_caller]
fn same(one: &str, other: &str, within: f64) {
    let [one, other] = [one, other].map(|text| predicted(text)["laws"][0].clone());
    for name in NUMBERS {
        let [one, other] = [&one, &other].map(|law| law[name].as_f64().unwrap());
        assert!((one / other - 1.0).abs() < within, "{name}: {one} and {other}");
    }
}

#[test]
fn an_fmu_of_an_ellipse_agrees_with_the_prediction() {
    let folder = empty_folder();
    let moved = "coupling = { effective_mass = 0.02 }\nimpact = { speed = 0.3 }\n";
    let bodies = "impact = { speed = 0.3 }\n[[body]]\nname = \"inner\"\nmass = 0.1\n[[body]]\nname = \"ball\"\nmass = 0.02\n\
                  [[contact]]\nname = \"floor\"\nbetween = [\"inner\", \"ground\"]\ntarget = { radius = [\"9 mm\", \"flat\"] }\n\
                  [[contact]]\nname = \"pair\"\nbetween = [\"ball\", \"inner\"]\n";
    for (impactor, target, more) in [
        (BALL, RACEWAY, IMPACT.to_string()),
        (BALL, RACEWAY, moved.to_string()),
        (BALL, RACEWAY, bodies.to_string()),
        (BALL, RACEWAY, format!("{IMPACT}law = {{ elastic_restitution = 0.9 }}\n")),
        (BALL, RACEWAY, format!("{IMPACT}law = {{ loading = \"hertz\" }}\n")),
        (BALL, RACEWAY, format!("{IMPACT}law = {{ loading = \"tsuji\", restitution = 0.7 }}\n")),
        (
            "radius = [\"5 mm\", \"flat\"], youngs_modulus = 70e9, poissons_ratio = 0.33, yield_strength = 2e8, hardening_modulus = 1e9",
            "radius = [\"flat\", \"20 mm\"], material = \"mild steel\", hardening_modulus = 2e9",
            IMPACT.to_string(),
        ),
        (
            BALL,
            "radius = [0.1, 0.01], material = \"mild steel\", rate = { model = \"cowper-symonds\", d = 40.4, q = 5 }",
            moved.into(),
        ),
    ] {
        let outputs = if more.contains("tsuji") { "" } else { OUTPUTS };
        let (outputs, more) =
            if more.contains("[[body]]") { (outputs, more) } else { ("", format!("{more}{outputs}")) };
        fs::write(folder.path().join("scene.toml"), scene(impactor, target, &format!("{outputs}{more}"))).unwrap();
        run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0);
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
    }
    Both::of(scene(BALL, RACEWAY, &format!("{IMPACT}{OUTPUTS}")), store()).compare(100, &mut Random(7));
}

#[test]
fn equal_radii_and_equal_crossed_cylinders_are_a_ball() {
    let steel = "material = \"mild steel\"";
    let ball = scene("radius = 5e-3", steel, IMPACT);
    same(&ball, &scene("radius = [5e-3, 5e-3]", steel, IMPACT), 1e-12);
    let crossed = scene("radius = [5e-3, \"flat\"]", &format!("radius = [\"flat\", 5e-3], {steel}"), IMPACT);
    // large strain knows whose curvature it is
    same(&ball, &crossed, 5e-3);
    let turned = scene("radius = [\"flat\", 5e-3]", &format!("radius = [5e-3, \"flat\"], {steel}"), IMPACT);
    same(&crossed, &turned, 1e-12);
}

#[test]
fn half_axes_are_said_along_x_and_y_with_the_radii_of_the_scene() {
    let [one, other] = ["radius = [\"40 mm\", \"5 mm\"]", "radius = [\"5 mm\", \"40 mm\"]"].map(|impactor| {
        predicted(&scene(impactor, "material = \"mild steel\"", IMPACT))["laws"][0]["largest_half_axes"].clone()
    });
    assert_eq!((&one[0], &one[1]), (&other[1], &other[0]));
    assert!(one[0].as_f64() > one[1].as_f64(), "{one}");
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene(BALL, RACEWAY, &format!("{IMPACT}{OUTPUTS}"))).unwrap();
    let said = run(folder.path(), ["predict", "scene.toml"]).with_status(0).out;
    assert!(said.contains("largest half-axes") && said.contains(" along x, ") && !said.contains("a/R"), "{said}");
    let said = run(folder.path(), ["predict", "scene.toml", "--speed", "1"]).with_status(0).out;
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("of the smallest radius in its direction"), "{said}");
}
