//! Loading laws, one file each: the curve that the force follows while the indentation is the largest so far.

// `pub mod big_alabo; pub use big_alabo::BigAlabo;` and so on, of every law in modelDescription/laws.toml; see build/laws.rs
include!(concat!(env!("OUT_DIR"), "/loading_laws.rs"));

pub mod strengthened;
pub use strengthened::Strengthened;

use super::history::{LARGEST_INDENTATION, Regime};
use super::material::{Pair, YieldPoint};
use super::segment::Segment;

/// A loading law: the law's own constants, without the bodies.
///
/// All indentations are in m and not negative. The curve begins at zero indentation with Hertz's law; only [`WaltonBraun`]
/// and [`Luding`] yield there.
pub trait Loading {
    /// Whether the law yields at all. Of a unit whose law doesn't nothing plastic is compiled: the compiler can't see that
    /// no indentation is above an infinite one.
    fn can_yield(&self) -> bool {
        true
    }

    /// The end of the elastic part; infinite if the law never yields.
    fn yield_point(&self, pair: &Pair) -> YieldPoint;

    /// The piece of the curve that holds at `indentation` and just above it, with the bounds it has on the curve. Where
    /// the curve has no segments it is the [tangent](Segment::tangent); the elastic part always is a segment.
    fn segment(&self, pair: &Pair, indentation: f64) -> Segment;

    /// Whether every piece of the curve is a segment, and none a tangent.
    fn is_segmented(&self) -> bool {
        true
    }

    /// Whether a segment of the law can have a quadratic term.
    fn has_squares() -> bool
    where
        Self: Sized,
    {
        false
    }

    /// The first indentation above `indentation` where the curve or its slope is not smooth \[m\].
    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        self.segment(pair, indentation).upper
    }

    /// Work of the loading from first contact to `indentation` \[J\]: in closed form, or to rounding.
    fn work(&self, pair: &Pair, indentation: f64) -> f64;

    /// Work from `low` to `high` \[J\], on one smooth piece of the curve, of a law whose work is an integral there. None
    /// where a difference of two [`Loading::work`] is as good.
    fn work_between(&self, _pair: &Pair, _low: f64, _high: f64) -> Option<f64> {
        None
    }

    /// Contact radius \[m\] while loading.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64;

    /// The regime of the loading at `indentation` and just above it.
    fn regime(&self, pair: &Pair, indentation: f64) -> Regime;

    /// [`Loading::segment`] and [`Loading::regime`] at `indentation`. A law may find the two together in less, the more so as
    /// it is told the yield `point`.
    fn branch(&self, pair: &Pair, _point: &YieldPoint, indentation: f64) -> (Segment, Regime) {
        (self.segment(pair, indentation), self.regime(pair, indentation))
    }

    /// [`Loading::contact_radius`] \[m\] where the load begins to come off. A law may find it in less, as it is told the yield
    /// `point` and the `force` \[N\].
    fn radius_at(&self, pair: &Pair, _point: &YieldPoint, indentation: f64, _force: f64) -> f64 {
        self.contact_radius(pair, indentation)
    }

    /// A number that follows from the constants, by the name under which the table of laws cites it; `None` if there is none
    /// of this name.
    fn derived(&self, _name: &str) -> Option<f64> {
        None
    }
}

/// The line `f = ratio (2x - 1)` from `lower` to `upper` \[m\]: a constant pressure, `ratio` times that at the yield `point`, on
/// the area `a^2 = R d_y (2x - 1)`.
fn constant_pressure(point: &YieldPoint, ratio: f64, lower: f64, upper: f64) -> Segment {
    Segment {
        lower,
        upper,
        origin: lower,
        constant: ratio * (2.0 * (lower / point.indentation) - 1.0) * point.force,
        linear: 2.0 * ratio * (point.force / point.indentation),
        ..Segment::NOTHING
    }
}

/// The first of a law's rising `corners` above `indentation` \[m\].
fn first_above<const CORNERS: usize>(indentation: f64, corners: [f64; CORNERS]) -> f64 {
    corners.into_iter().find(|&corner| indentation < corner).unwrap_or(LARGEST_INDENTATION)
}

/// Work of a curve that is made of segments, from first contact to `indentation` \[J\]: the whole segments below it and the
/// begun one.
fn work_over_segments(law: &impl Loading, pair: &Pair, indentation: f64) -> f64 {
    let mut segment = law.segment(pair, 0.0);
    let mut work = 0.0;
    while segment.upper < indentation {
        work += segment.work(segment.upper);
        segment = law.segment(pair, segment.upper);
    }
    work + segment.work(indentation)
}
