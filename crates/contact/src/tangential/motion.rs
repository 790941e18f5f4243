//! A straight piece of the motion in any number of tangential directions.

use super::vector::{self, length, times};
use crate::numerics::quotient;
use libm::fabs;

/// A part of a motion with all rates held, in `D` tangential directions. Tangential lengths and rates are
/// [scaled](super::Friction::scale).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<const D: usize> {
    /// Indentation at the start \[m\].
    pub from: f64,
    /// Indentation at the end \[m\].
    pub to: f64,
    /// Scaled tangential displacement over the way \[m\].
    pub shift: [f64; D],
    /// Rate of the indentation; only its ratio to `tangential` matters. It is the same in all parts of a divided step. The
    /// ratio of the displacements would have rounding errors.
    pub normal: f64,
    /// Rates of the scaled tangential displacement.
    pub tangential: [f64; D],
}

impl<const D: usize> Motion<D> {
    /// The straight way over these distances \[m\].
    pub fn straight(from: f64, to: f64, shift: [f64; D]) -> Motion<D> {
        Motion { from, to, shift, normal: to - from, tangential: shift }
    }

    /// Change of the indentation \[m\].
    pub fn rise(&self) -> f64 {
        self.to - self.from
    }

    /// The first `part` of the way.
    pub fn first_part(&self, part: f64) -> Motion<D> {
        Motion { to: self.from + part * self.rise(), shift: times(part, self.shift), ..*self }
    }

    /// Whether there is any motion.
    pub fn moves(&self) -> bool {
        self.normal != 0.0 || self.tangential.iter().any(|&rate| rate != 0.0)
    }

    /// The part of the way above the `surface` \[m\], for a way that ends above it.
    pub fn above(&self, surface: f64) -> Motion<D> {
        if self.from >= surface {
            return *self;
        }
        let part = self.part_above(surface);
        Motion { from: surface, shift: times(part, self.shift), ..*self }
    }

    /// Length of the way above the `surface` \[m\] as a part of the way, if one of its ends is above it.
    pub fn part_above(&self, surface: f64) -> f64 {
        let (low, high) = if self.from < self.to { (self.from, self.to) } else { (self.to, self.from) };
        quotient(high - surface, high - low, low < surface && low < high, 1.0)
    }

    /// Whether the contact area grows without slip.
    pub fn sticks(&self) -> bool {
        self.normal > 0.0 && length(self.tangential) <= self.normal
    }

    /// d(offset)/d(height) of the springs that touch on a [sticking](Motion::sticks) way.
    pub fn slope(&self) -> [f64; D] {
        self.tangential.map(|rate| quotient(rate, self.normal, self.normal > 0.0, 0.0))
    }

    /// Direction of the tangential motion; any direction if there is none.
    pub(super) fn direction(&self) -> [f64; D] {
        vector::direction(self.tangential)
    }

    /// The direction in which the edge slips, if it follows from the ratio of the rates alone. Otherwise the contact opens so
    /// fast that the direction depends on the springs.
    pub(super) fn slip(&self) -> Option<[f64; D]> {
        (length(self.tangential) >= fabs(self.normal)).then(|| self.direction())
    }
}
