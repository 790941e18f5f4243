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

const UNLOADING: [(f64, &str); 5] = [
    (3.0, include_str!("../data/truth/unloading_from_3.csv")),
    (10.0, include_str!("../data/truth/unloading_from_10.csv")),
    (30.0, include_str!("../data/truth/unloading_from_30.csv")),
    (82.5, include_str!("../data/truth/unloading_from_82.5.csv")),
    (200.0, include_str!("../data/truth/unloading_from_200.csv")),
];

/// An impact, quasi-static, in yield indentations and yield forces.
pub struct Impact {
    /// Largest indentation and largest force.
    pub largest: Point,
    /// Rebound and dent, if unloading was computed.
    pub rebound: Option<Rebound>,
}

/// The result of unloading.
pub struct Rebound {
    pub restitution: f64,
    /// Depth of the dent.
    pub dent: f64,
}

/// The impacts whose unloading was computed.
pub fn impacts() -> Vec<Impact> {
    let curve = loading();
    UNLOADING.iter().map(|(x, rows)| computed(&curve, *x, rows)).collect()
}

/// The impact that unloads from `x` along `rows`.
fn computed(curve: &[Point], x: f64, rows: &str) -> Impact {
    let points = path(rows);
    let back: f64 = points.windows(2).map(|pair| 0.5 * (pair[0].x - pair[1].x) * (pair[0].f + pair[1].f)).sum();
    let (largest, energy) = loaded(curve, x);
    let dent = points.last().map_or(x, |point| point.x);
    Impact { largest, rebound: Some(Rebound { restitution: (back / energy).sqrt(), dent }) }
}

/// The points of an unloading, from the largest indentation down.
fn path(rows: &str) -> Vec<Point> {
    let points = rows.lines().filter_map(|line| line.strip_prefix("unload,")).map(|line| {
        let mut columns = line.split(',');
        let [x, f] = [(); 2].map(|()| number(columns.next().unwrap_or_default()));
        Point { x, f }
    });
    points.collect()
}

/// Force and work at the indentation `x`: interpolated linearly, with Hertz's law before the first point.
fn loaded(curve: &[Point], x: f64) -> (Point, f64) {
    let mut work = 0.4 * curve[0].x * curve[0].f;
    for pair in curve.windows(2) {
        let (from, to) = (&pair[0], &pair[1]);
        let end = x.min(to.x);
        let f = from.f + (to.f - from.f) * (end - from.x) / (to.x - from.x);
        work += 0.5 * (end - from.x) * (from.f + f);
        if x <= to.x {
            return (Point { x, f }, work);
        }
    }
    (Point { x, f: f64::NAN }, work)
}

/// The impact with an `energy` [yield forces times yield indentations]; `None` beyond the end of the loading curve.
pub fn impact(energy: f64) -> Option<Impact> {
    let curve = loading();
    let (mut low, mut high) = (curve.first()?.x, curve.last()?.x);
    if !(loaded(&curve, low).1..loaded(&curve, high).1).contains(&energy) {
        return None;
    }
    while high - low > 1e-12 * high {
        let middle = 0.5 * (low + high);
        if loaded(&curve, middle).1 > energy { high = middle } else { low = middle }
    }
    let largest = loaded(&curve, low).0;
    let rebound = rebound(low);
    Some(Impact { largest, rebound })
}

/// The rebound from the indentation `x`, between two computed ones: restitution and recovery are nearly powers of it.
fn rebound(x: f64) -> Option<Rebound> {
    let known = impacts();
    let pair = known.windows(2).find(|pair| (pair[0].largest.x..=pair[1].largest.x).contains(&x))?;
    let (one, other) = (pair[0].rebound.as_ref()?, pair[1].rebound.as_ref()?);
    let (from, to) = (pair[0].largest.x, pair[1].largest.x);
    let part = libm::log(x / from) / libm::log(to / from);
    let between = |one: f64, other: f64| one * libm::pow(other / one, part);
    let recovery = between(from - one.dent, to - other.dent);
    Some(Rebound { restitution: between(one.restitution, other.restitution), dent: x - recovery })
}
