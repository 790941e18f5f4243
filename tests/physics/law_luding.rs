//! Luding's spring: forces, dents and restitution compared with his formulas.

use crate::physics::{self, MASS, go, model, pressed, unit};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::{History, Loading};

/// `k_1` [N/m], `k_2/k_1`, `d*` [m] and the deepest dent [m] of the reference constants on the pair of the tables.
fn constants() -> (f64, f64, f64, f64) {
    let pair = physics::mild();
    let unit = unit(&pair);
    // phi 2R, and k_2/(k_2 - k_1) of it
    let dent = 0.05 * 2.0 * 0.005;
    (unit.force / unit.indentation, 4.0, 4.0 / 3.0 * dent, dent)
}

#[track_caller]
fn close(what: &str, got: f64, expected: f64) {
    // a few rounding errors
    assert!((got / expected - 1.0).abs() <= 32.0 * f64::EPSILON, "{what}: {got:e} instead of {expected:e}");
}

/// The force according to Luding's section 2.3 of a contact at `d` with the largest indentation `largest` [m].
fn luding(largest: f64, d: f64) -> f64 {
    let (k1, ratio, limit, _) = constants();
    if largest >= limit {
        let line = ratio * k1 * (d - limit) + k1 * limit;
        let below = if d >= largest && d < limit { k1 * d } else { line };
        return below.max(0.0);
    }
    let k2 = k1 + (ratio - 1.0) * k1 * largest / limit;
    (k1 * d).min(k2 * (d - largest) + k1 * largest).max(0.0)
}

#[test]
fn the_force_is_luding_s_on_the_way_in_out_and_in_again() {
    let model = model("luding", "luding");
    let (k1, _, limit, _) = constants();
    for largest in [1e-6, 0.1, 0.5, 0.999, 1.0, 1.5, 40.0].map(|part| part * limit) {
        let mut history = History::start(&model, 0.0).expect("within range");
        for part in [0.1, 0.4, 0.7, 1.0, 0.95, 0.8, 0.5, 0.2, 0.9, 0.99, 1.0] {
            let rising = history.max_indentation() < largest;
            go(&mut history, &model, part * largest);
            let d = history.indentation();
            let expected = luding(if rising { d } else { largest }, d);
            let difference = (history.force() - expected).abs();
            // the difference of two forces as large as those at the peak
            assert!(difference <= 64.0 * f64::EPSILON * (4.0 * k1 * largest), "{largest:e}, {part}: {expected:e}");
        }
    }
}

#[test]
fn the_dent_deepens_up_to_the_limit_depth_and_no_further() {
    let model = model("luding", "luding");
    let (_, ratio, limit, deepest) = constants();
    for part in [1e-6, 0.1, 0.5, 0.999] {
        let largest = part * limit;
        let dent = pressed(&model, largest).residual_indentation(&model);
        close("dent", dent, largest * ((ratio - 1.0) * part / (1.0 + (ratio - 1.0) * part)));
        assert!(dent < deepest);
    }
    for part in [1.0, 1.5, 40.0] {
        close("deepest dent", pressed(&model, part * limit).residual_indentation(&model), deepest);
    }
}

#[test]
fn restitution_is_the_root_of_the_stiffness_ratio_at_the_largest_indentation() {
    let model = model("luding", "luding");
    let (k1, ratio, limit, _) = constants();
    let frequency = (k1 / MASS).sqrt();
    for part in [1e-6, 0.01, 0.3, 0.9] {
        let impact = Impact { mass: MASS, speed: part * limit * frequency };
        let prediction = predict(&model, &impact).expect("an ordinary impact");
        close("largest indentation", prediction.max_indentation, part * limit);
        close("restitution", prediction.restitution, (1.0 / (1.0 + (ratio - 1.0) * part)).sqrt());
        // a quarter of a period of each spring
        let quarter = std::f64::consts::FRAC_PI_2 / frequency;
        let times = [prediction.loading_time / quarter, prediction.unloading_time / (prediction.restitution * quarter)];
        for time in times {
            assert!((time - 1.0).abs() < 1e-9, "{time} quarters of a period");
        }
    }
}

#[test]
fn beyond_the_limit_no_more_energy_is_lost() {
    let model = model("luding", "luding");
    let (k1, ratio, limit, deepest) = constants();
    // k_1 d*^2/2 - k_2 (d* - 2 R phi)^2/2
    let elastic = limit - deepest;
    let lost = 0.5 * k1 * limit * limit - 0.5 * ratio * k1 * elastic * elastic;
    for part in [1.0, 2.0, 30.0] {
        let dissipated = pressed(&model, part * limit).dissipated_energy(&model);
        let rounding = 16.0 * f64::EPSILON * model.loading.work(&model.pair, part * limit);
        assert!((dissipated - lost).abs() <= rounding, "{dissipated:e} at {part}, not {lost:e}");
    }
}
