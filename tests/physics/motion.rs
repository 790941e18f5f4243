//! A contact that knows the mass: its motion within one step.

use crate::physics::{AnyModel, MASS, all_models, mild, model};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::motion::{ExternalLoad, NoMotion, Outcome, follow};
use brinell_contact::{History, Loading, Surface};

fn go(history: &mut History, model: &AnyModel, acceleration: f64, speed: f64, step: f64) -> Outcome {
    follow(history, model, &ExternalLoad { mass: MASS, acceleration }, speed, step).expect("within range")
}

fn assert_close(what: &str, value: f64, expected: f64, tolerance: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error <= tolerance, "{what}: {value:e} instead of {expected:e}, off by {error:e}");
}

#[test]
fn one_step_over_a_whole_impact_gives_the_predicted_rebound() {
    for (name, model) in all_models(mild()) {
        for speed in [1e-3, 0.03, 1.0, 20.0] {
            let prediction = predict(&model, &Impact { mass: MASS, speed }).expect("within range");
            let mut history = History::start(&model, 0.0).unwrap();
            let outcome = go(&mut history, &model, 0.0, speed, 2.0 * prediction.contact_time());
            let name = format!("{name} at {speed} m/s ({} evaluations)", outcome.evaluations);
            assert_close(&format!("{name}: restitution"), -outcome.speed / speed, prediction.restitution, 1e-11);
            assert_close(&format!("{name}: depth"), history.max_indentation(), prediction.max_indentation, 1e-11);
            assert_eq!(history.force(), 0.0, "{name}");
            // apart since the end of the contact; without segments, the energies of the prediction are differences
            let tolerance = if model.loading.is_segmented() { 1e-12 } else { 1e-10 };
            let flown = prediction.residual_indentation - history.indentation();
            let time = 2.0 * prediction.contact_time() + flown / outcome.speed;
            assert_close(&format!("{name}: contact time"), time, prediction.contact_time(), tolerance);
        }
    }
}

/// Kinetic energy, potential energy of the acceleration, and energy of the contact [J].
fn energy(history: &History, model: &AnyModel, acceleration: f64, speed: f64) -> f64 {
    0.5 * MASS * speed * speed - MASS * acceleration * history.indentation() + history.work(model)
}

#[test]
fn a_small_motion_in_the_dent_of_any_impact_stays_small_and_cheap() {
    for (name, model) in all_models(mild()) {
        for speed in [1e-3, 0.03, 1.0, 60.0] {
            let prediction = predict(&model, &Impact { mass: MASS, speed }).expect("within range");
            let (depth, elastic) =
                (prediction.max_indentation, prediction.max_indentation - prediction.residual_indentation);
            let frequency = (model.unloading_segment(depth, depth).stiffness(depth) / MASS).sqrt();
            let mut history = History::start(&model, -depth).unwrap();
            history.advance(&model, -0.01 * elastic).unwrap();
            let acceleration = history.force() / MASS;
            let first = 1e-6 * elastic * frequency;
            let (mut rate, mut most) = (first, 0);
            for _ in 0..20 {
                let outcome = go(&mut history, &model, acceleration, rate, 8.0 / frequency);
                (rate, most) = (outcome.speed, most.max(outcome.evaluations));
            }
            assert!(most < 20_000, "{name} after {speed} m/s: {most} evaluations");
            assert!(rate.abs() < 1.01 * first, "{name} after {speed} m/s: it grows to {rate:e} from {first:e} m/s");
        }
    }
}

#[test]
fn bodies_that_part_fly_on() {
    let model = model("big-alabo", "contact-radius");
    let mut history = History::start(&model, 1e-3).unwrap();
    let outcome = go(&mut history, &model, -5.0, -0.5, 0.1);
    assert_eq!((outcome.evaluations, history.force()), (0, 0.0));
    assert_close("gap", -history.indentation(), 1e-3 + 0.05 + 0.5 * 5.0 * 0.01, 1e-14);
    assert_close("speed", outcome.speed, -1.0, 1e-15);
}

#[test]
fn bounces_that_lose_nothing_are_followed_for_as_long_as_their_phase_is_known() {
    let model = model("hertz", "contact-radius");
    let acceleration = 1e5;
    let fall = |step: f64| {
        let mut history = History::start(&model, 1e-9).unwrap();
        let load = ExternalLoad { mass: MASS, acceleration };
        (follow(&mut history, &model, &load, 0.0, step), history)
    };
    // about 1e9 bounces
    let (followed, history) = fall(1e4);
    let outcome = followed.expect("nothing is lost");
    assert!(outcome.evaluations < 2000, "{outcome:?}");
    let off = energy(&history, &model, acceleration, outcome.speed) - MASS * acceleration * 1e-9;
    assert!(off.abs() < 1e-12 * MASS * acceleration * outcome.deepest, "off by {off:e} J");
    assert_close("speed taken", outcome.speed_removed, acceleration * 1e4 - outcome.speed, 1e-9);
    // about 1e13
    assert_eq!(fall(1e8).0, Err(NoMotion::TooLong));
}

#[test]
fn a_step_with_too_many_bounces_is_refused() {
    // the motion of bodies that yield less and less approaches a lossless one
    for (loading, unloading) in [("brinell", "brinell"), ("thornton", "thornton"), ("vu-quoc-zhang", "vu-quoc-zhang")] {
        let model = AnyModel { surface: Surface::Fresh, ..model(loading, unloading) };
        let mut history = History::start(&model, 1e-3).unwrap();
        let refused = follow(&mut history, &model, &ExternalLoad { mass: MASS, acceleration: 9.81 }, 0.0, 1e5);
        assert_eq!(refused, Err(NoMotion::TooLong), "{loading}");
    }
}

#[test]
fn a_body_that_leaves_the_range_of_the_laws_is_refused() {
    let model = model("hertz", "contact-radius");
    for (speed, step) in [(1e10, 1e200), (-1e10, 1e200), (f64::NAN, 1.0), (1.0, f64::INFINITY), (f64::INFINITY, 1.0)] {
        let mut history = History::start(&model, 0.0).unwrap();
        let refused = follow(&mut history, &model, &ExternalLoad { mass: 1e300, acceleration: 0.0 }, speed, step);
        assert!(matches!(refused, Err(NoMotion::TooDeep(_))), "{speed} m/s for {step} s: {refused:?}");
    }
}

#[test]
fn an_impact_takes_a_bounded_number_of_evaluations() {
    let mut most = 0;
    for (name, model) in all_models(mild()) {
        for speed in [1e-4, 1e-2, 1.0, 50.0] {
            let time = 2.0 * predict(&model, &Impact { mass: MASS, speed }).unwrap().contact_time();
            let outcome = go(&mut History::start(&model, 0.0).unwrap(), &model, 0.0, speed, time);
            assert!(outcome.evaluations < 15_000, "{name} at {speed} m/s: {} evaluations", outcome.evaluations);
            most = most.max(outcome.evaluations);
        }
    }
    println!("at most {most} evaluations");
}
