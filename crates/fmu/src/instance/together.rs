//! Steps of contacts that share bodies: all of them move together.

use super::*;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::numerics::largest;
use brinell_contact::shared::{InverseMasses, Refused};
use brinell_contact::tangential::Quantity;

/// The inverse effective masses of contacts that share bodies \[1/kg\]: the constants of the scene, or these `inputs`.
fn masses_of<S: Scene>(inputs: &S::InverseMasses) -> InverseMasses<'_> {
    let entries = if S::inverse_mass_inputs() > 0 { inputs.as_ref() } else { S::inverse_masses() };
    InverseMasses::new(S::rows(), entries).unwrap_or(InverseMasses::NONE)
}

/// A number of a row in the working memory of a step.
#[derive(Clone, Copy)]
pub(super) enum Number {
    /// Rate at the start of the step, then at its end \[m/s\].
    Rate,
    /// Acceleration by all forces but those of the contacts \[m/s^2\].
    Acceleration,
    /// Change of the impulse of a step \[N.s\].
    Change,
    /// Force at the end \[N\].
    Force,
}

/// The part of a step that could just be computed that is named instead of it.
const SAFE: f64 = 0.9;

impl<S: Scene> Instance<S> {
    /// The inverse effective masses of contacts that share bodies \[1/kg\].
    pub(super) fn inverse_masses(&self) -> InverseMasses<'_> {
        masses_of::<S>(&self.contacts.inverse_masses)
    }

    /// Checks the inverse masses that are inputs, if they have changed.
    fn check_inverse_masses(&mut self) -> Result<(), Fault> {
        let Contacts { inverse_masses, scratch, checked, .. } = &mut self.contacts;
        if S::inverse_mass_inputs() == 0 || *checked {
            return Ok(());
        }
        masses_of::<S>(inverse_masses).check(scratch.as_mut()).map_err(Fault::InverseMasses)?;
        *checked = true;
        Ok(())
    }

    /// Moves all contacts for `step` \[s\], or none of them.
    #[cold]
    #[inline(never)]
    pub(super) fn advance_together(&mut self, step: f64) -> Result<(), Fault> {
        self.check_inverse_masses()?;
        self.check_sharing();
        for row in 0..S::rows() {
            let (contact, direction) = Self::place_of(row);
            let slope = match direction {
                None => {
                    self.check_wiring(contact, step);
                    self.contacts.curves.as_ref().get(contact).map_or(0.0, |curve| curve.slope)
                }
                Some(direction) => {
                    let history = self.histories().get(contact);
                    history.map_or(0.0, |history| history.tangential_course(direction).slope)
                }
            };
            let rate = self.given_rate(row) - self.pending_rate(row);
            self.note(Number::Rate, row, rate);
            self.note(Number::Acceleration, row, self.acceleration(row, slope));
        }
        self.follow(step)?;
        self.clock.curved = true;
        for row in 0..S::rows() {
            let rate = self.number(Number::Rate, row);
            let (contact, direction) = Self::place_of(row);
            let Some(work) = self.contacts.works.as_ref().get(contact) else { continue };
            let (impulse, moment) = match direction {
                None => (work.impulse(), work.moment()),
                Some(direction) => (work.tangential_impulse(direction), work.tangential_moment(direction)),
            };
            let acceleration = self.number(Number::Acceleration, row);
            let change = self.book(row, rate, impulse / step, acceleration, step);
            self.note(Number::Change, row, change);
            self.contacts.moments.as_mut().get_mut(row).into_iter().for_each(|slot| *slot = moment);
            if direction.is_none() {
                self.note_normal(contact, impulse / step, step);
            }
        }
        for row in 0..S::rows() {
            self.note(Number::Force, row, self.force_at_end(row));
        }
        for row in 0..S::rows() {
            let jump = self.response(row, |other| self.number(Number::Change, other));
            let acceleration = self.number(Number::Acceleration, row);
            let slope = acceleration - self.response(row, |other| self.number(Number::Force, other));
            let [rate, force] = [Number::Rate, Number::Force].map(|number| self.number(number, row));
            let (contact, direction) = Self::place_of(row);
            let Contacts { histories, endings, curves, forces, .. } = &mut self.contacts;
            endings.as_mut().get_mut(row).into_iter().for_each(|ending| ending.jump = jump);
            if let Some(direction) = direction {
                let end = RatePolynomial { rate, slope, bend: 0.0 };
                let history = histories.as_mut().get_mut(contact);
                history.into_iter().for_each(|history| history.set_tangential_end(direction, &end));
                continue;
            }
            // as if the rate had changed linearly to this value
            let course = RatePolynomial { rate: rate - slope * step, slope, bend: 0.0 };
            curves.as_mut().get_mut(contact).into_iter().for_each(|curve| curve.end_of(&course, step));
            forces.as_mut().get_mut(contact).into_iter().for_each(|slot| *slot = force);
        }
        Ok(())
    }

    /// Notes the `mean_force` \[N\] of a `step` \[s\] of `contact`, and how deep it was.
    fn note_normal(&mut self, contact: usize, mean_force: f64, step: f64) {
        let allowed = self.depth(contact);
        let Contacts { histories, momenta, works, .. } = &mut self.contacts;
        momenta.as_mut().get_mut(contact).into_iter().for_each(|momentum| momentum.add(mean_force, step));
        let (Some(history), Some(work)) = (histories.as_mut().get_mut(contact), works.as_ref().get(contact)) else {
            return;
        };
        history.stays_within(allowed);
        let deepest = largest(history.max_indentation(), work.deepest());
        if deepest >= allowed {
            self.note_deep(contact, deepest);
        }
    }

    /// Notes a number of a row in the working memory of a step.
    fn note(&mut self, number: Number, row: usize, value: f64) {
        let slots = self.contacts.numbers.get_mut(number as usize).into_iter();
        slots.filter_map(|slots| slots.as_mut().get_mut(row)).for_each(|slot| *slot = value);
    }

    /// The number that has been noted; zero if there is none.
    fn number(&self, number: Number, row: usize) -> f64 {
        let slots = self.contacts.numbers.get(number as usize);
        slots.and_then(|slots| slots.as_ref().get(row)).copied().unwrap_or(0.0)
    }

    /// The force of a row at its noted rate \[N\].
    fn force_at_end(&self, row: usize) -> f64 {
        let (contact, direction) = Self::place_of(row);
        let Some(history) = self.histories().get(contact) else { return 0.0 };
        match direction {
            None => history.force(self.number(Number::Rate, row)),
            Some(direction) => {
                history.tangential(&self.model(contact), Quantity::Force(direction), self.number(Number::Rate, contact))
            }
        }
    }

    /// Moves the histories. The noted rates are those at the start, and then at the end.
    fn follow(&mut self, step: f64) -> Result<(), Fault> {
        let Instance { contacts: Contacts { histories, works, inverse_masses, numbers, .. }, settings, .. } = self;
        let [rates, accelerations, ..] = numbers;
        let masses = masses_of::<S>(inverse_masses);
        // not kept for all contacts: the stack of an importer may be small
        let model = |contact: usize| settings.model(S::group(contact));
        let (rates, works) = (rates.as_mut(), works.as_mut());
        let followed =
            S::follow_together(histories.as_mut(), model, &masses, accelerations.as_ref(), rates, works, step);
        followed.map(|_| ()).map_err(|reason| match reason {
            Refused::TooDeep(contact, deep) => too_deep(contact, deep),
            Refused::TooLong { left } => Fault::TooLongTogether { step, possible: SAFE * (step - left) },
            // there is one of each for every contact
            Refused::Sizes => Fault::StepSize { step, shortest: Self::shortest() },
        })
    }
}
