//! Noticing where a simulation leaves what its law is valid for. It goes on there: what is told of it is no matter of this module.

use super::*;
use crate::contact::validity;

/// Puts up a mark where `history` would leave `depth` [m], so that the step that does isn't plain. False if it has left it.
#[inline]
pub(super) fn stays_within(depth: f64, history: &mut History) -> bool {
    let within = history.max_indentation() < depth;
    if within {
        history.notice_at(depth);
    }
    within
}

/// The closing speed [m/s] up to which elastic waves can be left out in `group`; any, if its density isn't known.
fn largest_speed(group: usize, values: &Values) -> f64 {
    let modulus = scene::parameter(Parameter::TargetYoungsModulus, group, values);
    scene::density(group).map_or(f64::MAX, |density| validity::largest_speed(modulus, density))
}

/// The opposite of the rate up to which an input needs no further look in any group [m/s].
pub(super) fn lowest_rate(values: &Values) -> f64 {
    let finite = if scene::CONTACTS > 1 { FAST } else { f64::MAX };
    let speeds = (0..scene::GROUPS).map(|group| largest_speed(group, values));
    -speeds.fold(finite, |least, speed| if speed < least { speed } else { least })
}

impl Instance {
    /// Makes the next step look at every contact, wherever it is: nobody has heard of it yet.
    pub fn look(&mut self) {
        self.limit = NOWHERE;
    }

    /// Whether this may be too fast for an input [m/s].
    pub fn may_be_fast(&self, rate: f64) -> bool {
        rate > -self.lowest_rate
    }

    /// Up to which indentation the law of `contact` is valid [m].
    pub(super) fn valid_depth(&self, contact: usize) -> f64 {
        self.pairs.get(scene::group(contact)).map_or(f64::NAN, |bodies| bodies.depth)
    }

    /// Looks for a contact that is deeper than its law is valid for.
    #[cold]
    pub(super) fn find_deep(&mut self) {
        let mut contacts = self.histories.iter().enumerate();
        let deep = contacts.find(|(contact, history)| history.max_indentation() >= self.valid_depth(*contact));
        if let Some((contact, history)) = deep {
            (self.deep, self.deepest) = (contact as u32 + 1, history.max_indentation());
        }
    }

    /// A contact that the last step has left deeper than its law is valid for, or had there on the way, if it is yet to be told.
    #[inline(always)]
    pub fn is_deep(&self) -> bool {
        self.deep != 0
    }

    /// The warning of that contact, which then is told.
    pub fn take_deep(&mut self) -> Option<Fault> {
        let contact = core::mem::take(&mut self.deep).checked_sub(1)?;
        Some(Fault::Deep { contact, indentation: self.deepest, allowed: self.valid_depth(contact as usize) })
    }

    /// The first contact that closes faster than its law is valid.
    pub fn find_fast(&self) -> Option<Fault> {
        self.rates.iter().enumerate().find_map(|(contact, &rate)| {
            if !self.may_be_fast(rate) {
                return None;
            }
            // the bound of the one group is known
            let only = scene::GROUPS == 1;
            let allowed = if only { -self.lowest_rate } else { largest_speed(scene::group(contact), &self.values) };
            (rate > allowed).then_some(Fault::Fast { contact: contact as u32, rate, allowed })
        })
    }
}
