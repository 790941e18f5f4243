//! The exact motion of one spring on a straight way.

use super::vector::{Vector, add, dot, length, times};
use crate::contact::numbers::{largest, quotient, root, smallest};
use libm::{exp, fabs, log1p};

/// Relative change of a limit below which the limit counts as constant.
const CONSTANT: f64 = 1e-9;

/// Longest way that can be squared twice \[m\]. On a longer one every spring slips until it is aligned with it.
const FARTHEST: f64 = 1e60;

/// A spring before a straight way: its tension, and its limit before and after.
pub(super) struct Spring {
    /// Scaled displacement of the contact from the stuck offset \[m\].
    pub tension: Vector,
    /// Largest tension at the start \[m\].
    pub limit: f64,
    /// Largest tension at the end \[m\].
    pub end_limit: f64,
}

impl Spring {
    /// Tension \[m\] at the end of a way with this `shift` \[m\] of a given `direction`, for a spring that would exceed
    /// its limit if it stuck.
    ///
    /// It sticks until the tension reaches the limit. Then the tension `w` has the length of the limit `p`, and its
    /// angle to the motion obeys `p d(angle) = -sin(angle) ds`, since slip is along `w`. With `p` linear in `s`:
    ///
    /// `tan(angle1/2) = tan(angle0/2) exp(-L ln(p1/p0)/(p1 - p0))` over the length `L`.
    ///
    /// Reference: the pursuit curve of P. Bouguer (1732).
    pub(super) fn moved(&self, shift: Vector, direction: Vector) -> Vector {
        if self.end_limit <= 0.0 {
            return [0.0; 2];
        }
        if length(shift) > FARTHEST {
            return times(self.end_limit, direction);
        }
        let stuck = self.stuck_part(shift);
        let tension = add(self.tension, stuck, shift);
        let limit = self.limit + stuck * (self.end_limit - self.limit);
        let way = (1.0 - stuck) * length(shift);
        let [along, across] = direction;
        let (ahead, aside) = (dot(tension, direction), dot(tension, [-across, along]));
        // divisor and dividend of tan(angle0/2), without cancellation
        let (divisor, dividend) = if ahead >= 0.0 {
            (length(tension) + ahead, aside)
        } else {
            (fabs(aside), (length(tension) - ahead) * if aside < 0.0 { -1.0 } else { 1.0 })
        };
        let dividend = dividend * turn(way, limit, self.end_limit);
        let size = length([divisor, dividend]);
        let [cosine, sine] = [divisor, dividend].map(|part| quotient(part, size, size > 0.0, 0.0));
        let (ahead, aside) = ((cosine - sine) * (cosine + sine), 2.0 * sine * cosine);
        let unit = if size > 0.0 && limit > 0.0 { [ahead, aside] } else { [1.0, 0.0] };
        let [ahead, aside] = times(self.end_limit, unit);
        [ahead * along - aside * across, ahead * across + aside * along]
    }

    /// The part of the way on which the spring sticks: up to `|tension + t shift| = limit + t (change of the limit)`.
    /// A spring on its limit that first moves inwards reaches it again later.
    fn stuck_part(&self, shift: Vector) -> f64 {
        let change = self.end_limit - self.limit;
        let way = length(shift);
        let square = (way - change) * (way + change);
        let half = dot(self.tension, shift) - self.limit * change;
        let size = length(self.tension);
        let constant = smallest((size - self.limit) * (size + self.limit), 0.0);
        let discriminant = root(half * half - square * constant);
        let part = if half > 0.0 {
            quotient(-constant, half + discriminant, half + discriminant > 0.0, 0.0)
        } else {
            quotient(discriminant - half, square, square > 0.0 && discriminant - half < square, 1.0)
        };
        smallest(largest(part, 0.0), 1.0)
    }
}

/// `exp(-L ln(p1/p0)/(p1 - p0))` over the length `way` \[m\], with the limits `p0` and `p1` \[m\]; 0 if `p0` is 0.
fn turn(way: f64, limit: f64, end_limit: f64) -> f64 {
    let touches = limit > 0.0 && end_limit < 1e200 * limit;
    let change = quotient(end_limit - limit, limit, touches, 0.0);
    let rate =
        quotient(log1p(largest(change, f64::EPSILON - 1.0)), change, fabs(change) > CONSTANT, 1.0 - 0.5 * change);
    let exponent = quotient(way, limit, touches && way < 1e200 * limit, 1e200) * rate;
    exp(-smallest(exponent, 700.0))
}
