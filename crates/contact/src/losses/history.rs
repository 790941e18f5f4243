//! The state of a contact with losses.

mod behaviour;
mod shared;

use super::bodies::driven;
use super::held::{Spent, on_segment, on_the_way};
use super::{Damping, Form, Growth, Loss, Model};
use crate::history::path::Sum;
use crate::loading::Loading;
use crate::numerics::{largest, quotient};
use crate::regime::{LARGEST_INDENTATION, Regime, TooDeep};
use crate::unloading::Unloading;
use libm::fabs;

/// The whole state of a contact with losses, and the factor of its loss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct History<K> {
    /// The state of the elastoplastic law.
    pub(super) plastic: crate::History,
    pub(super) loss: K,
    factor: f64,
    /// Largest speed of indentation since the contact began \[m/s\]; zero before.
    pub(super) swiftest: f64,
    /// d2F/d(indentation)^2 of the elastoplastic law where the last step ended \[N/m^2\], if the law has no segments.
    bend: f64,
    /// Energy lost without yield \[J\].
    pub(super) heat: Sum,
}

impl<K: Loss> History<K> {
    /// A contact at `gap` \[m\] before any motion.
    ///
    /// # Errors
    /// [`TooDeep`] as for the [elastoplastic](crate::History::start) contact.
    pub fn start<L: Loading, U: Unloading>(model: &Model<L, U, K>, gap: f64) -> Result<History<K>, TooDeep> {
        let mut history = History {
            plastic: crate::History::start(&model.plastic, gap)?,
            loss: model.loss,
            factor: model.loss.factor(),
            swiftest: 0.0,
            bend: 0.0,
            heat: Sum::new(0.0),
        };
        history.note_bend(model);
        Ok(history)
    }

    /// Whether the bodies are apart.
    pub(super) fn is_apart(&self) -> bool {
        self.plastic.regime() == Regime::Apart
    }

    /// The loss for a motion with speeds of up to `rate` \[m/s\].
    pub(super) fn damping_for(&self, rate: f64) -> Damping {
        // every contact has its own largest speed
        let before = if self.is_apart() { 0.0 } else { self.swiftest };
        let swiftest = match self.loss.is_scaled_by_touch() {
            // before the bodies have closed there is no scale, and no damping
            true if before == 0.0 => {
                if rate > 0.0 {
                    rate
                } else {
                    f64::INFINITY
                }
            }
            true => before,
            false => largest(fabs(rate), before),
        };
        Damping { form: self.loss.form(), factor: self.factor, swiftest }
    }

    /// Moves the contact at `rate` \[m/s\] for `step` \[s\]; the rate of a contact on a plate is that of the other body.
    ///
    /// # Errors
    /// [`TooDeep`] outside the range of the law, and for a heat that overflows; the history is then unchanged.
    pub fn advance<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U, K>,
        rate: f64,
        step: f64,
    ) -> Result<(), TooDeep> {
        let (next, _) = self.moved(model, rate, step)?;
        *self = next;
        Ok(())
    }

    /// The contact after a step, and the impulse of the step \[N.s\].
    ///
    /// # Errors
    /// As for [`History::advance`].
    pub(super) fn moved<L: Loading, U: Unloading>(
        &self,
        model: &Model<L, U, K>,
        rate: f64,
        step: f64,
    ) -> Result<(History<K>, f64), TooDeep> {
        // to the last bit like a short step
        let mut flown = *self;
        if flown.is_apart() && flown.plastic.advance_on_branch(rate * step) {
            return Ok((flown, 0.0));
        }
        if self.loss.form() == Form::Mobility {
            let mut next = *self;
            let impulse = driven(&mut next, model, rate, step)?;
            return Ok((next, impulse));
        }
        let (mut next, increment) = (*self, rate * step);
        let from = self.plastic.indentation();
        next.plastic.advance(&model.plastic, increment)?;
        let to = next.plastic.indentation();
        let damping = self.damping_for(rate);
        let stays =
            !self.is_apart() && self.plastic.branch().contains(from) && next.plastic.branch() == self.plastic.branch();
        let Spent { work, heat } = match stays {
            true => on_segment(self.plastic.branch(), &damping, (from, to), rate),
            false => on_the_way(&self.plastic, &model.plastic, &damping, to, rate)?,
        };
        next.swiftest = if damping.swiftest < f64::INFINITY { damping.swiftest } else { 0.0 };
        next.take(model, heat)?;
        let impulse = quotient(work + heat, rate, increment != 0.0, self.force(rate) * step);
        Ok((next, impulse))
    }

    /// Adds `heat` \[J\] and updates whatever follows from the position.
    ///
    /// # Errors
    /// [`TooDeep`] for a heat that overflows.
    pub(super) fn take<L: Loading, U: Unloading>(&mut self, model: &Model<L, U, K>, heat: f64) -> Result<(), TooDeep> {
        self.heat = self.heat.plus(heat);
        self.note_bend(model);
        let finite = self.heat.total() < f64::INFINITY && fabs(self.plastic.indentation()) < LARGEST_INDENTATION;
        if finite { Ok(()) } else { Err(TooDeep { indentation: self.plastic.indentation() }) }
    }

    /// Keeps the curvature of a law without segments: only the model knows it.
    fn note_bend<L: Loading, U: Unloading>(&mut self, model: &Model<L, U, K>) {
        let follows = |growth: Growth| growth.needs_stiffness();
        let needed =
            matches!(self.loss.form(), Form::Viscous(growth) if follows(growth)) && !model.plastic.is_segmented();
        self.bend = if needed && !self.is_apart() { self.plastic.curvature(&model.plastic) } else { 0.0 };
    }

    /// Force \[N\] and stiffness \[N/m\] of the elastoplastic law.
    fn elastic(&self) -> (f64, f64) {
        if self.is_apart() { (0.0, 0.0) } else { (self.plastic.force(), self.plastic.stiffness()) }
    }

    fn depth(&self) -> f64 {
        self.plastic.indentation()
    }

    /// Normal force at `rate` \[m/s\], in N.
    pub fn force(&self, rate: f64) -> f64 {
        let (force, stiffness) = self.elastic();
        // a dashpot has a force of its own
        if self.is_apart() { 0.0 } else { self.damping_for(rate).force(self.depth(), force, stiffness, rate) }
    }

    /// dF/d(indentation) at constant `rate` \[N/m\].
    pub fn stiffness(&self, rate: f64) -> f64 {
        let (force, stiffness) = self.elastic();
        let damping = self.damping_for(rate);
        match damping.form {
            Form::Mobility => stiffness,
            Form::Proportional => stiffness * damping.gain(rate),
            Form::Viscous(growth) if !self.is_apart() && damping.force(self.depth(), force, stiffness, rate) > 0.0 => {
                let branch = self.plastic.branch();
                // where a power begins, the curvature is infinite, but not its product with the stiffness
                let bend = match self.bend == 0.0 {
                    true if stiffness > 0.0 => branch.curvature(self.plastic.indentation()),
                    _ => self.bend,
                };
                stiffness + damping.factor * growth.slope(self.depth(), stiffness, bend) * rate
            }
            Form::Viscous(_) => 0.0,
        }
    }

    /// dF/d(rate) \[N.s/m\].
    pub fn damping(&self, rate: f64) -> f64 {
        let (force, stiffness) = self.elastic();
        let damping = self.damping_for(rate);
        if self.is_apart() || damping.force(self.depth(), force, stiffness, rate) <= 0.0 {
            return 0.0;
        }
        match damping.form {
            Form::Mobility => 0.0,
            // the fastest motion determines its own scale
            Form::Proportional => {
                let follows = fabs(rate) < self.swiftest || self.swiftest > 0.0 && self.loss.is_scaled_by_touch();
                quotient(force * self.factor, self.swiftest, follows, 0.0)
            }
            Form::Viscous(growth) => growth.times(self.factor, self.depth(), || stiffness),
        }
    }

    /// Whether the passivity guard shortens the unloading path of the present dent.
    pub fn is_held_back<L: Loading, U: Unloading>(&self, model: &Model<L, U, K>) -> bool {
        self.plastic.is_held_back(&model.plastic)
    }

    /// The elastoplastic contact without the loss.
    pub fn plastic(&self) -> &crate::History {
        &self.plastic
    }

    /// The same to change.
    pub(crate) fn elastoplastic_mut(&mut self) -> &mut crate::History {
        &mut self.plastic
    }

    /// The loss, with the largest speed of the present contact.
    pub(crate) fn loss_at_present(&self) -> Damping {
        let swiftest = if self.is_apart() { 0.0 } else { self.swiftest };
        Damping { form: self.loss.form(), factor: self.factor, swiftest }
    }

    /// Adds `heat` \[J\], and notes the largest speed of the present contact \[m/s\].
    ///
    /// # Errors
    /// [`TooDeep`] for a heat that overflows.
    pub(crate) fn add_heat<L: Loading, U: Unloading>(
        &mut self,
        model: &Model<L, U, K>,
        swiftest: f64,
        heat: f64,
    ) -> Result<(), TooDeep> {
        self.swiftest = swiftest;
        self.take(model, heat)
    }

    /// Energy lost without yield \[J\].
    pub fn heat(&self) -> f64 {
        self.heat.total()
    }
}
