//! Steps: the plain step, and all others.

use super::clock::Guarded;
use super::stability::{Ahead, watch};
use super::*;
use crate::scene::Real;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::motion::{ExternalLoad, NoMotion};
use brinell_contact::numerics::largest;

/// Result of an attempt at a plain step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plain {
    /// The step is done.
    Done,
    /// It leaves the branch of the single contact and is otherwise plain: use [`Instance::do_branch_step`].
    OffBranch,
    /// It is not plain: use [`Instance::do_step`].
    Other,
}

/// The state of a contact after a step that is not committed yet.
struct Moved<C> {
    history: C,
    /// A course with the same end as the step.
    course: RatePolynomial,
    mean_force: f64,
    /// Closing speed of the bodies at the end, if the FMU moves them \[m/s\].
    speed: f64,
    /// The largest indentation during the step \[m\].
    deepest: f64,
}

impl<S: Scene> Instance<S> {
    /// Moves the contacts from `time` for `step` \[s\] with constant rates. Afterwards, [`Instance::take_deep`] may return a
    /// warning.
    ///
    /// # Errors
    /// [`Fault::StepSize`], [`Fault::CommunicationPoint`], [`Fault::BeyondStopTime`], [`Fault::TooLate`], [`Fault::TooDeep`],
    /// [`Fault::TooLong`], [`Fault::TooWide`], [`Fault::InputOutOfRange`], [`Fault::UnknownMass`]; no contact changes then.
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), Fault> {
        self.clock.check(time, step, Self::shortest())?;
        self.check_width()?;
        self.check_tangential_rates(step)?;
        self.check_masses()?;
        self.advance(time + step, step)?;
        // it may have been asked to look
        if !self.clock.curved && !self.is_watching() {
            self.clock.release();
        }
        if S::contacts() > 1 && !self.is_deep() {
            self.find_deep();
        }
        Ok(())
    }

    /// Checks that the masses that are inputs are known.
    ///
    /// # Errors
    /// [`Fault::UnknownMass`]
    fn check_masses(&self) -> Result<(), Fault> {
        let masses = self.contacts.masses.as_ref().iter();
        let unknown = masses.take_while(|_| S::has_input(Real::EffectiveMass)).position(|mass| *mass == 0.0);
        unknown.map_or(Ok(()), |contact| Err(Fault::UnknownMass { contact }))
    }

    /// The most frequent kind of step: no further checks are needed, and a single contact stays on its branch. The result is
    /// the same as that of [`Instance::do_step`]. If it is not such a step, it changes nothing, and the result gives the
    /// reason.
    #[inline(always)]
    pub fn do_plain_step(&mut self, time: f64, step: f64) -> Plain {
        let end = time + step;
        let in_order = self.clock.takes(time, end, step, Self::shortest());
        if S::contacts() > 1 {
            let plain = in_order && Self::is_plain();
            return if plain && self.advance(end, step).is_ok() { Plain::Done } else { Plain::Other };
        }
        let Contacts { histories, rates, momenta, last_step, .. } = &mut self.contacts;
        let (Some(history), Some(&rate)) = (histories.as_mut().first_mut(), rates.as_ref().first()) else {
            return Plain::Other;
        };
        let from = if S::has_momentum() { history.indentation() } else { 0.0 };
        if !(Self::is_plain() && in_order) {
            return Plain::Other;
        }
        if !history.short_step(rate * step) {
            return if Self::is_simple() { Plain::OffBranch } else { Plain::Other };
        }
        for momentum in momenta.as_mut() {
            momentum.add(history.mean_force_of_short_step(from), step);
        }
        last_step.as_mut().fill(step);
        self.clock.time = end;
        Plain::Done
    }

    /// Whether a step concerns a single contact with a constant rate, and needs no other check than that of the indentation up
    /// to which the law is valid.
    #[inline(always)]
    fn is_simple() -> bool {
        S::contacts() == 1 && Self::is_plain() && !S::has_momentum() && S::guard().is_none()
    }

    /// A step that [`Instance::do_plain_step`] has found to be plain except that it [leaves its branch](Plain::OffBranch). The
    /// result is the same as that of [`Instance::do_step`]. If that would fail, it changes nothing and returns false.
    /// Afterwards, [`Instance::take_deep`] may return a warning.
    #[inline(always)]
    pub fn do_branch_step(&mut self, time: f64, step: f64) -> bool {
        self.advance_one(time + step, step).is_ok()
    }

    /// Moves the contact of a simple instance for `step` \[s\], to the time `end` \[s\].
    #[inline(always)]
    fn advance_one(&mut self, end: f64, step: f64) -> Result<(), TooDeep> {
        let Contacts { histories, rates, watched, looks, .. } = &mut self.contacts;
        let (Some(history), Some(&rate)) = (histories.as_ref().first(), rates.as_ref().first()) else { return Ok(()) };
        let ahead = Ahead { history, rate, time: self.clock.time, step, end, mean_force: 0.0 };
        let long = watch::<S>(watched, looks, 0, &ahead);
        self.move_one(rate, step)?;
        // a later step will report the depth
        self.deep = long.unwrap_or(self.deep);
        self.contacts.last_step.as_mut().fill(step);
        self.clock.time = end;
        self.keep_watching();
        Ok(())
    }

    /// Moves the single contact of an instance at constant `rate` \[m/s\] for `step` \[s\].
    #[inline(never)]
    pub(super) fn move_one(&mut self, rate: f64, step: f64) -> Result<(), TooDeep> {
        let settings = &self.settings;
        let (Some(history), Some(bodies)) =
            (self.contacts.histories.as_mut().first_mut(), settings.bodies.as_ref().first())
        else {
            return Ok(());
        };
        history.step_held(rate, step, &bodies.kept, || settings.model_at_once(0))?;
        if !history.stays_within(bodies.depth) {
            self.note_depth();
        }
        Ok(())
    }

    /// Computes the indentation up to which the law of the single contact is valid, and records whether the contact is deeper.
    #[cold]
    #[inline(never)]
    fn note_depth(&mut self) {
        let depth = self.depth(0);
        let Some(history) = self.contacts.histories.as_mut().first_mut() else { return };
        let reached = history.max_indentation();
        if !history.stays_within(depth) {
            let Deep { contact, indentation } = self.deep;
            // a fresh surface may have forgotten the largest indentation within the same step
            self.note_deep(0, if contact == 0 { reached } else { largest(reached, indentation) });
        }
    }

    /// Moves all contacts for `step` \[s\], to the time `end` \[s\], or none of them.
    #[inline]
    fn advance(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        if Self::is_alone() && self.clock.curved && self.contacts.curves.as_ref().iter().any(Curve::is_curved) {
            return self.advance_on_course(end, step);
        }
        // only with friction a single contact gets here with derivatives of its inputs
        match Self::is_simple() && !(S::Contact::HAS_FRICTION && self.clock.curved) {
            true => self.advance_one(end, step).map_err(|deep| too_deep(0, deep))?,
            false => self.advance_all(end, step)?,
        }
        // the end of a step with derivatives stays known until the next step, which is not plain for this reason
        if Self::is_alone() && self.clock.curved {
            self.straighten();
        }
        Ok(())
    }

    /// Moves all contacts of an instance that is not simple, or none of them.
    #[inline]
    fn advance_all(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        if S::is_shared() {
            self.advance_together(step)?;
            self.contacts.last_step.as_mut().fill(step);
            self.clock.time = end;
            return Ok(());
        }
        if S::contacts() > 1 {
            // within the limits of rate and time, a law with segments cannot fail
            let looks_ahead = self.clock.curved || !Self::is_plain() || S::Contact::may_refuse(&self.model(0));
            if looks_ahead {
                for contact in 0..S::contacts() {
                    self.moved(contact, step)?;
                }
            }
        }
        let any = self.clock.curved && !Self::is_alone() || !Self::is_plain() || S::follows_rate() && S::has_momentum();
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

    /// Moves all contacts at constant rates.
    #[inline]
    fn advance_held(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        let (time, watches) = (self.clock.time, self.is_watching());
        let guarded = &mut self.clock.guard;
        let Contacts { histories, rates, forces, momenta, watched, looks, .. } = &mut self.contacts;
        let settings = &mut self.settings;
        let (forces, momenta) = (forces.as_mut(), momenta.as_mut());
        // asked once, since a scene that is data would be asked for each contact
        let (is_one, has_momentum) = (S::contacts() == 1, S::has_momentum());
        for (contact, (history, &rate)) in histories.as_mut().iter_mut().zip(rates.as_ref()).enumerate() {
            let from = if has_momentum { history.indentation() } else { 0.0 };
            let before = *history;
            // a single contact has been tried before; when its momentum is an output, it is computed as in a plain step
            let short = (!is_one || has_momentum) && history.short_step(rate * step);
            let group = || S::group(contact);
            let kept = |group: usize| settings.bodies.as_ref().get(group).map(|bodies| bodies.kept).unwrap_or_default();
            let mut long = None;
            if watches || !short {
                let mean_force = momenta.get(contact).map_or(0.0, |momentum| momentum.mean_force);
                let ahead = Ahead { history: &before, rate, time, step, end, mean_force };
                long = watch::<S>(watched, looks, contact, &ahead);
            }
            if !short {
                let group = group();
                history
                    .step_held(rate, step, &kept(group), || settings.model_at_once(group))
                    .map_err(|deep| too_deep(contact, deep))?;
                // on a branch it neither begins nor ceases to act
                if let Some(guard) = S::guard()
                    && *guarded == Guarded::Unseen
                    && (guard.acts)(history, &settings.model_at_once(group))
                {
                    *guarded = Guarded::Seen;
                }
            }
            if (is_one || !short) && !history.stays_within(settings.depth(group())) {
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
                        .mean_force(&settings.model_at_once(group()), rate, step)
                        .map_err(|deep| too_deep(contact, deep))?,
                };
                momentum.add(mean, step);
            }
        }
        Ok(())
    }

    /// Moves all contacts, along the course of their inputs or by their masses.
    #[cold]
    fn advance_any(&mut self, step: f64) -> Result<(), Fault> {
        let any_curve = self.contacts.curves.as_ref().iter().any(Curve::is_curved);
        let curved = !Self::is_plain() || any_curve || self.any_tangential_curve();
        self.clock.curved |= !Self::is_plain();
        self.check_sharing();
        for contact in 0..S::contacts() {
            self.check_wiring(contact, step);
            let Moved { mut history, course, mean_force, speed, deepest } = self.moved(contact, step)?;
            self.end_step(contact, speed, mean_force, step);
            let allowed = self.depth(contact);
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
        // the end of the step stays known until the next step, which is not plain for this reason
        if !curved {
            self.straighten();
        }
        Ok(())
    }

    /// The state of `contact` after `step` \[s\].
    fn moved(&self, contact: usize, step: f64) -> Result<Moved<S::Contact>, Fault> {
        let (Some(history), Some(&rate)) = (self.histories().get(contact), self.rates().get(contact)) else {
            return Err(Fault::StepSize { step, shortest: Self::shortest() });
        };
        let mut history = *history;
        let mut course = self.contacts.curves.as_ref().get(contact).copied().unwrap_or_default().course(rate);
        let model = self.model(contact);
        let failed = |deep| too_deep(contact, deep);
        if let Some(follow) = S::follow() {
            let mass = self.mass(contact);
            let load = ExternalLoad { mass, acceleration: self.acceleration(contact, course.slope) };
            let speed = rate - self.pending_rate(contact);
            let outcome = follow(&mut history, &model, &load, speed, step).map_err(|reason| match reason {
                NoMotion::TooDeep(deep) => failed(deep),
                NoMotion::TooLong => Fault::TooLong { contact, step },
            })?;
            let mean_force = mass * outcome.speed_removed / step;
            // as if the rate had changed linearly to this value
            let slope = load.acceleration - history.force(outcome.speed) / mass;
            course = RatePolynomial { rate: outcome.speed - slope * step, slope, bend: 0.0 };
            return Ok(Moved { history, course, mean_force, speed: outcome.speed, deepest: outcome.deepest });
        }
        let (deepest, mean_force) = match S::has_momentum() {
            true => history.step_with_mean_force(&course, step, || &*model).map_err(failed)?,
            false => (history.step(&course, step, || &*model).map_err(failed)?, 0.0),
        };
        Ok(Moved { history, course, mean_force, speed: 0.0, deepest })
    }
}
