//! Output quantities of the springs.

use super::{SAME, Stuck};
use crate::numbers::largest;
use crate::segment::Segment;
use libm::fabs;

/// Slip state of a contact. The numbers are those of the variable `sliding`.
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

/// A quantity of the friction of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Tangential force in this direction, counted from 0 \[N\].
    Force(usize),
    /// Mean tangential force of the last step in this direction \[N\].
    MeanForce(usize),
    /// Integral of the tangential force in this direction over time since the start \[N.s\].
    Impulse(usize),
    /// Elastic energy of the tangential strain \[J\].
    Energy,
    /// Energy lost by slip since the start \[J\].
    FrictionWork,
    /// Radius of the stick area \[m\].
    StickRadius,
}

impl Sliding {
    /// All states, in the order of their numbers.
    pub const ALL: [Sliding; 4] = [Sliding::Apart, Sliding::Stick, Sliding::PartialSlip, Sliding::Sliding];
}

impl<const N: usize, const PARTS: u32> Stuck<N, PARTS> {
    /// Tangential force at the current `indentation` \[m\], divided by the coefficient of friction \[N\].
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
        let energy = segments.fold(0.0, |sum, (vertex, (height, force))| {
            // r {[w F] + r [int F dh]}, in a form without cancellation on a short segment
            let rise = height - vertex.height;
            let tension = displacement - vertex.offset;
            let shortfall = force - curve.mean_force(vertex.height, height);
            sum + vertex.slope * (tension * (force - vertex.force) - vertex.slope * rise * shortfall)
        });
        // slopes below `SAME` may count as zero
        largest(0.0, energy)
    }

    /// Slip state of the contact.
    pub fn sliding(&self) -> Sliding {
        match self.list.vertices() {
            [] => Sliding::Apart,
            [only] if fabs(only.slope) >= 1.0 - SAME => Sliding::Sliding,
            [.., last] if fabs(last.slope) >= 1.0 - SAME => Sliding::PartialSlip,
            _ => Sliding::Stick,
        }
    }

    /// Height \[m\] of the highest spring that sticks, for a contact at `indentation` \[m\]; the surface if all
    /// springs slide.
    pub fn stick_height(&self, indentation: f64) -> f64 {
        match self.sliding() {
            Sliding::PartialSlip | Sliding::Sliding => self.list.last().map_or(indentation, |last| last.height),
            _ => indentation,
        }
    }

    /// Number of segments of the polyline.
    pub fn segments(&self) -> usize {
        self.list.vertices().len()
    }
}
