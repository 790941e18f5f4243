//! The unloading of a curve of one's own.

use super::{Peak, Unloading, path_of_shape, residual_after};
use crate::material::Pair;
use crate::segment::Segment;

/// `F = F_m ((1 + g) s^1.5 - g s^2)` with `s = (d - d_f)/d_e`. The loading law [`Tabulated`](crate::loading::Tabulated) gives `d_e` and `g`
/// at the peak. Without an unloading in the file the path is Hertz's, `g = 0`, with `d_e = 3 F_m/(4 E* a_m)`.
///
/// Reference: K. L. Johnson, *Contact Mechanics*, 1985, section 6.4(b); J. S. Field, M. V. Swain, *J. Mater. Res.* 8 (1993) 297-306.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Tabulated;

impl Unloading for Tabulated {
    const SQUARES: bool = true;

    fn path(&self, _pair: &Pair, peak: &Peak) -> Segment {
        let shape = peak.recovery.difference;
        let residual = residual_after(peak, peak.recovery.factor);
        path_of_shape(peak, residual, shape)
    }
}
