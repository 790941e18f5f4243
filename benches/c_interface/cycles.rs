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

/// Goals of the time relative to the empty FMU and to the one in C.
fn goals(steps_per_cycle: usize) -> [Goal; 2] {
    let over_empty = match steps_per_cycle {
        32 => Goal::OverEmpty(1.9, 1.5),
        64 => Goal::OverEmpty(1.7, 1.4),
        128 => Goal::OverEmpty(1.6, 1.35),
        _ => Goal::None,
    };
    [over_empty, Goal::OverC(1.15, 1.0)]
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
    let columns = ["instructions at steps per cycle", "changes of branch", "Brinell", "C", "empty", "Brinell / C"];
    table::head(&[&columns[..], &["Brinell / empty"]].concat());
    for steps_per_cycle in STEPS_PER_CYCLE {
        let work = Work::along(&cycles(steps_per_cycle), CYCLE_STEP);
        let [brinell, c, empty] = trio.count(&work, EXCHANGE).map(|count| count.map(|all| all / CYCLE_STEPS as f64));
        let over = |other: Option<f64>| brinell.zip(other).map(|(brinell, other)| brinell / other);
        let changes = 100.0 * changes(trio, steps_per_cycle) as f64 / CYCLE_STEPS as f64;
        table::row(&[
            steps_per_cycle.to_string(),
            format!("{changes:.1} % of steps"),
            cell(brinell, 1),
            cell(c, 1),
            cell(empty, 1),
            cell(over(c), 2),
            cell(over(empty), 2),
        ]);
    }
}

fn print_times(trio: &Trio) {
    let columns = ["time at steps per cycle", "Brinell", "C", "empty", "Brinell / empty"];
    table::head(&[&columns[..], &GOALS, &["Brinell / C"], &GOALS].concat());
    let fleets = trio.units.each_ref().map(|unit| Fleet::of(unit, 1));
    let rates = STEPS_PER_CYCLE.map(cycles);
    // taken in turn, so that no row suffers alone from a slow period
    let sample = |number: usize, _| time_of_exchange(&fleets[number % 3], &rates[number / 3], CYCLE_STEP);
    let times: [f64; 3 * STEPS_PER_CYCLE.len()] = interleaved(ROUNDS, sample);
    for (steps_per_cycle, &times) in STEPS_PER_CYCLE.into_iter().zip(times.as_chunks::<3>().0) {
        let [over_empty, over_c] = goals(steps_per_cycle).map(|goal| goal.cells(times.map(Some), "", 2));
        let [brinell, c, empty] = times;
        let measured = times.map(|time| format!("{time:.2} ns"));
        let [empty_ratio, c_ratio] = [empty, c].map(|other| format!("{:.2}", brinell / other));
        let head = [steps_per_cycle.to_string()];
        table::row(&[&head[..], &measured, &[empty_ratio], &over_empty, &[c_ratio], &over_c].concat());
    }
}
