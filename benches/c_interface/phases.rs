//! Many instances in turn, each at another position on the same cycles. This measures an FMU whose instances do not fit into
//! the cache of a core, with contacts on all branches.

use super::exchange::{exchange, timed};
use super::fleet::Fleet;
use super::paths::{CYCLE_STEP, CYCLE_STEPS, cycles};
use super::sampling::interleaved;
use super::table::{Goal, Row};
use super::trio::Trio;
use super::unit::{FORCE, INPUT, Instance, Status, ok};
use std::hint::black_box;

const INSTANCES: usize = 10_000;

const STEPS_PER_CYCLE: usize = 64;

/// Number of steps of each instance in a sample.
const STEPS_OF_EACH: usize = 50;

/// Number of samples.
const ROUNDS: usize = 200;

/// The number of steps that an instance has made. Neighbouring instances are far apart.
fn phase(index: usize) -> usize {
    const APART: usize = 617;
    index * APART % (CYCLE_STEPS - STEPS_OF_EACH)
}

pub fn print(trio: &Trio) {
    let rates = cycles(STEPS_PER_CYCLE);
    let prepare = |index: usize, instance: &Instance| ok(exchange(instance, &rates[..phase(index)], CYCLE_STEP, 0));
    let fleets = trio.units.each_ref().map(|unit| Fleet::placed(unit, INSTANCES, prepare));
    let times = interleaved(ROUNDS, |unit: usize, _| {
        fleets[unit].restore();
        let time = timed(|| in_turn(&fleets[unit], black_box(&rates)));
        time.as_nanos() as f64 / (INSTANCES * STEPS_OF_EACH) as f64
    });
    let name = "set + step + get, 10,000 instances in turn on all branches, 64 steps per cycle";
    Row { name, unit: "ns", decimals: 2, goal: Goal::OverEmpty(2.4, 1.7) }.print(times.map(Some));
}

fn in_turn(fleet: &Fleet, rates: &[f64]) -> Status {
    let (mut status, mut force) = (0, 0.0);
    for step in 0..STEPS_OF_EACH {
        for (index, instance) in fleet.instances.iter().enumerate() {
            let made = phase(index) + step;
            status |= instance.set(INPUT, rates[made]) | instance.step(made as f64 * CYCLE_STEP, CYCLE_STEP);
            status |= instance.get(FORCE, &mut force);
            black_box(force);
        }
    }
    status
}
