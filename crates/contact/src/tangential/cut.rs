//! Moves a polyline on a way that ends outside the cones of some of its springs.

use super::list::{Apex, Draft};
use super::merge::Merging;
use super::pursuit::Spring;
use super::vector::{across, add, difference, dot, length, times};
use super::vertex::Vertex;
use super::{Motion, SAME, TINY};
use crate::numerics::{largest, quotient, root, smallest};
use crate::segment::Segment;

/// A distance smaller than this part of another one is zero.
const NEAR: f64 = 1e-12;

/// A part of a segment whose springs slip gets a vertex in its middle if the tangential force would else be off by about more
/// than this part of Coulomb's limit.
const BEND: f64 = 1e-4;

/// Such a part also gets one if its springs turn, and its length times the difference of its stiffnesses is more than this
/// part of the force. Springs are then close enough whenever they turn, in however small steps.
const SPACING: f64 = 1e-2;

/// How often a part of a segment may be halved.
const HALVINGS: u32 = 6;

/// Height and offset of a point of the polyline \[m\].
pub(super) type Place<const D: usize> = (f64, [f64; D]);

/// A point of the polyline before and after the way.
#[derive(Clone, Copy)]
pub(super) struct Point<const D: usize> {
    /// \[m\]
    pub height: f64,
    /// Largest tension of the springs before the way \[m\].
    limit: f64,
    /// Stuck offset before the way \[m\].
    pub before: [f64; D],
    /// Stuck offset after the way \[m\].
    after: [f64; D],
    /// Whether the springs at the point slip, at least in the end.
    slips: bool,
    /// Their tension then along the way \[m\], if it has no other component; negative against the way, where limits fall faster
    /// than the motion relaxes the springs.
    aligned: Option<f64>,
}

/// A polyline that follows a way.
pub(super) struct Cut<'a, const D: usize, const N: usize> {
    curve: &'a Segment,
    way: &'a Motion<D>,
    /// Displacement at the start of the way \[m\].
    start: [f64; D],
    /// Direction of the way.
    direction: [f64; D],
    /// The end of the way.
    pub apex: Apex<D>,
    /// Force at the end of the way \[N\].
    force: f64,
    /// How excess segments are merged.
    pub merging: Merging,
    /// The result.
    pub left: Draft<D, N>,
    /// Height of the lowest springs that slip \[m\].
    pub slips_from: Option<f64>,
    /// Whether some springs don't.
    pub sticks: bool,
}

impl<'a, const D: usize, const N: usize> Cut<'a, D, N> {
    /// Nothing yet of a polyline, for a `way` from the displacement `start` to `apex`.
    pub(super) fn new(curve: &'a Segment, way: &'a Motion<D>, start: [f64; D], apex: Apex<D>) -> Self {
        let force = curve.force(apex.indentation);
        Cut {
            curve,
            way,
            start,
            direction: way.direction(),
            apex,
            force,
            merging: Merging::Halfway,
            left: Draft::EMPTY,
            slips_from: None,
            sticks: false,
        }
    }

    /// Adds the segment of this `vertex` up to the point `end`, which is not above the contact. `start` is the point at the
    /// vertex, if it is known. Returns that at the end.
    pub(super) fn segment(&mut self, vertex: &Vertex<D>, start: Option<Point<D>>, end: Place<D>) -> Point<D> {
        let from = match start {
            Some(point) => point,
            None => self.point((vertex.height, vertex.offset), self.way.from - vertex.height),
        };
        let to = self.point(end, self.way.from - end.0);
        self.between(vertex.slope, &from, &to);
        to
    }

    /// Adds the segment of this `slope` between two points, up to the indentation: a dent that grows may become narrower.
    pub(super) fn between(&mut self, slope: [f64; D], from: &Point<D>, to: &Point<D>) {
        let height = smallest(to.height, self.apex.indentation);
        if height <= from.height {
            return;
        }
        let end = if height < to.height { self.on_segment(slope, (from, to), height) } else { *to };
        let middle = self.farthest_inside(slope, from, &end).map(|height| self.on_segment(slope, (from, to), height));
        match middle.filter(|middle| !middle.slips) {
            Some(middle) => {
                self.part(slope, from, &middle);
                self.part(slope, &middle, &end);
            }
            None => self.part(slope, from, &end),
        }
    }

    /// Adds a segment of this `slope` that crosses the cone at most once.
    fn part(&mut self, slope: [f64; D], from: &Point<D>, to: &Point<D>) {
        match (from.slips, to.slips) {
            (false, false) => self.stick(slope, from, to),
            (false, true) => {
                let front = self.front(slope, from, to);
                self.stick(slope, from, &front);
                self.slip(&front, to, HALVINGS);
            }
            (true, false) => {
                let front = self.front(slope, to, from);
                self.slip(from, &front, HALVINGS);
                self.stick(slope, &front, to);
            }
            (true, true) => self.slip(from, to, HALVINGS),
        }
    }

    /// Adds the springs that touch and slip on the way, from the indentation `from` \[m\] on.
    pub(super) fn touching(&mut self, from: f64) {
        let offset = add(self.apex.displacement, from - self.apex.indentation, self.direction);
        self.slips_from.get_or_insert(from);
        self.left.extend(Vertex::new(self.curve, from, offset, self.direction));
    }

    /// The point at this height and offset \[m\], whose springs had this `limit` before the way \[m\].
    pub(super) fn point(&self, (height, before): Place<D>, limit: f64) -> Point<D> {
        let slips = self.apex.distance(height, before) <= SAME * self.apex.indentation;
        let mut point = Point { height, limit, before, after: before, slips, aligned: None };
        if slips {
            let spring = Spring {
                tension: difference(self.start, before),
                limit: largest(limit, 0.0),
                end_limit: largest(self.apex.indentation - height, 0.0),
            };
            let tension = spring.moved(self.way.shift, self.direction);
            point.after = difference(self.apex.displacement, tension);
            point.aligned = self.aligned(tension);
        }
        point
    }

    /// The size of a `tension` \[m\] along the way, if it has no other component.
    fn aligned(&self, tension: [f64; D]) -> Option<f64> {
        let is_aligned = across(tension, self.direction) <= SAME * self.apex.indentation;
        is_aligned.then_some(dot(tension, self.direction))
    }

    /// The point at this `height` \[m\] of a segment of this `slope` between two points.
    fn on_segment(&self, slope: [f64; D], (from, to): (&Point<D>, &Point<D>), height: f64) -> Point<D> {
        let (rise, whole) = (height - from.height, to.height - from.height);
        let part = quotient(rise, whole, whole > 0.0, 1.0);
        self.point((height, add(from.before, rise, slope)), from.limit + part * (to.limit - from.limit))
    }

    /// Height \[m\] on a segment of this `slope` where springs are farthest inside their limits, if those at both ends slip. Only a
    /// segment that is steeper than the cone can cross it twice: on a dent that has grown.
    fn farthest_inside(&self, slope: [f64; D], from: &Point<D>, to: &Point<D>) -> Option<f64> {
        let square = dot(slope, slope) - 1.0;
        if !(from.slips && to.slips && square > 0.0) {
            return None;
        }
        let tension = difference(self.apex.displacement, from.before);
        let half = dot(tension, slope) - (self.apex.indentation - from.height);
        let height = from.height + quotient(half, square, half < square * (to.height - from.height), 0.0);
        (height > from.height && height < to.height).then_some(height)
    }

    /// The point on a segment of this `slope` between `stuck` springs and slipping ones that just reaches its limit.
    fn front(&self, slope: [f64; D], stuck: &Point<D>, slipping: &Point<D>) -> Point<D> {
        let rise = slipping.height - stuck.height;
        let part = self.crossing(stuck, slope, rise);
        let before = add(stuck.before, part * rise, slope);
        let aligned = self.aligned(difference(self.apex.displacement, before));
        let limit = stuck.limit + part * (slipping.limit - stuck.limit);
        Point { height: stuck.height + part * rise, limit, before, after: before, slips: true, aligned }
    }

    /// Where a segment of this `slope` leaves the cone, on its way from the `stuck` point over `rise` \[m\], as a part of
    /// this way: the first positive root of `|tension - t shift| = limit - t rise`.
    fn crossing(&self, stuck: &Point<D>, slope: [f64; D], rise: f64) -> f64 {
        let tension = difference(self.apex.displacement, stuck.before);
        let limit = self.apex.indentation - stuck.height;
        let shift = times(rise, slope);
        let (way, size) = (length(shift), length(tension));
        // square t^2 + 2 half t + constant = 0, and constant <= 0 inside the cone
        let (square, inside) = ((way - rise) * (way + rise), largest(limit - size, 0.0));
        let constant = -inside * (limit + size);
        let (scalar, across) = (dot(tension, shift), across(tension, shift));
        // size way - scalar, and limit rise - scalar, without cancellation
        let sum = size * way + scalar;
        let behind = if scalar > 0.0 { quotient(across * across, sum, sum > 0.0, 0.0) } else { size * way - scalar };
        let half = inside * rise + size * (rise - way) + behind;
        // half^2 - square constant, in the form with less cancellation
        let along = length(add(times(limit, shift), -rise, tension));
        let product = square * constant;
        let discriminant =
            root(if product < 0.5 * half * half { half * half - product } else { (along - across) * (along + across) });
        let part = if half > 0.0 {
            quotient(-constant, half + discriminant, half + discriminant > 0.0, 0.0)
        } else {
            quotient(discriminant - half, square, discriminant - half < square, 1.0)
        };
        smallest(largest(part, 0.0), 1.0)
    }

    /// Adds a part of a segment that is straight in the end.
    fn line(&mut self, slope: [f64; D], from: &Point<D>, to: &Point<D>) {
        if to.height > from.height {
            self.left.extend(Vertex::new(self.curve, from.height, from.after, slope));
        }
    }

    /// Adds a part of a segment whose springs stick.
    pub(super) fn stick(&mut self, slope: [f64; D], from: &Point<D>, to: &Point<D>) {
        self.sticks |= to.height > from.height;
        self.line(slope, from, to);
    }

    /// Adds a part of a segment whose springs slip. It is halved where its springs turn and it is long, or its middle is
    /// off the straight line.
    fn slip(&mut self, from: &Point<D>, to: &Point<D>, halvings: u32) {
        let rise = to.height - from.height;
        if rise <= 0.0 {
            return;
        }
        self.slips_from.get_or_insert(from.height);
        if let (Some(one), Some(other)) = (from.aligned, to.aligned)
            && one * other >= 0.0
        {
            let sign = if one + other >= 0.0 { 1.0 } else { -1.0 };
            return self.line(times(sign, self.direction), from, to);
        }
        if halvings > 0 && self.left.has_room() {
            let place = (0.5 * (from.height + to.height), times(0.5, add(from.before, 1.0, to.before)));
            let middle = self.point(place, 0.5 * (from.limit + to.limit));
            let bend = length(difference(middle.after, times(0.5, add(from.after, 1.0, to.after))));
            let stiffening = self.curve.stiffness(to.height) - self.curve.stiffness(from.height);
            let is_bent = bend * stiffening > BEND * self.force;
            let near = if self.merging == Merging::Halfway { NEAR } else { TINY };
            if is_bent || bend > near * self.apex.indentation && rise * stiffening > SPACING * self.force {
                self.slip(from, &middle, halvings - 1);
                return self.slip(&middle, to, halvings - 1);
            }
        }
        let slope = difference(to.after, from.after).map(|shift| quotient(shift, rise, rise > 0.0, 0.0));
        self.line(slope, from, to);
    }
}
