//! Hosts that have changed the processor's arithmetic.

use super::{courses, variables};
use crate::arithmetic::{MODES, control, set_control};
use crate::face::Face;

/// In every mode of arithmetic, values are finite, and energies are balanced, and a step is the sum of its parts.
pub fn modes(face: &Face) {
    let usual = control();
    for mode in MODES {
        set_control(usual | mode);
        for check in [
            variables::enormous_inputs,
            courses::values_along_a_course,
            courses::impulse,
            courses::steps_and_their_parts,
        ] {
            check(face);
        }
    }
    set_control(usual);
}
