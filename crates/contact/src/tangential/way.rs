//! A straight piece of the motion.

use crate::numbers::quotient;
use libm::fabs;

/// A part of a motion with both rates held. Tangential lengths and rates are [scaled](super::Friction::scale).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Indentation at the start \[m\].
    pub from: f64,
    /// Indentation at the end \[m\].
    pub to: f64,
    /// Scaled tangential displacement over the way \[m\].
    pub shift: f64,
    /// Rate of the indentation; only its ratio to `tangential` matters. It is the same in all parts of a divided
    /// step. The ratio of the displacements would have rounding errors.
    pub normal: f64,
    /// Rate of the scaled tangential displacement.
    pub tangential: f64,
}

impl Way {
    /// The straight way over these distances \[m\].
    pub fn straight(from: f64, to: f64, shift: f64) -> Way {
        Way { from, to, shift, normal: to - from, tangential: shift }
    }

    /// Change of the indentation \[m\].
    pub fn rise(&self) -> f64 {
        self.to - self.from
    }

    /// The first `part` of the way.
    pub fn first_part(&self, part: f64) -> Way {
        Way { to: self.from + part * self.rise(), shift: part * self.shift, ..*self }
    }

    /// Whether there is any motion.
    pub fn moves(&self) -> bool {
        self.normal != 0.0 || self.tangential != 0.0
    }

    /// Whether the contact area grows without slip.
    pub fn sticks(&self) -> bool {
        self.normal > 0.0 && fabs(self.tangential) <= self.normal
    }

    /// d(offset)/d(height) of the springs that touch on a [sticking](Way::sticks) way.
    pub fn slope(&self) -> f64 {
        quotient(self.tangential, self.normal, self.normal > 0.0, 0.0)
    }

    /// The direction of slip, if it follows from the ratio of the rates alone. Otherwise the contact opens so fast
    /// that the direction depends on the springs.
    pub fn slip(&self) -> Option<f64> {
        (fabs(self.tangential) >= fabs(self.normal)).then_some(if self.tangential > 0.0 { 1.0 } else { -1.0 })
    }

    /// The part of the way above the `surface` \[m\], for a way that ends above it.
    pub fn above(&self, surface: f64) -> Way {
        if self.from >= surface {
            return *self;
        }
        Way { from: surface, shift: self.shift * self.part_above(surface), ..*self }
    }

    /// Length of the way above the `surface` \[m\], if one of its ends is above it.
    pub fn part_above(&self, surface: f64) -> f64 {
        let (low, high) = if self.from < self.to { (self.from, self.to) } else { (self.to, self.from) };
        quotient(high - surface, high - low, low < surface && low < high, 1.0)
    }
}
