//! The cost of a change of branch in addition to a step that stays on its branch, in instructions of the step alone.
//!
//! It is the number of instructions of the steps of some path, minus that of as many steps that stay on their branch, divided
//! by the number of changes. A change is a step after which `regime` is different.

use super::corners::{self, Place, STEP, STEPS_BEFORE, before_corners};
use super::cycles;
use super::instructions::{STEP as STEP_ALONE, Work};
use super::paths::{CYCLE_STEP, CYCLE_STEPS};
use super::table::{Goal, Row};
use super::trio::Trio;
use super::unit::INPUT;

/// Number of repetitions of each kind of change. The steps that lead to it are counted once.
const TIMES: usize = 10_000;

/// Number of steps that stay on their branch.
const STILL: usize = 1000;

/// Prints the mean over the changes in cycles of 32 steps, and each kind separately.
pub fn print(trio: &Trio) {
    const STEPS_PER_CYCLE: usize = 32;
    let still = Work::along(&[0.0; STILL], STEP);
    let plain = trio.count(&still, STEP_ALONE).map(|count| count.map(|all| all / STILL as f64));
    let beyond = |work: &Work, steps: usize, changes: usize| {
        let counts = trio.count(work, STEP_ALONE);
        let [brinell, c, _] = [0, 1, 2].map(|unit| {
            let (all, plain) = (counts[unit]?, plain[unit]?);
            Some((all - plain * steps as f64) / changes as f64)
        });
        [brinell, c, None]
    };
    let name = format!("instructions of a change of branch, mean at {STEPS_PER_CYCLE} steps per cycle");
    let work = Work::along(&super::paths::cycles(STEPS_PER_CYCLE), CYCLE_STEP);
    let counts = beyond(&work, CYCLE_STEPS, cycles::changes(trio, STEPS_PER_CYCLE));
    Row { name: &name, unit: "", decimals: 0, goal: Goal::Value(150.0, 60.0) }.print(counts);
    let places = before_corners(trio);
    corners::check(trio, &places, |instance, place| {
        instance.set(INPUT, place.step / STEP) | instance.step(STEPS_BEFORE as f64 * STEP, STEP)
    });
    for Place { name, before, step, .. } in places {
        let before = before.map(|increment| increment / STEP).to_vec();
        let work = Work { before, rates: vec![step / STEP], step: STEP, times: TIMES };
        let counts = beyond(&work, TIMES + STEPS_BEFORE, TIMES);
        Row { name: &format!("- {name}"), unit: "", decimals: 0, goal: Goal::None }.print(counts);
    }
}
