//! The importer of a check: it moves the mass against one contact, as a user's importer would.

use crate::importer::{ImportError, Instance};
use brinell_contact::impact::Impact;

/// Number of fixed-point iterations between a rate-dependent force and the speed that it causes.
const ITERATIONS: u32 = 3;

/// Results of an explicit co-simulation.
pub struct Simulated {
    pub max_indentation: f64,
    pub max_force: f64,
    pub residual_indentation: f64,
    pub restitution: f64,
    pub contact_time: f64,
}

/// An importer that moves the mass at a constant rate in each step: the leap-frog method, explicit and of second order.
pub struct Master<'a, 'b> {
    pub instance: &'a mut Instance<'b>,
    pub rate: u32,
    pub force: u32,
    pub time: f64,
    /// Whether the force depends on the rate at the same instant.
    pub follows: bool,
    /// The variable `mean_force` of an FMU that moves the mass itself. The rate is then that at the start of a step.
    pub mean_force: Option<u32>,
    /// Whether that FMU is for an importer that steps all FMUs at once. Its force is then for the next step.
    pub parallel: bool,
}

/// Number of steps per contact. The method is of second order: its error is then far below the tolerance.
pub const STEPS_PER_CONTACT: u32 = 4096;

/// Number of steps after which an impact counts as endless: sixteen times the expected number.
const MOST_STEPS: u32 = 16 * STEPS_PER_CONTACT;

/// Number of short steps after which a long step no longer affects the FMU.
const FORGOTTEN: u32 = 120;

impl Master<'_, '_> {
    /// Makes a step at `rate` [m/s] and returns the force at its end [N].
    fn step(&mut self, rate: f64, step: f64) -> Result<f64, ImportError> {
        self.instance.set_real(self.rate, rate)?;
        self.instance.do_step(self.time, step)?;
        self.time += step;
        self.instance.real(self.force)
    }

    /// The present force at `rate` [m/s], in N.
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

    /// Moves the mass of `impact` across `gap` [m] and against the contact until they separate again.
    pub fn impact(&mut self, impact: &Impact, gap: f64, step: f64) -> Result<Simulated, ImportError> {
        self.approach(impact.speed, gap, step)?;
        // the speed is taken at the middle of each step; a nonzero force at first contact causes the error of one step only
        let (mut speed, mut owed) = (impact.speed, 0.0);
        let (mut indentation, mut time) = (0.0, 0.0);
        let (mut max_indentation, mut max_force) = (0.0, 0.0);
        // indentation and force at the end of the last two steps
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
                // the force applied up to the end of a step does not contain this change yet
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

/// The indentation at which the force ends [m], from the last two points in contact: it vanishes as `(d - d_f)^1.5`.
fn end_of_contact([(first, first_force), (last, last_force)]: [(f64, f64); 2]) -> f64 {
    let (first_root, last_root) = (f64::powf(first_force, 2.0 / 3.0), f64::powf(last_force, 2.0 / 3.0));
    last - last_root * (first - last) / (first_root - last_root)
}
