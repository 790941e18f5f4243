//! A step of one contact with derivatives of its input.

use super::stability::{Ahead, watch};
use super::*;

impl<S: Scene> Instance<S> {
    /// Whether a step with derivatives of the input concerns a single contact that follows its input.
    #[inline(always)]
    pub(super) fn is_alone() -> bool {
        S::contacts() == 1 && Self::is_plain() && S::has_course() && !S::Contact::HAS_FRICTION
    }

    /// Moves the single contact for `step` \[s\], to the time `end` \[s\], along the course of its input.
    #[inline(never)]
    pub(super) fn advance_on_course(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        let Contacts { histories, rates, curves, momenta, watched, looks, .. } = &mut self.contacts;
        let (Some(history), Some(&rate)) = (histories.as_ref().first(), rates.as_ref().first()) else { return Ok(()) };
        let course = curves.as_ref().first().copied().unwrap_or_default().course(rate);
        let mean_force = momenta.as_ref().first().map_or(0.0, |momentum| momentum.mean_force);
        let ahead = Ahead { history, rate, time: self.clock.time, step, end, mean_force };
        let found = watch::<S>(watched, looks, 0, &ahead);
        let history = *history;
        let deep = self.deep;
        let mut mean_force = 0.0;
        if S::has_momentum() {
            let (mut history, model) = (history, self.model(0));
            let moved = history.step_with_mean_force(&course, step, || &*model);
            let (deepest, mean) = moved.map_err(|deep| too_deep(0, deep))?;
            history.stays_within(self.depth(0));
            if deepest >= self.depth(0) {
                self.note_deep(0, deepest);
            }
            self.contacts.histories.as_mut().fill(history);
            mean_force = mean;
        } else {
            let motions = course.motions(step);
            let [_, second, _] = motions;
            let before = (second != 0.0).then_some(history);
            for increment in motions {
                if increment != 0.0
                    && !self.contacts.histories.as_mut().iter_mut().all(|history| history.short_step(increment))
                    && let Err(deepest) = self.move_one(increment, 1.0)
                {
                    // if a single motion fails, the contact has not changed
                    before.into_iter().for_each(|before| self.contacts.histories.as_mut().fill(before));
                    self.deep = deep;
                    return Err(too_deep(0, deepest));
                }
            }
        }
        let Contacts { histories, forces, momenta, curves, last_step, .. } = &mut self.contacts;
        forces.as_mut().iter_mut().zip(histories.as_ref()).for_each(|(force, history)| *force = history.force(rate));
        momenta.as_mut().iter_mut().for_each(|momentum| momentum.add(mean_force, step));
        curves.as_mut().iter_mut().for_each(|curve| curve.end_of(&course, step));
        last_step.as_mut().fill(step);
        self.deep = found.unwrap_or(self.deep);
        self.clock.time = end;
        self.keep_watching();
        Ok(())
    }
}
