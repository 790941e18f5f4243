//! The motion of the bodies on one smooth piece of the law, step by step.

use super::Damping;
use crate::contact::loading::Loading;
use crate::contact::numbers::{largest, quotient, smallest};
use crate::contact::piece::Piece;
use crate::contact::unloading::Unloading;
use libm::{fabs, pow};

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
const TOLERANCE: f64 = 1e-11;

/// A distance by which the plate gives way, relative to the height, below which its digits do not count.
const SMALL: f64 = 1e-4;

/// Smaller errors count as this one.
const LEAST: f64 = 1e-30;

/// Distance from the balance of forces, relative to the height above the surface, at which bodies count as at rest.
const REST: f64 = 1e-9;

/// The same for the rate of indentation at a given closing speed, relative to that speed.
const STILL: f64 = 1e-14;

/// More halvings than the interpolation of an event ever needs.
const MOST_CUTS: u32 = 100;

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
        let stiffness = self.piece.stiffness(d);
        (self.damping.force(elastic, stiffness, rate), rate)
    }

    /// The state after `step` \[s\], and its relative error.
    fn step(&self, from: &State, step: f64) -> (State, f64) {
        let mut slopes = [(0.0, 0.0, 0.0, 0.0); 7];
        let mut next = *from;
        for (stage, row) in STAGES.iter().enumerate() {
            let State { mut way, mut retreat, mut speed, mut heat, .. } = *from;
            for (weight, slope) in row.iter().zip(&slopes) {
                way += step * weight * slope.0;
                retreat += step * weight * slope.1;
                speed += step * weight * slope.2;
                heat += step * weight * slope.3;
            }
            next = State { time: from.time + step, way, retreat, speed, heat };
            if let Some(slope) = slopes.get_mut(stage) {
                let (force, _) = self.force_and_rate(&next);
                let given = self.damping.retreat(force);
                *slope = (speed, given, self.acceleration - force * self.inverse_mass, given * force);
            }
        }
        let mut errors = [0.0; 3];
        for (weight, slope) in ERROR.iter().zip(&slopes) {
            for (error, slope) in errors.iter_mut().zip([slope.0, slope.1, slope.2]) {
                *error += step * weight * slope;
            }
        }
        let [way, retreat, speed] = errors.map(fabs);
        let height = fabs(self.start - self.surface) + fabs(next.way) + fabs(next.retreat);
        let speeds = fabs(from.speed) + fabs(next.speed) + fabs(next.speed - from.speed);
        let relative = |error: f64, size: f64| quotient(error, size, size > 0.0, 0.0);
        // where the force begins, the distance is a fractional power of time: its first steps are never accurate by themselves
        let given = fabs(next.retreat) + fabs(next.retreat - from.retreat) + SMALL * height;
        (next, largest(largest(relative(way, height), relative(retreat, given)), relative(speed, speeds)))
    }

    /// How far the state is beyond the end of the stretch: positive beyond its border, or when the indentation has turned.
    fn beyond(&self, state: &State, at_border: bool) -> f64 {
        let sign = if self.rising { 1.0 } else { -1.0 };
        match at_border {
            true if self.rising => self.indentation(state) - self.piece.upper,
            true => self.piece.lower - self.indentation(state),
            false => -sign * self.force_and_rate(state).1,
        }
    }

    /// The state within the `step` from `from` at the end of the stretch, which lies inside the step.
    fn event(&self, from: &State, step: f64, at_border: bool) -> State {
        let end = |part: f64| self.step(from, part).0;
        let (mut low, mut high) = (0.0, step);
        let mut below = self.beyond(from, at_border);
        let mut above = self.beyond(&end(high), at_border);
        for cut in 0..MOST_CUTS {
            // the secant, with a bisection in every third cut
            let secant = low + (high - low) * quotient(-below, above - below, above > below, 0.5);
            // the secant may have no room, where the stretch begins at its end
            let useful = cut % 3 != 2 && secant > low && secant < high;
            let middle = if useful { secant } else { 0.5 * (low + high) };
            if !(middle > low && middle < high) || high - low <= 4.0 * f64::EPSILON * step {
                break;
            }
            let value = self.beyond(&end(middle), at_border);
            if value > 0.0 {
                (high, above) = (middle, value)
            } else {
                (low, below) = (middle, value)
            };
        }
        end(high)
    }

    /// Whether the bodies have come to rest: forces in balance, and too slow to move noticeably.
    fn rests(&self, state: &State) -> bool {
        let (force, rate) = self.force_and_rate(state);
        let d = self.indentation(state);
        let (height, stiffness) = (d - self.surface, self.piece.stiffness(d));
        if self.inverse_mass == 0.0 {
            // bodies at a given speed rest when the plate gives way at that speed, or when nothing is left of the contact
            let same = fabs(rate) <= STILL * fabs(state.speed);
            return same || state.speed == 0.0 && height <= STILL * fabs(self.start - self.surface);
        }
        let excess = fabs(self.acceleration - force * self.inverse_mass);
        let scale = stiffness * self.inverse_mass;
        let is_balanced = excess <= REST * scale * height;
        is_balanced && scale > 0.0 && rate * rate <= REST * REST * scale * height * height
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
        loop {
            let rest = time - state.time;
            if rest <= 0.0 {
                return (state, Ended::WithTime);
            }
            let last = *guess >= rest;
            let step = if last { rest } else { *guess };
            let Some(fewer) = left.checked_sub(STAGES.len() as u32) else { return (state, Ended::TooLong) };
            *left = fewer;
            let (next, error) = self.step(&state, step);
            let factor = 0.9 * pow(TOLERANCE / largest(error, LEAST), 0.2);
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
            let border = self.beyond(&next, true) >= 0.0;
            let turned = self.beyond(&next, false) > 0.0;
            if border || turned {
                *left = left.saturating_sub(20 * STAGES.len() as u32);
                let mut end = self.event(&state, step, border);
                let mut ended = if border { Ended::AtBorder } else { Ended::Turned };
                // the indentation may have turned before it would have reached the border
                if border && self.beyond(&end, false) > 0.0 {
                    (end, ended) = (self.event(&state, step, false), Ended::Turned);
                }
                watch(&end, self.force_and_rate(&end).0);
                return (end, if ended == Ended::Turned && self.rests(&end) { Ended::AtRest } else { ended });
            }
            state = next;
            if last {
                state.time = time;
            }
            let (force, rate) = self.force_and_rate(&state);
            self.damping.swiftest = largest(self.damping.swiftest, fabs(rate));
            watch(&state, force);
            if self.rests(&state) {
                return (state, Ended::AtRest);
            }
            if !last || factor < 1.0 {
                *guess = step * if factor < 5.0 { factor } else { 5.0 };
            }
        }
    }
}

/// The stages of Dormand and Prince; the last one is the step itself.
///
/// Reference: J. R. Dormand, P. J. Prince, *J. Comput. Appl. Math.* 6 (1980) 19-26.
const STAGES: [[f64; 6]; 7] = crate::contact::damped::impact::STAGES;

/// The difference between the methods of order 5 and 4.
const ERROR: [f64; 7] = crate::contact::damped::impact::ERROR;
