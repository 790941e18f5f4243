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
    let value = |parameter| S::parameter(parameter, group, values);
    validity::size_of([
        validity::size_of([value(Parameter::ImpactorRadius), value(Parameter::TargetRadius)]),
        S::size(group),
    ])
}

impl<S: Scene> Settings<S> {
    /// Sets the limit. The depths at which the groups reach it are computed when they are needed.
    pub(super) fn set_limit(&mut self, limit: Limit) {
        if self.limit != limit {
            self.limit = limit;
            self.bodies.as_mut().iter_mut().for_each(|bodies| bodies.depth = 0.0);
        }
    }
}

impl<S: Scene> Instance<S> {
    /// Makes the next step check every contact, so that warnings are given again.
    pub fn look(&mut self) {
        if self.settings.limit == Limit::Wide {
            self.settings.set_limit(Limit::Valid);
        }
        self.clock.hold();
        self.clock.guard = Guarded::Unseen;
    }

    /// Whether this rate may be too fast for an input \[m/s\].
    pub fn may_be_fast(&self, rate: f64) -> bool {
        rate > self.settings.largest_rate
    }

    /// The indentation at which `contact` reaches the present limit \[m\].
    pub(super) fn depth(&mut self, contact: usize) -> f64 {
        self.settings.depth(S::group(contact))
    }

    /// Checks that no contact has become as wide as its smaller body.
    ///
    /// # Errors
    /// [`Fault::TooWide`]
    pub(super) fn check_width(&self) -> Result<(), Fault> {
        let Limit::Reached(contact) = self.settings.limit else { return Ok(()) };
        let contact = contact as usize;
        let group = S::group(contact);
        let size = size::<S>(group, &self.settings.values);
        let [_, size] = S::Contact::widths(|| self.settings.model(group), f64::INFINITY, size);
        Err(Fault::TooWide { contact, size })
    }

    /// A contact has passed the present limit: the next one applies.
    fn raise_limit(&mut self, contact: usize, indentation: f64) {
        let Instance { contacts, settings, .. } = self;
        settings.set_limit(Limit::Wide);
        let mut reached = (indentation >= settings.depth(S::group(contact))).then_some(contact);
        for (contact, history) in contacts.histories.as_mut().iter_mut().enumerate() {
            if !history.stays_within(settings.depth(S::group(contact))) {
                reached = Some(contact);
            }
        }
        if let Some(contact) = reached {
            settings.limit = Limit::Reached(contact as u32);
            self.clock.hold();
        }
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
        let deep = contacts.find(|(contact, history)| history.max_indentation() >= settings.depth(S::group(*contact)));
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
        let indentation = self.deep.indentation;
        let is_first = self.settings.limit == Limit::Valid;
        let warning = is_first.then(|| Warning::Deep { contact, indentation, allowed: self.depth(contact) });
        self.raise_limit(contact, indentation);
        warning
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
