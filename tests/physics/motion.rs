//! A contact that knows the mass: its motion within one step.

use crate::physics::{self, AnyModel, MASS, all_models, mild, model, unit};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::motion::{Drive, NoMotion, Outcome, follow};
use brinell_contact::{History, Loading, Surface};

fn go(history: &mut History, model: &AnyModel, acceleration: f64, speed: f64, step: f64) -> Outcome {
    follow(history, model, &Drive { mass: MASS, acceleration }, speed, step).expect("within range")
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

#[test]
fn it_does_not_matter_how_time_is_cut() {
    for (name, model) in all_models(mild()) {
        let steps = |count: u32| {
            let mut history = History::start(&model, 1e-6).unwrap();
            let mut speed = 0.7;
            for _ in 0..count {
                speed = go(&mut history, &model, 9.81, speed, 60e-6 / f64::from(count)).speed;
            }
            (history.indentation(), speed)
        };
        let (indentation, speed) = steps(1);
        for count in [2, 7, 100] {
            let (other, other_speed) = steps(count);
            assert!((other - indentation).abs() < 1e-11 * 1e-5, "{name}: {other:e}, {indentation:e} in one step");
            assert_close(&name, other_speed, speed, 1e-10);
        }
    }
}

/// Kinetic energy, potential energy of the acceleration, and energy of the contact [J].
fn energy(history: &History, model: &AnyModel, acceleration: f64, speed: f64) -> f64 {
    0.5 * MASS * speed * speed - MASS * acceleration * history.indentation() + history.work(model)
}

#[test]
fn a_ball_that_is_pressed_bounces_and_keeps_its_energy() {
    for surface in [Surface::Dented, Surface::Fresh] {
        for (name, model) in all_models(mild()) {
            // a law that is not passive conserves no energy
            if !physics::is_passive(&model) {
                continue;
            }
            let model = AnyModel { surface, ..model };
            let (acceleration, mut speed) = (2000.0, 0.0);
            let mut history = History::start(&model, 20e-6).unwrap();
            let before = energy(&history, &model, acceleration, speed);
            let mut bounces = 0;
            for _ in 0..40 {
                let outcome = go(&mut history, &model, acceleration, speed, 50e-6);
                bounces += u32::from(outcome.speed < 0.0 && speed >= 0.0);
                speed = outcome.speed;
                let now = energy(&history, &model, acceleration, speed);
                let scale = 0.5 * MASS * 0.3 * 0.3;
                assert!((now - before).abs() < 1e-10 * scale, "{name}: {now:e} J instead of {before:e} J");
            }
            assert!(bounces >= 2, "{name}: {bounces} bounces were seen");
        }
    }
}

#[test]
fn a_second_with_many_bounces_is_one_step() {
    let model = model("big-alabo", "contact-radius");
    let mut history = History::start(&model, 1e-3).unwrap();
    let outcome = go(&mut history, &model, 9.81, 0.1, 1.0);
    let scale = 0.5 * MASS * 0.2 * 0.2;
    let now = energy(&history, &model, 9.81, outcome.speed) - 0.5 * MASS * 0.01 - MASS * 9.81 * 1e-3;
    assert!(now.abs() < 1e-9 * scale, "off by {now:e} J of {scale:e} J");
    assert!(outcome.taken > 0.9 * 9.81, "it hangs on the contact all the time: {outcome:?}");
}

#[test]
fn a_body_at_rest_on_the_surface_is_carried() {
    // the force of a contact in equilibrium with the acceleration
    let model = model("hertz", "contact-radius");
    let depth = unit(&mild()).indentation;
    let mut history = History::start(&model, -depth).unwrap();
    let acceleration = history.force() / MASS;
    let outcome = go(&mut history, &model, acceleration, 0.0, 1e-3);
    assert!(outcome.speed.abs() < 1e-12, "{outcome:?}");
    assert!((history.indentation() / depth - 1.0).abs() < 1e-10);
}

#[test]
fn a_small_motion_under_a_large_load_takes_no_more_evaluations_than_a_large_one() {
    let model = model("hertz", "contact-radius");
    let depth = unit(&mild()).indentation;
    let frequency = (model.unloading_segment(depth, depth).stiffness(depth) / MASS).sqrt();
    for amplitude in [1e-3, 1e-6, 1e-9] {
        let mut history = History::start(&model, -depth).unwrap();
        let acceleration = history.force() / MASS;
        let first = amplitude * depth * frequency;
        let mut speed = first;
        for _ in 0..100 {
            let outcome = go(&mut history, &model, acceleration, speed, 8.0 / frequency);
            assert!(outcome.evaluations < 8000, "amplitude {amplitude:e}: {} evaluations", outcome.evaluations);
            speed = outcome.speed;
            assert!(speed.abs() < 1.01 * first, "amplitude {amplitude:e}: it grows to {speed:e} from {first:e} m/s");
        }
    }
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
        let drive = Drive { mass: MASS, acceleration };
        (follow(&mut history, &model, &drive, 0.0, step), history)
    };
    // about 1e9 bounces
    let (followed, history) = fall(1e4);
    let outcome = followed.expect("nothing is lost");
    assert!(outcome.evaluations < 2000, "{outcome:?}");
    let off = energy(&history, &model, acceleration, outcome.speed) - MASS * acceleration * 1e-9;
    assert!(off.abs() < 1e-12 * MASS * acceleration * outcome.deepest, "off by {off:e} J");
    assert_close("speed taken", outcome.taken, acceleration * 1e4 - outcome.speed, 1e-9);
    // about 1e13
    assert_eq!(fall(1e8).0, Err(NoMotion::TooLong));
}

#[test]
fn a_step_with_too_many_bounces_is_refused() {
    // the motion of bodies that yield less and less approaches a lossless one
    for (loading, unloading) in [("brinell", "brinell"), ("thornton", "thornton"), ("vu-quoc-zhang", "vu-quoc-zhang")] {
        let model = AnyModel { surface: Surface::Fresh, ..model(loading, unloading) };
        let mut history = History::start(&model, 1e-3).unwrap();
        let refused = follow(&mut history, &model, &Drive { mass: MASS, acceleration: 9.81 }, 0.0, 1e5);
        assert_eq!(refused, Err(NoMotion::TooLong), "{loading}");
    }
}

#[test]
fn a_body_that_leaves_the_range_of_the_laws_is_refused() {
    let model = model("hertz", "contact-radius");
    for (speed, step) in [(1e10, 1e200), (-1e10, 1e200), (f64::NAN, 1.0), (1.0, f64::INFINITY), (f64::INFINITY, 1.0)] {
        let mut history = History::start(&model, 0.0).unwrap();
        let refused = follow(&mut history, &model, &Drive { mass: 1e300, acceleration: 0.0 }, speed, step);
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

/// Evaluations of an impact at 1 m/s over 1.25 contact times in this number of steps, starting a tenth of one before the touch.
fn evaluations_of_an_impact(model: &AnyModel, steps: u32) -> u32 {
    let time = predict(model, &Impact { mass: MASS, speed: 1.0 }).expect("within range").contact_time();
    let mut history = History::start(model, 0.1 * time).unwrap();
    let (mut speed, mut sum) = (1.0, 0);
    for _ in 0..steps {
        let outcome = go(&mut history, model, 0.0, speed, 1.25 * time / f64::from(steps));
        (speed, sum) = (outcome.speed, sum + outcome.evaluations);
    }
    sum
}

#[test]
fn cutting_an_impact_into_steps_costs_little_for_each() {
    // the number when this was written, plus a few hundredths for other roundings
    for (loading, unloading, most) in [
        ("big-alabo", "contact-radius", [(1, 135), (2, 158), (32, 595), (1000, 9200)]),
        ("hertz", "contact-radius", [(1, 63), (2, 91), (32, 595), (1000, 6300)]),
        ("brinell", "brinell", [(1, 236), (2, 305), (32, 750), (1000, 6050)]),
    ] {
        let model = model(loading, unloading);
        for (steps, most) in most {
            let evaluations = evaluations_of_an_impact(&model, steps);
            assert!(evaluations <= most, "{loading}: {evaluations} evaluations in {steps} steps");
        }
    }
}
