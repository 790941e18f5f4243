//! An instant of a motion, and the power series in time that starts there.

use crate::numerics::quotient;
use libm::fabs;

/// An instant of a motion in contact.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Speed \[m/s\].
    pub speed: f64,
    /// Acceleration \[m/s^2\].
    pub net: f64,
    /// Decrease of the acceleration per distance \[1/s^2\].
    pub stiffness: f64,
    /// Height above the point where the force may begin as a fractional power \[m\].
    pub height: f64,
}

/// Larger than any ratio of distances, but small enough that no product with it overflows.
const WITHOUT_LIMIT: f64 = 1e100;

impl Moment {
    /// The distance \[m\] covered in `time` \[s\], which may be negative, with four powers of the time; and an upper bound for
    /// the contribution of the next change of the force to the last of them.
    pub fn after(&self, time: f64) -> (f64, f64) {
        let (phase, straight, fall) = (self.stiffness * time * time, self.speed * time, self.net * time * time);
        // the stiffness grows at most as above the origin of a power, and at the origin without limit
        let limited = fabs(straight) < WITHOUT_LIMIT * self.height;
        let bend = fabs(straight) * quotient(fabs(straight), self.height, limited, WITHOUT_LIMIT);
        let way = straight * (1.0 - phase / 6.0) + fall * (0.5 - phase / 24.0);
        (way, fabs(phase) * (bend + fabs(fall)) / 24.0)
    }
}
