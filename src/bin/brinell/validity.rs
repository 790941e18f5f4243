//! The limits of validity of the laws, in words.

use crate::numbers::significant;
use brinell::contact::Pair;
use brinell::contact::impact::Prediction;
use brinell::contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO, wave_speed};

/// Fraction of the energy of an elastic impact that waves take, for this ratio of speed to wave speed.
///
/// Reference: as for [`LARGEST_SPEED_RATIO`].
fn wave_energy(speed_ratio: f64) -> f64 {
    1.04 * libm::pow(speed_ratio, 0.6)
}

/// A limit of validity that is exceeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beyond {
    /// Ratio of contact radius to effective radius.
    Width(f64),
    /// Ratio of speed to wave speed, and the fraction of energy that waves take.
    Speed { ratio: f64, waves: f64 },
}

/// The limits that a contact of the bodies `pair` exceeds at this contact `radius` [m] and this closing `speed` [m/s]; the
/// `density` [kg/m^3] of the target may be unknown.
pub fn beyond(pair: &Pair, density: Option<f64>, radius: f64, speed: f64) -> Vec<Beyond> {
    let width = radius / pair.radius;
    let waves = density.map_or(f64::INFINITY, |density| wave_speed(pair.youngs_modulus, density));
    let ratio = speed / waves;
    let width = (width > LARGEST_RADIUS_RATIO).then_some(Beyond::Width(width));
    let speed = (ratio > LARGEST_SPEED_RATIO).then_some(Beyond::Speed { ratio, waves });
    width.into_iter().chain(speed).collect()
}

/// Warnings about a `prediction` for an impact at `speed` [m/s] of the bodies `pair`; the `density` [kg/m^3] of the target may
/// be unknown. Empty if the laws are valid.
pub fn warnings(pair: &Pair, density: Option<f64>, prediction: &Prediction, speed: f64) -> Vec<String> {
    beyond(pair, density, prediction.max_contact_radius, speed).into_iter().map(words).collect()
}

/// An exceeded limit, in words.
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

/// The limits of validity of an FMU on bodies with this limit of `depth` [m] and this target, in words. Beyond them, the FMU
/// logs a warning.
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
