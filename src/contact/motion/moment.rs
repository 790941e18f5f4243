//! A moment of a motion, and the power series in time that starts there.

use crate::contact::numbers::quotient;
use libm::fabs;

/// A moment of a motion under force.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// \[m/s\]
    pub speed: f64,
    /// Acceleration \[m/s^2\].
    pub net: f64,
    /// What a longer way takes from it \[1/s^2\].
    pub stiffness: f64,
    /// Above where the force may begin as a fractional power \[m\].
    pub height: f64,
}

/// More than any ratio of ways, and not so much that a product with it overflows.
const WITHOUT_LIMIT: f64 = 1e100;

impl Moment {
    /// The way in `time` \[s\], which may be negative \[m\]: four powers of the time. And how large the next change of the force
    /// makes the last of them at most.
    pub fn after(&self, time: f64) -> (f64, f64) {
        let (phase, straight, fall) = (self.stiffness * time * time, self.speed * time, self.net * time * time);
        // the stiffness grows at most as from the origin of a power, and there without limit
        let limited = fabs(straight) < WITHOUT_LIMIT * self.height;
        let bend = fabs(straight) * quotient(fabs(straight), self.height, limited, WITHOUT_LIMIT);
        let way = straight * (1.0 - phase / 6.0) + fall * (0.5 - phase / 24.0);
        (way, fabs(phase) * (bend + fabs(fall)) / 24.0)
    }
}
