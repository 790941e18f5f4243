//! The data that a contact of known mass keeps for its importer: how the last step ended, and the momentum in transit.
//!
//! A *serial* importer (Gauss-Seidel) steps the contact first and applies its force over the same step. A *parallel* importer
//! (Jacobi) steps all FMUs at once: over a step, it applies the force that the contact showed before that step. The contact
//! therefore keeps an account. Its debt is the impulse that the contact has exerted and the importer has not yet applied. The
//! bodies actually close at the given rate minus debt over mass. A step adds the impulse of the contact to the debt and
//! subtracts what the importer has applied. The force to apply over the next step is the debt over the length of a step.
//! Momentum is neither lost nor applied twice, however long the steps are.

use super::*;
use crate::scene::Real;
use brinell_contact::numerics::quotient;
use brinell_contact::numerics::words::{load_numbers, store_numbers};

/// The end of the last step, as reported to the importer.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ending {
    /// Closing speed of the bodies at the end \[m/s\].
    pub speed: f64,
    /// Force to apply \[N\]: over the same step by a serial importer, over the next step by a parallel one.
    pub force: f64,
    /// Change of speed that the change of this force causes in a step of the same length \[m/s\]. An importer with the other
    /// order of execution adds or subtracts it.
    pub jump: f64,
    /// The rate that the importer gives next if it applies no contact force \[m/s\].
    pub free: f64,
}

impl Ending {
    /// Number of words that hold an ending.
    pub const WORDS: usize = 4;

    /// A contact before any motion, with this `force` \[N\].
    pub fn start(force: f64) -> Ending {
        Ending { speed: 0.0, force, jump: 0.0, free: 0.0 }
    }

    pub fn save(&self, store: &mut impl FnMut(u64)) {
        store_numbers(&[self.speed, self.force, self.jump, self.free], store);
    }

    /// The ending that [`Ending::save`] has stored; `None` if a word is not a finite number.
    pub fn load(words: &mut impl Iterator<Item = u64>) -> Option<Ending> {
        let [speed, force, jump, free] = load_numbers(words)?;
        Some(Ending { speed, force, jump, free })
    }
}

/// The account of momentum between a contact and a parallel importer.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Account {
    /// Impulse that the contact has exerted and the importer has not yet applied \[N.s\].
    pub pending_impulse: f64,
    /// Lower limit of the assumed length of the next step \[s\].
    span: f64,
}

/// Factor by which the longest step fades from step to step. A debt divided by a short step and applied over a long one would
/// come back larger, and alternating step sizes would let it grow.
const FADING: f64 = 0.75;

impl Account {
    /// Number of words that hold an account.
    pub const WORDS: usize = 2;

    /// Records a step \[s\] in which the contact has exerted `impulse` \[N.s\] and the importer has applied the force `applied`
    /// \[N\]. Returns the force to apply over the next step \[N\].
    fn book(&mut self, impulse: f64, applied: f64, step: f64) -> f64 {
        self.pending_impulse += impulse - applied * step;
        let longest = if step > self.span { step } else { self.span };
        let faded = FADING * longest;
        self.span = if step > faded { step } else { faded };
        let force = self.pending_impulse / longest;
        // the debt remains until steps are long enough for it
        if force.is_finite() { force } else { 0.0 }
    }

    pub fn save(&self, store: &mut impl FnMut(u64)) {
        store_numbers(&[self.pending_impulse, self.span], store);
    }

    /// The account that [`Account::save`] has stored; `None` if a word is not a finite number.
    pub fn load(words: &mut impl Iterator<Item = u64>) -> Option<Account> {
        let [pending_impulse, span] = load_numbers(words)?;
        Some(Account { pending_impulse, span })
    }
}

impl<S: Scene> Instance<S> {
    /// Effective mass of `contact` \[kg\]. Of contacts that share bodies, it is that of this contact alone.
    pub(super) fn mass(&self, contact: usize) -> f64 {
        if S::is_shared() {
            let inverse = self.inverse_masses().of(contact, contact);
            return quotient(1.0, inverse, inverse > 0.0, f64::MAX);
        }
        match self.contacts.masses.as_ref().get(contact) {
            Some(&mass) if S::has_input(Real::EffectiveMass) => mass,
            _ => S::parameter(Parameter::EffectiveMass, S::group(contact), &self.settings.values),
        }
    }

    /// Acceleration of a row by all forces except the contact forces \[m/s^2\]: the input if there is one, otherwise the `slope` of
    /// the rate.
    pub(super) fn acceleration(&self, row: usize, slope: f64) -> f64 {
        match self.contacts.accelerations.as_ref().get(row) {
            Some(&acceleration) if S::has_input(Real::ExternalAcceleration) => acceleration,
            _ => slope,
        }
    }

    /// The part of the given rate of a row that the importer has yet to remove \[m/s\].
    pub(super) fn pending_rate(&self, row: usize) -> f64 {
        let accounts = self.contacts.accounts.as_ref();
        match S::is_parallel() {
            true => self.response(row, |other| accounts.get(other).map_or(0.0, |account| account.pending_impulse)),
            false => 0.0,
        }
    }

    /// The change of the speed of a row by these impulses \[N.s\] of all rows of contacts that share its bodies: how much it
    /// loses \[m/s\]. With forces \[N\], it is an acceleration.
    pub(super) fn response(&self, row: usize, impulse: impl Fn(usize) -> f64) -> f64 {
        if !S::is_shared() {
            return impulse(row) / self.mass(row);
        }
        let masses = self.inverse_masses();
        (0..S::rows()).map(|other| masses.of(row, other) * impulse(other)).sum()
    }

    /// Records the end of a `step` \[s\] of `contact`: its `speed` \[m/s\] and its `mean_force` \[N\].
    pub(super) fn end_step(&mut self, contact: usize, speed: f64, mean_force: f64, step: f64) {
        let mass = self.mass(contact);
        let slope = self.contacts.curves.as_ref().get(contact).map_or(0.0, |curve| curve.slope);
        let change = self.book(contact, speed, mean_force, self.acceleration(contact, slope), step);
        if let Some(ending) = self.contacts.endings.as_mut().get_mut(contact) {
            ending.jump = change / mass;
        }
    }

    /// Records the end of a step with this `acceleration` by all other forces \[m/s^2\], except for the jump, and returns the change of
    /// the impulse of a step that causes it \[N.s\].
    pub(super) fn book(&mut self, row: usize, speed: f64, mean_force: f64, acceleration: f64, step: f64) -> f64 {
        let rate = self.given_rate(row);
        let free = rate + acceleration * step;
        let free = if free.is_finite() { free } else { rate };
        let Contacts { endings, accounts, .. } = &mut self.contacts;
        let Some(ending) = endings.as_mut().get_mut(row) else { return 0.0 };
        let account = accounts.as_mut().get_mut(row).filter(|_| S::is_parallel());
        let force = match account {
            Some(account) => account.book(mean_force * step, ending.force, step),
            None => mean_force,
        };
        let change = force - ending.force;
        *ending = Ending { speed, force, jump: 0.0, free };
        change * step
    }
}
