//! Instances that find the strength of each impact from its closing speed, in the hands of both kinds of importers.

use crate::masters::{MASS, Master, choice};
use crate::physics::{AnyModel, all_models, mild, model};
use crate::scenes::{self, Chosen, Rated, outputs, words};
use brinell_contact::impact::{self, Impact, Prediction};
use brinell_contact::rate::{Factors, Model, Rate};
use brinell_contact::{Loading, Surface};
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::{Absent, Coupled, Present, Real, Scene};

type Serial = Chosen<Rated, 1, Present>;
type Parallel = Chosen<Rated<Coupled<Present>>, 1, Present>;
type WiredSerial = Chosen<Rated<Coupled<Absent, Present, Present>>, 1, Present>;
type WiredParallel = Chosen<Rated<Coupled<Present, Present, Present>>, 1, Present>;

const RATES: [Rate; 2] = [Rate::JohnsonCook { c: 0.014, reference_rate: 1.0 }, Rate::CowperSymonds { d: 40.4, q: 5.0 }];
const SPEEDS: [f64; 5] = [0.01, 0.1, 1.0, 10.0, 100.0];

/// The strength and the prediction of an impact, which the instance must agree with.
fn predicted(slow: &AnyModel, rate: Rate, speed: f64) -> (f64, Prediction) {
    let (model, impact) = (Model { slow: *slow, rate, harder: Rate::NONE }, Impact { mass: MASS, speed });
    let factors = model.in_impact(&impact).expect("within range").factors;
    (factors.softer, impact::predict(&model.at(factors), &impact).expect("within range"))
}

/// An importer with bodies at this closing speed and gap [m].
fn master<S: Scene>(slow: &AnyModel, rate: Rate, surface: Surface, gap: f64, speed: f64, kind: usize) -> Master<S> {
    let choice = scenes::Choice { rate, ..choice(slow, surface, gap) };
    Master::new(choice, kind % 2 == 1, kind >= 2, speed, 0.0)
}

/// Steps until the bodies have parted and the importer knows their speed.
fn bounce<S: Scene>(master: &mut Master<S>, step: f64) {
    for _ in 0..20_000 {
        master.step(step);
        let speed = master.get(Real::ClosingSpeed);
        let known = (master.speed - speed).abs() <= 1e-13 * speed.abs();
        if master.get(Real::Force) == 0.0 && speed < 0.0 && known {
            return;
        }
    }
    panic!("the bodies do not part");
}

/// The restitution of an impact in steps of `step` [s], with each kind of importer.
fn restitutions(slow: &AnyModel, rate: Rate, speed: f64, step: f64, kinds: &[usize]) -> Vec<f64> {
    fn one<S: Scene>(mut master: Master<S>, step: f64) -> f64 {
        let speed = master.speed;
        bounce(&mut master, step);
        assert!(master.instance.take_miswired().is_none());
        -master.speed / speed
    }
    let (surface, gap) = (Surface::Dented, 0.3 * speed * step);
    let each = |&kind: &usize| match kind {
        0 => one(master::<Serial>(slow, rate, surface, gap, speed, kind), step),
        1 => one(master::<Parallel>(slow, rate, surface, gap, speed, kind), step),
        2 => one(master::<WiredSerial>(slow, rate, surface, gap, speed, kind), step),
        _ => one(master::<WiredParallel>(slow, rate, surface, gap, speed, kind), step),
    };
    kinds.iter().map(each).collect()
}

#[test]
fn a_rebound_is_the_predicted_one_at_any_speed_and_in_any_steps() {
    let mut worst = 0.0f64;
    for (loading, unloading) in [("brinell", "brinell"), ("big-alabo", "contact-radius"), ("thornton", "thornton")] {
        let slow = model(loading, unloading);
        for rate in RATES {
            for speed in SPEEDS {
                let (factor, expected) = predicted(&slow, rate, speed);
                assert!(factor > 1.0);
                for parts in [1.0, 10.0, 1000.0] {
                    let step = 1.4 * expected.contact_time() / parts;
                    for found in restitutions(&slow, rate, speed, step, &[0, 1, 2, 3]) {
                        let error = (found / expected.restitution - 1.0).abs();
                        worst = worst.max(error);
                        assert!(error < 1e-10, "{loading}/{unloading}, {rate:?}, {speed} m/s in {parts}: {error:e}");
                    }
                }
            }
        }
    }
    println!("largest error of the restitution: {worst:.1e}");
}

#[test]
fn every_law_has_the_strength_of_its_impact() {
    for (place, (name, slow)) in all_models(mild()).into_iter().enumerate() {
        let (rate, speed) = (RATES[place % 2], SPEEDS[place % 5]);
        let (_, expected) = predicted(&slow, rate, speed);
        let step = 0.7 * expected.contact_time();
        for found in restitutions(&slow, rate, speed, step, &[place % 4]) {
            let error = (found / expected.restitution - 1.0).abs();
            // the motion under a law without segments is known to eight digits
            let allowed = if slow.is_segmented() { 1e-10 } else { 1e-8 };
            assert!(error < allowed, "{name}, {rate:?}, {speed} m/s: {error:e}");
        }
    }
}

#[test]
fn a_dent_keeps_its_strength_and_a_fresh_surface_has_that_of_each_impact() {
    for (loading, unloading) in [("brinell", "brinell"), ("big-alabo", "contact-radius"), ("johnson", "hertz-shift")] {
        let slow = model(loading, unloading);
        for (rate, surface) in [(RATES[0], Surface::Dented), (RATES[1], Surface::Dented), (RATES[1], Surface::Fresh)] {
            for speeds in [[3.0, 0.3, 8.0], [0.3, 3.0, 3.0]] {
                let mut master = master::<Serial>(&slow, rate, surface, 1e-6, speeds[0], 0);
                let (factor, first) = predicted(&slow, rate, speeds[0]);
                let dented = Model { slow, rate, harder: Rate::NONE }.at(Factors { softer: factor, harder: 1.0 });
                let mut deepest = 0.0f64;
                for speed in speeds {
                    // away beyond the original surface, and back
                    (0..3).for_each(|_| {
                        if deepest > 0.0 {
                            master.step(1e-3)
                        }
                    });
                    master.speed = speed;
                    bounce(&mut master, 3e-6);
                    let restitution = -master.speed / speed;
                    let expected = match surface {
                        Surface::Fresh => predicted(&slow, rate, speed).1.restitution,
                        Surface::Dented => {
                            // from the energy balance of a strength that stays
                            let stored = if deepest > 0.0 { dented.recovered_work(deepest, deepest) } else { 0.0 };
                            let work = |depth| dented.loading.work(&dented.pair, depth);
                            let energy = 0.5 * MASS * speed * speed;
                            if energy > stored {
                                deepest = depth_of(|depth| work(depth) - work(deepest) + stored - energy);
                                (dented.recovered_work(deepest, deepest) / energy).sqrt()
                            } else {
                                1.0
                            }
                        }
                    };
                    let error = (restitution / expected - 1.0).abs();
                    assert!(error < 1e-9, "{loading}, {rate:?}, {surface:?}, {speeds:?}, {speed}: {error:e}");
                    deepest = deepest.max(first.max_indentation);
                }
            }
        }
    }
}

/// Where a rising function is zero, by bisection.
fn depth_of(excess: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e-3);
    while 0.5 * (low + high) > low && 0.5 * (low + high) < high {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { high = middle } else { low = middle }
    }
    low
}

#[test]
fn a_state_saved_in_contact_continues_with_the_same_bits() {
    let slow = model("brinell", "brinell");
    for surface in [Surface::Dented, Surface::Fresh] {
        let mut ball = master::<WiredParallel>(&slow, RATES[1], surface, 1e-5, 2.0, 3);
        ball.acceleration = 2e4;
        for step in 0..300 {
            let saved = words(&ball.instance);
            let bytes: Vec<_> = saved.iter().map(|word| word.to_le_bytes()).collect();
            let mut copy = Instance::<WiredParallel>::new().expect("the bodies fit");
            assert!(copy.load(&bytes), "step {step}");
            assert_eq!(words(&copy), saved, "step {step}");
            let (time, speed) = (ball.instance.time(), ball.speed);
            scenes::set_rate(&mut copy, 0, speed);
            copy.set_real((Real::ExternalAcceleration, 0), ball.acceleration);
            copy.set_real((Real::EffectiveMass, 0), ball.mass);
            copy.do_step(time, 5e-6).expect("the bodies can be followed");
            ball.step(5e-6);
            let bits = |instance| outputs(instance).into_iter().map(f64::to_bits).collect::<Vec<_>>();
            assert_eq!(bits(&copy), bits(&ball.instance), "step {step}");
        }
    }
}

#[test]
fn the_predicted_force_is_that_of_the_coming_impact() {
    let slow = model("brinell", "brinell");
    for rate in RATES {
        for speed in SPEEDS {
            let (factor, expected) = predicted(&slow, rate, speed);
            let strong = Model { slow, rate, harder: Rate::NONE }.at(Factors { softer: factor, harder: 1.0 });
            let way = 0.8 * expected.max_indentation;
            let mut ball = master::<Serial>(&slow, rate, Surface::Dented, 1.5 * way, speed, 0);
            ball.step(way / speed);
            let found = ball.get(Real::PredictedForce);
            let force = strong.loading.segment(&strong.pair, 0.5 * way).force(0.5 * way);
            assert!((found / force - 1.0).abs() < 1e-9, "{rate:?} {speed}: {found} {force}");
        }
    }
}
