//! The passivity guard: no unloading returns more energy than the loading took.

use super::{ContactRadius, DeformedRadius, OriginalRadius, Peak, Thornton, Unloading, hertzian};
use crate::contact::material::Pair;
use crate::contact::segment::Segment;

/// An unloading law whose whole path is `F = F_m ((d - d_f)/d_e)^1.5`, so that it gives back `W_r = 0.4 F_m d_e`.
pub trait Hertzian: Unloading {}

impl Hertzian for ContactRadius {}
impl Hertzian for Thornton {}
impl Hertzian for OriginalRadius {}
impl Hertzian for DeformedRadius {}

/// `d_e <= 2.5 W/F_m`, so that `W_r <= W`: another law's path, and where that would give back more than the work `W` of the
/// loading, the shorter one that gives back just that. Elsewhere nothing is changed.
///
/// The force is that of the law at the peak; the dent is deeper, and as continuous as without. One impact then never ends faster than it
/// began. That the dissipated energy grows with the largest indentation is not promised: a law may still lose much, and
/// less when it is pressed in deeper.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "exporter", derive(serde::Serialize, serde::Deserialize))]
pub struct Guarded<U>(pub U);

/// Room for the rounding of a recovery that gives back exactly what was put in, in largest indentations: without it the
/// guard would act on the last bits of contacts that just yield.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The longest recovery \[m\] that gives back no more than the work of the loading.
fn longest(peak: &Peak) -> f64 {
    2.5 * peak.work / peak.force
}

/// Whether the recovery of `path` is longer than that.
fn exceeds(path: &Segment, peak: &Peak) -> bool {
    path.upper - path.lower > longest(peak) + ROUNDING * peak.indentation
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
