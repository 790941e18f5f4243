//! The tangential state of a contact in two directions, and its step along one elastic curve.

use super::Way;
use super::cut::Cut;
use super::list::{Apex, List, Vertex};
use super::vector::{Vector, ZERO, add, difference, dot, length};
use crate::contact::numbers::smallest;
use crate::contact::path::Sum;
use crate::contact::segment::Segment;
use crate::contact::tangential::SAME;

/// The springs of a contact: the tangential displacement, and the polyline of their stuck offsets, of at most `N`
/// segments (sixteen are recommended, eight or more are allowed).
///
/// The methods take the elastic normal force over the indentation as `curve`, from the surface (its lower end). It has
/// to be the same in all calls until the contact separates. Its stiffness must not fall with the indentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stuck<const N: usize> {
    /// Scaled tangential displacement \[m\] since the first touch or since the whole contact last slipped.
    pub(super) displacement: [Sum; 2],
    pub(super) list: List<N>,
}

impl<const N: usize> Stuck<N> {
    /// No contact.
    pub const APART: Stuck<N> = Stuck { displacement: [Sum::new(0.0); 2], list: List::EMPTY };

    /// A contact that is pressed in without tangential displacement, at `indentation` \[m\].
    pub fn pressed(curve: &Segment, indentation: f64) -> Stuck<N> {
        let mut stuck = Stuck::APART;
        if indentation > curve.lower {
            stuck.list.add(Vertex::new(curve, curve.lower, ZERO, ZERO));
        }
        stuck
    }

    /// Number of segments of the polyline.
    pub fn segments(&self) -> usize {
        self.list.vertices().len()
    }

    /// Scaled displacement \[m\].
    fn displaced(&self) -> Vector {
        self.displacement.map(Sum::total)
    }

    /// Moves the contact on its way along `curve`.
    pub fn advance(&mut self, curve: &Segment, way: &Way) {
        if way.to <= curve.lower {
            *self = Stuck::APART;
            return;
        }
        if !way.moves() {
            return;
        }
        let is_new = self.list.vertices().is_empty();
        if is_new {
            *self = Stuck::pressed(curve, way.to);
        }
        // a contact that starts with an indentation already has springs
        let is_fresh = is_new && way.from <= curve.lower;
        let way = if is_fresh { way.above(curve.lower) } else { *way };
        let before = self.displaced();
        let [first, second] = self.displacement;
        let [shift, other_shift] = way.shift;
        self.displacement = [first.plus(shift), second.plus(other_shift)];
        if !way.sticks() {
            self.slip(curve, &way, before, is_fresh);
        } else if is_fresh {
            self.list.set_slope(way.slope());
        } else if way.to > way.from && self.turns(way.slope()) {
            let apex = Apex { indentation: way.from, displacement: before };
            self.list.push(curve, &apex, Vertex::new(curve, way.from, before, way.slope()));
        }
    }

    /// Whether the last segment has another slope than `slope`.
    fn turns(&self, slope: Vector) -> bool {
        self.list.last().is_none_or(|last| length(difference(last.slope, slope)) > SAME)
    }

    /// Moves all springs that leave the cone of the current point.
    fn slip(&mut self, curve: &Segment, way: &Way, before: Vector, is_fresh: bool) {
        let apex = Apex { indentation: way.to, displacement: self.displaced() };
        let lowest = self.list.vertices().first();
        let slides = is_fresh || lowest.is_none_or(|lowest| apex.excludes(lowest.height, lowest.offset));
        let mut cut = Cut::new(curve, way, before, apex);
        if is_fresh {
            cut.slipping(curve.lower);
        } else {
            let vertices = self.list.vertices();
            let ends = vertices.iter().skip(1).map(|next| (next.height, next.offset));
            for (vertex, end) in vertices.iter().zip(ends.chain(core::iter::once((way.from, before)))) {
                let height = smallest(end.0, way.to);
                cut.segment(vertex, if height < end.0 { (height, vertex.offset_at(height)) } else { end });
            }
            if way.to > way.from {
                cut.slipping(way.from);
            }
        }
        self.list = cut.left.into_list(curve, &apex);
        if slides {
            // from here on only the tension of the springs matters
            self.list.rebase(apex.displacement);
            self.displacement = [Sum::new(0.0); 2];
        }
    }

    /// Mean tangential force over a `way`, divided by the coefficient of friction \[N\], by Simpson's rule. The middle
    /// results from a step over half of the way.
    pub fn mean_pull(&self, curve: &Segment, way: &Way) -> [f64; 2] {
        let (mut middle, mut end) = (*self, *self);
        let half = way.first_part(0.5);
        middle.advance(curve, &half);
        end.advance(curve, way);
        let sum = add(self.pull(curve, way.from), 4.0, middle.pull(curve, half.to));
        add(sum, 1.0, end.pull(curve, way.to)).map(|pull| pull / 6.0)
    }

    /// The segments with the normal force \[N\] and the height \[m\] at their ends, for a contact at `indentation`
    /// \[m\].
    fn segments_with_ends(&self, curve: &Segment, indentation: f64) -> impl Iterator<Item = (&Vertex, f64, f64)> {
        let vertices = self.list.vertices();
        let ends = vertices.iter().skip(1).map(|next| (next.force, next.height));
        let all = vertices.iter().zip(ends.chain(core::iter::once((curve.force(indentation), indentation))));
        all.map(|(vertex, (force, height))| (vertex, force, height))
    }

    /// Tangential force at the current `indentation` \[m\], divided by the coefficient of friction \[N\]. It opposes
    /// the motion: a positive rate leads to a positive force.
    pub fn pull(&self, curve: &Segment, indentation: f64) -> [f64; 2] {
        let segments = self.segments_with_ends(curve, indentation);
        segments.fold(ZERO, |sum, (vertex, force, _)| add(sum, force - vertex.force, vertex.slope))
    }

    /// Stored tangential energy at `indentation` \[m\], times `kappa/mu` \[J\].
    pub fn energy(&self, curve: &Segment, indentation: f64) -> f64 {
        let displacement = self.displaced();
        let segments = self.segments_with_ends(curve, indentation);
        segments.fold(0.0, |sum, (vertex, force, height)| {
            // r {[w F] + r [int F dh]}, in a form without cancellation on a short segment
            let tension = difference(displacement, vertex.offset);
            let shortfall = (height - vertex.height) * (force - curve.mean_force(vertex.height, height));
            let pull = dot(vertex.slope, tension) * (force - vertex.force);
            sum + pull - dot(vertex.slope, vertex.slope) * shortfall
        })
    }
}
