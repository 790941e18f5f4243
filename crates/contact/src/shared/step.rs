//! One step of the integration: the forces at an instant, the stages, the error.

use super::block::Block;
use super::branch::Kind;
use super::clock::Clock;
use super::curve::Curve;
use super::dop853::{self, STAGES};
use super::inverse_masses::InverseMasses;
use super::work::{Instant, Work};
use super::{Refused, SharedContact};
use crate::motion::COSTLY;
use crate::numerics::{largest, quotient};
use core::borrow::Borrow;
use libm::fabs;

/// Largest error of a step of the integration, as a part of the scales of rates and indentations.
const TOLERANCE: f64 = 2e-13;

/// Errors below this part of a number do not count: they are rounding.
const ROUNDING: f64 = 2e-15;

/// The largest error of the work of a contact with a loss as a part of itself: it may be far below the scales of the motion.
const OWN_TOLERANCE: f64 = 1e-6;

/// The same for the heat of a target that gives way to bodies at a given rate.
const HELD_TOLERANCE: f64 = 1e-11;

/// The place of no contact.
const NO_CLOCK: usize = usize::MAX;

impl<C: SharedContact<M>, M, B: Borrow<M>, F: Fn(usize) -> B> Block<'_, C, M, B, F> {
    /// Forces and accelerations at present.
    pub(super) fn evaluate_now(&mut self) {
        self.cost = 0;
        let mut cost = 0;
        for (_, member) in self.members_mut() {
            member.trial = member.now;
            member.active = true;
            cost += member.branch.cost(COSTLY);
        }
        self.cost = cost;
        self.evaluate(NO_CLOCK, 0.0);
        for (_, member) in self.members_mut() {
            member.now = member.trial;
            member.active = member.branch.kind != Kind::Apart;
        }
        spread_activity(self.work, self.masses, self.first);
    }

    /// Forces and accelerations of the instants that are tried. The contact at `place_of_clock` is where the root of its
    /// height is `w`.
    fn evaluate(&mut self, place_of_clock: usize, w: f64) {
        let Block { model, first, masses, .. } = *self;
        for (place, member) in self.active_mut() {
            let branch = &member.branch;
            let (by_root, indentation) = (place == place_of_clock, member.trial.indentation());
            let at = if by_root { branch.surface() + w * w } else { indentation };
            let known = if by_root { branch.force_of_root(w) } else { branch.force(indentation) };
            let elastic = known.unwrap_or_else(|| {
                let model = model(first + place);
                let force = branch.force_without_segments(at, member.contact.plastic_model(model.borrow()).borrow());
                if by_root && w < 0.0 { -force } else { force }
            });
            let trial = &mut member.trial;
            trial.elastic = elastic;
            (trial.force, trial.approach) = (elastic, trial.rate());
            if let Some(loss) = &member.loss
                && branch.kind != Kind::Apart
            {
                if loss.needs_stiffness() {
                    let known = if by_root { branch.stiffness_of_root(w) } else { branch.stiffness(indentation) };
                    trial.stiffness = known.unwrap_or_else(|| {
                        let model = model(first + place);
                        branch.stiffness_without_segments(at, member.contact.plastic_model(model.borrow()).borrow())
                    });
                    trial.easing = loss.easing(trial.stiffness);
                }
                (trial.force, trial.approach) = loss.force_and_approach(at, elastic, trial.stiffness, trial.rate());
            } else {
                trial.easing = 0.0;
            }
            member.trial.net = member.acceleration;
        }
        accelerate(self.work, masses, first);
    }

    /// The time of the step that was tried \[s\].
    pub(super) fn passed(&self, clock: Option<&Clock>, length: f64) -> f64 {
        let [time, _] = self.ticked;
        if clock.is_some() { time } else { length }
    }

    /// Tries a step of this length. Returns its error as a multiple of the tolerance.
    pub(super) fn attempt(&mut self, clock: Option<&Clock>, length: f64) -> Result<f64, Refused> {
        self.count(self.cost.saturating_mul(STAGES as u32))?;
        let start = clock.map_or([0.0; 2], |clock| [0.0, clock.root]);
        // without any force all contacts fly
        let stages = if self.cost > 0 { STAGES } else { 0 };
        for stage in 0..stages {
            let [_, w] = if stage == 0 { start } else { self.ticks.at_stage(stage, &start, length) };
            if stage == 0 {
                self.active_mut().for_each(|(_, member)| member.trial = member.now);
            } else {
                for (_, member) in self.active_mut() {
                    member.trial.numbers = member.slopes.at_stage(stage, &member.now.numbers, length);
                }
                self.evaluate(clock.map_or(NO_CLOCK, |clock| clock.place), w);
            }
            let pace = if clock.is_some() { w } else { 1.0 };
            let mut rate_of_clock = 0.0;
            for (place, member) in self.active_mut() {
                let Instant { numbers: [_, rate, impulse, _], force, net, approach, .. } = member.trial;
                member.slopes.set(stage, [pace * approach, pace * net, pace * force, pace * impulse]);
                if let Some(loss) = &member.loss {
                    // a target that hardly gives way is not the difference of two rates
                    let rate = if member.is_held { loss.easing(force) } else { rate };
                    member.power.set(stage, [pace * force * rate]);
                }
                if clock.is_some_and(|clock| clock.place == place) {
                    rate_of_clock = approach;
                }
            }
            self.ticks.set(stage, [pace, 0.5 * rate_of_clock]);
        }
        self.ticked = self.ticks.at_end(&start, length);
        let time = self.passed(clock, length);
        self.members_mut().filter(|(_, member)| !member.active).for_each(|(_, member)| member.fly(time));
        let (mut fifth, mut third) = (0.0, 0.0);
        let scales = self.scales;
        let mut note = |of_fifth: f64, of_third: f64, number: f64, unit: f64| {
            let missed = length * fabs(of_fifth);
            if missed > ROUNDING * fabs(number) || missed.is_nan() {
                let relative = |missed: f64| quotient(missed, unit, unit > 1e-100 * missed, 1e100);
                fifth = largest(fifth, relative(missed));
                third = largest(third, relative(length * fabs(of_third)));
            }
        };
        for (_, member) in self.active_mut() {
            member.trial.numbers = member.slopes.at_end(&member.now.numbers, length);
            if member.loss.is_some() {
                let [work] = member.power.at_end(&[member.now.work], length);
                let ([work5], [work3]) = member.power.differences();
                let least = member.unresolved_part(&scales) * scales.root_energy * scales.root_energy;
                let own = if member.is_held { HELD_TOLERANCE } else { OWN_TOLERANCE };
                note(work5, work3, 0.0, own * largest(fabs(work), least));
                member.trial.work = work;
            }
            let ([way5, rate5, ..], [way3, rate3, ..]) = member.slopes.differences();
            let [indentation, rate, ..] = member.trial.numbers;
            let unit = TOLERANCE * member.speed(&scales);
            note(way5, way3, indentation, unit * scales.time);
            note(rate5, rate3, fabs(rate) + time * member.rounded_acceleration(), unit);
        }
        if clock.is_some() {
            let ([time5, _], [time3, _]) = self.ticks.differences();
            note(time5, time3, 0.0, TOLERANCE * scales.time);
        }
        Ok(dop853::error(fifth, third))
    }

    /// Forces at the end of the step that was tried.
    pub(super) fn finish(&mut self) -> Result<(), Refused> {
        self.count(self.cost)?;
        self.evaluate(NO_CLOCK, 0.0);
        Ok(())
    }

    /// Makes the step that was tried the present.
    pub(super) fn accept(&mut self, clock: Option<&Clock>, length: f64) {
        let paces = self.paces(clock);
        for (_, member) in self.members_mut() {
            // a turn on the way without yield, which is no event
            if member.branch.kind == Kind::Path && member.now.approach > 0.0 && member.trial.approach < 0.0 {
                let top = indentation_over(member, &paces, length).top();
                member.branch.note(top.unwrap_or(0.0));
            }
            member.now = member.trial;
            member.branch.note(member.now.indentation());
        }
    }

    /// The pace of time, and its slope, at both ends of the step that was tried.
    pub(super) fn paces(&self, clock: Option<&Clock>) -> [[f64; 2]; 2] {
        let Some(clock) = clock else { return [[1.0, 0.0]; 2] };
        let Some(member) = self.work.get(clock.place) else { return [[1.0, 0.0]; 2] };
        let [_, end] = self.ticked;
        [[clock.root, 0.5 * member.now.approach], [end, 0.5 * member.trial.approach]]
    }
}

/// The indentation over the step that was tried.
pub(super) fn indentation_over<C>(member: &Work<C>, paces: &[[f64; 2]; 2], length: f64) -> Curve {
    let &[start, end] = paces;
    let number = |instant: &Instant, [pace, slope]: [f64; 2]| {
        let (rate, bend) = (instant.approach, instant.bend());
        [instant.indentation(), pace * rate * length, (slope * rate + pace * pace * bend) * length * length]
    };
    Curve::quintic(number(&member.now, start), number(&member.trial, end))
}

/// Makes every contact active that is coupled with one that is pressed.
fn spread_activity<C>(work: &mut [Work<C>], masses: &InverseMasses, first: usize) {
    let mut rest = work;
    for row in masses.rows(first) {
        let Some((member, others)) = core::mem::take(&mut rest).split_first_mut() else { return };
        let is_pressed = |member: &Work<C>| member.block == first && member.branch.kind != Kind::Apart;
        for (other, &entry) in others.iter_mut().take(member.reach).zip(row.iter().skip(1)) {
            if entry != 0.0 {
                other.active |= is_pressed(member);
                member.active |= is_pressed(other);
            }
        }
        rest = others;
    }
}

/// Adds the accelerations by the contact forces: `-W F`. A row of the matrix ends with its last coupled contact.
#[inline(always)]
pub(super) fn accelerate<C>(work: &mut [Work<C>], masses: &InverseMasses, first: usize) {
    let mut rest = work;
    for row in masses.rows(first) {
        let Some((member, others)) = core::mem::take(&mut rest).split_first_mut() else { return };
        if member.block == first
            && member.active
            && let Some((own, row)) = row.split_first()
        {
            let force = member.trial.force;
            member.trial.net -= own * force;
            for (other, entry) in others.iter_mut().take(member.reach).zip(row) {
                member.trial.net -= entry * other.trial.force;
                other.trial.net -= entry * force;
            }
        }
        rest = others;
    }
}
