//! Cycles of increasing amplitude, with typical numbers of steps.

use super::exchange::time_of_exchange;
use super::fleet::Fleet;
use super::instructions::{EXCHANGE, Work};
use super::paths::{CYCLE_STEP, CYCLE_STEPS, STEPS_PER_CYCLE, cycles};
use super::sampling::interleaved;
use super::table::{self, GOALS, Goal, cell};
use super::trio::Trio;
use super::unit::{INPUT, ok};

/// Number of samples for each FMU. A sample consists of all cycles.
const ROUNDS: usize = 5000;

/// Goals of the time relative to the empty FMU, for the default law with a rigid ball and for the law that is also in C, and relative to C.
fn goals(steps_per_cycle: usize) -> [Goal; 3] {
    let (by_default, over_empty) = match steps_per_cycle {
        32 => (Goal::OverEmpty(1.9, 1.9), Goal::OverEmpty(1.9, 1.5)),
        64 => (Goal::OverEmpty(1.7, 1.7), Goal::OverEmpty(1.7, 1.4)),
        128 => (Goal::OverEmpty(1.5, 1.5), Goal::OverEmpty(1.6, 1.35)),
        _ => (Goal::OverEmpty(1.4, 1.4), Goal::None),
    };
    [by_default, over_empty, Goal::OverC(1.15, 1.0)]
}

/// Largest number of instructions of the default law where both bodies can yield.
fn most_instructions(steps_per_cycle: usize) -> Goal {
    let most = match steps_per_cycle {
        32 => 250.0,
        64 => 200.0,
        128 => 160.0,
        _ => 130.0,
    };
    Goal::Value(most, most)
}

/// Number of steps of the cycles in which the regime changes.
pub fn changes(trio: &Trio, steps_per_cycle: usize) -> usize {
    let (unit, regime) = (&trio.with_regime.0, trio.with_regime.1);
    let instance = unit.instance();
    let mut last = instance.integer(regime);
    let mut changes = 0;
    for (index, rate) in cycles(steps_per_cycle).into_iter().enumerate() {
        ok(instance.set(INPUT, rate) | instance.step(index as f64 * CYCLE_STEP, CYCLE_STEP));
        let now = instance.integer(regime);
        changes += usize::from(now != last);
        last = now;
    }
    changes
}

pub fn print(trio: &Trio) {
    print_instructions(trio);
    print_times(trio);
}

fn print_instructions(trio: &Trio) {
    let columns = ["instructions at steps per cycle", "changes of branch", "brinell", "brinell / empty", "both yield"];
    let others = ["big-alabo", "C", "empty", "big-alabo / C", "big-alabo / empty"];
    table::head(&[&columns[..], &GOALS, &others].concat());
    for steps_per_cycle in STEPS_PER_CYCLE {
        let work = Work::along(&cycles(steps_per_cycle), CYCLE_STEP);
        let each = |count: Option<f64>| count.map(|all| all / CYCLE_STEPS as f64);
        let [one, both] = trio.count_by_default(&work, EXCHANGE).map(each);
        let [alabo, c, empty] = trio.count(&work, EXCHANGE).map(each);
        let over = |own: Option<f64>, other: Option<f64>| cell(own.zip(other).map(|(own, other)| own / other), 2);
        let changes = 100.0 * changes(trio, steps_per_cycle) as f64 / CYCLE_STEPS as f64;
        let head = [steps_per_cycle.to_string(), format!("{changes:.1} % of steps")];
        let by_default = [cell(one, 1), over(one, empty), cell(both, 1)];
        let met = most_instructions(steps_per_cycle).cells([both, None, None], "", 0);
        let others = [cell(alabo, 1), cell(c, 1), cell(empty, 1), over(alabo, c), over(alabo, empty)];
        table::row(&[&head[..], &by_default, &met, &others].concat());
    }
}

fn print_times(trio: &Trio) {
    let columns = ["time at steps per cycle", "brinell", "brinell / empty"];
    let others = ["both yield", "big-alabo", "C", "empty", "big-alabo / empty"];
    table::head(&[&columns[..], &GOALS, &others, &GOALS, &["big-alabo / C"], &GOALS].concat());
    let [(one, _), (both, _)] = &trio.by_default;
    let [alabo, c, empty] = &trio.units;
    let fleets = [one, both, alabo, c, empty].map(|unit| Fleet::of(unit, 1));
    let rates = STEPS_PER_CYCLE.map(cycles);
    // taken in turn, so that no row suffers alone from a slow period
    let sample = |number: usize, _| time_of_exchange(&fleets[number % 5], &rates[number / 5], CYCLE_STEP);
    let times: [f64; 5 * STEPS_PER_CYCLE.len()] = interleaved(ROUNDS, sample);
    for (steps_per_cycle, &[one, both, alabo, c, empty]) in STEPS_PER_CYCLE.into_iter().zip(times.as_chunks::<5>().0) {
        let [own, over_empty, over_c] = goals(steps_per_cycle);
        let [time, both, alabo_time, c_time, empty_time] =
            [one, both, alabo, c, empty].map(|time| format!("{time:.2} ns"));
        let ratio = |own: f64, other: f64| format!("{:.2}", own / other);
        let cells = |law: f64, goal: Goal| goal.cells([law, c, empty].map(Some), "", 2);
        let head = [steps_per_cycle.to_string(), time, ratio(one, empty)];
        let others = [both, alabo_time, c_time, empty_time, ratio(alabo, empty)];
        let parts = [&head[..], &cells(one, own), &others, &cells(alabo, over_empty), &[ratio(alabo, c)]];
        table::row(&[&parts.concat()[..], &cells(alabo, over_c)].concat());
    }
}
