//! The springs of a growing dent.
//!
//! Springs keep their distance from the centre of the contact and their offsets. Their limits change: the limit of a
//! spring is its compression on the unloading path of the current dent. The distance `x = F'(h)/(2 E*)` identifies a
//! spring on a new path. New contact area is free of stress.
//!
//! A model of parallel springs is passive for any change of the limits. Coulomb's bound holds if the limits add up to
//! the normal force. The accuracy of a growth step depends on the paths. It is exact to rounding for Hertz's curve
//! with `x^2` linear in the largest indentation (`thornton`). It is lower if a straight line over the old heights is
//! curved over the new ones. There is no measured reference for friction on a contact that has yielded.

use super::cone::{Cone, Point};
use super::list::Draft;
use super::vertex::Vertex;
use super::{List, Stuck, Way};
use crate::numbers::{largest, quotient, root};
use crate::path::Sum;
use crate::segment::Segment;
use libm::{ceil, fabs};

/// Parts of a path other than Hertz's curve whose images on a new path count as straight.
pub(super) const PARTS: u32 = 4;

/// Longest such part \[m\] of a path that is `length` \[m\] long; infinite without parts.
pub(super) fn longest_part(parts: u32, length: f64) -> f64 {
    quotient(length, f64::from(parts), parts > 0, f64::INFINITY)
}

/// Whether `path` is Hertz's curve from its origin. The images of such paths are proportional to each other.
pub(super) fn is_hertzian(path: &Segment) -> bool {
    path.square == 0.0 && path.linear == 0.0
}

/// The part of a step's way that does not pull a core as stiff as the straight path `new`: area that a dent gains evenly over
/// the step is pulled over half of the way. Where a dent begins, the path and its area jump at the start.
pub(super) fn part_of_gain(old: &Segment, new: &Segment) -> f64 {
    let gain = largest(new.linear - old.linear, 0.0);
    let is_gradual = old.lower > 0.0 && old.power == 0.0 && old.square == 0.0;
    quotient(0.5 * gain, new.linear, is_gradual && new.linear > 0.0, 0.0)
}

/// Height \[m\] on `path` where its stiffness is `stiffness` \[N/m\], but not below the surface.
pub(super) fn height_with(path: &Segment, stiffness: f64) -> f64 {
    let excess = stiffness - path.linear;
    // root of 2 c3 q^2 + 1.5 c2 q = excess, q = sqrt(z), in a form without cancellation
    let half = 1.5 * path.power;
    let divisor = half + root(half * half + 8.0 * path.square * excess);
    let q = quotient(2.0 * excess, divisor, excess > 0.0 && divisor > 0.0, 0.0);
    largest(path.origin + q * q, path.lower)
}

impl<const N: usize, const PARTS: u32> Stuck<N, PARTS> {
    /// Moves the contact on its `way` along the loading curve, while its dent grows: from the end of the `old` path
    /// to the end of the `new` one.
    pub fn grow(&mut self, old: &Segment, new: &Segment, way: &Way) {
        if self.list.is_empty() {
            self.touch(old);
        }
        let before = self.displacement.total();
        let pull = self.pull(old, way.from);
        self.displacement = self.displacement.plus(way.shift);
        if new.power == 0.0 && new.square == 0.0 {
            let tension = pull / largest(old.stiffness(way.from), new.linear) - part_of_gain(old, new) * way.shift;
            return self.grow_core(new, tension, before, way);
        }
        let mut cut = Cut::new(new, way.to, self.displacement.total());
        let image = |(height, offset): Point| (height_with(new, old.stiffness(height)), offset);
        let parts = if is_hertzian(old) && is_hertzian(new) { 0 } else { PARTS };
        let longest = longest_part(parts, way.from - old.lower);
        let mut last = None;
        for (vertex, end) in self.segments_up_to((way.from, before)) {
            let start = (vertex.height, vertex.offset);
            let mut from = *last.get_or_insert(image(start));
            let parts = ceil(quotient(end.0 - start.0, longest, longest > 0.0, 1.0));
            let mut part = 1.0;
            while part < parts && part < f64::from(2 * PARTS) {
                let height = start.0 + (end.0 - start.0) * (part / parts);
                let to = image((height, vertex.offset_at(height)));
                cut.line(from, to);
                from = to;
                part += 1.0;
            }
            let to = image(end);
            cut.line(from, to);
            last = Some(to);
        }
        cut.line(last.unwrap_or((new.lower, before)), (way.to, self.displacement.total()));
        self.take(cut, new, way.to);
    }

    /// The same for a straight path. All springs touch at once, and act as one with the mean `tension` \[m\]
    /// they would have if the whole area had been there `before` \[m\] the step.
    fn grow_core(&mut self, path: &Segment, tension: f64, before: f64, way: &Way) {
        let offset = before - tension;
        let mut cut = Cut::new(path, way.to, self.displacement.total());
        cut.line((path.lower, offset), (way.to, self.displacement.total()));
        self.take(cut, path, way.to);
    }

    /// Whether no segment of the polyline is steeper than a cone.
    pub fn is_within_cones(&self) -> bool {
        self.list.is_within_cones()
    }

    /// Moves the contact on its `way` along `curve`, the path of its dent. Like [`Stuck::advance`], but for a
    /// polyline that may be steeper than the cones: it cuts every segment.
    pub fn settle(&mut self, curve: &Segment, way: &Way) {
        if self.is_within_cones() || way.to <= curve.lower || !way.moves() {
            return self.advance(curve, way);
        }
        let before = self.displacement.total();
        self.displacement = self.displacement.plus(way.shift);
        let mut cut = Cut::new(curve, way.to, self.displacement.total());
        for (vertex, end) in self.segments_up_to((way.from, before)) {
            cut.segment((vertex.height, vertex.offset), end, vertex.slope);
        }
        cut.line((way.from, before), (way.to, self.displacement.total()));
        self.take(cut, curve, way.to);
    }

    /// The segments with their ends; the last one ends at `top`.
    fn segments_up_to(&self, top: Point) -> impl Iterator<Item = (&Vertex, Point)> {
        let vertices = self.list.vertices();
        let ends = vertices.iter().skip(1).map(|next| (next.height, next.offset));
        vertices.iter().zip(ends.chain(core::iter::once(top)))
    }

    /// Takes over the segments that `cut` has kept on `curve`, up to `indentation` \[m\].
    fn take(&mut self, cut: Cut<N>, curve: &Segment, indentation: f64) {
        self.list = cut.left.into_list(curve, &cut.cone);
        if let [only] = self.list.vertices()
            && fabs(only.slope) == 1.0
        {
            // from here on only the direction of sliding matters
            let only = Vertex { offset: -only.slope * (indentation - only.height), ..*only };
            self.displacement = Sum::new(0.0);
            self.list = List::EMPTY;
            self.list.push(curve, only);
        }
    }
}

/// The part of a polyline that the cone of a point keeps, segment by segment from the lowest one.
struct Cut<'a, const N: usize> {
    curve: &'a Segment,
    cone: Cone,
    left: Draft<N>,
}

impl<const N: usize> Cut<'_, N> {
    fn new(curve: &Segment, indentation: f64, displacement: f64) -> Cut<'_, N> {
        Cut { curve, cone: Cone { displacement, indentation }, left: Draft::EMPTY }
    }

    /// Adds the segment between two points.
    fn line(&mut self, from: Point, to: Point) {
        let rise = to.0 - from.0;
        if rise > 0.0 {
            self.segment(from, to, quotient(to.1 - from.1, rise, rise > 0.0, 0.0));
        }
    }

    /// Adds the part below the present indentation of a segment of this `slope` between two points.
    fn segment(&mut self, from: Point, to: Point, slope: f64) {
        let to = if to.0 > self.cone.indentation {
            (self.cone.indentation, from.1 + slope * (self.cone.indentation - from.0))
        } else {
            to
        };
        if to.0 > from.0 {
            let sides = [1.0, -1.0].map(|sign| (sign, self.cone.distance(sign, from), self.cone.distance(sign, to)));
            let [first, second] = sides.map(|(_, start, end)| self.crossing(start, end));
            let (low, high) = if first < second { (first, second) } else { (second, first) };
            for (start, end) in [(0.0, low), (low, high), (high, 1.0)] {
                if end > start {
                    self.part((from, to), slope, (start, end), sides);
                }
            }
        }
    }

    /// Adds one part of a segment; the part is entirely inside or entirely outside the cone. Of both `sides` of the cone it has
    /// the sign and the distances of the ends of the segment.
    ///
    /// Between the ends, distances are interpolated. A segment may be so short that there is no number between its heights.
    fn part(&mut self, (from, to): (Point, Point), slope: f64, (start, end): (f64, f64), sides: [(f64, f64, f64); 2]) {
        let height = from.0 + start * (to.0 - from.0);
        let (mut offset, mut kept) = (from.1 + start * (to.1 - from.1), slope);
        for (sign, at_start, at_end) in sides {
            let middle = at_start + 0.5 * (start + end) * (at_end - at_start);
            if self.cone.is_outside(middle) {
                (offset, kept) = (self.cone.displacement - sign * (self.cone.indentation - height), sign);
            }
        }
        self.left.extend(self.curve, &self.cone, Vertex::new(self.curve, height, offset, kept));
    }

    /// Where a segment crosses one side of the cone, as a fraction of its length; 1 without a crossing. Its ends have these
    /// distances from the side.
    fn crossing(&self, start: f64, end: f64) -> f64 {
        let crosses = self.cone.is_outside(start) != self.cone.is_outside(end);
        let part = quotient(start, start - end, crosses && start != end, 1.0);
        if part > 0.0 && part < 1.0 { part } else { 1.0 }
    }
}
