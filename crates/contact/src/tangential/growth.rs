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

use super::cut::{Cut, Point};
use super::list::Apex;
use super::vector::{add, difference, length};
use super::{Motion, Stuck, Vertex};
use crate::numbers::{largest, quotient, root};
use crate::segment::Segment;
use libm::ceil;

/// Parts of a path other than Hertz's curve whose images on a new path count as straight.
const PARTS: u32 = 4;

/// Whether `path` is Hertz's curve from its origin. The images of such paths are proportional to each other.
fn is_hertzian(path: &Segment) -> bool {
    path.square == 0.0 && path.linear == 0.0
}

/// The part of a step's way that does not pull a core as stiff as the straight path `new`: area that a dent gains evenly over
/// the step is pulled over half of the way. Where a dent begins, the path and its area jump at the start.
fn part_of_gain(old: &Segment, new: &Segment) -> f64 {
    let gain = largest(new.linear - old.linear, 0.0);
    let is_gradual = old.lower > 0.0 && old.power == 0.0 && old.square == 0.0;
    quotient(0.5 * gain, new.linear, is_gradual && new.linear > 0.0, 0.0)
}

/// Height \[m\] on `path` where its stiffness is `stiffness` \[N/m\], but not below the surface.
fn height_with(path: &Segment, stiffness: f64) -> f64 {
    let excess = stiffness - path.linear;
    // root of 2 c3 q^2 + 1.5 c2 q = excess, q = sqrt(z), in a form without cancellation
    let half = 1.5 * path.power;
    let divisor = half + root(half * half + 8.0 * path.square * excess);
    let q = quotient(2.0 * excess, divisor, excess > 0.0 && divisor > 0.0, 0.0);
    largest(path.origin + q * q, path.lower)
}

impl<const D: usize, const N: usize> Stuck<D, N> {
    /// Moves the contact on its `way` along the loading curve, while its dent grows: from the end of the `old` path
    /// to the end of the `new` one.
    ///
    /// Springs keep their places and offsets. Their limits change evenly over the way to those of the new path.
    pub fn grow(&mut self, old: &Segment, new: &Segment, way: &Motion<D>) {
        if self.list.vertices().is_empty() {
            *self = Stuck::pressed(old, way.to);
        }
        let before = self.displaced();
        let pull = self.pull(old, way.from);
        self.displace(way.shift);
        let apex = Apex { indentation: way.to, displacement: self.displaced() };
        let mut cut = Cut::new(new, way, before, apex);
        if new.power == 0.0 && new.square == 0.0 {
            // a straight path: all springs touch at once, and act as one with the mean tension
            let stiffness = largest(old.stiffness(way.from), new.linear);
            let length_of = |force: f64| quotient(force, stiffness, stiffness > 0.0, 0.0);
            let tension = add(pull.map(length_of), -part_of_gain(old, new), way.shift);
            let from = (new.lower, difference(before, tension));
            let from = cut.point(from, length_of(old.force(way.from)));
            let to = cut.point((way.to, apex.displacement), 0.0);
            cut.between(slope(&from, &to), &from, &to);
            return self.take(&mut cut, new);
        }
        let edge = self.map(&mut cut, old, new, (way.from, before));
        let rise = way.to - edge;
        if rise > 0.0 && length(way.shift) > rise {
            cut.touching(edge);
        } else if rise > 0.0 {
            let slope = way.shift.map(|shift| quotient(shift, rise, rise > 0.0, 0.0));
            cut.sticks = true;
            cut.left.extend(Vertex::new(new, edge, before, slope));
        }
        self.take(&mut cut, new);
    }

    /// Adds the segments up to `top` to `cut`, with their heights on the `new` path. Returns the height of the old edge.
    fn map(&self, cut: &mut Cut<D, N>, old: &Segment, new: &Segment, top: (f64, [f64; D])) -> f64 {
        let image = |height: f64| height_with(new, old.stiffness(height));
        let longest = (top.0 - old.lower) / f64::from(PARTS);
        let is_divided = longest > 0.0 && !(is_hertzian(old) && is_hertzian(new));
        let mut edge = new.lower;
        for (vertex, end) in self.segments_up_to(top) {
            let parts = ceil(quotient(end.0 - vertex.height, longest, is_divided, 1.0));
            let at =
                |cut: &Cut<D, N>, height: f64, offset: [f64; D]| cut.point((image(height), offset), top.0 - height);
            let mut from = at(cut, vertex.height, vertex.offset);
            let mut part = 1.0;
            while part < parts && part < f64::from(2 * PARTS) {
                let height = vertex.height + (end.0 - vertex.height) * (part / parts);
                let to = at(cut, height, vertex.offset_at(height));
                cut.between(slope(&from, &to), &from, &to);
                from = to;
                part += 1.0;
            }
            let to = at(cut, end.0, end.1);
            cut.between(slope(&from, &to), &from, &to);
            edge = image(end.0);
        }
        edge
    }
}

/// Slope of the straight line between two points.
fn slope<const D: usize>(from: &Point<D>, to: &Point<D>) -> [f64; D] {
    let rise = to.height - from.height;
    difference(to.before, from.before).map(|shift| quotient(shift, rise, rise > 0.0, 0.0))
}
