//! A contact that knows the mass in delicate cases: at the surface, at rest, in equilibrium, and pulled away.

use crate::physics::{self, AnyModel, MASS, all_models, mild, model, pair_of, unit};
use brinell_contact::motion::{ExternalLoad, NoMotion, Outcome, follow};
use brinell_contact::{History, Surface};

fn go(history: &mut History, model: &AnyModel, acceleration: f64, speed: f64, step: f64) -> Outcome {
    follow(history, model, &ExternalLoad { mass: MASS, acceleration }, speed, step).expect("within range")
}

#[test]
fn a_body_at_rest_on_the_surface_that_is_pulled_away_leaves_it() {
    for (name, model) in all_models(mild()) {
        for acceleration in [-1e-300, -1e-30, -1e-3, -9.81, -1e30] {
            let mut history = History::start(&model, 0.0).unwrap();
            let outcome = go(&mut history, &model, acceleration, 0.0, 1e-3);
            assert_eq!(outcome.speed, acceleration * 1e-3, "{name}");
            let way = 0.5e-6 * acceleration;
            assert!((history.indentation() - way).abs() <= 1e-15 * way.abs(), "{name}");
            assert_eq!((outcome.speed_removed, outcome.evaluations), (0.0, 0), "{name}");
        }
    }
}

#[test]
fn a_body_at_rest_on_the_surface_that_nothing_pulls_stays() {
    for (name, model) in all_models(mild()) {
        let mut history = History::start(&model, 0.0).unwrap();
        let outcome = go(&mut history, &model, 0.0, 0.0, 1e3);
        assert_eq!((outcome.speed, outcome.speed_removed, history.indentation()), (0.0, 0.0, 0.0), "{name}");
    }
}

#[test]
fn a_body_that_arrives_without_speed_leaves_again() {
    let model = model("big-alabo", "contact-radius");
    // up to the surface, where it turns: 1/8 m at 1/2 m/s with 1 m/s^2 against it, without rounding
    let mut history = History::start(&model, 0.125).unwrap();
    let outcome = go(&mut history, &model, -1.0, 0.5, 2.0);
    assert_eq!((outcome.speed, history.indentation(), outcome.speed_removed), (-1.5, -1.125, 0.0));
    // and the step that ends there
    let mut history = History::start(&model, 0.125).unwrap();
    let outcome = go(&mut history, &model, -1.0, 0.5, 0.5);
    assert_eq!((outcome.speed, history.indentation(), history.force()), (0.0, 0.0, 0.0));
    assert_eq!(go(&mut history, &model, -1.0, 0.0, 1.0).speed, -1.0);
}

/// Largest indentation and dissipated energy after `time` [s] from the surface, in this number of steps.
fn pulled_away(acceleration: f64, speed: f64, time: f64, steps: u32) -> (f64, f64) {
    let model = model("big-alabo", "contact-radius");
    let mut history = History::start(&model, 0.0).unwrap();
    let mut speed = speed;
    for _ in 0..steps {
        let load = ExternalLoad { mass: 4e-3, acceleration };
        speed = follow(&mut history, &model, &load, speed, time / f64::from(steps)).expect("within range").speed;
    }
    (history.max_indentation(), history.dissipated_energy(&model))
}

#[test]
fn an_impact_is_not_missed_where_the_bodies_would_part_within_the_step_without_it() {
    for (acceleration, speed, time, depth) in
        [(-100.0, 0.1, 5e-3, 1.456e-6), (-9.81, 0.01, 5e-3, 2.44e-7), (-1000.0, 0.01, 1e-4, 4.887e-8)]
    {
        let (deepest, lost) = pulled_away(acceleration, speed, time, 1);
        assert!((deepest / depth - 1.0).abs() < 5e-3, "{deepest:e} m at {acceleration} m/s^2");
        for steps in [2, 5, 10, 100, 1000] {
            let (other, other_lost) = pulled_away(acceleration, speed, time, steps);
            let energy = 0.5 * 4e-3 * speed * speed;
            assert!((other / deepest - 1.0).abs() < 1e-12, "{other:e} m in {steps} steps, {deepest:e} m in one");
            assert!((other_lost - lost).abs() < 1e-12 * energy, "{other_lost:e} J in {steps} steps, {lost:e} J in one");
        }
    }
    // 7.9e-6 of 2e-5 J
    assert!((pulled_away(-100.0, 0.1, 5e-3, 1).1 - 7.9e-6).abs() < 0.05e-6);
}

#[test]
fn bodies_in_balance_stay_for_any_time() {
    let depth = unit(&mild()).indentation;
    for (name, model) in all_models(mild()) {
        for part in [0.5, 3.0, 40.0] {
            let mut history = History::start(&model, -part * depth).unwrap();
            let acceleration = history.force() / MASS;
            let outcome = go(&mut history, &model, acceleration, 0.0, 1e3);
            // the force has not changed, within rounding
            assert!((history.indentation() / (part * depth) - 1.0).abs() < 1e-14, "{name} at {part}: {outcome:?}");
            assert!(outcome.speed.abs() < 1e-14 * acceleration, "{name} at {part}: {outcome:?}");
            assert!(
                (outcome.speed_removed / (acceleration * 1e3) - 1.0).abs() < 1e-14,
                "{name} at {part}: {outcome:?}"
            );
        }
    }
}

#[test]
fn a_body_that_its_weight_holds_in_its_dent_trembles_there_for_any_time() {
    for surface in [Surface::Dented, Surface::Fresh] {
        for (name, model) in all_models(mild()) {
            let model = AnyModel { surface, ..model };
            // placed on the surface with its weight: it goes twice as deep as its rest position, and back
            let mut history = History::start(&model, 0.0).unwrap();
            let first = go(&mut history, &model, 9.81, 0.0, 1e-3);
            assert!(history.indentation() >= 0.0, "{name}: {first:?}");
            let mut speed = first.speed;
            for step in [1.0, 100.0, 1e3] {
                let outcome = go(&mut history, &model, 9.81, speed, step);
                // it may begin to bounce only if the law is not passive
                let stays = history.indentation() >= 0.0 && outcome.deepest <= first.deepest * (1.0 + 1e-12);
                assert!(stays || !physics::is_passive(&model), "{name}: {outcome:?} after {first:?}");
                assert!(outcome.evaluations < 20_000, "{name}: {outcome:?}");
                speed = outcome.speed;
            }
        }
    }
}

#[test]
fn a_step_of_a_hundred_thousand_years_is_refused_or_fast() {
    for (name, model) in all_models(mild()) {
        let step = 3.5e12;
        let follow = |acceleration: f64, speed: f64| {
            let mut history = History::start(&model, 0.0).unwrap();
            let result = follow(&mut history, &model, &ExternalLoad { mass: MASS, acceleration }, speed, step);
            (result, history.indentation())
        };
        // one impact, then separation
        let (result, indentation) = follow(0.0, 1.0);
        let outcome = result.unwrap_or_else(|fault| panic!("{name}: {fault:?}"));
        assert!((indentation / (outcome.speed * step) - 1.0).abs() < 1e-12, "{name}");
        // held by its weight: its position within the last of its oscillations cannot be known
        assert_eq!(follow(9.81, 1.0).0, Err(NoMotion::TooLong), "{name}");
        assert_eq!(follow(9.81, 0.0).0, Err(NoMotion::TooLong), "{name}");
    }
}

#[test]
fn the_slowest_impact_that_numbers_can_say_loses_nothing() {
    for (name, model) in all_models(mild()) {
        // these yield at zero force
        if ["walton-braun", "luding"].iter().any(|law| name.starts_with(law)) {
            continue;
        }
        for speed in [1e-30, 1e-100, 1e-130, 1e-150, 1e-160] {
            let mut history = History::start(&model, 0.0).unwrap();
            // twice the contact time with Hertz's law: the contact time is proportional to the speed to the power of -1/5
            let stiffness = model.pair.hertz_stiffness() / MASS;
            let time = 6.0 * (1.0 / (stiffness * stiffness * speed)).powf(0.2);
            let outcome = go(&mut history, &model, 0.0, speed, time);
            assert!((-outcome.speed / speed - 1.0).abs() < 1e-13, "{name} at {speed:e} m/s: {outcome:?}");
            assert!(history.indentation() < 0.0 && outcome.deepest > 0.0, "{name} at {speed:e} m/s");
        }
    }
}

/// A body that touches at a speed far below what its acceleration gives it afterwards is where one is that touches at rest, a
/// little earlier: near the surface, the contact force is negligible.
#[test]
fn a_touch_that_is_slow_beside_the_motion_after_it_is_as_exact_as_any() {
    // a line contact is so stiff that the body has turned many times by then
    let of_balls = |(_, model): &(String, AnyModel)| !model.loading.is_line();
    for (name, model) in all_models(pair_of(0.005, 2e11, 4e8)).into_iter().filter(of_balls) {
        let yields = model.pair.yield_point(1.1);
        let mass = 1.0;
        // the body stays in the elastic range of the laws that have one
        let acceleration = 0.05 * yields.force / mass;
        let scale = (0.1 * yields.indentation / acceleration).sqrt();
        for time in [0.1 * scale, 0.3 * scale, scale] {
            for part in [1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12, 1e-14] {
                let speed = part * acceleration * time;
                let end = |speed: f64, time: f64| {
                    let mut history = History::start(&model, 0.0).expect("within range");
                    let outcome = follow(&mut history, &model, &ExternalLoad { mass, acceleration }, speed, time);
                    (history.indentation(), outcome.expect("within range").speed)
                };
                let (slow, rest) = (end(speed, time), end(0.0, time + speed / acceleration));
                let largest = acceleration * time;
                let off = ((slow.0 - rest.0) / rest.0).abs().max((slow.1 - rest.1).abs() / largest);
                assert!(off < 1e-12 + part * part, "{name}: {off:e} after {time:e} s from {part:e} of the speed");
            }
        }
    }
}
