//! Large strain: how the law `brinell` of one body changes when the contact radius `a` is no longer small beside the radius `R` of the
//! sphere that presses it.
//!
//! With the depth `k` in yield depths, `Phi = F/F_Y` and `u = a/R` of small strain:
//!
//! - the lag `psi = 1 - Phi/k^1.5` behind Hertz's law says how plastic the contact is, and `z = psi u` measures the plastic strain. So
//!   curves of different `E*/S` fall together, and the correction begins without a slope at first yield;
//! - `s` is the part of its effective curvature that the body has as its own: 0 for a plane, 1 for a sphere on a rigid flat. Force and
//!   area are mixed linearly between the two;
//! - **plane**: force times `(1 + (1.83 z)^3)^(-1/3)`, `a^2` times `(1 + 0.427 psi z)/(1 + (u (1 - 1/k))^2/4)`. The quarter is that of an
//!   exact sphere, `a^2 = 2 R h - h^2`; the rest is piled up;
//! - **sphere**: it yields to its free sides. Force times `(1 + sigma) (1 + 4.5 psi^2 u^1.5)^(-1/2)`, `a^2` times `1 + 2 sigma`. Between
//!   contact and middle plane a sphere is shorter than a half-space, and so stiffer:
//!   `1/sigma = 1/psi + 1/e`, `e = 0.85 (S/E*) (1 - 1/k)^2 Phi/k` (elastic series of a sphere between two flats, not fitted). `psi` keeps
//!   the force below Hertz's;
//! - **recovery** over `1 + 0.2 z`.
//!
//! Against finite elements with large deformation (`data/truth/`): a plane with `E*/S = 100`, 200, 1000: force within 0.7 % and contact
//! radius within 0.6 % up to `a/R = 0.36`, restitution within 0.7 %; a sphere on a rigid flat with `E*/S = 300`: force within 1.2 % and
//! contact radius within 1.3 % up to `a/R = 0.3`. These curves are those of the fit; others, at `E*/S` = 300 and 400, differ by up to 1.4 %
//! (plane) and 1.6 % (sphere), and planes that are left out of the fit by what they differ within it. Between plane and sphere, and for two bodies, nothing is known to compare with.
//!
//! Outside the tables the correction goes no further: `u` stops where `z` is 0.5, its largest value there, and at 1. Far from all tables,
//! passivity counts: `u` and `e` fade out where `E*/S` is below 20, and the contact radius never falls below Hertz's.

use crate::numerics::dual::Dual;
use crate::numerics::largest;

// fitted to the finite-element curves
const PLANE_FORCE: f64 = 1.83;
const PLANE_AREA: f64 = 0.427;
const SPHERE_FORCE: f64 = 4.5;
const RECOVERY: f64 = 0.2;

/// Shortening of a sphere, from the elastic series.
const SHORTENING: f64 = 0.85;

/// `E*/S` of bodies so soft that the correction is halved: they stay nearly elastic, and large elastic strain is not covered.
const FLEXIBLE: f64 = 20.0;

/// The shortening changes the area by this factor more than the force.
const WIDENING: f64 = 2.0;

/// Plastic strain `z` from which on the correction stays the same: the largest that finite elements have reached.
const LARGEST_STRAIN: f64 = 0.5;

/// The same for the contact radius over the radius.
const LARGEST_RADIUS: f64 = 1.0;

const ONE: Dual = Dual { value: 1.0, slope: 0.0 };

/// A body beyond first yield, by its law for small strain. Slopes are those over the logarithm of any one depth.
#[derive(Clone, Copy)]
pub struct Pressed {
    /// Depth in yield depths.
    pub k: Dual,
    /// Force in yield forces.
    pub force: Dual,
    /// Squared contact radius over that of Hertz's law.
    pub area: f64,
    /// Contact radius over the radius of its sphere.
    pub radius: Dual,
    /// The part of its effective curvature that is its own, from 0 to 1.
    pub curvature: Dual,
    /// Yield strength over plane-strain modulus.
    pub flexibility: f64,
}

/// What large strain changes.
#[derive(Clone, Copy)]
pub struct Correction {
    /// Factor of the force.
    pub force: Dual,
    /// Factor of the squared contact radius.
    pub area: f64,
    /// The measure `z` of the plastic strain.
    pub strain: f64,
}

impl Correction {
    /// That of an elastic body.
    pub const NONE: Correction = Correction { force: ONE, area: 1.0, strain: 0.0 };
}

/// The correction of a body.
#[inline(never)]
pub fn correction(body: &Pressed) -> Correction {
    let Pressed { k, force, area: over_hertz, radius, curvature, flexibility } = *body;
    let inverse = k.inverse();
    let lag = ONE - force * inverse * k.root().inverse();
    // just above yield the two forces differ only by rounding
    let lag = if lag.value > 0.0 { lag } else { Dual::constant(0.0) };
    let soft = FLEXIBLE * flexibility;
    let fading = 1.0 / (1.0 + soft * soft * soft);
    let radius = fading * if radius.value < LARGEST_RADIUS { radius } else { Dual::constant(LARGEST_RADIUS) };
    let is_within = lag.value * radius.value < LARGEST_STRAIN;
    let radius = if is_within { radius } else { LARGEST_STRAIN * lag.inverse() };
    let strain = lag * radius;
    let beyond_yield = ONE - inverse;
    let most = SHORTENING * flexibility * fading;
    let shortening = most * (beyond_yield * beyond_yield * force * inverse);
    // never beyond Hertz's law
    let exists = lag.value > 0.0 && shortening.value > 0.0;
    let both = if exists { (lag + shortening).inverse() } else { ONE };
    let shortening = shortening * lag * both;

    let scaled = PLANE_FORCE * strain;
    let plane = (ONE + scaled * scaled * scaled).power(-1.0 / 3.0);
    let bulging = SPHERE_FORCE * (lag * lag * radius * radius.root());
    let sphere = (ONE + shortening) * (ONE + bulging).root().inverse();
    let factor = plane + curvature * (sphere - plane);

    let round = radius.value * beyond_yield.value;
    let plane_area = (1.0 + PLANE_AREA * lag.value * strain.value) / (1.0 + 0.25 * round * round);
    let sphere_area = 1.0 + WIDENING * shortening.value;
    // never smaller than Hertz's
    let area = largest(plane_area + curvature.value * (sphere_area - plane_area), 1.0 / over_hertz);
    Correction { force: factor, area, strain: strain.value }
}

/// Factor of the recovery of a body with this measure of plastic strain.
pub fn recovery_factor(strain: f64) -> f64 {
    1.0 / (1.0 + RECOVERY * strain)
}
