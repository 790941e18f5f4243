//! Setting rates, stepping, reading forces.

use super::fleet::Fleet;
use super::unit::{FORCE, INPUT, Instance, Status, ok};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// For each of `rates` [m/s]: set the input, make a step of `step` [s], read the force. The instance has made `before` such
/// steps. Returns the combined status of all calls.
pub fn exchange(instance: &Instance, rates: &[f64], step: f64, before: usize) -> Status {
    let (mut status, mut force) = (0, 0.0);
    for (index, &rate) in (before..).zip(rates) {
        status |= instance.set(INPUT, rate) | instance.step(index as f64 * step, step);
        status |= instance.get(FORCE, &mut force);
        black_box(force);
    }
    status
}

/// Mean time of an exchange [ns] over `rates`, which the first instance follows from its position.
pub fn time_of_exchange(fleet: &Fleet, rates: &[f64], step: f64) -> f64 {
    fleet.restore();
    let time = timed(|| exchange(&fleet.instances[0], black_box(rates), step, 0));
    time.as_nanos() as f64 / rates.len() as f64
}

/// Time of `work`, whose calls must all succeed.
pub fn timed(work: impl FnOnce() -> Status) -> Duration {
    let start = Instant::now();
    let status = work();
    let time = start.elapsed();
    ok(status);
    time
}

/// Moves an instance from time zero by `increments` [m], one in each step of `step` [s].
pub fn follow(instance: &Instance, increments: &[f64], step: f64) {
    for (index, increment) in increments.iter().enumerate() {
        ok(instance.set(INPUT, increment / step) | instance.step(index as f64 * step, step));
    }
}
