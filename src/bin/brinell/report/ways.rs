//! The ways to couple a contact with a mass that the master moves.

use super::unit::Contact;
use crate::importer::ImportError;

/// What a master found of one impact.
pub struct Rebound {
    /// Away from the surface [m/s].
    pub speed: f64,
    /// At the ends of steps [N].
    pub max_force: f64,
}

/// A master: contact, mass [kg], closing speed [m/s], step [s]. An impact that isn't over after so many steps that
/// something must be wrong ends with a NaN speed.
pub type Master = fn(&mut Contact, f64, f64, f64) -> Result<Rebound, ImportError>;

/// A way to couple.
pub struct Way {
    pub name: &'static str,
    pub master: Master,
    /// Whether the unit must know the mass.
    pub knows_mass: bool,
    /// Whether a unit whose force follows the rate can do it; it has no input derivatives and can't know the mass.
    pub by_rate: bool,
}

pub const LATE: Way = Way { name: "late force", master: late, knows_mass: false, by_rate: true };
pub const LEAP_FROG: Way = Way { name: "leap-frog", master: leap_frog, knows_mass: false, by_rate: true };

pub const MASS_KNOWN: Way = Way { name: "mass known", master: mass_known, knows_mass: true, by_rate: false };

/// All ways that a report runs.
pub const WAYS: [Way; 5] = [
    LATE,
    Way { name: "predicted_force", master: predicted, knows_mass: false, by_rate: true },
    LEAP_FROG,
    Way { name: "input derivatives", master: derivatives, knows_mass: false, by_rate: false },
    MASS_KNOWN,
];

/// Steps after which an impact is given up: the longest that a report asks for has half a million.
const LONGEST: u64 = 20_000_000;

/// Makes steps by `advance`, which takes force and speed and gives them anew, until the bodies part.
fn until_they_part(
    mut speed: f64,
    mut advance: impl FnMut(f64, f64) -> Result<(f64, f64), ImportError>,
) -> Result<Rebound, ImportError> {
    let (mut force, mut max_force) = (0.0, 0.0);
    for _ in 0..LONGEST {
        if force <= 0.0 && speed <= 0.0 {
            return Ok(Rebound { speed: -speed, max_force });
        }
        (force, speed) = advance(force, speed)?;
        max_force = f64::max(max_force, force);
    }
    Ok(Rebound { speed: f64::NAN, max_force })
}

/// All units step at once: the bodies feel the force of the beginning of the step. First order.
fn late(contact: &mut Contact, mass: f64, speed: f64, step: f64) -> Result<Rebound, ImportError> {
    until_they_part(speed, |force, speed| {
        contact.set_rate(speed)?;
        contact.step(step)?;
        Ok((contact.force()?, speed - step * force / mass))
    })
}

/// All units step at once, with the force that the contact expects at the end of the step. Second order.
fn predicted(contact: &mut Contact, mass: f64, speed: f64, step: f64) -> Result<Rebound, ImportError> {
    until_they_part(speed, |_, speed| {
        contact.set_rate(speed)?;
        let expected = contact.predicted_force()?;
        contact.step(step)?;
        Ok((contact.force()?, speed - step * expected / mass))
    })
}

/// First the contact, then the bodies with its new force. Second order.
fn leap_frog(contact: &mut Contact, mass: f64, speed: f64, step: f64) -> Result<Rebound, ImportError> {
    until_they_part(speed, |_, speed| {
        contact.set_rate(speed)?;
        contact.step(step)?;
        let force = contact.force()?;
        Ok((force, speed - step * force / mass))
    })
}

/// Acceleration and jerk as input derivatives, the mean force over the step out. Third order.
fn derivatives(contact: &mut Contact, mass: f64, speed: f64, step: f64) -> Result<Rebound, ImportError> {
    let mut slope = 0.0;
    until_they_part(speed, |force, speed| {
        contact.set_rate(speed)?;
        contact.set_derivatives([-force / mass, -slope / mass])?;
        contact.step(step)?;
        let speed = speed - step * contact.mean_force()? / mass;
        slope = contact.force_slope()?;
        Ok((contact.force()?, speed))
    })
}

/// The unit moves the mass itself within the step: exact but for rounding.
fn mass_known(contact: &mut Contact, mass: f64, speed: f64, step: f64) -> Result<Rebound, ImportError> {
    until_they_part(speed, |_, speed| {
        contact.set_rate(speed)?;
        contact.step(step)?;
        let speed = speed - step * contact.mean_force()? / mass;
        Ok((contact.force()?, speed))
    })
}
