//! FMUs with the passivity guard: their texts, and their agreement with the prediction.

use crate::archive;
use crate::command::{empty_folder, run};
use brinell_testing::long;
use std::fs;
use std::path::Path;

/// Writes a scene with these laws to `folder`; `guard` is the line about the guard.
fn write(folder: &Path, loading: &str, guard: &str) {
    let scene = format!(
        "name = \"unit\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n[law]\n\
         loading = \"{loading}\"\nunloading = \"thornton\"\n{guard}\n[impact]\nmass = 4.11e-3\nspeed = 0.0025\n"
    );
    fs::write(folder.join("scene.toml"), scene).unwrap();
}

#[test]
fn a_guarded_fmu_states_where_the_guard_acts_and_agrees_with_the_prediction() {
    let folder = empty_folder();
    // two with a range from first yield on, one whose range begins later; then the rest
    let laws = ["stronge", "ghaednia", "brake-2012-line", "kogut-etsion", "brake-2012-tangent", "brake-2015"];
    for loading in laws.into_iter().take(if long::is_asked() { laws.len() } else { 3 }) {
        write(folder.path(), loading, "passivity_guard = true");
        let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
        let ranges = exported["passivity_guard"].as_array().unwrap().clone();
        assert!(!ranges.is_empty(), "{loading} makes energy: {exported}");
        run(folder.path(), ["check", "unit.fmu"]).with_status(0);
        let said = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu"]).with_status(0).out;
        let words = format!("from {:.4} to {:.4}", ranges[0][0].as_f64().unwrap(), ranges[0][1].as_f64().unwrap());
        assert!(said.contains("guard      acts at largest indentations") && said.contains(&words), "{said}");
        let page = archive::text(&folder.path().join("unit.fmu"), "documentation/index.html");
        assert!(page.contains("Passivity guard") && page.contains(&words), "{loading}");
        assert!(
            archive::text(&folder.path().join("unit.fmu"), "modelDescription.xml").contains("logStatusWarning"),
            "{loading}"
        );
    }
}

#[test]
fn the_guard_is_off_unless_requested_and_then_not_mentioned() {
    let folder = empty_folder();
    let mut constants = Vec::new();
    for guard in ["", "passivity_guard = false"] {
        write(folder.path(), "stronge", guard);
        constants.push(run(folder.path(), ["constants", "scene.toml"]).with_status(0).out);
    }
    assert_eq!(constants[0], constants[1]);
    assert!(!constants[0].to_lowercase().contains("guard"));
    let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
    assert!(exported["passivity_guard"].is_null(), "{exported}");
    assert!(!archive::text(&folder.path().join("unit.fmu"), "documentation/index.html").contains("Passivity guard"));
    let restitution = |expected: &dyn Fn(f64) -> bool| {
        let predicted = run(folder.path(), ["predict", "scene.toml", "--json"]).with_status(0).json();
        let restitution = predicted["laws"][0]["restitution"].as_f64().unwrap();
        assert!(expected(restitution), "{restitution}");
    };
    restitution(&|e| e > 1.05);
    write(folder.path(), "stronge", "passivity_guard = true");
    restitution(&|e| (e - 1.0).abs() < 1e-13);
}

#[test]
fn the_stated_range_of_the_guard_ends_where_energy_begins_to_be_lost() {
    let folder = empty_folder();
    write(folder.path(), "stronge", "passivity_guard = true");
    let exported = run(folder.path(), ["export", "scene.toml", "-o", "unit.fmu", "--json"]).with_status(0).json();
    let ranges = exported["passivity_guard"].as_array().unwrap();
    let [from, to] = [0, 1].map(|end| ranges[0][end].as_f64().unwrap());
    // d_y = R (3 pi 1.1 S/(4 E*))^2 of 5 mm on mild steel
    let ratio = 3.0 * std::f64::consts::PI * 1.1 * 300e6 / (4.0 * 206e9 / (1.0 - 0.3 * 0.3));
    let d_y = 0.005 * ratio * ratio;
    let lost = |x: f64| {
        let to = format!("{:e}", x * d_y);
        run(folder.path(), ["curve", "scene.toml", "--to", &to, "-o", "curve.csv"]).with_status(0);
        let table = std::fs::read_to_string(folder.path().join("curve.csv")).unwrap();
        let row = table.lines().last().unwrap().split(',').map(|cell| cell.parse().unwrap_or(f64::NAN));
        let row: Vec<f64> = row.collect();
        // the dissipated energy at the end, in F_y d_y with F_y = 1.1 pi S R d_y
        row[8] / (1.1 * std::f64::consts::PI * 300e6 * 0.005 * d_y * d_y)
    };
    assert!(ranges.len() == 1 && (from - 1.0).abs() < 1e-12, "{exported}");
    assert!(lost(0.999 * to).abs() < 1e-12 && lost(0.5 * to).abs() < 1e-12, "{}", lost(0.999 * to));
    assert!(lost(1.001 * to) > 1e-6, "{}", lost(1.001 * to));
}
