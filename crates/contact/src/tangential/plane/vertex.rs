//! A vertex of the polyline of stuck offsets, in two directions.

use super::vector::{ZERO, add};
use crate::segment::Segment;

/// A vertex of the polyline with the segment above it, which ends at the next vertex. The last segment ends at the
/// current indentation and displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Height of the springs at the vertex: the indentation at which they touch \[m\].
    pub height: f64,
    /// Stuck offset of the vertex \[m\]: the scaled tangential displacement at which these springs are relaxed.
    pub offset: [f64; 2],
    /// d(offset)/d(height) of the segment. It may be longer than 1 where the direction of slip turns.
    pub slope: [f64; 2],
    /// Normal force of the curve at `height` \[N\].
    pub force: f64,
}

impl Vertex {
    /// In place of a vertex that there isn't.
    pub(super) const NONE: Vertex = Vertex { height: 0.0, offset: ZERO, slope: ZERO, force: 0.0 };

    /// A vertex at `height` and `offset` \[m\] whose normal force is that of `curve`.
    pub fn new(curve: &Segment, height: f64, offset: [f64; 2], slope: [f64; 2]) -> Vertex {
        Vertex { height, offset, slope, force: curve.force(height) }
    }

    /// Offset on the segment, or on its extension, at `height` \[m\].
    pub fn offset_at(&self, height: f64) -> [f64; 2] {
        add(self.offset, height - self.height, self.slope)
    }
}
