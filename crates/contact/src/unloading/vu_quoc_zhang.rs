//! Vu-Quoc and Zhang: the plastic part of the contact radius remains.

use super::{Peak, Unloading, hertzian};
use crate::loading::{Loading, VuQuocZhang as LoadingLaw};
use crate::material::{Pair, YieldPoint};
use crate::segment::Segment;
use libm::{cbrt, sqrt};

/// The plastic radius `p` \[a_y\] and the curvature `c` of the peak stay constant during unloading; the elastic radius is
/// Hertz's:
///
/// `x = (f^(1/3) + p)^2 / c`, so `f = (sqrt(c x) - p)^3` and `x_f = p^2/c`, with `c = 1 + B (f_m - 1)` and `p = sqrt(c x_m) - f_m^(1/3)`.
///
/// With [the loading law of the same authors](LoadingLaw), whose `B`, `d_y` and `F_y` are used here, `p = A (f_m - 1)`. With
/// any other law, the path still ends at the peak. Where a loading law lies so far above Hertz's curve that `p` is negative, no
/// dent remains: `F = F_m (d/d_m)^1.5`. The paper gives the force-driven form; this is its inverse. The work `W` from `x_f` on,
/// with `g = f^(1/3)`, is `(2/c) (g^5/5 + p g^4/4)` in units of `F_y d_y`. The contact radius is `a_m (g + p)/(g_m + p)`. It
/// does not vanish where the force does: the dent still fits the sphere there.
///
/// Reference: L. Vu-Quoc, X. Zhang, *Proc. R. Soc. A* 455 (1999) 4013-4044.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct VuQuocZhang {
    /// `B`: relative growth of the radius of curvature for each `F_y` beyond yield \[-\].
    pub curvature: f64,
}

/// The quantities that stay constant during unloading, in the units of the law.
struct Frozen {
    unit: YieldPoint,
    plastic_radius: f64,
    growth: f64,
    /// Indentation \[m\] at which unloading began, and `f_m^(1/3)` there.
    peak: (f64, f64),
}

impl Frozen {
    /// `f^(1/3)` at `indentation` \[m\]. It is computed from the peak down, so that the path ends at the peak to the last bits.
    fn root_of_force(&self, indentation: f64) -> f64 {
        let (largest, largest_root) = self.peak;
        let scale = sqrt(self.growth / self.unit.indentation);
        let root = largest_root - scale * ((largest - indentation) / (sqrt(largest) + sqrt(indentation)));
        if root > 0.0 { root } else { 0.0 }
    }
}

impl VuQuocZhang {
    /// The constant of the published fit.
    pub const REFERENCE: VuQuocZhang = VuQuocZhang { curvature: LoadingLaw::REFERENCE.curvature };

    /// `None` if the plastic radius would be negative.
    fn frozen(&self, pair: &Pair, peak: &Peak) -> Option<Frozen> {
        let unit = LoadingLaw::REFERENCE.yield_point(pair);
        let force = peak.force / unit.force;
        let growth = 1.0 + self.curvature * if force > 1.0 { force - 1.0 } else { 0.0 };
        let root = cbrt(force);
        let plastic_radius = sqrt(growth * (peak.indentation / unit.indentation)) - root;
        (plastic_radius > 0.0).then_some(Frozen { unit, plastic_radius, growth, peak: (peak.indentation, root) })
    }
}

impl Unloading for VuQuocZhang {
    const SEGMENTED: bool = false;

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let residual = match self.frozen(pair, peak) {
            Some(Frozen { unit, plastic_radius, growth, .. }) => {
                plastic_radius / growth * plastic_radius * unit.indentation
            }
            None => 0.0,
        };
        hertzian(peak, peak.indentation - residual)
    }

    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment {
        let Some(frozen) = self.frozen(pair, peak) else {
            return *path;
        };
        let root = frozen.root_of_force(indentation);
        let unit = frozen.unit;
        // x = (g + p)^2/c: dx/dg = 2 (g + p)/c
        let slope = 1.5 * root * root * frozen.growth / (root + frozen.plastic_radius);
        Segment::tangent(indentation, unit.force * (root * root * root), slope * (unit.force / unit.indentation))
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        match self.frozen(pair, peak) {
            // a is proportional to g + p = sqrt(c x)
            Some(_) => peak.contact_radius * sqrt(indentation / peak.indentation),
            None => peak.contact_radius * sqrt((indentation - path.lower) / (path.upper - path.lower)),
        }
    }

    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        let Some(frozen) = self.frozen(pair, peak) else {
            return path.work(indentation);
        };
        let g = frozen.root_of_force(indentation);
        let fourth = (g * g) * (g * g);
        let unit = frozen.unit;
        2.0 / frozen.growth * fourth * (g / 5.0 + frozen.plastic_radius / 4.0) * (unit.force * unit.indentation)
    }
}
