//! The springs that a point of the motion leaves as they are.

use super::SAME;

/// Height and offset of a point of the polyline \[m\].
pub(super) type Point = (f64, f64);

/// The upward cone of 45 degrees below the current point of the motion. Springs inside it stick.
pub(super) struct Cone {
    /// Scaled tangential displacement \[m\].
    pub(super) displacement: f64,
    /// Indentation \[m\].
    pub(super) indentation: f64,
}

impl Cone {
    /// Distance of a point from one side of the cone \[m\]; positive inside.
    pub(super) fn distance(&self, sign: f64, (height, offset): Point) -> f64 {
        sign * (offset - self.displacement) + self.indentation - height
    }

    /// Whether a point at this `distance` \[m\] from a side is outside, apart from rounding.
    pub(super) fn is_outside(&self, distance: f64) -> bool {
        distance < -SAME * self.indentation
    }

    /// Whether the spring at `point` sticks.
    pub(super) fn holds(&self, point: Point) -> bool {
        [1.0, -1.0].iter().all(|&sign| !self.is_outside(self.distance(sign, point)))
    }
}
