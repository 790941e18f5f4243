//! The range in which the laws are valid: contacts that are small compared with the bodies, and speeds that are low compared
//! with elastic waves. Leaving the range logs a warning; the laws continue.

use crate::numerics::smallest;
use libm::{fabs, sqrt};

/// Ratio of contact radius to effective radius `R` up to which the laws hold: they assume a paraboloid and small strain.
///
/// Compared with finite elements with large deformation up to this ratio, the law `brinell`, which is corrected for
/// [large strain](mod@crate::material::large_strain), has the force within 1.4 % on a plane and 1.6 % on a sphere that it is not fitted to. Without
/// the correction a plane has 0.6 to 1.4 % too much, but a sphere of `E*/S = 300` has 17 %.
///
/// The same part of the [smaller body](size_of) is the limit where that is smaller: a socket that hardly differs from its ball has an
/// effective radius far above both, and each body counts as a half-space beside the contact.
pub const LARGEST_RADIUS_RATIO: f64 = 0.3;

/// The size of the smaller of two bodies with these radii of curvature \[m\], one of which may be flat or a socket.
pub fn size_of(radii: [f64; 2]) -> f64 {
    let [one, other] = radii.map(fabs);
    smallest(one, other)
}

/// Ratio of closing speed to the wave speed in a rod of the target, `c0 = sqrt(E/rho)`, up to which elastic waves are
/// negligible.
///
/// Waves take a fraction of about `1.04 (v/c0)^(3/5)` of the energy of an elastic impact. At this ratio it is 6.5 %, which no
/// law includes.
///
/// Reference: S. C. Hunter, *Journal of the Mechanics and Physics of Solids* 5 (1957) 162-171; J. Reed, *Journal of Physics D*
/// 18 (1985) 2329-2337.
pub const LARGEST_SPEED_RATIO: f64 = 0.01;

/// Largest number of iterations of the search. About six are enough, because the contact area is nearly linear.
const GUESSES: u32 = 60;

/// Largest number of doublings of the depth in which it searches.
const DOUBLINGS: u32 = 8;

/// Largest relative error of the contact area after the search.
const AREA_TOLERANCE: f64 = 1e-12;

/// The contact radius up to which a law is valid \[m\]: [`LARGEST_RADIUS_RATIO`] of the effective `radius` \[m\], or of the smaller body,
/// which has this `size` \[m\].
pub fn largest_radius(radius: f64, size: f64) -> f64 {
    LARGEST_RADIUS_RATIO * smallest(radius, size)
}

/// The indentation at which a law of bodies with this effective `radius` \[m\] has the contact radius `wanted` \[m\]: `contact_radius` is a
/// function of the indentation.
///
/// The contact radius rises with the indentation for every law, and is hardly ever below that of Hertz, `sqrt(R d)`. The search uses the
/// Illinois method.
///
/// Reference: M. Dowell, P. Jarratt, *BIT* 11 (1971) 168-174.
#[inline(never)]
pub fn depth_of(wanted: f64, radius: f64, contact_radius: impl Fn(f64) -> f64) -> f64 {
    // ratios are squared, because the square of a small radius may underflow
    let excess = |depth: f64| {
        let ratio = contact_radius(depth) / wanted;
        ratio * ratio - 1.0
    };
    let hertz = wanted / radius * wanted;
    let (mut below, mut above) = ((0.0, -1.0), (hertz, excess(hertz)));
    for _ in 0..DOUBLINGS {
        if above.1 >= 0.0 {
            break;
        }
        below = above;
        above = (2.0 * above.0, excess(2.0 * above.0));
    }
    // a law that is never so wide; NaN is no reason to search either
    let is_wide = above.1 >= 0.0;
    if !is_wide {
        return above.0;
    }
    let (mut depth, mut was_above) = (above.0, None);
    for _ in 0..GUESSES {
        depth = below.0 + (above.0 - below.0) * (below.1 / (below.1 - above.1));
        let found = excess(depth);
        if found < AREA_TOLERANCE && found > -AREA_TOLERANCE {
            break;
        }
        let is_above = found > 0.0;
        let again = was_above == Some(is_above);
        // the value at an end that stays is halved
        if is_above {
            above = (depth, found);
            below.1 *= if again { 0.5 } else { 1.0 };
        } else {
            below = (depth, found);
            above.1 *= if again { 0.5 } else { 1.0 };
        }
        was_above = Some(is_above);
    }
    depth
}

/// The closing speed \[m/s\] up to which elastic waves are negligible in a target of `youngs_modulus` \[Pa\] and `density`
/// \[kg/m^3\].
pub fn largest_speed(youngs_modulus: f64, density: f64) -> f64 {
    LARGEST_SPEED_RATIO * wave_speed(youngs_modulus, density)
}

/// The speed of waves in a rod, `sqrt(E/rho)` \[m/s\].
pub fn wave_speed(youngs_modulus: f64, density: f64) -> f64 {
    sqrt(youngs_modulus / density)
}
