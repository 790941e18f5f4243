//! What leaves the validity of the laws, in words.

use brinell::contact::Pair;
use brinell::contact::impact::Prediction;
use brinell::contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO, wave_speed};

/// Part of the energy of an elastic impact that waves take, at this speed over that of the waves.
///
/// Reference: as for [`LARGEST_SPEED_RATIO`].
fn wave_energy(speed_ratio: f64) -> f64 {
    1.04 * speed_ratio.powf(0.6)
}

/// What is to be said against a `prediction` for an impact at `speed` [m/s] of the bodies `pair`, whose target may have a known
/// `density` [kg/m^3]; nothing, if the laws are valid.
pub fn warnings(pair: &Pair, density: Option<f64>, prediction: &Prediction, speed: f64) -> Vec<String> {
    let mut warnings = Vec::new();
    let ratio = prediction.max_contact_radius / pair.radius;
    if ratio > LARGEST_RADIUS_RATIO {
        warnings.push(format!(
            "the contact radius reaches {ratio:.2} effective radii; above {LARGEST_RADIUS_RATIO} the sphere is no paraboloid \
             any more, and the law isn't valid"
        ));
    }
    let Some(density) = density else { return warnings };
    let waves = wave_speed(pair.youngs_modulus, density);
    let ratio = speed / waves;
    if ratio > LARGEST_SPEED_RATIO {
        warnings.push(format!(
            "the speed is {ratio:.3} of the wave speed of {waves:.0} m/s; above {LARGEST_SPEED_RATIO} elastic waves take energy \
             that the law leaves out, here {:.0} % of an elastic impact's",
            100.0 * wave_energy(ratio)
        ));
    }
    warnings
}

/// Up to where the unit's law is valid on bodies with this `depth` [m] and target, in words: what the unit tells of.
pub fn limits(pair: &Pair, density: Option<f64>, depth: f64) -> String {
    let radius = format!(
        "up to a contact radius of {LARGEST_RADIUS_RATIO} effective radii, here an indentation of {depth:.3e} m"
    );
    match density {
        Some(density) => format!(
            "{radius}, and up to a closing speed of {LARGEST_SPEED_RATIO} of the wave speed, here {:.3} m/s",
            LARGEST_SPEED_RATIO * wave_speed(pair.youngs_modulus, density)
        ),
        None => format!("{radius}, and slow against elastic waves (the scene gives no density of the target)"),
    }
}
