//! Cuts a polyline with the cone of a new point.

use super::list::{Apex, Draft, Vertex};
use super::pursuit::Spring;
use super::vector::{Vector, add, difference, dot, length, times};
use super::{BEND, NEAR, Way};
use crate::contact::numbers::{quotient, root};
use crate::contact::segment::Segment;

/// Crossings closer to an end of a segment than this part of it are left out.
const AT_END: f64 = 1e-12;

/// Height and offset of a point of the polyline \[m\].
type Point = (f64, Vector);

/// A polyline that is cut after a way.
pub(super) struct Cut<'a, const N: usize> {
    curve: &'a Segment,
    way: &'a Way,
    /// Displacement at the start of the way \[m\].
    before: Vector,
    /// Direction of the way.
    direction: Vector,
    apex: Apex,
    /// The result.
    pub left: Draft<N>,
}

impl<'a, const N: usize> Cut<'a, N> {
    /// Nothing yet is left of a polyline, for a `way` that starts at the displacement `before` and ends at `apex`.
    pub(super) fn new(curve: &'a Segment, way: &'a Way, before: Vector, apex: Apex) -> Self {
        Cut { curve, way, before, direction: way.direction(), apex, left: Draft::EMPTY }
    }

    /// Adds the segment from `vertex` to `end`; it ends below the present indentation.
    pub(super) fn segment(&mut self, vertex: &Vertex, end: Point) {
        let rise = end.0 - vertex.height;
        if rise <= 0.0 {
            return;
        }
        let [low, high] = self.crossings(vertex, rise);
        for (start, stop) in [(0.0, low), (low, high), (high, 1.0)] {
            if stop > start {
                let at = |part: f64| {
                    if part >= 1.0 {
                        return end;
                    }
                    let height = vertex.height + part * rise;
                    (height, vertex.offset_at(height))
                };
                self.part(vertex.slope, at(start), at(stop));
            }
        }
    }

    /// Adds the springs that touch and slip on the way, from the indentation `from` \[m\] on.
    pub(super) fn slipping(&mut self, from: f64) {
        let offset = add(self.apex.displacement, from - self.apex.indentation, self.direction);
        let vertex = Vertex::new(self.curve, from, offset, self.direction);
        self.left.extend(vertex, self.apex.indentation, self.near());
    }

    fn near(&self) -> f64 {
        NEAR * self.apex.indentation
    }

    /// Adds one part of a segment of this `slope`; the part is entirely inside or entirely outside the cone.
    fn part(&mut self, slope: Vector, from: Point, to: Point) {
        let middle = (0.5 * (from.0 + to.0), times(0.5, add(from.1, 1.0, to.1)));
        if !self.apex.excludes(middle.0, middle.1) {
            let ends = [from, to].map(|point| (point.0, self.moved(point)));
            if ends != [from, to] {
                let [start, end] = ends;
                return self.line(start, end);
            }
            let vertex = Vertex::new(self.curve, from.0, from.1, slope);
            return self.left.extend(vertex, to.0, self.near());
        }
        let [start, between, end] = [from, middle, to].map(|point| (point.0, self.moved(point)));
        let straight = times(0.5, add(start.1, 1.0, end.1));
        let turns = length(difference(between.1, straight)) > BEND * (self.apex.indentation - self.curve.lower);
        if turns {
            self.line(start, between);
            self.line(between, end);
        } else {
            self.line(start, end);
        }
    }

    /// Adds the segment between two points.
    fn line(&mut self, from: Point, to: Point) {
        let rise = to.0 - from.0;
        let slope = difference(to.1, from.1).map(|shift| quotient(shift, rise, rise > 0.0, 0.0));
        if rise > 0.0 {
            self.left.extend(Vertex::new(self.curve, from.0, from.1, slope), to.0, self.near());
        }
    }

    /// The offset after the way of the springs at a point \[m\].
    fn moved(&self, (height, offset): Point) -> Vector {
        if !self.apex.excludes(height, offset) {
            return offset;
        }
        let spring = Spring {
            tension: difference(self.before, offset),
            limit: self.way.from - height,
            end_limit: self.apex.indentation - height,
        };
        difference(self.apex.displacement, spring.moved(self.way.shift, self.direction))
    }

    /// Where the segment of `vertex`, of this `rise` \[m\], crosses the cone, as fractions of its length in ascending
    /// order; 1 without a crossing. The roots of `|tension - t shift|^2 = (limit - t rise)^2`.
    fn crossings(&self, vertex: &Vertex, rise: f64) -> [f64; 2] {
        let (tension, limit) =
            (difference(self.apex.displacement, vertex.offset), self.apex.indentation - vertex.height);
        let shift = times(rise, vertex.slope);
        let (way, size) = (length(shift), length(tension));
        let square = (way - rise) * (way + rise);
        let half = limit * rise - dot(tension, shift);
        let constant = (size - limit) * (size + limit);
        let discriminant = half * half - square * constant;
        let q = -(half + if half >= 0.0 { root(discriminant) } else { -root(discriminant) });
        let inside = |dividend: f64, divisor: f64| {
            let (dividend, divisor) = if divisor < 0.0 { (-dividend, -divisor) } else { (dividend, divisor) };
            let is_inside = discriminant > 0.0 && dividend > AT_END * divisor && dividend < (1.0 - AT_END) * divisor;
            quotient(dividend, divisor, is_inside, 1.0)
        };
        let (one, other) = (inside(q, square), inside(constant, q));
        if one < other { [one, other] } else { [other, one] }
    }
}
