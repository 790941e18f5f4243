//! Time and memory to create and free an instance, and those of a library.

use super::build::{size, stripped_size};
use super::exchange::timed;
use super::heap;
use super::paths::STEP;
use super::sampling::interleaved;
use super::table::{Goal, Row};
use super::trio::Trio;
use super::unit::{INPUT, Unit, ok};
use std::fs;
use std::time::Instant;

/// Number of samples of a life cycle, and of life cycles in each.
const ROUNDS: usize = 2000;
const LIVES: usize = 100;

/// Number of samples of the load time; each needs a file.
const LOAD_ROUNDS: usize = 200;

/// Number of instances to measure the memory of one.
const HEAP_INSTANCES: usize = 1000;

pub fn print(trio: &Trio) {
    print_life(trio);
    print_memory(trio);
    print_load_time(trio);
    print_sizes(trio);
}

/// Instantiate, initialize, terminate, free.
fn print_life(trio: &Trio) {
    let times = interleaved(ROUNDS, |unit: usize, _| {
        let time = timed(|| {
            for _ in 0..LIVES {
                drop(trio.units[unit].instance());
            }
            0
        });
        time.as_nanos() as f64 / LIVES as f64
    });
    let name = "instantiate + initialize + terminate + free";
    Row { name, unit: "ns", decimals: 0, goal: Goal::OverC(15.0, 5.0) }.print(times.map(Some));
}

fn print_memory(trio: &Trio) {
    let heap = |unit: &Unit| {
        let mut instances = Vec::with_capacity(2 * HEAP_INSTANCES);
        // the first instances may reuse memory that others have freed
        instances.extend((0..HEAP_INSTANCES).map(|_| unit.instance()));
        let before = heap::in_use()?;
        instances.extend((0..HEAP_INSTANCES).map(|_| unit.instance()));
        Some((heap::in_use()? - before) as f64 / HEAP_INSTANCES as f64)
    };
    let heaps = trio.units.each_ref().map(heap);
    let name = if heaps[0].is_some() { "heap per instance" } else { "heap per instance (needs glibc)" };
    Row { name, unit: "B", decimals: 0, goal: Goal::Value(320.0, 128.0) }.print(heaps);
}

/// Time from opening the library to the end of the first step.
fn print_load_time(trio: &Trio) {
    let times = interleaved(LOAD_ROUNDS, |number: usize, _| {
        // a library that is already open is not loaded again, so each sample needs a new copy
        let copy = trio.folder.join("copy.so");
        fs::copy(&trio.libraries[number], &copy).expect("the folder can be written to");
        let start = Instant::now();
        let unit = Unit::open(&copy, &trio.exported.guid);
        let instance = unit.instance();
        let status = instance.set(INPUT, 1e-3) | instance.step(0.0, STEP);
        let time = start.elapsed();
        ok(status);
        fs::remove_file(&copy).expect("the copy can be removed");
        time.as_nanos() as f64 / 1e3
    });
    let row = Row { name: "load to first step", unit: "us", decimals: 1, goal: Goal::Value(100.0, 70.0) };
    row.print(times.map(Some));
}

fn print_sizes(trio: &Trio) {
    let sizes = trio.libraries.each_ref().map(|library| stripped_size(library, &trio.folder).map(|size| size as f64));
    let [_, c, empty] = sizes;
    let library = Some(size(&trio.libraries[0]) as f64);
    let name = "library, those in C stripped";
    Row { name, unit: "B", decimals: 0, goal: Goal::Value(28_232.0, 24_000.0) }.print([library, c, empty]);
    let archive = Some(trio.exported.archive as f64);
    Row { name: ".fmu", unit: "B", decimals: 0, goal: Goal::Value(f64::INFINITY, 20_000.0) }
        .print([archive, None, None]);
}
