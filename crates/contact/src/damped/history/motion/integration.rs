//! The integration of the motion: one step, its error, and the events in it.

use super::{Bodies, State};
use crate::damped::Damped;
use crate::motion::SMALLEST_MOTION;
use crate::numbers::{largest, quotient};
use crate::regime::LARGEST_INDENTATION;
use crate::runge_kutta::{self, EVALUATIONS};
use libm::{fabs, sqrt};

/// The part of the contact's depth that a step may cover: no change of the force is passed over.
const STRIDE: f64 = 0.25;

/// Distance from the balance of forces, relative to the indentation, at which bodies count as at rest.
const REST: f64 = 1e-9;

/// Bisections that find an event in a step to its last digit.
const HALVINGS: u32 = 60;

impl<D: Damped + Copy> Bodies<D> {
    /// The time `guess` \[s\], but not beyond the end of the step, and not past a change of the force.
    pub(super) fn limited(&self, guess: f64) -> f64 {
        let State { depth, speed } = self.scale;
        let swift = speed + sqrt(depth * fabs(self.acceleration));
        let longest = quotient(STRIDE * depth, swift, depth > 0.0 && swift > 0.0, f64::INFINITY);
        let guess = if guess < longest { guess } else { longest };
        if guess < self.left { guess } else { self.left }
    }

    /// A short time for bodies that have just touched \[s\]: a millionth of that in which they move by the depth that a contact
    /// without damping would reach.
    pub(super) fn first_guess(&self) -> f64 {
        let Bodies { state: State { speed, .. }, acceleration, inverse_mass, .. } = *self;
        let factor = self.contact.factors.elastic * inverse_mass;
        let stops = |depth: f64| {
            factor * self.contact.law.elastic(depth).integral > 0.5 * speed * speed + largest(acceleration, 0.0) * depth
        };
        let (mut low, mut high) = (0u64, LARGEST_INDENTATION.to_bits());
        while high - low > 1 {
            // the bits of positive f64 numbers, read as integers, keep their order
            let middle = low + (high - low) / 2;
            *(if stops(f64::from_bits(middle)) { &mut high } else { &mut low }) = middle;
        }
        let depth = f64::from_bits(high);
        let swift = fabs(speed) + sqrt(fabs(acceleration) * depth);
        quotient(1e-6 * depth, swift, swift > 0.0, self.left)
    }

    /// The time to the first border of the law that a motion to `next` in `step` \[s\] passes: the damping is not smooth there.
    /// `None` if the step ends at the border.
    pub(super) fn until_border(&mut self, step: f64, next: &State) -> Option<f64> {
        let depth = self.state.depth;
        let rising = next.depth > depth;
        let passes = |border: &f64| *border > 0.0 && (depth < *border) == rising && (next.depth > *border) == rising;
        let [first, second] = self.contact.law.borders();
        let order = if rising { [first, second] } else { [second, first] };
        let border = order.into_iter().filter(|border| depth != *border).find(passes)?;
        let (time, _) = self.event(step, |_, state| (state.depth > border) == rising);
        (time < step).then_some(time)
    }

    /// The time to the largest speed of a motion to `next` in `step` \[s\], from where on the damping has another scale. `None`
    /// if it isn't passed.
    pub(super) fn until_largest_speed(&mut self, step: f64, next: &State) -> Option<f64> {
        let slows = |bodies: &Self, state: &State| bodies.net(state) * state.speed <= 0.0;
        let state = self.state;
        let passes = self.contact.law.scaled_by_touch()
            && fabs(state.speed) >= self.contact.touch_speed
            && !slows(self, &state)
            && slows(self, next);
        if !passes {
            return None;
        }
        let sign = self.net(&state) > 0.0;
        let (mut low, mut high) = (0.0, step);
        self.evaluations += HALVINGS * EVALUATIONS;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let there = self.stepped(middle).0;
            *(if (self.net(&there) > 0.0) == sign { &mut low } else { &mut high }) = middle;
        }
        (high < step).then_some(high)
    }

    /// The time to where the surface ceases to push, or grips again, in a motion to `next` in `step` \[s\]. `None` if the step
    /// ends there, and for a law whose surface doesn't grip again: the error of the step tells such a kink, but not a force that
    /// begins and ends within the step.
    pub(super) fn until_grip(&mut self, step: f64, next: &State) -> Option<f64> {
        if !self.contact.law.grips_again() {
            return None;
        }
        let before = self.pushes(&self.state);
        let changes = |bodies: &Self, state: &State| bodies.pushes(state) != before;
        if !changes(self, next) {
            return None;
        }
        let (time, _) = self.event(step, changes);
        (time < step).then_some(time)
    }

    /// Whether the surface pushes. It lags behind in a separation only, and one that grips again ends with a force, which may be too
    /// small for a number.
    fn pushes(&self, state: &State) -> bool {
        state.speed >= 0.0
            || state.depth <= SMALLEST_MOTION
            || self.contact.sum_of_forces(state.depth, state.speed) > 0.0
    }

    /// The longest first step \[s\] of a surface that didn't push at the state `before` and has gripped now: the force begins with
    /// zero, and a longer step could miss it.
    pub(super) fn of_grip(&self, before: &State) -> f64 {
        let State { depth, speed } = self.state;
        let grips = self.contact.law.grips_again() && !self.pushes(before) && self.pushes(&self.state);
        quotient(STRIDE * depth, fabs(speed), grips && depth > 0.0 && speed != 0.0, f64::INFINITY)
    }

    /// Acceleration of the bodies \[m/s^2\].
    pub(super) fn net(&self, state: &State) -> f64 {
        // a law that is scaled by the largest speed so far
        let (known, speed) = (self.contact.touch_speed, fabs(state.speed));
        let faster = self.contact.law.scaled_by_touch() && speed > known;
        let part = quotient(known, speed, faster, 1.0);
        let force = self.contact.sum_of_forces(largest(state.depth, 0.0), part * state.speed);
        self.acceleration - largest(force, 0.0) * self.inverse_mass
    }

    /// The state after `step` \[s\], and its relative error.
    pub(super) fn stepped(&self, step: f64) -> (State, f64) {
        let State { depth, speed } = self.state;
        let slope = |&[depth, speed]: &[f64; 2]| Some([speed, self.net(&State { depth, speed })]);
        let Some(([depth, speed], error)) = runge_kutta::step(&[depth, speed], step, slope) else {
            return (self.state, f64::INFINITY);
        };
        let next = State { depth, speed };
        let relative = |error: f64, size: f64| fabs(error) / largest(size, SMALLEST_MOTION);
        let depth = relative(error[0], largest(self.scale.depth, fabs(next.depth)));
        let speed = relative(error[1], largest(self.scale.speed, fabs(next.speed)));
        (next, largest(depth, speed))
    }

    /// The time within `step` \[s\] at which `happens` becomes true, and the state then. It must be true at the end.
    pub(super) fn event(&mut self, step: f64, happens: impl Fn(&Self, &State) -> bool) -> (f64, State) {
        self.evaluations += HALVINGS * EVALUATIONS;
        let (mut low, mut high) = (0.0, step);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if happens(self, &self.stepped(middle).0) { &mut high } else { &mut low }) = middle;
        }
        (high, self.stepped(high).0)
    }

    /// Whether the bodies have come to rest: forces in balance, and too slow to move noticeably.
    pub(super) fn rests(&self) -> bool {
        let State { depth, speed } = self.state;
        let scale = self.contact.stiffness(0.0) * self.inverse_mass;
        let is_balanced = fabs(self.net(&self.state)) <= REST * scale * depth;
        is_balanced && scale > 0.0 && speed * speed <= REST * REST * scale * depth * depth
    }
}
