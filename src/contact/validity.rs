//! The range in which the laws are valid: small compared with the bodies, and slow compared with elastic waves. No law stops
//! there; leaving the range is reported.

use libm::sqrt;

/// Contact radius over effective radius `R` up to which the laws of a paraboloid at small strain hold.
///
/// Against finite elements with large deformation, at `E*/S = 100`, they are off by 0.6 % at most up to there, and by 6 % at
/// 0.5: see DESIGN.md.
pub const LARGEST_RADIUS_RATIO: f64 = 0.3;

/// Closing speed over the speed of waves in a rod of the target, `c0 = sqrt(E/rho)`, up to which elastic waves can be left out.
///
/// Of the energy of an elastic impact they take about `1.04 (v/c0)^(3/5)`: here 6.5 %, which no law has.
///
/// Reference: S. C. Hunter, *Journal of the Mechanics and Physics of Solids* 5 (1957) 162-171; J. Reed, *Journal of Physics D*
/// 18 (1985) 2329-2337.
pub const LARGEST_SPEED_RATIO: f64 = 0.01;

/// Guesses after which a search ends. Some six are enough, since the contact area nearly is a straight line.
const GUESSES: u32 = 60;

/// The largest error of the contact area, relative, that a search leaves.
const AREA_TOLERANCE: f64 = 1e-12;

/// The indentation up to which a law is valid on a sphere of effective `radius` \[m\]: where its `contact_radius`, a function of
/// the indentation \[m\], reaches [`LARGEST_RADIUS_RATIO`].
///
/// It rises with every law, and at an indentation of `R`, where Hertz's is `R`, it is far above that. The search is the
/// Illinois method.
///
/// Reference: M. Dowell, P. Jarratt, *BIT* 11 (1971) 168-174.
#[inline(never)]
pub fn largest_indentation(radius: f64, contact_radius: impl Fn(f64) -> f64) -> f64 {
    let allowed = LARGEST_RADIUS_RATIO * LARGEST_RADIUS_RATIO;
    // squares of ratios, since squares of small radii may be zero
    let excess = |depth: f64| {
        let ratio = contact_radius(depth) / radius;
        ratio * ratio - allowed
    };
    let (mut below, mut above) = ((0.0, -allowed), (radius, excess(radius)));
    let (mut depth, mut was_above) = (0.0, None);
    for _ in 0..GUESSES {
        depth = below.0 + (above.0 - below.0) * (below.1 / (below.1 - above.1));
        let found = excess(depth);
        if found < AREA_TOLERANCE * allowed && found > -AREA_TOLERANCE * allowed {
            break;
        }
        let is_above = found > 0.0;
        let again = was_above == Some(is_above);
        // an end that stays where it is counts for half
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

/// The closing speed \[m/s\] up to which elastic waves can be left out in a target of `youngs_modulus` \[Pa\] and `density` \[kg/m^3\].
pub fn largest_speed(youngs_modulus: f64, density: f64) -> f64 {
    LARGEST_SPEED_RATIO * wave_speed(youngs_modulus, density)
}

/// The speed of waves in a rod, `sqrt(E/rho)` \[m/s\].
pub fn wave_speed(youngs_modulus: f64, density: f64) -> f64 {
    sqrt(youngs_modulus / density)
}
