//! The motion of the bodies on one smooth piece of the law, step by step.

mod events;

use super::{Damping, Form};
use crate::loading::Loading;
use crate::motion::SMALLEST_MOTION;
use crate::numbers::{largest, quotient, smallest};
use crate::piece::Piece;
use crate::runge_kutta::{self, EVALUATIONS};
use crate::unloading::Unloading;
use events::Event;
use libm::{fabs, sqrt};

/// An instant of the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct State {
    /// Time \[s\].
    pub time: f64,
    /// Distance by which the bodies have come closer since the start of the stretch \[m\].
    pub way: f64,
    /// Distance by which the target has given way since then \[m\].
    pub retreat: f64,
    /// Closing speed of the bodies \[m/s\].
    pub speed: f64,
    /// Energy that the target has carried away since the start of the stretch by giving way \[J\].
    pub heat: f64,
}

/// The reason why a stretch ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ended {
    /// The indentation turned.
    Turned,
    /// It reached the end of the piece.
    AtBorder,
    /// The time ended.
    WithTime,
    /// The bodies came to rest.
    AtRest,
    /// It took too many evaluations.
    TooLong,
}

/// Largest error of a step, relative to the changes in it and to the height above the surface.
const TOLERANCE: f64 = 2e-12;

/// A distance by which the plate gives way, relative to the height, below which its digits do not count.
const SMALL: f64 = 1e-4;

/// The same relative to the indentation, whose last digits are rounded: a dent is much deeper than the height above it may be.
const ROUNDED: f64 = 1e-3;

/// Last digits by which the sum of opposite forces over the stages of a step may be off.
const DIGITS: f64 = 16.0;

/// Largest indentation of a stage \[m\].
const FARTHEST: f64 = 1e20;

/// Distance from the balance of forces, relative to the height above the surface, at which bodies count as at rest.
const REST: f64 = 1e-9;

/// The same for bodies at a given speed on a plate: the distance that the contact still moves, relative to that of the bodies.
/// The integration leaves more than a tenth of it.
const STILL: f64 = 1e-10;

/// The height above the surface, relative to that at the start, of which nothing is left.
const NOTHING: f64 = 1e-14;

/// A stretch: a motion in one direction on one smooth `piece` of the law.
pub(super) struct Stretch<'a, L, U> {
    pub piece: &'a Piece<'a, L, U>,
    pub damping: Damping,
    /// Inverse of the effective mass \[1/kg\]; zero for a given closing speed.
    pub inverse_mass: f64,
    /// Acceleration by the other forces \[m/s^2\].
    pub acceleration: f64,
    /// Indentation at the start \[m\].
    pub start: f64,
    /// Indentation of the surface \[m\].
    pub surface: f64,
    pub rising: bool,
    /// Whether the largest speed is the present one, which grows.
    pub leads: bool,
    /// Whether the surface would have to pull, so that there is no force.
    pub slack: bool,
}

impl<L: Loading, U: Unloading> Stretch<'_, L, U> {
    /// Indentation \[m\].
    pub fn indentation(&self, state: &State) -> f64 {
        self.start + (state.way - state.retreat)
    }

    /// Contact force \[N\] and rate of indentation \[m/s\].
    pub fn force_and_rate(&self, state: &State) -> (f64, f64) {
        let d = self.indentation(state);
        // a trial may lead beyond the end of the piece
        let d = if self.rising { smallest(d, self.piece.upper) } else { d };
        let elastic = self.piece.force(d);
        let rate = state.speed - self.damping.retreat(elastic);
        (if self.slack { 0.0 } else { self.pull(d, elastic, rate) }, rate)
    }

    /// Force \[N\] with the damping at the indentation `d` \[m\], the `elastic` force \[N\] and `rate` \[m/s\]. It is negative where the
    /// surface would have to pull.
    fn pull(&self, d: f64, elastic: f64, rate: f64) -> f64 {
        if self.leads {
            let sign = if self.rising { 1.0 } else { -1.0 };
            return elastic * (1.0 + sign * self.damping.factor);
        }
        self.damping.pull(elastic, || self.piece.stiffness(d), rate)
    }

    /// The same for a state.
    fn pull_at(&self, state: &State) -> f64 {
        let d = self.indentation(state);
        let d = if self.rising { smallest(d, self.piece.upper) } else { d };
        let elastic = self.piece.force(d);
        self.pull(d, elastic, state.speed - self.damping.retreat(elastic))
    }

    /// Acceleration in the direction of the motion \[m/s^2\].
    fn gain_of_speed(&self, state: &State) -> f64 {
        let net = self.acceleration - self.force_and_rate(state).0 * self.inverse_mass;
        if self.rising { net } else { -net }
    }

    /// Decides whether the speed of `state` leads, and whether the surface would have to pull.
    fn note_speed(&mut self, state: &State) {
        self.slack = self.slack && self.pull_at(state) < 0.0;
        let speed = fabs(self.force_and_rate(state).1);
        let is_largest = speed >= self.damping.swiftest;
        self.damping.swiftest = largest(self.damping.swiftest, speed);
        if self.damping.form == Form::Proportional {
            // with the force of a speed that leads, does it grow?
            self.leads = is_largest;
            self.leads = is_largest && self.gain_of_speed(state) > 0.0;
        }
        self.slack = self.pull_at(state) < 0.0;
    }

    /// The state after `step` \[s\], and its relative error.
    fn step(&self, from: &State, step: f64) -> (State, f64) {
        let time = from.time + step;
        let mut pull = 0.0;
        let slope = |&[way, retreat, speed, heat]: &[f64; 4]| {
            let there = State { time, way, retreat, speed, heat };
            // a step that is far too long must not overflow in its next stage; written positively to reject NaN
            let near = fabs(self.indentation(&there)) < FARTHEST;
            if !near {
                return None;
            }
            let (force, _) = self.force_and_rate(&there);
            let given = self.damping.retreat(force);
            pull = largest(pull, fabs(force * self.inverse_mass));
            Some([speed, given, self.acceleration - force * self.inverse_mass, given * force])
        };
        let numbers = [from.way, from.retreat, from.speed, from.heat];
        let Some(([way, retreat, speed, heat], errors)) = runge_kutta::step(&numbers, step, slope) else {
            return (*from, f64::INFINITY);
        };
        let next = State { time, way, retreat, speed, heat };
        let [way, retreat, speed, _] = errors.map(fabs);
        let moved = fabs(self.start - self.surface) + fabs(next.way) + fabs(next.retreat);
        let height = moved + ROUNDED * fabs(self.start);
        // bodies near rest are slower than the rounding of the forces, which balance
        let noise = self.noise(pull, moved) * step / TOLERANCE;
        let speeds = fabs(from.speed) + fabs(next.speed) + fabs(next.speed - from.speed) + noise;
        let relative = |error: f64, size: f64| error / largest(size, SMALLEST_MOTION);
        // where the force begins, the distance is a fractional power of time: its first steps are never accurate by themselves
        let given = fabs(next.retreat) + fabs(next.retreat - from.retreat) + SMALL * moved + ROUNDED * fabs(self.start);
        (next, largest(largest(relative(way, height), relative(retreat, given)), relative(speed, speeds)))
    }

    /// Rounding of the acceleration \[m/s^2\] where the contact force alone gives the acceleration `pull` \[m/s^2\] at this `height`
    /// \[m\] above the surface. In a deep dent, the last digit of the indentation is a larger part of the height.
    fn noise(&self, pull: f64, height: f64) -> f64 {
        let digits = 1.0 + quotient(fabs(self.start), height, height > 0.0, 0.0);
        DIGITS * f64::EPSILON * (fabs(self.acceleration) + pull * digits)
    }

    /// Whether the bodies have come to rest: forces in balance, and too slow to move noticeably.
    fn rests(&self, state: &State) -> bool {
        let (force, rate) = self.force_and_rate(state);
        let d = self.indentation(state);
        let (height, stiffness) = (d - self.surface, self.piece.stiffness(d));
        // the rate at which a plate gives way to a change of the force
        let easing = self.damping.retreat(stiffness);
        if self.inverse_mass == 0.0 {
            // bodies at a given speed rest when the plate gives way at that speed, or when nothing is left of the contact
            let moved = fabs(self.start - self.surface) + fabs(state.way) + fabs(state.retreat);
            let steady = state.speed > 0.0 && fabs(rate) <= STILL * easing * moved;
            return steady || state.speed == 0.0 && height <= NOTHING * fabs(self.start - self.surface);
        }
        let excess = fabs(self.acceleration - force * self.inverse_mass);
        let scale = stiffness * self.inverse_mass;
        let is_balanced = excess <= REST * scale * height;
        is_balanced && scale > 0.0 && fabs(rate) <= REST * (sqrt(scale) + easing) * height
    }

    /// Follows the motion for `time` \[s\] from the closing speed `speed` \[m/s\]. `guess` is the first step \[s\] to try, and
    /// becomes the last one; `left` is the number of evaluations allowed. `watch` gets every accepted step.
    pub fn run(
        &mut self,
        speed: f64,
        time: f64,
        guess: &mut f64,
        left: &mut u32,
        watch: &mut dyn FnMut(&State, f64),
    ) -> (State, Ended) {
        let mut state = State { speed, ..State::default() };
        self.note_speed(&state);
        loop {
            let rest = time - state.time;
            if rest <= 0.0 {
                return (state, Ended::WithTime);
            }
            let last = *guess >= rest;
            let step = if last { rest } else { *guess };
            let Some(fewer) = left.checked_sub(EVALUATIONS) else { return (state, Ended::TooLong) };
            *left = fewer;
            let (next, error) = self.step(&state, step);
            let factor = runge_kutta::factor(TOLERANCE, error);
            // written positively to reject NaN
            let accepted = error <= TOLERANCE;
            if !accepted {
                let shorter = step * if factor > 0.1 { factor } else { 0.1 };
                if shorter <= f64::MIN_POSITIVE {
                    return (state, Ended::TooLong);
                }
                *guess = shorter;
                continue;
            }
            if let Some((event, length)) = self.first_event(&state, &next, step) {
                *left = left.saturating_sub(20 * EVALUATIONS);
                let (end, error) = self.step(&state, length);
                // most of the longer step may have had no force
                if error > TOLERANCE && length < step && length > f64::MIN_POSITIVE {
                    *guess = 0.5 * length;
                    continue;
                }
                watch(&end, self.force_and_rate(&end).0);
                self.note_speed(&end);
                match event {
                    Event::Border => return (end, Ended::AtBorder),
                    Event::Turn => return (end, if self.rests(&end) { Ended::AtRest } else { Ended::Turned }),
                    Event::Lead | Event::Peak | Event::Slack => state = end,
                }
                continue;
            }
            state = next;
            if last {
                state.time = time;
            }
            self.note_speed(&state);
            watch(&state, self.force_and_rate(&state).0);
            if self.rests(&state) {
                return (state, Ended::AtRest);
            }
            if !last || factor < 1.0 {
                *guess = step * if factor < 5.0 { factor } else { 5.0 };
            }
        }
    }
}
