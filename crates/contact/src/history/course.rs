//! A contact during a motion with a changing rate, and its impulse.

use super::{History, Regime, TooDeep};
use crate::Model;
use crate::history::panel::impulse_on;
use crate::history::path::RatePolynomial;
use crate::loading::Loading;
use crate::numerics::{largest, smallest};
use crate::segment::Segment;
use crate::unloading::Unloading;
use core::borrow::Borrow;

/// More branches than a motion in one direction can cross: no law has more than a dozen.
const MOST_BRANCHES: u32 = 100;

/// Progress through a step.
struct Progress<'a> {
    course: &'a RatePolynomial,
    /// Indentation at the start of the step \[m\].
    start: f64,
    /// Time since then \[s\].
    time: f64,
    /// Present indentation \[m\].
    indentation: f64,
    /// Impulse so far \[N.s\].
    impulse: f64,
}

impl Progress<'_> {
    /// Goes on along `segment`, to `indentation` \[m\] at the time `end` \[s\].
    fn go_along(&mut self, segment: &Segment, end: f64, indentation: f64) {
        let from = (self.time, self.indentation);
        self.impulse += impulse_on(segment, self.course, from, (end, indentation));
        (self.time, self.indentation) = (end, indentation);
    }

    /// The time at which the indentation is `indentation` \[m\], at most `end` \[s\].
    fn when(&self, indentation: f64, end: f64) -> f64 {
        if indentation == self.indentation {
            return self.time;
        }
        self.course.when_at(indentation - self.start, self.time, end)
    }
}

impl History {
    /// Moves the contact along `course` for `step` \[s\]. Returns the largest indentation of the step \[m\] and the impulse
    /// \[N.s\]. The law must have segments.
    ///
    /// # Errors
    /// As for [`History::advance`].
    #[inline(never)]
    pub(crate) fn advance_along<L: Loading, U: Unloading, B: Borrow<Model<L, U>>>(
        &mut self,
        course: &RatePolynomial,
        step: f64,
        model: impl Fn() -> B,
    ) -> Result<(f64, f64), TooDeep> {
        let start = self.indentation();
        let mut way = Progress { course, start, time: 0.0, indentation: start, impulse: 0.0 };
        let (mut moved, mut deepest, mut from) = (*self, 0.0, 0.0);
        for end in course.monotone_ends(step) {
            let to = course.way(end);
            let increment = to - from;
            if increment > 0.0 {
                moved.rise(&mut way, end, increment, &model)?;
            } else {
                moved.fall(&mut way, end, increment, &model)?;
            }
            from = to;
            deepest = largest(moved.max_indentation(), deepest);
        }
        *self = moved;
        Ok((deepest, way.impulse))
    }

    /// Moves deeper by `increment` \[m\] until the time `end` \[s\], from branch to branch.
    #[inline(never)]
    fn rise<L: Loading, U: Unloading, B: Borrow<Model<L, U>>>(
        &mut self,
        way: &mut Progress<'_>,
        end: f64,
        increment: f64,
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        for _ in 0..MOST_BRANCHES {
            let stays = self.advance_on_branch(increment);
            let border = self.segment.upper;
            let (time, to) = if stays { (end, self.indentation()) } else { (way.when(border, end), border) };
            match self.regime {
                Regime::Apart => (way.time, way.indentation) = (time, to),
                _ => way.go_along(&self.segment, time, to),
            }
            if stays {
                return Ok(());
            }
            // the indentation keeps its value until the branch on which the motion ends
            self.change_branch(model().borrow(), border, true)?;
        }
        Err(TooDeep { indentation: self.indentation() + increment })
    }

    /// Moves back by `increment` \[m\] until the time `end` \[s\]: down one path, and through the air.
    #[inline(never)]
    fn fall<L: Loading, U: Unloading, B: Borrow<Model<L, U>>>(
        &mut self,
        way: &mut Progress<'_>,
        end: f64,
        increment: f64,
        model: impl Fn() -> B,
    ) -> Result<(), TooDeep> {
        let presses = self.regime != Regime::Apart && increment < 0.0;
        let path = match presses && self.is_loading() {
            true => model().borrow().unloading_path(self.max_indentation()),
            false => self.segment,
        };
        if !self.advance_on_branch(increment) {
            let sum = self.indentation.plus(increment);
            if sum.total() != way.indentation {
                self.change_branch(model().borrow(), sum.total(), false)?;
            }
            self.indentation = sum;
        }
        let to = self.indentation();
        if presses {
            let leaves = to < path.lower;
            let time = if leaves { way.when(path.lower, end) } else { end };
            way.go_along(&path, smallest(time, end), if leaves { path.lower } else { to });
        }
        (way.time, way.indentation) = (end, to);
        Ok(())
    }
}
