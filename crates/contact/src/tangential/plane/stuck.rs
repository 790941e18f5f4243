//! The tangential state of a contact in two directions, and its step along one elastic curve.

use super::Way;
use super::cut::Cut;
use super::list::{Apex, List};
use super::vector::{Vector, ZERO, add, difference, dot, length};
use super::vertex::Vertex;
use crate::numbers::{largest, next_above, smallest};
use crate::path::Sum;
use crate::segment::Segment;
use crate::tangential::{self, SAME, Sliding};

/// Lowest height of springs that slip if none do \[m\].
const NONE: f64 = f64::MAX;

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
    /// Height of the lowest springs that slipped on the last way \[m\].
    pub(super) slips_from: f64,
}

impl<const N: usize> Stuck<N> {
    /// No contact.
    pub const APART: Stuck<N> = Stuck { displacement: [Sum::new(0.0); 2], list: List::EMPTY, slips_from: NONE };

    /// A contact that is pressed in without tangential displacement, at `indentation` \[m\].
    pub fn pressed(curve: &Segment, indentation: f64) -> Stuck<N> {
        let mut stuck = Stuck::APART;
        if indentation > curve.lower {
            stuck.list.add(Vertex::new(curve, curve.lower, ZERO, ZERO));
        }
        stuck
    }

    /// The springs of a contact that moves in the first direction only.
    pub(in crate::tangential) fn on_a_line<const PARTS: u32>(line: &tangential::Stuck<N, PARTS>) -> Stuck<N> {
        let mut stuck = Stuck { displacement: [line.displacement, Sum::new(0.0)], ..Stuck::APART };
        for &tangential::Vertex { height, offset, slope, force, .. } in line.list.vertices() {
            stuck.list.add(Vertex { height, offset: [offset, 0.0], slope: [slope, 0.0], force });
        }
        stuck
    }

    /// Scaled displacement \[m\].
    pub(super) fn displaced(&self) -> Vector {
        self.displacement.map(Sum::total)
    }

    /// Adds this `shift` \[m\] to the displacement.
    pub(super) fn displace(&mut self, shift: Vector) {
        for (sum, shift) in self.displacement.iter_mut().zip(shift) {
            *sum = sum.plus(shift);
        }
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
        self.displace(way.shift);
        if !way.sticks() {
            return self.slip(curve, &way, before, is_fresh);
        }
        self.slips_from = NONE;
        if is_fresh {
            self.list.set_slope(way.slope());
        } else if way.to > way.from && self.turns(way.slope()) {
            self.list.push(curve, Vertex::new(curve, way.from, before, way.slope()));
        }
    }

    /// Whether the last segment has another slope than `slope`.
    fn turns(&self, slope: Vector) -> bool {
        self.list.last().is_none_or(|last| length(difference(last.slope, slope)) > SAME)
    }

    /// Moves all springs that leave the cone of the current point.
    fn slip(&mut self, curve: &Segment, way: &Way, before: Vector, is_fresh: bool) {
        let apex = Apex { indentation: way.to, displacement: self.displaced() };
        let mut cut = Cut::new(curve, way, before, apex);
        if is_fresh {
            cut.touching(curve.lower);
        } else {
            let mut last = None;
            for (vertex, end) in self.segments_up_to((way.from, before)) {
                // unloading leaves no segment above the contact
                let height = smallest(end.0, way.to);
                let end = if height < end.0 { (height, vertex.offset_at(height)) } else { end };
                last = Some(cut.segment(vertex, last, end));
            }
            if way.to > way.from {
                cut.touching(way.from);
            }
        }
        self.take(cut, curve);
    }

    /// The segments with the height and offset of their ends \[m\]; the last one ends at `top`.
    pub(super) fn segments_up_to(&self, top: (f64, Vector)) -> impl Iterator<Item = (&Vertex, (f64, Vector))> {
        let vertices = self.list.vertices();
        let ends = vertices.iter().skip(1).map(|next| (next.height, next.offset));
        vertices.iter().zip(ends.chain(core::iter::once(top)))
    }

    /// Takes over the segments of `cut` on `curve`.
    pub(super) fn take(&mut self, cut: Cut<N>, curve: &Segment) {
        let lowest = cut.left.lowest();
        self.slips_from = match cut.slips_from {
            // springs above it stick
            Some(height) if cut.sticks && height <= lowest => next_above(lowest),
            Some(height) => height,
            None => NONE,
        };
        let indentation = cut.apex.indentation;
        self.list = cut.left.into_list(curve);
        if self.sliding() == Sliding::Sliding {
            // from here on only the tension of the springs matters
            self.list.rebase(indentation);
            self.displacement = [Sum::new(0.0); 2];
        }
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
        let energy = segments.fold(0.0, |sum, (vertex, force, height)| {
            // r {[w F] + r [int F dh]}, in a form without cancellation on a short segment
            let tension = difference(displacement, vertex.offset);
            let shortfall = (height - vertex.height) * (force - curve.mean_force(vertex.height, height));
            let pull = dot(vertex.slope, tension) * (force - vertex.force);
            sum + pull - dot(vertex.slope, vertex.slope) * shortfall
        });
        // relaxed springs have rounding errors of either sign
        largest(0.0, energy)
    }

    /// Slip state of the contact, from its last way.
    pub fn sliding(&self) -> Sliding {
        match self.list.vertices() {
            [] => Sliding::Apart,
            [lowest, ..] if self.slips_from <= lowest.height => Sliding::Sliding,
            _ if self.slips_from < NONE => Sliding::PartialSlip,
            _ => Sliding::Stick,
        }
    }

    /// Height \[m\] of the lowest springs that slipped on the last way; without slip, the `indentation` \[m\].
    pub fn edge(&self) -> Vector {
        self.list.last().map_or(ZERO, |last| last.slope)
    }

    /// Height \[m\] of the highest spring that sticks, for a contact at `indentation` \[m\].
    pub fn stick_height(&self, indentation: f64) -> f64 {
        smallest(self.slips_from, indentation)
    }

    /// Number of segments of the polyline.
    pub fn segments(&self) -> usize {
        self.list.vertices().len()
    }
}
