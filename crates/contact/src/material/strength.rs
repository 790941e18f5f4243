//! One effective strength: how hardening and Poisson's ratio change the law `brinell`.
//!
//! Lengths are in units of the yield indentation `d_Y` of the material, forces in units of its yield force `F_Y`:
//! `k = d/d_Y`, `phi = F/F_Y`. `Phi` and `A` are the force and the area of the law `brinell` itself.

use crate::numerics::largest;
use libm::{exp, log, pow, sqrt};

/// Poisson's ratio of the fit of the law `brinell`.
pub const POISSONS_RATIO: f64 = 0.3;

// The constants from `data/fit/fit_materials.py`. A test compares them with the file that it writes.
const GROWTH: [f64; 2] = [0.741, 0.097];
const DECAY_SCALE: f64 = 20.36;
const DECAY_POWER: f64 = 0.5777;
const DECAY_SHIFT: f64 = 2.931;
const RISE: f64 = 0.9452;
const RISE_POWER: f64 = 0.3895;
const SATURATION: f64 = 1.318;
/// Power by which a contact area falls with the force.
pub(crate) const RADIUS_POWER: f64 = 0.8509;
const DENT_FALL: f64 = 1.584;
const DENT_DECAY_SCALE: f64 = 7.405;
const DENT_DECAY_POWER: f64 = 0.5019;
const SLOPE_POWER: f64 = 1.111;
const LARGEST_SHAPE: f64 = 0.75;

/// The effective strength of a material, relative to its strength at first yield.
///
/// A hardening material behaves like one of a higher strength. This strength grows with the indentation. Poisson's
/// ratio has the same effect, but it decays with the indentation. The combined effect is the product `t = t_nu t_H`,
/// with `phi = t^3 Phi(k/t^2)`:
///
/// - at first yield, relative to `nu = 0.3`: `s0 = exp(0.741 (nu - 0.3) + 0.097 (nu - 0.3)^2)`. The contact yields at
///   `s0^2 d_y` (theory: 0.825, 0.955, 1.110, 1.198 for `nu = 0.2, 0.3, 0.4, 0.45`; K. L. Johnson, *Contact
///   Mechanics*, Cambridge 1985, section 6.2);
/// - `t_nu = 1 + (1/s0 - 1) w/(1 + w)` with `w = s0^2.931 (k^0.5777 - 1)/20.36`;
/// - `t_H = 1 + 0.9452 h s0^0.779 (k^0.3895 - 1)` with `h = eta/(1 + 1.318 eta)` and
///   `eta = (1 - nu^2) H/E`.
///
/// `eta` belongs to the body that yields, whatever the other one is. Of two equal bodies each is pressed by the flat plane
/// between them, and doesn't know what is behind it. The depth in yield depths, `k`, is the same for one body and for both,
/// and so is the curve. Under an elastic body the `k` of the yielding body alone is larger than that of the pair, with
/// hardening as without it.
///
/// The two effects are taken as independent, which is right within 0.8 % of the force (`data/truth/both`). Fitted for `nu` from 0.2
/// to 0.45 and `H/E` up to 0.1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// `s0`.
    at_yield: f64,
    /// `1/s0 - 1`.
    ease: f64,
    /// `s0^2.931`.
    shift: f64,
    /// `h`.
    hardening: f64,
    /// Factor of `k^0.3895 - 1`.
    rise: f64,
}

impl Strength {
    /// The strength of a body with this plane-strain `modulus` \[Pa\], Poisson's ratio and `hardening_modulus` \[Pa\]; `None` if the
    /// law `brinell` describes it by itself.
    pub fn of(modulus: f64, poissons_ratio: f64, hardening_modulus: f64) -> Option<Strength> {
        let differs = poissons_ratio != POISSONS_RATIO || hardening_modulus != 0.0;
        differs.then(|| Strength::new(modulus, poissons_ratio, hardening_modulus))
    }

    #[inline(never)]
    fn new(modulus: f64, poissons_ratio: f64, hardening_modulus: f64) -> Strength {
        let [first, second] = GROWTH;
        let more = poissons_ratio - POISSONS_RATIO;
        let logarithm = more * (first + second * more);
        // this quotient does not overflow; one with a soft body in the denominator may
        let hardening = hardening_modulus / (modulus + SATURATION * hardening_modulus);
        Strength {
            at_yield: exp(logarithm),
            ease: exp(-logarithm) - 1.0,
            shift: exp(DECAY_SHIFT * logarithm),
            hardening,
            rise: RISE * hardening * exp(2.0 * RISE_POWER * logarithm),
        }
    }

    /// Mean pressure at first yield relative to that for `nu = 0.3`: `s0`.
    pub fn at_yield(&self) -> f64 {
        self.at_yield
    }

    /// `1 + (1/s0 - 1) w/(1 + w)`, and its derivative with respect to `k`.
    fn fading(&self, k: f64, scale: f64, power: f64) -> (f64, f64) {
        if self.ease == 0.0 {
            return (1.0, 0.0);
        }
        let (raised, unit) = (pow(k, power), self.shift / scale);
        let w = unit * (raised - 1.0);
        let slope = unit * power * raised / k;
        (1.0 + self.ease * w / (1.0 + w), self.ease * slope / ((1.0 + w) * (1.0 + w)))
    }

    /// The part of `t` that the Poisson's ratio has, at `k >= 1`, and its slope.
    pub fn of_poissons_ratio(&self, k: f64) -> (f64, f64) {
        self.fading(k, DECAY_SCALE, DECAY_POWER)
    }

    /// `t` at `k >= 1`, and its slope.
    pub fn at(&self, k: f64) -> (f64, f64) {
        let (one, one_slope) = self.of_poissons_ratio(k);
        let raised = pow(k, RISE_POWER);
        let (other, other_slope) = (1.0 + self.rise * (raised - 1.0), self.rise * RISE_POWER * raised / k);
        (one * other, one_slope * other + one * other_slope)
    }

    /// The strength that determines the dent, for `k >= 1`. The effect of Poisson's ratio decays faster.
    pub fn of_dent(&self, k: f64) -> f64 {
        self.fading(k, DENT_DECAY_SCALE, DENT_DECAY_POWER).0
    }

    /// Factor by which hardening reduces the depth of a dent.
    pub fn dent_divisor(&self) -> f64 {
        1.0 + DENT_FALL * self.hardening
    }
}

/// The Poisson's ratio at which a contact yields at `harder` times the pressure that it has at this `ratio`.
pub(crate) fn poissons_ratio_for(ratio: f64, harder: f64) -> f64 {
    let [first, second] = GROWTH;
    let more = ratio - POISSONS_RATIO;
    let wanted = log(harder) + more * (first + second * more);
    // the root near zero, without cancellation
    let root = sqrt(largest(first * first + 4.0 * second * wanted, 0.0));
    if harder == 1.0 { ratio } else { POISSONS_RATIO + 2.0 * wanted / (first + root) }
}

/// Factor of the contact area relative to `A(k)`, for a force of `ratio` times `Phi(k)`. It is below 1 for a harder
/// material.
pub fn area_factor(ratio: f64) -> f64 {
    pow(ratio, -RADIUS_POWER)
}

/// Factor of the squared contact radius that corresponds to the initial unloading slope, for a force of `ratio` times
/// that of the law itself.
pub fn slope_factor(ratio: f64) -> f64 {
    pow(ratio, -SLOPE_POWER)
}

/// The shape `g` of an unloading path, limited to 0 and a number above all fitted curves. Without the limits,
/// materials far from the fit would return more energy than they received.
pub fn held(shape: f64) -> f64 {
    shape.clamp(0.0, LARGEST_SHAPE)
}
