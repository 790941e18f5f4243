//! Rest: contacts that have come into balance stay where they are for the rest of the step.
//!
//! A block is at rest if all its contacts are so slow, and so near the balance of forces, that what is left of their motion
//! is below the accuracy of a step: 1e-12 of the elastic energy that the load has stored. Nothing is remembered, so any
//! change of a load, a mass or a rate wakes it.

use super::SharedContact;
use super::block::{Block, present_stiffness};
use super::branch::Kind;
use super::gradients::{self, SOLVED, System, Unknown};
use super::step::accelerate;
use super::work::{Instant, Work};
use crate::numerics::{largest, quotient};
use core::borrow::Borrow;
use libm::{fabs, sqrt};

/// The amplitude that counts as none, relative to the static indentation: its square is the part of the energy.
pub(super) const STILL: f64 = 1e-6;

/// The rate of indentation, relative to the largest one, at which a target counts as giving way at a given rate.
const STEADY: f64 = 1e-11;

/// Accelerations of this part of those of all forces are rounding: the balance needs no correction.
const BALANCED: f64 = 1e-13;

impl<C: SharedContact<M>, M, B: Borrow<M>, F: Fn(usize) -> B> Block<'_, C, M, B, F> {
    /// Whether the block is at rest until the end of the step. The forces are then those without rates.
    pub(super) fn rests(&mut self) -> bool {
        // most motions are far from rest
        let quick = |member: &Work<C>| fabs(member.now.approach) > 2.0 * STILL * member.speed(&self.scales);
        if self.members().any(|(_, member)| quick(member)) {
            return false;
        }
        if let Some((_, member)) = self.members().find(|(_, member)| member.is_held) {
            // the target gives way at the given rate
            let is_pressed = member.branch.kind != Kind::Apart && member.now.rate() > 0.0;
            return is_pressed && fabs(member.now.approach) <= STEADY * member.speed(&self.scales);
        }
        let (mut stored, mut stiffest) = (0.0, 0.0);
        for (place, member) in self.members() {
            if member.branch.kind == Kind::Apart {
                continue;
            }
            if member.loss.is_some_and(|loss| loss.slack) {
                return false;
            }
            let elastic = member.now.elastic;
            let stiffness = self.stiffness(place, member);
            stored = largest(quotient(elastic * elastic, stiffness, stiffness > 1e-100 * fabs(elastic), 0.0), stored);
            stiffest = largest(stiffness, stiffest);
        }
        let slow = STILL * sqrt(stored);
        let is_slow = |member: &Work<C>| fabs(member.now.approach) <= slow * sqrt(member.inverse_mass);
        if !(stored > 0.0 && self.members().all(|(_, member)| is_slow(member))) {
            return false;
        }
        for (_, member) in self.members_mut() {
            (member.trial.force, member.trial.net) = (member.now.elastic, member.acceleration);
        }
        accelerate(self.work, self.masses, self.first);
        let balanced = slow * sqrt(stiffest);
        let is_balanced = |member: &Work<C>| fabs(member.trial.net) <= balanced * member.inverse_mass;
        if !self.members().all(|(_, member)| is_balanced(member) && self.stays_apart(member)) {
            return false;
        }
        self.members_mut()
            .for_each(|(_, member)| (member.now.force, member.now.net) = (member.trial.force, member.trial.net));
        true
    }

    /// Whether a contact that is apart stays so; true for others.
    fn stays_apart(&self, member: &Work<C>) -> bool {
        let way = self.left * (largest(member.now.rate(), 0.0) + 0.5 * self.left * largest(member.trial.net, 0.0));
        member.branch.kind != Kind::Apart || member.now.indentation() + way < member.branch.surface()
    }

    /// Holds every contact in balance until the end of the step. The impulses end the rates, and the distances that the
    /// bodies would still move: `P = h F + c` and `Q = h^2 F/2 + q` with `W c = r + h r'` and `W q = h r + h^2 r'/2`. A
    /// target that gives way goes on at its rate.
    pub(super) fn rest(&mut self) {
        let h = self.left;
        self.find_balance();
        for (_, member) in self.members_mut() {
            let Unknown { number, product, .. } = member.solution;
            let stiffness = if member.branch.kind == Kind::Apart { 0.0 } else { member.trial.stiffness };
            let [indentation, _, _, moment] = &mut member.now.numbers;
            *moment -= number;
            *indentation += product;
            member.now.work += (member.now.force + 0.5 * stiffness * product) * product;
            member.now.force += stiffness * product;
            member.now.approach -= member.now.easing * product;
            (member.trial.force, member.trial.net) = (member.now.force, member.acceleration);
        }
        accelerate(self.work, self.masses, self.first);
        self.members_mut().for_each(|(_, member)| member.now.net = member.trial.net);
        self.solve(|member| h * (member.now.approach + 0.5 * h * member.now.net), false);
        for (_, member) in self.members_mut() {
            let Unknown { number, product, .. } = member.solution;
            let Instant { force, net, .. } = member.now;
            let [indentation, rate, impulse, moment] = &mut member.now.numbers;
            *moment += h * (*impulse + 0.5 * h * force) + number;
            if member.branch.kind == Kind::Apart {
                *indentation += h * (*rate + 0.5 * h * net) - product;
            }
        }
        self.solve(|member| member.now.approach + h * member.now.net, false);
        for (_, member) in self.members_mut() {
            let Unknown { number, product, .. } = member.solution;
            let Instant { force, net, approach, .. } = member.now;
            let [_, rate, impulse, _] = &mut member.now.numbers;
            *impulse += h * force + number;
            *rate = if member.branch.kind == Kind::Apart { *rate + h * net - product } else { *rate - approach };
            member.now.work += force * (*rate * h);
            member.now.approach = 0.0;
        }
        self.left = 0.0;
    }

    /// Finds the distances to the balance of forces: `W K W x = r'`, and the contacts go deeper by `W x`, as the bodies can.
    fn find_balance(&mut self) {
        let Block { model, first, .. } = *self;
        let mut is_balanced = true;
        for (place, member) in self.members_mut() {
            member.trial.stiffness = present_stiffness(member, || model(first + place));
            let forces = fabs(member.acceleration) + member.inverse_mass * fabs(member.now.force);
            is_balanced &= fabs(member.now.net) <= BALANCED * forces;
        }
        self.solve(|member| if is_balanced { 0.0 } else { member.now.net }, true);
    }

    /// Solves `W x = side`, or `W K W x = side`, for the contacts that are pressed. The product that is kept is `W x`. The solution
    /// of a contact that is apart is zero.
    fn solve(&mut self, side: impl Fn(&Work<C>) -> f64, by_stiffness: bool) {
        for (_, member) in self.members_mut() {
            let stiffness = largest(member.trial.stiffness, f64::MIN_POSITIVE);
            let factor = if by_stiffness { stiffness * member.inverse_mass } else { 1.0 };
            let is_sought = member.branch.kind != Kind::Apart;
            member.solution = Unknown::new(member.inverse_mass * factor, side(member), is_sought);
        }
        gradients::solve(&mut Balance { block: self, by_stiffness }, SOLVED);
    }
}

/// The system of a block at rest.
struct Balance<'a, 'b, C, M, B, F> {
    block: &'a mut Block<'b, C, M, B, F>,
    by_stiffness: bool,
}

impl<C: SharedContact<M>, M, B: Borrow<M>, F: Fn(usize) -> B> System for Balance<'_, '_, C, M, B, F> {
    fn visit(&mut self, mut each: impl FnMut(&mut Unknown)) {
        self.block.members_mut().for_each(|(_, member)| each(&mut member.solution));
    }

    fn multiply(&mut self) {
        let Balance { block, by_stiffness } = self;
        for (_, member) in block.members_mut() {
            (member.trial.force, member.trial.net) = (member.solution.direction, 0.0);
        }
        accelerate(block.work, block.masses, block.first);
        for (_, member) in block.members_mut() {
            // -W direction
            member.solution.image = -member.trial.net;
            if *by_stiffness {
                let is_apart = member.branch.kind == Kind::Apart;
                let force = if is_apart { 0.0 } else { -member.trial.stiffness * member.trial.net };
                (member.trial.force, member.trial.net) = (force, 0.0);
            }
        }
        if *by_stiffness {
            accelerate(block.work, block.masses, block.first);
        }
        block.members_mut().for_each(|(_, member)| member.solution.reply = -member.trial.net);
    }
}
