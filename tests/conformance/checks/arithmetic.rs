//! Hosts that have changed the processor's arithmetic.

use super::{courses, variables};
use crate::arithmetic::{MODES, control, set_control};
use crate::face::Face;

/// In every mode of arithmetic, values are finite, and energies are balanced, and a step is the sum of its parts. Each enormous input
/// is set in one of the modes, or as usual.
pub fn modes(face: &Face) {
    let (usual, count) = (control(), MODES.len() + 1);
    variables::enormous_inputs(face, 0, count);
    for (place, mode) in (1..).zip(MODES) {
        set_control(usual | mode);
        variables::enormous_inputs(face, place, count);
        for check in [courses::values_along_a_course, courses::impulse, courses::steps_and_their_parts] {
            check(face);
        }
    }
    set_control(usual);
}
