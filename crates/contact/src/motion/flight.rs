//! Flight: two bodies that do not touch move along a parabola in time.

use super::SMALLEST;
use crate::numerics::{largest, quotient, root};
use libm::fabs;

/// A flight at constant acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// Speed at the start \[m/s\].
    pub speed: f64,
    /// Acceleration \[m/s^2\].
    pub acceleration: f64,
}

/// The end of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Time of arrival \[s\].
    pub time: f64,
    /// Speed at arrival \[m/s\].
    pub speed: f64,
}

impl Flight {
    /// The same flight, with the direction reversed.
    pub fn reversed(&self) -> Flight {
        Flight { speed: -self.speed, acceleration: -self.acceleration }
    }

    /// Distance covered after `time` \[s\], in m.
    pub fn way(&self, time: f64) -> f64 {
        time * (self.speed + 0.5 * self.acceleration * time)
    }

    /// Speed after `time` \[s\], in m/s.
    pub fn speed_after(&self, time: f64) -> f64 {
        self.speed + self.acceleration * time
    }

    /// The first arrival at `distance` \[m\] >= 0 in the direction of the flight, after the start and before `end` \[s\];
    /// `None` if there is none.
    ///
    /// No operation overflows or divides by zero: distances that are too far for the time are skipped, and speeds are squared
    /// in units of the largest one.
    pub fn arrival(&self, distance: f64, end: f64) -> Option<Arrival> {
        let Flight { speed, acceleration } = *self;
        let reach = end * (fabs(speed) + 0.5 * fabs(acceleration) * end);
        let possible = distance <= reach && (speed > 0.0 || acceleration > 0.0);
        if !possible {
            return None;
        }
        if distance < SMALLEST {
            // it is already there, or it comes back to where it began
            if speed >= 0.0 {
                return Some(Arrival { time: 0.0, speed });
            }
            let returns = -2.0 * speed < acceleration * end;
            let time = quotient(-2.0 * speed, acceleration, returns, end);
            return returns.then_some(Arrival { time, speed: -speed });
        }
        let unit = largest(fabs(speed), fabs(acceleration) * end);
        let (first, gain) = (speed / unit, 2.0 * (acceleration / unit) * (distance / unit));
        // distance = speed t + acceleration t^2/2, in the form without cancellation
        let square = first * first + gain;
        if square < 0.0 {
            return None;
        }
        let last = if acceleration == 0.0 { speed } else { unit * root(square) };
        if speed >= 0.0 {
            let sum = speed + last;
            // a distance that is negligible beside the others takes no time
            let time = quotient(2.0 * distance, sum, sum > 0.0, 0.0);
            return (time < end).then_some(Arrival { time, speed: last });
        }
        let arrives = last - speed < acceleration * end;
        let time = quotient(last - speed, acceleration, arrives, end);
        arrives.then_some(Arrival { time, speed: last })
    }
}
