//! Vectors along the surface, in any number of directions.

use crate::numerics::{largest, quotient};
use libm::{fabs, hypot, sqrt};

/// `one + factor other`
#[inline(always)]
pub(super) fn add<const D: usize>(mut one: [f64; D], factor: f64, other: [f64; D]) -> [f64; D] {
    one.iter_mut().zip(other).for_each(|(one, other)| *one += factor * other);
    one
}

/// `one - other`
#[inline(always)]
pub(super) fn difference<const D: usize>(one: [f64; D], other: [f64; D]) -> [f64; D] {
    add(one, -1.0, other)
}

/// `factor vector`
#[inline(always)]
pub(super) fn times<const D: usize>(factor: f64, vector: [f64; D]) -> [f64; D] {
    vector.map(|part| factor * part)
}

/// Scalar product.
#[inline(always)]
pub(super) fn dot<const D: usize>(one: [f64; D], other: [f64; D]) -> f64 {
    one.iter().zip(other).fold(0.0, |sum, (one, other)| sum + one * other)
}

/// `vector` turned by a right angle; nothing along a line.
#[inline(always)]
pub(super) fn turned<const D: usize>(vector: [f64; D]) -> [f64; D] {
    let mut turned = [0.0; D];
    if let [x, y] = vector.as_slice() {
        turned.iter_mut().zip([-y, *x]).for_each(|(part, value)| *part = value);
    }
    turned
}

/// Size of the component of `one` across `other`, times the length of `other`.
#[inline(always)]
pub(super) fn across<const D: usize>(one: [f64; D], other: [f64; D]) -> f64 {
    fabs(dot(one, turned(other)))
}

/// Numbers of this size and their inverses can be squared.
const SQUARED: f64 = 1e140;

/// Length.
#[inline(always)]
pub(super) fn length<const D: usize>(vector: [f64; D]) -> f64 {
    let size = vector.iter().fold(0.0, |sum, part| sum + fabs(*part));
    match vector.as_slice() {
        [x, y] if size < SQUARED && size * SQUARED > 1.0 => sqrt(x * x + y * y),
        [x, y] => hypot(*x, *y),
        _ => size,
    }
}

/// The direction of `vector`; that of the first axis, if it has none.
#[inline(always)]
pub(super) fn direction<const D: usize>(vector: [f64; D]) -> [f64; D] {
    let size = length(vector);
    let mut first = [0.0; D];
    first.iter_mut().take(1).for_each(|part| *part = 1.0);
    if size > 0.0 { vector.map(|part| quotient(part, size, size > 0.0, 0.0)) } else { first }
}

/// `vector`, shortened to this `limit` if it is longer.
pub(super) fn within<const D: usize>(vector: [f64; D], limit: f64) -> [f64; D] {
    let (limit, size) = (largest(limit, 0.0), length(vector));
    times(quotient(limit, size, size > limit, 1.0), vector)
}
