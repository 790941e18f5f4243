//! The finite-element curves of the folder `data/truth/`, for comparison.

use brinell_contact::TwoBodies;
use brinell_contact::strength::POISSONS_RATIO;
use brinell_exporter::scene::Scene;

/// Ratio of contact radius to effective radius up to which the curves hold: their strain is small. Large deformation then changes the
/// force by 0.2 % on a plane, and by 2 % on a sphere.
const WIDEST: f64 = 0.1;

/// `a^2/(R d)` of deep dents.
const SPREAD: f64 = 2.6;

/// Whether the bodies of `scene` are those of the curves up to this `indentation` \[m\]: a rigid one on one that does not harden, with a
/// Poisson's ratio of 0.3, and a contact that stays small.
pub fn is_of(scene: &Scene, indentation: f64) -> bool {
    let TwoBodies { hardening_modulus, other, .. } = scene.two_bodies(0);
    let pair = scene.model().pair;
    let is_plain = hardening_modulus == 0.0 && pair.poissons_ratio == POISSONS_RATIO;
    is_plain && other.modulus == f64::INFINITY && SPREAD * indentation < WIDEST * WIDEST * pair.radius
}

/// The truth's unit of indentation is the yield point for this mean pressure over the yield strength.
pub const YIELD_PRESSURE_FACTOR: f64 = 1.1;

const LOADING: &str = include_str!("../data/truth/loading.csv");

/// A point of the loading curve.
pub struct Point {
    /// Indentation in yield indentations.
    pub x: f64,
    /// Force in yield forces.
    pub f: f64,
}

/// The loading curve up to 1000 yield indentations, smoothed to remove the sawtooth of the mesh.
pub fn loading() -> Vec<Point> {
    let point = |line: &str| {
        let columns: Vec<&str> = line.split(',').collect();
        Point { x: number(columns[0]), f: number(columns[2]) }
    };
    LOADING.lines().skip(1).map(point).collect()
}

fn number(text: &str) -> f64 {
    text.parse().expect("the truth is a table of numbers")
}
