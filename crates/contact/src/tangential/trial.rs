//! The mean of a force over a way from trial steps.

use super::vector::{add, length};
use crate::numerics::smallest;

/// Error of the mean force on a growing dent that is accepted, relative to the normal force. Where the motion turns, the forces
/// themselves are off by more.
pub(super) const TOLERANCE: f64 = 1e-5;

/// The largest number of parts that are tried.
const MOST_TRIES: u32 = 400;

/// Mean of a tangential force over a way, from its values at the `start` and at the `end`, and `at` a part of the way. An error of
/// `tolerance` is accepted in each part \[N\].
///
/// By Boole's rule over parts of the way, which become shorter where springs begin or cease to slip. There the force has a kink. Its
/// third differences in both halves of a part bound the error, wherever the kink is. The fourth difference, by which Simpson's rule
/// over the part and over its halves differ, vanishes for some places of a kink. The sizes of vectors don't depend on the
/// directions in which they are counted, so motion along one line has the same parts in two directions as in one.
pub(super) fn mean_over<const D: usize>(
    start: [f64; D],
    end: [f64; D],
    tolerance: f64,
    at: impl Fn(f64) -> [f64; D],
) -> [f64; D] {
    let (mut sum, mut from, mut here, mut width) = ([0.0; D], 0.0, start, 1.0);
    // the middle and the end of a part that is half of one before
    let mut known = None;
    for turn in 1..=MOST_TRIES {
        let left = 1.0 - from;
        // the last part is all that is left, however rough the force is there
        let is_last = turn == MOST_TRIES;
        let part = if is_last { left } else { smallest(width, left) };
        let (middle, next) = known.take().filter(|_| !is_last).unwrap_or_else(|| {
            let next = if part < left { at(from + part) } else { end };
            (at(from + 0.5 * part), next)
        });
        let [first, third] = [0.25, 0.75].map(|place| at(from + place * part));
        let forces = [here, first, middle, third, next];
        let error = (length(weighted([-1.0, 3.0, -3.0, 1.0, 0.0], forces))
            + length(weighted([0.0, -1.0, 3.0, -3.0, 1.0], forces)))
            / 12.0;
        if part * error > tolerance && !is_last {
            known = Some((first, middle));
            width = 0.5 * part;
            continue;
        }
        let mean = weighted([7.0, 32.0, 12.0, 32.0, 7.0], forces);
        sum = add(sum, part / 90.0, mean);
        if part >= left {
            return sum;
        }
        (from, here, width) = (from + part, next, 2.0 * part);
    }
    sum
}

/// The sum of `forces` with these weights.
fn weighted<const D: usize>(weights: [f64; 5], forces: [[f64; D]; 5]) -> [f64; D] {
    weights.into_iter().zip(forces).fold([0.0; D], |sum, (weight, force)| add(sum, weight, force))
}

#[cfg(test)]
mod tests {
    use super::{MOST_TRIES, mean_over};
    use core::cell::Cell;

    /// The mean of a force that jumps at each of `jumps` places between 1 and 3, and the number of trial steps.
    fn mean_of_jumps(jumps: f64) -> (f64, u32) {
        let tries = Cell::new(0);
        let force = |place: f64| [if ((jumps * place) as u64).is_multiple_of(2) { 1.0 } else { 3.0 }];
        let counted = |place| {
            tries.set(tries.get() + 1);
            force(place)
        };
        let [mean] = mean_over(force(0.0), force(1.0), 1e-9, counted);
        (mean, tries.get())
    }

    #[test]
    fn a_force_that_is_too_rough_for_all_tries_has_the_mean_of_the_whole_way() {
        for jumps in [1.5, 7.3, 40.1, 333.7, 1e4, 1e9] {
            let (mean, tries) = mean_of_jumps(jumps);
            // within the values of the force, which no mean over a part of the way would be
            assert!((1.0..=3.0).contains(&mean), "{jumps} jumps: {mean}");
            assert!(tries <= 4 * MOST_TRIES, "{jumps} jumps: {tries} trial steps");
        }
    }
}
