//! What an FMU does to its process: floating-point traps, memory, stack, threads, other instances.

use crate::checks::{courses, derivatives, logging, states};
use crate::face::Face;
use crate::importer::{Importer, OK, Phase, STEP, callbacks};
use std::ffi::c_int;
use std::ptr::null_mut;
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

/// Instances that take turns give the same bits as each alone.
pub fn instances_in_turn(face: &Face) {
    let count = 4;
    let alone: Vec<_> = (0..count).map(|number| course(face, number, 60)).collect();
    let mut all: Vec<_> = (0..count).map(|_| Importer::at(face, Phase::StepComplete)).collect();
    let expected = |number: usize, step: usize| &alone[number][step];
    for step in 0..60 {
        // all inputs first, then all steps, then all outputs
        for (number, i) in all.iter().enumerate() {
            i.set_rates(rate(number, step));
        }
        for i in &mut all {
            assert_eq!(i.step(i.time, STEP), OK, "{:?}", i.log);
            i.time += STEP;
        }
        for (number, i) in all.iter().enumerate() {
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

/// What `mallinfo2` of glibc tells.
#[repr(C)]
#[derive(Default)]
struct Mallinfo2 {
    arena: usize,
    ordblks: usize,
    smblks: usize,
    hblks: usize,
    hblkhd: usize,
    usmblks: usize,
    fsmblks: usize,
    /// Bytes in use, except those of large pieces, which are `hblkhd`.
    uordblks: usize,
    fordblks: usize,
    keepcost: usize,
}

#[link(name = "m")]
unsafe extern "C" {
    fn mallinfo2() -> Mallinfo2;
    fn feenableexcept(exceptions: c_int) -> c_int;
    fn fedisableexcept(exceptions: c_int) -> c_int;
    fn feclearexcept(exceptions: c_int) -> c_int;
}

/// Bytes of this process that were allocated and not freed.
fn in_use() -> usize {
    // SAFETY: it has no precondition
    let info = unsafe { mallinfo2() };
    info.uordblks + info.hblkhd
}

/// The bytes that `run` leaves behind each time: the least of several trials, since the test runner has threads of its own.
fn left_by(mut run: impl FnMut()) -> isize {
    let trial = |_| {
        let before = in_use();
        run();
        in_use() as isize - before as isize
    };
    (0..4).map(trial).min().expect("several trials")
}

/// Instances, states and errors leave no memory behind, and steps take none.
pub fn memory(face: &Face) {
    let live = || {
        let mut i = Importer::at(face, Phase::StepComplete);
        let state = i.save();
        let bytes = i.bytes(state);
        let (status, other) = i.state_of(&bytes);
        assert_eq!(status, OK);
        let mut bad = bytes.clone();
        bad[20] ^= 1;
        i.state_of(&bad);
        assert_eq!(i.restore(other), OK);
        i.press(0.1);
        let mut again = state;
        // SAFETY: the state lives
        assert_eq!(unsafe { (i.f().get_fmu_state)(i.c, &raw mut again) }, OK);
        i.step(i.time, f64::NAN);
        assert_eq!(i.reset(), OK);
        // SAFETY: a wrong type gives no instance
        unsafe {
            let callbacks = callbacks(face, &i.log);
            let c = (i.f().instantiate)(c"x".as_ptr(), 0, face.guid.as_ptr(), null_mut(), &raw const callbacks, 0, 0);
            (i.f().free_instance)(c);
        }
        i.free(state);
        i.free(other);
    };
    (0..3).for_each(|_| live());
    let rounds = 30;
    let left = left_by(|| (0..rounds).for_each(|_| live()));
    assert!(left < rounds, "{left} bytes are left after {rounds} lives");
    let mut i = Importer::at(face, Phase::StepComplete);
    let rates = &face.rates;
    let values = vec![1e-3; rates.len()];
    let left = left_by(|| {
        for _ in 0..100 {
            assert_eq!(i.set(rates, &values), OK);
            assert_eq!(i.step(i.time, STEP), OK);
            i.time += STEP;
        }
    });
    assert!(left <= 0, "{left} bytes are left after 100 steps");
}

/// Division by zero, overflow and invalid operations, as in `fenv.h` for this processor.
#[cfg(any(target_arch = "x86_64", target_arch = "x86"))]
const TRAPS: c_int = 0x04 | 0x08 | 0x01;
#[cfg(not(any(target_arch = "x86_64", target_arch = "x86")))]
const TRAPS: c_int = 0x02 | 0x04 | 0x01;

/// Calls in a host whose processor traps; a trapped operation ends this process with SIGFPE.
pub fn floating_point_traps(face: &Face) {
    // SAFETY: they have no precondition
    unsafe {
        feclearexcept(TRAPS);
        feenableexcept(TRAPS);
    }
    let mut i = Importer::at(face, Phase::StepComplete);
    for step in 0..300 {
        let speed = [0.0, -0.0, 1.0, -0.3, -8.0, 1e-3, 5.0, -1.0, 0.01, -50.0][(7 * step + step / 16) % 10];
        i.press(speed);
        i.bits();
        let state = i.save();
        let (_, other) = i.state_of(&i.bytes(state));
        assert_eq!(i.restore(other), OK);
        i.free(state);
        i.free(other);
    }
    // refusals compute with the wrong values: none of them may trap. A NaN is left out, since a comparison with it may trap
    for value in [f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
        let i = Importer::at(face, Phase::StepComplete);
        i.set(&[face.inputs[0]], &[value]);
        assert_eq!(i.reset(), OK);
        let i = Importer::at(face, Phase::StepComplete);
        i.step(i.time, value);
        i.step(value, STEP);
    }
    // SAFETY: as above
    unsafe { fedisableexcept(TRAPS) };
}
