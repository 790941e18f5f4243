//! What a contact that moves its bodies remembers for its importer: how the last step ended, and the momentum in transit.
//!
//! A *serial* importer (Gauss-Seidel) steps the contact first and applies its force over the same step. A *parallel* importer
//! (Jacobi) steps all FMUs at once: over a step, it applies the force that the contact showed before that step. The contact
//! therefore keeps an account. Its debt is the impulse that it has given and the importer has not applied. The bodies really close
//! at the given rate less debt over mass. A step adds the impulse of the contact to the debt and subtracts what the importer has
//! applied. The force to apply over the next step is the debt over the length of a step. Momentum is neither lost nor given twice,
//! however long the steps are.

use super::*;
use crate::contact::words::{load_numbers, store_numbers};
use crate::scene::Real;

/// How the last step ended, as the master has been told.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ending {
    /// Closing speed that the bodies had reached \[m/s\].
    pub speed: f64,
    /// Force to apply: over the step that has been made by a serial master, over the next one by a parallel one \[N\].
    pub force: f64,
    /// Speed that the change of that force makes in a step of the same length \[m/s\]: what a master with the other order of
    /// execution adds or takes.
    pub jump: f64,
}

impl Ending {
    /// Number of words that hold an ending.
    pub const WORDS: usize = 3;

    /// A contact before any motion, with this `force` \[N\].
    pub fn start(force: f64) -> Ending {
        Ending { speed: 0.0, force, jump: 0.0 }
    }

    pub fn save(&self, store: &mut impl FnMut(u64)) {
        store_numbers(&[self.speed, self.force, self.jump], store);
    }

    /// The ending that [`Ending::save`] has stored; `None` if a word is not a finite number.
    pub fn load(words: &mut impl Iterator<Item = u64>) -> Option<Ending> {
        let [speed, force, jump] = load_numbers(words)?;
        Some(Ending { speed, force, jump })
    }
}

/// The account of momentum between a contact and a parallel master.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Account {
    /// Impulse that the contact has given and the master has not applied yet \[N.s\].
    pub debt: f64,
    /// How long the next step is taken to be at least \[s\].
    span: f64,
}

/// What of the longest step is kept in mind from step to step. A debt over a short step, applied over a long one, would come
/// back larger; steps that alternate would let it grow.
const FADING: f64 = 0.75;

impl Account {
    /// Number of words that hold an account.
    pub const WORDS: usize = 2;

    /// Books a step \[s\] in which the contact has given `impulse` \[N.s\] and the master has applied the force `applied` \[N\].
    /// The result is the force to apply over the next step \[N\].
    fn book(&mut self, impulse: f64, applied: f64, step: f64) -> f64 {
        self.debt += impulse - applied * step;
        let longest = if step > self.span { step } else { self.span };
        let faded = FADING * longest;
        self.span = if step > faded { step } else { faded };
        let force = self.debt / longest;
        // a debt waits for steps that are long enough for it
        if force.is_finite() { force } else { 0.0 }
    }

    pub fn save(&self, store: &mut impl FnMut(u64)) {
        store_numbers(&[self.debt, self.span], store);
    }

    /// The account that [`Account::save`] has stored; `None` if a word is not a finite number.
    pub fn load(words: &mut impl Iterator<Item = u64>) -> Option<Account> {
        let [debt, span] = load_numbers(words)?;
        Some(Account { debt, span })
    }
}

/// A change of speed below this part of the speeds themselves says nothing of the master.
const TELLING: f64 = 1e-6;

/// Rounding of a master's own sums, as a part of such a change.
const ROUNDING: f64 = 1e-8;

impl<S: Scene> Instance<S> {
    /// Whether the unit moves the bodies.
    pub(super) const MOVES: bool = <S::Coupling as Coupling>::Ending::IS_PRESENT;

    /// Effective mass of `contact` \[kg\].
    pub(super) fn mass(&self, contact: usize) -> f64 {
        match self.contacts.masses.as_ref().get(contact) {
            Some(&mass) if S::has_input(Real::EffectiveMass) => mass,
            _ => S::parameter(Parameter::EffectiveMass, S::group(contact), &self.settings.values),
        }
    }

    /// Closing acceleration of `contact` by all forces but its own \[m/s^2\]: the input, where there is one, or else the `slope`
    /// of the rate.
    pub(super) fn acceleration(&self, contact: usize, slope: f64) -> f64 {
        match self.contacts.accelerations.as_ref().get(contact) {
            Some(&acceleration) if S::has_input(Real::ExternalAcceleration) => acceleration,
            _ => slope,
        }
    }

    /// What of the given rate of `contact` is momentum that the master has yet to take off \[m/s\].
    pub(super) fn owed(&self, contact: usize) -> f64 {
        self.contacts.accounts.as_ref().get(contact).map_or(0.0, |account| account.debt / self.mass(contact))
    }

    /// Notes how a step of `contact` ended that was `step` \[s\] long: with this `speed` \[m/s\], after this `mean_force` \[N\].
    pub(super) fn end_step(&mut self, contact: usize, speed: f64, mean_force: f64, step: f64) {
        let mass = self.mass(contact);
        let Contacts { endings, accounts, .. } = &mut self.contacts;
        let Some(ending) = endings.as_mut().get_mut(contact) else { return };
        let force = match accounts.as_mut().get_mut(contact) {
            Some(account) => account.book(mean_force * step, ending.force, step),
            None => mean_force,
        };
        *ending = Ending { speed, force, jump: (force - ending.force) * step / mass };
    }

    /// Looks whether the rate that `contact` is given for the next step is that of a master with the other order of execution.
    pub(super) fn check_wiring(&mut self, contact: usize) {
        let (Some(ending), Some(&rate)) = (self.contacts.endings.as_ref().get(contact), self.rates().get(contact))
        else {
            return;
        };
        let expected = ending.speed + self.owed(contact);
        // a serial master has applied the new force already, a parallel one still the old one
        let other = if is_parallel::<S>() { -ending.jump } else { ending.jump };
        let size = rate.abs() + ending.speed.abs() + expected.abs();
        if other.abs() > TELLING * size && (rate - expected - other).abs() <= ROUNDING * other.abs() {
            let wiring = Miswired { contact: contact as u32 + 1, rate, expected };
            self.contacts.miswired.as_mut().fill(wiring);
        }
    }

    /// Whether the last step began with the rate of a master with the other order of execution; the warning, once.
    pub fn take_miswired(&mut self) -> Option<Warning> {
        let Miswired { contact, rate, expected } = core::mem::take(self.contacts.miswired.as_mut().first_mut()?);
        let contact = contact.checked_sub(1)? as usize;
        Some(Warning::Miswired { contact, rate, expected, parallel: is_parallel::<S>() })
    }
}

/// Whether the scene is made for a master that steps all units at once.
fn is_parallel<S: Scene>() -> bool {
    <S::Coupling as Coupling>::Account::IS_PRESENT
}

/// A contact whose rate was that of a master with the other order of execution, until its user hears of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Miswired {
    /// The contact, counted from 1; 0 is none.
    contact: u32,
    /// The rate that was given \[m/s\].
    rate: f64,
    /// The rate that was expected \[m/s\].
    expected: f64,
}
