//! The springs of a growing dent in two directions: see [one direction](super::super::growth).

use super::cut::Cut;
use super::list::Apex;
use super::vector::{Vector, difference, length};
use super::vertex::Vertex;
use super::{Stuck, Way};
use crate::numbers::{largest, quotient};
use crate::segment::Segment;
use crate::tangential::growth::{PARTS, height_with, is_hertzian, longest_part, part_of_gain};
use libm::ceil;

impl<const N: usize> Stuck<N> {
    /// Moves the contact on its `way` along the loading curve, while its dent grows: from the end of the `old` path
    /// to the end of the `new` one.
    ///
    /// Springs keep their places and offsets. Their limits change evenly over the way to those of the new path.
    pub fn grow(&mut self, old: &Segment, new: &Segment, way: &Way) {
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
            let part = part_of_gain(old, new);
            let [one, other] = pull.map(length_of);
            let [shift, other_shift] = way.shift;
            let tension = [one - part * shift, other - part * other_shift];
            let from = (new.lower, difference(before, tension));
            let from = cut.point(from, length_of(old.force(way.from)));
            let to = cut.point((way.to, apex.displacement), 0.0);
            cut.between(slope(&from, &to), &from, &to);
            return self.take(cut, new);
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
        self.take(cut, new);
    }

    /// Adds the segments up to `top` to `cut`, with their heights on the `new` path. Returns the height of the old edge.
    fn map(&self, cut: &mut Cut<N>, old: &Segment, new: &Segment, top: (f64, Vector)) -> f64 {
        let image = |height: f64| height_with(new, old.stiffness(height));
        let parts = if is_hertzian(old) && is_hertzian(new) { 0 } else { PARTS };
        let longest = longest_part(parts, top.0 - old.lower);
        let mut edge = new.lower;
        for (vertex, end) in self.segments_up_to(top) {
            let parts = ceil(quotient(end.0 - vertex.height, longest, longest > 0.0, 1.0));
            let at = |cut: &Cut<N>, height: f64, offset: Vector| cut.point((image(height), offset), top.0 - height);
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
fn slope(from: &super::cut::Point, to: &super::cut::Point) -> Vector {
    let rise = to.height - from.height;
    difference(to.before, from.before).map(|shift| quotient(shift, rise, rise > 0.0, 0.0))
}
