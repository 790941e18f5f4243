//! Loading laws, one file each: the curve that the force follows while the indentation is the largest so far.

pub mod big_alabo;
pub mod brake_2012;
pub mod brake_2015;
pub mod brinell;
pub mod ghaednia;
pub mod hertz;
pub mod jackson_green;
pub mod johnson;
pub mod kogut_etsion;
pub mod luding;
pub mod ma_liu;
pub mod power;
pub mod stronge;
pub mod thornton;
pub mod vu_quoc_zhang;
pub mod walton_braun;
pub mod yigit_christoforou;
pub mod zhao_maietta_chang;

pub use big_alabo::BigAlabo;
pub use brake_2012::Brake2012;
pub use brake_2015::Brake2015;
pub use brinell::Brinell;
pub use ghaednia::Ghaednia;
pub use hertz::Hertz;
pub use jackson_green::JacksonGreen;
pub use johnson::Johnson;
pub use kogut_etsion::KogutEtsion;
pub use luding::Luding;
pub use ma_liu::MaLiu;
pub use power::Power;
pub use stronge::Stronge;
pub use thornton::Thornton;
pub use vu_quoc_zhang::VuQuocZhang;
pub use walton_braun::WaltonBraun;
pub use yigit_christoforou::YigitChristoforou;
pub use zhao_maietta_chang::ZhaoMaiettaChang;

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

    /// The first indentation above `indentation` where the curve or its slope is not smooth [m].
    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        self.segment(pair, indentation).upper
    }

    /// Work of the loading from first contact to `indentation` [J]: in closed form, or to rounding.
    fn work(&self, pair: &Pair, indentation: f64) -> f64;

    /// Work from `low` to `high` [J], on one smooth piece of the curve, of a law whose work is an integral there. None
    /// where a difference of two [`Loading::work`] is as good.
    fn work_between(&self, _pair: &Pair, _low: f64, _high: f64) -> Option<f64> {
        None
    }

    /// Contact radius [m] while loading.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64;

    /// The regime of the loading at `indentation` and just above it.
    fn regime(&self, pair: &Pair, indentation: f64) -> Regime;
}

/// The line `f = ratio (2x - 1)` from `lower` to `upper` [m]: a constant pressure, `ratio` times that at the yield `point`, on
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

/// The first of a law's rising `corners` above `indentation` [m].
fn first_above<const CORNERS: usize>(indentation: f64, corners: [f64; CORNERS]) -> f64 {
    corners.into_iter().find(|&corner| indentation < corner).unwrap_or(LARGEST_INDENTATION)
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
#[cfg_attr(feature = "exporter", derive(serde::Serialize, serde::Deserialize))]
pub enum AnyLoading {
    /// See [`Hertz`].
    Hertz(Hertz),
    /// See [`BigAlabo`].
    BigAlabo(BigAlabo),
    /// See [`Brinell`].
    Brinell(Brinell),
    /// See [`Stronge`].
    Stronge(Stronge),
    /// See [`Thornton`].
    Thornton(Thornton),
    /// See [`YigitChristoforou`].
    YigitChristoforou(YigitChristoforou),
    /// See [`ZhaoMaiettaChang`].
    ZhaoMaiettaChang(ZhaoMaiettaChang),
    /// See [`MaLiu`].
    MaLiu(MaLiu),
    /// See [`Power`].
    Power(Power),
    /// See [`WaltonBraun`].
    WaltonBraun(WaltonBraun),
    /// See [`Brake2012`].
    Brake2012(Brake2012),
    /// See [`Brake2015`].
    Brake2015(Brake2015),
    /// See [`Ghaednia`].
    Ghaednia(Ghaednia),
    /// See [`JacksonGreen`].
    JacksonGreen(JacksonGreen),
    /// See [`KogutEtsion`].
    KogutEtsion(KogutEtsion),
    /// See [`VuQuocZhang`].
    VuQuocZhang(VuQuocZhang),
    /// See [`Johnson`].
    Johnson(Johnson),
    /// See [`Luding`].
    Luding(Luding),
}

impl AnyLoading {
    /// Every law under the name it has in a scene, with its reference constants.
    pub const ALL: [(&'static str, AnyLoading); 19] = [
        ("hertz", AnyLoading::Hertz(Hertz)),
        ("big-alabo", AnyLoading::BigAlabo(BigAlabo::REFERENCE)),
        ("brinell", AnyLoading::Brinell(Brinell::REFERENCE)),
        ("stronge", AnyLoading::Stronge(Stronge::REFERENCE)),
        ("thornton", AnyLoading::Thornton(Thornton::REFERENCE)),
        ("yigit-christoforou", AnyLoading::YigitChristoforou(YigitChristoforou::REFERENCE)),
        ("zhao-maietta-chang", AnyLoading::ZhaoMaiettaChang(ZhaoMaiettaChang::REFERENCE)),
        ("ma-liu", AnyLoading::MaLiu(MaLiu::REFERENCE)),
        ("power", AnyLoading::Power(Power::REFERENCE)),
        ("walton-braun", AnyLoading::WaltonBraun(WaltonBraun::REFERENCE)),
        ("brake-2012-tangent", AnyLoading::Brake2012(Brake2012::TANGENT)),
        ("brake-2012-line", AnyLoading::Brake2012(Brake2012::LINE)),
        ("brake-2015", AnyLoading::Brake2015(Brake2015::REFERENCE)),
        ("ghaednia", AnyLoading::Ghaednia(Ghaednia::REFERENCE)),
        ("jackson-green", AnyLoading::JacksonGreen(JacksonGreen::REFERENCE)),
        ("kogut-etsion", AnyLoading::KogutEtsion(KogutEtsion::REFERENCE)),
        ("vu-quoc-zhang", AnyLoading::VuQuocZhang(VuQuocZhang::REFERENCE)),
        ("johnson", AnyLoading::Johnson(Johnson::REFERENCE)),
        ("luding", AnyLoading::Luding(Luding::REFERENCE)),
    ];

    /// The law itself.
    pub fn law(&self) -> &dyn Loading {
        match self {
            AnyLoading::Hertz(law) => law,
            AnyLoading::BigAlabo(law) => law,
            AnyLoading::Brinell(law) => law,
            AnyLoading::Stronge(law) => law,
            AnyLoading::Thornton(law) => law,
            AnyLoading::YigitChristoforou(law) => law,
            AnyLoading::ZhaoMaiettaChang(law) => law,
            AnyLoading::MaLiu(law) => law,
            AnyLoading::Power(law) => law,
            AnyLoading::WaltonBraun(law) => law,
            AnyLoading::Brake2012(law) => law,
            AnyLoading::Brake2015(law) => law,
            AnyLoading::Ghaednia(law) => law,
            AnyLoading::JacksonGreen(law) => law,
            AnyLoading::KogutEtsion(law) => law,
            AnyLoading::VuQuocZhang(law) => law,
            AnyLoading::Johnson(law) => law,
            AnyLoading::Luding(law) => law,
        }
    }
}

impl Loading for AnyLoading {
    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        self.law().yield_point(pair)
    }

    fn can_yield(&self) -> bool {
        self.law().can_yield()
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        self.law().segment(pair, indentation)
    }

    fn is_segmented(&self) -> bool {
        self.law().is_segmented()
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().next_corner(pair, indentation)
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().work(pair, indentation)
    }

    fn work_between(&self, pair: &Pair, low: f64, high: f64) -> Option<f64> {
        self.law().work_between(pair, low, high)
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        self.law().contact_radius(pair, indentation)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        self.law().regime(pair, indentation)
    }
}
