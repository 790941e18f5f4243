//! Detects an importer with steps that are too long for the contact force, or that applies it one step late.
//!
//! An explicit importer that moves a mass under the contact force is stable for steps of up to `2 sqrt(m/K)`. Beyond
//! this limit the mass gains energy in every step. A prescribed motion is exact for any step. The rate of a coupled
//! mass responds to the force; a prescribed rate does not. For a coupled mass, the acceleration minus the contact
//! force over the mass is that of the other forces. In two consecutive steps the other forces are the same, but the
//! contact force changes.

use super::*;

/// Tolerance for equal other forces, relative to the contact force. It covers the rounding in the sums of an importer.
const ROUNDING: f64 = 1e-8;

/// Smallest change of the contact force that rules out a coincidence, relative to the force.
const CHANGE: f64 = 1e-3;

/// `h^2 K/m` of the longest stable step.
const STABLE: f64 = 4.0;

/// `h^2 K/m` above which the next steps are also examined: that of a quarter of the longest stable step.
const NEARLY: f64 = STABLE / 16.0;

/// Number of steps examined after a touch, or after a step close to the limit.
const LOOKS: u32 = 8;

/// After this number of long steps without a response, the motion counts as prescribed. From then on only steps that
/// leave a branch are examined.
const PATIENCE: u32 = 200;

/// Larger forces, stiffnesses, inverse masses and inverse steps are not examined: their products may overflow.
const LARGEST: f64 = 1e90;

/// Stored in place of the contact number for a step that was too long, or a force that comes late; no contact has these numbers.
pub(super) const UNSTABLE: u32 = u32::MAX;
pub(super) const LATE: u32 = UNSTABLE - 1;

/// Number of forces that an importer may have applied over a step: the new one, the old one, their mean, the new one
/// extrapolated by half a step, the mean force output of the contact, and the same of the step before.
const KINDS: usize = 6;

/// The last examined step of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watched {
    /// Its end \[s\].
    end: f64,
    /// Its length \[s\].
    step: f64,
    /// Its rate \[m/s\].
    rate: f64,
    /// Force at its start divided by the mass \[m/s^2\].
    start: f64,
    /// The forces that the importer may have applied before it, divided by the mass \[m/s^2\].
    applied: [f64; KINDS],
    /// For each of them, the remaining acceleration from all other forces \[m/s^2\].
    others: [f64; KINDS],
    /// The longest unstable step among the examined steps without a gap \[s\], or 0.
    long: f64,
    /// Number of long steps in which the rate changed without responding to the force.
    unanswered: u32,
    /// 1 if a force that comes late has been found.
    found: u32,
}

/// The next step of a contact.
pub(super) struct Ahead<'a, C> {
    pub history: &'a C,
    /// \[m/s\]
    pub rate: f64,
    /// Its start, which is the end of the last step \[s\].
    pub time: f64,
    /// Its length \[s\].
    pub step: f64,
    /// Its end on the clock of the importer \[s\].
    pub end: f64,
    /// Mean force of the last step \[N\], where known.
    pub mean_force: f64,
}

impl Watched {
    /// Whether the rates \[m/s\] of the step `ahead` and of the last step respond to each kind of contact force, which is now
    /// `start` times the mass \[m/s^2\].
    fn answers<C>(&mut self, ahead: &Ahead<C>, start: f64, mean: f64) -> [bool; KINDS] {
        let change = (ahead.rate - self.rate) / self.step;
        let [.., last_mean, _] = self.applied;
        let trapezoid = 0.5 * (start + self.start);
        let applied = [start, self.start, trapezoid, 1.5 * start - 0.5 * self.start, mean, last_mean];
        let mut answers = [false; KINDS];
        let kinds = self.applied.iter_mut().zip(&mut self.others).zip(applied);
        for (((last, others), applied), answers) in kinds.zip(&mut answers) {
            let size = if applied.abs() > last.abs() { applied.abs() } else { last.abs() };
            let differs = (applied - *last).abs() > CHANGE * size;
            *answers = differs && (change + applied - *others).abs() <= ROUNDING * size;
            (*last, *others) = (applied, change + applied);
        }
        answers
    }

    /// What is found, once, if the rate responds to a force of the step before, and to no other.
    fn late(&mut self, answers: [bool; KINDS]) -> Option<Deep> {
        let is_late =
            matches!(answers, [false, true, false, false, false, false] | [false, false, false, false, false, true]);
        let is_new = is_late && core::mem::replace(&mut self.found, 1) == 0;
        is_new.then_some(Deep { contact: LATE, indentation: self.step })
    }

    /// Examines the step `ahead` of a contact: whether this step, or a recent one, is longer than the stable limit
    /// while the rate responds to the force, or the force comes late. `looks` is the number of next steps to examine.
    #[cold]
    #[inline(never)]
    fn look<S: Scene>(&mut self, looks: &mut u32, ahead: &Ahead<S::Contact>) -> Option<Deep> {
        let &Ahead { history, rate, time, step, end, mean_force } = ahead;
        let mass = S::impact_mass();
        // a prebuilt library that examines nothing has no room for it
        let is_known = mass * LARGEST > 1.0;
        if !is_known {
            return None;
        }
        let follows = self.step > 0.0 && time == self.end;
        // the importer has seen the force with the rate before
        let force = history.force(if follows { self.rate } else { rate });
        let stiffness = history.stiffness(rate);
        let in_range = step * LARGEST > 1.0 && force < LARGEST && mean_force < LARGEST && stiffness < LARGEST;
        if !in_range {
            *self = Watched::default();
            return None;
        }
        let start = force / mass;
        let ratio = step * step * stiffness / mass;
        let is_long = force > 0.0 && ratio > STABLE;
        let (mut answers, mut late) = (false, None);
        if follows {
            let last = self.rate;
            let all = self.answers(ahead, start, mean_force / mass);
            answers = all.contains(&true);
            late = self.late(all);
            self.unanswered = self.unanswered.saturating_add(u32::from(is_long && rate != last && !answers));
        } else {
            // the step before is unknown, and nothing is equal to it
            (self.others, self.long) = ([f64::INFINITY; KINDS], 0.0);
        }
        if is_long && step > self.long {
            self.long = step;
        }
        (self.end, self.step, self.rate, self.start) = (end, step, rate, start);
        // a look that is only due to the last one causes no further ones: the examination of a flight ends soon
        let touches = force == 0.0 && *looks == 0;
        if (ratio > NEARLY || touches) && self.unanswered < PATIENCE {
            *looks = LOOKS;
        }
        let is_unstable = answers && self.long > 0.0;
        if is_unstable { Some(Deep { contact: UNSTABLE, indentation: self.long }) } else { late }
    }
}

/// The warning about the step `ahead`, if there is one.
#[inline]
pub(super) fn watch<S: Scene>(
    watched: &mut IfPresent<S::Watch, S, Watched>,
    looks: &mut <S::Watch as Presence>::Of<u32, [u32; 1]>,
    contact: usize,
    ahead: &Ahead<S::Contact>,
) -> Option<Deep> {
    let watched = watched.as_mut().get_mut(contact)?;
    watched.look::<S>(looks.as_mut().first_mut()?, ahead)
}

impl<S: Scene> Instance<S> {
    /// Whether contacts that stay on their branch are examined.
    #[inline]
    pub(super) fn is_watching(&self) -> bool {
        self.contacts.looks.as_ref().iter().any(|looks| *looks > 0)
    }

    /// Requests the examination of the next step, if that is due.
    #[inline]
    pub(super) fn keep_watching(&mut self) {
        for looks in self.contacts.looks.as_mut() {
            *looks = looks.saturating_sub(1);
            if *looks > 0 {
                self.clock.hold();
            }
        }
    }
}
