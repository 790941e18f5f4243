//! What an FMU does to its process: stack, threads, other instances.

use crate::checks::{courses, derivatives, logging, states};
use crate::face::Face;
use crate::importer::{Importer, OK, Phase, STEP};
use std::thread;

/// A rate that presses, holds, releases and presses again [m/s]; it differs between instances.
fn rate(number: usize, step: usize) -> f64 {
    (0.2 + 0.01 * number as f64) * (0.05 * (step * (1 + number % 3)) as f64).cos()
}

/// The instance `number`, moved along its course; the bits of all variables at the end of each step.
fn course(face: &Face, number: usize, steps: usize) -> Vec<Vec<u64>> {
    let mut i = Importer::new(face);
    i.go(Phase::StepComplete);
    (0..steps)
        .map(|step| {
            i.press(rate(number, step));
            i.bits()
        })
        .collect()
}

/// Instances that take turns give the same bits as each alone, also after one of them has been freed.
pub fn instances_in_turn(face: &Face) {
    let count = 4;
    let alone: Vec<_> = (0..count).map(|number| course(face, number, 60)).collect();
    let mut all: Vec<_> = (0..count).map(|_| Importer::at(face, Phase::StepComplete)).collect();
    let expected = |number: usize, step: usize| &alone[number][step];
    for step in 0..60 {
        let freed = usize::from(step >= 30);
        if freed > 0 && all.len() == count {
            all.remove(0);
        }
        // all inputs first, then all steps, then all outputs
        for (number, i) in (freed..).zip(&all) {
            i.set_rates(rate(number, step));
        }
        for i in &mut all {
            assert_eq!(i.step(i.time, STEP), OK, "{:?}", i.log);
            i.time += STEP;
        }
        for (number, i) in (freed..).zip(&all) {
            assert_eq!(&i.bits(), expected(number, step), "instance {number} in step {step}");
        }
    }
}

/// Instances in threads of their own give the same bits as each alone.
pub fn instances_in_threads(face: &Face) {
    let (threads, steps) = (8, 300usize.div_ceil(face.rates.len()).max(20));
    let alone: Vec<_> = (0..threads).map(|number| course(face, number, steps)).collect();
    for _ in 0..3 {
        thread::scope(|scope| {
            let all: Vec<_> = (0..threads).map(|number| scope.spawn(move || course(face, number, steps))).collect();
            for (number, (thread, alone)) in all.into_iter().zip(&alone).enumerate() {
                assert_eq!(&thread.join().expect("a thread ends"), alone, "thread {number}");
            }
        });
    }
}

/// The stack of a thread that musl makes \[bytes\]: the smallest of the common C libraries.
const SMALL_STACK: usize = 128 << 10;

/// Steps, states, derivatives and refusals in a thread with a small stack; one that overflows ends this process.
pub fn small_stack(face: &Face) {
    let checks = [
        courses::values_along_a_course,
        courses::steps_and_their_parts,
        states::saving_into_a_state,
        derivatives::in_every_direction,
        logging::every_refusal_is_told,
    ];
    for check in checks {
        let small = thread::Builder::new().stack_size(SMALL_STACK);
        thread::scope(|scope| {
            small.spawn_scoped(scope, || check(face)).expect("a thread").join().expect("the check passes there, too")
        });
    }
}
