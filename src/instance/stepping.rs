//! Steps: the plain one, and any other.

use super::validity::stays_within;
use super::*;

impl Instance {
    /// Moves the contacts from `time` over `step` [s] with the rates held. Then [`Instance::take_deep`] has something to tell, or
    /// not.
    ///
    /// # Errors
    /// [`Fault::StepSize`], [`Fault::CommunicationPoint`], [`Fault::BeyondStopTime`], [`Fault::TooDeep`]; every contact
    /// is then where it was.
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), Fault> {
        self.check_step(time, step)?;
        self.advance(time + step, step)?;
        // it may have been asked to look
        if !self.curved {
            self.limit = self.stop;
        }
        if scene::CONTACTS > 1 && !self.is_deep() {
            self.find_deep();
        }
        Ok(())
    }

    /// The step that nearly every step is: plainly in order, and of one contact on the branch that it is on. It does what
    /// [`Instance::do_step`] does; if it isn't such a step nothing is done, and false.
    #[inline(always)]
    pub fn do_plain_step(&mut self, time: f64, step: f64) -> bool {
        let end = time + step;
        // a step that is zero, negative or NaN is not larger than any distance; without a stop time `stop` is the largest
        // number, so that an infinite step isn't plain
        let follows = (time - self.time).abs() * (1.0 / TIME_TOLERANCE) < step;
        let beyond = end > self.limit;
        let in_order = follows && !beyond;
        if scene::CONTACTS > 1 {
            // what the passivity guard does must be told
            let plain = in_order && PLAIN && scene::GUARD.is_none();
            return plain && self.advance(end, step).is_ok();
        }
        let (Some(history), Some(&rate)) = (self.histories.first_mut(), self.rates.first()) else { return false };
        let from = if scene::MOMENTUM { history.indentation() } else { 0.0 };
        let done = PLAIN && in_order && history.plain_step(rate, step);
        if done {
            for momentum in &mut self.momenta {
                momentum.add(history.mean_force_since(from), step);
            }
            self.last_step.fill(step);
            self.time = end;
        }
        done
    }

    /// Moves all contacts over `step` [s], to the time `end` [s], or none of them.
    #[inline]
    fn advance(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        let ahead = History::FOLLOWS_RATE || self.curved || self.fast || end.abs() > LATE || !PLAIN;
        if scene::CONTACTS > 1 && ahead {
            for contact in 0..scene::CONTACTS {
                self.moved(contact, step)?;
            }
        }
        if self.curved || !PLAIN || History::FOLLOWS_RATE && scene::MOMENTUM {
            self.advance_any(step)?;
        } else {
            self.advance_held(step)?;
        }
        self.last_step.fill(step);
        self.time = end;
        Ok(())
    }

    /// Moves all contacts with their rates held.
    #[inline]
    fn advance_held(&mut self, step: f64) -> Result<(), Fault> {
        let (pairs, values) = (&self.pairs, &self.values);
        for (contact, (history, &rate)) in self.histories.iter_mut().zip(&self.rates).enumerate() {
            let from = if scene::MOMENTUM { history.indentation() } else { 0.0 };
            let before = *history;
            // one contact has been tried before, or is only looked at: its momentum is then that of a plain step, too
            let plain = (scene::CONTACTS > 1 || scene::MOMENTUM) && history.plain_step(rate, step);
            let group = scene::group(contact);
            let bodies = || pairs.get(group).copied().unwrap_or(NO_BODIES);
            let model = || model_of(group, bodies(), values);
            if !plain {
                history.step(rate, step, model).map_err(|deep| too_deep(contact, deep))?;
            }
            let allowed = bodies().depth;
            if (scene::CONTACTS == 1 || !plain) && !stays_within(allowed, history) {
                (self.deep, self.deepest) = (contact as u32 + 1, history.max_indentation());
            }
            if let Some(force) = self.forces.get_mut(contact) {
                *force = history.plain_force(rate, Model::SQUARES);
            }
            if let Some(momentum) = self.momenta.get_mut(contact) {
                let mean = match plain {
                    true => history.mean_force_since(from),
                    false => before
                        .mean_force_along(&Course::held(rate), step, &model())
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
        let curved = !PLAIN || self.curves.iter().any(|curve| curve.slope != 0.0 || curve.bend != 0.0);
        self.curved |= !PLAIN;
        for contact in 0..scene::CONTACTS {
            let Moved { mut history, course, mean_force, deepest } = self.moved(contact, step)?;
            let allowed = self.valid_depth(contact);
            stays_within(allowed, &mut history);
            if deepest >= allowed {
                (self.deep, self.deepest) = (contact as u32 + 1, deepest);
            }
            if let Some(momentum) = self.momenta.get_mut(contact) {
                momentum.add(mean_force, step);
            }
            if let Some(slot) = self.histories.get_mut(contact) {
                *slot = history;
            }
            if let Some(curve) = self.curves.get_mut(contact) {
                curve.end_of(&course, step);
            }
            if let Some(force) = self.forces.get_mut(contact) {
                *force = history.force_at_rate(course.rate);
            }
        }
        // how the step ended is known until the next one, which isn't plain for that reason
        if !curved {
            self.straighten();
        }
        Ok(())
    }

    /// Where `contact` will be after `step` [s].
    fn moved(&self, contact: usize, step: f64) -> Result<Moved, Fault> {
        let (Some(history), Some(&rate)) = (self.histories.get(contact), self.rates.get(contact)) else {
            return Err(Fault::Unavailable);
        };
        let mut history = *history;
        let mut course = self.curves.get(contact).copied().unwrap_or_default().course(rate);
        let model = self.model(contact);
        let failed = |deep| too_deep(contact, deep);
        if let Some(follow) = scene::FOLLOW {
            let mass = scene::parameter(Parameter::EffectiveMass, scene::group(contact), &self.values);
            let drive = Drive { mass, acceleration: course.slope };
            let outcome = follow(&mut history, &model, &drive, rate, step).map_err(|reason| match reason {
                NoMotion::TooDeep(deep) => failed(deep),
                NoMotion::TooLong => Fault::TooLong { step },
            })?;
            let mean_force = mass * outcome.taken / step;
            // as if the rate had gone there in a straight line
            let slope = course.slope - history.force_at_rate(outcome.speed) / mass;
            course = Course { rate: outcome.speed - slope * step, slope, bend: 0.0 };
            return Ok(Moved { history, course, mean_force, deepest: outcome.deepest });
        }
        let mean_force = match scene::MOMENTUM {
            true => history.mean_force_along(&course, step, &model).map_err(failed)?,
            false => 0.0,
        };
        let deepest = history.step_along(&course, step, || model).map_err(failed)?;
        Ok(Moved { history, course, mean_force, deepest })
    }

    fn check_step(&self, time: f64, step: f64) -> Result<(), Fault> {
        if !(step > 0.0 && step < f64::INFINITY) {
            return Err(Fault::StepSize { step });
        }
        let rounding = TIME_ROUNDING * (time.abs() + self.time.abs());
        let follows = time.is_finite() && (time - self.time).abs() <= TIME_TOLERANCE * step + rounding;
        if !follows {
            return Err(Fault::CommunicationPoint { given: time, expected: self.time });
        }
        let end = time + step;
        let in_time = end - self.stop <= STOP_TOLERANCE * step + rounding;
        if !in_time {
            return Err(Fault::BeyondStopTime { end, stop: self.stop });
        }
        Ok(())
    }
}

/// A contact after a step that it has yet to make.
struct Moved {
    history: History,
    /// The course that ends as the step did.
    course: Course,
    mean_force: f64,
    /// The largest indentation on the way [m].
    deepest: f64,
}
