//! Motion on a segment that is not a straight line, as a power series in time.

use super::moments::{Moments, Point};
use crate::numerics::{root, smallest};
use libm::fabs;

/// Largest number of powers.
const MOST: usize = 22;

/// Largest contribution of the last two powers to the speed, relative to the sum, for which the remaining powers are negligible.
const MISSED: f64 = 0.125 * f64::EPSILON;

/// The same relative to the change of speed, which is the impulse: over a short step it is far below the speed.
const MISSED_OF_IMPULSE: f64 = 1e-13;

/// `1/((k + 1) (k + 2))`, from `k = 1` on.
const INVERSE: [f64; MOST - 2] = {
    let mut inverse = [0.0; MOST - 2];
    let mut index = 0;
    while index < inverse.len() {
        inverse[index] = 1.0 / ((index + 2) * (index + 3)) as f64;
        index += 1;
    }
    inverse
};

/// The coefficient of one power of the time.
#[derive(Clone, Copy)]
struct Power {
    /// Of the height: `y` of a [`Curve`].
    way: f64,
    /// Of the root of the height: `e`.
    root: f64,
    /// Of the nonlinear part of the force, divided by `y`: `q e + r y`.
    bend: f64,
}

/// A motion that starts at a height of one.
///
/// With the height `1 + y` and its root `1 + e`: `y = 2 e + e^2`, and
/// `y'' = net - p y - q ((1 + y) (1 + e) - 1) - r (2 y + y^2)`. Each power of the time follows from those before it.
pub struct Curve {
    /// `p`, `q` and `r`.
    force: [f64; 3],
    /// The initial speed.
    speed: f64,
    powers: [Power; MOST],
    pub count: usize,
}

impl Curve {
    /// The motion with these first two powers of the distance. `None` if the later powers do not fall fast enough.
    pub fn new(first: f64, second: f64, force: [f64; 3]) -> Option<Curve> {
        let [p, q, r] = force;
        let powers = [Power { way: 0.0, root: 0.0, bend: 0.0 }; MOST];
        let mut curve = Curve { force, speed: first, powers, count: 0 };
        let (mut way, mut next, mut last) = (first, second, fabs(2.0 * second));
        let (mut size, mut change) = (fabs(first) + last, last);
        for (index, inverse) in INVERSE.into_iter().enumerate() {
            let (before, after) = curve.powers.split_at_mut_checked(index)?;
            // the newest powers come last, so that no sum waits for them
            let product: f64 = before.iter().rev().zip(before.iter()).map(|(late, early)| late.way * early.bend).sum();
            let (early, late) = before.split_at_checked(index / 2)?;
            let middle = if index % 2 == 1 { late.first()?.root } else { 0.0 };
            let pairs = early.iter().rev().zip(late.iter().skip(index % 2));
            let square = middle * middle + 2.0 * pairs.map(|(early, late)| early.root * late.root).sum::<f64>();
            let root = 0.5 * (way - square);
            let bend = q * root + r * way;
            *after.first_mut()? = Power { way, root, bend };
            (way, next) = (next, -((p + q + r) * way + bend + product) * inverse);
            let gain = fabs((index + 3) as f64 * next);
            (size, change) = (size + gain, change + gain);
            if gain + last <= smallest(MISSED * size, MISSED_OF_IMPULSE * change) {
                curve.count = index + 1;
                return Some(curve);
            }
            last = gain;
        }
        None
    }
}

impl Moments for Curve {
    fn at(&self, time: f64) -> Point {
        let (mut way, mut gain, mut net) = (0.0, 0.0, 0.0);
        let powers = self.powers.iter().take(self.count);
        for (index, Power { way: power, .. }) in powers.enumerate().skip(1).rev() {
            let (order, before) = ((index + 1) as f64, index as f64);
            way = (way + power) * time;
            gain = (gain + order * power) * time;
            net = net * time + order * before * power;
        }
        let ([p, q, r], way) = (self.force, (way + self.speed) * time);
        let root = root(1.0 + way);
        Point { time, way, gain, net, stiffness: p + root * (1.5 * q + 2.0 * r * root) }
    }
}
