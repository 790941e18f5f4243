//! The stuck offsets of a contact as a polyline of bounded length.

use super::merge::{Merging, merge};
use super::vector::{add, difference, length, times};
use super::vertex::Vertex;
use super::{SAME, TINY};
use crate::numerics::quotient;
use crate::segment::Segment;

/// The current point: indentation and scaled tangential displacement \[m\]. It is the apex of the cone of all springs
/// that can stick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Apex<const D: usize> {
    pub indentation: f64,
    pub displacement: [f64; D],
}

impl<const D: usize> Apex<D> {
    /// How much a spring at `height` with this `offset` \[m\] is inside its limit \[m\]; negative outside.
    pub(super) fn distance(&self, height: f64, offset: [f64; D]) -> f64 {
        self.indentation - height - length(difference(self.displacement, offset))
    }
}

/// A polyline of at most `N` segments, from the lowest height to the highest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct List<const D: usize, const N: usize> {
    count: usize,
    vertices: [Vertex<D>; N],
}

impl<const D: usize, const N: usize> List<D, N> {
    /// No contact.
    pub const EMPTY: Self = {
        // a draft then has room for all parts of all segments
        assert!(N >= 8);
        List { count: 0, vertices: [Vertex::NONE; N] }
    };

    /// The vertices in ascending order of height.
    #[inline(always)]
    pub fn vertices(&self) -> &[Vertex<D>] {
        self.vertices.get(..self.count).unwrap_or(&[])
    }

    /// The highest segment.
    pub fn last(&self) -> Option<&Vertex<D>> {
        self.vertices().last()
    }

    /// Replaces the slope of the highest segment.
    pub(super) fn set_slope(&mut self, slope: [f64; D]) {
        if let Some(last) = self.vertices.get_mut(..self.count).and_then(<[Vertex<D>]>::last_mut) {
            last.slope = slope;
        }
    }

    /// Turns the highest segment so that it ends at `apex`.
    pub(super) fn stretch(&mut self, apex: &Apex<D>) {
        if let Some(last) = self.vertices.get_mut(..self.count).and_then(<[Vertex<D>]>::last_mut) {
            last.slope = slope(last, (apex.indentation, apex.displacement));
        }
    }

    /// Keeps the lowest `count` segments.
    #[inline(always)]
    pub(super) fn truncate(&mut self, count: usize) {
        self.count = if count < self.count { count } else { self.count };
    }

    /// Adds a segment on top. A full list first merges two of its segments.
    pub(super) fn push(&mut self, curve: &Segment, vertex: Vertex<D>) {
        if self.count >= N {
            self.count = merge(&mut self.vertices, &vertex, curve, None, Merging::Halfway);
        }
        self.add(vertex);
    }

    /// Adds a segment on top of a list that is not full.
    pub(super) fn add(&mut self, vertex: Vertex<D>) {
        if let Some(slot) = self.vertices.get_mut(self.count) {
            *slot = vertex;
            self.count += 1;
        }
    }

    /// Multiplies all offsets and slopes by `factor`.
    pub(super) fn lengthen(&mut self, factor: f64) {
        for vertex in self.vertices.iter_mut().take(self.count) {
            (vertex.offset, vertex.slope) = (times(factor, vertex.offset), times(factor, vertex.slope));
        }
    }

    /// Moves the origin of all offsets to that of the highest springs, at `indentation` \[m\]. The offsets follow from the slopes:
    /// after a long slide, they would be small differences of large numbers.
    pub(super) fn rebase(&mut self, indentation: f64) {
        let mut end = (indentation, [0.0; D]);
        for vertex in self.vertices.iter_mut().take(self.count).rev() {
            vertex.offset = add(end.1, vertex.height - end.0, vertex.slope);
            end = (vertex.height, vertex.offset);
        }
    }
}

/// A polyline under construction, with room for all parts of the segments of a [`List`].
pub(super) struct Draft<const D: usize, const N: usize> {
    count: usize,
    vertices: [[Vertex<D>; N]; 8],
}

impl<const D: usize, const N: usize> Draft<D, N> {
    /// An empty polyline.
    pub(super) const EMPTY: Self = Draft { count: 0, vertices: [[Vertex::NONE; N]; 8] };

    /// Whether segments may be divided further. The rest of the room is for those that follow.
    pub(super) fn has_room(&self) -> bool {
        self.count < 2 * N
    }

    /// The segments so far.
    pub(super) fn vertices(&self) -> &[Vertex<D>] {
        self.vertices.as_flattened().get(..self.count).unwrap_or(&[])
    }

    /// Height of the lowest springs \[m\].
    pub(super) fn lowest(&self) -> f64 {
        self.vertices.as_flattened().first().map_or(0.0, |vertex| vertex.height)
    }

    /// Adds a segment, unless it continues the last one in a straight line.
    pub(super) fn extend(&mut self, vertex: Vertex<D>) {
        let room = self.vertices.as_flattened_mut();
        let last = self.count.checked_sub(1).and_then(|last| room.get(last));
        if last.is_none_or(|last| length(difference(last.slope, vertex.slope)) > SAME)
            && let Some(slot) = room.get_mut(self.count)
        {
            *slot = vertex;
            self.count += 1;
        }
    }

    /// The list of these segments; excess segments are merged.
    pub(super) fn list(&mut self, curve: &Segment, cone: &Apex<D>, merging: Merging) -> List<D, N> {
        let room = self.vertices.as_flattened_mut();
        if self.count > N
            && let Some([.., below, last]) = room.get_mut(..self.count)
            && cone.indentation - last.height <= TINY * cone.indentation
        {
            below.slope = slope(below, (cone.indentation, cone.displacement));
            self.count -= 1;
        }
        while self.count > N
            && let Some(([rest @ .., last], _)) = room.split_at_mut_checked(self.count)
        {
            let last = *last;
            let left = merge(rest, &last, curve, Some(cone), merging);
            if let Some(slot) = room.get_mut(left) {
                *slot = last;
            }
            self.count = left + 1;
        }
        let mut list = List::EMPTY;
        for vertex in room.iter().take(self.count) {
            list.add(*vertex);
        }
        list
    }
}

/// Slope of the straight line from `vertex` to the height and offset \[m\] of its `end`.
fn slope<const D: usize>(vertex: &Vertex<D>, (height, offset): (f64, [f64; D])) -> [f64; D] {
    let rise = height - vertex.height;
    difference(offset, vertex.offset).map(|shift| quotient(shift, rise, rise > 0.0, 0.0))
}
