//! Vectors in the plane of the surface.

use libm::{fabs, hypot, sqrt};

/// A vector along the surface.
pub(super) type Vector = [f64; 2];

/// No displacement.
pub(super) const ZERO: Vector = [0.0; 2];

/// `one + factor other`
#[inline(always)]
pub(super) fn add(one: Vector, factor: f64, other: Vector) -> Vector {
    let ([x, y], [dx, dy]) = (one, other);
    [x + factor * dx, y + factor * dy]
}

/// `one - other`
#[inline(always)]
pub(super) fn difference(one: Vector, other: Vector) -> Vector {
    add(one, -1.0, other)
}

/// `factor vector`
#[inline(always)]
pub(super) fn times(factor: f64, [x, y]: Vector) -> Vector {
    [factor * x, factor * y]
}

/// Scalar product.
#[inline(always)]
pub(super) fn dot([x, y]: Vector, [u, v]: Vector) -> f64 {
    x * u + y * v
}

/// Vector product: the component of `one` across `other`, times its length.
#[inline(always)]
pub(super) fn cross([x, y]: Vector, [u, v]: Vector) -> f64 {
    x * v - y * u
}

/// Numbers of this size and their inverses can be squared.
const SQUARED: f64 = 1e140;

/// Length.
#[inline(always)]
pub(super) fn length([x, y]: Vector) -> f64 {
    let size = fabs(x) + fabs(y);
    if size < SQUARED && size * SQUARED > 1.0 { sqrt(x * x + y * y) } else { hypot(x, y) }
}
