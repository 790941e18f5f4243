//! The clock of a contact that has just touched, or is about to part.
//!
//! Its force is a fractional power of the height `z` above the surface, and not smooth in time. In the root `w` of the
//! height it is: with `dt = w dtau`, `w' = d'/2`, `t' = w`, and every slope is `w` times that in time. All is regular
//! through `w = 0`.

use super::scales::Scales;
use super::work::Work;
use crate::numerics::{quotient, root, smallest};
use libm::{fabs, sqrt};

/// A contact whose height and rate make up less than this number of steps is near the surface.
const STEPS: f64 = 4.0;

/// The square of its rate over the product of height and acceleration, above which a contact flies through the surface.
const BALLISTIC: f64 = 10.0;

/// The least rate, as a part of the largest one: a contact that is slower takes thousands of steps for nothing.
const LEAST_RATE: f64 = 1e-6;

/// The part beyond the surface to which a step of a contact that parts goes, so that the root of the height changes its
/// sign.
const BEYOND: f64 = 1.1;

/// The clock of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    /// The place of the contact.
    pub place: usize,
    /// The root of its height \[m^0.5\].
    pub root: f64,
    /// Its rate of indentation \[m/s\].
    rate: f64,
    /// The surface \[m\].
    pub surface: f64,
    /// The time in which it covers its height \[s\].
    pub until: f64,
    /// The time for which it flies about as fast \[s\].
    ballistic: f64,
}

impl Clock {
    /// The clock of the contact at `place`, if it has one and its motion is not smooth over `time` \[s\].
    pub fn of<C>(place: usize, member: &Work<C>, scales: &Scales, time: f64) -> Option<Clock> {
        if !member.branch.begins_rough() {
            return None;
        }
        let (rate, surface) = (member.now.approach, member.branch.surface());
        let speed = fabs(rate);
        let height = member.now.indentation() - surface;
        let is_swift =
            speed > LEAST_RATE * member.speed(scales) && rate * rate > BALLISTIC * height * fabs(member.now.bend());
        let is_near = height < STEPS * time * speed && (height > 0.0 || rate > 0.0);
        if !(is_swift && is_near) {
            return None;
        }
        let (root, pull) = (root(height), fabs(member.now.bend()));
        let ballistic = quotient(0.5 * speed, pull, pull > 1e-100 * speed, f64::INFINITY);
        Some(Clock { place, root, rate, surface, until: height / speed, ballistic })
    }

    /// The length of a step by the clock that takes about `time` \[s\] or less; of a contact that parts, one that goes a
    /// little beyond.
    pub fn length(&self, time: f64) -> f64 {
        let Clock { root, rate, ballistic, .. } = *self;
        let time = smallest(time, ballistic);
        let height = root * root + rate * time;
        if height < 0.0 || rate < 0.0 && height < 0.01 * root * root {
            return BEYOND * 2.0 * root / -rate;
        }
        // (sqrt(height) - root)/(rate/2) without cancellation
        2.0 * time / (sqrt(height) + root)
    }
}
