//! Reading and setting variables.

use super::friction::check_tangential_rate;
use super::*;
use crate::scene::{Integer, Real};
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::shared::NotInverseMasses;

impl<S: Scene> Instance<S> {
    /// Checks whether `variable` of `contact` may be set to `value` now.
    ///
    /// # Errors
    /// [`Fault::NotFinite`], [`Fault::RateOutOfRange`], [`Fault::AccelerationOutOfRange`], [`Fault::TooFast`],
    /// [`Fault::OutOfRange`], [`Fault::InputOutOfRange`], [`Fault::InverseMasses`], [`Fault::NotSettable`],
    /// [`Fault::FixedParameter`].
    pub fn check_real(&self, (variable, contact): (Real, usize), value: f64) -> Result<(), Fault> {
        match variable {
            Real::IndentationRate if !value.is_finite() => Err(Fault::NotFinite { name: "indentation_rate", value }),
            Real::IndentationRate if value.abs() > FASTEST => Err(Fault::RateOutOfRange { rate: value }),
            Real::IndentationRate => {
                self.histories().get(contact).map_or(Ok(()), |history| check_rate::<S>(history, value))
            }
            Real::Parameter(index) => self.check_parameter(index, value),
            // instead of a contact, it has a place in the matrix
            Real::InverseMass if S::has_input(variable) => {
                let (row, column) = self.inverse_masses().row_and_column(contact);
                // a zero on the diagonal is not known yet: a step refuses it
                let in_range = match row == column {
                    true => value == 0.0 || is_mass(value),
                    false => value.abs() <= *MASSES.end(),
                };
                if in_range {
                    Ok(())
                } else {
                    Err(Fault::InverseMasses(NotInverseMasses::Entry { row, column, value }))
                }
            }
            _ if !S::has_input(variable) => Err(Fault::NotSettable),
            _ if S::Contact::HAS_FRICTION && variable.tangential_rate().is_some() => match value.is_finite() {
                true => check_tangential_rate(value),
                false => Err(Fault::NotFinite { name: "tangential_rate", value }),
            },
            // an importer that connects FMUs passes on what is not known yet
            Real::EffectiveMass if value == 0.0 && self.is_before_start() => Ok(()),
            _ => check_input(variable, value),
        }
    }

    fn is_before_start(&self) -> bool {
        matches!(self.phase(), Phase::Instantiated | Phase::Initialization)
    }

    fn check_parameter(&self, index: usize, value: f64) -> Result<(), Fault> {
        let Some((settable, _)) = S::settable(index) else { return Err(Fault::NotSettable) };
        if !self.is_before_start() && !S::is_tunable(index) {
            return Err(Fault::FixedParameter { index });
        }
        if allows(&settable, value) { Ok(()) } else { Err(Fault::OutOfRange { index, value }) }
    }

    /// Sets a variable to a `value` that [`Instance::check_real`] has accepted. Returns true for a parameter, which takes
    /// effect when [`Instance::parameters_are_set`] is called.
    pub fn set_real(&mut self, (variable, contact): (Real, usize), value: f64) -> bool {
        if S::Contact::HAS_FRICTION
            && let Some(direction) = variable.tangential_rate()
        {
            self.set_tangential_rate(contact, direction, value);
            return false;
        }
        let slot = match variable {
            Real::IndentationRate => self.contacts.rates.as_mut().get_mut(contact),
            Real::EffectiveMass => self.contacts.masses.as_mut().get_mut(contact),
            Real::InverseMass => {
                self.contacts.checked = false;
                self.contacts.inverse_masses.as_mut().get_mut(contact)
            }
            Real::Parameter(index) => self.settings.values.as_mut().get_mut(index),
            _ => variable
                .external_acceleration()
                .and_then(|row| self.contacts.accelerations.as_mut().get_mut(row * S::contacts() + contact)),
        };
        if let Some(slot) = slot {
            *slot = value;
        }
        matches!(variable, Real::Parameter(_))
    }

    /// Applies the parameters. Outputs that are read before the first step follow them. If the bodies do not fit together, this
    /// is detected only at the end of initialization, because other parameters may still follow. Parameters set between steps
    /// apply to the next steps.
    pub fn parameters_are_set(&mut self) {
        if S::moves() && self.phase() == Phase::StepComplete {
            self.stamp_parameters();
            return;
        }
        let _ = self.start();
    }

    /// Sets the input of `contact` and returns true, provided that `rate` needs no further checks and the input may be set now.
    #[inline(always)]
    pub fn set_plain_rate(&mut self, contact: usize, rate: f64) -> bool {
        let Contacts { histories, rates, .. } = &mut self.contacts;
        let (Some(history), Some(slot)) = (histories.as_ref().get(contact), rates.as_mut().get_mut(contact)) else {
            return false;
        };
        let plain = self.clock.takes_rate(rate) && check_rate::<S>(history, rate).is_ok();
        if plain {
            *slot = rate;
        }
        plain
    }

    /// Like [`Instance::set_plain_rate`] for the contacts from `first` on. It sets all of them or none.
    pub fn set_plain_rates(&mut self, first: usize, rates: &[f64]) -> bool {
        let end = first.wrapping_add(rates.len());
        let Contacts { histories, rates: slots, .. } = &mut self.contacts;
        let (Some(histories), Some(slots)) = (histories.as_ref().get(first..end), slots.as_mut().get_mut(first..end))
        else {
            return false;
        };
        let mut plain = true;
        for (history, &rate) in histories.iter().zip(rates) {
            plain &= self.clock.takes_rate(rate) && check_rate::<S>(history, rate).is_ok();
        }
        if plain {
            for (slot, &rate) in slots.iter_mut().zip(rates) {
                *slot = rate;
            }
        }
        plain
    }

    /// The force of `contact` \[N\], if it can be read without further checks: during the simulation.
    #[inline(always)]
    pub fn plain_force(&self, contact: usize) -> Option<f64> {
        let force = match self.contacts.forces.as_ref().get(contact) {
            Some(&force) => force,
            None => self.histories().get(contact)?.force(self.shown_rate(contact)?),
        };
        (self.clock.phase == Phase::StepComplete).then_some(force)
    }

    /// Copies the forces \[N\] of the contacts from `first` on and returns true, if they are stored.
    pub fn copy_plain_forces(&self, first: usize, forces: &mut [f64]) -> bool {
        let end = first.wrapping_add(forces.len());
        let Some(histories) = self.histories().get(first..end) else { return false };
        if self.phase() != Phase::StepComplete {
            return false;
        }
        match self.contacts.forces.as_ref().get(first..end) {
            Some(known) => forces.iter_mut().zip(known).for_each(|(force, &known)| *force = known),
            None => {
                for (contact, (force, history)) in (first..end).zip(forces.iter_mut().zip(histories)) {
                    *force = history.force(self.shown_rate(contact).unwrap_or(0.0));
                }
            }
        }
        true
    }

    /// The speed of a row of bodies that the FMU moves \[m/s\]; `None` before the initialization ends.
    #[inline(always)]
    pub(super) fn own_speed(&self, row: usize) -> Option<f64> {
        let has_started = !matches!(self.phase(), Phase::Instantiated | Phase::Initialization);
        self.contacts.endings.as_ref().get(row).filter(|_| has_started).map(|ending| ending.speed)
    }

    /// The rate at which outputs that follow it are shown \[m/s\]: the speed of bodies that the FMU moves, otherwise the input.
    #[inline(always)]
    pub(super) fn shown_rate(&self, contact: usize) -> Option<f64> {
        let own = if S::moves() && S::follows_rate() { self.own_speed(contact) } else { None };
        own.or_else(|| self.rates().get(contact).copied())
    }

    /// The present value of a variable.
    pub fn real(&self, (variable, contact): (Real, usize)) -> f64 {
        if variable == Real::InverseMass {
            return self.contacts.inverse_masses.as_ref().get(contact).copied().unwrap_or(f64::NAN);
        }
        let (Some(history), Some(&rate)) = (self.histories().get(contact), self.rates().get(contact)) else {
            return f64::NAN;
        };
        let momentum = || self.contacts.momenta.as_ref().get(contact);
        // only some outputs need it
        let model = || self.model(contact);
        let shown = self.shown_rate(contact).unwrap_or(rate);
        match variable {
            Real::IndentationRate => rate,
            Real::Force => history.force(shown),
            Real::Indentation => history.indentation(),
            Real::MaxIndentation => history.max_indentation(),
            Real::Work => history.work(&model()),
            Real::Stiffness => history.stiffness(shown),
            Real::Impulse => momentum().map_or(f64::NAN, Momentum::impulse),
            Real::MeanForce => match self.contacts.endings.as_ref().get(contact) {
                Some(ending) => ending.force,
                None => momentum().map_or(f64::NAN, |momentum| momentum.mean_force),
            },
            Real::ImpulseMoment => self.moment(contact),
            Real::TangentialImpulseMoment => self.moment(S::contacts() + contact),
            Real::SecondTangentialImpulseMoment => self.moment(2 * S::contacts() + contact),
            Real::TangentialSpeed => self.speed_of_row(S::contacts() + contact),
            Real::SecondTangentialSpeed => self.speed_of_row(2 * S::contacts() + contact),
            // of bodies that the FMU moves, the force that the importer applies
            Real::MeanTangentialForce if S::is_shared() => self.force_of_row(S::contacts() + contact),
            Real::SecondMeanTangentialForce if S::is_shared() => self.force_of_row(2 * S::contacts() + contact),
            Real::PredictedForce => self.predicted_force(contact, history),
            Real::ClosingSpeed if S::moves() => self.speed_of_row(contact),
            Real::RegimeNumber => self.integer((Integer::Regime, contact)).into(),
            Real::SlidingNumber => self.integer((Integer::Sliding, contact)).into(),
            Real::EffectiveMass if S::has_input(variable) => self.mass(contact),
            Real::TangentialRate => history.tangential_course(0).rate,
            Real::SecondTangentialRate => history.tangential_course(1).rate,
            Real::PredictedTangentialForce | Real::SecondPredictedTangentialForce => {
                match variable.predicted_direction() {
                    Some(direction) if S::Contact::HAS_FRICTION => {
                        self.predicted_tangential_force(contact, direction, &model(), rate)
                    }
                    _ => f64::NAN,
                }
            }
            Real::ClosingSpeed | Real::EffectiveMass | Real::InverseMass => f64::NAN,
            Real::ExternalAcceleration
            | Real::ExternalTangentialAcceleration
            | Real::SecondExternalTangentialAcceleration => match variable.external_acceleration() {
                Some(row) if S::has_input(variable) => self.acceleration(row * S::contacts() + contact, f64::NAN),
                _ => f64::NAN,
            },
            Real::Parameter(index) => self.settings.values.as_ref().get(index).copied().unwrap_or(f64::NAN),
            output => match output.quantity() {
                Some(quantity) => history.tangential(&model(), quantity, shown),
                None => of_state::<S>(output, history, &model(), shown),
            },
        }
    }

    /// The moment of the impulse of a row over the last step \[N.s^2\].
    fn moment(&self, row: usize) -> f64 {
        self.contacts.moments.as_ref().get(row).copied().unwrap_or(f64::NAN)
    }

    /// The speed of a row at the end of the last step \[m/s\]; before the first one, the given rate.
    fn speed_of_row(&self, row: usize) -> f64 {
        self.own_speed(row).unwrap_or_else(|| self.given_rate(row))
    }

    /// The mean force of a row that the importer applies \[N\].
    fn force_of_row(&self, row: usize) -> f64 {
        self.contacts.endings.as_ref().get(row).map_or(f64::NAN, |ending| ending.force)
    }

    /// The force \[N\] of `contact`, with the state `history`, at the end of a next step as long as the last one.
    fn predicted_force(&self, contact: usize, history: &S::Contact) -> f64 {
        let rate = self.shown_rate(contact).unwrap_or(0.0);
        let end_rate = self.end_of(contact).0;
        // on the branch, a copy of a few numbers is enough
        let mut next = *history;
        match next.short_step(end_rate * self.last_step()) {
            true => next.force(rate),
            false => self.predicted(contact, &self.model(contact), end_rate).map_or(f64::NAN, |next| next.force(rate)),
        }
    }

    /// `contact` at the end of a next step as long as the last one, at `rate` \[m/s\]. Where the law ends, the state does not
    /// change.
    #[inline(never)]
    pub(super) fn predicted(&self, contact: usize, model: &S::Model, rate: f64) -> Option<S::Contact> {
        let history = *self.histories().get(contact)?;
        let mut next = history;
        for direction in 0..S::Contact::DIRECTIONS {
            next.set_tangential_course(
                direction,
                &RatePolynomial::held(self.tangential_end_of(contact, direction).rate),
            );
        }
        let step = self.last_step();
        if S::Contact::FINDS_STRENGTH {
            next.meet(model, self.mass(contact), rate);
        }
        let moved =
            next.short_step(rate * step) || next.step_held(rate, step, &S::Contact::kept(model), || model).is_ok();
        Some(if moved { next } else { history })
    }

    /// Length of the last step \[s\], if a force is predicted from it.
    pub(super) fn last_step(&self) -> f64 {
        self.contacts.last_step.as_ref().first().copied().unwrap_or(0.0)
    }

    /// Rate \[m/s\] and its derivative \[m/s^2\] of `contact` at the present time: from the end of the last step, or the input.
    pub(super) fn end_of(&self, contact: usize) -> (f64, f64) {
        match self.contacts.curves.as_ref().get(contact) {
            Some(curve) if self.clock.curved => (curve.end_rate, curve.end_slope),
            _ => (self.shown_rate(contact).unwrap_or(0.0), 0.0),
        }
    }

    /// The present value of a variable.
    pub fn integer(&self, (variable, contact): (Integer, usize)) -> i32 {
        match variable {
            Integer::Regime => self.histories().get(contact).map_or(0, |history| history.regime() as i32),
            Integer::Sliding => self.histories().get(contact).map_or(0, |history| history.sliding() as i32),
        }
    }
}

/// The output that is a function of the state of a `contact` at this `rate` \[m/s\]. Its derivatives by time follow from it. NaN for
/// other variables.
#[inline(always)]
pub(super) fn of_state<S: Scene>(output: Real, contact: &S::Contact, model: &S::Model, rate: f64) -> f64 {
    match output {
        Real::ResidualIndentation => contact.residual_indentation(model),
        Real::ContactRadius => contact.contact_radius(model),
        Real::ContactArea => contact.contact_area(model),
        Real::MeanPressure => contact.mean_pressure(model, rate),
        Real::Stiffness => contact.stiffness(rate),
        Real::ElasticEnergy => contact.elastic_energy(model),
        Real::DissipatedEnergy => contact.dissipated_energy(model),
        _ => f64::NAN,
    }
}

/// Checks whether an input other than the rate may have this `value`.
fn check_input(variable: Real, value: f64) -> Result<(), Fault> {
    match variable {
        Real::EffectiveMass if !is_mass(value) => Err(Fault::InputOutOfRange { input: variable, value }),
        _ if variable.external_acceleration().is_some() => {
            let is_normal = variable == Real::ExternalAcceleration;
            let name = if is_normal { "external_acceleration" } else { "external_tangential_acceleration" };
            check_acceleration(name, "m/s^2", value)
        }
        _ => Ok(()),
    }
}
