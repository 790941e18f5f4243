//! Detects that a simulation leaves the valid range of its law. The simulation continues; other modules write the messages.

use super::clock::Guarded;
use super::*;
use brinell_contact::validity;

/// The closing speed \[m/s\] up to which elastic waves are negligible in `group`; infinite if the density is unknown.
fn largest_speed<S: Scene>(group: usize, values: &S::Values) -> f64 {
    let modulus = S::parameter(Parameter::TargetYoungsModulus, group, values);
    S::density(group).map_or(FASTEST, |density| validity::largest_speed(modulus, density))
}

/// The rate up to which an input needs no further check in any group \[m/s\].
pub(super) fn largest_rate<S: Scene>(values: &S::Values) -> f64 {
    let speeds = (0..S::groups()).map(|group| largest_speed::<S>(group, values));
    speeds.fold(FASTEST, |least, speed| if speed < least { speed } else { least })
}

/// The smaller radius of the bodies of `group` \[m\].
pub(super) fn size<S: Scene>(group: usize, values: &S::Values) -> f64 {
    let radii = [Parameter::ImpactorRadius, Parameter::TargetRadius];
    validity::size_of(radii.map(|radius| S::parameter(radius, group, values)))
}

impl<S: Scene> Instance<S> {
    /// Makes the next step check every contact, so that warnings are given again.
    pub fn look(&mut self) {
        self.clock.hold();
        self.clock.guard = Guarded::Unseen;
    }

    /// Whether this rate may be too fast for an input \[m/s\].
    pub fn may_be_fast(&self, rate: f64) -> bool {
        rate > self.settings.largest_rate
    }

    /// The indentation up to which the law of `contact` is valid \[m\].
    pub(super) fn valid_depth(&mut self, contact: usize) -> f64 {
        self.settings.valid_depth(S::group(contact))
    }

    /// Records that `contact` has reached `indentation` \[m\].
    pub(super) fn note_deep(&mut self, contact: usize, indentation: f64) {
        self.deep = Deep { contact: contact as u32 + 1, indentation };
    }

    /// Searches for a contact that is deeper than its law is valid.
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

    /// Whether a contact is or was deeper in the last step than its law is valid, and the warning has not been
    /// [taken](Instance::take_deep) yet.
    #[inline(always)]
    pub fn is_deep(&self) -> bool {
        self.deep.contact != 0
    }

    /// The warning about that contact, once.
    pub fn take_deep(&mut self) -> Option<Warning> {
        let contact = core::mem::take(&mut self.deep.contact).checked_sub(1)? as usize;
        if S::Watch::IS_PRESENT {
            match contact as u32 + 1 {
                stability::UNSTABLE => {
                    return Some(Warning::Unstable { step: self.deep.indentation, mass: S::impact_mass() });
                }
                stability::LATE => return Some(Warning::Late),
                _ => {}
            }
        }
        Some(Warning::Deep { contact, indentation: self.deep.indentation, allowed: self.valid_depth(contact) })
    }

    /// Whether the passivity guard has begun to act in a plain step, and that has not been [taken](Instance::take_guard) yet.
    #[inline(always)]
    pub fn is_guard_seen(&self) -> bool {
        S::guard().is_some() && self.clock.guard == Guarded::Seen
    }

    /// The warning, once, that the passivity guard shortens the unloading path of the present dent of a contact.
    pub fn take_guard(&mut self) -> Option<Warning> {
        let guard = S::guard()?;
        let acts = match self.clock.guard {
            Guarded::Told => false,
            Guarded::Seen => true,
            Guarded::Unseen => {
                let mut contacts = self.histories().iter().enumerate();
                contacts.any(|(contact, history)| (guard.acts)(history, &self.model(contact)))
            }
        };
        if !acts {
            return None;
        }
        self.clock.guard = Guarded::Told;
        Some(Warning::Guarded)
    }

    /// The first contact that closes faster than its law is valid.
    pub fn find_fast(&self) -> Option<Warning> {
        self.rates().iter().enumerate().find_map(|(contact, &rate)| {
            if !self.may_be_fast(rate) {
                return None;
            }
            // with a single group, the limit is known
            let only = S::groups() == 1;
            let values = &self.settings.values;
            let allowed = if only { self.settings.largest_rate } else { largest_speed::<S>(S::group(contact), values) };
            (rate > allowed).then_some(Warning::Fast { contact, rate, allowed })
        })
    }
}
