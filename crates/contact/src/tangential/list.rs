//! The stuck offsets of a contact as a polyline of bounded length.

use super::vertex::Vertex;
use crate::segment::Segment;
use libm::fabs;

use super::SAME;
use super::cone::Cone;
use super::merge::merge;

/// A polyline of at most `N` segments, from the lowest height to the highest.
///
/// Adding a segment to a full list merges two of those below it: see `merge`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct List<const N: usize> {
    count: usize,
    vertices: [Vertex; N],
}

impl<const N: usize> List<N> {
    /// No contact.
    pub const EMPTY: List<N> = {
        // the shortest list in which two segments can replace three below the last one
        assert!(N >= 4);
        List { count: 0, vertices: [Vertex::NONE; N] }
    };

    /// The vertices in ascending order of height.
    #[inline(always)]
    pub fn vertices(&self) -> &[Vertex] {
        self.vertices.get(..self.count).unwrap_or(&[])
    }

    /// Whether there is no segment.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The highest segment.
    #[inline(always)]
    pub fn last(&self) -> Option<&Vertex> {
        self.vertices().last()
    }

    /// Replaces the slope of the highest segment.
    pub fn set_slope(&mut self, slope: f64) {
        if let Some(last) = self.vertices.get_mut(..self.count).and_then(<[Vertex]>::last_mut) {
            last.slope = slope;
        }
    }

    /// Keeps the lowest `count` segments.
    #[inline(always)]
    pub fn truncate(&mut self, count: usize) {
        self.count = if count < self.count { count } else { self.count };
    }

    /// Adds a segment on top. In a full list it first merges two segments, along the `curve` of the normal force.
    #[inline]
    pub fn push(&mut self, curve: &Segment, vertex: Vertex) {
        push(&mut self.vertices, &mut self.count, curve, None, vertex);
    }

    /// Whether no slope is steeper than that of slipping springs. The cone of a point then cuts the top off the
    /// polyline and leaves the rest unchanged.
    pub fn is_within_cones(&self) -> bool {
        self.vertices().iter().all(|vertex| fabs(vertex.slope) <= 1.0 + SAME)
    }
}

/// Adds a segment above the `count` others in `room`; if `room` is full, it first merges two of them. A growing dent
/// has a `cone`.
#[inline(always)]
fn push(room: &mut [Vertex], count: &mut usize, curve: &Segment, cone: Option<&Cone>, mut vertex: Vertex) {
    if *count >= room.len() {
        *count = merge(room, &vertex, curve, cone);
    }
    let last = count.checked_sub(1).and_then(|last| room.get(last));
    vertex.below = last.map_or(0.0, |last| last.pull_up_to(vertex.force));
    if let Some(slot) = room.get_mut(*count) {
        *slot = vertex;
        *count += 1;
    }
}

/// A polyline under construction, with room for more segments than a [`List`] keeps.
pub(super) struct Draft<const N: usize> {
    count: usize,
    vertices: [[Vertex; N]; 4],
}

impl<const N: usize> Draft<N> {
    /// An empty polyline.
    pub(super) const EMPTY: Draft<N> = Draft { count: 0, vertices: [[Vertex::NONE; N]; 4] };

    /// Adds a segment on top, unless it continues the last one in a straight line.
    pub(super) fn extend(&mut self, curve: &Segment, cone: &Cone, vertex: Vertex) {
        let room = self.vertices.as_flattened_mut();
        let last = self.count.checked_sub(1).and_then(|last| room.get(last));
        if last.is_none_or(|last| fabs(last.slope - vertex.slope) > SAME) {
            push(room, &mut self.count, curve, Some(cone), vertex);
        }
    }

    /// The list of these segments; excess segments are merged.
    pub(super) fn into_list(mut self, curve: &Segment, cone: &Cone) -> List<N> {
        let room = self.vertices.as_flattened_mut();
        while self.count > N
            && let Some(([rest @ .., last], _)) = room.split_at_mut_checked(self.count)
        {
            let last = *last;
            self.count = merge(rest, &last, curve, Some(cone));
            push(room, &mut self.count, curve, Some(cone), last);
        }
        let mut list = List::EMPTY;
        for vertex in room.iter().take(self.count) {
            list.push(curve, *vertex);
        }
        list
    }
}
