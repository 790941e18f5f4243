//! The exact motion of one spring on a straight way.

use super::SAME;
use super::vector::{self, across, add, dot, length, times, turned};
use crate::numerics::{largest, quotient, root, smallest};
use libm::{exp, fabs, log1p};

/// Relative change of a limit below which the limit counts as constant.
const CONSTANT: f64 = 1e-9;

/// Parts of the slip of a spring over which its mean tension is an integral. After that many its direction is that of the way.
const PANELS: u32 = 24;

/// Places and weights of Gauss's rule on the unit interval, exact for polynomials of degree five.
pub(super) const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// Longest way that can be squared twice \[m\]. On a longer one every spring slips until it is aligned with it.
pub(super) const FARTHEST: f64 = 1e60;

/// A spring before a straight way: its tension, and its limit before and after.
pub(super) struct Spring<const D: usize> {
    /// Scaled displacement of the contact from the stuck offset \[m\].
    pub tension: [f64; D],
    /// Largest tension at the start \[m\].
    pub limit: f64,
    /// Largest tension at the end \[m\].
    pub end_limit: f64,
}

impl<const D: usize> Spring<D> {
    /// Tension \[m\] at the end of a way with this `shift` \[m\] of a given `direction`, for a spring that would exceed
    /// its limit if it stuck.
    ///
    /// It sticks until the tension reaches the limit. Then the tension `w` has the length of the limit `p`, and its
    /// angle to the motion obeys `p d(angle) = -sin(angle) ds`, since slip is along `w`. With `p` linear in `s`:
    ///
    /// `tan(angle1/2) = tan(angle0/2) exp(-L ln(p1/p0)/(p1 - p0))` over the length `L`.
    ///
    /// Reference: the pursuit curve of P. Bouguer (1732).
    pub(super) fn moved(&self, shift: [f64; D], direction: [f64; D]) -> [f64; D] {
        if self.end_limit <= 0.0 {
            return [0.0; D];
        }
        if length(shift) > FARTHEST {
            return times(self.end_limit, direction);
        }
        let stuck = self.stuck_part(shift);
        let way = (1.0 - stuck) * length(shift);
        slipped(add(self.tension, stuck, shift), way, (self.limit_after(stuck), self.end_limit), direction)
    }

    /// Mean tension \[m\] over such a way, also of a spring that never slips. Between stick and the end of the turn, it is an
    /// integral by Gauss; exact if the spring doesn't turn.
    pub(super) fn mean(&self, shift: [f64; D], direction: [f64; D]) -> [f64; D] {
        let whole = length(shift);
        if whole > FARTHEST {
            return times(0.5 * (self.limit + self.end_limit), direction);
        }
        let stuck = self.stuck_part(shift);
        let mut sum = times(stuck, add(self.tension, 0.5 * stuck, shift));
        let mut tension = add(self.tension, stuck, shift);
        let mut time = stuck;
        for panel in 0..PANELS {
            let limit = self.limit_after(time);
            if time >= 1.0 || panel + 1 == PANELS || across(tension, direction) <= SAME * limit {
                break;
            }
            // as far as the limit is long, or as it falls to about a half
            let speed = whole + largest(self.limit - self.end_limit, 0.0);
            let part = smallest(quotient(limit, speed, limit < speed * (1.0 - time), 1.0), 1.0 - time);
            let at = |share: f64| {
                let limits = (limit, self.limit_after(time + share * part));
                slipped(tension, share * part * whole, limits, direction)
            };
            sum = GAUSS.iter().fold(sum, |sum, &(node, weight)| add(sum, weight * part, at(node)));
            tension = at(1.0);
            time += part;
        }
        // from here on the spring doesn't turn
        let (limit, rest) = (self.limit_after(time), 1.0 - time);
        let unit = if length(tension) > 0.0 { vector::direction(tension) } else { direction };
        add(sum, 0.5 * rest * (limit + self.end_limit), unit)
    }

    /// Largest tension after this part of the way \[m\].
    fn limit_after(&self, part: f64) -> f64 {
        self.limit + part * (self.end_limit - self.limit)
    }

    /// The part of the way on which the spring sticks: up to `|tension + t shift| = limit + t (change of the limit)`.
    /// A spring on its limit that first moves inwards reaches it again later.
    fn stuck_part(&self, shift: [f64; D]) -> f64 {
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

/// `tension` \[m\] of a spring on its limit after it has slipped over the length `way` \[m\] of a motion in this `direction`, during
/// which its limit changed evenly between these limits \[m\].
fn slipped<const D: usize>(
    tension: [f64; D],
    way: f64,
    (limit, end_limit): (f64, f64),
    direction: [f64; D],
) -> [f64; D] {
    let side = turned(direction);
    let (ahead, aside) = (dot(tension, direction), dot(tension, side));
    if aside == 0.0 || limit <= 0.0 {
        let sign = if ahead < 0.0 && limit > 0.0 { -1.0 } else { 1.0 };
        return times(sign * end_limit, direction);
    }
    // divisor and dividend of tan(angle0/2), without cancellation
    let (divisor, dividend) = if ahead >= 0.0 {
        (length(tension) + ahead, aside)
    } else {
        (fabs(aside), (length(tension) - ahead) * if aside < 0.0 { -1.0 } else { 1.0 })
    };
    let dividend = dividend * turn(way, limit, end_limit);
    let size = length([divisor, dividend]);
    let [cosine, sine] = [divisor, dividend].map(|part| quotient(part, size, size > 0.0, 0.0));
    let (ahead, aside) = ((cosine - sine) * (cosine + sine), 2.0 * sine * cosine);
    times(end_limit, add(times(ahead, direction), aside, side))
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
