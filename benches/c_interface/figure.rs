//! What is measured of a unit with one contact.

use super::unit::{Fleet, INPUT, Status, Unit, ok};
use std::hint::black_box;
use std::ptr::null_mut;
use std::time::{Duration, Instant};

/// Reference of the force of a unit with one contact.
pub const FORCE: u32 = 1;

/// Steps of an impact, half of them closing.
pub const STEPS: usize = 1000;

/// Size of a step [s].
pub const STEP: f64 = 1e-6;

/// Largest indentation of the impact [m]: about 200 yield indentations of the ball on steel that the units are.
const PEAK: f64 = 200.0 * 5.9e-8;

/// Rates [m/s] of an impact whose force is thought constant: they fall linearly from closing to opening, so that each
/// step has another one. Half of the steps load the contact, a quarter unloads it, the rest is flight.
pub fn rates() -> Vec<f64> {
    let largest = 4.0 * PEAK / (STEPS as f64 * STEP);
    (0..STEPS).map(|index| largest * (1.0 - (2 * index + 1) as f64 / STEPS as f64)).collect()
}

/// What the rates of one of many contacts are multiplied by, so that not all leave their branches in the same step. The
/// first has them as they are.
pub fn share(contact: usize) -> f64 {
    1.0 - (contact % 16) as f64 / 100.0
}

/// One kind of work. All of it is done [`STEPS`] times with every instance.
#[derive(Clone, Copy, PartialEq)]
pub enum Figure {
    /// Set, step and get, in an impact; with many instances each does so in turn.
    Impact,
    /// There and back at constant speed, without looking at the force.
    StepsAlone,
    /// The state is saved over an older one and restored.
    SaveAndRestore,
    /// The state is saved, and restored after a step.
    Rollback,
}

impl Figure {
    pub const ALL: [Figure; 4] = [Figure::Impact, Figure::StepsAlone, Figure::SaveAndRestore, Figure::Rollback];

    pub fn name(self) -> &'static str {
        match self {
            Figure::Impact => "set + step + get",
            Figure::StepsAlone => "step alone",
            Figure::SaveAndRestore => "get + set state",
            Figure::Rollback => "rollback of a step",
        }
    }

    /// Time of `impacts` times [`STEPS`] operations with each instance; what leads back to the start isn't part of it.
    pub fn measure(self, fleet: &Fleet, rates: &[f64], impacts: u64) -> Duration {
        let mut total = Duration::ZERO;
        for _ in 0..impacts {
            fleet.restore();
            total += self.measure_once(fleet, black_box(rates));
        }
        total
    }

    fn measure_once(self, fleet: &Fleet, rates: &[f64]) -> Duration {
        let one = &fleet.instances[0];
        let shares: Vec<f64> = (0..fleet.instances.len()).map(share).collect();
        let mut state = null_mut();
        ok(one.save(&mut state));
        if self == Figure::Rollback {
            // in the middle of loading
            ok(rates[..STEPS / 4]
                .iter()
                .enumerate()
                .fold(0, |status, (index, &rate)| status | one.set(INPUT, rate) | one.step(index as f64 * STEP, STEP)));
        }
        let start = Instant::now();
        let status = match self {
            Figure::Impact if fleet.instances.len() == 1 => impact(fleet, rates),
            Figure::Impact => impacts(fleet, rates, &shares),
            Figure::StepsAlone => there_and_back(fleet, &shares),
            Figure::SaveAndRestore => {
                (0..STEPS).fold(0, |status, _| status | one.save(&mut state) | one.restore(state))
            }
            Figure::Rollback => {
                let time = (STEPS / 4) as f64 * STEP;
                (0..STEPS)
                    .fold(0, |status, _| status | one.save(&mut state) | one.step(time, STEP) | one.restore(state))
            }
        };
        let time = start.elapsed();
        ok(status);
        one.free(&mut state);
        time
    }
}

/// An impact with an input and an output for every step; the status of all calls together.
fn impact(fleet: &Fleet, rates: &[f64]) -> Status {
    let instance = &fleet.instances[0];
    let (mut status, mut force) = (0, 0.0);
    for (index, &rate) in rates.iter().enumerate() {
        status |= instance.set(INPUT, rate) | instance.step(index as f64 * STEP, STEP);
        status |= instance.get(FORCE, &mut force);
        black_box(force);
    }
    status
}

/// The same for many instances, which step in turn.
fn impacts(fleet: &Fleet, rates: &[f64], shares: &[f64]) -> Status {
    let (mut status, mut force) = (0, 0.0);
    for (index, &rate) in rates.iter().enumerate() {
        let time = index as f64 * STEP;
        for (instance, share) in fleet.instances.iter().zip(shares) {
            status |= instance.set(INPUT, rate * share) | instance.step(time, STEP);
            status |= instance.get(FORCE, &mut force);
            black_box(force);
        }
    }
    status
}

fn there_and_back(fleet: &Fleet, shares: &[f64]) -> Status {
    let speed = PEAK / (STEPS / 2) as f64 / STEP;
    let mut status = 0;
    for (speed, steps) in [(speed, 0..STEPS / 2), (-speed, STEPS / 2..STEPS)] {
        for (instance, share) in fleet.instances.iter().zip(shares) {
            status |= instance.set(INPUT, speed * share);
        }
        for index in steps {
            for instance in &fleet.instances {
                status |= instance.step(index as f64 * STEP, STEP);
            }
        }
    }
    status
}

/// From opening the library to the end of the first step. The library must not be open already.
pub fn load(open: impl FnOnce() -> Unit) -> Duration {
    let start = Instant::now();
    let unit = open();
    let instance = unit.instance();
    let status = instance.set(INPUT, 1e-3) | instance.step(0.0, STEP);
    let time = start.elapsed();
    ok(status);
    time
}
