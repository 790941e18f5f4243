//! Jackson, Chusoipin and Green: residual indentation fitted to finite elements.

use super::{Peak, Unloading, hertzian};
use crate::loading::JacksonGreen;
use crate::material::Pair;
use crate::segment::Segment;
use libm::pow;

/// `d_f/d_m = 1.02 (1 - ((y_m + 5.9)/6.9)^-0.54)` with `y_m = d_m/d_c` and `d_c` of [`JacksonGreen`].
///
/// Up to `y_m = 1`, no dent remains. [`JacksonGreen`] counts as elastic up to 1.9, so its dent starts there at 0.0349 of the
/// indentation. The fit exceeds 1 from `y_m = 10017` on, where there is no recovery: the dent is then the whole indentation,
/// the path is as steep as the numbers allow, and the restitution is practically zero. Such a depth is far outside the fit.
///
/// Reference: R. L. Jackson, I. Chusoipin, I. Green, *J. Tribol.* 127 (2005) 484-493.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Jackson {
    /// Residual ratio of an infinitely deep dent \[-\].
    pub factor: f64,
    /// Offset added to `y_m` \[-\].
    pub offset: f64,
    /// Exponent \[-\].
    pub exponent: f64,
}

impl Jackson {
    /// The constants as published.
    pub const REFERENCE: Jackson = Jackson { factor: 1.02, offset: 5.9, exponent: -0.54 };
}

impl Unloading for Jackson {
    fn path(&self, pair: &Pair, peak: &Peak) -> Segment {
        let depth = peak.indentation / JacksonGreen::REFERENCE.unit(pair).indentation;
        let depth = if depth > 1.0 { depth } else { 1.0 };
        let residual = self.factor * (1.0 - pow((depth + self.offset) / (1.0 + self.offset), self.exponent));
        hertzian(peak, peak.indentation * (1.0 - residual))
    }
}
