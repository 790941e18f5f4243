//! Importers with both orders of execution, and steps of any length: the rebound is the predicted one, also where the instance finds the
//! strength of each impact from its closing speed. Each importer is used with the scene made for it.

use crate::physics::{AnyModel, Random, all_models, mild, model};
use crate::scenes::{self, Choice, Chosen, Rated, ready, words};
use brinell_contact::impact::{self, Impact, Prediction, predict};
use brinell_contact::rate::{Factors, Model, Rate};
use brinell_contact::{Loading, Surface};
use brinell_fmu::scene::{Absent, Coupled, Present, Real, Scene};
use brinell_testing::masters::{MASS, Master, PATTERNS, Parallel, Serial, WiredParallel, WiredSerial, choice};

/// Runs `one` with both kinds of importers, with input derivatives and with inputs, at this speed and gravity.
fn with_each_master(choice: Choice, speed: f64, gravity: f64, mut one: impl FnMut(&str, &mut dyn AnyMaster)) {
    one("serial", &mut Master::<Serial>::new(choice, false, false, speed, gravity));
    one("parallel", &mut Master::<Parallel>::new(choice, true, false, speed, gravity));
    one("serial, wired", &mut Master::<WiredSerial>::new(choice, false, true, speed, gravity));
    one("parallel, wired", &mut Master::<WiredParallel>::new(choice, true, true, speed, gravity));
}

/// An importer for any scene.
trait AnyMaster {
    fn step(&mut self, step: f64);
    fn get(&self, output: Real) -> f64;
    fn speed(&self) -> f64;
    fn has_parted(&self) -> bool;
    fn is_miswired(&mut self) -> bool;
    /// Goes on with a new instance that is loaded from the words of the old one.
    fn reload(&mut self);
}

impl<S: Scene> AnyMaster for Master<S> {
    fn step(&mut self, step: f64) {
        Master::step(self, step);
    }
    fn get(&self, output: Real) -> f64 {
        Master::get(self, output)
    }
    fn speed(&self) -> f64 {
        self.speed
    }
    fn has_parted(&self) -> bool {
        Master::has_parted(self)
    }
    fn is_miswired(&mut self) -> bool {
        self.instance.take_miswired().is_some()
    }
    fn reload(&mut self) {
        let bytes: Vec<_> = words(&self.instance).iter().map(|word| word.to_le_bytes()).collect();
        self.instance = ready::<S>();
        assert!(self.instance.load(&bytes), "its own words are refused");
    }
}

/// Sizes of steps [s]; the contact of `big-alabo` takes 29.5 us.
const SIZES: [f64; 5] = [1e-6, 7e-6, 1e-4, 5e-4, 2e-3];

#[test]
fn a_rebound_is_the_predicted_one_whatever_the_master_and_its_steps() {
    // by step size and kind of importer
    let mut worst = [[0.0f64; 4]; SIZES.len()];
    for (name, model) in all_models(mild()) {
        let expected = predict(&model, &Impact { mass: MASS, speed: 1.0 }).unwrap().restitution;
        for (row, size) in SIZES.into_iter().enumerate() {
            for pattern in PATTERNS {
                let mut kind = 0;
                with_each_master(choice(&model, Surface::Dented, 0.4 * size), 1.0, 0.0, |master_name, master| {
                    let mut random = Random(11);
                    let mut count = 0;
                    while !master.has_parted() {
                        master.step(size * pattern.factor(count, &mut random));
                        count += 1;
                        assert!(count < 1000, "{name}, {master_name}, {size} s, {pattern:?}: the debt isn't paid");
                    }
                    let error = (-master.speed() / expected - 1.0).abs();
                    worst[row][kind] = worst[row][kind].max(error);
                    kind += 1;
                    assert!(error < 1e-11, "{name}, {master_name}, {size} s, {pattern:?}: off by {error:e}");
                    assert!(!master.is_miswired(), "{name}, {master_name}, {size} s, {pattern:?}");
                });
            }
        }
    }
    println!("largest error of the restitution: serial, parallel, serial wired, parallel wired");
    SIZES
        .iter()
        .zip(worst)
        .for_each(|(size, errors)| println!("{size:e} s: {}", errors.map(|error| format!("{error:.1e}")).join(" ")));
}

/// What it loses is what the contact has taken up, and no master is told anything, also where the instance is restored again and again.
#[test]
fn a_ball_bounces_by_the_balance_of_energy_with_each_master_and_from_restored_states() {
    let (mut worst, mut bounces) = (0.0f64, 0);
    for (place, (name, model)) in all_models(mild()).into_iter().enumerate() {
        let (surface, pattern) = ([Surface::Dented, Surface::Fresh][place % 2], PATTERNS[place / 2 % 4]);
        for (size, gravity) in [(3e-5, 50.0), (1e-3, 9.81), (5e-3, 9.81)] {
            with_each_master(choice(&model, surface, 0.0), 0.5, gravity, |master_name, master| {
                let (mut random, mut given) = (Random(5), 0.0);
                for count in 0..usize::min(3000, (0.5 / size) as usize) {
                    if count % 7 == 3 {
                        master.reload();
                    }
                    master.step(size * pattern.factor(count, &mut random));
                    let what = format!("{name}, {surface:?}, {master_name}, {size} s, {pattern:?}, step {count}");
                    assert!(!master.is_miswired(), "{what}");
                    let kinetic = 0.5 * MASS * master.get(Real::ClosingSpeed).powi(2);
                    let potential = MASS * gravity * master.get(Real::Indentation);
                    let error = (kinetic - potential + master.get(Real::Work)) / (0.125 * MASS) - 1.0;
                    worst = worst.max(error.abs());
                    assert!(error.abs() < 1e-9, "{what}: {error:e}");
                    let impulse = master.get(Real::Impulse);
                    if master.get(Real::Force) == 0.0 {
                        bounces += u32::from(impulse > given);
                        given = impulse;
                    }
                }
            });
        }
    }
    println!("largest error of the energy: {worst:.1e}, {bounces} bounces");
    assert!(bounces > 10_000, "{bounces}");
}

type RatedSerial = Chosen<Rated, 1, Present>;
type RatedParallel = Chosen<Rated<Coupled<Present>>, 1, Present>;
type RatedWiredSerial = Chosen<Rated<Coupled<Absent, Present, Present>>, 1, Present>;
type RatedWiredParallel = Chosen<Rated<Coupled<Present, Present, Present>>, 1, Present>;

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
        0 => one(master::<RatedSerial>(slow, rate, surface, gap, speed, kind), step),
        1 => one(master::<RatedParallel>(slow, rate, surface, gap, speed, kind), step),
        2 => one(master::<RatedWiredSerial>(slow, rate, surface, gap, speed, kind), step),
        _ => one(master::<RatedWiredParallel>(slow, rate, surface, gap, speed, kind), step),
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
            let mut ball = master::<RatedSerial>(&slow, rate, Surface::Dented, 1.5 * way, speed, 0);
            ball.step(way / speed);
            let found = ball.get(Real::PredictedForce);
            let force = strong.loading.segment(&strong.pair, 0.5 * way).force(0.5 * way);
            assert!((found / force - 1.0).abs() < 1e-9, "{rate:?} {speed}: {found} {force}");
        }
    }
}
