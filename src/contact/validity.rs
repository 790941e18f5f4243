//! Where the laws are valid: small against the bodies, and slow against elastic waves. No law here stops there; whoever
//! goes on is told.

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

/// Halvings that leave nothing of an effective radius but rounding.
const HALVINGS: u32 = 60;

/// The indentation up to which a law is valid on a sphere of effective `radius` \[m\]: where its `contact_radius`, a function of
/// the indentation \[m\], reaches [`LARGEST_RADIUS_RATIO`].
///
/// It rises with every law, and at an indentation of `R`, where Hertz's is `R`, it is far above that.
#[inline(never)]
pub fn largest_indentation(radius: f64, contact_radius: impl Fn(f64) -> f64) -> f64 {
    let (mut depth, mut width) = (0.0, radius);
    for _ in 0..HALVINGS {
        width *= 0.5;
        if contact_radius(depth + width) < LARGEST_RADIUS_RATIO * radius {
            depth += width;
        }
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
