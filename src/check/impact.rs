//! The impact of a check: what a user's importer finds that moves the mass with fine steps.

use crate::importer::ImportError;
use crate::master::Contact;
use brinell_contact::impact::Impact;
use brinell_exporter::master::{
    Body, Coupled, CouplingMethod, JACOBI_MASS, LEAP_FROG, LEAP_FROG_FOLLOWED, MASS_KNOWN, Requirements,
};
use brinell_exporter::scene::Scene;
use serde::Serialize;
use std::borrow::Cow;

/// One quantity, predicted and from the co-simulation. Those of an oblique impact are predicted by the springs of the
/// library.
#[derive(Debug, Serialize)]
pub struct Row {
    pub quantity: Cow<'static, str>,
    pub unit: &'static str,
    pub predicted: f64,
    pub simulated: f64,
    /// Difference relative to the predicted value or to `scale`.
    pub difference: f64,
}

impl Row {
    /// A row whose difference is relative to `scale`.
    pub fn new(
        quantity: impl Into<Cow<'static, str>>,
        unit: &'static str,
        predicted: f64,
        simulated: f64,
        scale: f64,
    ) -> Row {
        Row { quantity: quantity.into(), unit, predicted, simulated, difference: (simulated - predicted) / scale }
    }
}

/// Results of an explicit co-simulation.
pub struct Simulated {
    pub max_indentation: f64,
    pub max_force: f64,
    pub residual_indentation: f64,
    pub restitution: f64,
    pub contact_time: f64,
}

/// Number of steps per contact. The method is of second order: its error is then far below the tolerance.
pub const STEPS_PER_CONTACT: u32 = 4096;

/// Number of steps after which an impact counts as endless: sixteen times the expected number.
pub const MOST_STEPS: u32 = 16 * STEPS_PER_CONTACT;

/// Number of short steps after which a long step no longer affects an FMU whose force is applied one step late.
const FORGOTTEN: u32 = 120;

/// The way to couple an FMU of `scene`.
pub fn way_of(scene: &Scene) -> &'static CouplingMethod {
    match &scene.coupling {
        Some(coupling) if coupling.parallel => &JACOBI_MASS,
        Some(_) => &MASS_KNOWN,
        None if scene.follows_rate() => &LEAP_FROG_FOLLOWED,
        None => &LEAP_FROG,
    }
}

/// Moves the mass of `impact` across the `gap` [m] and against the contact until they separate again. The force ends with this `power`
/// of the time.
///
/// # Errors
/// [`ImportError`] if the FMU rejects a call, for a force that is not finite, and for an impact that doesn't end.
pub fn simulate(
    contact: &mut Contact,
    way: &CouplingMethod,
    impact: &Impact,
    (gap, power): (f64, f64),
    step: f64,
) -> Result<Simulated, ImportError> {
    approach(contact, way, impact.speed, gap, step)?;
    let (mut body, begin) = (Body::flying(impact.mass, impact.speed), contact.elapsed());
    let (mut indentation, mut max_indentation, mut max_force) = (0.0, 0.0, 0.0);
    // time, indentation and force at the end of the last two steps
    let mut before = [(0.0, 0.0, 0.0); 2];
    for _ in 0..MOST_STEPS {
        let start = body.settled_speed(step);
        way.advance(contact, &mut body, step)?;
        let (force, speed, time) = (body.force, body.settled_speed(step), contact.elapsed() - begin);
        if !force.is_finite() {
            return Err(ImportError::Force { force, time });
        }
        // the other ways hold the rate, which is that in the middle of the step
        indentation += step * if way.needs.knows_mass() { 0.5 * (start + speed) } else { start };
        max_indentation = f64::max(max_indentation, indentation);
        max_force = f64::max(max_force, force);
        if force <= 0.0 && speed < 0.0 {
            let (contact_time, residual_indentation) = end_of_force(before, power);
            return Ok(Simulated {
                max_indentation,
                max_force,
                residual_indentation,
                restitution: -speed / impact.speed,
                contact_time,
            });
        }
        before = [before[1], (time, indentation, force)];
    }
    Err(ImportError::Endless { steps: MOST_STEPS })
}

/// Crosses `gap` [m] at `speed` [m/s].
fn approach(contact: &mut Contact, way: &CouplingMethod, speed: f64, gap: f64, step: f64) -> Result<(), ImportError> {
    if gap <= 0.0 {
        return Ok(());
    }
    let short =
        if way.needs == Requirements::JacobiMass { f64::min(gap, f64::from(FORGOTTEN) * step * speed) } else { 0.0 };
    contact.set_rate(speed)?;
    if gap > short {
        contact.step((gap - short) / speed)?;
    }
    for _ in 0..if short > 0.0 { FORGOTTEN } else { 0 } {
        contact.step(short / speed / f64::from(FORGOTTEN))?;
    }
    Ok(())
}

/// Time \[s\] and indentation \[m\] at which the force ends, from the last two points in contact: it vanishes with this
/// `power` of the time. A force with a loss vanishes in another way, within the same step.
fn end_of_force([first, last]: [(f64, f64, f64); 2], power: f64) -> (f64, f64) {
    let root = |force: f64| f64::powf(force, 1.0 / power);
    let steps = root(last.2) / (root(first.2) - root(last.2));
    (last.0 + steps * (last.0 - first.0), last.1 + steps * (last.1 - first.1))
}
