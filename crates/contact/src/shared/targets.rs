//! What ends a step of the integration early: the place of the first event, and the step that ends there.

use super::Refused;
use super::SharedContact;
use super::block::Block;
use super::branch::{Event, Watched};
use super::clock::Clock;
use super::curve::Curve;
use super::step::indentation_over;
use super::work::Instant;
use crate::numerics::{largest, quotient, smallest};
use core::borrow::Borrow;
use libm::fabs;

/// Largest number of steps in search of an event; two or three are usual.
const APPROACHES: u32 = 40;

/// Correction of the length of a step to an event, relative to the length, below which the event is found.
const FOUND: f64 = 1e-12;

/// The same for an event at which the force has a kink and no jump: the place matters by its square.
const FOUND_KINK: f64 = 1e-8;

/// A part of a bracket so near its start that the number is at its threshold there.
const AT_START: f64 = 1e-6;

/// Two lengths of a step between which an event lies, each with the number that falls through zero there.
struct Bracket {
    before: (f64, f64),
    beyond: (f64, f64),
}

impl Bracket {
    /// The next length to try after `length`, where the number is `value`: by the secant, and every fourth time halfway.
    fn next(&mut self, length: f64, value: f64, attempt: u32) -> f64 {
        *(if value > 0.0 { &mut self.before } else { &mut self.beyond }) = (length, value);
        let ((low, above), (high, below)) = (self.before, self.beyond);
        let part = quotient(above, above - below, above - below > 1e-100 * above, 0.5);
        let part = if attempt % 4 == 3 || !(part > AT_START && part < 1.0) { 0.5 } else { part };
        low + part * (high - low)
    }
}

/// What ends a step of the integration early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// The end of the time, for a step in the clock of a contact.
    Time,
    /// An event of the contact at this place.
    Event(usize, Watched),
}

impl<C: SharedContact<M>, M, B: Borrow<M>, F: Fn(usize) -> B> Block<'_, C, M, B, F> {
    /// The first event of the step that was tried, but for one, and the part of the step at which it comes.
    pub(super) fn first_target(
        &self,
        clock: Option<&Clock>,
        length: f64,
        but: Option<Target>,
    ) -> Option<(Target, f64)> {
        let paces = self.paces(clock);
        let mut first: Option<(Target, f64)> = None;
        let mut end = 1.0;
        let [time, w] = self.ticked;
        if let Some(clock) = clock {
            let [[from, slope], [to, last]] = paces;
            let parts = Target::Event(
                clock.place,
                Watched::Indentation { event: Event::Part, threshold: clock.surface, sign: -1.0 },
            );
            if w < 0.0 && but != Some(parts) {
                let bend = |instant: &Instant, w: f64| 0.5 * w * instant.bend() * length * length;
                let member = self.work.get(clock.place)?;
                let (start, stop) = (bend(&member.now, from), bend(&member.trial, to));
                let curve = Curve::quintic([from, slope * length, start], [to, last * length, stop]);
                end = curve.first_fall(1.0, 0.0).unwrap_or(1.0);
                first = Some((parts, end));
            }
            let curve = Curve::quintic(
                [0.0, from * length, slope * length * length],
                [time, to * length, last * length * length],
            );
            let left = curve.below(self.left, 1.0);
            if but != Some(Target::Time)
                && let Some(part) = left.first_fall(end, 0.0)
            {
                end = part;
                first = Some((Target::Time, part));
            }
        }
        for (place, member) in self.members() {
            let is_clock = clock.is_some_and(|clock| clock.place == place);
            for watched in member.watches() {
                let parts = matches!(watched, Watched::Indentation { event: Event::Part, .. });
                // beyond the surface the clock goes back
                let is_beyond = matches!(watched, Watched::Pull { .. }) && is_clock && w < 0.0 && !member.grips_again();
                if but == Some(Target::Event(place, watched)) || is_clock && parts || is_beyond {
                    continue;
                }
                let (now, trial) = (&member.now, &member.trial);
                let mut near = member.near(&watched, &self.scales);
                if member.rises_in_the_curve_only(&watched, near) {
                    continue;
                }
                let curve = match watched {
                    Watched::Indentation { threshold, sign, .. } => {
                        indentation_over(member, &paces, length).below(threshold, sign)
                    }
                    Watched::Rate { threshold, sign, .. } => {
                        let [[from, _], [to, _]] = paces;
                        let (start, stop) = (from * now.bend() * length, to * trial.bend() * length);
                        Curve::cubic([now.approach, start], [trial.approach, stop]).below(threshold, sign)
                    }
                    Watched::Bend { sign } => {
                        // in units of rate, by the part of the step
                        let [[from, _], [to, _]] = paces;
                        let (start, stop) = (from * now.bend() * length, to * trial.bend() * length);
                        let rate =
                            Curve::cubic([sign * now.approach, sign * start], [sign * trial.approach, sign * stop]);
                        near = largest(near * length * largest(from, to), member.near(&Watched::TURN, &self.scales));
                        rate.slope()
                    }
                    Watched::Pull { .. } => {
                        let (start, stop) = (member.value(&watched, now), member.value(&watched, trial));
                        Curve::cubic([start, stop - start], [stop, stop - start])
                    }
                };
                if let Some(part) = curve.first_fall(end, near)
                    && (part < end || first.is_none())
                {
                    end = part;
                    first = Some((Target::Event(place, watched), part));
                }
            }
        }
        first
    }

    /// Repeats the step with the length that ends at the target, starting with `length`; another target may come first.
    /// Returns the target, the length, zero for a target that is here, and the error of the step as a multiple of the
    /// tolerance.
    pub(super) fn approach(
        &mut self,
        clock: Option<&Clock>,
        target: Target,
        length: f64,
        whole: f64,
    ) -> Result<(Target, f64, f64), Refused> {
        let (mut target, mut length) = (target, length);
        let (mut bracket, mut error) = (self.bracket(clock, &target, whole), 0.0);
        for attempt in 0..APPROACHES {
            if length <= 0.0 {
                return Ok((target, 0.0, 0.0));
            }
            error = self.attempt(clock, length)?;
            self.finish()?;
            let (gap, slope) = self.gap(clock, &target);
            let (change, found) = match slope {
                Some(slope) => {
                    let leads = slope < 0.0 && fabs(gap) < -0.5 * slope * length;
                    (quotient(gap, -slope, leads, 0.0), FOUND)
                }
                None => (bracket.next(length, gap, attempt) - length, FOUND_KINK),
            };
            let other = self.first_target(clock, length, Some(target));
            if let Some((other, part)) = other
                && (part - 1.0) * length < change - found * length
            {
                let before = length;
                (target, length) = (other, part * length);
                bracket = self.bracket(clock, &target, before);
                continue;
            }
            if fabs(change) <= found * length || fabs(gap) <= self.exact(&target) {
                if slope.is_none() && gap > 0.0 {
                    // short of a kink, the force before it would come back at once
                    length *= 1.0 + 4.0 * FOUND_KINK;
                    self.attempt(clock, length)?;
                    self.finish()?;
                }
                break;
            }
            length += change;
        }
        Ok((target, length, error))
    }

    /// The lengths between which the target lies, after a step of length `whole` that went beyond.
    fn bracket(&self, clock: Option<&Clock>, target: &Target, whole: f64) -> Bracket {
        let start = match target {
            Target::Event(place, watched) => {
                self.work.get(*place).map_or(0.0, |member| member.value(watched, &member.now))
            }
            Target::Time => self.left,
        };
        let (beyond, _) = self.gap(clock, target);
        Bracket { before: (0.0, largest(start, 0.0)), beyond: (whole, smallest(beyond, 0.0)) }
    }

    /// The number of the motion that falls through zero at the target, and its slope if it is known, at the end of the step
    /// that was tried.
    fn gap(&self, clock: Option<&Clock>, target: &Target) -> (f64, Option<f64>) {
        let [_, [pace, slope]] = self.paces(clock);
        let [time, w] = self.ticked;
        let Target::Event(place, watched) = *target else { return (self.left - time, Some(-pace)) };
        let Some(member) = self.work.get(place) else { return (0.0, None) };
        let (value, trial) = (member.value(&watched, &member.trial), &member.trial);
        match watched {
            Watched::Indentation { event: Event::Part, .. } if clock.is_some_and(|clock| clock.place == place) => {
                (w, Some(slope))
            }
            Watched::Indentation { sign, .. } => (value, Some(-sign * pace * trial.approach)),
            Watched::Rate { sign, .. } => (value, Some(-sign * pace * trial.bend())),
            Watched::Bend { .. } | Watched::Pull { .. } => (value, None),
        }
    }

    /// A gap that is rounding. A number that was at the threshold already only has to be clear of it.
    fn exact(&self, target: &Target) -> f64 {
        let Target::Event(place, watched) = target else { return 0.0 };
        self.work.get(*place).map_or(0.0, |member| {
            let near = member.near(watched, &self.scales);
            if member.value(watched, &member.now) > near { 0.01 * near } else { 2.0 * near }
        })
    }
}
