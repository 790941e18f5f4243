//! The ends of laws: a fit must reject what is beyond its range, not return numbers that are not finite.

use crate::physics::{AnyModel, MASS, Random, mild, model, pair_of, some_models};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::impact::{Impact, predict, restitution};
use brinell_contact::numerics::quadrature::logarithmic_integral;
use brinell_contact::{History, Pair, losses};

/// Log-uniform numbers from `10^low` to `10^high`.
fn decades(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(low + (high - low) * random.next())
}

/// A sphere of any radius [m] on a target of any modulus [Pa] and strength [Pa].
fn bodies(random: &mut Random) -> (f64, Pair) {
    let modulus = decades(random, 3.0, 15.0);
    let strength = modulus * decades(random, -9.0, 0.0);
    let radius = decades(random, -9.0, 3.0);
    (radius, pair_of(radius, modulus, strength))
}

/// Force, stiffness, dent, contact radius and energies of the contact must be finite.
fn check(what: &str, history: &History, model: &AnyModel) {
    let shown = [
        ("force", history.force()),
        ("stiffness", history.stiffness()),
        ("dent", history.residual_indentation(model)),
        ("contact radius", history.contact_radius(model)),
        ("elastic energy", history.elastic_energy(model)),
        ("dissipated energy", history.dissipated_energy(model)),
    ];
    for (quantity, value) in shown {
        assert!(value.is_finite(), "{what}: {quantity} = {value}");
    }
}

#[test]
fn a_contact_has_finite_outputs_or_is_refused_for_any_bodies_and_depth() {
    let mut random = Random(2015);
    let (mut shown, mut refused) = (0, 0);
    for _ in 0..400 {
        let (radius, pair) = bodies(&mut random);
        for (name, model) in some_models(pair) {
            let depth = radius * decades(&mut random, -12.0, 6.0);
            let mut history = History::start(&model, 0.0).unwrap();
            let before = history;
            let what = format!("{name}, {pair:?}, d = {depth:e}");
            if history.advance(&model, depth).is_err() {
                assert_eq!(history, before, "{what}: a refused step moves nothing");
                refused += 1;
                continue;
            }
            check(&what, &history, &model);
            history.advance(&model, -0.3 * depth).unwrap();
            check(&format!("{what}, on the way back"), &history, &model);
            shown += 1;
        }
    }
    assert!(shown > 100 * refused && refused > 0, "{shown} contacts and {refused} refused");
}

#[test]
fn a_prediction_is_of_numbers_or_there_is_none() {
    let mut random = Random(1985);
    let (mut found, mut none) = (0, 0);
    for _ in 0..40 {
        let (radius, pair) = bodies(&mut random);
        let impact = Impact { mass: 1e4 * radius.powi(3), speed: decades(&mut random, -9.0, 4.0) };
        for (name, model) in some_models(pair) {
            let Some(prediction) = predict(&model, &impact) else {
                none += 1;
                continue;
            };
            let numbers = [
                prediction.max_indentation,
                prediction.max_force,
                prediction.max_contact_radius,
                prediction.residual_indentation,
                prediction.rebound_energy,
                prediction.restitution,
                prediction.contact_time(),
            ];
            let what = format!("{name}, {pair:?}, {impact:?}");
            assert!(numbers.iter().all(|number| number.is_finite()), "{what}: {prediction:?}");
            assert!(prediction.loading_time > 0.0 && prediction.unloading_time > 0.0, "{what}: {prediction:?}");
            found += 1;
        }
    }
    assert!(found > 10 * none, "{found} predictions and {none} refused");
}

/// Of every kind of law: a negative speed has a positive energy, too.
#[test]
fn only_impacts_of_a_positive_finite_mass_and_speed_are_predicted() {
    let plastic = model("big-alabo", "contact-radius");
    let lossy = losses::Model { plastic, loss: losses::RestitutionFitted { restitution: 0.9 } };
    let good = Impact { mass: MASS, speed: 1.0 };
    let bad = [0.0, -0.0, -1e-3, -1.0, -1e3, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, -f64::NAN];
    let none = bad.into_iter().flat_map(|number| [Impact { mass: number, ..good }, Impact { speed: number, ..good }]);
    // their energies are positive, but overflow or have lost digits
    let extreme = [Impact { mass: 1e300, speed: 1e100 }, Impact { mass: 1e-300, speed: 1e-100 }];
    let both = [Impact { mass: -MASS, speed: -1.0 }];
    let damped = AnyDamped::ALL.map(|(name, law)| (name, law.model(mild(), 0.6, MASS)));
    let check = |impact: Impact, some: bool| {
        assert_eq!(predict(&plastic, &impact).is_some(), some, "{impact:?}");
        assert_eq!(restitution(&plastic, &impact).is_some(), some, "{impact:?}");
        assert_eq!(losses::impact::predict(&lossy, &impact).is_some(), some, "with losses, {impact:?}");
        for (name, damped) in &damped {
            assert_eq!(losses::impact::predict(damped, &impact).is_some(), some, "{name}, {impact:?}");
        }
    };
    check(good, true);
    none.chain(extreme).chain(both).for_each(|impact| check(impact, false));
}

#[test]
fn jackson_and_green_end_where_their_fit_overflows() {
    // B = 0.14 e^(23 S/E') is an exponent of 1e9 for a target as strong as it is stiff
    let model = model("jackson-green", "jackson");
    let strong = AnyModel { pair: pair_of(5e-3, 1e11, 1e11), ..model };
    let mut history = History::start(&strong, 0.0).unwrap();
    let refused = history.advance(&strong, 1.0).unwrap_err();
    assert_eq!(refused.indentation, 1.0);
    assert_eq!(history.force(), 0.0);
    history.advance(&strong, 1e-4).unwrap();
    assert!(history.force() > 0.0);
}

/// A fit with a zero unit of length would have an infinite range.
#[test]
fn an_integral_up_to_infinity_ends_and_is_no_number() {
    for (low, high) in [(1.0, f64::INFINITY), (0.0, 1.0), (f64::NAN, 1.0), (1.0, f64::NAN)] {
        let integral = logarithmic_integral(low, high, &|y| y.sqrt());
        assert!(!integral.is_finite(), "{integral} from {low} to {high}");
    }
    let integral = logarithmic_integral(1e-300, 1e100, &|y| 1.0 / y);
    assert!((integral / (400.0 * 10f64.ln()) - 1.0).abs() < 1e-14, "{integral}");
}
