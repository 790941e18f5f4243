//! The numbers of one contact during a step.

use super::branch::{Branch, Event, Watched};
use super::dop853::{Numbers, Slopes};
use crate::numbers::quotient;
use libm::{fabs, sqrt};

/// Working memory of one contact for a step, and its results. The caller keeps one for each contact, or makes them anew: a step
/// needs nothing from the step before.
#[derive(Clone, Copy)]
pub struct Work<C> {
    /// The contact, moved by the step.
    pub(super) contact: C,
    /// The first contact of the block, which names it.
    pub(super) block: usize,
    /// Number of contacts behind this one up to the last one that it is coupled with.
    pub(super) reach: usize,
    pub(super) branch: Branch,
    /// `W_ii` \[1/kg\].
    pub(super) inverse_mass: f64,
    /// Closing acceleration by all other forces \[m/s^2\].
    pub(super) acceleration: f64,
    pub(super) now: Instant,
    /// The instant that a step of the integration tries.
    pub(super) trial: Instant,
    pub(super) slopes: Slopes<4>,
    /// The largest indentation of dents that were left behind \[m\].
    pub(super) deepest: f64,
}

/// A contact at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant {
    /// Indentation \[m\], closing rate \[m/s\], impulse of the step so far \[N.s\] and the integral of the impulse over time \[N.s^2\].
    pub numbers: Numbers,
    /// Force \[N\].
    pub force: f64,
    /// The derivative of the closing rate \[m/s^2\].
    pub net: f64,
}

impl Instant {
    pub const NOTHING: Instant = Instant { numbers: [0.0; 4], force: 0.0, net: 0.0 };

    #[inline(always)]
    pub fn indentation(&self) -> f64 {
        let [indentation, ..] = self.numbers;
        indentation
    }

    #[inline(always)]
    pub fn rate(&self) -> f64 {
        let [_, rate, ..] = self.numbers;
        rate
    }
}

impl<C> Work<C> {
    /// Working memory for `contact`; any contact will do.
    pub fn new(contact: C) -> Work<C> {
        Work {
            contact,
            block: 0,
            reach: 0,
            branch: Branch::NOTHING,
            inverse_mass: 0.0,
            acceleration: 0.0,
            now: Instant::NOTHING,
            trial: Instant::NOTHING,
            slopes: Slopes::NONE,
            deepest: 0.0,
        }
    }

    /// Impulse of the contact force over the step \[N.s\].
    pub fn impulse(&self) -> f64 {
        let [_, _, impulse, _] = self.now.numbers;
        impulse
    }

    /// The moment of the impulse \[N.s^2\]: its integral over the step, by which the bodies are displaced.
    pub fn moment(&self) -> f64 {
        let [_, _, _, moment] = self.now.numbers;
        moment
    }

    /// The largest indentation during the step or before \[m\], which a fresh surface forgets.
    pub fn deepest(&self) -> f64 {
        self.deepest
    }
}

/// Rounding of an acceleration, relative to the forces that make it up.
const BALANCE: f64 = 1e-13;

/// A distance from a threshold, relative to the scale, at which the contact counts as there, and a rate at which it counts as at
/// rest: then its acceleration decides where it goes.
const NEAR: f64 = 1e-13;

/// The scales of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// The root of twice the energy \[J^0.5\].
    pub root_energy: f64,
    /// The shortest time of an oscillation \[s\].
    pub time: f64,
}

impl<C> Work<C> {
    /// The largest rate that the energy allows \[m/s\].
    pub(super) fn speed(&self, scales: &Scales) -> f64 {
        scales.root_energy * sqrt(self.inverse_mass)
    }

    /// The distance from what is `watched` at which the contact counts as there \[m, m/s\].
    pub(super) fn near(&self, watched: &Watched, scales: &Scales) -> f64 {
        let speed = NEAR * self.speed(scales);
        match watched {
            Watched::Indentation { threshold, .. } => speed * scales.time + 4.0 * f64::EPSILON * fabs(*threshold),
            Watched::Rate => speed,
        }
    }

    /// 1 for a contact that goes deeper, -1 for one that comes back, 0 for one at rest.
    fn direction(&self, scales: &Scales) -> f64 {
        let (rate, net) = (self.now.rate(), self.now.net);
        if fabs(rate) > NEAR * self.speed(scales) {
            return rate.signum();
        }
        let rounding = BALANCE * (fabs(self.acceleration) + self.inverse_mass * fabs(self.now.force));
        if fabs(net) > rounding { net.signum() } else { 0.0 }
    }

    /// The event that is due without any motion: the contact is at a threshold, or beyond it, and moves across.
    pub(super) fn due(&self, watched: &Watched, scales: &Scales) -> Option<Event> {
        let near = self.near(watched, scales);
        match *watched {
            Watched::Indentation { event, threshold, sign } => {
                let is_there = sign * (threshold - self.now.indentation()) <= near;
                (is_there && sign * self.direction(scales) > 0.0).then_some(event)
            }
            Watched::Rate => (self.now.rate() <= near && self.direction(scales) < 0.0).then_some(Event::Turn),
        }
    }

    /// About the elastic energy at present \[J\], for this `stiffness` \[N/m\].
    pub(super) fn stored(&self, stiffness: f64) -> f64 {
        let force = fabs(self.now.force);
        let spring = quotient(0.6 * force * force, stiffness, stiffness > 1e-100 * force, 0.0);
        let most = 0.5 * force * fabs(self.now.indentation());
        if spring < most { spring } else { most }
    }
}
