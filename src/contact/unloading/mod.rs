//! Unloading laws, one file each: the path from the largest indentation down to the dent that remains.
//!
//! All are closures: from the point of the loading curve where the load begins to come off they give the elastic recovery
//! `d_e = d_m - d_f`, and with it the whole path. Reloading follows the same path back.

pub mod brinell;
pub mod contact_radius;
pub mod deformed_radius;
pub mod etsion;
pub mod guarded;
pub mod hertz_shift;
pub mod jackson;
pub mod luding;
pub mod original_radius;
pub mod thornton;
pub mod vu_quoc_zhang;
pub mod walton_braun;

pub use brinell::Brinell;
pub use contact_radius::ContactRadius;
pub use deformed_radius::DeformedRadius;
pub use etsion::Etsion;
pub use guarded::Guarded;
pub use hertz_shift::HertzShift;
pub use jackson::Jackson;
pub use luding::Luding;
pub use original_radius::OriginalRadius;
pub use thornton::Thornton;
pub use vu_quoc_zhang::VuQuocZhang;
pub use walton_braun::WaltonBraun;

use super::material::Pair;
use super::segment::Segment;
use libm::sqrt;

/// The point of the loading curve from which the load comes off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Largest indentation `d_m` [m].
    pub indentation: f64,
    /// Force there `F_m` [N].
    pub force: f64,
    /// Contact radius there `a_m` [m].
    pub contact_radius: f64,
    /// Force at which the loading law begins to yield `F_y` [N].
    pub yield_force: f64,
    /// Work of the loading up to there [J]; NaN for a law that doesn't [need](Unloading::needs_work) it.
    pub work: f64,
}

/// An unloading law.
pub trait Unloading {
    /// Whether the whole path is one segment. Otherwise only its ends are of use, and [`Unloading::tangent`] and
    /// [`Unloading::work`] say the rest.
    const SEGMENTED: bool = true;

    /// Whether a segment can have a quadratic term.
    const SQUARES: bool = false;

    /// Whether the law asks for the work of the loading, which may be an integral.
    fn needs_work(&self) -> bool {
        false
    }

    /// Whether the passivity guard shortens the path from `peak`; without guard never.
    fn holds_back(&self, _pair: &Pair, _peak: &Peak) -> bool {
        false
    }

    /// The path from the residual indentation `d_f` (`lower`) to `peak` (`upper`), for a peak beyond the yield point.
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment;

    /// The [tangent](Segment::tangent) of a `path` that is no segment.
    fn tangent(&self, _pair: &Pair, _peak: &Peak, path: &Segment, _indentation: f64) -> Segment {
        *path
    }

    /// Contact radius on the `path` [m]: that of a Hertzian recovery, `a = a_m sqrt((d - d_f)/d_e)`.
    fn contact_radius(&self, _pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        peak.contact_radius * sqrt((indentation - path.lower) / (path.upper - path.lower))
    }

    /// Work given back on a `path` that is no segment, from `indentation` down to its lower end [J].
    fn work(&self, _pair: &Pair, _peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        path.work(indentation)
    }
}

/// The residual indentation that an elastic `recovery` [m] leaves of `peak` [m].
///
/// A residual of a few units in the last place of the peak is none: the recovery just beyond yield is the whole
/// indentation, rounded. Far beyond anything physical the recovery is less than the last digit of the indentation, but it
/// isn't nothing.
fn residual_after(peak: &Peak, recovery: f64) -> f64 {
    let difference = peak.indentation - recovery;
    let rounding = 8.0 * f64::EPSILON * peak.indentation;
    if difference > -rounding && difference < rounding {
        0.0
    } else if difference < peak.indentation {
        difference
    } else {
        peak.indentation.next_down()
    }
}

/// `F = F_m ((d - d_f)/d_e)^1.5`: Hertzian unloading with the elastic recovery `d_e` [m].
///
/// `d_e` is taken again from the rounded `d_f`, so that the path ends in the peak to the last bits.
fn hertzian(peak: &Peak, recovery: f64) -> Segment {
    let residual = residual_after(peak, recovery);
    let recovery = peak.indentation - residual;
    Segment {
        lower: residual,
        upper: peak.indentation,
        origin: residual,
        power: peak.force / (recovery * sqrt(recovery)),
        ..Segment::NOTHING
    }
}

/// A straight line from the `residual` indentation [m] to the peak.
fn straight(peak: &Peak, residual: f64) -> Segment {
    let residual = if residual < peak.indentation { residual } else { peak.indentation.next_down() };
    Segment {
        lower: residual,
        upper: peak.indentation,
        origin: residual,
        linear: peak.force / (peak.indentation - residual),
        ..Segment::NOTHING
    }
}

/// An unloading law chosen while the program runs. The FMU doesn't need it: a scene names its law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "exporter", derive(serde::Serialize, serde::Deserialize))]
pub enum AnyUnloading {
    /// See [`ContactRadius`].
    ContactRadius(ContactRadius),
    /// See [`Thornton`].
    Thornton(Thornton),
    /// See [`OriginalRadius`].
    OriginalRadius(OriginalRadius),
    /// See [`DeformedRadius`].
    DeformedRadius(DeformedRadius),
    /// See [`HertzShift`].
    HertzShift(HertzShift),
    /// See [`Brinell`].
    Brinell(Brinell),
    /// See [`WaltonBraun`].
    WaltonBraun(WaltonBraun),
    /// See [`Etsion`].
    Etsion(Etsion),
    /// See [`Jackson`].
    Jackson(Jackson),
    /// See [`VuQuocZhang`].
    VuQuocZhang(VuQuocZhang),
    /// See [`Luding`].
    Luding(Luding),
    /// See [`Guarded`].
    GuardedContactRadius(Guarded<ContactRadius>),
    /// See [`Guarded`].
    GuardedThornton(Guarded<Thornton>),
    /// See [`Guarded`].
    GuardedOriginalRadius(Guarded<OriginalRadius>),
    /// See [`Guarded`].
    GuardedDeformedRadius(Guarded<DeformedRadius>),
}

impl AnyUnloading {
    /// Every law under the name it has in a scene, with its reference constants.
    pub const ALL: [(&'static str, AnyUnloading); 11] = [
        ("contact-radius", AnyUnloading::ContactRadius(ContactRadius)),
        ("thornton", AnyUnloading::Thornton(Thornton)),
        ("original-radius", AnyUnloading::OriginalRadius(OriginalRadius)),
        ("deformed-radius", AnyUnloading::DeformedRadius(DeformedRadius::REFERENCE)),
        ("hertz-shift", AnyUnloading::HertzShift(HertzShift)),
        ("brinell", AnyUnloading::Brinell(Brinell::REFERENCE)),
        ("walton-braun", AnyUnloading::WaltonBraun(WaltonBraun::REFERENCE)),
        ("etsion", AnyUnloading::Etsion(Etsion::REFERENCE)),
        ("jackson", AnyUnloading::Jackson(Jackson::REFERENCE)),
        ("vu-quoc-zhang", AnyUnloading::VuQuocZhang(VuQuocZhang::REFERENCE)),
        ("luding", AnyUnloading::Luding(Luding::REFERENCE)),
    ];
}

impl AnyUnloading {
    /// The law with the passivity guard; none for a law that has no guarded form.
    pub fn guarded(self) -> Option<AnyUnloading> {
        match self {
            AnyUnloading::ContactRadius(law) => Some(AnyUnloading::GuardedContactRadius(Guarded(law))),
            AnyUnloading::Thornton(law) => Some(AnyUnloading::GuardedThornton(Guarded(law))),
            AnyUnloading::OriginalRadius(law) => Some(AnyUnloading::GuardedOriginalRadius(Guarded(law))),
            AnyUnloading::DeformedRadius(law) => Some(AnyUnloading::GuardedDeformedRadius(Guarded(law))),
            _ => None,
        }
    }
}

impl Unloading for AnyUnloading {
    // some are, some aren't; of those that are, the tangent and the work are the path's own
    const SEGMENTED: bool = false;
    const SQUARES: bool = true;

    fn needs_work(&self) -> bool {
        match self {
            AnyUnloading::GuardedContactRadius(law) => law.needs_work(),
            AnyUnloading::GuardedThornton(law) => law.needs_work(),
            AnyUnloading::GuardedOriginalRadius(law) => law.needs_work(),
            AnyUnloading::GuardedDeformedRadius(law) => law.needs_work(),
            _ => false,
        }
    }

    fn holds_back(&self, pair: &Pair, peak: &Peak) -> bool {
        match self {
            AnyUnloading::GuardedContactRadius(law) => law.holds_back(pair, peak),
            AnyUnloading::GuardedThornton(law) => law.holds_back(pair, peak),
            AnyUnloading::GuardedOriginalRadius(law) => law.holds_back(pair, peak),
            AnyUnloading::GuardedDeformedRadius(law) => law.holds_back(pair, peak),
            _ => false,
        }
    }

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        match self {
            AnyUnloading::ContactRadius(law) => law.path(pair, peak),
            AnyUnloading::Thornton(law) => law.path(pair, peak),
            AnyUnloading::OriginalRadius(law) => law.path(pair, peak),
            AnyUnloading::DeformedRadius(law) => law.path(pair, peak),
            AnyUnloading::HertzShift(law) => law.path(pair, peak),
            AnyUnloading::Brinell(law) => law.path(pair, peak),
            AnyUnloading::WaltonBraun(law) => law.path(pair, peak),
            AnyUnloading::Etsion(law) => law.path(pair, peak),
            AnyUnloading::Jackson(law) => law.path(pair, peak),
            AnyUnloading::VuQuocZhang(law) => law.path(pair, peak),
            AnyUnloading::Luding(law) => law.path(pair, peak),
            AnyUnloading::GuardedContactRadius(law) => law.path(pair, peak),
            AnyUnloading::GuardedThornton(law) => law.path(pair, peak),
            AnyUnloading::GuardedOriginalRadius(law) => law.path(pair, peak),
            AnyUnloading::GuardedDeformedRadius(law) => law.path(pair, peak),
        }
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        match self {
            AnyUnloading::Brinell(law) => law.contact_radius(pair, peak, path, indentation),
            AnyUnloading::Etsion(law) => law.contact_radius(pair, peak, path, indentation),
            AnyUnloading::VuQuocZhang(law) => law.contact_radius(pair, peak, path, indentation),
            // the others have the radius of a Hertzian recovery
            _ => ContactRadius.contact_radius(pair, peak, path, indentation),
        }
    }

    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment {
        match self {
            AnyUnloading::Etsion(law) => law.tangent(pair, peak, path, indentation),
            AnyUnloading::VuQuocZhang(law) => law.tangent(pair, peak, path, indentation),
            _ => *path,
        }
    }

    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        match self {
            AnyUnloading::Etsion(law) => law.work(pair, peak, path, indentation),
            AnyUnloading::VuQuocZhang(law) => law.work(pair, peak, path, indentation),
            _ => path.work(indentation),
        }
    }
}
