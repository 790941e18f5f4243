//! The unloading of a line contact, from the shape of its pressure.

use super::{Peak, Unloading, residual_after};
use crate::material::Pair;
use crate::material::line::Chain;
use crate::segment::Segment;
use core::f64::consts::PI;
use libm::sqrt;

/// For every convex profile without friction, a line contact gives way as a flat punch of its present half-width does. With the half-width
/// `a^2 = a_m^2 ((1 + g) s - g s^2)`, `s = F/F_m`, indentation, work and restitution follow exactly; the path is a chain of segments by force
/// and slope at fixed parts of `F_m`.
///
/// `g = 1.027 u/(u + 2.156)`, `u = f^0.861 - 1`, is the shape of the pressure at the peak: 0 Hertz, 1 uniform. At yield it is Hertz's, and the
/// path is the elastic curve.
///
/// Against the finite elements in `data/truth/line`: path within 0.3 % of the recovery, restitution 0.24 %, dent 0.9 %. Made for the loading law
/// [`Line`](crate::loading::Line).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Line {
    /// Length of the contact `[R]`, as the loading law has it.
    pub length: f64,
}

impl Line {
    /// A contact that is as long as its effective radius.
    pub const REFERENCE: Line = Line { length: 1.0 };

    /// The way back from `peak`, and the part `s` of its force at `indentation` \[m\].
    fn chain(&self, pair: &Pair, peak: &Peak) -> Chain {
        let scale = peak.force / (PI * pair.modulus * (self.length * pair.radius));
        let super::Recovery { factor: compliance, difference: shape } = peak.recovery;
        Chain { force: peak.force, scale, compliance, shape }
    }
}

impl Unloading for Line {
    const SEGMENTED: bool = false;
    const SQUARES: bool = true;

    /// Only the ends: the segments are those of [`Unloading::tangent`].
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let residual = residual_after(peak, self.chain(pair, peak).recovery());
        Segment { lower: residual, upper: peak.indentation, origin: residual, ..Segment::NOTHING }
    }

    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment {
        self.chain(pair, peak).segment(indentation, path.lower, path.upper)
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        let s = self.tangent(pair, peak, path, indentation).force(indentation) / peak.force;
        let shape = peak.recovery.difference;
        peak.contact_radius * sqrt(s * (1.0 + shape - shape * s))
    }

    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        self.chain(pair, peak).work(indentation - path.lower, path.upper - path.lower)
    }
}
