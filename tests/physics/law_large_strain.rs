//! The law `brinell` where the contact is not small, compared with finite elements with large deformation in `data/truth/`.

use crate::law_materials::{force, read};
use crate::physics::{AnyModel, brinell, unit};
use brinell_contact::{Body, Loading, Pair, TwoBodies};

/// A plane under a rigid sphere, or a sphere under a rigid plane, with this `E*/S`.
fn model(ratio: f64, is_sphere: bool) -> AnyModel {
    let flat = Body { radius: f64::INFINITY, youngs_modulus: f64::INFINITY, poissons_ratio: 0.3 };
    let rigid = Body { radius: 1.0, ..flat };
    let metal = |radius| Body { radius, youngs_modulus: 0.91e11, poissons_ratio: 0.3 };
    let (body, other) = if is_sphere { (metal(1.0), flat) } else { (metal(f64::INFINITY), rigid) };
    let (impactor, target) = if is_sphere { (body, other) } else { (other, body) };
    let pair = Pair::new(&impactor, &target, 1e11 / ratio).expect("they touch").yielding_in(&body, 1e11 / ratio);
    brinell(pair, TwoBodies { curvature: body.curvature(&other), ..TwoBodies::under_rigid(0.0) })
}

/// The numbers in the columns of these names of a table.
fn columns(file: &str, names: [&str; 3]) -> Vec<[f64; 3]> {
    let text = read(&format!("data/truth/{file}.csv"));
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let head: Vec<_> = lines.next().expect("a head").split(',').collect();
    let places = names.map(|name| head.iter().position(|column| *column == name).expect("a column of this name"));
    let cells = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("a number")).collect();
        places.map(|place| cells[place])
    };
    lines.map(cells).collect()
}

/// Indentation and contact radius over the sphere's radius, and force over `R^2 S`, of the finite elements beyond first yield.
fn curve(ratio: f64, is_sphere: bool) -> Vec<[f64; 3]> {
    let model = model(ratio, is_sphere);
    let unit = unit(&model.pair);
    let scale = unit.force / model.pair.yield_strength;
    let in_yield = ["delta_over_dy", "F_over_Fy", "a_over_ay"];
    let rows = match (ratio, is_sphere) {
        (300.0, true) => columns("pairs/sphere_on_rigid_flat_E300", ["d_over_R", "F_over_R2S", "a_over_R"]),
        (200.0, false) => columns("pairs/loading_large_deformation_E200", ["d_over_R", "F_over_R2S", "a_over_R"]),
        _ => columns(&format!("loading_large_deformation_E{ratio}"), in_yield)
            .into_iter()
            .map(|[d, f, a]| [d * unit.indentation, f * scale, a * unit.indentation.sqrt()])
            .collect(),
    };
    rows.into_iter().filter(|[d, ..]| *d > 1.5 * unit.indentation).collect()
}

/// `E*/S`, whether it is a sphere, the largest `a/R`, and the largest errors of force and contact radius \[%\].
const CURVES: [(f64, bool, f64, [f64; 2]); 4] = [
    (100.0, false, 0.36, [0.7, 0.7]),
    (200.0, false, 0.37, [0.7, 0.7]),
    (1000.0, false, 0.06, [0.7, 0.8]),
    (300.0, true, 0.32, [1.2, 1.3]),
];

#[test]
fn force_and_contact_radius_are_those_of_finite_elements_with_large_deformation() {
    let mut wrong = Vec::new();
    for (ratio, is_sphere, widest, allowed) in CURVES {
        let model = model(ratio, is_sphere);
        let mut worst = [0.0f64; 2];
        let rows: Vec<_> = curve(ratio, is_sphere).into_iter().filter(|[.., a]| *a < widest).collect();
        assert!(rows.len() > 50, "the curve of {ratio} is complete");
        assert!(rows.iter().any(|[.., a]| *a > 0.85 * widest));
        for [d, f, a] in rows {
            let errors = [
                force(&model, d) / model.pair.yield_strength / f - 1.0,
                model.loading.contact_radius(&model.pair, d) / a - 1.0,
            ];
            worst = [0, 1].map(|place| worst[place].max(100.0 * errors[place].abs()));
        }
        println!("E*/S = {ratio}, sphere {is_sphere}: force {:.2} %, radius {:.2} %", worst[0], worst[1]);
        if worst[0] > allowed[0] || worst[1] > allowed[1] {
            wrong.push((ratio, is_sphere));
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// The Brinell number that the law gives for the load of the finite elements, over the one of their own contact radius.
#[test]
fn the_brinell_number_is_that_of_finite_elements_with_large_deformation() {
    for (ratio, widest) in [(100.0, 0.5), (200.0, 0.37)] {
        let model = model(ratio, false);
        let mut worst = 0.0f64;
        for [d, f, a] in curve(ratio, false).into_iter().filter(|[.., a]| *a > 0.1 && *a < widest) {
            let load = f * model.pair.yield_strength;
            let (mut low, mut high) = (0.5 * d, 2.0 * d);
            while high - low > 1e-12 * d {
                let middle = 0.5 * (low + high);
                *(if force(&model, middle) < load { &mut low } else { &mut high }) = middle;
            }
            // the number is the load over the area of a cap
            let depth = |a: f64| a * a / (1.0 + (1.0 - a * a).sqrt());
            let error = depth(a) / depth(model.loading.contact_radius(&model.pair, low)) - 1.0;
            worst = worst.max(100.0 * error.abs());
        }
        println!("E*/S = {ratio}: HBW {worst:.2} %");
        assert!(worst < 1.5, "E*/S = {ratio}: {worst} %");
    }
}

/// The unloading of finite elements in the plane. Their peaks are raw, and the curve is smoothed: the recovered work is scaled by both.
#[test]
fn restitution_is_that_of_finite_elements_with_large_deformation() {
    for ratio in [100.0, 1000.0] {
        let model = model(ratio, false);
        let unit = unit(&model.pair);
        let rows = columns(&format!("loading_large_deformation_E{ratio}"), ["delta_over_dy", "F_over_Fy", "a_over_ay"]);
        for depth in ["3", "10", "30", "82.5", "200"] {
            let text = read(&format!("data/truth/unloading_large_deformation_E{ratio}_from_{depth}.csv"));
            let back: Vec<[f64; 2]> = text
                .lines()
                .filter_map(|line| line.strip_prefix("unload,"))
                .map(|line| {
                    let mut cells = line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN));
                    [cells.next().expect("a depth"), cells.next().expect("a force")]
                })
                .collect();
            let largest: f64 = depth.parse().expect("a number");
            let (mut work, mut smooth) = (0.0, 0.0);
            for pair in rows.windows(2) {
                let ([x, f, _], [to, next, _]) = (pair[0], pair[1]);
                let end = largest.min(to);
                if x < largest {
                    // the ratio to Hertz's law is nearly straight
                    let part = (end - x) / (to - x);
                    let at = |x: f64, f: f64| f / x.powf(1.5);
                    smooth = (at(x, f) + part * (at(to, next) - at(x, f))) * end.powf(1.5);
                    work += (end - x) * (f + smooth) / 2.0;
                }
            }
            work += 0.4 * rows[0][0] * rows[0][1];
            let scale = smooth / back[0][1];
            let recovered: f64 =
                back.windows(2).map(|two| 0.5 * (two[0][0] - two[1][0]) * (two[0][1] + two[1][1])).sum();
            let expected = (recovered * scale * scale / work).sqrt();
            let peak = largest * unit.indentation;
            let got = (model.recovered_work(peak, peak) / model.loading.work(&model.pair, peak)).sqrt();
            let error = 100.0 * (got / expected - 1.0);
            println!("E*/S = {ratio} from {depth}: e {expected:.4}, {error:+.2} %");
            assert!(error.abs() < 1.0, "E*/S = {ratio} from {depth}: {error:+.2} %");
        }
    }
}
