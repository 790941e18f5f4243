//! Steps: the plain step, and every other kind.

use super::stability::{Ahead, watch};
use super::*;
use crate::contact::motion::{Drive, NoMotion};
use crate::contact::numbers::largest;
use crate::contact::path::Course;

/// What has become of a step that might be a plain one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plain {
    /// It is done.
    Done,
    /// It leaves the branch that the one contact is on, and is plain otherwise: [`Instance::do_branch_step`] makes it.
    OffBranch,
    /// It is another one: [`Instance::do_step`] makes it.
    Other,
}

/// A contact after a step that it has yet to make.
struct Moved<C> {
    history: C,
    /// The course that ends as the step did.
    course: Course,
    mean_force: f64,
    /// Closing speed at the end, of bodies that the unit moves \[m/s\].
    speed: f64,
    /// The largest indentation on the way \[m\].
    deepest: f64,
}

impl<S: Scene> Instance<S> {
    /// Moves the contacts from `time` over `step` \[s\] with the rates held. Then [`Instance::take_deep`] may have a warning.
    ///
    /// # Errors
    /// [`Fault::StepSize`], [`Fault::CommunicationPoint`], [`Fault::BeyondStopTime`], [`Fault::TooLate`], [`Fault::TooDeep`],
    /// [`Fault::TooLong`]; every contact is then where it was.
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), Fault> {
        self.clock.check(time, step)?;
        self.advance(time + step, step)?;
        // it may have been asked to look
        if !self.clock.curved && !self.is_watching() {
            self.clock.release();
        }
        if S::CONTACTS > 1 && !self.is_deep() {
            self.find_deep();
        }
        Ok(())
    }

    /// The step that nearly every step is: plainly in order, and of one contact on the branch that it is on. It does what
    /// [`Instance::do_step`] does. If it isn't such a step nothing is done, and the result says why.
    #[inline(always)]
    pub fn do_plain_step(&mut self, time: f64, step: f64) -> Plain {
        let end = time + step;
        let in_order = self.clock.takes(time, end, step);
        if S::CONTACTS > 1 {
            // what the passivity guard does must be logged
            let plain = in_order && Self::PLAIN && S::GUARD.is_none();
            return if plain && self.advance(end, step).is_ok() { Plain::Done } else { Plain::Other };
        }
        let Contacts { histories, rates, momenta, last_step, .. } = &mut self.contacts;
        let (Some(history), Some(&rate)) = (histories.as_mut().first_mut(), rates.as_ref().first()) else {
            return Plain::Other;
        };
        let from = if S::Momentum::IS_PRESENT { history.indentation() } else { 0.0 };
        if !(Self::PLAIN && in_order) {
            return Plain::Other;
        }
        if !history.short_step(rate * step) {
            return if Self::SIMPLE { Plain::OffBranch } else { Plain::Other };
        }
        for momentum in momenta.as_mut() {
            momentum.add(history.mean_force_of_short_step(from), step);
        }
        last_step.as_mut().fill(step);
        self.clock.time = end;
        Plain::Done
    }

    /// Whether a step is that of one contact with its rate held, and nothing to do or look for but the depth up to which its law
    /// is valid.
    const SIMPLE: bool = S::CONTACTS == 1 && Self::PLAIN && !S::Momentum::IS_PRESENT && S::GUARD.is_none();

    /// The step of which [`Instance::do_plain_step`] has found that it is plain but [leaves its branch](Plain::OffBranch). It does
    /// what [`Instance::do_step`] does; if that would fail nothing is done, and the result is false. Then
    /// [`Instance::take_deep`] may have a warning.
    #[inline(always)]
    pub fn do_branch_step(&mut self, time: f64, step: f64) -> bool {
        self.advance_one(time + step, step).is_ok()
    }

    /// Moves the one contact of a simple instance over `step` \[s\], to the time `end` \[s\].
    #[inline(always)]
    fn advance_one(&mut self, end: f64, step: f64) -> Result<(), TooDeep> {
        let Contacts { histories, rates, watched, looks, .. } = &mut self.contacts;
        let (Some(history), Some(&rate)) = (histories.as_ref().first(), rates.as_ref().first()) else { return Ok(()) };
        let ahead = Ahead { history, rate, time: self.clock.time, step, end, mean_force: 0.0 };
        let long = watch::<S>(watched, looks, 0, &ahead);
        self.move_one(rate, step)?;
        // the depth is told by a later step
        self.deep = long.unwrap_or(self.deep);
        self.contacts.last_step.as_mut().fill(step);
        self.clock.time = end;
        self.keep_watching();
        Ok(())
    }

    /// Moves the one contact of an instance with `rate` \[m/s\] held over `step` \[s\].
    #[inline(never)]
    pub(super) fn move_one(&mut self, rate: f64, step: f64) -> Result<(), TooDeep> {
        let Settings { bodies, values, .. } = &self.settings;
        let (Some(history), Some(bodies)) = (self.contacts.histories.as_mut().first_mut(), bodies.as_ref().first())
        else {
            return Ok(());
        };
        history.step_held(rate, step, &bodies.kept, || model_of::<S>(0, bodies, values))?;
        if !history.stays_within(bodies.depth) {
            self.note_depth();
        }
        Ok(())
    }

    /// Finds up to which depth the law of the one contact is valid, and notes whether the contact is deeper.
    #[cold]
    #[inline(never)]
    fn note_depth(&mut self) {
        let depth = self.valid_depth(0);
        let Some(history) = self.contacts.histories.as_mut().first_mut() else { return };
        let reached = history.max_indentation();
        if !history.stays_within(depth) {
            let Deep { contact, indentation } = self.deep;
            // a fresh surface may have forgotten what was deeper in the same step
            self.note_deep(0, if contact == 0 { reached } else { largest(reached, indentation) });
        }
    }

    /// Moves all contacts over `step` \[s\], to the time `end` \[s\], or none of them.
    #[inline]
    fn advance(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        if Self::ALONE && self.clock.curved && self.contacts.curves.as_ref().iter().any(Curve::is_curved) {
            return self.advance_on_course(end, step);
        }
        match Self::SIMPLE {
            true => self.advance_one(end, step).map_err(|deep| too_deep(0, deep))?,
            false => self.advance_all(end, step)?,
        }
        // how a step with derivatives ended is known until the next one, which isn't plain for that reason
        if Self::ALONE && self.clock.curved {
            self.straighten();
        }
        Ok(())
    }

    /// Moves all contacts of an instance that isn't simple, or none of them.
    #[inline]
    fn advance_all(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        if S::CONTACTS > 1 {
            // within the limits of rates and times a law that is made of segments can't refuse
            let looks_ahead = self.clock.curved || !Self::PLAIN || S::Contact::may_refuse(&self.model(0));
            if looks_ahead {
                for contact in 0..S::CONTACTS {
                    self.moved(contact, step)?;
                }
            }
        }
        let any =
            self.clock.curved && !Self::ALONE || !Self::PLAIN || S::Contact::FOLLOWS_RATE && S::Momentum::IS_PRESENT;
        if any {
            self.advance_any(step)?;
        } else {
            self.advance_held(end, step)?;
        }
        self.contacts.last_step.as_mut().fill(step);
        self.clock.time = end;
        self.keep_watching();
        Ok(())
    }

    /// Moves all contacts with their rates held, to the time `end` \[s\].
    #[inline]
    fn advance_held(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        let (time, watches) = (self.clock.time, self.is_watching());
        let Contacts { histories, rates, forces, momenta, watched, looks, .. } = &mut self.contacts;
        let settings = &mut self.settings;
        let (forces, momenta) = (forces.as_mut(), momenta.as_mut());
        for (contact, (history, &rate)) in histories.as_mut().iter_mut().zip(rates.as_ref()).enumerate() {
            let from = if S::Momentum::IS_PRESENT { history.indentation() } else { 0.0 };
            let before = *history;
            // one contact has been tried before, or is only looked at: its momentum is then that of a plain step, too
            let short = (S::CONTACTS > 1 || S::Momentum::IS_PRESENT) && history.short_step(rate * step);
            let group = S::group(contact);
            let kept = || settings.bodies.as_ref().get(group).map(|bodies| bodies.kept).unwrap_or_default();
            let mut long = None;
            if watches || !short {
                let mean_force = momenta.get(contact).map_or(0.0, |momentum| momentum.mean_force);
                let ahead = Ahead { history: &before, rate, time, step, end, mean_force };
                long = watch::<S>(watched, looks, contact, &ahead);
            }
            if !short {
                history
                    .step_held(rate, step, &kept(), || settings.model_at_once(group))
                    .map_err(|deep| too_deep(contact, deep))?;
            }
            if (S::CONTACTS == 1 || !short) && !history.stays_within(settings.valid_depth(group)) {
                self.deep = Deep { contact: contact as u32 + 1, indentation: history.max_indentation() };
            }
            self.deep = long.unwrap_or(self.deep);
            if let Some(force) = forces.get_mut(contact) {
                *force = history.force(rate);
            }
            if let Some(momentum) = momenta.get_mut(contact) {
                let mean = match short {
                    true => history.mean_force_of_short_step(from),
                    false => before
                        .mean_force(&settings.model_at_once(group), rate, step)
                        .map_err(|deep| too_deep(contact, deep))?,
                };
                momentum.add(mean, step);
            }
        }
        Ok(())
    }

    /// Moves all contacts, each on the course of its input, or by its mass.
    #[cold]
    fn advance_any(&mut self, step: f64) -> Result<(), Fault> {
        let curved = !Self::PLAIN || self.contacts.curves.as_ref().iter().any(Curve::is_curved);
        self.clock.curved |= !Self::PLAIN;
        for contact in 0..S::CONTACTS {
            self.check_wiring(contact);
            let Moved { mut history, course, mean_force, speed, deepest } = self.moved(contact, step)?;
            self.end_step(contact, speed, mean_force, step);
            let allowed = self.valid_depth(contact);
            history.stays_within(allowed);
            if deepest >= allowed {
                self.note_deep(contact, deepest);
            }
            let Contacts { histories, forces, momenta, curves, .. } = &mut self.contacts;
            if let Some(momentum) = momenta.as_mut().get_mut(contact) {
                momentum.add(mean_force, step);
            }
            if let Some(slot) = histories.as_mut().get_mut(contact) {
                *slot = history;
            }
            if let Some(curve) = curves.as_mut().get_mut(contact) {
                curve.end_of(&course, step);
            }
            if let Some(force) = forces.as_mut().get_mut(contact) {
                *force = history.force(course.rate);
            }
        }
        // how the step ended is known until the next one, which isn't plain for that reason
        if !curved {
            self.straighten();
        }
        Ok(())
    }

    /// Where `contact` will be after `step` \[s\].
    fn moved(&self, contact: usize, step: f64) -> Result<Moved<S::Contact>, Fault> {
        let (Some(history), Some(&rate)) = (self.histories().get(contact), self.rates().get(contact)) else {
            return Err(Fault::StepSize { step });
        };
        let mut history = *history;
        let mut course = self.contacts.curves.as_ref().get(contact).copied().unwrap_or_default().course(rate);
        let model = self.model(contact);
        let failed = |deep| too_deep(contact, deep);
        if let Some(follow) = S::FOLLOW {
            let mass = self.mass(contact);
            let drive = Drive { mass, acceleration: self.acceleration(contact, course.slope) };
            let speed = rate - self.owed(contact);
            let outcome = follow(&mut history, &model, &drive, speed, step).map_err(|reason| match reason {
                NoMotion::TooDeep(deep) => failed(deep),
                NoMotion::TooLong => Fault::TooLong { contact, step },
            })?;
            let mean_force = mass * outcome.taken / step;
            // as if the rate had gone there in a straight line
            let slope = drive.acceleration - history.force(outcome.speed) / mass;
            course = Course { rate: outcome.speed - slope * step, slope, bend: 0.0 };
            return Ok(Moved { history, course, mean_force, speed: outcome.speed, deepest: outcome.deepest });
        }
        let (deepest, mean_force) = match S::Momentum::IS_PRESENT {
            true => history.step_with_mean_force(&course, step, || model).map_err(failed)?,
            false => (history.step(&course, step, || model).map_err(failed)?, 0.0),
        };
        Ok(Moved { history, course, mean_force, speed: 0.0, deepest })
    }
}
