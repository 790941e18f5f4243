//! The passivity guard: unloading never returns more energy than the loading took.

use super::{Peak, Unloading, hertzian};
use crate::laws::{LawNumbers, Numbered};
use crate::material::Pair;
use crate::segment::Segment;

/// An unloading law whose whole path is `F = F_m ((d - d_f)/d_e)^1.5`. It returns the work `W_r = 0.4 F_m d_e`.
pub trait Hertzian: Unloading {}

/// Limits the recovery of another law to `d_e <= 2.5 W/F_m`, so that `W_r <= W`. Where the law would return more than the work
/// `W` of the loading, the shorter path returns exactly `W`. Elsewhere nothing changes.
///
/// The force at the peak does not change; the dent is deeper, and as continuous as without the guard. A single impact then
/// never ends faster than it began. The dissipated energy need not grow with the largest indentation: a law may dissipate less
/// when it is indented deeper.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Guarded<U>(pub U);

/// Tolerance for the rounding of a recovery that returns exactly the work of the loading, relative to the largest indentation.
/// Without it, the guard would act on the last bits of contacts that just yield.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The longest recovery \[m\] that returns no more than the work of the loading.
fn longest(peak: &Peak) -> f64 {
    2.5 * peak.work / peak.force
}

/// Whether the recovery of `path` exceeds that length.
fn exceeds(path: &Segment, peak: &Peak) -> bool {
    path.upper - path.lower > longest(peak) + ROUNDING * peak.indentation
}

impl<U: Numbered> Numbered for Guarded<U> {
    const FIRST: Guarded<U> = Guarded(U::FIRST);

    #[inline(always)]
    fn from_numbers(numbers: &LawNumbers) -> Option<Guarded<U>> {
        U::from_numbers(numbers).map(Guarded)
    }
}

impl<U: Hertzian> Unloading for Guarded<U> {
    fn needs_work(&self) -> bool {
        true
    }

    fn holds_back(&self, pair: &Pair, peak: &Peak) -> bool {
        exceeds(&self.0.path(pair, peak), peak)
    }

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let path = self.0.path(pair, peak);
        if exceeds(&path, peak) { hertzian(peak, longest(peak)) } else { path }
    }
}
