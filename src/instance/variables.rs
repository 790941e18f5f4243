//! Reading and setting variables, and their derivatives.

use super::*;

impl Instance {
    /// Whether `variable` of `contact` may be set to `value` now.
    ///
    /// # Errors
    /// [`Fault::NotFinite`], [`Fault::TooFast`], [`Fault::OutOfRange`], [`Fault::NotSettable`], [`Fault::FixedParameter`].
    pub fn check_real(&self, (variable, contact): (Real, usize), value: f64) -> Result<(), Fault> {
        match variable {
            Real::IndentationRate if value.is_finite() => {
                self.histories.get(contact).map_or(Ok(()), |history| check_rate(history, value))
            }
            Real::IndentationRate => Err(Fault::NotFinite { name: "indentation_rate", value }),
            Real::Parameter(index) => self.check_parameter(index, value),
            _ => Err(Fault::NotSettable),
        }
    }

    fn check_parameter(&self, index: usize, value: f64) -> Result<(), Fault> {
        let Some(settable) = scene::SETTABLE.get(index) else { return Err(Fault::NotSettable) };
        if !matches!(self.phase, Phase::Instantiated | Phase::Initialization) {
            return Err(Fault::FixedParameter { name: settable.name });
        }
        if allows(settable, value) { Ok(()) } else { Err(Fault::OutOfRange { settable, value }) }
    }

    /// Sets a variable to a `value` that [`Instance::check_real`] has allowed; true for a parameter, which takes effect
    /// when [`Instance::parameters_are_set`] is called.
    pub fn set_real(&mut self, (variable, contact): (Real, usize), value: f64) -> bool {
        match variable {
            Real::IndentationRate => {
                self.fast |= value.abs() > FAST;
                if let Some(rate) = self.rates.get_mut(contact) {
                    *rate = value;
                }
            }
            Real::Parameter(index) => {
                if let Some(slot) = self.values.get_mut(index) {
                    *slot = value;
                }
            }
            _ => {}
        }
        matches!(variable, Real::Parameter(_))
    }

    /// What is read before the first step follows the parameters set so far. Bodies that don't fit are noticed when
    /// initialization ends: another parameter may still come.
    pub fn parameters_are_set(&mut self) {
        let _ = self.start();
    }

    /// Sets the input of `contact` and reports true if that is all there is to do: the input may be set now, and `rate`
    /// is plain.
    #[inline(always)]
    pub fn set_plain_rate(&mut self, contact: usize, rate: f64) -> bool {
        let (Some(history), Some(slot)) = (self.histories.get(contact), self.rates.get_mut(contact)) else {
            return false;
        };
        // a NaN is not
        let slow = -rate.abs() >= self.lowest_rate;
        let plain = self.phase == Phase::StepComplete && slow && history.is_finite_at_rate(rate);
        if plain {
            *slot = rate;
        }
        plain
    }

    /// Sets the inputs of the contacts from `first` on and reports true, as [`Instance::set_plain_rate`] does; or sets none.
    pub fn set_plain_rates(&mut self, first: usize, rates: &[f64]) -> bool {
        let end = first.wrapping_add(rates.len());
        let (Some(histories), Some(slots)) = (self.histories.get(first..end), self.rates.get_mut(first..end)) else {
            return false;
        };
        let mut plain = self.phase == Phase::StepComplete;
        for (history, &rate) in histories.iter().zip(rates) {
            plain &= -rate.abs() >= self.lowest_rate && (!History::FOLLOWS_RATE || history.is_finite_at_rate(rate));
        }
        if plain {
            for (slot, &rate) in slots.iter_mut().zip(rates) {
                *slot = rate;
            }
        }
        plain
    }

    /// The force of `contact` [N], if outputs are plainly there: during the simulation.
    #[inline(always)]
    pub fn plain_force(&self, contact: usize) -> Option<f64> {
        let force = match self.forces.get(contact) {
            Some(&force) => force,
            None => self.histories.get(contact)?.plain_force(*self.rates.get(contact)?, Model::SQUARES),
        };
        (self.phase == Phase::StepComplete).then_some(force)
    }

    /// Copies the forces [N] of the contacts from `first` on and reports true, if they are there.
    pub fn copy_plain_forces(&self, first: usize, forces: &mut [f64]) -> bool {
        let end = first.wrapping_add(forces.len());
        let (Some(histories), Some(rates)) = (self.histories.get(first..end), self.rates.get(first..end)) else {
            return false;
        };
        if self.phase != Phase::StepComplete {
            return false;
        }
        match self.forces.get(first..end) {
            Some(known) => forces.iter_mut().zip(known).for_each(|(force, &known)| *force = known),
            None => {
                for ((force, history), &rate) in forces.iter_mut().zip(histories).zip(rates) {
                    *force = history.plain_force(rate, Model::SQUARES);
                }
            }
        }
        true
    }

    /// The value of a variable now.
    pub fn real(&self, (variable, contact): (Real, usize)) -> f64 {
        let (Some(history), Some(&rate)) = (self.histories.get(contact), self.rates.get(contact)) else {
            return f64::NAN;
        };
        let model = self.model(contact);
        match variable {
            Real::IndentationRate => rate,
            Real::Force => history.force_at_rate(rate),
            Real::Indentation => history.indentation(),
            Real::MaxIndentation => history.max_indentation(),
            Real::ResidualIndentation => history.residual_indentation(&model),
            Real::ContactRadius => history.contact_radius(&model),
            Real::MeanPressure => history.mean_pressure_at_rate(&model, rate),
            Real::Stiffness => history.stiffness_at_rate(rate),
            Real::Work => history.work(&model),
            Real::ElasticEnergy => history.elastic_energy(&model),
            Real::DissipatedEnergy => history.dissipated_energy(&model),
            Real::Impulse => self.momenta.get(contact).map_or(f64::NAN, Momentum::impulse),
            Real::MeanForce => self.momenta.get(contact).map_or(f64::NAN, |momentum| momentum.mean_force),
            Real::PredictedForce => {
                let mut next = *history;
                let step = self.last_step.first().copied().unwrap_or(0.0);
                let moved = next.step(self.end_of(contact).0, step, || model);
                // where the law ends there is no other force than the present one
                if moved.is_ok() { next.force_at_rate(rate) } else { history.force_at_rate(rate) }
            }
            Real::Parameter(index) => self.values.get(index).copied().unwrap_or(f64::NAN),
        }
    }

    /// Rate [m/s] and its derivative [m/s^2] of `contact` at this moment: how the last step ended, or the input.
    fn end_of(&self, contact: usize) -> (f64, f64) {
        match self.curves.get(contact) {
            Some(curve) if self.curved => (curve.end_rate, curve.end_slope),
            _ => (self.rates.get(contact).copied().unwrap_or(0.0), 0.0),
        }
    }

    /// The derivative of this `order` of the force by time [N/s or N/s^2], at the end of the last step.
    ///
    /// # Errors
    /// [`Fault::NoDerivative`] for another variable, [`Fault::DerivativeOrder`].
    pub fn output_derivative(&self, (variable, contact): (Real, usize), order: i32) -> Result<f64, Fault> {
        if variable != Real::Force {
            return Err(Fault::NoDerivative { of: "force" });
        }
        check_order(order, History::DERIVATIVES)?;
        let (rate, slope) = self.end_of(contact);
        let model = self.model(contact);
        Ok(self.histories.get(contact).map_or(f64::NAN, |history| history.force_derivative(order, rate, slope, &model)))
    }

    /// Whether the derivative of this `order` of an input may be set to `value` now.
    ///
    /// # Errors
    /// [`Fault::NoDerivative`] for another variable, [`Fault::DerivativeOrder`], [`Fault::NotFinite`],
    /// [`Fault::Unsupported`] for a law that follows the rate.
    pub fn check_input_derivative(&self, (variable, _): (Real, usize), order: i32, value: f64) -> Result<(), Fault> {
        if CURVES == 0 {
            return Err(Fault::Unsupported);
        }
        if variable != Real::IndentationRate {
            return Err(Fault::NoDerivative { of: "indentation_rate" });
        }
        check_order(order, INPUT_DERIVATIVES)?;
        if value.is_finite() {
            Ok(())
        } else {
            Err(Fault::NotFinite { name: "a derivative of indentation_rate", value })
        }
    }

    /// Sets a derivative that [`Instance::check_input_derivative`] has allowed; it holds for the next step.
    pub fn set_input_derivative(&mut self, contact: usize, order: i32, value: f64) {
        if let Some(curve) = self.curves.get_mut(contact) {
            *(if order == 1 { &mut curve.slope } else { &mut curve.bend }) = value;
            if value != 0.0 && !self.curved {
                // the ends of contacts that had none
                for (curve, &rate) in self.curves.iter_mut().zip(&self.rates) {
                    (curve.end_rate, curve.end_slope) = (rate, 0.0);
                }
                self.curved = true;
                self.set_limit();
            }
        }
    }

    /// The value of a variable now.
    pub fn integer(&self, (variable, contact): (Integer, usize)) -> i32 {
        match variable {
            Integer::Regime => self.histories.get(contact).map_or(0, |history| history.regime() as i32),
        }
    }
}

/// Up to which order the derivatives of inputs go.
const INPUT_DERIVATIVES: i32 = if scene::FOLLOW.is_some() { 1 } else { 2 };

fn check_order(order: i32, largest: i32) -> Result<(), Fault> {
    if order >= 1 && order <= largest { Ok(()) } else { Err(Fault::DerivativeOrder { order, largest }) }
}
