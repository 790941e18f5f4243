//! Etsion, Kligerman and Kadin: residual indentation and exponent fitted to finite elements.

use super::{Peak, Unloading, hertzian};
use crate::loading::KogutEtsion;
use crate::material::Pair;
use crate::numerics::quotient;
use crate::segment::Segment;
use libm::{pow, sqrt};

/// With `y_m = d_m/d_c` and `d_c` of [`KogutEtsion`]:
///
/// `d_f/d_m = (1 - y_m^-0.28) (1 - y_m^-0.69)`, `F = F_m ((d - d_f)/d_e)^n` with `n = 1.5 y_m^-0.0331`,
/// `a^2 = a_m^2 ((d - d_f)/d_e)^(y_m^-0.12)`, `W = F_m d_e ((d - d_f)/d_e)^(n + 1) / (n + 1)`.
///
/// Up to `y_m = 1`, no dent remains and `n = 1.5`; other loading laws may yield earlier. The fit ends at about `y_m = 170`.
/// Beyond `y_m = 2.1e5`, `n` is below 1 and the stiffness at the lower end of the path is infinite; the law returns zero at
/// that point.
///
/// Reference: I. Etsion, Y. Kligerman, Y. Kadin, *Int. J. Solids Struct.* 42 (2005) 3716-3729.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Etsion {
    /// Exponent of `y_m` in the first factor of the residual indentation.
    pub first_residual_exponent: f64,
    /// Exponent of `y_m` in the second factor.
    pub second_residual_exponent: f64,
    /// Exponent of `y_m` in `n`.
    pub force_exponent: f64,
    /// Exponent of `y_m` in the exponent of the area.
    pub area_exponent: f64,
}

impl Etsion {
    /// The constants as published.
    pub const REFERENCE: Etsion = Etsion {
        first_residual_exponent: -0.28,
        second_residual_exponent: -0.69,
        force_exponent: -0.0331,
        area_exponent: -0.12,
    };

    /// `y_m`, but at least 1.
    fn depth(pair: &Pair, peak: &Peak) -> f64 {
        let depth = peak.indentation / KogutEtsion::REFERENCE.unit(pair).indentation;
        if depth > 1.0 { depth } else { 1.0 }
    }

    /// `n`.
    fn exponent(&self, pair: &Pair, peak: &Peak) -> f64 {
        1.5 * pow(Etsion::depth(pair, peak), self.force_exponent)
    }
}

/// `(d - d_f)/d_e`, between 0 and 1.
fn part(path: &Segment, indentation: f64) -> f64 {
    let part = (indentation - path.lower) / (path.upper - path.lower);
    if part > 0.0 { part } else { 0.0 }
}

impl Unloading for Etsion {
    const SEGMENTED: bool = false;

    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let depth = Etsion::depth(pair, peak);
        let one = 1.0 - pow(depth, self.first_residual_exponent);
        let two = 1.0 - pow(depth, self.second_residual_exponent);
        hertzian(peak, peak.indentation * (1.0 - one * two))
    }

    fn tangent(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> Segment {
        let (n, part) = (self.exponent(pair, peak), part(path, indentation));
        let force = peak.force * pow(part, n);
        let stiffness = n * quotient(force, part, part > 0.0, 0.0) / (path.upper - path.lower);
        Segment::tangent(indentation, force, stiffness)
    }

    fn contact_radius(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        let exponent = pow(Etsion::depth(pair, peak), self.area_exponent);
        peak.contact_radius * sqrt(pow(part(path, indentation), exponent))
    }

    fn work(&self, pair: &Pair, peak: &Peak, path: &Segment, indentation: f64) -> f64 {
        let n = self.exponent(pair, peak);
        peak.force * (path.upper - path.lower) * pow(part(path, indentation), n + 1.0) / (n + 1.0)
    }
}
