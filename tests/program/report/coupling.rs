//! The ways to couple in a report: orders, stable limits, recommendations.

use super::{DEFAULT, ELASTIC, row, rows};
use serde_json::Value;
use std::fs;

/// The ways of an FMU that knows the mass.
const KNOWN: [&str; 2] = ["mass known", "mass known, parallel"];

#[test]
fn fitted_orders_are_those_of_the_methods() {
    for (way, order) in [("late force", 1.0), ("predicted_force", 2.0), ("leap-frog", 2.0), ("input derivatives", 3.0)]
    {
        let fitted = row(&DEFAULT.1, "orders", way)["order"].as_f64().expect("a fitted order");
        assert!((fitted - order).abs() < 0.3, "{way}: order {fitted} instead of {order}");
    }
}

#[test]
fn an_fmu_that_knows_the_mass_is_exact_to_rounding_for_every_step() {
    for way in KNOWN {
        let known = rows(&DEFAULT.1, "precision").iter().filter(|row| row["way"] == way);
        let errors: Vec<f64> = known.map(|row| row["error_of_restitution"].as_f64().expect("an error")).collect();
        assert_eq!(errors.len(), 8, "{way}: 2 to 256 steps per contact");
        assert!(errors.iter().all(|error| *error < 1e-11), "{way}: {errors:?}");
    }
}

#[test]
fn the_stable_limits_of_an_elastic_scene_are_those_of_theory() {
    // the smallest root of the polynomial in (h omega)^2 for which input derivatives have the eigenvalue -1
    let polynomial = |z: f64| ((z - 48.0) * z + 432.0) * z - 576.0;
    let (mut low, mut high) = (0.0, 2.0f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if polynomial(middle) < 0.0 { low = middle } else { high = middle }
    }
    for (way, theory) in [("predicted_force", 2.0), ("leap-frog", 2.0), ("input derivatives", low.sqrt())] {
        let row = row(&ELASTIC, "limits", way);
        let told = row["elastic_theory"].as_f64().expect("a limit of theory");
        assert!((told / theory - 1.0).abs() < 1e-12, "{way}: theory says {theory}, the report {told}");
        let limit = row["largest_stable_h_sqrt(K/m)"].as_f64().expect("a limit");
        assert!((limit / theory - 1.0).abs() < 0.05, "{way}: h sqrt(K/m) = {limit} instead of {theory}");
    }
    for (way, words) in [
        ("late force", "at no step that was tried"),
        ("mass known", "at every step that was tried"),
        ("mass known, parallel", "at every step that was tried"),
    ] {
        let row = row(&ELASTIC, "limits", way);
        assert_eq!(row["stable"], words, "{way}");
        assert!(row["largest_stable_h_sqrt(K/m)"].is_null(), "{way} has no limit: {row}");
    }
}

#[test]
fn the_json_has_the_stable_limit_of_every_way() {
    let names = |rows: &[Value]| rows.iter().map(|row| row["way"].to_string()).collect::<Vec<_>>();
    let used = ELASTIC["use"]["ways"].as_array().expect("a list");
    assert_eq!(names(rows(&ELASTIC, "limits")), names(used));
    assert!(row(&ELASTIC, "limits", "leap-frog")["largest_stable_step_s"].as_f64().expect("a step") > 0.0);
    assert!(row(&ELASTIC, "limits", "late force")["largest_stable_step_s"].is_null(), "it is stable at no step");
}

#[test]
fn each_co_simulation_algorithm_has_one_recommended_way_the_cheapest_that_reaches_one_percent() {
    let ways = DEFAULT.1["use"]["ways"].as_array().expect("a list");
    let time = |way: &Value| way["one_percent"]["time_per_impact_s"].as_f64().unwrap_or(f64::INFINITY);
    for master in ["serial (Gauss-Seidel)", "parallel (Jacobi)"] {
        let ways: Vec<_> = ways.iter().filter(|way| way["master"] == master).collect();
        let recommended: Vec<_> = ways.iter().filter(|way| way["recommended"] == true).collect();
        assert_eq!(recommended.len(), 1, "{master}: {ways:?}");
        assert!(ways.iter().all(|way| time(way) >= time(recommended[0])), "{master}: {ways:?}");
        assert!(recommended[0]["one_percent"]["error_of_restitution"].as_f64().expect("an error") < 0.01);
    }
    let exact = ways.iter().filter(|way| way["exact"] == true).map(|way| way["way"].as_str().expect("a name"));
    assert_eq!(exact.collect::<Vec<_>>(), KNOWN);
}

/// Step and highest rebound energy of a way, over the steps of the map.
fn energies(data: &Value, way: &str) -> Vec<(f64, f64)> {
    let rows = rows(data, "stability").iter().filter(|row| row["way"] == way);
    let number = |value: &Value| value.as_f64().expect("a number");
    rows.map(|row| (number(&row["h_sqrt(K/m)"]), number(&row["highest_rebound_over_incoming_energy"]))).collect()
}

#[test]
fn the_map_has_every_way_at_every_step() {
    let steps = |way: &str| energies(&DEFAULT.1, way).into_iter().map(|(step, _)| step).collect::<Vec<_>>();
    let first = steps("late force");
    assert_eq!(first.len(), 41);
    assert!((first[0] / 0.02 - 1.0).abs() < 1e-12 && (first[40] / 8.0 - 1.0).abs() < 1e-12, "{first:?}");
    for way in ["predicted_force", "leap-frog", "input derivatives", "mass known", "mass known, parallel"] {
        assert_eq!(steps(way), first, "{way}");
    }
    let map = fs::read_to_string(DEFAULT.0.path().join("report/stability.svg")).expect("a map");
    for way in ["late force", "predicted_force", "leap-frog", "input derivatives", "mass known"] {
        assert!(map.contains(way), "the map has no row {way}");
    }
}

#[test]
fn an_fmu_that_knows_the_mass_creates_energy_at_no_step() {
    for (data, way) in [&DEFAULT.1, &*ELASTIC].into_iter().flat_map(|data| KNOWN.map(|way| (data, way))) {
        for (step, energy) in energies(data, way) {
            assert!(energy <= 1.0 + 1e-9, "{way}: h sqrt(K/m) = {step}: {energy}");
        }
    }
}

#[test]
fn a_delayed_force_creates_energy_at_a_large_step() {
    let (step, energy) = *energies(&DEFAULT.1, "late force").last().expect("steps");
    assert!(energy > 1.0, "h sqrt(K/m) = {step}: {energy}");
}

#[test]
fn the_error_of_the_dent_has_the_order_of_the_method_too() {
    let dents = |way: &str| -> Vec<f64> {
        let points = rows(&DEFAULT.1, "precision").iter().filter(|row| row["way"] == way);
        points.map(|row| row["error_of_dent"].as_f64().expect("an error")).collect()
    };
    // from 32 to 256 steps per contact
    for (way, order) in [("late force", 1.0), ("leap-frog", 2.0), ("input derivatives", 3.0)] {
        let dents = dents(way);
        let fallen = (dents[4] / dents[7]).log2() / 3.0;
        assert!((fallen - order).abs() < 0.35, "{way}: order {fallen} instead of {order}");
    }
}
