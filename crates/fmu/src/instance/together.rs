//! Steps of contacts that share bodies: all of them move together.

use super::*;
use brinell_contact::numbers::largest;
use brinell_contact::path::Course;
use brinell_contact::shared::{InverseMasses, Refused};
use brinell_contact::tangential::Quantity;

/// The inverse effective masses of contacts that share bodies \[1/kg\]: the constants of the scene, or these `inputs`.
fn masses_of<S: Scene>(inputs: &S::InverseMasses) -> InverseMasses<'_> {
    let entries = if S::InverseMasses::LENGTH > 0 { inputs.as_ref() } else { S::inverse_masses() };
    InverseMasses::new(S::ROWS, entries).unwrap_or(InverseMasses::NONE)
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
        let mut rates = <S::Rows<f64>>::filled(0.0);
        let mut accelerations = <S::Rows<f64>>::filled(0.0);
        for (row, (rate, acceleration)) in rates.as_mut().iter_mut().zip(accelerations.as_mut()).enumerate() {
            let (contact, direction) = Self::place_of(row);
            let slope = match direction {
                None => {
                    self.check_wiring(contact);
                    self.contacts.curves.as_ref().get(contact).map_or(0.0, |curve| curve.slope)
                }
                Some(direction) => {
                    let history = self.histories().get(contact);
                    history.map_or(0.0, |history| history.tangential_course(direction).slope)
                }
            };
            *rate = self.given_rate(row) - self.owed(row);
            *acceleration = self.acceleration(row, slope);
        }
        self.follow(&accelerations, &mut rates, step)?;
        self.clock.curved = true;
        let mut changes = <S::Rows<f64>>::filled(0.0);
        for (row, (change, &rate)) in changes.as_mut().iter_mut().zip(rates.as_ref()).enumerate() {
            let (contact, direction) = Self::place_of(row);
            let Some(work) = self.contacts.works.as_ref().get(contact) else { continue };
            let (impulse, moment) = match direction {
                None => (work.impulse(), work.moment()),
                Some(direction) => (work.tangential_impulse(direction), work.tangential_moment(direction)),
            };
            *change = self.book(row, rate, impulse / step, step);
            self.contacts.moments.as_mut().get_mut(row).into_iter().for_each(|slot| *slot = moment);
            if direction.is_none() {
                self.note_normal(contact, impulse / step, step);
            }
        }
        let forces = self.forces_of_rows(rates.as_ref());
        let force = |other: usize| forces.as_ref().get(other).copied().unwrap_or(0.0);
        for (row, &rate) in rates.as_ref().iter().enumerate() {
            let jump = self.response(row, |other| changes.as_ref().get(other).copied().unwrap_or(0.0));
            let acceleration = accelerations.as_ref().get(row).copied().unwrap_or(0.0);
            let slope = acceleration - self.response(row, force);
            let (contact, direction) = Self::place_of(row);
            let Contacts { histories, endings, curves, forces, .. } = &mut self.contacts;
            endings.as_mut().get_mut(row).into_iter().for_each(|ending| ending.jump = jump);
            if let Some(direction) = direction {
                let end = Course { rate, slope, bend: 0.0 };
                let history = histories.as_mut().get_mut(contact);
                history.into_iter().for_each(|history| history.set_tangential_end(direction, &end));
                continue;
            }
            // as if the rate had changed linearly to this value
            let course = Course { rate: rate - slope * step, slope, bend: 0.0 };
            curves.as_mut().get_mut(contact).into_iter().for_each(|curve| curve.end_of(&course, step));
            forces.as_mut().get_mut(contact).into_iter().for_each(|slot| *slot = force(row));
        }
        Ok(())
    }

    /// Notes the `mean_force` \[N\] of a `step` \[s\] of `contact`, and how deep it was.
    fn note_normal(&mut self, contact: usize, mean_force: f64, step: f64) {
        let allowed = self.valid_depth(contact);
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

    /// The forces of all rows at these speeds \[m/s\], in N.
    fn forces_of_rows(&self, speeds: &[f64]) -> S::Rows<f64> {
        let mut forces = <S::Rows<f64>>::filled(0.0);
        for (row, (force, &speed)) in forces.as_mut().iter_mut().zip(speeds).enumerate() {
            let (contact, direction) = Self::place_of(row);
            let Some(history) = self.histories().get(contact) else { continue };
            *force = match direction {
                None => history.force(speed),
                Some(direction) => history.tangential(&self.model(contact), Quantity::Force(direction)),
            };
        }
        forces
    }

    /// Moves the histories. `rates` are those at the start \[m/s\], and then at the end.
    fn follow(&mut self, accelerations: &S::Rows<f64>, rates: &mut S::Rows<f64>, step: f64) -> Result<(), Fault> {
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
