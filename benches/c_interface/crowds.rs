//! Impacts and single steps, of one instance and of many in turn.

use super::exchange::{time_of_exchange, timed};
use super::fleet::Fleet;
use super::instructions::{EXCHANGE, STEP as STEP_ALONE, Work};
use super::paths::{PEAK, STEP, STEPS, impact, share};
use super::sampling::interleaved;
use super::table::{Goal, Row, number};
use super::trio::Trio;
use super::unit::{FORCE, INPUT, Instance, Status};
use std::hint::black_box;

/// The number of instances of each FMU, the number of impacts in one sample, and the number of samples. A sample is long enough
/// for the clock, and short enough that an interruption spoils few of them.
struct Crowd {
    instances: usize,
    impacts: usize,
    rounds: usize,
    /// For an impact, and for the step alone.
    goals: [Goal; 2],
}

const CROWDS: [Crowd; 3] = [
    Crowd { instances: 1, impacts: 10, rounds: 8000, goals: [Goal::OverC(1.25, 1.1), Goal::OverC(1.2, 1.1)] },
    Crowd { instances: 100, impacts: 1, rounds: 200, goals: [Goal::OverC(1.25, 1.1); 2] },
    Crowd { instances: 10_000, impacts: 1, rounds: 40, goals: [Goal::OverC(1.4, 1.1); 2] },
];

pub fn print(trio: &Trio) {
    let rates = impact();
    for crowd in &CROWDS {
        let fleets = trio.units.each_ref().map(|unit| Fleet::of(unit, crowd.instances));
        let shares: Vec<f64> = (0..crowd.instances).map(share).collect();
        let [impact_goal, step_goal] = crowd.goals;
        let title = |name: &str| match crowd.instances {
            1 => name.to_owned(),
            instances => format!("{name}, {} instances in turn", number(instances as f64, 0)),
        };
        let times = |measure: &dyn Fn(&Fleet) -> f64| {
            let sample = |unit: usize, _| {
                let total: f64 = (0..crowd.impacts).map(|_| measure(&fleets[unit])).sum();
                total / crowd.impacts as f64
            };
            interleaved(crowd.rounds, sample).map(Some)
        };
        let impacts = times(&|fleet| match crowd.instances {
            1 => time_of_exchange(fleet, &rates, STEP),
            _ => time_in_turn(fleet, || impacts(fleet, black_box(&rates), &shares)),
        });
        let alone = times(&|fleet| time_in_turn(fleet, || there_and_back(fleet, &shares)));
        Row { name: &title("set + step + get"), unit: "ns", decimals: 2, goal: impact_goal }.print(impacts);
        if crowd.instances == 1 {
            let name = "set + step + get, each rate from the last force";
            let coupled = times(&|fleet| time_in_turn(fleet, || rebound(&fleet.instances[0])));
            Row { name, unit: "ns", decimals: 2, goal: Goal::OverC(1.2, 1.1) }.print(coupled);
        }
        Row { name: &title("step alone"), unit: "ns", decimals: 2, goal: step_goal }.print(alone);
    }
}

/// Time of `work` per instance and step, for [`STEPS`] steps [ns].
fn time_in_turn(fleet: &Fleet, work: impl FnOnce() -> Status) -> f64 {
    fleet.restore();
    timed(work).as_nanos() as f64 / (STEPS * fleet.instances.len()) as f64
}

/// An impact with an input and an output in every step, by instances that step in turn. Returns the combined status of all
/// calls.
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

/// Mass [kg] and closing speed [m/s] of a ball that is in contact in most of the steps, and about as deep as the [`PEAK`].
const BALL: (f64, f64) = (4.0, 0.03);

/// The rebound of a ball, as by a master that couples it with the contact: each rate follows from the last force. Returns the
/// combined status of all calls.
fn rebound(instance: &Instance) -> Status {
    let (mass, mut speed) = BALL;
    let (mut status, mut force) = (0, 0.0);
    for index in 0..STEPS {
        speed -= force * (STEP / mass);
        status |= instance.set(INPUT, speed) | instance.step(index as f64 * STEP, STEP);
        status |= instance.get(FORCE, &mut force);
    }
    status
}

/// The speed [m/s] at which half of the steps reach the [`PEAK`].
const SPEED: f64 = PEAK / (STEPS / 2) as f64 / STEP;

/// Loading and unloading at constant speed, without reading the force.
fn there_and_back(fleet: &Fleet, shares: &[f64]) -> Status {
    let mut status = 0;
    for (speed, steps) in [(SPEED, 0..STEPS / 2), (-SPEED, STEPS / 2..STEPS)] {
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

/// Prints the mean number of instructions of a step on the same paths, including changes of branch.
pub fn print_instructions(trio: &Trio) {
    let speeds = [vec![SPEED; STEPS / 2], vec![-SPEED; STEPS / 2]].concat();
    for (name, rates, functions, goal) in [
        ("instructions of set + step + get", impact(), EXCHANGE, Goal::Value(75.0, 63.0)),
        ("instructions of step alone", speeds, STEP_ALONE, Goal::Value(36.0, 26.0)),
    ] {
        let counts = trio.count(&Work::along(&rates, STEP), functions).map(|count| count.map(|all| all / STEPS as f64));
        Row { name, unit: "", decimals: 1, goal }.print(counts);
    }
}
