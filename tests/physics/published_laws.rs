//! The published laws compared with tables of independently computed numbers. The numbers are as printed, unless a comment
//! names another source.

use crate::physics::{self, AnyModel, MASS, loading_force, mild, model, pair_of, unit};
use crate::printed::{agrees, agrees_in_digits, closure};
use brinell_contact::Loading;
use brinell_contact::impact::{Impact, Prediction, predict};

/// Numbers of the published laws by quantity and law, with their places.
const TABLE: &str = include_str!("published.csv");

const SPEEDS: [f64; 7] = [0.05, 0.1, 0.5, 1.0, 5.0, 20.0, 100.0];

fn impact(model: &AnyModel, speed: f64) -> Prediction {
    predict(model, &Impact { mass: MASS, speed }).expect("an ordinary impact")
}

/// Compares a quantity of an impact with the number that is printed with so many digits or decimals.
fn of_impact(quantity: &str, found: &Prediction, printed: f64, what: &str) {
    match quantity {
        "restitution" => agrees(what, found.restitution, printed, 8),
        "restitution over yield" => agrees(what, found.restitution, printed, 7),
        "largest indentation" => agrees_in_digits(what, found.max_indentation, printed, 8),
        "largest force" => agrees_in_digits(what, found.max_force, printed, 7),
        "dent" => agrees_in_digits(what, found.residual_indentation, printed, 8),
        "loading time" => agrees_in_digits(what, found.loading_time, printed, 9),
        "unloading time" => agrees_in_digits(what, found.unloading_time, printed, 9),
        other => panic!("{other}"),
    }
}

/// Restitution depends on the speed over that of yield alone: it is compared for another pair and mass, too.
#[test]
fn the_laws_have_the_forces_dents_impacts_and_times_of_the_table() {
    let (mut places, mut compared, lead) = (Vec::new(), 0, pair_of(0.03, 16e9, 8e6));
    for line in TABLE.lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split(',').collect();
        let (head, numbers) = fields.split_at(3);
        if head[0] == "at" {
            places = numbers.iter().map(|place| place.parse::<f64>().expect("a number")).collect();
            continue;
        }
        let (quantity, loading, unloading) = (head[0], head[1], head[2]);
        let model = if unloading == "rd165" { closure(unloading) } else { model(loading, unloading) };
        let unit = unit(&model.pair);
        for (place, printed) in places.iter().zip(numbers).filter(|(_, printed)| !printed.is_empty()) {
            let (what, printed) =
                (format!("{quantity} of {line} at {place}"), printed.parse::<f64>().expect("a number"));
            compared += 1;
            match quantity {
                "force" => {
                    let force = loading_force(&model, place * unit.indentation) / unit.force;
                    agrees_in_digits(&what, force, printed, 8);
                }
                "dent over indentation" => {
                    let largest = place * unit.indentation;
                    agrees(&what, model.unloading_path(largest).lower / largest, printed, 8);
                }
                "restitution over yield" => {
                    for (pair, mass) in [(mild(), MASS), (lead, 1.3)] {
                        let model = AnyModel { pair, ..model };
                        let point = model.loading.yield_point(&pair);
                        // rounding does not decide whether the first case yields: some laws jump there
                        let beside = if printed == 1.0 { 1.0 - 1e-12 } else { 1.0 + 1e-12 };
                        let beside = if *place == 1.0 { beside } else { 1.0 };
                        let speed = beside * place * (0.8 * point.force * point.indentation / mass).sqrt();
                        let found = predict(&model, &Impact { mass, speed }).expect("an ordinary impact");
                        of_impact(quantity, &found, printed, &what);
                    }
                }
                _ => of_impact(quantity, &impact(&model, *place), printed, &what),
            }
        }
    }
    assert!(compared > 938, "{compared} numbers");
}

/// The dent is the whole indentation except for its last digit, and no energy is returned.
#[test]
fn beyond_the_fit_of_jackson_nothing_comes_back() {
    let found = impact(&model("jackson-green", "jackson"), 100.0);
    let (dent, largest) = (found.residual_indentation, found.max_indentation);
    assert!(found.restitution < 1e-7 && dent < largest && dent > largest * (1.0 - 2.0 * f64::EPSILON), "{found:?}");
}

#[test]
fn thorntons_restitution_is_the_one_he_gives_in_closed_form() {
    let model = model("thornton", "thornton");
    let point = model.loading.yield_point(&model.pair);
    let yield_speed = (0.8 * point.force * point.indentation / MASS).sqrt();
    for ratio in [1.0, 1.001, 1.5, 2.0, 5.0, 10.0, 100.0, 1e4, 1e6] {
        let r: f64 = 1.0 / ratio;
        let root = (r / (r + 2.0 * (6.0 / 5.0 - r * r / 5.0).sqrt())).powf(0.25);
        let expected = (6.0 * 3f64.sqrt() / 5.0).sqrt() * (1.0 - r * r / 6.0).sqrt() * root;
        let prediction = impact(&model, ratio * yield_speed);
        // a few rounding errors, and that of the dent, which determines the recovery
        let recovery = prediction.max_indentation - prediction.residual_indentation;
        let allowed = (32.0 + prediction.max_indentation / recovery) * f64::EPSILON;
        let restitution = prediction.restitution;
        assert!((restitution / expected - 1.0).abs() <= allowed, "{restitution} at {ratio}, not {expected}");
    }
}

#[test]
fn walton_and_brauns_restitution_is_the_root_of_the_stiffness_ratio_at_any_speed() {
    let model = model("walton-braun", "walton-braun");
    for speed in SPEEDS {
        let restitution = impact(&model, speed).restitution;
        // k_1/k_2 = 1/4; a few rounding errors
        assert!((restitution / 0.5 - 1.0).abs() <= 8.0 * f64::EPSILON, "{restitution} at {speed} m/s");
    }
}

#[test]
fn the_walton_braun_line_meets_hertz_where_the_mean_pressure_is_1_1_times_the_yield_strength() {
    let model = model("walton-braun", "walton-braun");
    let unit = unit(&model.pair);
    for x in [0.5, 1.0, 2.0, 200.0] {
        let force = loading_force(&model, x * unit.indentation) / unit.force;
        // a few rounding errors
        assert!((force / x - 1.0).abs() <= 8.0 * f64::EPSILON, "{force} at {x}");
    }
}

#[test]
fn the_power_law_follows_its_constants() {
    use brinell_contact::loading::Power;
    let law = Power { yield_pressure_factor: 1.0, coefficient: 2.0, exponent: 1.5 };
    let pair = mild();
    let point = law.yield_point(&pair);
    // computed by hand: 1 + 2 (x - 1)^1.5, with the slope 3 sqrt(x - 1) and the work 0.4 + (x - 1) + 0.8 (x - 1)^2.5
    for (x, force, slope, work) in
        [(1.0, 1.0, 0.0, 0.4), (2.0, 3.0, 3.0, 2.2), (5.0, 17.0, 6.0, 30.0), (10.0, 55.0, 9.0, 203.8)]
    {
        let at = x * point.indentation;
        let segment = law.segment(&pair, at);
        let found = [
            (segment.force(at) / point.force, force),
            (segment.stiffness(at) * point.indentation / point.force, slope),
            (law.work(&pair, at) / (point.force * point.indentation), work),
        ];
        for (got, expected) in found {
            // a few rounding errors
            assert!((got - expected).abs() <= 16.0 * f64::EPSILON * expected, "{got} at {x}, not {expected}");
        }
    }
}

#[test]
fn the_slopes_at_the_borders_are_the_printed_ones() {
    // law, boundary in yield indentations, slope below and above [F_y/d_y]
    #[rustfmt::skip]
    const SLOPES: [(&str, f64, f64, f64); 8] = [
        ("stronge", 1.0, 1.5, 2.606),
        ("stronge", 82.510_953_649_950_87, 5.697, 5.091),
        ("thornton", 1.0, 1.5, 1.5),
        ("yigit-christoforou", 1.0, 1.5, 1.5),
        ("zhao-maietta-chang", 1.0, 1.5, 1.387),
        ("zhao-maietta-chang", 54.0, 5.866, 5.091),
        ("ma-liu", 1.0, 1.5, 1.5),
        // 1.5 * 2 * 2.85/1.61
        ("ma-liu", 160.893_932_191_922_47, 5.311, 5.311),
    ];
    for (name, border, below, above) in SLOPES {
        let law = physics::loading(name);
        let (pair, point) = (mild(), law.yield_point(&mild()));
        for (x, printed) in [(border * (1.0 - 1e-9), below), (border * (1.0 + 1e-9), above)] {
            let at = x * point.indentation;
            let slope = law.segment(&pair, at).stiffness(at) * point.indentation / point.force;
            agrees(&format!("{name} at {x}"), slope, printed, 3);
        }
    }
}

#[test]
fn jackson_and_green_with_the_fitted_dent_have_the_restitution_of_the_printed_check() {
    // speed [m/s], with the law, and with the authors' own fit of the restitution (which is close, but not equal)
    const MILD: [(f64, f64, Option<f64>); 6] = [
        (0.05, 0.703241, Some(0.704274)),
        (0.1, 0.611207, Some(0.600945)),
        (0.5, 0.410764, Some(0.417607)),
        (1.0, 0.337604, Some(0.339418)),
        (5.0, 0.198096, None),
        (20.0, 0.096168, None),
    ];
    let law = model("jackson-green", "jackson");
    let unit = brinell_contact::loading::JacksonGreen::REFERENCE.unit(&law.pair);
    let yield_speed = (0.8 * unit.force * unit.indentation / MASS).sqrt();
    agrees_in_digits("V_c", yield_speed, 0.0017757891, 8);
    for (speed, printed, fit) in MILD {
        let restitution = impact(&law, speed).restitution;
        agrees(&format!("at {speed} m/s"), restitution, printed, 6);
        // the largest difference of the printed table itself is 0.0103
        assert!(fit.is_none_or(|fit| (restitution - fit).abs() < 0.0104), "at {speed} m/s: {restitution}, fit {fit:?}");
    }
}
