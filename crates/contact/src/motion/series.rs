//! The forces around a point of a smooth piece, as a power series in the distance from it.

use crate::numerics::quadrature::POINTS;
use crate::numerics::{quotient, root};
use crate::segment::Segment;

/// Number of powers of the acceleration on a segment, whose force is a polynomial of fourth degree in the root.
pub const SEGMENT: usize = 5;

/// The acceleration of the bodies around a point, as powers of `t`, which is the change of the root `r = sqrt(z)` from that
/// point. `z` is measured from where the force may begin as a fractional power. Roots have their own unit.
///
/// On a segment `F = c0 + c1 z + c2 z^1.5 + c3 z^2`, five powers are exact. A small motion in a deep dent loses no digits: the
/// large terms that cancel occur only once, in the first power.
#[derive(Clone, Copy, Debug)]
pub struct Series<const N: usize> {
    /// `r` at the point.
    pub root: f64,
    /// The acceleration \[m/s^2\]: `n_0 + n_1 t + n_2 t^2 ...`.
    net: [f64; N],
    /// Its integral over `z`, divided by `t`; it has one more power.
    gain: [f64; N],
    last: f64,
}

/// `1/k`.
const INVERSE: [f64; POINTS + 1] = {
    let mut inverse = [0.0; POINTS + 1];
    let mut index = 0;
    while index < inverse.len() {
        inverse[index] = 1.0 / (index + 1) as f64;
        index += 1;
    }
    inverse
};

impl Series<SEGMENT> {
    /// The series of a `segment` at the height `z` above its origin \[m\], where the acceleration is `net` \[m/s^2\].
    pub fn on_segment(segment: &Segment, height: f64, net: f64, inverse_mass: f64) -> Series<SEGMENT> {
        let r = root(height);
        let [linear, power, square] = [segment.linear, segment.power, segment.square].map(|c| c * inverse_mass);
        // coefficients of c1 r^2 + c2 r^3 + c3 r^4 around r
        let third = power + 4.0 * square * r;
        let second = linear + 3.0 * r * (power + 2.0 * square * r);
        let first = r * (2.0 * linear + r * (3.0 * power + 4.0 * square * r));
        Series::new(r, [net, -first, -second, -third, -square])
    }
}

impl<const N: usize> Series<N> {
    /// The series of the acceleration `net` around the point with this root.
    pub fn new(root: f64, net: [f64; N]) -> Series<N> {
        // the integral of n(t) dz, dz = 2 (root + t) dt
        let (mut gain, mut before) = ([0.0; N], 0.0);
        for ((slot, power), inverse) in gain.iter_mut().zip(net).zip(INVERSE) {
            *slot = 2.0 * (root * power + before) * inverse;
            before = power;
        }
        Series { root, net, gain, last: 2.0 * before / (N + 1) as f64 }
    }

    /// The acceleration at `t` \[m/s^2\].
    pub fn net(&self, t: f64) -> f64 {
        self.net.iter().rev().fold(0.0, |sum, power| sum * t + power)
    }

    /// The integral of the acceleration over `z`, from the point to `t`, divided by `t`.
    pub fn gain(&self, t: f64) -> f64 {
        self.gain.iter().rev().fold(self.last, |sum, power| sum * t + power)
    }

    /// Change of `z` from the point to `t`.
    pub fn way(&self, t: f64) -> f64 {
        t * (2.0 * self.root + t)
    }

    /// `t` at this change of `z` from the point; below the origin, `t` of the origin.
    pub fn roots(&self, way: f64) -> f64 {
        let sum = self.root + root(self.root * self.root + way);
        quotient(way, sum, sum != 0.0, 0.0)
    }

    /// Decrease of the acceleration per distance at `t`: `-dn/dz`.
    pub fn stiffness(&self, t: f64) -> f64 {
        let mut slope = 0.0;
        self.net.iter().rev().fold(0.0, |sum, power| {
            slope = slope * t + sum;
            sum * t + power
        });
        let root = self.root + t;
        // at the origin, the first power of the root is zero
        let [_, _, second, ..] = self.net.first_chunk::<3>().copied().unwrap_or_default();
        quotient(-0.5 * slope, root, root != 0.0, -second)
    }

    /// Coefficient of the fractional power in that decrease, for a segment at its origin: `c2` over the mass.
    pub fn power(&self) -> f64 {
        let [.., third, fourth] = self.net.last_chunk::<2>().copied().unwrap_or_default();
        4.0 * self.root * fourth - third
    }

    /// The same forces around another point at `t`.
    pub fn around(&self, t: f64) -> Series<N> {
        let mut net = self.net;
        for first in 0..N {
            net.iter_mut().skip(first).rev().fold(0.0, |above, slot| {
                *slot += t * above;
                *slot
            });
        }
        Series::new(self.root + t, net)
    }
}
