//! The integral of force over time: the impulse of a step.

use crate::history::History;
use crate::history::path::RatePolynomial;
use crate::history::piece::Piece;
use crate::loading::Loading;
use crate::numerics::quadrature::{gauss, graded_integral};
use crate::regime::TooDeep;
use crate::unloading::Unloading;
use crate::{Model, Surface};
use libm::fabs;

/// The largest difference between two integrals of a smooth force, as a fraction of the integral.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// More pieces than any law has in one direction: none has more than a dozen.
const MOST_PIECES: u32 = 100;

/// Impulse \[N.s\] of a step along `course` for `step` \[s\] from the present state, which does not change.
///
/// The path is split where the direction changes and where the law has a corner. On each part the force is smooth in time. If
/// the rate is constant and the law has segments, the integral is a closed form. Otherwise Gauss's rule integrates to rounding;
/// for laws with segments it integrates only the [power](crate::segment::Segment).
///
/// # Errors
/// [`TooDeep`] as for [`History::advance`].
pub fn impulse<L: Loading, U: Unloading>(
    history: &History,
    model: &Model<L, U>,
    course: &RatePolynomial,
    step: f64,
) -> Result<f64, TooDeep> {
    if !course.is_held() && model.is_segmented() {
        let mut contact = *history;
        return Ok(contact.advance_along(course, step, || model)?.1);
    }
    impulse_by_pieces(history, model, course, step)
}

/// [`impulse`] for a constant rate, or for a law without segments.
pub(super) fn impulse_by_pieces<L: Loading, U: Unloading>(
    history: &History,
    model: &Model<L, U>,
    course: &RatePolynomial,
    step: f64,
) -> Result<f64, TooDeep> {
    let mut walk = Walk { contact: *history, model, course, origin: history.indentation(), time: 0.0, impulse: 0.0 };
    for end in course.monotone_ends(step) {
        let mut pieces = 0;
        while walk.time < end {
            if pieces == MOST_PIECES {
                return Err(TooDeep { indentation: walk.at(end) });
            }
            walk.go_on(end)?;
            pieces += 1;
        }
    }
    Ok(walk.impulse)
}

/// A contact on its way through a step.
struct Walk<'a, L, U> {
    contact: History,
    model: &'a Model<L, U>,
    course: &'a RatePolynomial,
    /// Indentation at the start of the step \[m\].
    origin: f64,
    /// Time since then \[s\].
    time: f64,
    impulse: f64,
}

impl<L: Loading, U: Unloading> Walk<'_, L, U> {
    /// Indentation after `time` \[m\].
    fn at(&self, time: f64) -> f64 {
        self.origin + self.course.way(time)
    }

    /// Goes on in one direction, to `end` \[s\] or to the next corner of the law.
    fn go_on(&mut self, end: f64) -> Result<(), TooDeep> {
        let (from, to) = (self.contact.indentation(), self.at(end));
        let rising = to > from;
        let piece = match Piece::ahead(&self.contact, self.model, rising) {
            Ok(piece) => piece.part(from, rising),
            Err(surface) => {
                // a fresh surface forgets the dent at zero
                let forgets = !rising && self.model.surface == Surface::Fresh && from > 0.0 && to < 0.0;
                let border = if rising { surface } else { 0.0 };
                let stops = (rising && to > surface) || forgets;
                let (time, goal) = if stops { (self.when(border, end), border) } else { (end, to) };
                self.time = time;
                return self.contact.go_to(self.model, goal, rising);
            }
        };
        let leaves = if rising { to > piece.upper } else { to < piece.lower };
        let border = if rising { piece.upper } else { piece.lower };
        let (time, goal) = if leaves { (self.when(border, end), border) } else { (end, to) };
        self.impulse += self.over(&piece, (self.time, time), (from, goal));
        self.time = time;
        self.contact.go_to(self.model, goal, rising)
    }

    /// Impulse over the smooth `piece`, from one time and indentation to another.
    fn over(&self, piece: &Piece<'_, L, U>, (start, end): (f64, f64), (from, to): (f64, f64)) -> f64 {
        // a law made of segments gets here only with a constant rate, and then needs no quadrature
        let is_held = self.model.is_segmented() || self.course.is_held();
        // a segment of a chain is one, too
        if is_held && let Some(segment) = piece.whole() {
            return (end - start) * segment.mean_force(from, to);
        }
        let force = |time: f64| piece.force(self.at(time));
        // where the force begins, at the surface or at a corner of the law, it may be a fractional power; usually that point is
        // far away
        let middle = 0.5 * (start + end);
        let (whole, halves) = (gauss(start, end, &force), gauss(start, middle, &force) + gauss(middle, end, &force));
        if fabs(whole - halves) <= ROUNDING * fabs(halves) { halves } else { graded_integral(start, end, &force) }
    }

    /// The time between now and `end` \[s\] at which the indentation is `border` \[m\].
    fn when(&self, border: f64, end: f64) -> f64 {
        self.course.when(|time| self.at(time) - border, (self.time, end), 0.5 * (self.time + end))
    }
}
