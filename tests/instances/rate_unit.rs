//! Instances that find the strength of each impact from its closing speed, in the hands of both kinds of importers.

use crate::masters::{MASS, Master, choice};
use crate::physics::{AnyModel, all_models, mild, model};
use crate::scenes::{self, Chosen, Rated};
use brinell_contact::impact::{self, Impact, Prediction};
use brinell_contact::rate::{Factors, Model, Rate};
use brinell_contact::{Loading, Surface};
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

/// All rates, speeds, lengths of steps and kinds of importers meet in turn.
#[test]
fn a_rebound_is_the_predicted_one_with_every_law_at_any_speed_and_in_any_steps() {
    for (place, (name, slow)) in all_models(mild()).into_iter().enumerate() {
        for (turn, speed) in SPEEDS.into_iter().enumerate() {
            let (rate, parts) = (RATES[(place + turn) % 2], [1.4, 2.0, 10.0, 1000.0][(place + turn) % 4]);
            let (factor, expected) = predicted(&slow, rate, speed);
            assert!(factor >= 1.0);
            let step = 1.4 * expected.contact_time() / parts;
            for found in restitutions(&slow, rate, speed, step, &[(place + turn / 2) % 4]) {
                let error = (found / expected.restitution - 1.0).abs();
                // the motion under a law without segments is known to eight digits
                let allowed = if slow.is_segmented() { 1e-10 } else { 1e-8 };
                assert!(error < allowed, "{name}, {rate:?}, {speed} m/s in {parts}: {error:e}");
            }
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
