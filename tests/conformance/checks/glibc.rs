//! What an FMU does to its process, as far as glibc tells: memory and floating-point traps.

use crate::face::Face;
use crate::importer::{Importer, OK, Phase, STEP, callbacks};
use std::ffi::c_int;
use std::ptr::null_mut;

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
