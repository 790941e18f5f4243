//! The tangential state of a contact, and its step along one elastic curve: partial slip within Coulomb's bound.

use super::{List, SAME, Vertex, Way, growth};
use crate::path::Sum;
use crate::segment::Segment;
use libm::fabs;

/// The springs of a contact: the tangential displacement, and the polyline of their stuck offsets.
///
/// A segment is divided if it is longer than a path over `PARTS`, before it moves to a path of a deeper dent; with 0 it is
/// not divided.
///
/// The methods take the elastic normal force over the indentation as `curve`, from the surface (its lower end):
/// Hertz's law, or the unloading path of a dent. It has to be the same in all calls until the contact separates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stuck<const N: usize, const PARTS: u32 = { growth::PARTS }> {
    /// Scaled tangential displacement \[m\] since the first touch or since the last slide of the whole contact.
    pub(super) displacement: Sum,
    pub(super) list: List<N>,
}

impl<const N: usize, const PARTS: u32> Stuck<N, PARTS> {
    /// No contact.
    pub const APART: Self = Stuck { displacement: Sum::new(0.0), list: List::EMPTY };

    /// A contact that is pressed in without tangential displacement, at `indentation` \[m\].
    pub fn pressed(curve: &Segment, indentation: f64) -> Self {
        let mut stuck = Stuck::APART;
        if indentation > curve.lower {
            stuck.touch(curve);
        }
        stuck
    }

    /// Lets the first spring touch.
    pub(super) fn touch(&mut self, curve: &Segment) {
        *self = Stuck::APART;
        self.list.push(curve, Vertex::new(curve, curve.lower, 0.0, 0.0));
    }

    /// Moves the contact on its way along `curve`.
    ///
    /// Only the end point matters: on a straight way its cone cuts off as much of the polyline as the cones of all
    /// points on the way together.
    #[inline]
    pub fn advance(&mut self, curve: &Segment, way: &Way) {
        if way.to <= curve.lower {
            *self = Stuck::APART;
            return;
        }
        if !way.moves() {
            return;
        }
        let is_new = self.list.is_empty();
        if is_new {
            self.touch(curve);
        }
        // a contact that starts with an indentation already has springs
        let is_fresh = is_new && way.from <= curve.lower;
        let way = if is_fresh { way.above(curve.lower) } else { *way };
        let before = self.displacement.total();
        self.displacement = self.displacement.plus(way.shift);
        if !way.sticks() {
            self.slip(curve, &way, is_fresh);
        } else if is_fresh {
            self.list.set_slope(way.slope());
        } else if way.to > way.from && self.turns(way.slope()) {
            self.list.push(curve, Vertex::new(curve, way.from, before, way.slope()));
        }
    }

    /// Whether the last segment has another slope than `slope`.
    fn turns(&self, slope: f64) -> bool {
        self.list.last().is_none_or(|last| fabs(last.slope - slope) > SAME)
    }

    /// Cuts the polyline with the cone of the current point.
    fn slip(&mut self, curve: &Segment, way: &Way, is_fresh: bool) {
        let (displacement, indentation) = (self.displacement.total(), way.to);
        let mut left = self.list.vertices();
        let sign = way.slip().unwrap_or_else(|| {
            while let Some((last, below)) = left.split_last()
                && !below.is_empty()
                && last.height >= indentation
            {
                left = below;
            }
            let line = left.last().map_or(0.0, |last| last.offset_at(indentation));
            if displacement > line { 1.0 } else { -1.0 }
        });
        while let Some((last, below)) = left.split_last()
            && distance(last, sign, displacement, indentation) <= SAME * indentation
        {
            left = below;
        }
        let count = if is_fresh { 0 } else { left.len() };
        self.list.truncate(count);
        let Some(last) = self.list.last() else {
            // from here on only the direction of sliding matters
            self.displacement = Sum::new(0.0);
            let offset = -sign * (indentation - curve.lower);
            self.list.push(curve, Vertex::new(curve, curve.lower, offset, sign));
            return;
        };
        if fabs(last.slope - sign) > SAME {
            let front = front(last, sign, distance(last, sign, displacement, indentation));
            if front < indentation {
                let offset = last.offset_at(front);
                self.list.push(curve, Vertex::new(curve, front, offset, sign));
            }
        }
    }
}

/// Distance \[m\] of `vertex` from the side of the cone of `displacement` and `indentation` \[m\] that slips in the
/// direction `sign`; positive inside the cone.
#[inline(always)]
pub(super) fn distance(vertex: &Vertex, sign: f64, displacement: f64, indentation: f64) -> f64 {
    sign * (vertex.offset - displacement) + indentation - vertex.height
}

/// Height \[m\] of the slip front in the direction `sign` on the segment of `vertex`, at this `distance` \[m\] from
/// the side of the cone. The slope of the segment differs from `sign`.
#[inline(always)]
pub(super) fn front(vertex: &Vertex, sign: f64, distance: f64) -> f64 {
    vertex.height + distance / (1.0 - sign * vertex.slope)
}
