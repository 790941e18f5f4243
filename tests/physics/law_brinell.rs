//! The law `brinell` is the one that was fitted.

use crate::law_materials::read;
use crate::physics::{AnyModel, model, unit};
use brinell_contact::Loading;

fn fitted() -> AnyModel {
    model("brinell", "brinell")
}

/// Loading force in units of the yield point.
fn force(model: &AnyModel, x: f64) -> f64 {
    let unit = unit(&model.pair);
    model.loading.segment(&model.pair, x * unit.indentation).force(x * unit.indentation) / unit.force
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
    let written: serde_json::Value = serde_json::from_str(&read("data/fit/brinell_law.json")).unwrap();
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
