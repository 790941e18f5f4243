//! A straight piece of the motion in two tangential directions.

use super::vector::{Vector, length};
use crate::numbers::quotient;
use crate::tangential::Motion;

/// A straight way in two tangential directions.
pub type Way = Motion<2>;

impl Way {
    /// Whether the contact area grows without slip.
    pub fn sticks(&self) -> bool {
        self.normal > 0.0 && length(self.tangential) <= self.normal
    }

    /// d(offset)/d(height) of the springs that touch on a [sticking](Way::sticks) way.
    pub fn slope(&self) -> [f64; 2] {
        self.tangential.map(|rate| quotient(rate, self.normal, self.normal > 0.0, 0.0))
    }

    /// Direction of the tangential motion; any direction if there is none.
    pub(super) fn direction(&self) -> Vector {
        let rate = length(self.tangential);
        if rate > 0.0 { self.tangential.map(|part| quotient(part, rate, rate > 0.0, 0.0)) } else { [1.0, 0.0] }
    }
}
