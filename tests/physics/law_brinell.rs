//! The law `brinell` compared with the finite-element results of its fit, in `data/truth/`.

use crate::physics::{AnyModel, advance, model, pressed, unit};
use brinell_contact::Loading;
use std::fs;
use std::path::Path;

/// The rows of a finite-element table, without comments and its heading.
fn truth(name: &str) -> Vec<Vec<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/truth").join(name);
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').map(str::to_string).collect())
        .collect()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn fitted() -> AnyModel {
    model("brinell", "brinell")
}

/// Loading force in units of the yield point.
fn force(model: &AnyModel, x: f64) -> f64 {
    let unit = unit(&model.pair);
    model.loading.segment(&model.pair, x * unit.indentation).force(x * unit.indentation) / unit.force
}

/// The unloading from one depth in the finite-element results: (x, f), from the largest indentation downwards.
fn unloading(depth: &str) -> Vec<(f64, f64)> {
    let rows = truth(&format!("unloading_from_{depth}.csv"));
    rows.iter().filter(|row| row[0] == "unload").map(|row| (number(&row[1]), number(&row[2]))).collect()
}

const DEPTHS: [&str; 5] = ["3", "10", "30", "82.5", "200"];

#[test]
fn the_loading_force_is_within_a_third_of_a_percent_of_the_truth_up_to_a_thousand_yield_indentations() {
    let model = fitted();
    let rows = truth("loading.csv");
    assert!(rows.len() > 300 && number(&rows[rows.len() - 1][0]) >= 999.0, "the truth is complete");
    for row in rows {
        let (x, expected) = (number(&row[0]), number(&row[2]));
        let error = force(&model, x) / expected - 1.0;
        // the requirement is 1 %; the fit reaches 0.31 % at x = 1000
        assert!(error.abs() < 3.2e-3, "x = {x}: {:.3} %", 100.0 * error);
    }
}

#[test]
fn the_contact_radius_follows_the_truth_within_its_own_sawtooth() {
    let model = fitted();
    let unit = unit(&model.pair);
    for row in truth("loading.csv").iter().filter(|row| number(&row[0]) >= 0.8) {
        let (x, expected) = (number(&row[0]), number(&row[3]));
        let radius = model.loading.contact_radius(&model.pair, x * unit.indentation);
        let error = radius / (model.pair.radius * unit.indentation).sqrt() / expected - 1.0;
        assert!(error.abs() < 6e-3, "x = {x}: {:.3} %", 100.0 * error);
    }
}

/// Force within 0.25 % up to 100 yield indentations, 0.52 % up to 1000 and 0.23 % beyond; contact radius within 0.2 %; mean
/// pressure within 0.4 %. The table's own errors are 0.15 %, 0.4 to 0.7 % and 0.7 to 1 % in force, and 0.4 % in radius.
#[test]
fn force_and_radius_follow_the_deep_table_up_to_three_thousand_yield_indentations() {
    let model = fitted();
    let unit = unit(&model.pair);
    let a_y = (model.pair.radius * unit.indentation).sqrt();
    let rows = truth("pairs/one_body_loading_to_3000.csv");
    assert!(rows.len() > 300 && number(&rows[rows.len() - 1][0]) == 3000.0, "the table is complete");
    for row in rows {
        let [x, expected_force, expected_radius, expected_pressure] = [0, 2, 3, 4].map(|column| number(&row[column]));
        if x < 1.0 {
            continue; // Hertz's law, which the other table shows better
        }
        let (force, radius) = (force(&model, x), model.loading.contact_radius(&model.pair, x * unit.indentation) / a_y);
        let pressure = 1.1 * force / radius.powi(2);
        let force_error = if x < 100.0 { 2.5e-3 } else { 5.2e-3 };
        for (name, got, expected, largest) in [
            ("force", force, expected_force, if x < 1000.0 { force_error } else { 2.3e-3 }),
            ("radius", radius, expected_radius, 2e-3),
            ("mean pressure", pressure, expected_pressure, 4e-3),
        ] {
            let error = got / expected - 1.0;
            assert!(error.abs() < largest, "{name} at x = {x}: {:.3} %", 100.0 * error);
        }
    }
}

#[test]
fn the_unloading_path_is_within_half_a_percent_of_the_largest_force() {
    let model = fitted();
    let unit = unit(&model.pair);
    for depth in DEPTHS {
        let points = unloading(depth);
        let (x_m, f_m) = points[0];
        let mut history = pressed(&model, x_m * unit.indentation);
        for (x, f) in points {
            let step = x * unit.indentation - history.indentation();
            advance(&mut history, &model, step);
            let error = (history.force() / unit.force - f) / f_m;
            // the requirement is 2 %
            assert!(error.abs() < 5e-3, "from {depth} at x = {x}: {:.3} % of F_m", 100.0 * error);
        }
    }
}

#[test]
fn recovery_dissipation_and_restitution_are_within_one_percent_of_the_truth() {
    // x_m, recovery in d_y, returned work over loading work: the table in data/truth/README.md
    let table = [
        (3.0, 2.516, 0.8482),
        (10.0, 6.030, 0.6031),
        (30.0, 12.672, 0.4164),
        (82.5, 24.659, 0.2874),
        (200.0, 43.413, 0.2028),
    ];
    let model = fitted();
    let unit = unit(&model.pair);
    for (x_m, recovery, returned) in table {
        let largest = x_m * unit.indentation;
        let path = model.unloading_path(largest);
        let ratio = model.recovered_work(largest, largest) / model.loading.work(&model.pair, largest);
        let errors = [
            ("recovery", (path.upper - path.lower) / unit.indentation / recovery - 1.0),
            ("dissipation", (1.0 - ratio) / (1.0 - returned) - 1.0),
            ("restitution", (ratio / returned).sqrt() - 1.0),
        ];
        let dent = path.lower / unit.indentation / (x_m - recovery) - 1.0;
        assert!(dent.abs() < 6e-3, "dent from {x_m}: {:.3} %", 100.0 * dent);
        for (name, error) in errors {
            assert!(error.abs() < 0.01, "{name} from {x_m}: {:.3} %", 100.0 * error);
        }
    }
}

/// Value and slope at the corners, within the rounding of the three terms of the slope.
#[test]
fn force_and_slope_are_continuous_at_every_knot() {
    let model = fitted();
    let d_y = unit(&model.pair).indentation;
    for knot in [1.0, 2.0, 5.0, 12.0, 30.0, 80.0, 250.0, 700.0, 2000.0] {
        let border = knot * d_y;
        let below = model.loading.segment(&model.pair, border.next_down().next_down());
        let above = model.loading.segment(&model.pair, border.next_up());
        assert!(below != above, "{knot} is no knot");
        let (force_below, force_above) = (below.force(border), above.force(border));
        assert!((force_below - force_above).abs() < 1e-14 * force_above, "force at {knot}");
        let (slope_below, slope_above) = (below.stiffness(border), above.stiffness(border));
        assert!((slope_below - slope_above).abs() < 1e-13 * slope_above, "slope at {knot}");
    }
}

/// Results of the program that made the fit, with all its printed digits.
#[test]
fn the_law_equals_the_fitted_one() {
    // x, f, w, a/a_y, x_f, W_rec/W
    let table = [
        [0.95, 9.259454628e-1, 3.518592758e-1, 9.746794345e-1, 0.0, 1.0],
        [1.5, 1.820555277, 1.099462360, 1.231702881, 5.635966831e-2, 9.673259378e-1],
        [3.0, 4.915419414, 6.058482873, 1.797973109, 4.836589017e-1, 8.491201469e-1],
        [13.93, 3.888394521e1, 2.328807896e2, 4.374982569, 6.368542259, 5.426943839e-1],
        [82.5, 3.550391077e2, 1.318443741e4, 1.195582352e1, 5.786152996e1, 2.879914814e-1],
        [1000.0, 6.302415723e3, 2.967661770e6, 4.803253210e1, 8.867549794e2, 1.027854009e-1],
        [2600.0, 1.780911972e4, 2.217962300e7, 8.031035012e1, 2.404684866e3, 6.647085443e-2],
        [1e6, 7.292046800e6, 3.645447327e12, 1.618683555e3, 9.958170755e5, 3.466480933e-3],
    ];
    let model = fitted();
    let unit = unit(&model.pair);
    for [x, f, w, radius, dent, returned] in table {
        let largest = x * unit.indentation;
        let work = model.loading.work(&model.pair, largest);
        let a_y = (model.pair.radius * unit.indentation).sqrt();
        let pairs = [
            ("f", force(&model, x), f),
            ("w", work / (unit.force * unit.indentation), w),
            ("a", model.loading.contact_radius(&model.pair, largest) / a_y, radius),
            ("x_f", model.unloading_path(largest).lower / unit.indentation, dent),
            ("W_rec/W", model.recovered_work(largest, largest) / work, returned),
        ];
        for (name, got, expected) in pairs {
            // half a unit in the tenth digit
            assert!(
                (got - expected).abs() <= 5.1e-10 * expected.abs(),
                "{name} at x = {x}: {got} instead of {expected}"
            );
        }
    }
}

#[test]
fn the_constants_in_the_source_equal_those_of_the_fit() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/fit/brinell_law.json");
    let written: serde_json::Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let list = |name: &str| -> Vec<f64> {
        written[name].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
    };
    let loading = brinell_contact::loading::Brinell::REFERENCE;
    let unloading = brinell_contact::unloading::Brinell::REFERENCE;
    assert_eq!(loading.knots.to_vec(), list("knots"));
    assert_eq!(loading.force_slopes.to_vec(), list("force_slopes"));
    assert_eq!(loading.area_slopes.to_vec(), list("area_slopes"));
    let shape = [unloading.height, unloading.onset, unloading.decline];
    let names = ["unloading_height", "unloading_onset", "unloading_decline"];
    assert_eq!(shape.map(Some), names.map(|name| written[name].as_f64()));
}
