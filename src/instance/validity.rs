//! Detects that a simulation leaves the validity of its law. The simulation continues; the messages are written elsewhere.

use super::*;
use crate::contact::validity;

/// The closing speed \[m/s\] up to which elastic waves can be left out in `group`; any, if its density isn't known.
fn largest_speed<S: Scene>(group: usize, values: &S::Values) -> f64 {
    let modulus = S::parameter(Parameter::TargetYoungsModulus, group, values);
    S::density(group).map_or(FASTEST, |density| validity::largest_speed(modulus, density))
}

/// The opposite of the rate up to which an input needs no further look in any group \[m/s\].
pub(super) fn lowest_rate<S: Scene>(values: &S::Values) -> f64 {
    let speeds = (0..S::GROUPS).map(|group| largest_speed::<S>(group, values));
    -speeds.fold(FASTEST, |least, speed| if speed < least { speed } else { least })
}

impl<S: Scene> Instance<S> {
    /// Makes the next step look at every contact, wherever it is: its user hasn't heard of it yet.
    pub fn look(&mut self) {
        self.clock.hold();
    }

    /// Whether this may be too fast for an input \[m/s\].
    pub fn may_be_fast(&self, rate: f64) -> bool {
        rate > -self.settings.lowest_rate
    }

    /// Up to which indentation the law of `contact` is valid \[m\].
    pub(super) fn valid_depth(&mut self, contact: usize) -> f64 {
        self.settings.valid_depth(S::group(contact))
    }

    /// Notes that `contact` has been as deep as `indentation` \[m\].
    pub(super) fn note_deep(&mut self, contact: usize, indentation: f64) {
        self.deep = Deep { contact: contact as u32 + 1, indentation };
    }

    /// Looks for a contact that is deeper than its law is valid for.
    #[cold]
    pub(super) fn find_deep(&mut self) {
        let Instance { contacts, settings, .. } = self;
        let mut contacts = contacts.histories.as_ref().iter().enumerate();
        let deep =
            contacts.find(|(contact, history)| history.max_indentation() >= settings.valid_depth(S::group(*contact)));
        if let Some((contact, history)) = deep {
            let indentation = history.max_indentation();
            self.note_deep(contact, indentation);
        }
    }

    /// Whether the last step has left a contact deeper than its law is valid for, or had it there on the way, and nobody has
    /// [taken](Instance::take_deep) the warning yet.
    #[inline(always)]
    pub fn is_deep(&self) -> bool {
        self.deep.contact != 0
    }

    /// The warning of that contact, once.
    pub fn take_deep(&mut self) -> Option<Warning> {
        let contact = core::mem::take(&mut self.deep.contact).checked_sub(1)? as usize;
        if S::Watch::IS_PRESENT && contact + 1 == stability::UNSTABLE as usize {
            return Some(Warning::Unstable { step: self.deep.indentation, mass: S::impact_mass() });
        }
        Some(Warning::Deep { contact, indentation: self.deep.indentation, allowed: self.valid_depth(contact) })
    }

    /// The first contact that closes faster than its law is valid.
    pub fn find_fast(&self) -> Option<Warning> {
        self.rates().iter().enumerate().find_map(|(contact, &rate)| {
            if !self.may_be_fast(rate) {
                return None;
            }
            // the bound of the one group is known
            let only = S::GROUPS == 1;
            let values = &self.settings.values;
            let allowed = if only { -self.settings.lowest_rate } else { largest_speed::<S>(S::group(contact), values) };
            (rate > allowed).then_some(Warning::Fast { contact, rate, allowed })
        })
    }
}
