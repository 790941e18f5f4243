//! A vertex of the polyline of stuck offsets.

use crate::segment::Segment;

/// A vertex of the polyline with the segment above it, which ends at the next vertex. The last segment ends at the
/// current indentation and displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Height of the springs at the vertex: the indentation at which they touch \[m\].
    pub height: f64,
    /// Stuck offset of the vertex \[m\]: the scaled tangential displacement at which these springs are relaxed.
    pub offset: f64,
    /// d(offset)/d(height) of the segment; 1 or -1 where its springs slip.
    pub slope: f64,
    /// Normal force of the curve at `height` \[N\].
    pub force: f64,
    /// Tangential force of all segments below, divided by the coefficient of friction \[N\].
    pub below: f64,
}

impl Vertex {
    /// In place of a vertex that there isn't.
    pub(super) const NONE: Vertex = Vertex { height: 0.0, offset: 0.0, slope: 0.0, force: 0.0, below: 0.0 };

    /// A vertex at `height` and `offset` \[m\] whose normal force is that of `curve`.
    pub fn new(curve: &Segment, height: f64, offset: f64, slope: f64) -> Vertex {
        Vertex { height, offset, slope, force: curve.force(height), below: 0.0 }
    }

    /// Tangential force of all segments up to a point of this one with the normal force `force` \[N\], divided by the
    /// coefficient of friction \[N\].
    pub fn pull_up_to(&self, force: f64) -> f64 {
        self.below + self.slope * (force - self.force)
    }

    /// Offset on the segment, or on its extension, at `height` \[m\].
    pub fn offset_at(&self, height: f64) -> f64 {
        self.offset + self.slope * (height - self.height)
    }
}
