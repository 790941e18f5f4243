//! The master of a check: it moves the mass against one contact, as a user's own would.

use super::trial::STEPS_PER_CONTACT;
use crate::importer::{ImportError, Instance};
use brinell::contact::impact::Impact;

/// Iterations of a force that depends on the rate with the speed that it leads to.
const ITERATIONS: u32 = 3;

/// What an explicit co-simulation finds.
pub struct Simulated {
    pub max_indentation: f64,
    pub max_force: f64,
    pub residual_indentation: f64,
    pub restitution: f64,
    pub contact_time: f64,
}

/// A master that moves the mass and holds the rate over each step: the leap-frog method, of second order, and explicit.
pub struct Master<'a, 'b> {
    pub instance: &'a mut Instance<'b>,
    pub rate: u32,
    pub force: u32,
    pub time: f64,
    /// Whether the force follows the rate at the same instant.
    pub follows: bool,
    /// The mean force of a unit that moves the mass itself: the rate is then that at the start of a step.
    pub mean_force: Option<u32>,
    /// Whether that unit is made for a master that steps all units at once: its force is then one for the next step.
    pub parallel: bool,
}

/// After this many steps an impact counts as endless: sixteen times as many as it should take.
const MOST_STEPS: u32 = 16 * STEPS_PER_CONTACT;

/// Short steps after which a unit has forgotten a long one.
const FORGOTTEN: u32 = 120;

impl Master<'_, '_> {
    /// Steps with `rate` [m/s] and gives the force at the end [N].
    fn step(&mut self, rate: f64, step: f64) -> Result<f64, ImportError> {
        self.instance.set_real(self.rate, rate)?;
        self.instance.do_step(self.time, step)?;
        self.time += step;
        self.instance.real(self.force)
    }

    /// The force at this moment with `rate` [m/s], [N].
    fn force_at(&mut self, rate: f64) -> Result<f64, ImportError> {
        self.instance.set_real(self.rate, rate)?;
        self.instance.real(self.force)
    }

    /// Crosses `gap` [m] at `speed` [m/s].
    fn approach(&mut self, speed: f64, gap: f64, step: f64) -> Result<(), ImportError> {
        if gap <= 0.0 {
            return Ok(());
        }
        let short = if self.parallel { f64::min(gap, f64::from(FORGOTTEN) * step * speed) } else { 0.0 };
        if gap > short {
            self.step(speed, (gap - short) / speed)?;
        }
        for _ in 0..if short > 0.0 { FORGOTTEN } else { 0 } {
            self.step(speed, short / speed / f64::from(FORGOTTEN))?;
        }
        Ok(())
    }

    /// Lets the mass of `impact` meet the contact, after the way across `gap` [m], until they part again.
    pub fn impact(&mut self, impact: &Impact, gap: f64, step: f64) -> Result<Simulated, ImportError> {
        self.approach(impact.speed, gap, step)?;
        // the speed in the middle of each step; that the force at first contact may not be zero is an error of one step
        let (mut speed, mut owed) = (impact.speed, 0.0);
        let (mut indentation, mut time) = (0.0, 0.0);
        let (mut max_indentation, mut max_force) = (0.0, 0.0);
        // indentation and force at the ends of the last two steps
        let mut before = [(0.0, 0.0); 2];
        for _ in 0..MOST_STEPS {
            let start = speed;
            let mut force = self.step(speed + owed, step)?;
            for _ in 0..if self.follows { ITERATIONS } else { 0 } {
                force = self.force_at(speed - 0.5 * step * force / impact.mass)?;
            }
            if let Some(mean_force) = self.mean_force {
                let change = step * self.instance.real(mean_force)? / impact.mass;
                speed -= change;
                // what has been applied by the end of a step doesn't have it yet
                owed = if self.parallel { change } else { 0.0 };
            }
            indentation += 0.5 * (start + speed) * step;
            time += step;
            max_indentation = f64::max(max_indentation, indentation);
            max_force = f64::max(max_force, force);
            if force <= 0.0 && speed < 0.0 {
                let residual = end_of_contact(before);
                return Ok(Simulated {
                    max_indentation,
                    max_force,
                    residual_indentation: residual,
                    restitution: -speed / impact.speed,
                    contact_time: time - (residual - indentation) / -speed,
                });
            }
            before = [before[1], (indentation, force)];
            if self.mean_force.is_none() {
                speed -= step * force / impact.mass;
            }
            if !force.is_finite() {
                return Err(ImportError::Force { force, time });
            }
        }
        Err(ImportError::Endless { steps: MOST_STEPS })
    }
}

/// Where the force ends [m], from the last two points of the contact: it vanishes as `(d - d_f)^1.5`.
fn end_of_contact([(first, first_force), (last, last_force)]: [(f64, f64); 2]) -> f64 {
    let (first_root, last_root) = (f64::powf(first_force, 2.0 / 3.0), f64::powf(last_force, 2.0 / 3.0));
    last - last_root * (first - last) / (first_root - last_root)
}
