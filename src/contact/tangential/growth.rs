//! The springs of a dent that grows.
//!
//! Springs keep their distance from the middle of the contact and their offsets. What changes is how far each may be strained:
//! its limit is the compression that it has on the unloading path of the present dent. A spring is therefore found on a new path
//! by its distance `x = F'(h)/(2 E*)`, and area that the contact gains is free of stress at first.
//!
//! A model of parallel springs whose limits change in any way is passive, and Coulomb's bound holds as long as the limits add
//! up to the normal force. How exact a growth step is depends on the paths: to rounding if they are Hertz's curve with `x^2`
//! linear in the largest indentation (`thornton`), and less where the line in the old heights is none in the new ones.
//! There is no measured reference for friction on a contact that has yielded.

use super::list::{Draft, Vertex};
use super::{List, SAME, Stuck, Way};
use crate::contact::numbers::{largest, quotient, root};
use crate::contact::path::Sum;
use crate::contact::segment::Segment;
use libm::{ceil, fabs};

/// The longest part of a path that isn't Hertz's whose image on a new path counts as a line, in lengths of the path.
const LONGEST: f64 = 0.25;

/// Height and offset of a point of the polyline \[m\].
type Point = (f64, f64);

/// Whether `path` is Hertz's curve from its origin on. Such paths have images of each other that are proportional.
fn is_hertzian(path: &Segment) -> bool {
    path.square == 0.0 && path.linear == 0.0
}

/// The height on `path` \[m\] where its stiffness is `stiffness` \[N/m\], but not below the surface.
fn height_with(path: &Segment, stiffness: f64) -> f64 {
    let excess = stiffness - path.linear;
    // the root of 2 c3 q^2 + 1.5 c2 q = excess, q = sqrt(z), in the form that doesn't cancel
    let half = 1.5 * path.power;
    let divisor = half + root(half * half + 8.0 * path.square * excess);
    let q = quotient(2.0 * excess, divisor, excess > 0.0 && divisor > 0.0, 0.0);
    largest(path.origin + q * q, path.lower)
}

impl<const N: usize> Stuck<N> {
    /// Moves the contact on its `way` along the loading curve, on which its dent grows: from where the `old` path ends to where the
    /// `new` one does.
    pub fn grow(&mut self, old: &Segment, new: &Segment, way: &Way) {
        if self.list.is_empty() {
            self.touch(old);
        }
        let before = self.displacement.total();
        let pull = self.pull(old, way.from);
        self.displacement = self.displacement.plus(way.shift);
        if new.power == 0.0 && new.square == 0.0 {
            return self.grow_core(new, pull / largest(old.stiffness(way.from), new.linear), before, way);
        }
        let mut cut = Cut::new(new, way.to, self.displacement.total());
        let image = |(height, offset): Point| (height_with(new, old.stiffness(height)), offset);
        let longest =
            if is_hertzian(old) && is_hertzian(new) { f64::INFINITY } else { LONGEST * (way.from - old.lower) };
        let mut last = None;
        for (vertex, end) in self.segments_up_to((way.from, before)) {
            let start = (vertex.height, vertex.offset);
            let mut from = *last.get_or_insert(image(start));
            let parts = ceil(quotient(end.0 - start.0, longest, longest > 0.0, 1.0));
            let mut part = 1.0;
            while part < parts && part < 2.0 / LONGEST {
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

    /// The same for a straight path, on which all springs touch together. They are then one, of the mean `tension` \[m\] `before` \[m\]
    /// the step.
    fn grow_core(&mut self, path: &Segment, tension: f64, before: f64, way: &Way) {
        let offset = before - tension;
        let mut cut = Cut::new(path, way.to, self.displacement.total());
        cut.line((path.lower, offset), (way.to, self.displacement.total()));
        self.take(cut, path, way.to);
    }

    /// Whether no part of the polyline is steeper than a cone.
    pub fn is_within_cones(&self) -> bool {
        self.list.is_within_cones()
    }

    /// Moves the contact on its `way` along `curve`, the path of its dent. It does what [`Stuck::advance`] does, for a polyline that
    /// may be steeper than the cones: every segment is cut.
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

    /// The segments with their ends; the last one ends in `top`.
    fn segments_up_to(&self, top: Point) -> impl Iterator<Item = (&Vertex, Point)> {
        let vertices = self.list.vertices();
        let ends = vertices.iter().skip(1).map(|next| (next.height, next.offset));
        vertices.iter().zip(ends.chain(core::iter::once(top)))
    }

    /// Takes what `cut` has left on `curve`, up to `indentation` \[m\].
    fn take(&mut self, cut: Cut<N>, curve: &Segment, indentation: f64) {
        self.list = cut.left.into_list(curve);
        if let [only] = self.list.vertices()
            && fabs(only.slope) == 1.0
        {
            // only the direction of sliding matters from here on
            let only = Vertex { offset: -only.slope * (indentation - only.height), ..*only };
            self.displacement = Sum::new(0.0);
            self.list = List::EMPTY;
            self.list.push(curve, only);
        }
    }
}

/// What the cone of a point leaves of a polyline, segment by segment from the lowest on.
struct Cut<'a, const N: usize> {
    curve: &'a Segment,
    indentation: f64,
    displacement: f64,
    left: Draft<N>,
}

impl<const N: usize> Cut<'_, N> {
    fn new(curve: &Segment, indentation: f64, displacement: f64) -> Cut<'_, N> {
        Cut { curve, indentation, displacement, left: Draft::EMPTY }
    }

    /// Adds the segment between two points.
    fn line(&mut self, from: Point, to: Point) {
        let rise = to.0 - from.0;
        if rise > 0.0 {
            self.segment(from, to, quotient(to.1 - from.1, rise, rise > 0.0, 0.0));
        }
    }

    /// Adds the segment of this `slope` between two points: what of it is below the present indentation.
    fn segment(&mut self, from: Point, to: Point, slope: f64) {
        let to =
            if to.0 > self.indentation { (self.indentation, from.1 + slope * (self.indentation - from.0)) } else { to };
        if to.0 > from.0 {
            let [first, second] = [1.0, -1.0].map(|sign| self.crossing(sign, from, to));
            let (low, high) = if first < second { (first, second) } else { (second, first) };
            for (start, end) in [(0.0, low), (low, high), (high, 1.0)] {
                if end > start {
                    self.part(from, to, slope, (start, end));
                }
            }
        }
    }

    /// Adds one part of a segment, which is either inside of the cone or outside.
    fn part(&mut self, from: Point, to: Point, slope: f64, (start, end): (f64, f64)) {
        let rise = to.0 - from.0;
        let height = from.0 + start * rise;
        let (mut offset, mut kept) = (from.1 + slope * (height - from.0), slope);
        let middle = from.0 + 0.5 * (start + end) * rise;
        for sign in [1.0, -1.0] {
            if self.is_outside(self.distance(sign, (middle, from.1 + slope * (middle - from.0)))) {
                (offset, kept) = (self.displacement - sign * (self.indentation - height), sign);
            }
        }
        self.left.extend(self.curve, Vertex::new(self.curve, height, offset, kept));
    }

    /// How far a point is inside of one side of the cone \[m\].
    fn distance(&self, sign: f64, (height, offset): Point) -> f64 {
        sign * (offset - self.displacement) + self.indentation - height
    }

    fn is_outside(&self, distance: f64) -> bool {
        distance < -SAME * self.indentation
    }

    /// Where a segment crosses one side of the cone, as a part of it; 1 if it doesn't.
    fn crossing(&self, sign: f64, from: Point, to: Point) -> f64 {
        let (start, end) = (self.distance(sign, from), self.distance(sign, to));
        let crosses = self.is_outside(start) != self.is_outside(end);
        let part = quotient(start, start - end, crosses && start != end, 1.0);
        if part > 0.0 && part < 1.0 { part } else { 1.0 }
    }
}
