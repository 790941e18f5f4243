//! Kogut and Etsion: powers of the indentation fitted to finite elements.

use super::{Loading, first_above, hertz};
use crate::material::{Pair, YieldPoint};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use libm::{pow, sqrt};

/// The loading curve of Kogut and Etsion, with `H = 2.8 S`, `K = 0.454 + 0.41 nu`, `d_c = (pi K H/(2 E*))^2 R`,
/// `F_c = K_h d_c^1.5`, `y = d/d_c` and the area `A` over that at yield, `A_c = pi R d_c`:
///
/// | regime | where | `F/F_c` | `A/A_c` |
/// |---|---|---|---|
/// | elastic (Hertz) | `y < 1` | `y^1.5` | `y` |
/// | elastoplastic, first region | `1 <= y < 6` | `1.03 y^1.425` | `0.93 y^1.136` |
/// | elastoplastic, second region | `6 <= y < 110` | `1.40 y^1.263` | `0.94 y^1.146` |
/// | fully plastic | `110 <= y` | `3 y/K` (`F = 2 pi R d H`) | `2 y` |
///
/// As published: the fits do not meet. The force jumps up by 3.0 % at `y = 1`, 1.7 % at 6 and 7.9 % at 110 (nu = 0.3); the area
/// jumps by -7.0 %, +2.9 % and +7.1 %. A jump takes no work, so a contact that yields a little can return more energy than was
/// put in: the restitution is 1.015 just beyond yield. The fits are for a deformable sphere under a rigid flat.
///
/// Reference: L. Kogut, I. Etsion, *J. Appl. Mech.* 69 (2002) 657-662.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct KogutEtsion {
    /// Hardness `H` over the yield strength.
    pub hardness_factor: f64,
    /// `K` at `nu = 0`: the largest pressure at yield over `H` \[-\].
    pub yield_constant: f64,
    /// Increase of `K` per unit of Poisson's ratio.
    pub yield_slope: f64,
    /// Start of the second region \[d_c\].
    pub second_region: f64,
    /// Start of the fully plastic regime \[d_c\].
    pub fully_plastic: f64,
    /// Factor of the force in the first region.
    pub first_factor: f64,
    /// Exponent of the force in the first region.
    pub first_exponent: f64,
    /// Factor of the force in the second region.
    pub second_factor: f64,
    /// Exponent of the force in the second region.
    pub second_exponent: f64,
    /// Factor of the area in the first region.
    pub first_area_factor: f64,
    /// Exponent of the area in the first region.
    pub first_area_exponent: f64,
    /// Factor of the area in the second region.
    pub second_area_factor: f64,
    /// Exponent of the area in the second region.
    pub second_area_exponent: f64,
}

impl KogutEtsion {
    /// The constants as published.
    pub const REFERENCE: KogutEtsion = KogutEtsion {
        hardness_factor: 2.8,
        yield_constant: 0.454,
        yield_slope: 0.41,
        second_region: 6.0,
        fully_plastic: 110.0,
        first_factor: 1.03,
        first_exponent: 1.425,
        second_factor: 1.40,
        second_exponent: 1.263,
        first_area_factor: 0.93,
        first_area_exponent: 1.136,
        second_area_factor: 0.94,
        second_area_exponent: 1.146,
    };

    /// `d_c` and `F_c`, the scales of the law. The largest pressure is 1.5 times the mean pressure.
    pub fn unit(&self, pair: &Pair) -> YieldPoint {
        let peak = (self.yield_constant + self.yield_slope * pair.poissons_ratio) * self.hardness_factor;
        pair.yield_point(peak / 1.5)
    }

    /// `2 pi R H`: slope of the fully plastic line \[N/m\].
    fn plastic_slope(&self, pair: &Pair) -> f64 {
        2.0 * core::f64::consts::PI * pair.radius * self.hardness_factor * pair.yield_strength
    }

    /// Factor and exponent of the force in the first or the `second` elastoplastic region.
    fn fit(&self, second: bool) -> (f64, f64) {
        if second { (self.second_factor, self.second_exponent) } else { (self.first_factor, self.first_exponent) }
    }
}

impl Loading for KogutEtsion {
    fn is_segmented(&self) -> bool {
        false
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        self.unit(pair)
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        let YieldPoint { indentation: d_c, force: f_c } = self.unit(pair);
        if indentation < d_c {
            return hertz::segment(pair, d_c);
        }
        let plastic = self.fully_plastic * d_c;
        if indentation < plastic {
            let (factor, exponent) = self.fit(indentation >= self.second_region * d_c);
            let force = factor * f_c * pow(indentation / d_c, exponent);
            return Segment::tangent(indentation, force, exponent * force / indentation);
        }
        let linear = self.plastic_slope(pair);
        Segment {
            lower: plastic,
            upper: LARGEST_INDENTATION,
            origin: plastic,
            constant: linear * plastic,
            linear,
            ..Segment::NOTHING
        }
    }

    fn next_corner(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_c = self.unit(pair).indentation;
        first_above(indentation, [d_c, self.second_region * d_c, self.fully_plastic * d_c])
    }

    /// In `F_c d_c`: `0.4 y^2.5`, then `c y^(1+p)/(1+p)` between the boundaries of each fit, then `3 y^2/(2 K)`.
    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let YieldPoint { indentation: d_c, force: f_c } = self.unit(pair);
        if indentation <= d_c {
            return hertz::segment(pair, d_c).work(indentation);
        }
        let mut work = hertz::segment(pair, d_c).work(d_c);
        let y = indentation / d_c;
        let regions = [(false, 1.0, self.second_region), (true, self.second_region, self.fully_plastic)];
        for (second, from, to) in regions {
            if y > from {
                let (factor, exponent) = self.fit(second);
                let end = if y < to { y } else { to };
                let area = (pow(end, 1.0 + exponent) - pow(from, 1.0 + exponent)) / (1.0 + exponent);
                work += factor * area * f_c * d_c;
            }
        }
        let plastic = self.fully_plastic * d_c;
        if indentation > plastic { work + self.segment(pair, plastic).work(indentation) } else { work }
    }

    /// From the contact area of the paper, `a^2 = A/pi`, including its jumps.
    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        let d_c = self.unit(pair).indentation;
        let y = indentation / d_c;
        let area = if indentation < d_c {
            y
        } else if indentation < self.second_region * d_c {
            self.first_area_factor * pow(y, self.first_area_exponent)
        } else if indentation < self.fully_plastic * d_c {
            self.second_area_factor * pow(y, self.second_area_exponent)
        } else {
            2.0 * y
        };
        sqrt(pair.radius * d_c * area)
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        let d_c = self.unit(pair).indentation;
        if indentation < d_c {
            Regime::Elastic
        } else if indentation < self.second_region * d_c {
            Regime::ElastoplasticFirst
        } else if indentation < self.fully_plastic * d_c {
            Regime::ElastoplasticSecond
        } else {
            Regime::FullyPlastic
        }
    }
}
