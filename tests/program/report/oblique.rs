//! Oblique impacts in the report of a scene with friction.

use super::{DEFAULT, rows};
use crate::command::{empty_folder, run};
use std::fs;

#[test]
fn the_fmu_converges_to_the_predicted_rebound() {
    let folder = empty_folder();
    let scene = "name = \"glass\"\nimpactor = { radius = 2.5e-3, youngs_modulus = 380e9, poissons_ratio = 0.23 }\n\
                 target = { youngs_modulus = 70e9, poissons_ratio = 0.25 }\nlaw = { loading = \"hertz\" }\n\
                 friction = { coefficient = 0.092 }\nimpact = { mass = 2.618e-4, speed = 3.9 }\n";
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let data = run(folder.path(), ["report", "scene.toml", "--quick", "--json", "-o", "report"]).with_status(0).json();
    let errors = rows(&data, "oblique-error").iter();
    let unit: Vec<f64> = errors.map(|row| row["error_of_tangential_restitution"].as_f64().expect("an error")).collect();
    assert_eq!(unit.len(), 7, "4 to 256 steps per contact");
    // second order
    assert!(unit[6] < 1e-3 && unit[6] < 0.2 * unit[4] && unit[4] < 0.2 * unit[2], "{unit:?}");
    // the frequency of the tangential motion: sqrt(7/2 4 G*/E*)
    let summary = data["summary"].to_string();
    assert!(summary.contains("stable steps of a solid ball that sticks are 1.7 times shorter"), "{summary}");
    // an FMU with friction can't know the mass
    assert!(!summary.contains("knows the mass"), "{summary}");
    assert!(rows(&data, "limits").iter().all(|row| !row["way"].as_str().unwrap_or_default().starts_with("mass known")));
    let page = fs::read_to_string(folder.path().join("report/index.html")).unwrap();
    assert!(page.contains("Oblique impacts") && page.contains("oblique-error.svg"));
}

#[test]
fn a_scene_without_friction_has_no_oblique_impacts() {
    assert!(DEFAULT.1["oblique-error"].is_null());
}
