//! Loading laws, one file each: the force-indentation curve while the indentation is the largest so far.

pub mod two_bodies;

mod any;
pub mod big_alabo;
pub mod brake_2012;
pub mod brake_2015;
pub mod brinell;
pub mod brizmer;
pub mod elastic;
pub mod ghaednia;
pub mod hertz;
pub mod jackson_green;
pub mod johnson;
pub mod kogut_etsion;
pub mod line;
pub mod luding;
pub mod ma_liu;
pub mod paired;
pub mod power;
pub mod stronge;
mod table;
pub mod tabulated;
pub mod thornton;
pub mod vu_quoc_zhang;
pub mod walton_braun;
pub mod yigit_christoforou;
pub mod zhao_maietta_chang;

pub use paired::Paired;

use super::laws::{Constant, LawNumbers, Numbered, laws};
use super::material::{Pair, YieldPoint};
use super::regime::{LARGEST_INDENTATION, Regime};
use super::segment::Segment;
use super::unloading::Recovery;
use super::validity::largest_radius;
use crate::loading::two_bodies::{Construction, Together, TwoBodies};
use core::f64::consts::PI;

laws! {
    /// A loading law chosen while a program runs. In an FMU the scene names the law.
    pub enum AnyLoading: dyn Loading {
        hertz::Hertz [] { "hertz" = Hertz }
        big_alabo::BigAlabo [yield_pressure_factor, plastic_pressure_factor, second_region, fully_plastic, plastic_slope] { "big-alabo" = BigAlabo::REFERENCE }
        brinell::Brinell [yield_pressure_factor] or Brinell::REFERENCE { "brinell" = Brinell::REFERENCE }
        stronge::Stronge [yield_pressure_factor, plastic_pressure_factor] { "stronge" = Stronge::REFERENCE }
        thornton::Thornton [peak_pressure_factor] { "thornton" = Thornton::REFERENCE }
        yigit_christoforou::YigitChristoforou [yield_pressure_factor] { "yigit-christoforou" = YigitChristoforou::REFERENCE }
        zhao_maietta_chang::ZhaoMaiettaChang [yield_pressure_factor, plastic_pressure_factor, fully_plastic] { "zhao-maietta-chang" = ZhaoMaiettaChang::REFERENCE }
        ma_liu::MaLiu [peak_pressure_factor, plastic_pressure_factor, fully_plastic] { "ma-liu" = MaLiu::REFERENCE }
        power::Power [yield_pressure_factor, coefficient, exponent] { "power" = Power::REFERENCE }
        walton_braun::WaltonBraun [yield_pressure_factor, stiffness_factor] { "walton-braun" = WaltonBraun::REFERENCE }
        brake_2012::Brake2012 [hardness_factor, plastic_start] {
            "brake-2012-tangent" = Brake2012::TANGENT,
            "brake-2012-line" = Brake2012::LINE,
        }
        brake_2015::Brake2015 [hardness_factor] { "brake-2015" = Brake2015::REFERENCE }
        ghaednia::Ghaednia [hardening, hardness_factor, hardness_loss, hardening_rate] { "ghaednia" = Ghaednia::REFERENCE }
        jackson_green::JacksonGreen [yield_constant, yield_growth, transition, area_exponent, area_growth, hardness_factor] { "jackson-green" = JacksonGreen::REFERENCE }
        kogut_etsion::KogutEtsion [hardness_factor, yield_constant, yield_slope, second_region, fully_plastic, first_factor, first_exponent, second_factor, second_exponent, first_area_factor, first_area_exponent, second_area_factor, second_area_exponent] { "kogut-etsion" = KogutEtsion::REFERENCE }
        brizmer::Brizmer [yield_constant, yield_slope, force_exponent, force_slope, area_exponent, area_slope] { "brizmer" = Brizmer::REFERENCE }
        vu_quoc_zhang::VuQuocZhang [peak_pressure_factor, plastic_radius, curvature] { "vu-quoc-zhang" = VuQuocZhang::REFERENCE }
        johnson::Johnson [yield_pressure_factor, plastic_pressure_factor] { "johnson" = Johnson::REFERENCE }
        luding::Luding [yield_pressure_factor, stiffness_factor, stiffness_ratio, limit_depth] { "luding" = Luding::REFERENCE }
        tabulated::Tabulated [] or Tabulated::REFERENCE { "table" = Tabulated::REFERENCE }
        line::Line [length, impactor_reach, impactor_tension, target_reach, target_tension] or Line::REFERENCE { "line" = Line::REFERENCE }
    }
    paired { Brinell as PairedBrinell }
    springs { elastic::Elastic }
}

/// [`Unloading::recovery`](crate::Unloading::recovery) of some law.
pub type RecoveryOf<'a> = dyn Fn(&Construction<'_>, &Together) -> Recovery + 'a;

/// A loading law: its constants, without the bodies.
///
/// All indentations are in m and not negative. The curve begins with Hertz's law at zero indentation; only [`WaltonBraun`] and
/// [`Luding`] yield there, and [`Elastic`] is elastic with another power.
pub trait Loading {
    /// Whether the law yields at all. For a law that never yields, the plastic code is compiled out. Without this function the
    /// compiler could not know that no indentation exceeds an infinite yield indentation.
    fn can_yield(&self) -> bool {
        true
    }

    /// The end of the elastic part; infinite if the law never yields.
    fn yield_point(&self, pair: &Pair) -> YieldPoint;

    /// The piece of the curve that holds at `indentation` and just above it, with its bounds. Where the curve has no segments,
    /// it is the [tangent](Segment::tangent); the elastic part is always a segment.
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

    /// The elastic part as the scale of a motion: its segment, whose power has the [exponent](Loading::elastic_exponent).
    fn scale(&self, pair: &Pair) -> Segment {
        self.segment(pair, 0.0)
    }

    /// The exponent of the power in the elastic part: Hertz's.
    fn elastic_exponent(&self) -> f64 {
        hertz::EXPONENT
    }

    /// Whether the elastic part can be a chain of segments. Otherwise it is one.
    fn has_chain() -> bool
    where
        Self: Sized,
    {
        false
    }

    /// The first indentation above `indentation` where the curve or its slope is not smooth \[m\].
    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        self.segment(pair, indentation).upper
    }

    /// Work of loading from first contact to `indentation` \[J\]: in closed form, or integrated to rounding.
    fn work(&self, pair: &Pair, indentation: f64) -> f64;

    /// Work from `low` to `high` \[J\] on one smooth piece of the curve, for a law whose work is an integral there. `None`
    /// where the difference of two calls of [`Loading::work`] is as accurate.
    fn work_between(&self, _pair: &Pair, _low: f64, _high: f64) -> Option<f64> {
        None
    }

    /// Contact radius \[m\] while loading.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64;

    /// Area \[m^2\] of a contact with this contact radius \[m\].
    fn area(&self, _pair: &Pair, radius: f64) -> f64 {
        PI * radius * radius
    }

    /// Whether the law may have [widths](Loading::widths) of its own. Otherwise only the radii of the bodies count.
    fn has_own_widths() -> bool
    where
        Self: Sized,
    {
        false
    }

    /// The contact radii \[m\] up to which the law is valid, and from which on there is no contact at all, for bodies of which the smaller
    /// one has this `size` \[m\].
    fn widths(&self, pair: &Pair, size: f64) -> [f64; 2] {
        [largest_radius(pair.radius, size), size]
    }

    /// The law of a line contact between these bodies; the pair describes the impactor or the target.
    fn along_line(self, _bodies: TwoBodies, _is_impactor: bool) -> Self
    where
        Self: Sized,
    {
        self
    }

    /// The law with this list of numbers, if it is a curve of one's own.
    fn through(self, _list: &[f64]) -> Self
    where
        Self: Sized,
    {
        self
    }

    /// The regime of the loading at `indentation` and just above it.
    fn regime(&self, pair: &Pair, indentation: f64) -> Regime;

    /// [`Loading::segment`] and [`Loading::regime`] at `indentation`. A law may compute the two together at less cost; it gets
    /// the yield `point` for this.
    fn branch(&self, pair: &Pair, _point: &YieldPoint, indentation: f64) -> (Segment, Regime) {
        (self.segment(pair, indentation), self.regime(pair, indentation))
    }

    /// [`Loading::contact_radius`] \[m\] at the start of unloading. A law may compute it at less cost from the yield `point`
    /// and the `force` \[N\].
    fn radius_at(&self, pair: &Pair, _point: &YieldPoint, indentation: f64, _force: f64) -> f64 {
        self.contact_radius(pair, indentation)
    }

    /// [`Loading::radius_at`] \[m\], and how the [`recovery`](crate::Unloading::recovery) from there differs from that of the unloading law
    /// itself. Only a law of two bodies asks for it.
    fn at_peak(
        &self,
        pair: &Pair,
        point: &YieldPoint,
        indentation: f64,
        force: f64,
        _recovery: &RecoveryOf<'_>,
    ) -> (f64, Recovery) {
        (self.radius_at(pair, point, indentation, force), Recovery::NONE)
    }

    /// The law with all that depends on `pair` alone computed in advance, if that is slow. It holds for this pair only, with the same
    /// unloading law. The law `before`, with the same constants, may have it already.
    fn prepared(self, _pair: &Pair, _recovery: &RecoveryOf<'_>, _before: Option<&Self>) -> Self
    where
        Self: Sized,
    {
        self
    }

    /// The same for force and work alone, for motions whose work does not exceed `energy` \[J\]. It costs less.
    fn prepared_for(self, _pair: &Pair, _energy: f64) -> Self
    where
        Self: Sized,
    {
        self
    }

    /// Contact radius \[m\] and [`Loading::share`] at `indentation` \[m\].
    fn width(&self, pair: &Pair, indentation: f64) -> (f64, f64) {
        (self.contact_radius(pair, indentation), self.share(pair, indentation))
    }

    /// The part of the gap's curvature `1/R` that the softer body takes on at `indentation`: it sees a rigid sphere of the radius `R`
    /// over this part. The default is Hertz's, [`Pair::share`].
    fn share(&self, pair: &Pair, _indentation: f64) -> f64 {
        pair.share()
    }

    /// A number that follows from the constants, under the name that the table of laws uses for it; `None` if there is no such
    /// name.
    fn derived(&self, _name: &str) -> Option<f64> {
        None
    }

    /// The law for bodies of other strengths: hardening of the softer one `factor` times as large, strength and hardening of the harder
    /// one `others` times. The yield strength of the softer one is not part of a law.
    fn strengthened_by(self, _factor: f64, _others: f64) -> Self
    where
        Self: Sized,
    {
        self
    }
}

/// The line `f = ratio (2x - 1)` from `lower` to `upper` \[m\]. It is a constant pressure, `ratio` times the pressure at the
/// yield `point`, on the area `a^2 = R d_y (2x - 1)`.
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

/// The first of the ascending `corners` above `indentation` \[m\].
fn first_above<const CORNERS: usize>(indentation: f64, corners: [f64; CORNERS]) -> f64 {
    corners.into_iter().find(|&corner| indentation < corner).unwrap_or(LARGEST_INDENTATION)
}

/// More segments than a loading curve has.
const MOST_SEGMENTS: u32 = 128;

/// Work of a curve made of segments, from first contact to `indentation` \[J\]: the complete segments below it plus the last,
/// partial one.
///
/// The number of segments is bounded: with bodies from a forged state, a segment may end where it begins.
fn work_over_segments(law: &impl Loading, pair: &Pair, indentation: f64) -> f64 {
    let mut segment = law.segment(pair, 0.0);
    let mut work = 0.0;
    for _ in 0..MOST_SEGMENTS {
        if indentation <= segment.upper {
            break;
        }
        work += segment.work(segment.upper);
        segment = law.segment(pair, segment.upper);
    }
    work + segment.work(indentation)
}
