//! The mean tangential force over a step.

use super::vector::{ZERO, add, times};
use super::{Stuck, Way};
use crate::contact::segment::Segment;

impl<const N: usize> Stuck<N> {
    /// Mean tangential force over a `way`, divided by the coefficient of friction \[N\], by Simpson's rule over the part of
    /// the way in contact. The middle results from a step over half of it.
    pub fn mean_pull(&self, curve: &Segment, way: &Way) -> [f64; 2] {
        if way.from <= curve.lower && way.to <= curve.lower {
            return ZERO;
        }
        let part = way.part_above(curve.lower);
        let inside = if way.to < curve.lower { way.first_part(part) } else { way.above(curve.lower) };
        let start = if self.list.vertices().is_empty() { Stuck::pressed(curve, inside.from) } else { *self };
        let (mut middle, mut end) = (*self, *self);
        let half = inside.first_part(0.5);
        middle.advance(curve, &half);
        end.advance(curve, &inside);
        let sum = add(start.pull(curve, inside.from), 4.0, middle.pull(curve, half.to));
        times(part / 6.0, add(sum, 1.0, end.pull(curve, inside.to)))
    }
}
