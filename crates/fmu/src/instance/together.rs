//! Steps of contacts that share bodies: all of them move together.

use super::*;
use brinell_contact::numbers::largest;
use brinell_contact::path::Course;
use brinell_contact::shared::{InverseMasses, Refused};

/// The inverse effective masses of contacts that share bodies \[1/kg\]: the constants of the scene, or these `inputs`.
fn masses_of<S: Scene>(inputs: &S::InverseMasses) -> InverseMasses<'_> {
    let entries = if S::InverseMasses::LENGTH > 0 { inputs.as_ref() } else { S::inverse_masses() };
    InverseMasses::new(S::CONTACTS, entries).unwrap_or(InverseMasses::NONE)
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
        if S::InverseMasses::LENGTH == 0 || *checked {
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
        let mut rates = <S::Contacts<f64>>::filled(0.0);
        let mut accelerations = <S::Contacts<f64>>::filled(0.0);
        for (contact, (rate, acceleration)) in rates.as_mut().iter_mut().zip(accelerations.as_mut()).enumerate() {
            self.check_wiring(contact);
            let given = self.rates().get(contact).copied().unwrap_or(0.0);
            let slope = self.contacts.curves.as_ref().get(contact).map_or(0.0, |curve| curve.slope);
            *rate = given - self.owed(contact);
            *acceleration = self.acceleration(contact, slope);
        }
        self.follow(&accelerations, &mut rates, step)?;
        self.clock.curved = true;
        let mut changes = <S::Contacts<f64>>::filled(0.0);
        for (contact, (change, &rate)) in changes.as_mut().iter_mut().zip(rates.as_ref()).enumerate() {
            let Some(work) = self.contacts.works.as_ref().get(contact) else { continue };
            let (impulse, moment, left) = (work.impulse(), work.moment(), work.deepest());
            *change = self.book(contact, rate, impulse / step, step);
            let allowed = self.valid_depth(contact);
            let Contacts { histories, momenta, moments, .. } = &mut self.contacts;
            momenta.as_mut().get_mut(contact).into_iter().for_each(|momentum| momentum.add(impulse / step, step));
            moments.as_mut().get_mut(contact).into_iter().for_each(|slot| *slot = moment);
            let Some(history) = histories.as_mut().get_mut(contact) else { continue };
            history.stays_within(allowed);
            let deepest = largest(history.max_indentation(), left);
            if deepest >= allowed {
                self.note_deep(contact, deepest);
            }
        }
        for (contact, &rate) in rates.as_ref().iter().enumerate() {
            let jump = self.response(contact, |other| changes.as_ref().get(other).copied().unwrap_or(0.0));
            let speed = |other: usize| rates.as_ref().get(other).copied().unwrap_or(0.0);
            let force = |other: usize| self.histories().get(other).map_or(0.0, |history| history.force(speed(other)));
            let acceleration = accelerations.as_ref().get(contact).copied().unwrap_or(0.0);
            let slope = acceleration - self.response(contact, force);
            let Contacts { histories, endings, curves, forces, .. } = &mut self.contacts;
            endings.as_mut().get_mut(contact).into_iter().for_each(|ending| ending.jump = jump);
            // as if the rate had changed linearly to this value
            let course = Course { rate: rate - slope * step, slope, bend: 0.0 };
            curves.as_mut().get_mut(contact).into_iter().for_each(|curve| curve.end_of(&course, step));
            if let (Some(slot), Some(history)) = (forces.as_mut().get_mut(contact), histories.as_ref().get(contact)) {
                *slot = history.force(rate);
            }
        }
        Ok(())
    }

    /// Moves the histories. `rates` are those at the start \[m/s\], and then at the end.
    fn follow(
        &mut self,
        accelerations: &S::Contacts<f64>,
        rates: &mut S::Contacts<f64>,
        step: f64,
    ) -> Result<(), Fault> {
        let Instance { contacts: Contacts { histories, works, inverse_masses, .. }, settings, .. } = self;
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
            Refused::Sizes => Fault::StepSize { step, shortest: Self::SHORTEST },
        })
    }
}
