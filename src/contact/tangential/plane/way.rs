//! A straight piece of the motion in two tangential directions.

use super::vector::{Vector, add, length, times};
use crate::contact::numbers::quotient;

/// A part of a motion with all rates held. Tangential lengths and rates are
/// [scaled](super::super::Friction::scale).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Indentation at the start \[m\].
    pub from: f64,
    /// Indentation at the end \[m\].
    pub to: f64,
    /// Scaled tangential displacement over the way \[m\].
    pub shift: [f64; 2],
    /// Rate of the indentation; only its ratio to `tangential` matters. It is the same in all parts of a divided step.
    pub normal: f64,
    /// Rates of the scaled tangential displacement.
    pub tangential: [f64; 2],
}

impl Way {
    /// The straight way over these distances \[m\].
    pub fn straight(from: f64, to: f64, shift: [f64; 2]) -> Way {
        Way { from, to, shift, normal: to - from, tangential: shift }
    }

    /// Change of the indentation \[m\].
    pub fn rise(&self) -> f64 {
        self.to - self.from
    }

    /// The first `part` of the way.
    pub fn first_part(&self, part: f64) -> Way {
        Way { to: self.from + part * self.rise(), shift: times(part, self.shift), ..*self }
    }

    /// Whether there is any motion.
    pub fn moves(&self) -> bool {
        self.normal != 0.0 || self.tangential != [0.0; 2]
    }

    /// Whether the contact area grows without slip.
    pub fn sticks(&self) -> bool {
        self.normal > 0.0 && length(self.tangential) <= self.normal
    }

    /// d(offset)/d(height) of the springs that touch on a [sticking](Way::sticks) way.
    pub fn slope(&self) -> [f64; 2] {
        self.tangential.map(|rate| quotient(rate, self.normal, self.normal > 0.0, 0.0))
    }

    /// Direction of the tangential motion; any direction if there is none.
    pub(super) fn direction(&self) -> Vector {
        let rate = length(self.tangential);
        if rate > 0.0 { self.tangential.map(|part| quotient(part, rate, rate > 0.0, 0.0)) } else { [1.0, 0.0] }
    }

    /// The part of the way above the `surface` \[m\], for a way that ends above it.
    pub fn above(&self, surface: f64) -> Way {
        if self.from >= surface {
            return *self;
        }
        let part = quotient(self.to - surface, self.rise(), self.to > surface, 1.0);
        Way { from: surface, shift: add([0.0; 2], part, self.shift), ..*self }
    }
}
