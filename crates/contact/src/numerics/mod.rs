//! Arithmetic that raises no floating-point exceptions except inexact and underflow: a host may trap the others.
//!
//! A compiler that optimizes for size may compute both sides of a choice between two numbers. A forbidden division or root is
//! therefore not skipped, but evaluated for another operand, which is hidden from the compiler. `expm1`, `sinh`, `cosh` and `tanh` of `libm`
//! choose between a product and one that overflows, so that none of them is used.
//!
//! The files beside integrate, differentiate, and store numbers as words.

pub mod dual;
pub mod quadrature;
pub mod words;

use core::hint::black_box;
use libm::{exp, log, sqrt};

/// The larger of two numbers; the second one if the first is NaN.
pub fn largest(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

/// The smaller of two numbers; the second one if the first is NaN.
pub fn smallest(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}

/// The square root; zero for a negative number.
pub fn root(square: f64) -> f64 {
    sqrt(black_box(largest(square, 0.0)))
}

/// `dividend/divisor` if it `exists`, otherwise `instead`.
pub fn quotient(dividend: f64, divisor: f64, exists: bool, instead: f64) -> f64 {
    let quotient = dividend / black_box(if exists { divisor } else { 1.0 });
    if exists { quotient } else { instead }
}

/// `1 - e^(-u)` for `u >= 0`, without cancellation: the rounding of the exponential function is in both factors of `(1 - e) u / -ln e`.
///
/// Reference: N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., SIAM 2002, section 1.14.1.
pub(crate) fn saturation(u: f64) -> f64 {
    // 1 beyond 40
    let u = smallest(u, 40.0);
    let decayed = exp(-u);
    let differs = decayed < 1.0;
    let whole = (1.0 - decayed) * quotient(u, -log(decayed), differs, 1.0);
    if differs { whole } else { u }
}

/// The largest power of two not above `value` >= 0. For the smallest numbers, it is the smallest normal power of two.
pub fn power_of_two(value: f64) -> f64 {
    let power = f64::from_bits(value.to_bits() & f64::INFINITY.to_bits());
    if power > 0.0 { power } else { f64::MIN_POSITIVE }
}

/// The next larger number after a finite one.
#[inline(always)]
pub fn next_above(value: f64) -> f64 {
    // adding 0.0 turns -0.0 into 0.0
    let bits = (value + 0.0).to_bits();
    f64::from_bits(bits.wrapping_add(1).wrapping_sub(2 * (bits >> 63)))
}

#[cfg(test)]
mod tests {
    use super::{next_above, saturation};

    #[test]
    fn saturation_is_exact_to_three_roundings_at_every_size() {
        for step in -3000..40 {
            let u = 10f64.powf(0.1 * f64::from(step));
            let (found, expected) = (saturation(u), -(-u).exp_m1());
            assert!((found - expected).abs() <= 3.0 * f64::EPSILON * expected, "{u:e}: {found:e}, not {expected:e}");
        }
        assert_eq!([saturation(0.0), saturation(1e300)], [0.0, 1.0]);
    }

    #[test]
    fn the_number_above_is_the_next_one() {
        for size in [0.0, f64::from_bits(1), f64::MIN_POSITIVE, 1e-9, 1.0, 1.5, 1e100] {
            for value in [size, -size] {
                assert_eq!(next_above(value).to_bits(), value.next_up().to_bits(), "{value:e}");
            }
        }
    }
}
