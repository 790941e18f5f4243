//! The other inputs of a contact with friction: its tangential rates.
//!
//! The contact itself keeps it, since every step needs it. It survives a new start of the contact, as inputs do.

use super::*;
use crate::scene::Real;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::tangential::Quantity;

impl<S: Scene> Instance<S> {
    /// Sets the tangential rate of `contact` in this `direction` \[m/s\].
    pub(super) fn set_tangential_rate(&mut self, contact: usize, direction: usize, rate: f64) {
        if let Some(history) = self.contacts.histories.as_mut().get_mut(contact) {
            history.set_tangential_course(direction, &RatePolynomial { rate, ..history.tangential_course(direction) });
        }
    }

    /// Sets the derivative of this `order` of the tangential rate of `contact` in this `direction` over the next step.
    pub(super) fn set_tangential_derivative(&mut self, contact: usize, direction: usize, order: i32, value: f64) {
        if let Some(history) = self.contacts.histories.as_mut().get_mut(contact) {
            let mut course = history.tangential_course(direction);
            *(if order == 1 { &mut course.slope } else { &mut course.bend }) = value;
            history.set_tangential_course(direction, &course);
        }
    }

    /// Discards the tangential rates.
    pub(super) fn forget_tangential_rates(&mut self) {
        for history in self.contacts.histories.as_mut() {
            for direction in 0..S::Contact::DIRECTIONS {
                history.set_tangential_course(direction, &RatePolynomial::held(0.0));
            }
        }
    }

    /// Whether the tangential rate of a contact changes during the next step.
    pub(super) fn any_tangential_curve(&self) -> bool {
        let is_held = |history: &S::Contact, direction| history.tangential_course(direction).is_held();
        (0..S::Contact::DIRECTIONS).any(|direction| !self.histories().iter().all(|history| is_held(history, direction)))
    }

    /// The tangential rate of `contact` in this `direction` at the present time: from the end of the last step, or the input.
    pub(super) fn tangential_end_of(&self, contact: usize, direction: usize) -> RatePolynomial {
        match self.histories().get(contact) {
            Some(history) if self.clock.curved => history.tangential_end(direction),
            Some(history) => RatePolynomial::held(history.tangential_course(direction).rate),
            None => RatePolynomial::held(0.0),
        }
    }

    /// The tangential force \[N\] of `contact` in this `direction` at the end of a next step as long as the last one; without
    /// a derivative of the input, at the present `rate` \[m/s\].
    pub(super) fn predicted_tangential_force(
        &self,
        contact: usize,
        direction: usize,
        model: &S::Model,
        rate: f64,
    ) -> f64 {
        let rate = if self.clock.curved { self.end_of(contact).0 } else { rate };
        let next = self.predicted(contact, model, rate);
        next.map_or(f64::NAN, |next| next.tangential(model, Quantity::Force(direction), rate))
    }

    /// Checks the tangential rates during the next `step` \[s\].
    ///
    /// # Errors
    /// [`Fault::InputOutOfRange`]
    pub(super) fn check_tangential_rates(&self, step: f64) -> Result<(), Fault> {
        if !S::Contact::HAS_FRICTION || !self.clock.curved {
            return Ok(());
        }
        for (history, direction) in self
            .histories()
            .iter()
            .flat_map(|history| (0..S::Contact::DIRECTIONS).map(move |direction| (history, direction)))
        {
            let RatePolynomial { rate, slope, bend } = history.tangential_course(direction);
            let largest = rate.abs() + step * (slope.abs() + 0.5 * bend.abs() * step);
            check_tangential_rate(largest)?;
        }
        Ok(())
    }
}

/// Checks whether a tangential rate may have this value \[m/s\].
pub(super) fn check_tangential_rate(rate: f64) -> Result<(), Fault> {
    // false for NaN
    if rate.abs() <= FASTEST {
        Ok(())
    } else {
        Err(Fault::InputOutOfRange { input: Real::TangentialRate, value: rate })
    }
}
