//! The forces around a point of a smooth piece, as powers of the way from there.

use crate::contact::numbers::quotient;

/// The acceleration of the bodies around a point, as powers of `t`, the change of the root `r = sqrt(z)` from there; `z` is counted
/// from where the force may begin as a fractional power.
///
/// On a segment `F = c0 + c1 z + c2 z^1.5 + c3 z^2` these are five powers, exactly. A small motion in a deep dent loses no digits:
/// what is large and cancels is in the first coefficient, once.
#[derive(Clone, Copy, Debug)]
pub struct Series<const N: usize> {
    /// `r` at the point.
    root: f64,
    /// Acceleration: `n_0 + n_1 t + n_2 t^2 ...`.
    net: [f64; N],
    /// Half the gain in the square of the speed, over `t`; it has one power more.
    gain: [f64; N],
    last: f64,
}

/// `c_0 + c_1 t + c_2 t^2 ... + last t^N`.
fn polynomial<const N: usize>(coefficients: &[f64; N], last: f64, t: f64) -> f64 {
    coefficients.iter().rev().fold(last, |sum, coefficient| sum * t + coefficient)
}

impl<const N: usize> Series<N> {
    /// Powers of the acceleration around the point with this root.
    pub fn new(root: f64, net: [f64; N]) -> Series<N> {
        // the integral of n(t) dz, dz = 2 (root + t) dt
        let (mut gain, mut before, mut index) = ([0.0; N], 0.0, 1.0);
        for (slot, power) in gain.iter_mut().zip(net) {
            *slot = 2.0 * (root * power + before) / index;
            (before, index) = (power, index + 1.0);
        }
        Series { root, net, gain, last: 2.0 * before / index }
    }

    /// `r` at the point.
    pub fn root(&self) -> f64 {
        self.root
    }

    /// The acceleration at `t`.
    pub fn net(&self, t: f64) -> f64 {
        polynomial(&self.net, 0.0, t)
    }

    /// Half the gain in the square of the speed on the way to `t`, over `t`.
    pub fn gain(&self, t: f64) -> f64 {
        polynomial(&self.gain, self.last, t)
    }

    /// `z` at `t`, from the point.
    pub fn way(&self, t: f64) -> f64 {
        t * (2.0 * self.root + t)
    }

    /// What a longer way takes from the acceleration: `-dn/dz` at the point.
    pub fn stiffness(&self) -> f64 {
        let [_, first, second, ..] = self.net.first_chunk::<3>().copied().unwrap_or_default();
        quotient(-0.5 * first, self.root, self.root != 0.0, -second)
    }

    /// `c2` of a segment, at its origin.
    pub fn power(&self) -> f64 {
        let [.., third, fourth] = self.net.last_chunk::<2>().copied().unwrap_or_default();
        4.0 * self.root * fourth - third
    }

    /// The same forces around another point, at `t`.
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
