//! The indentation over time: its course over a step, and a sum that loses no digits.

use crate::numerics::{quotient, root};
use libm::fabs;

/// A relative change so small that its square is below rounding.
const NEAR: f64 = 1e-8;

/// Larger numbers are not squared.
const HUGE: f64 = 1e150;

/// A sum of many small increments, carried to twice the precision of `f64`.
///
/// `value` is the plain sum, and `rest` is the sum of its rounding errors. After 1e8 steps, [`Sum::total`] is off by at most a
/// few units in the last place of the largest intermediate sum. The rounding error of an increment smaller than the sum is
/// known exactly, however small the increment is. An increment larger than the sum, near zero, may lose half a unit in its own
/// last place. No addition waits for the rest of the one before, so a step takes no longer than with a plain sum.
///
/// Reference: A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen", *ZAMM* 54 (1974) 39-51. T.
/// J. Dekker, *Numer. Math.* 18 (1971) 224-242, for the error of a sum whose larger term is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Sum {
    /// The sum, with its rounding errors.
    pub value: f64,
    /// The part that `value` misses.
    pub rest: f64,
}

impl Sum {
    /// A sum that starts at `value`.
    pub const fn new(value: f64) -> Sum {
        Sum { value, rest: 0.0 }
    }

    /// The sum with `increment` added.
    #[inline(always)]
    pub fn plus(self, increment: f64) -> Sum {
        let value = self.value + increment;
        Sum { value, rest: self.value - value + increment + self.rest }
    }

    /// The sum, rounded once.
    #[inline(always)]
    pub fn total(self) -> f64 {
        self.value + self.rest
    }
}

/// The rate over one step: `rate + slope t + bend t^2/2`. The indentation is then a cubic polynomial.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RatePolynomial {
    /// Rate at the start of the step \[m/s\].
    pub rate: f64,
    /// Its first derivative \[m/s^2\].
    pub slope: f64,
    /// Its second derivative \[m/s^3\].
    pub bend: f64,
}

impl RatePolynomial {
    /// A constant rate.
    pub const fn held(rate: f64) -> RatePolynomial {
        RatePolynomial { rate, slope: 0.0, bend: 0.0 }
    }

    /// Whether the rate is constant.
    #[inline(always)]
    pub fn is_held(&self) -> bool {
        self.slope == 0.0 && self.bend == 0.0
    }

    /// The rate after `time` \[s\], in m/s.
    #[inline]
    pub fn rate_after(&self, time: f64) -> f64 {
        self.rate + time * (self.slope + 0.5 * self.bend * time)
    }

    /// The distance covered after `time` \[s\], in m.
    #[inline]
    pub fn way(&self, time: f64) -> f64 {
        time * (self.rate + time * (0.5 * self.slope + self.bend * time * (1.0 / 6.0)))
    }

    /// The course that remains after `time` \[s\].
    #[inline(always)]
    pub fn after(&self, time: f64) -> RatePolynomial {
        RatePolynomial { rate: self.rate_after(time), slope: self.slope + self.bend * time, bend: self.bend }
    }

    /// The course backwards in time, which leads to the start of this one.
    pub fn reversed(&self) -> RatePolynomial {
        RatePolynomial { rate: -self.rate, slope: self.slope, bend: -self.bend }
    }

    /// The time between `low` and `high` \[s\] at which the distance is `way` \[m\]. The rate must keep its sign there.
    pub fn when_at(&self, way: f64, low: f64, high: f64) -> f64 {
        let (before, after) = (self.way(low) - way, self.way(high) - way);
        let part = quotient(before, before - after, fabs(before) < fabs(before - after), 0.5);
        self.when(|time| self.way(time) - way, (low, high), low + part * (high - low))
    }

    /// The time between two bounds \[s\] at which `beyond`, a function whose derivative is the rate, changes its sign. Newton's
    /// method within a bracket, starting at `time` \[s\].
    pub fn when(&self, beyond: impl Fn(f64) -> f64, (low, high): (f64, f64), mut time: f64) -> f64 {
        let end = high;
        let (mut low, mut high) = (low, high);
        let near = NEAR * (high - low);
        let below_at_end = beyond(end) < 0.0;
        for _ in 0..200 {
            let beyond = beyond(time);
            *(if (beyond < 0.0) == below_at_end { &mut high } else { &mut low }) = time;
            // no division by a rate whose step would leave the bracket, such as where the direction changes
            let RatePolynomial { rate, slope, .. } = self.after(time);
            let leads = fabs(beyond) < fabs(rate) * (high - low);
            let newton = time - quotient(beyond, rate, leads, f64::MAX);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if next == time || beyond == 0.0 || !(next > low && next < high) {
                break;
            }
            let change = fabs(next - time);
            time = next;
            // the remaining error is then as small a fraction of the change
            if change < near && change * fabs(slope) < NEAR * fabs(rate) && next == newton && slope != 0.0 {
                break;
            }
        }
        if time < end { time } else { end }
    }

    /// Whether the rate certainly keeps its sign over `step` \[s\]. The rate is a weighted mean of three numbers with
    /// non-negative weights (Bernstein form), so it keeps its sign if the three have the same sign. The converse does not hold:
    /// the three may differ in sign although the direction never changes.
    #[inline]
    pub fn keeps_direction(&self, step: f64) -> bool {
        let (middle, end) = (self.rate + 0.5 * self.slope * step, self.rate_after(step));
        let forward = self.rate >= 0.0 && middle >= 0.0 && end >= 0.0;
        forward || self.rate <= 0.0 && middle <= 0.0 && end <= 0.0
    }

    /// The monotone motions of a step \[m\]; unused entries are zero. Their sum is the distance covered.
    pub fn motions(&self, step: f64) -> [f64; 3] {
        let mut from = 0.0;
        self.monotone_ends(step).map(|end| {
            let to = self.way(end);
            to - core::mem::replace(&mut from, to)
        })
    }

    /// The times at which the monotone parts of a step end \[s\]: the sign changes of the rate inside the step, in order.
    /// Unused entries are the end of the step.
    #[inline]
    pub fn monotone_ends(&self, step: f64) -> [f64; 3] {
        if self.keeps_direction(step) { [step; 3] } else { self.turns(step) }
    }

    /// The ends of the monotone parts of a course that may change direction.
    #[cold]
    #[inline(never)]
    fn turns(&self, step: f64) -> [f64; 3] {
        // scaling does not change the roots, and prevents overflow of the squares
        let huge = [self.rate, self.slope, self.bend].iter().any(|number| fabs(*number) > HUGE);
        let unit = if huge { 1.0 / HUGE } else { 1.0 };
        let (rate, half, bend) = (unit * self.rate, 0.5 * unit * self.slope, 0.5 * unit * self.bend);
        let discriminant = half * half - bend * rate;
        // no real root, or a double root: the sign does not change
        let negative = discriminant <= 0.0 && bend != 0.0;
        if negative || self.is_held() {
            return [step; 3];
        }
        // the two roots of bend t^2/2 + slope t + rate, in the form without cancellation; quotients outside the step are not
        // computed
        let q = -(half + if half >= 0.0 { root(discriminant) } else { -root(discriminant) });
        let inside = |dividend: f64, divisor: f64| {
            let is_inside = dividend * divisor.signum() > 0.0 && fabs(dividend) < fabs(divisor) * step;
            quotient(dividend, divisor, is_inside, step)
        };
        let (one, other) = (inside(q, bend), inside(rate, q));
        if one < other { [one, other, step] } else { [other, one, step] }
    }
}
