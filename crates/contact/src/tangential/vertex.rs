//! A vertex of the polyline of stuck offsets.

use super::vector::{add, difference, dot};
use crate::segment::Segment;

/// A vertex of the polyline with the segment above it, which ends at the next vertex. The last segment ends at the
/// current indentation and displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex<const D: usize> {
    /// Height of the springs at the vertex: the indentation at which they touch \[m\].
    pub height: f64,
    /// Stuck offset of the vertex \[m\]: the scaled tangential displacement at which these springs are relaxed.
    pub offset: [f64; D],
    /// d(offset)/d(height) of the segment; of length 1 where its springs slip. It may be longer where the direction of slip
    /// turns, and on a dent that has grown.
    pub slope: [f64; D],
    /// Normal force of the curve at `height` \[N\].
    pub force: f64,
}

impl<const D: usize> Vertex<D> {
    /// In place of a vertex that there isn't.
    pub(super) const NONE: Self = Vertex { height: 0.0, offset: [0.0; D], slope: [0.0; D], force: 0.0 };

    /// A vertex at `height` and `offset` \[m\] whose normal force is that of `curve`.
    pub fn new(curve: &Segment, height: f64, offset: [f64; D], slope: [f64; D]) -> Self {
        Vertex { height, offset, slope, force: curve.force(height) }
    }

    /// Offset on the segment, or on its extension, at `height` \[m\].
    pub fn offset_at(&self, height: f64) -> [f64; D] {
        add(self.offset, height - self.height, self.slope)
    }

    /// Tangential energy of the segment up to the height \[m\] and normal force \[N\] of its `end` on `curve`, for a contact at this
    /// `displacement` \[m\], times `kappa/mu` \[J\]. The sum over all segments is what the springs store.
    pub(super) fn energy(&self, curve: &Segment, displacement: [f64; D], end: (f64, f64)) -> f64 {
        // r {[w F] + r [int F dh]}, in a form without cancellation on a short segment
        let (height, force) = end;
        let tension = difference(displacement, self.offset);
        let shortfall = (height - self.height) * (force - curve.mean_force(self.height, height));
        let pull = dot(self.slope, tension) * (force - self.force);
        pull - dot(self.slope, self.slope) * shortfall
    }
}
