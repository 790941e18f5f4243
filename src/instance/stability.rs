//! Detects an importer whose steps are too long for the force that it applies.
//!
//! An explicit importer that moves a mass by the contact force is stable up to steps of `2 sqrt(m/K)`. Beyond, the mass gains
//! energy with every step. A prescribed motion is exact at any step. The difference: the rate of a coupled mass responds to the
//! force. What its acceleration leaves when the force over the mass is taken off are the other forces, and these are the same
//! in two steps that follow each other, while the force of the contact is not.

use super::*;

/// How closely the other forces must agree, as a part of the force of the contact: room for the rounding of a master's own sums.
const ROUNDING: f64 = 1e-8;

/// How much the force of the contact must change for that to be no coincidence, as a part of it.
const CHANGE: f64 = 1e-3;

/// `h^2 K/m` of the largest stable step.
const STABLE: f64 = 4.0;

/// `h^2 K/m` from which on the next steps are looked at, too: that of a quarter of the largest stable step.
const NEARLY: f64 = STABLE / 16.0;

/// How many steps are looked at from a touch on, or from a step that is nearly too long.
const LOOKS: u32 = 8;

/// After so many long steps without an answer the motion is taken to be prescribed: only steps that leave a branch are looked at.
const PATIENCE: u32 = 200;

/// Forces, stiffnesses, inverse masses and inverse steps beyond this are not looked at: their products may overflow.
const LARGEST: f64 = 1e90;

/// What stands for a contact in the place of one that is too deep: none, but a step that was too long.
pub(super) const UNSTABLE: u32 = u32::MAX;

/// The number of forces that an importer may have applied over a step: the new one, the old one, the mean of both, the new one
/// extrapolated by half a step, and the mean force that the contact shows.
const KINDS: usize = 5;

/// The last step of a contact that was looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watched {
    /// When it ended \[s\].
    end: f64,
    /// Its length \[s\].
    step: f64,
    /// Its rate \[m/s\].
    rate: f64,
    /// Force at its start over mass \[m/s^2\].
    start: f64,
    /// The forces that may have been applied before it, over the mass \[m/s^2\].
    applied: [f64; KINDS],
    /// The acceleration by all other forces that follows from each of them \[m/s^2\].
    others: [f64; KINDS],
    /// The longest unstable step of those that were looked at without a gap \[s\], or 0.
    long: f64,
    /// How many long steps there were in which the rate changed, and not by the force.
    unanswered: u32,
}

/// A step that a contact is about to make.
pub(super) struct Ahead<'a, C> {
    pub history: &'a C,
    /// \[m/s\]
    pub rate: f64,
    /// When it starts, which is where the last one has ended \[s\].
    pub time: f64,
    /// Its length \[s\].
    pub step: f64,
    /// When it ends, by the clock of the importer \[s\].
    pub end: f64,
    /// Mean force of the last step \[N\], where it is known.
    pub mean_force: f64,
}

impl Watched {
    /// Whether the rate \[m/s\] of the step `ahead` and the last one have answered the contact's force, which is now `start` times
    /// the mass \[m/s^2\].
    fn answers<C>(&mut self, ahead: &Ahead<C>, start: f64, mean: f64) -> bool {
        let change = (ahead.rate - self.rate) / self.step;
        let applied = [start, self.start, 0.5 * (start + self.start), 1.5 * start - 0.5 * self.start, mean];
        let mut answers = false;
        let kinds = self.applied.iter_mut().zip(&mut self.others).zip(applied);
        for ((last, others), applied) in kinds {
            let size = if applied.abs() > last.abs() { applied.abs() } else { last.abs() };
            let differs = (applied - *last).abs() > CHANGE * size;
            answers |= differs && (change + applied - *others).abs() <= ROUNDING * size;
            (*last, *others) = (applied, change + applied);
        }
        answers
    }

    /// Looks at the step `ahead` of a contact: whether it, or one shortly before, is longer than a stable one and the rate answers
    /// the force. The result is that step \[s\]. `looks` is how many of the next steps are to be looked at.
    #[cold]
    #[inline(never)]
    fn look<S: Scene>(&mut self, looks: &mut u32, ahead: &Ahead<S::Contact>) -> Option<f64> {
        let &Ahead { history, rate, time, step, end, mean_force } = ahead;
        let mass = S::impact_mass();
        // a prebuilt library has none where nothing is to be watched
        let is_known = mass * LARGEST > 1.0;
        if !is_known {
            return None;
        }
        let follows = self.step > 0.0 && time == self.end;
        // what the importer has seen is the force with the rate before
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
        let mut answers = false;
        if follows {
            let last = self.rate;
            answers = self.answers(ahead, start, mean_force / mass);
            self.unanswered = self.unanswered.saturating_add(u32::from(is_long && rate != last && !answers));
        } else {
            // nothing is known of the step before, and nothing equals it
            (self.others, self.long) = ([f64::INFINITY; KINDS], 0.0);
        }
        if is_long && step > self.long {
            self.long = step;
        }
        (self.end, self.step, self.rate, self.start) = (end, step, rate, start);
        // a look that is due only because of the last one doesn't make others due: a flight is soon left alone
        let touches = force == 0.0 && *looks == 0;
        if (ratio > NEARLY || touches) && self.unanswered < PATIENCE {
            *looks = LOOKS;
        }
        (answers && self.long > 0.0).then_some(self.long)
    }
}

/// What is to be told of the step `ahead`, if there is anything.
#[inline]
pub(super) fn watch<S: Scene>(
    watched: &mut IfPresent<S::Watch, S, Watched>,
    looks: &mut <S::Watch as Presence>::Of<u32, [u32; 1]>,
    contact: usize,
    ahead: &Ahead<S::Contact>,
) -> Option<Deep> {
    let watched = watched.as_mut().get_mut(contact)?;
    let long = watched.look::<S>(looks.as_mut().first_mut()?, ahead)?;
    Some(Deep { contact: UNSTABLE, indentation: long })
}

impl<S: Scene> Instance<S> {
    /// Whether the contacts are looked at that stay on their branch.
    #[inline]
    pub(super) fn is_watching(&self) -> bool {
        self.contacts.looks.as_ref().iter().any(|looks| *looks > 0)
    }

    /// Has the next step looked at, too, if that is due.
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
