//! Elliptic contact: bodies with two principal radii, as balls.
//!
//! Hertz's pressure `p_0 sqrt(1 - x^2/a^2 - y^2/b^2)` presses in a paraboloid with two radii `R'` and `R''`. Force, contact area and mean
//! pressure at each depth are those of a ball of another radius and other moduli, so that the laws of balls take an ellipse without a state
//! of its own. In units of `c = sqrt(a b)`, with `k = a/b` and Carlson's integrals `R_F` and `R_D` of `(0, 1/k, k)`:
//!
//! - `d = p_0 c/E* R_F`, `c/R' = 2/3 p_0/E* R_D(0, 1/k, k)`, `c/R'' = 2/3 p_0/E* R_D(0, k, 1/k)`;
//! - the ball has the radius `c^2/d` and `pi/(2 R_F)` times the moduli.
//!
//! **First yield** depends on Poisson's ratio and on `k`: the largest equivalent stress of von Mises on the axis. The ball has the
//! Poisson's ratio with which the law `brinell` has this first yield. Its effect on the mean pressure fades with the depth, and so does that of the
//! ellipse: deep dents have the mean pressure of deep dents by a ball. The limit of a slender ellipse is a row of line contacts, and the law
//! of cylinders confirms it: at the same half-width over that at first yield, the mean pressure is 1.1 % lower to 5.8 % higher. Elastic-plastic ellipses
//! between the two limits have not been compared with anything.
//!
//! Reference: K. L. Johnson, *Contact Mechanics*, Cambridge 1985, chapters 3 and 4; B. C. Carlson, *Numerical Algorithms* 10 (1995)
//! 13-26.

use crate::material::Body;
use crate::material::strength;
use crate::numerics::{largest, smallest};
use core::f64::consts::FRAC_PI_2;
use libm::{exp, fabs, log, sqrt};

/// Largest ratio of the two radii. Beyond it a contact is a line.
pub const LARGEST_RATIO: f64 = 1e4;

/// Largest number of duplications; each takes a quarter off the difference of the arguments.
const DUPLICATIONS: u32 = 60;

/// Difference of the arguments, relatively, at which the series ends: its error is of sixth order.
const NEAR: f64 = 2e-3;

/// Number of bisections.
const BISECTIONS: u32 = 60;

/// Depths over the smaller half-axis in which the largest stress is looked for: up to the last one, in so many steps.
const DEPTHS: (f64, u32) = (1.2, 48);

/// Carlson's `R_F(x, y, z)`: half the integral of `1/sqrt((t + x)(t + y)(t + z))` over all `t > 0`.
fn integral_f(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    let mut mean = (x + y + z) / 3.0;
    for _ in 0..DUPLICATIONS {
        let far = largest(fabs(mean - x), largest(fabs(mean - y), fabs(mean - z)));
        if far < NEAR * mean {
            break;
        }
        let shift = sqrt(x * y) + sqrt(y * z) + sqrt(z * x);
        (x, y, z) = (0.25 * (x + shift), 0.25 * (y + shift), 0.25 * (z + shift));
        mean = (x + y + z) / 3.0;
    }
    let (one, other) = (1.0 - x / mean, 1.0 - y / mean);
    let third = -one - other;
    let (second, cube) = (one * other - third * third, one * other * third);
    (1.0 + second * (second / 24.0 - 0.1 - 3.0 * cube / 44.0) + cube / 14.0) / sqrt(mean)
}

/// Carlson's `R_D(x, y, z)`: 1.5 times the integral of `1/sqrt((t + x)(t + y)(t + z)^3)` over all `t > 0`.
fn integral_d(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    let (mut sum, mut part) = (0.0, 1.0);
    let mut mean = (x + y + 3.0 * z) / 5.0;
    for _ in 0..DUPLICATIONS {
        let far = largest(fabs(mean - x), largest(fabs(mean - y), fabs(mean - z)));
        if far < NEAR * mean {
            break;
        }
        let shift = sqrt(x * y) + sqrt(y * z) + sqrt(z * x);
        sum += part / (sqrt(z) * (z + shift));
        part *= 0.25;
        (x, y, z) = (0.25 * (x + shift), 0.25 * (y + shift), 0.25 * (z + shift));
        mean = (x + y + 3.0 * z) / 5.0;
    }
    let (one, other) = (1.0 - x / mean, 1.0 - y / mean);
    let third = -(one + other) / 3.0;
    let (product, square) = (one * other, third * third);
    let second = product - 6.0 * square;
    let cube = (3.0 * product - 8.0 * square) * third;
    let fourth = 3.0 * (product - square) * square;
    let fifth = product * square * third;
    let series = 1.0 - 3.0 * second / 14.0 + cube / 6.0 + 9.0 * second * second / 88.0
        - 3.0 * fourth / 22.0
        - 9.0 * second * cube / 52.0
        + 3.0 * fifth / 26.0;
    3.0 * sum + part * series / (mean * sqrt(mean))
}

/// The largest value of `of` from 0 to `end`: among equal steps, then by golden sections around the best of them.
fn maximum(end: f64, steps: u32, of: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let step = end / f64::from(steps);
    let (mut best, mut place) = (of(0.0), 0.0);
    for count in 1..=steps {
        let here = step * f64::from(count);
        let found = of(here);
        if found > best {
            (best, place) = (found, here);
        }
    }
    let (mut low, mut high) = (largest(place - step, 0.0), place + step);
    for _ in 0..BISECTIONS {
        let (one, other) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if of(one) < of(other) {
            low = one;
        } else {
            high = other;
        }
    }
    largest(best, of(0.5 * (low + high)))
}

/// The shape of an elliptic contact, and the ball that has its force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// `k = a/b`, the half-axes of the contact over each other, at least 1 \[-\].
    pub ratio: f64,
    /// Radius of the ball \[m\].
    pub radius: f64,
    /// Its moduli over those of the bodies \[-\].
    pub stiffness: f64,
}

impl Ellipse {
    /// A ball of the radius 1.
    pub const BALL: Ellipse = Ellipse { ratio: 1.0, radius: 1.0, stiffness: 1.0 };

    /// The contact of a gap with these two radii \[m\], in any order; `None` unless they are above zero and at most [`LARGEST_RATIO`] apart.
    pub fn of(radii: [f64; 2]) -> Option<Ellipse> {
        let [one, other] = radii;
        let wanted = largest(one, other) / smallest(one, other);
        // written positively to reject NaN
        let is_one = one > 0.0 && other > 0.0 && wanted <= LARGEST_RATIO;
        if !is_one {
            return None;
        }
        let curvatures = |k: f64| [integral_d(0.0, 1.0 / k, k), integral_d(0.0, k, 1.0 / k)].map(|of| 2.0 / 3.0 * of);
        let (mut low, mut high) = (0.0, log(wanted));
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let [along, across] = curvatures(exp(middle));
            *(if across < wanted * along { &mut low } else { &mut high }) = middle;
        }
        let ratio = exp(0.5 * (low + high));
        let ([along, across], depth) = (curvatures(ratio), integral_f(0.0, 1.0 / ratio, ratio));
        let radius = sqrt(one) * sqrt(other) * (sqrt(along * across) / depth);
        Some(Ellipse { ratio, radius, stiffness: FRAC_PI_2 / depth })
    }

    /// The half-axes \[m\] of a contact of this `radius` \[m\], which is `sqrt(a b)`: the longer one first.
    pub fn half_axes(&self, radius: f64) -> [f64; 2] {
        let root = sqrt(self.ratio);
        [radius * root, radius / root]
    }

    /// The stresses on the axis at the depth `z` over `sqrt(a b)`, along the longer half-axis, along the shorter one and down, over the largest
    /// pressure.
    pub fn stresses(&self, poissons_ratio: f64, z: f64) -> [f64; 3] {
        stresses(self.ratio, poissons_ratio, z)
    }

    /// The largest pressure at first yield over the strength, in a body with this Poisson's ratio.
    pub fn pressure_at_yield(&self, poissons_ratio: f64) -> f64 {
        pressure_at_yield(self.ratio, poissons_ratio)
    }

    /// One of the two bodies, and its radius in place of its own two, as the law takes it.
    pub fn ball(&self, body: &Body, radius: f64) -> Body {
        let ratio = body.poissons_ratio;
        let harder = self.pressure_at_yield(ratio) / pressure_at_yield(1.0, ratio);
        let poissons_ratio = strength::poissons_ratio_for(ratio, harder);
        // the plane-strain modulus is to be that of the body
        let plane = (1.0 - poissons_ratio * poissons_ratio) / (1.0 - ratio * ratio);
        Body { radius, youngs_modulus: body.youngs_modulus * (self.stiffness * plane), poissons_ratio }
    }
}

/// The largest pressure at first yield over the strength, for an ellipse with this ratio of its half-axes.
fn pressure_at_yield(ratio: f64, poissons_ratio: f64) -> f64 {
    let equivalent = |z: f64| {
        let [x, y, down] = stresses(ratio, poissons_ratio, z);
        let squares = [x - y, y - down, down - x].map(|difference| difference * difference);
        sqrt(0.5 * (squares[0] + squares[1] + squares[2]))
    };
    let (end, steps) = DEPTHS;
    1.0 / maximum(end / sqrt(ratio), steps, equivalent)
}

/// The stresses along the longer half-axis, along the shorter one and down, over the largest pressure. On the axis at the depth `z`, with
/// `A^2 = a^2 + z^2`, `B^2 = b^2 + z^2`:
/// `sigma_z = -p_0 a b/(A B)`, `sigma_x = p_0 a b (-nu z I_0 + (1 - nu) z I_a - (1 - 2 nu)/(A (A + B)))`, with the integrals
/// `I_0 = 2/3 R_D(A^2, B^2, z^2)`, `I_a = 2/3 R_D(z^2, B^2, A^2)`, and `sigma_y` with `a` and `b` exchanged.
fn stresses(ratio: f64, nu: f64, z: f64) -> [f64; 3] {
    let square = z * z;
    let (along, across) = (ratio + square, 1.0 / ratio + square);
    let (root, other) = (sqrt(along), sqrt(across));
    let is_inside = z > 0.0;
    let integral = |x: f64, y: f64, of: f64| if is_inside { 2.0 / 3.0 * z * integral_d(x, y, of) } else { 0.0 };
    // at the surface z I_0 has a limit
    let common = if is_inside { integral(along, across, square) } else { 2.0 };
    let sideways = |of: f64, rest: f64, own: f64| {
        (1.0 - nu) * integral(square, rest, of) - nu * common - (1.0 - 2.0 * nu) / (own * (root + other))
    };
    [sideways(along, across, root), sideways(across, along, other), -1.0 / (root * other)]
}
