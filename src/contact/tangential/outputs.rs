//! What the springs of a contact show.

use super::{SAME, Stuck};
use crate::contact::segment::Segment;
use libm::fabs;

/// How much of a contact slips. The numbers are those of the variable `sliding`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sliding {
    /// No contact.
    Apart = 0,
    /// No spring has slipped since the contact last grew or reversed.
    Stick = 1,
    /// An annulus at the edge has slipped.
    PartialSlip = 2,
    /// The whole contact has slipped: Coulomb's limit.
    Sliding = 3,
}

impl Sliding {
    /// Every state, in the order of its number.
    pub const ALL: [Sliding; 4] = [Sliding::Apart, Sliding::Stick, Sliding::PartialSlip, Sliding::Sliding];
}

impl<const N: usize> Stuck<N> {
    /// Tangential force at `indentation` \[m\], where the contact is, over the coefficient of friction \[N\].
    #[inline]
    pub fn pull(&self, curve: &Segment, indentation: f64) -> f64 {
        self.list.last().map_or(0.0, |last| last.pull_up_to(curve.force(indentation)))
    }

    /// Stored tangential energy at `indentation` \[m\], times `kappa/mu` \[J\].
    pub fn energy(&self, curve: &Segment, indentation: f64) -> f64 {
        let (displacement, top) = (self.displacement.total(), curve.force(indentation));
        let vertices = self.list.vertices();
        let ends = vertices.iter().skip(1).map(|next| (next.height, next.force));
        let segments = vertices.iter().zip(ends.chain(core::iter::once((indentation, top))));
        segments
            .map(|(vertex, (height, force))| {
                // r {[w F] + r [int F dh]}, in a form that doesn't cancel on a short segment
                let rise = height - vertex.height;
                let tension = displacement - vertex.offset;
                let shortfall = force - curve.mean_force(vertex.height, height);
                vertex.slope * (tension * (force - vertex.force) - vertex.slope * rise * shortfall)
            })
            .sum()
    }

    /// How much of the contact slips.
    pub fn sliding(&self) -> Sliding {
        match self.list.vertices() {
            [] => Sliding::Apart,
            [only] if fabs(only.slope) >= 1.0 - SAME => Sliding::Sliding,
            [.., last] if fabs(last.slope) >= 1.0 - SAME => Sliding::PartialSlip,
            _ => Sliding::Stick,
        }
    }

    /// Height of the highest spring that doesn't slip \[m\], of a contact at `indentation` \[m\]; the surface if all slide.
    pub fn stick_height(&self, indentation: f64) -> f64 {
        match self.sliding() {
            Sliding::PartialSlip | Sliding::Sliding => self.list.last().map_or(indentation, |last| last.height),
            _ => indentation,
        }
    }

    /// How many segments the polyline has.
    pub fn segments(&self) -> usize {
        self.list.vertices().len()
    }
}
