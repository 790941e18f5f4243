//! `predict --restitution`: the inverse problem gives every speed and yield strength that explains a rebound.

use crate::command::{empty_folder, run};
use brinell_testing::long::some;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A scene like the default one with another yield strength [Pa].
fn scene_with(yield_strength: f64) -> String {
    format!(
        "name = \"ball\"\n[impactor]\nradius = 5e-3\n[target]\nmaterial = \"mild steel\"\n\
         yield_strength = {yield_strength:e}\n[impact]\nmass = 4.11e-3\nspeed = 1.0\n"
    )
}

/// The predicted restitution for the scene in `folder`.
fn restitution(folder: &Path, text: &str, law: &str, speed: f64) -> f64 {
    fs::write(folder.join("scene.toml"), text).unwrap();
    let arguments = ["predict", "scene.toml", "--json", "--laws", law, "--speed", &format!("{speed:e}")];
    let predicted = run(folder, arguments).with_status(0).json();
    predicted["laws"][0]["restitution"].as_f64().unwrap()
}

/// The explanations of the restitution `goal` with `law`.
fn explained(folder: &Path, law: &str, goal: f64) -> Value {
    fs::write(folder.join("scene.toml"), scene_with(300e6)).unwrap();
    let arguments = ["predict", "scene.toml", "--json", "--laws", law, "--restitution", &goal.to_string()];
    run(folder, arguments).with_status(0).json()["laws"][0].clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn every_solution_has_the_requested_rebound() {
    let folder = empty_folder();
    // the number of solutions: counted in the curves of restitution over speed
    let cases = [
        ("big-alabo", 0.87, 3),
        ("big-alabo", 0.5, 1),
        ("zhao-maietta-chang", 0.735, 3),
        ("brake-2012-tangent", 0.99, 3),
        ("brinell", 0.446, 1),
        ("jackson-green", 0.7, 1),
    ];
    for (law, goal, count) in some(cases, 2) {
        let explained = explained(folder.path(), law, goal);
        let speeds = numbers(&explained["speed"]["solutions"]);
        let strengths = numbers(&explained["yield_strength"]["solutions"]);
        assert_eq!(speeds.len(), count, "{law} at {goal}: {explained}");
        assert_eq!(strengths.len(), count, "{law} at {goal}: {explained}");
        for speed in speeds {
            let got = restitution(folder.path(), &scene_with(300e6), law, speed);
            assert!((got - goal).abs() < 1e-9, "{law} at {speed} m/s: {got}, not {goal}");
        }
        for strength in strengths {
            let got = restitution(folder.path(), &scene_with(strength), law, 1.0);
            assert!((got - goal).abs() < 1e-9, "{law} with {strength} Pa: {got}, not {goal}");
        }
    }
}

/// The published law has a minimum of the restitution just above yield, where two solutions approach each other.
#[test]
fn two_solutions_closer_than_the_grid_are_both_found() {
    let folder = empty_folder();
    let speeds = |goal: f64| numbers(&explained(folder.path(), "big-alabo", goal)["speed"]["solutions"]);
    // the minimum by trying smaller and smaller values: two solutions approach each other, then only the third remains
    let (mut low, mut high) = (0.8, 0.86);
    while high - low > 1e-9 {
        let middle = 0.5 * (low + high);
        match speeds(middle).len() {
            1 => low = middle,
            3 => high = middle,
            other => panic!("{other} solutions at {middle}"),
        }
    }
    let found = speeds(high);
    assert!(found[1] / found[0] < 1.001, "{found:?}: closer than the points of any coarse grid");
}

#[test]
fn an_elastic_rebound_is_explained_by_every_speed_below_yield() {
    let folder = empty_folder();
    let explained = explained(folder.path(), "big-alabo", 1.0);
    let ranges = explained["speed"]["ranges"].as_array().unwrap();
    assert_eq!(ranges.len(), 1, "{explained}");
    // the speed at which the scene's target yields, according to predict
    let arguments = ["predict", "scene.toml", "--json"];
    let onset = &run(folder.path(), arguments).with_status(0).json()["laws"][0]["onsets"][0]["speed"];
    let end = numbers(&ranges[0])[1];
    assert!((end / onset.as_f64().unwrap() - 1.0).abs() < 1e-6, "{end}, yields at {onset}");
}

/// The fitted dent of Jackson and Green begins with a jump of the restitution down from 1.
#[test]
fn a_value_that_restitution_jumps_past_is_no_solution() {
    let folder = empty_folder();
    fs::write(folder.path().join("scene.toml"), scene_with(300e6)).unwrap();
    let arguments = ["predict", "scene.toml", "--laws", "jackson-green/jackson,brinell", "--restitution", "0.999"];
    let run = run(folder.path(), arguments).with_status(0);
    assert!(run.out.contains("jumps past it") && run.out.contains("with no speed"), "{run:#?}");
}
