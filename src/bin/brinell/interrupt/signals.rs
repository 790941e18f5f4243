//! Signals that have no effect.
#![cfg(unix)]
#![allow(unsafe_code, reason = "the standard library has no signals")]

use std::ffi::c_int;

/// SIGHUP, SIGINT and SIGTERM, which end the program.
const ENDS: [c_int; 3] = [1, 2, 15];

/// SIGXFSZ, of a file beyond the limit of the user: without it, writing gives an error, and temporary files are removed.
const TOO_LARGE: c_int = 25;

/// `SIG_IGN`.
const IGNORE: usize = 1;

unsafe extern "C" {
    fn signal(number: c_int, action: usize) -> usize;
}

/// Those of [`ENDS`] that the caller of the program ignores.
pub fn ignored() -> Vec<c_int> {
    let is_ignored = |number: &c_int| {
        // SAFETY: no handler is installed yet; ignoring a signal and restoring its action is always allowed.
        unsafe {
            let before = signal(*number, IGNORE);
            if before != IGNORE {
                signal(*number, before);
            }
            before == IGNORE
        }
    };
    ENDS.into_iter().filter(is_ignored).collect()
}

/// Ignores these signals, and the one of a file that becomes too large.
pub fn ignore(numbers: &[c_int]) {
    for number in numbers.iter().chain(&[TOO_LARGE]) {
        // SAFETY: ignoring a signal is always allowed.
        unsafe { signal(*number, IGNORE) };
    }
}
