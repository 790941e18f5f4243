//! The law `brinell` where the contact is not small, compared with finite elements with large deformation in `data/truth/`.

use crate::finite_elements::columns;
use crate::law_materials::force;
use crate::physics::{AnyModel, brinell, unit};
use brinell_contact::{Body, Loading, Pair, TwoBodies};

/// A plane under a rigid sphere of 1 m with this `E*/S`.
fn model(ratio: f64) -> AnyModel {
    let [rigid, metal] = [(1.0, f64::INFINITY), (f64::INFINITY, 0.91e11)].map(|(radius, youngs_modulus)| Body {
        radius,
        youngs_modulus,
        poissons_ratio: 0.3,
    });
    brinell(Pair::new(&rigid, &metal, 1e11 / ratio).expect("they touch"), TwoBodies::under_rigid(0.0))
}

/// Indentation, force and contact radius of the finite elements, in units of first yield.
fn curve(ratio: f64) -> Vec<[f64; 3]> {
    let file = format!("loading_large_deformation_E{ratio}");
    let file = if ratio == 200.0 { format!("pairs/{file}") } else { file };
    columns(&file, ["delta_over_dy", "F_over_Fy", "a_over_ay"]).expect("a curve")
}

/// The Brinell number that the law gives for the load of the finite elements, over the one of their own contact radius.
#[test]
fn the_brinell_number_is_that_of_finite_elements_with_large_deformation() {
    for (ratio, widest) in [(100.0, 0.5), (200.0, 0.37)] {
        let model = model(ratio);
        let (mut worst, unit) = (0.0f64, unit(&model.pair));
        let in_metres = |[x, f, a]: [f64; 3]| [x * unit.indentation, f * unit.force, a * unit.indentation.sqrt()];
        for [d, load, a] in curve(ratio).into_iter().map(in_metres).filter(|[.., a]| *a > 0.1 && *a < widest) {
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
        let model = model(ratio);
        let unit = unit(&model.pair);
        let rows = curve(ratio);
        for depth in ["3", "10", "30", "82.5", "200"] {
            let unloading = format!("unloading_large_deformation_E{ratio}_from_{depth}");
            let back = columns(&unloading, ["delta_over_dy", "F_over_Fy"]).expect("an unloading");
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
