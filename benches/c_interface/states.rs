//! States: saving over an older state, restoring, and both around a step.

use super::exchange::{exchange, timed};
use super::fleet::Fleet;
use super::paths::{STEP, STEPS, impact};
use super::sampling::interleaved;
use super::table::{Goal, Row};
use super::trio::Trio;
use super::unit::{FORCE, INPUT, Instance, State, Status, ok};
use std::ptr::null_mut;

/// Number of samples, and of operations in each.
const ROUNDS: usize = 5000;
const OPERATIONS: usize = 10_000;

/// The contact is in the middle of loading.
const STEPS_BEFORE: usize = STEPS / 4;

type Operation = fn(&Instance, &mut State) -> Status;

const OPERATIONS_BY_NAME: [(&str, Operation, Goal); 4] = [
    ("get state", |instance, state| instance.save(state), Goal::OverC(1.25, 1.1)),
    ("set state", |instance, state| instance.restore(*state), Goal::OverC(1.25, 1.1)),
    ("get + set state", |instance, state| instance.save(state) | instance.restore(*state), Goal::OverC(1.25, 1.1)),
    (
        "save + step + restore",
        |instance, state| {
            let time = STEPS_BEFORE as f64 * STEP;
            instance.save(state) | instance.step(time, STEP) | instance.restore(*state)
        },
        Goal::OverC(1.25, 1.1),
    ),
];

pub fn print(trio: &Trio) {
    let rates = impact();
    let fleets = trio.units.each_ref().map(|unit| Fleet::of(unit, 1));
    let mut states = fleets.each_ref().map(|fleet| {
        let mut state = null_mut();
        ok(exchange(&fleet.instances[0], &rates[..STEPS_BEFORE], STEP, 0));
        ok(fleet.instances[0].save(&mut state));
        state
    });
    for (fleet, &mut state) in fleets.iter().zip(&mut states) {
        check(&fleet.instances[0], state);
    }
    for (name, operation, goal) in OPERATIONS_BY_NAME {
        let times = interleaved(ROUNDS, |unit: usize, _| {
            let (instance, state) = (&fleets[unit].instances[0], &mut states[unit]);
            let time = timed(|| (0..OPERATIONS).fold(0, |status, _| status | operation(instance, state)));
            time.as_nanos() as f64 / OPERATIONS as f64
        });
        Row { name, unit: "ns", decimals: 2, goal }.print(times.map(Some));
    }
    for (fleet, state) in fleets.iter().zip(&mut states) {
        fleet.instances[0].free(state);
    }
}

/// Checks that the restored state is the saved one.
fn check(instance: &Instance, state: State) {
    let before = instance.value(FORCE);
    ok(instance.set(INPUT, 1.0) | instance.step(STEPS_BEFORE as f64 * STEP, STEP));
    assert_ne!(instance.value(FORCE), before, "the step leads elsewhere");
    ok(instance.restore(state));
    assert_eq!(instance.value(FORCE), before, "the state is restored");
}
