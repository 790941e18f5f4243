//! Detects that a simulation leaves the valid range of its law. The simulation continues, up to a contact that is as wide as the smaller
//! body; other modules write the messages.

use super::clock::Guarded;
use super::*;
use brinell_contact::numbers::smallest;
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

/// The size of the smaller body of `group` \[m\]: its radius, or that of a rod.
pub(super) fn size<S: Scene>(group: usize, values: &S::Values) -> f64 {
    let radii = [Parameter::ImpactorRadius, Parameter::TargetRadius];
    let size = validity::size_of(radii.map(|radius| S::parameter(radius, group, values)));
    S::rod_radius(group).map_or(size, |radius| smallest(size, radius))
}

/// Part of an indentation of the order of the valid ones, below which no contact needs to be looked at.
const SHALLOW: f64 = 0.005;

/// An indentation \[m\] at which no contact of any group is wide; `radius` gives the effective radius of a group \[m\].
pub(super) fn shallow<S: Scene>(values: &S::Values, radius: impl Fn(usize) -> f64) -> f64 {
    let of = |group| {
        let (radius, size) = (radius(group), size::<S>(group, values));
        let width = smallest(radius, size);
        SHALLOW * (width / radius * width)
    };
    (0..S::groups()).map(of).fold(f64::INFINITY, smallest)
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

    /// How deep the bodies of `contact` may be pressed together.
    pub(super) fn depths(&mut self, contact: usize) -> Depths {
        self.settings.depths(S::group(contact))
    }

    /// Rejects a step at constant rates after which a contact would be as wide as the smaller body. Looks at the law only where a contact
    /// ends at a depth that is not shallow.
    pub(super) fn check_width(&mut self, step: f64) -> Result<(), Fault> {
        let shallow = self.settings.shallow;
        for contact in 0..S::contacts() {
            let (Some(history), Some(&rate)) = (self.histories().get(contact), self.rates().get(contact)) else {
                break;
            };
            if history.indentation() + rate * step >= shallow {
                self.check_width_of(contact, rate, step)?;
            }
        }
        Ok(())
    }

    /// The same for one `contact` that moves at this `rate` \[m/s\].
    #[cold]
    #[inline(never)]
    pub(super) fn check_width_of(&mut self, contact: usize, rate: f64, step: f64) -> Result<(), Fault> {
        let Depths { possible, .. } = self.depths(contact);
        let Some(history) = self.histories().get(contact) else { return Ok(()) };
        let end = history.indentation() + rate * step;
        if end < possible {
            return Ok(());
        }
        // only on a plate, which has no derivatives, the bodies come closer than the indentation tells
        if S::derivatives() > 0 {
            return Err(Fault::TooWide { contact, indentation: end, possible });
        }
        let (mut history, model) = (*history, self.model(contact));
        let kept = S::Contact::kept(&model);
        history.step_held(rate, step, &kept, || model).map_err(|deep| too_deep(contact, deep))?;
        self.check_depth(contact, history.max_indentation())
    }

    /// Rejects an `indentation` \[m\] at which `contact` is as wide as the smaller body.
    pub(super) fn check_depth(&mut self, contact: usize, indentation: f64) -> Result<(), Fault> {
        let Depths { possible, .. } = self.depths(contact);
        if indentation >= possible { Err(Fault::TooWide { contact, indentation, possible }) } else { Ok(()) }
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
            contacts.find(|(contact, history)| history.max_indentation() >= settings.depths(S::group(*contact)).valid);
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
        Some(Warning::Deep { contact, indentation: self.deep.indentation, allowed: self.depths(contact).valid })
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
