//! Predictions: the root of the energy balance.

use crate::physics::{AnyModel, MASS, advance, logarithmic, mild, model, pressed, some_models, unit};
use brinell_contact::Loading;
use brinell_contact::impact::{Impact, predict};
use brinell_contact::loading::AnyLoading;

#[test]
fn the_largest_indentation_is_the_first_whose_work_exceeds_the_energy() {
    for (name, loading) in AnyLoading::ALL {
        let model = AnyModel { loading, ..model("hertz", "contact-radius") };
        for speed in logarithmic(1e-30, 1e12, 211) {
            let Some(prediction) = predict(&model, &Impact { mass: MASS, speed }) else {
                panic!("{name} at {speed:e} m/s: no prediction")
            };
            let deepest = prediction.max_indentation;
            let work = |d: f64| loading.work(&model.pair, d);
            assert!(work(deepest) > prediction.energy, "{name} at {speed:e} m/s: {deepest:e} m is not deep enough");
            assert!(
                work(deepest.next_down()) <= prediction.energy,
                "{name} at {speed:e} m/s: {deepest:e} m is too deep"
            );
        }
    }
}

#[test]
fn the_work_between_two_indentations_is_the_difference_of_their_works() {
    let mut compared = 0;
    for (name, law) in AnyLoading::ALL {
        let pair = mild();
        for x in logarithmic(3.0, 1e5, 40) {
            for part in [1e-3, 0.1, 0.9] {
                let high = x * unit(&pair).indentation;
                let low = high * (1.0 - part);
                // never called across a corner
                let corner = law.next_corner(&pair, low);
                let Some(between) = law.work_between(&pair, low, high).filter(|_| corner >= high) else { continue };
                let difference = law.work(&pair, high) - law.work(&pair, low);
                let rounding = 1e-13 * law.work(&pair, high);
                assert!((between - difference).abs() <= rounding, "{name} at {x}: {between:e}, not {difference:e}");
                compared += 1;
            }
        }
    }
    assert!(compared >= 200, "{compared}: two laws have integrals");
}

#[test]
fn times_are_right_to_rounding_though_the_kinetic_energy_vanishes_at_the_turning_point() {
    // Hertz's impact lasts (4/5) sqrt(pi) Gamma(2/5)/Gamma(9/10) d_m/v; the loading is half of it (mpmath, 30 digits)
    let hertz = model("hertz", "contact-radius");
    for speed in logarithmic(1e-6, 1e2, 9) {
        let prediction = predict(&hertz, &Impact { mass: MASS, speed }).unwrap();
        let half = 0.5 * 2.943_275_184_324_704_7 * prediction.max_indentation / speed;
        for (name, time) in [("loading", prediction.loading_time), ("unloading", prediction.unloading_time)] {
            let error = time / half - 1.0;
            assert!(error.abs() < 1e-14, "{name} at {speed} m/s is off by {error:e}");
        }
    }
}

/// Largest indentation [m], restitution and duration [s] of an impact, by leapfrog steps of `1/steps` of `duration`.
fn leapfrog(model: &AnyModel, impact: &Impact, duration: f64, steps: u32) -> (f64, f64, f64) {
    let step = duration / f64::from(steps);
    let mut history = pressed(model, 0.0);
    let (mut speed, mut largest, mut time) = (impact.speed, 0.0_f64, 0.0);
    loop {
        speed -= 0.5 * step * history.force() / impact.mass;
        advance(&mut history, model, step * speed);
        speed -= 0.5 * step * history.force() / impact.mass;
        largest = largest.max(history.indentation());
        time += step;
        if speed < 0.0 && history.force() == 0.0 {
            // the bodies separated within the last step: go back to the residual indentation at the speed of separation
            let passed = (history.residual_indentation(model) - history.indentation()) / -speed;
            return (largest, -speed / impact.speed, time - passed);
        }
    }
}

#[test]
fn predictions_agree_with_a_fine_simulation() {
    for (name, model) in some_models(mild()) {
        for speed in [1e-3, 4e-3, 0.03, 0.2, 2.0] {
            let impact = Impact { mass: MASS, speed };
            let prediction = predict(&model, &impact).expect("an ordinary impact");
            let duration = prediction.contact_time();
            let (largest, restitution, time) = leapfrog(&model, &impact, duration, 20_000);
            // second order: (1/20000)^2 times some tens, and ten times that for the corners of the curves
            let errors = [
                largest / prediction.max_indentation - 1.0,
                restitution - prediction.restitution,
                time / duration - 1.0,
            ];
            for error in errors {
                assert!(error.abs() <= 1e-6, "{name} at {speed} m/s: {errors:?}, {prediction:?}");
            }
        }
    }
}
