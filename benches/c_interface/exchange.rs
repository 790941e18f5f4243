//! Rates in, steps, forces out.

use super::fleet::Fleet;
use super::unit::{FORCE, INPUT, Instance, Status, ok};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// An exchange for each of `rates` [m/s]: set, step of length `step` [s], get. The instance has made `before` such steps.
/// The status of all calls together.
pub fn exchange(instance: &Instance, rates: &[f64], step: f64, before: usize) -> Status {
    let (mut status, mut force) = (0, 0.0);
    for (index, &rate) in (before..).zip(rates) {
        status |= instance.set(INPUT, rate) | instance.step(index as f64 * step, step);
        status |= instance.get(FORCE, &mut force);
        black_box(force);
    }
    status
}

/// Time of an exchange [ns] on average over `rates`, which the first instance follows from its place.
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

/// Moves an instance that starts at time zero by `increments` [m], one in each step of length `step` [s].
pub fn follow(instance: &Instance, increments: &[f64], step: f64) {
    for (index, increment) in increments.iter().enumerate() {
        ok(instance.set(INPUT, increment / step) | instance.step(index as f64 * step, step));
    }
}
