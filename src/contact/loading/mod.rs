//! Loading laws, one file each: the curve that the force follows while the indentation is the largest so far.

pub mod big_alabo;
pub mod brinell;
pub mod hertz;

pub use big_alabo::BigAlabo;
pub use brinell::Brinell;
pub use hertz::Hertz;

use super::history::Regime;
use super::material::{Pair, YieldPoint};
use super::segment::Segment;

/// A loading law: the law's own constants, without the bodies.
///
/// All indentations are in m and not negative. The curve begins at zero indentation with Hertz's law.
pub trait Loading {
    /// The end of the elastic part; infinite if the law never yields.
    fn yield_point(&self, pair: &Pair) -> YieldPoint;

    /// The piece of the curve that holds at `indentation` and just above it, with the bounds it has on the curve. Where
    /// the curve has no segments it is the [tangent](Segment::tangent); the elastic part always is a segment.
    fn segment(&self, pair: &Pair, indentation: f64) -> Segment;

    /// The first indentation above `indentation` where the curve or its slope is not smooth [m].
    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        self.segment(pair, indentation).upper
    }

    /// Work of the loading from first contact to `indentation` [J]: in closed form, or to rounding.
    fn work(&self, pair: &Pair, indentation: f64) -> f64;

    /// Contact radius [m] while loading.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64;

    /// The regime of the loading at `indentation` and just above it.
    fn regime(&self, pair: &Pair, indentation: f64) -> Regime;
}

/// Work of a curve that is made of segments, from first contact to `indentation` [J]: the whole segments below it and the
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

/// A loading law chosen while the program runs. The FMU doesn't need it: a scene names its law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyLoading {
    /// See [`Hertz`].
    Hertz(Hertz),
    /// See [`BigAlabo`].
    BigAlabo(BigAlabo),
    /// See [`Brinell`].
    Brinell(Brinell),
}

impl AnyLoading {
    /// Every law under the name it has in a scene, with its reference constants.
    pub const ALL: [(&'static str, AnyLoading); 3] = [
        ("hertz", AnyLoading::Hertz(Hertz)),
        ("big-alabo", AnyLoading::BigAlabo(BigAlabo::REFERENCE)),
        ("brinell", AnyLoading::Brinell(Brinell::REFERENCE)),
    ];

    /// The law itself.
    pub fn law(&self) -> &dyn Loading {
        match self {
            AnyLoading::Hertz(law) => law,
            AnyLoading::BigAlabo(law) => law,
            AnyLoading::Brinell(law) => law,
        }
    }
}

impl Loading for AnyLoading {
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        self.law().yield_point(pair)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        self.law().segment(pair, indentation)
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().next_corner(pair, indentation)
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().work(pair, indentation)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().contact_radius(pair, indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        self.law().regime(pair, indentation)
    }
}
