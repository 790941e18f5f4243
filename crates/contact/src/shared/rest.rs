//! Rest: contacts that have come into balance stay where they are for the rest of the step.
//!
//! A block is at rest if all its contacts are so slow, and so near the balance of forces, that what is left of their motion
//! is below the accuracy of a step: 1e-12 of the elastic energy that the load has stored. Nothing is remembered, so any
//! change of a load, a mass or a rate wakes it.

use super::SharedContact;
use super::block::{Block, present_stiffness};
use super::branch::Kind;
use super::step::accelerate;
use super::work::{Instant, Work};
use crate::numbers::{largest, quotient};
use core::borrow::Borrow;
use libm::{fabs, sqrt};

/// The amplitude that counts as none, relative to the static indentation: its square is the part of the energy.
const STILL: f64 = 1e-6;

/// The part of the right side that a solution may leave.
const SOLVED: f64 = 1e-13;

/// The curvature in a direction, relative to that without couplings, below which the matrix is singular there.
const SINGULAR: f64 = 1e-12;

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
            let Solution { number, product, .. } = member.solution;
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
            let Solution { number, product, .. } = member.solution;
            let Instant { force, net, .. } = member.now;
            let [indentation, rate, impulse, moment] = &mut member.now.numbers;
            *moment += h * (*impulse + 0.5 * h * force) + number;
            if member.branch.kind == Kind::Apart {
                *indentation += h * (*rate + 0.5 * h * net) - product;
            }
        }
        self.solve(|member| member.now.approach + h * member.now.net, false);
        for (_, member) in self.members_mut() {
            let Solution { number, product, .. } = member.solution;
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

    /// Solves `W x = side`, or `W K W x = side`, for the contacts that are pressed, by conjugate gradients, to which a
    /// singular matrix does not matter. The product that is kept is `W x`. The solution of a contact that is apart is zero.
    fn solve(&mut self, side: impl Fn(&Work<C>) -> f64, by_stiffness: bool) {
        let diagonal = |member: &Work<C>| match by_stiffness {
            true => member.inverse_mass * largest(member.trial.stiffness, f64::MIN_POSITIVE) * member.inverse_mass,
            false => member.inverse_mass,
        };
        let mut count: u32 = 0;
        for (_, member) in self.members_mut() {
            let residual = if member.branch.kind == Kind::Apart { 0.0 } else { side(member) };
            let exists = fabs(residual) < 1e200 * diagonal(member);
            let direction = quotient(residual, diagonal(member), exists, 0.0);
            member.solution = Solution { residual, direction, ..Solution::default() };
            count = count.saturating_add(1);
        }
        let size = |block: &Self| -> f64 {
            let sizes = block.members().map(|(_, member)| {
                let residual = member.solution.residual;
                let exists = fabs(residual) < 1e200 * diagonal(member);
                residual * quotient(residual, diagonal(member), exists, 0.0)
            });
            sizes.sum()
        };
        let mut left = size(self);
        let enough = SOLVED * SOLVED * left;
        // rounding may make it need more steps than there are contacts
        for _ in 0..count.saturating_mul(4) {
            if left <= enough {
                break;
            }
            let (mut curvature, mut alone) = (0.0, 0.0);
            for (_, member) in self.members_mut() {
                (member.trial.force, member.trial.net) = (member.solution.direction, 0.0);
            }
            accelerate(self.work, self.masses, self.first);
            for (_, member) in self.members_mut() {
                // -W direction
                member.solution.image = member.trial.net;
                if by_stiffness {
                    let is_apart = member.branch.kind == Kind::Apart;
                    let force = if is_apart { 0.0 } else { -member.trial.stiffness * member.trial.net };
                    (member.trial.force, member.trial.net) = (force, 0.0);
                }
            }
            if by_stiffness {
                accelerate(self.work, self.masses, self.first);
            }
            for (_, member) in self.members() {
                let direction = member.solution.direction;
                curvature -= direction * member.trial.net;
                alone += direction * diagonal(member) * direction;
            }
            if !(curvature > SINGULAR * alone && left < 1e100 * curvature) {
                break;
            }
            let step = left / curvature;
            for (_, member) in self.members_mut() {
                let Solution { number, product, residual, direction, image } = &mut member.solution;
                *number += step * *direction;
                *product -= step * *image;
                if member.branch.kind != Kind::Apart {
                    *residual += step * member.trial.net;
                }
            }
            let before = left;
            left = size(self);
            let part = quotient(left, before, left < 1e100 * before, 0.0);
            for (_, member) in self.members_mut() {
                let change = member.solution.residual / diagonal(member);
                member.solution.direction = change + part * member.solution.direction;
            }
        }
    }
}

/// The solution of a system for one contact, while it is sought.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Solution {
    number: f64,
    /// The product of the matrix and the solution.
    product: f64,
    residual: f64,
    direction: f64,
    /// Minus the product of the matrix and the direction.
    image: f64,
}
