//! What may happen within a step of the integration, and when.

use super::{State, Stretch};
use crate::loading::Loading;
use crate::losses::Form;
use crate::numbers::quotient;
use crate::unloading::Unloading;

/// More halvings than the interpolation of an event ever needs.
const MOST_CUTS: u32 = 100;

/// What may happen within a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Event {
    /// The indentation turns.
    Turn,
    /// It reaches the end of the piece.
    Border,
    /// The largest speed so far is exceeded, or is no longer the present one: the force has a kink.
    Lead,
    /// The speed is at its largest, whatever was before.
    Peak,
    /// The surface begins or ends to lag behind: it would have to pull.
    Slack,
}

impl<L: Loading, U: Unloading> Stretch<'_, L, U> {
    /// How far the state is beyond an event: positive if it has happened.
    fn beyond(&self, state: &State, event: Event) -> f64 {
        let sign = if self.rising { 1.0 } else { -1.0 };
        match event {
            Event::Border if self.rising => self.indentation(state) - self.piece.upper,
            Event::Border => self.piece.lower - self.indentation(state),
            Event::Turn => -sign * self.force_and_rate(state).1,
            Event::Lead if !self.leads => sign * self.force_and_rate(state).1 - self.damping.swiftest,
            Event::Lead | Event::Peak => -self.gain_of_speed(state),
            Event::Slack if self.slack => self.pull_at(state),
            Event::Slack => -self.pull_at(state),
        }
    }

    /// The time within `step` \[s\] from the state `from` to an event, which lies inside the step.
    fn time_of(&self, from: &State, step: f64, event: Event) -> f64 {
        let value = |part: f64| self.beyond(&self.step(from, part).0, event);
        let (mut low, mut high) = (0.0, step);
        let (mut below, mut above) = (self.beyond(from, event), value(high));
        for cut in 0..MOST_CUTS {
            // the secant, with a bisection in every third cut
            let secant = low + (high - low) * quotient(-below, above - below, above > below, 0.5);
            // the secant may have no room, where the stretch begins at its end
            let useful = cut % 3 != 2 && secant > low && secant < high;
            let middle = if useful { secant } else { 0.5 * (low + high) };
            if !(middle > low && middle < high) || high - low <= 4.0 * f64::EPSILON * step {
                break;
            }
            let there = value(middle);
            if there > 0.0 {
                (high, above) = (middle, there)
            } else {
                (low, below) = (middle, there)
            };
        }
        high
    }

    /// The first event within the `step` \[s\] from the state `from` to `next`, and its time \[s\].
    pub(super) fn first_event(&self, from: &State, next: &State, step: f64) -> Option<(Event, f64)> {
        let (mut end, mut first) = (*next, None);
        // an event may hide another one before it: bodies without force may leave the piece, turn, and be back at the end
        for event in [Event::Turn, Event::Border, Event::Lead, Event::Slack] {
            match (event, self.damping.form) {
                (Event::Lead, Form::Radiation | Form::Mobility) | (Event::Slack, Form::Mobility) => continue,
                _ => {}
            }
            let value = self.beyond(&end, event);
            if value > 0.0 || event == Event::Border && value == 0.0 {
                let length = first.map_or(step, |(_, time)| time);
                let time = self.time_of(from, length, event);
                (first, end) = (Some((event, time)), self.step(from, time).0);
            }
        }
        let length = first.map_or(step, |(_, time)| time);
        first.or_else(|| self.hidden_lead(from, &end, length))
    }

    /// The time at which the largest speed is exceeded, if the speed is below it again at the end of the `step` \[s\].
    fn hidden_lead(&self, from: &State, next: &State, step: f64) -> Option<(Event, f64)> {
        let rises = || self.gain_of_speed(from) > 0.0 && self.beyond(next, Event::Peak) > 0.0;
        if self.damping.form != Form::Proportional || self.leads || !rises() {
            return None;
        }
        let peak = self.time_of(from, step, Event::Peak);
        let exceeds = self.beyond(&self.step(from, peak).0, Event::Lead) > 0.0;
        exceeds.then(|| (Event::Lead, self.time_of(from, peak, Event::Lead)))
    }
}
