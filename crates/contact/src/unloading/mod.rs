//! Unloading laws, one file each: the path from the largest indentation down to the dent that remains.
//!
//! All laws determine the elastic recovery `d_e = d_m - d_f`, and with it the whole path, from the point of the loading curve
//! where unloading begins. Reloading follows the same path.

mod any;
pub mod brinell;
pub mod contact_radius;
pub mod deformed_radius;
pub mod etsion;
pub mod guarded;
pub mod hertz_shift;
pub mod jackson;
pub mod line;
pub mod luding;
pub mod original_radius;
pub mod tabulated;
pub mod thornton;
pub mod vu_quoc_zhang;
pub mod walton_braun;

pub use guarded::Guarded;

use super::laws::{Constant, LawNumbers, Numbered, laws};
use super::material::Pair;
use super::segment::Segment;
use crate::loading::two_bodies::{Construction, Together};
use libm::sqrt;

laws! {
    /// An unloading law chosen while a program runs. In an FMU the scene names the law.
    pub enum AnyUnloading: dyn any::DynUnloading {
        contact_radius::ContactRadius [] { "contact-radius" = ContactRadius }
        thornton::Thornton [] { "thornton" = Thornton }
        original_radius::OriginalRadius [] { "original-radius" = OriginalRadius }
        deformed_radius::DeformedRadius [pressure_factor] { "deformed-radius" = DeformedRadius::REFERENCE }
        hertz_shift::HertzShift [] { "hertz-shift" = HertzShift }
        brinell::Brinell [height, onset, decline] { "brinell" = Brinell::REFERENCE }
        walton_braun::WaltonBraun [stiffness_ratio] { "walton-braun" = WaltonBraun::REFERENCE }
        etsion::Etsion [first_residual_exponent, second_residual_exponent, force_exponent, area_exponent] { "etsion" = Etsion::REFERENCE }
        jackson::Jackson [factor, offset, exponent] { "jackson" = Jackson::REFERENCE }
        vu_quoc_zhang::VuQuocZhang [curvature] { "vu-quoc-zhang" = VuQuocZhang::REFERENCE }
        luding::Luding [stiffness_ratio, limit_depth] { "luding" = Luding::REFERENCE }
        tabulated::Tabulated [] { "table" = Tabulated }
        line::Line [length] { "line" = Line::REFERENCE }
    }
    guarded {
        ContactRadius as GuardedContactRadius,
        Thornton as GuardedThornton,
        OriginalRadius as GuardedOriginalRadius,
        DeformedRadius as GuardedDeformedRadius,
    }
}

/// The point of the loading curve where unloading begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Largest indentation `d_m` \[m\].
    pub indentation: f64,
    /// Force `F_m` \[N\] at the largest indentation.
    pub force: f64,
    /// Contact radius `a_m` \[m\] at the largest indentation.
    pub contact_radius: f64,
    /// Force `F_y` at which the loading law begins to yield \[N\].
    pub yield_force: f64,
    /// Work of loading up to the largest indentation \[J\]; NaN for a law that does not [need](Unloading::needs_work) it.
    pub work: f64,
    /// How the bodies differ from the law.
    pub recovery: Recovery,
}

/// How the recovery of two bodies differs from that of an unloading law itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recovery {
    /// Factor of the recovery.
    pub factor: f64,
    /// Difference of the shapes of the path.
    pub difference: f64,
}

impl Recovery {
    /// No difference.
    pub const NONE: Recovery = Recovery { factor: 1.0, difference: 0.0 };
}

/// An unloading law.
pub trait Unloading {
    /// Whether the whole path is one segment. If not, only its ends are used, and [`Unloading::tangent`] and
    /// [`Unloading::work`] give the rest.
    const SEGMENTED: bool = true;

    /// Whether that depends on the law, so that [`Unloading::is_segmented`] tells: for a type of several laws.
    const MIXED: bool = false;

    /// Whether a segment can have a quadratic term.
    const SQUARES: bool = false;

    /// Whether the whole path of this law is one segment.
    #[inline(always)]
    fn is_segmented(&self) -> bool {
        Self::SEGMENTED
    }

    /// Whether the law needs the work of loading, which may be an integral.
    fn needs_work(&self) -> bool {
        false
    }

    /// Whether the passivity guard shortens the path from `peak`; always false without guard.
    fn holds_back(&self, _pair: &Pair, _peak: &Peak) -> bool {
        false
    }

    /// The path from the residual indentation `d_f` (`lower`) to `peak` (`upper`), for a peak beyond the yield point.
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment;

    /// The [tangent](Segment::tangent) of a `path` that is not a segment, or its segment at and just above `indentation` \[m\] if it is a
    /// chain.
    fn tangent(&self, _pair: &Pair, _peak: &Peak, path: &Segment, _indentation: f64) -> Segment {
        *path
    }

    /// Contact radius on the `path` \[m\]. The default is a Hertzian recovery, `a = a_m sqrt((d - d_f)/d_e)`.
    fn contact_radius(&self, _pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        peak.contact_radius * sqrt((indentation - path.lower) / (path.upper - path.lower))
    }

    /// Work returned on a `path` that is not a segment, from `indentation` down to its lower end \[J\].
    fn work(&self, _pair: &Pair, _peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        path.work(indentation)
    }

    /// How the recovery `from` a point of two bodies differs from that of the law itself.
    fn recovery(&self, _bodies: &Construction<'_>, _from: &Together) -> Recovery {
        Recovery::NONE
    }
}

/// The residual indentation \[m\] after an elastic `recovery` \[m\] from `peak`.
///
/// A residual of a few units in the last place of the peak counts as zero: just beyond yield, the recovery is the whole
/// indentation except for rounding. Far beyond anything physical, the recovery is less than the last digit of the indentation;
/// it is then rounded up and not to zero.
#[inline(always)]
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

/// `F = F_m ((1 + g) s^1.5 - g s^2)` with `s = (d - d_f)/d_e`, the shape `g` \[-\] and the dent `d_f` \[m\].
#[inline]
fn path_of_shape(peak: &Peak, residual: f64, shape: f64) -> Segment {
    let recovery = peak.indentation - residual;
    Segment {
        lower: residual,
        upper: peak.indentation,
        origin: residual,
        power: (1.0 + shape) * peak.force / (recovery * sqrt(recovery)),
        square: -shape * peak.force / (recovery * recovery),
        ..Segment::NOTHING
    }
}

/// `F = F_m ((d - d_f)/d_e)^1.5`: Hertzian unloading with the elastic recovery `d_e` \[m\].
///
/// `d_e` is computed again from the rounded `d_f`, so that the path ends at the peak to the last bits.
#[inline(always)]
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

/// A straight line from the `residual` indentation \[m\] to the peak.
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
