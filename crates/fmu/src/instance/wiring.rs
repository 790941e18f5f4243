//! What a contact of known mass notices of its importer: the other order of execution, a rate that does not follow the force, another
//! mass, a body that contacts share.
//!
//! An importer can be *read* in several ways: it applies the force over the same step, one step late, not at all, or to another mass.
//! Each reading leaves a remainder of every rate: an acceleration that the FMU was not told, such as gravity. Under the true reading,
//! it is that of real forces, and changes little from step to step; under a wrong one, it changes by what the contact force does. So
//! the changes of the remainders are compared, in every step that tells the readings apart. A ratio of ten in one step is a common
//! coincidence. A product of eight digits, of one step or several, is none.

use super::*;
use brinell_contact::numerics::{largest, quotient, smallest};

/// A change below this fraction of the speeds tells nothing: an importer may compute in single precision.
const TELLING: f64 = 1e-6;

/// Two forces that differ by this part are not the same one. A mass that differs by less is not worth a warning.
const DIFFERENT: f64 = 1e-2;

/// Two ratios that differ by this part are the same one.
const SAME: f64 = 1e-8;

/// Rounding error of the importer's own sums, as a fraction of the speeds.
const ROUNDING: f64 = 1e-13;

/// Added to the speeds \[m/s\]: two bodies that fall together have a closing rate of mere rounding.
const USUAL: f64 = 1e-5;

/// Part of their sum by which two changes must differ, for the step to tell two readings apart.
const APART: f64 = 0.5;

/// A smaller ratio speaks against a reading: of changes that are mere noise, half of the ratios are above 1.
const LEAST: f64 = 10.0;

/// The same for a reading whose multiple of the force was found from another step.
const LEAST_OF_FIT: f64 = 1e3;

/// The largest ratio of one step, beyond the least.
const LARGEST_OF_STEP: f64 = 1e8;

/// Product of the ratios, each beyond the least, that is no coincidence. The tiny part is for the rounding of products.
const ENOUGH: f64 = 0.999e8;

/// Largest product that is kept.
const LARGEST: f64 = 1e16;

/// Factor by which a product must be above that of the other readings.
const LEAD: f64 = 1e4;

/// Larger speeds, times and accelerations are not examined: their products may overflow.
const FAR: f64 = 1e90;

/// What is left of the rate of a contact, under three readings of its importer.
#[derive(Clone, Copy, Debug, Default)]
struct Left {
    /// The importer is the one that the scene is made for.
    right: f64,
    /// It applies the force over the other step.
    other: f64,
    /// It applies none.
    none: f64,
}

impl Left {
    fn map(self, of: impl Fn(f64) -> f64) -> Left {
        Left { right: of(self.right), other: of(self.other), none: of(self.none) }
    }

    fn since(self, before: Left) -> Left {
        Left { right: self.right - before.right, other: self.other - before.other, none: self.none - before.none }
    }
}

/// How much the steps so far speak for a reading.
#[derive(Clone, Copy, Debug, Default)]
struct Odds(f64);

impl Odds {
    /// Takes the changes of the remainder in one step, under the reading of the scene and under this one, and the `least` ratio.
    fn weigh(&mut self, right: f64, this: f64, noise: f64, least: f64) {
        let [size, own] = [right.abs(), this.abs()];
        if (right - this).abs() > APART * (size + own) + TELLING / ROUNDING * noise {
            let ratio = quotient(size + noise, (own + noise) * least, own + noise > 0.0, 1.0);
            let ratio = largest(smallest(ratio, LARGEST_OF_STEP), 1.0 / LARGEST_OF_STEP);
            self.0 = smallest(self.product() * ratio, LARGEST);
        }
    }

    /// At least 1: what spoke against a reading earlier doesn't weigh.
    fn product(self) -> f64 {
        largest(self.0, 1.0)
    }
}

/// Changes in one step: of the force over the mass, and of the rate.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    force: f64,
    rate: f64,
}

impl Sample {
    /// The multiple of the force that the rate has followed, if it is known.
    fn share(self) -> Option<f64> {
        let is_known = self.rate.abs() < FAR * self.force.abs();
        is_known.then(|| -quotient(self.rate, self.force, is_known, 0.0))
    }
}

/// A reading in which the rate follows an unknown multiple of the force: the importer moves another mass.
#[derive(Clone, Copy, Debug, Default)]
struct Fit {
    /// By the multiple of the last sample: it may be this reading, and no other one is certain.
    possible: Odds,
    last: Sample,
    /// By that of an earlier sample, which has no step in common with the present one, and in which the force changed the other way:
    /// the rate of a damped body at rest is also a multiple of the force.
    certain: Odds,
    earlier: Sample,
}

impl Fit {
    /// Takes the changes of the remainders in one step.
    fn weigh(&mut self, change: Left, noise: f64) {
        let force = change.right - change.none;
        if let Some(share) = self.last.share() {
            self.possible.weigh(change.right, change.none + share * force, noise, LEAST_OF_FIT);
        }
        if let Some(share) = self.earlier.share().filter(|_| (force > 0.0) != (self.earlier.force > 0.0)) {
            self.certain.weigh(change.right, change.none + share * force, noise, LEAST_OF_FIT);
        }
        if self.certain.product() <= 1.0 {
            self.earlier = self.last;
        }
        if force.abs() > TELLING / ROUNDING * noise {
            self.last = Sample { force, rate: change.none };
        }
    }
}

/// What a contact knows of its importer. It isn't part of a saved state: after one is restored, a single step must tell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Evidence {
    /// Length of the last step \[s\], 0 if it is unknown.
    step: f64,
    /// The remainders of the step before it \[m/s^2\], and their rounding error; zero if they are unknown.
    left: Left,
    noise: f64,
    other: Odds,
    none: Odds,
    mass: Fit,
}

impl Evidence {
    /// Takes what is `left` of a rate \[m/s\], whose sums have this `noise`, and the length of the `next` step \[s\]. Returns the part of
    /// the force that the rate follows if the importer is not the one of the scene: 1 in the other order.
    fn take(&mut self, left: Left, noise: f64, next: f64) -> Option<f64> {
        let step = core::mem::replace(&mut self.step, next);
        let knows = step > 0.0;
        let step = if knows { step } else { 1.0 };
        let size = left.right.abs() + left.other.abs() + left.none.abs() + noise;
        let in_range = size < FAR && size < FAR * step && step < FAR;
        if !in_range {
            *self = Evidence::default();
            return None;
        }
        // speeds, if the length of the step is unknown
        let (left, noise) = (left.map(|left| left / step), noise / step);
        let change = left.since(self.left);
        let both = noise + self.noise;
        (self.left, self.noise) = if knows { (left, noise) } else { Default::default() };
        self.other.weigh(change.right, change.other, both, LEAST);
        self.none.weigh(change.right, change.none, both, LEAST);
        if knows {
            self.mass.weigh(change, both);
        }
        self.share()
    }

    /// The part of the force that the rate follows, if one reading is no coincidence and clearly above the others.
    fn share(&self) -> Option<f64> {
        let (other, mut none, mut mass) = (self.other.product(), self.none.product(), self.mass.possible.product());
        // an infinite mass
        if self.mass.last.share().is_some_and(|share| share.abs() <= DIFFERENT) {
            (none, mass) = (largest(none, mass), 1.0);
        }
        let leads = |odds: f64, one: f64, two: f64| odds > LEAD * largest(one, two);
        match () {
            () if other >= ENOUGH && leads(other, none, mass) => Some(1.0),
            () if none >= ENOUGH && leads(none, other, mass) => Some(0.0),
            () if self.mass.certain.product() >= ENOUGH && leads(mass, other, none) => {
                self.mass.earlier.share().filter(|share| *share > DIFFERENT && (share - 1.0).abs() > DIFFERENT)
            }
            () => None,
        }
    }
}

/// A contact whose importer is not the one of the scene, until the warning is taken.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Miswired {
    /// The contact, counted from 1; 0 is none.
    contact: u32,
    /// The rate that was given \[m/s\].
    rate: f64,
    /// The rate that was expected \[m/s\].
    expected: f64,
    /// The contact whose force moves its body, counted from 1; 0 if that is not the reason.
    other: u32,
    /// The part of the force that the rate follows; 1 if the order is the reason.
    share: f64,
}

/// A contact whose rate was not the expected one when another one pushed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Suspect {
    /// The other contact, counted from 1; 0 is none.
    other: u32,
    /// Difference of the rate over the force of the other contact \[m/(N.s)\].
    ratio: f64,
    /// That force \[N\].
    force: f64,
    /// Force of this contact before the last step \[N\].
    before: f64,
}

impl<S: Scene> Instance<S> {
    /// Examines the rate of `contact` for the next step, of this length \[s\].
    pub(super) fn check_wiring(&mut self, contact: usize, step: f64) {
        let (Some(ending), Some(&rate)) = (self.contacts.endings.as_ref().get(contact), self.rates().get(contact))
        else {
            return;
        };
        let expected = ending.speed + self.pending_rate(contact);
        // a serial importer has already applied the new force, a parallel one still the old force
        let jump = if S::is_parallel() { -ending.jump } else { ending.jump };
        let left = Left { right: rate - expected, other: rate - expected - jump, none: rate - ending.free };
        let size = USUAL + rate.abs() + ending.speed.abs() + expected.abs() + ending.free.abs();
        let Some(evidence) = self.contacts.evidence.as_mut().get_mut(contact) else { return };
        if let Some(share) = evidence.take(left, ROUNDING * size, step) {
            self.note_miswired(Miswired { contact: contact as u32 + 1, rate, expected, other: 0, share });
        }
    }

    /// Keeps what was found in this step, unless something else was.
    fn note_miswired(&mut self, found: Miswired) {
        for slot in self.contacts.miswired.as_mut().iter_mut().filter(|slot| slot.contact == 0) {
            *slot = found;
        }
    }

    /// Forgets what the steps so far said of the importer.
    pub(super) fn forget_importer(&mut self) {
        self.contacts.evidence.as_mut().fill(Evidence::default());
    }

    /// The warning, once, that the last step began with the rate of another importer than that of the scene.
    pub fn take_miswired(&mut self) -> Option<Warning> {
        let taken = core::mem::take(self.contacts.miswired.as_mut().first_mut()?);
        let Miswired { contact, rate, expected, other, share } = taken;
        let contact = contact.checked_sub(1)? as usize;
        let cause = match other.checked_sub(1) {
            Some(other) => Cause::Shared { with: other as usize },
            None if share == 1.0 => Cause::Order { parallel: S::is_parallel() },
            None if share == 0.0 => Cause::Unmoved,
            None => Cause::Mass { moved: self.mass(contact) / share, known: self.mass(contact) },
        };
        Some(Warning::Miswired { contact, rate, expected, cause })
    }

    /// Looks for contacts that share a body, unknown to the FMU or of another mass than it knows. In two steps, the rate of a contact
    /// differs from the expected one by the same multiple of the force of another contact, which alone pushes.
    pub(super) fn check_sharing(&mut self) {
        if S::contacts() < 2 || !S::moves() {
            return;
        }
        let mut pushing = None;
        let mut count = 0_usize;
        let Contacts { endings, suspects, .. } = &mut self.contacts;
        for (contact, (ending, suspect)) in endings.as_ref().iter().zip(suspects.as_mut()).enumerate() {
            let applied = if S::is_parallel() { suspect.before } else { ending.force };
            suspect.before = ending.force;
            if applied != 0.0 {
                pushing = Some((contact, applied));
                count += 1;
            }
        }
        let Some((other, force)) = pushing.filter(|_| count == 1) else { return };
        for contact in (0..S::contacts()).filter(|&contact| contact != other) {
            let (Some(ending), Some(&rate)) = (self.contacts.endings.as_ref().get(contact), self.rates().get(contact))
            else {
                continue;
            };
            let expected = ending.speed + self.pending_rate(contact);
            let (beyond, size) = (rate - expected, rate.abs() + ending.speed.abs() + expected.abs());
            let tells = beyond.abs() > TELLING * size;
            let ratio = quotient(beyond, force, tells, 0.0);
            let Some(suspect) = self.contacts.suspects.as_mut().get_mut(contact) else { continue };
            let same = suspect.other == other as u32 + 1 && (ratio - suspect.ratio).abs() <= SAME * ratio.abs();
            let differs = (force - suspect.force).abs() > DIFFERENT * force.abs();
            // the same force tells nothing new
            if !tells || same && !differs {
                continue;
            }
            let (contact, other) = (contact as u32 + 1, other as u32 + 1);
            *suspect = Suspect { other, ratio, force, before: suspect.before };
            if same {
                self.note_miswired(Miswired { contact, rate, expected, other, share: 0.0 });
            }
        }
    }
}
