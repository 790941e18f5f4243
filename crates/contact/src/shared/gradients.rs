//! Linear systems of contacts by conjugate gradients, to which a singular matrix does not matter.

use crate::numerics::quotient;
use libm::fabs;

/// The part of the right side that a solution may leave.
pub(super) const SOLVED: f64 = 1e-13;

/// The curvature in a direction, relative to that without couplings, below which the matrix is singular there.
const SINGULAR: f64 = 1e-10;

/// One unknown of a system `A x = side`, while it is sought.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Unknown {
    /// The solution so far.
    pub number: f64,
    /// The response of the bodies to the solution: `W x`.
    pub product: f64,
    /// What is left of the right side; zero for a number that is not sought, which stays zero.
    pub residual: f64,
    pub direction: f64,
    /// The response of the bodies to the direction: `W` times it.
    pub image: f64,
    /// The matrix `A` times the direction: the image, and the direction times what is added to the diagonal.
    pub reply: f64,
    /// What the diagonal has beyond the response of the bodies; zero unless set.
    pub own: f64,
    /// The diagonal of the matrix.
    pub diagonal: f64,
    /// Whether the number is sought.
    pub is_sought: bool,
}

impl Unknown {
    /// An unknown of this `diagonal` entry and right `side`.
    pub fn new(diagonal: f64, side: f64, is_sought: bool) -> Unknown {
        let residual = if is_sought { side } else { 0.0 };
        let unknown = Unknown { residual, diagonal, is_sought, ..Unknown::default() };
        Unknown { direction: unknown.step(), ..unknown }
    }

    /// The residual over the diagonal.
    fn step(&self) -> f64 {
        let exists = fabs(self.residual) < 1e200 * self.diagonal;
        quotient(self.residual, self.diagonal, exists, 0.0)
    }
}

/// A system whose unknowns are spread over contacts.
pub(super) trait System {
    /// Visits every unknown.
    fn visit(&mut self, each: impl FnMut(&mut Unknown));

    /// Sets image and reply of every unknown for the directions.
    fn multiply(&mut self);
}

/// Solves a system whose unknowns are [new](Unknown::new), up to this `part` of the right side.
pub(super) fn solve(system: &mut impl System, part: f64) {
    let (mut count, mut left) = (0_u32, 0.0);
    system.visit(|unknown| {
        count = count.saturating_add(1);
        left += unknown.residual * unknown.step();
    });
    let enough = part * part * left;
    // rounding may make it need more steps than there are unknowns
    for _ in 0..count.saturating_mul(4) {
        if left <= enough {
            break;
        }
        system.multiply();
        let (mut curvature, mut alone) = (0.0, 0.0);
        system.visit(|unknown| {
            curvature += unknown.direction * unknown.reply;
            alone += unknown.direction * unknown.diagonal * unknown.direction;
        });
        if !(curvature > SINGULAR * alone && left < 1e100 * curvature) {
            break;
        }
        let (step, before) = (left / curvature, left);
        left = 0.0;
        system.visit(|unknown| {
            unknown.number += step * unknown.direction;
            unknown.product += step * unknown.image;
            if unknown.is_sought {
                unknown.residual -= step * unknown.reply;
            }
            left += unknown.residual * unknown.step();
        });
        let part = quotient(left, before, left < 1e100 * before, 0.0);
        system.visit(|unknown| unknown.direction = unknown.step() + part * unknown.direction);
    }
}
