//! Importers with both orders of execution, and steps of any length: the rebound agrees with the energy balance. Each importer
//! is used with the scene made for it.

use crate::masters::{MASS, Master, PATTERNS, Parallel, Serial, WiredParallel, WiredSerial, choice};
use crate::physics::{self, AnyModel, Random, all_models, mild};
use crate::scenes::Choice;
use brinell_contact::impact::{Impact, predict};
use brinell_contact::{Loading, Surface};
use brinell_fmu::scene::{Real, Scene};
use brinell_testing::long::some;

/// Runs `one` with both kinds of importers, with input derivatives and with inputs.
fn with_each_master(choice: Choice, speed: f64, acceleration: f64, mut one: impl FnMut(&str, &mut dyn AnyMaster)) {
    one("serial", &mut Master::<Serial>::new(choice, false, false, speed, acceleration));
    one("parallel", &mut Master::<Parallel>::new(choice, true, false, speed, acceleration));
    one("serial, wired", &mut Master::<WiredSerial>::new(choice, false, true, speed, acceleration));
    one("parallel, wired", &mut Master::<WiredParallel>::new(choice, true, true, speed, acceleration));
}

/// An importer for any scene.
trait AnyMaster {
    fn step(&mut self, step: f64);
    fn get(&self, output: Real) -> f64;
    fn speed(&self) -> f64;
    fn has_parted(&self) -> bool;
    fn is_miswired(&mut self) -> bool;
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

/// Energies at the surface over the mass, after each of `count` bounces, from the energy balance [m^2/s^2]: the remainder of
/// `speed^2/2`.
fn bounces(model: &AnyModel, surface: Surface, speed: f64, gravity: f64, count: usize) -> Vec<f64> {
    let work = |depth: f64| model.loading.work(&model.pair, depth) / MASS;
    let recovered = |largest: f64| model.recovered_work(largest, largest) / MASS;
    // at the surface, where the height is zero
    let mut energy = 0.5 * speed * speed;
    let mut largest = 0.0;
    (0..count)
        .map(|_| {
            let stored = if largest > 0.0 { recovered(largest) } else { 0.0 };
            // deeper than the dent by the energy in excess of that returned
            let missing = |depth: f64| work(depth) - work(largest) + stored - energy - gravity * depth;
            if largest == 0.0 || missing(largest) < 0.0 {
                let (mut low, mut high) = (largest, 1e-3);
                while 0.5 * (low + high) > low && 0.5 * (low + high) < high {
                    let middle = 0.5 * (low + high);
                    if missing(middle) > 0.0 { high = middle } else { low = middle }
                }
                largest = low;
                energy = recovered(largest) - gravity * largest;
            }
            // a ball that does not leave its dent touches no fresh surface
            let leaves = energy > 2.0 * gravity * largest;
            if surface == Surface::Fresh {
                largest = 0.0;
            }
            leaves.then_some(energy)
        })
        .take_while(Option::is_some)
        .flatten()
        .collect()
}

#[test]
fn a_ball_bounces_ten_times_to_the_heights_of_the_energy_balance() {
    let (mut worst, mut told) = (0.0f64, 0);
    for surface in [Surface::Dented, Surface::Fresh] {
        let models = all_models(mild()).into_iter();
        let models = models.filter(|(_, model)| physics::is_passive(model) && model.loading.is_segmented());
        for (place, (name, model)) in some(models, 12).enumerate() {
            // gravity is stronger for short steps, to limit their number
            for (size, gravity) in [(1e-6, 50.0), (3e-5, 50.0), (1e-3, 9.81), (5e-3, 9.81)] {
                // with long steps, the tenth bounce may be in the same step as the eleventh
                let expected = bounces(&model, surface, 0.5, gravity, 40);
                if expected.len() < 40 {
                    continue;
                }
                // with the shortest step size there are about ten thousand steps
                let patterns = if size > 1e-6 { &PATTERNS[..] } else { &PATTERNS[place % 4..][..1] };
                for &pattern in patterns {
                    with_each_master(choice(&model, surface, 0.0), 0.5, gravity, |master_name, master| {
                        let mut random = Random(5);
                        let (mut seen, mut bounce, mut given) = (0, 0, 0.0);
                        for count in 0..200_000 {
                            master.step(size * pattern.factor(count, &mut random));
                            assert!(!master.is_miswired(), "{name}, {master_name}, {size} s, {pattern:?}");
                            if master.get(Real::Force) > 0.0 || master.get(Real::Impulse) == 0.0 {
                                continue;
                            }
                            let speed = master.get(Real::ClosingSpeed);
                            let energy = 0.5 * speed * speed - gravity * master.get(Real::Indentation);
                            let error = |bounce: usize| (energy / expected[bounce] - 1.0).abs();
                            let impulse = master.get(Real::Impulse);
                            if impulse > given {
                                // at least one more bounce; with long steps there may be several in one
                                given = impulse;
                                let Some(next) = (seen..expected.len()).min_by(|a, b| error(*a).total_cmp(&error(*b)))
                                else {
                                    break;
                                };
                                (bounce, seen) = (next, next + 1);
                            }
                            worst = worst.max(error(bounce));
                            assert!(
                                error(bounce) < 1e-9,
                                "{name}, {surface:?}, {master_name}, {size} s, {pattern:?}, bounce {bounce}: {:e}",
                                error(bounce)
                            );
                            if seen >= 10 {
                                break;
                            }
                        }
                        told += seen;
                        assert!(seen >= 10, "{name}, {surface:?}, {master_name}, {size} s, {pattern:?}: {seen} seen");
                    });
                }
            }
        }
    }
    println!("largest error of a height: {worst:e}; {told} bounces");
}
