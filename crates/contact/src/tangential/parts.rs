//! The parts of a step with changing rates.

use crate::history::path::RatePolynomial;

/// Parts of a step in two directions with changing rates.
const PARTS: usize = 8;

/// More parts than a step can have.
pub(super) const MOST_PARTS: usize = 11;

/// End times \[s\] of the parts of a step with changing rates, unsorted. The last one is the end of the step.
///
/// In one direction the contact either slips in one direction or sticks over each part, as far as the rates alone show it:
/// the times at which the rate of the indentation is zero or as large as the tangential rate times `scale`. In two directions
/// the way may turn all the time. The step is divided evenly, and where the rate of the indentation is zero.
pub(super) fn ends_of_parts<const D: usize>(
    normal: &RatePolynomial,
    tangential: &[RatePolynomial; D],
    scale: f64,
    step: f64,
) -> [f64; MOST_PARTS] {
    let mut ends = [step; MOST_PARTS];
    let mut places = ends.iter_mut();
    let mut add = |times: &[f64]| places.by_ref().zip(times).for_each(|(place, time)| *place = *time);
    let [tangential] = tangential.as_slice() else {
        let even = core::array::from_fn::<f64, PARTS, _>(|part| step * ((part + 1) as f64 / PARTS as f64));
        add(&normal.monotone_ends(step));
        add(&even);
        return ends;
    };
    for scale in [0.0, scale, -scale] {
        let difference = RatePolynomial {
            rate: normal.rate - scale * tangential.rate,
            slope: normal.slope - scale * tangential.slope,
            bend: normal.bend - scale * tangential.bend,
        };
        add(&difference.monotone_ends(step));
    }
    ends
}

/// The earliest of `ends` after `time` \[s\].
pub(super) fn next_of(ends: &[f64; MOST_PARTS], time: f64) -> Option<f64> {
    let behind = ends.iter().copied().filter(|&end| end > time);
    behind.reduce(|one, other| if other < one { other } else { one })
}
