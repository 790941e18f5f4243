//! The limits of validity of the laws, in words.

use crate::numbers::significant;
use brinell::contact::Pair;
use brinell::contact::impact::Prediction;
use brinell::contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO, wave_speed};

/// Part of the energy of an elastic impact that waves take, at this speed over that of the waves.
///
/// Reference: as for [`LARGEST_SPEED_RATIO`].
fn wave_energy(speed_ratio: f64) -> f64 {
    1.04 * libm::pow(speed_ratio, 0.6)
}

/// A limit of validity that is left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beyond {
    /// The contact radius over the effective radius.
    Width(f64),
    /// The speed over that of the waves.
    Speed { ratio: f64, waves: f64 },
}

/// What a contact of the bodies `pair` leaves that reaches this contact `radius` [m] and this closing `speed` [m/s]; the target
/// may have a known `density` [kg/m^3].
pub fn beyond(pair: &Pair, density: Option<f64>, radius: f64, speed: f64) -> Vec<Beyond> {
    let width = radius / pair.radius;
    let waves = density.map_or(f64::INFINITY, |density| wave_speed(pair.youngs_modulus, density));
    let ratio = speed / waves;
    let width = (width > LARGEST_RADIUS_RATIO).then_some(Beyond::Width(width));
    let speed = (ratio > LARGEST_SPEED_RATIO).then_some(Beyond::Speed { ratio, waves });
    width.into_iter().chain(speed).collect()
}

/// Warnings about a `prediction` for an impact at `speed` [m/s] of the bodies `pair`, whose target may have a known
/// `density` [kg/m^3]; nothing, if the laws are valid.
pub fn warnings(pair: &Pair, density: Option<f64>, prediction: &Prediction, speed: f64) -> Vec<String> {
    beyond(pair, density, prediction.max_contact_radius, speed).into_iter().map(words).collect()
}

/// A limit that is left, in words.
pub fn words(beyond: Beyond) -> String {
    match beyond {
        Beyond::Width(ratio) => format!(
            "the contact radius reaches {} effective radii; above {LARGEST_RADIUS_RATIO} a sphere is no longer a paraboloid, \
             and the law isn't valid",
            significant(ratio, 3)
        ),
        Beyond::Speed { ratio, waves } => format!(
            "the speed is {} of the wave speed of {waves:.0} m/s; above {LARGEST_SPEED_RATIO} elastic waves take energy \
             that the law neglects, here {:.0} % of that of an elastic impact",
            significant(ratio, 3),
            100.0 * wave_energy(ratio)
        ),
    }
}

/// Up to where the law of an FMU is valid on bodies with this `depth` [m] and target, in words: beyond, the FMU logs a warning.
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
