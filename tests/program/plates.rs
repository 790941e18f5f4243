//! What `predict` says about the size of a plate that gives way, against a plate with an edge.

use brinell_testing::folder::{Folder, number};
use std::f64::consts::PI;

/// Number of modes of a plate with an edge.
const MODES: usize = 3000;

/// The roots of J0, by Newton's method.
fn roots() -> Vec<f64> {
    let root = |index: usize| {
        let guess = (index as f64 + 0.75) * PI;
        (0..4).fold(guess, |x, _| x + libm::j0(x) / libm::j1(x))
    };
    (0..MODES).map(root).collect()
}

/// How far the middle of a round plate has moved after half a wave of a sine of force, relative to an infinite plate.
///
/// The edge is supported and free of the sum of the curvatures, so that the modes are those of a membrane: J0(j r/R). `radius`
/// is in units of sqrt(a t), with the time t of the contact and a = sqrt(D/(rho h)).
fn motion_of_the_middle(roots: &[f64], radius: f64) -> f64 {
    let mode = |root: &f64| {
        let frequency = (root / radius) * (root / radius);
        let mass = PI * radius * radius * libm::j1(*root) * libm::j1(*root);
        PI * libm::sin(frequency) / ((PI * PI - frequency * frequency) * mass * frequency)
    };
    // the infinite plate moves by an eighth of the momentum
    roots.iter().map(mode).sum::<f64>() / (0.125 * 2.0 / PI)
}

/// The force at one point from which a plate with a supported edge bends for good, whatever its size, by the lines in which it yields: the
/// work of a force in the middle of a polygon with many edges, against that of the moment `M` along its spokes and edge.
fn collapse(strength: f64, thickness: f64) -> f64 {
    let moment = strength * thickness * thickness / 4.0;
    let edges = 1000.0;
    // each of the triangles turns by 1/r about its edge; the spokes yield by what their neighbours turn against each other
    let half = PI / edges;
    moment * edges * 2.0 * libm::tan(half)
}

#[test]
fn a_thin_sheet_that_bends_for_good_is_told_from_the_force_at_which_it_does() {
    let (density, radius): (f64, f64) = (917.0, 12.5e-3);
    for thickness in [0.8e-3, 2e-3, 5e-3, 20e-3] {
        let mut seen = [false; 2];
        for speed in [1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0, 30.0] {
            // hail, which is stiffer here than ice would be if it broke
            let text = format!(
                "name = \"unit\"\nimpactor = {{ radius = {radius:?}, youngs_modulus = 9e9, poissons_ratio = 0.33, density = {density:?} }}\n\
                 target = {{ material = \"aluminium 1100-O\", yield_strength = 35e6, plate_thickness = {thickness:?} }}\n\
                 impact = {{ speed = {speed:?} }}\n"
            );
            let answer = Folder::of(&text).json("predict scene.toml");
            let force = number(&answer, "laws/0/largest_force");
            let warned = answer["laws"][0]["warnings"].to_string().contains("itself bends for good from");
            let collapse = collapse(35e6, thickness);
            assert_eq!(warned, force > collapse, "{thickness} m, {speed} m/s: {force} N of {collapse} N");
            seen[usize::from(warned)] = true;
        }
        assert!(seen[0], "{thickness}: a slow one only dents");
        assert!(seen[1] || thickness > 10e-3, "{thickness}: a fast one bends it");
    }
}

#[test]
fn a_plate_whose_edge_is_where_predict_says_moves_almost_like_an_infinite_one() {
    let roots = roots();
    let (modulus, density, ratio): (f64, f64, f64) = (206e9, 7850.0, 0.3);
    for (thickness, speed) in [(1e-3, 0.1), (4e-3, 3.0), (10e-3, 10.0)] {
        let text = format!(
            "name = \"unit\"\nimpactor = {{ radius = 5e-3 }}\n\
             target = {{ material = \"mild steel\", plate_thickness = {thickness:?} }}\n\
             impact = {{ mass = 4.11e-3, speed = {speed:?} }}\n"
        );
        let answer = Folder::of(&text).json("predict scene.toml");
        let notes = answer["notes"].to_string();
        let (_, rest) = notes.split_once("bending waves spread to a radius of ").expect("the note");
        let (edge, _) = rest.split_once(" mm: the plate must be larger").expect("a radius in millimetres");
        let time = number(&answer, "laws/0/loading_time") + number(&answer, "laws/0/unloading_time");
        let spread = thickness * (modulus / (12.0 * density * (1.0 - ratio * ratio))).sqrt();
        let front = 1e-3 * edge.parse::<f64>().unwrap() / (spread * time).sqrt();
        let [near, at, far] = [0.5, 1.0, 2.0].map(|part| motion_of_the_middle(&roots, part * front) - 1.0);
        assert!((near.abs() - 0.3).abs() < 0.02, "an edge at half of the radius: {near}");
        assert!((at.abs() - 0.05).abs() < 0.005, "an edge at the radius: {at}");
        assert!(far.abs() < 0.003, "an edge at twice the radius: {far}");
    }
}
