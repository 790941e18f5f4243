//! Bodies under a contact with a loss, where the force has a kink, the surface lags behind, or hardly anything moves.

use crate::moved_bodies::{Differences, Losing, LosingModel, Start, pulled_body, rate_dependent, with_loss};
use crate::physics::{AnyModel, MASS, Random, all_models, mild, pair_of};
use crate::prescribed::rate_dependent_laws;
use brinell_contact::Contact;
use brinell_contact::impact::Impact;
use brinell_contact::losses::{AnyLoss, History, RestitutionFitted, follow, impact};
use brinell_contact::motion::ExternalLoad;
use brinell_testing::long::some;

/// One contact of bodies of this mass [kg] at a depth [m], with an acceleration [m/s^2] and a speed [m/s].
fn body(model: LosingModel, mass: f64, depth: f64, acceleration: f64, speed: f64) -> Losing {
    Losing::new(vec![model], &[-depth], vec![1.0 / mass], vec![acceleration], vec![speed])
}

fn fitted(plastic: AnyModel, restitution: f64) -> LosingModel {
    LosingModel { plastic, loss: AnyLoss::RestitutionFitted(RestitutionFitted { restitution }) }
}

#[test]
fn the_contact_time_of_a_prediction_is_that_of_the_force() {
    const STEPS: u32 = 400;
    let (mut random, mut cases) = (Random(4407), 0);
    let mut check = |name: &str, model: LosingModel, it: &Impact| {
        let Some(found) = impact::predict(&model, it) else { return };
        // in a target that gives way easily the force fades out
        let (expected, least) = (found.contact_time(), 1e-12 * found.max_force);
        let mut group = body(model, it.mass, 0.0, 0.0, it.speed);
        // to a quarter beyond, so that a force that lasts longer is seen
        let mut last = 0;
        for number in 1..=STEPS + STEPS / 4 {
            group.step(expected / f64::from(STEPS));
            let force = Contact::<LosingModel>::force(&group.contacts[0], group.rates[0]);
            last = if force > least { number } else { last };
        }
        assert!(STEPS.abs_diff(last) <= 1, "{name}, {model:?}: the force ends after {last} of {STEPS} steps");
        cases += 1;
    };
    for (name, law) in some(all_models(mild()), 3) {
        for kind in 0..3 {
            let Some((start, it)) = pulled_body(&mut random, &law) else { continue };
            check(&name, with_loss(&mut random, &start.group.models[0], kind, &it), &it);
        }
    }
    // some of these surfaces grip again
    for (name, law) in rate_dependent_laws() {
        for speed in [0.1, 3.0] {
            check(&name, rate_dependent(law, mild(), MASS), &Impact { mass: MASS, speed });
        }
    }
    assert!(cases > 80, "only {cases} cases");
}

#[test]
fn bodies_that_leave_a_surface_that_lags_behind_them_may_come_back_within_the_same_step() {
    let mut found = Differences::default();
    for (name, plastic) in all_models(mild()) {
        let yields = plastic.pair.yield_point(1.1);
        for (restitution, slowness) in [(0.3, 1.0), (0.3, 100.0), (0.6, 1.0)] {
            let (mass, speed) = (1.0, -(yields.force * yields.indentation).sqrt() / slowness);
            // up to three yield indentations, down again, and a tenth of that longer
            let acceleration = speed * speed / (6.0 * yields.indentation);
            let group = body(fitted(plastic, restitution), mass, 0.1 * yields.indentation, acceleration, speed);
            let start = Start {
                group,
                energy: 0.5 * mass * speed * speed,
                step: -2.2 * speed / acceleration,
                depth: yields.indentation,
            };
            found.add(&name, &start, (&[100], 2e-9, [1e-9; 2]), |_| ());
        }
    }
    found.finish("a surface that lags behind");
}

#[test]
fn bodies_that_are_pulled_back_hard_feel_the_whole_law_on_their_way() {
    for (name, plastic) in all_models(mild()) {
        let yields = plastic.pair.yield_point(1.1);
        // the force at yield is far below the pull, as the change of speed by it is below the error of the integration
        let (speed, depth) = (1.0, 2000.0 * yields.indentation);
        let acceleration = -speed * speed / (2.0 * depth);
        let mass = 1e11 * yields.force / -acceleration;
        let dissipated = |parts: u32| {
            let mut group = body(fitted(plastic, 0.8), mass, 0.0, acceleration, speed);
            (0..parts).for_each(|_| group.step(-2.5 * speed / acceleration / f64::from(parts)));
            group.contacts[0].dissipated_energy(&group.models[0])
        };
        let off = (dissipated(1) / dissipated(100) - 1.0).abs();
        assert!(off < 1e-3, "{name} in 100 steps is off by {off:e}");
    }
}

#[test]
fn a_flight_after_the_contact_is_no_heat_however_fast_it_gets() {
    for (name, plastic) in all_models(mild()) {
        let yields = plastic.pair.yield_point(1.1);
        let (speed, mass) = (1.0, 100.0 * yields.force * yields.indentation);
        // the contact takes a small part of the energy, and the flight gives a billion times as much
        let acceleration = -speed * speed / (40.0 * yields.indentation);
        for restitution in [0.3, 0.9] {
            let [short, long] = [3.0, 1e6].map(|time| {
                let mut group = body(fitted(plastic, restitution), mass, 0.0, acceleration, speed);
                group.step(-time * speed / acceleration);
                (group.rates[0], group.contacts[0].dissipated_energy(&group.models[0]))
            });
            assert!(long.0 < 3e4 * short.0 && short.1 != 0.0, "{name}: {short:?}, {long:?}");
            let off = (long.1 / short.1 - 1.0).abs();
            assert!(off < 1e-8, "{name}, e = {restitution}: {off:e}");
        }
    }
}

/// Bodies near rest are slower than the rounding of the forces on them. A step of some oscillations then took forty times the
/// evaluations, or failed.
#[test]
fn bodies_come_to_rest_in_steps_of_few_evaluations_wherever_they_rest() {
    let mut random = Random(99);
    let mut most = 0;
    for (name, plastic) in all_models(mild()) {
        let modulus = random.log_uniform(1e9, 1e12);
        let pair = pair_of(random.log_uniform(1e-4, 1.0), modulus, modulus / random.log_uniform(50.0, 1000.0));
        let plastic = AnyModel { pair, ..plastic };
        let yields = pair.yield_point(1.1);
        for restitution in [0.3, 0.7, 0.9] {
            // where the bodies rest, or how deep they have been before
            let (rest, dent) = (random.log_uniform(1e-4, 0.1), [0.0, random.log_uniform(2.0, 100.0)]);
            let mass = random.log_uniform(1e-9, 1e3);
            let resting = brinell_contact::History::start(&plastic, -rest * yields.indentation).expect("within range");
            let acceleration = resting.force() / mass;
            let swing = (yields.indentation * rest / acceleration).sqrt();
            let speed = acceleration * swing * random.log_uniform(0.1, 3.0);
            for dent in dent {
                let model =
                    LosingModel { plastic, loss: AnyLoss::RestitutionFitted(RestitutionFitted { restitution }) };
                let depth = dent * yields.indentation;
                let mut history = History::start(&model, -depth).expect("within range");
                // up to the surface of the dent
                let bottom = history.plastic().residual_indentation(&plastic);
                history.advance(&model, -1.0, depth - bottom).expect("within range");
                let load = ExternalLoad { mass, acceleration };
                let (mut speed, mut steps) = (speed, 0);
                while steps == 0 || speed != 0.0 && steps < 30 {
                    let what = format!("{name}, e = {restitution}, dent {dent}, rest {rest}, step {steps}");
                    let outcome = follow(&mut history, &model, &load, speed, 20.0 * swing);
                    let outcome = outcome.unwrap_or_else(|reason| panic!("{what}: {reason:?}"));
                    most = most.max(outcome.evaluations);
                    assert!(outcome.evaluations < 100_000, "{what}: {} evaluations", outcome.evaluations);
                    speed = outcome.speed;
                    steps += 1;
                }
                let left = speed.abs() / (acceleration * swing);
                assert!(left < 0.1, "{name}, e = {restitution}, dent {dent}: {left} of the speed is left");
            }
        }
    }
    println!("at most {most} evaluations in a step");
}
