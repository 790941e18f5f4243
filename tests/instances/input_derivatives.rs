//! Derivatives of the inputs: what they are valid for, and how far they may lead.

use crate::physics::Random;
use crate::scenes::{choose, frictions, ready, set_rate, set_tangential_rate};
use crate::{FrictionalOne, FrictionalSeveral, One, RoughPlaneOne, RoughPlaneSeveral, STEP, Several, some_pairings};
use brinell_contact::Contact;
use brinell_fmu::instance::{FASTEST, Fault};
use brinell_fmu::scene::{Real, Scene};

/// The prediction after a step with derivatives continues from its end; after any other step it follows the input.
#[test]
fn a_prediction_after_a_step_without_derivatives_is_the_force_of_the_next_step_whatever_came_before() {
    fn check<S: Scene>(name: &str) {
        let mut instance = ready::<S>();
        let mut random = Random(23);
        let mut pressed = 0;
        for step in 0..120 {
            let curved = random.next() < 0.5;
            for contact in 0..S::contacts() {
                set_rate(&mut instance, contact, 4.0 * random.next() - 1.9);
                set_tangential_rate(&mut instance, contact, 2.0 * random.next() - 0.9);
                let inputs = [Real::IndentationRate, Real::TangentialRate, Real::SecondTangentialRate];
                for input in inputs.into_iter().take(if curved { 1 + S::Contact::DIRECTIONS } else { 0 }) {
                    instance.set_input_derivative((input, contact), 1, (random.next() - 0.5) / STEP);
                }
            }
            let time = instance.time();
            instance.do_step(time, STEP).unwrap();
            if curved {
                continue;
            }
            let mut next = ready::<S>();
            next.copy(&instance);
            for contact in 0..S::contacts() {
                let rate = 4.0 * random.next() - 1.9;
                set_rate(&mut instance, contact, rate);
                set_rate(&mut next, contact, rate);
            }
            let time = next.time();
            next.do_step(time, STEP).unwrap();
            for contact in 0..S::contacts() {
                let predictions = [(Real::PredictedForce, Real::Force)].into_iter();
                let of_friction = [
                    (Real::PredictedTangentialForce, Real::TangentialForce),
                    (Real::SecondPredictedTangentialForce, Real::SecondTangentialForce),
                ];
                let has = |of: &(Real, Real)| frictions::<S>().any(|output| output == of.0);
                for (predicted, force) in predictions.chain(of_friction.into_iter().filter(has)) {
                    let (predicted, force) = (instance.real((predicted, contact)), next.real((force, contact)));
                    let error = (predicted - force).abs();
                    assert!(error <= 1e-12 * force.abs(), "{name} in step {step}: {predicted} for {force}");
                    pressed += u32::from(force != 0.0);
                }
            }
        }
        assert!(pressed >= 10, "{name}: {pressed} forces");
    }
    for (name, choice) in some_pairings() {
        choose(choice);
        check::<One>(&name);
        check::<Several>(&name);
        check::<FrictionalOne>(&name);
        check::<FrictionalSeveral>(&name);
        check::<RoughPlaneOne>(&name);
        check::<RoughPlaneSeveral>(&name);
    }
}

/// A tangential rate may come up to the limit within a step, whatever the derivatives are that lead there.
#[test]
fn a_tangential_rate_that_exceeds_the_limit_within_the_step_is_refused() {
    choose(some_pairings()[0].1);
    let shares = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, 0.3, 0.4], [-0.3, -0.3, -0.4]];
    for input in [Real::TangentialRate, Real::SecondTangentialRate] {
        for step in [1e-9, 1e-3, 1.0, 1e3] {
            for share in shares {
                for (size, is_allowed) in [(0.999, true), (1.001, false)] {
                    let mut instance = ready::<RoughPlaneOne>();
                    let [rate, slope, bend] = share.map(|share| share * size * FASTEST);
                    instance.set_real((input, 0), rate);
                    instance.set_input_derivative((input, 0), 1, slope / step);
                    instance.set_input_derivative((input, 0), 2, 2.0 * bend / (step * step));
                    let result = instance.do_step(0.0, step);
                    let is_refused = matches!(result, Err(Fault::InputOutOfRange { input: Real::TangentialRate, .. }));
                    let what = format!("{input:?}, {share:?} of {size} in {step} s: {result:?}");
                    assert_eq!((result.is_ok(), is_refused), (is_allowed, !is_allowed), "{what}");
                }
            }
        }
    }
}
