//! One branch of a force-indentation curve.

use super::regime::LARGEST_INDENTATION;
use crate::numerics::next_above;
use libm::sqrt;

/// A piece of a force-indentation curve: `F = c0 + c1 z + c2 z^1.5 + c3 z^2`, `z = indentation - origin`.
///
/// Every branch of this project's own laws has this form: Hertz's law and its shifted copies use `c2`, linear laws use `c1`,
/// the unloading of the law `brinell` uses `c2` and `c3`. It holds for `lower <= indentation < upper`. Below `origin`, `z`
/// counts as zero and the force is `c0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Segment {
    /// Smallest indentation on the branch \[m\].
    pub lower: f64,
    /// Indentation where the next branch begins \[m\].
    pub upper: f64,
    /// Indentation where `z` is zero \[m\].
    pub origin: f64,
    /// `c0` \[N\].
    pub constant: f64,
    /// `c1` \[N/m\].
    pub linear: f64,
    /// `c2` \[N/m^1.5\].
    pub power: f64,
    /// `c3` \[N/m^2\].
    pub square: f64,
}

impl Segment {
    /// No force anywhere: the base from which the laws build their segments.
    pub const NOTHING: Segment =
        Segment { lower: 0.0, upper: 0.0, origin: 0.0, constant: 0.0, linear: 0.0, power: 0.0, square: 0.0 };

    /// Apart: no force, over `[lower, upper)` \[m\].
    pub const fn apart(lower: f64, upper: f64) -> Segment {
        Segment { lower, upper, origin: -LARGEST_INDENTATION, ..Segment::NOTHING }
    }

    /// The tangent of a curve that has no segments, at `indentation` \[m\] with `force` \[N\] and `stiffness` \[N/m\]. It holds
    /// at that point only: after any motion, the law is evaluated again.
    pub fn tangent(indentation: f64, force: f64, stiffness: f64) -> Segment {
        Segment {
            lower: indentation,
            upper: next_above(indentation),
            origin: indentation,
            constant: force,
            linear: stiffness,
            ..Segment::NOTHING
        }
    }

    /// The segment with its origin at zero, and with value and slope of the form at both ends, of which each is indentation, force and
    /// stiffness \[m, N, N/m\].
    ///
    /// Its slope is a quadratic in `u = sqrt(d)`: the straight line between the slopes at the ends, plus a multiple of
    /// `(u - p)(u - q)` that makes the integral equal to the difference of the forces.
    pub fn between([lower, begin, first]: [f64; 3], [upper, end, last]: [f64; 3]) -> Segment {
        let (p, q) = (sqrt(lower), sqrt(upper));
        let length = q - p;
        let incline = (last - first) / length;
        let straight = first * length * (p + q) + incline * length * length * (p + 2.0 / 3.0 * length);
        let bend = 6.0 * (straight - (end - begin)) / (length * length * length * (p + q));
        let linear = first - incline * p + bend * p * q;
        let power = (incline - bend * (p + q)) / 1.5;
        let square = 0.5 * bend;
        let constant = begin - lower * (linear + power * p + square * lower);
        Segment { lower, upper, origin: 0.0, constant, linear, power, square }
    }

    /// The segment from zero without force to a point of indentation, force and stiffness \[m, N, N/m\], without `c3`.
    pub(crate) fn from_zero([upper, force, stiffness]: [f64; 3]) -> Segment {
        let secant = force / upper;
        let excess = 2.0 * (stiffness - secant);
        Segment { upper, linear: secant - excess, power: excess / sqrt(upper), ..Segment::NOTHING }
    }

    /// The straight line from a point of indentation, force and stiffness \[m, N, N/m\] on.
    pub(crate) fn beyond([lower, constant, linear]: [f64; 3]) -> Segment {
        Segment { lower, upper: LARGEST_INDENTATION, origin: lower, constant, linear, ..Segment::NOTHING }
    }

    /// Whether `indentation` \[m\] lies on the branch; false for NaN.
    #[inline]
    pub fn contains(&self, indentation: f64) -> bool {
        indentation >= self.lower && indentation < self.upper
    }

    /// Whether the branch begins without force at its origin or just above it.
    #[inline]
    pub fn begins_at_origin(&self) -> bool {
        self.constant == 0.0 && (self.lower == self.origin || self.lower == next_above(self.origin))
    }

    /// `z` \[m\]; zero below the origin.
    #[inline(always)]
    fn above_origin(&self, indentation: f64) -> f64 {
        // this order lets the comparison and the difference take their second operand from memory
        let reached = if indentation > self.origin { indentation } else { self.origin };
        reached - self.origin
    }

    /// The force for which `rise` gives what `z` adds to `c0` \[N\]. The branch can be predicted; the result of a maximum would
    /// have to be waited for.
    #[inline(always)]
    fn force_with(&self, indentation: f64, rise: impl Fn(f64) -> f64) -> f64 {
        if indentation > self.origin { self.constant + rise(indentation - self.origin) } else { self.constant }
    }

    /// Force \[N\].
    #[inline]
    pub fn force(&self, indentation: f64) -> f64 {
        self.force_with(indentation, |z| z * (self.linear + self.power * sqrt(z) + self.square * z))
    }

    /// The same for a branch without `c3`, which most laws never use \[N\].
    #[inline(always)]
    pub fn force_without_square(&self, indentation: f64) -> f64 {
        self.force_with(indentation, |z| z * (self.linear + self.power * sqrt(z)))
    }

    /// Mean force over the distance from `from` to `to` \[m\], in either direction, without cancellation over short distances
    /// \[N\].
    pub fn mean_force(&self, from: f64, to: f64) -> f64 {
        let (y, z) = (self.above_origin(from), self.above_origin(to));
        let (p, q) = (sqrt(y), sqrt(z));
        // (q^5 - p^5)/(q^2 - p^2); both may be zero
        let powers = if p + q > 0.0 { (y * y + z * z + p * q * (y + z + p * q)) / (p + q) } else { 0.0 };
        self.constant
            + 0.5 * self.linear * (y + z)
            + 0.4 * self.power * powers
            + self.square * (y * y + y * z + z * z) / 3.0
    }

    /// d2F/d(indentation)^2 \[N/m^2\]; infinite where a power begins.
    pub fn curvature(&self, indentation: f64) -> f64 {
        let rise = if self.power == 0.0 { 0.0 } else { 0.75 * self.power / sqrt(self.above_origin(indentation)) };
        rise + 2.0 * self.square
    }

    /// dF/d(indentation) \[N/m\].
    #[inline]
    pub fn stiffness(&self, indentation: f64) -> f64 {
        let z = self.above_origin(indentation);
        self.linear + 1.5 * self.power * sqrt(z) + 2.0 * self.square * z
    }

    /// Integral of the force from the lower end of the branch to `indentation` \[J\]. It is not computed as a difference of two
    /// integrals, which would lose all digits over a distance that is short compared with the distance from the origin.
    pub fn work(&self, indentation: f64) -> f64 {
        self.mean_force(self.lower, indentation) * (indentation - self.lower)
    }
}
