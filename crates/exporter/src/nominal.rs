//! Typical values of the variables, for solvers that scale by them, and a suitable step size for a scene.

use crate::scene::Scene;
use crate::table::Variable;
use brinell_contact::impact::Prediction;
use std::f64::consts::PI;

/// Typical values of one group of contacts.
#[derive(Clone, Copy)]
pub struct Nominal {
    prediction: Prediction,
    /// Stiffness \[N/m\].
    stiffness: f64,
    /// Speed of the scene's impact \[m/s\].
    speed: f64,
    /// Coefficient of friction; 1 if it is zero.
    friction: f64,
}

/// The typical values of each group.
pub fn of(scene: &Scene) -> Vec<Nominal> {
    scene.by_bodies(|group| {
        let prediction = scene.predictions[group];
        let stiffness = scene.any_model_of(group).stiffness(prediction.max_indentation);
        let friction =
            scene.group_value(group, "friction.coefficient").filter(|friction| *friction > 0.0).unwrap_or(1.0);
        Nominal { prediction, stiffness, speed: scene.impact.speed, friction }
    })
}

impl Nominal {
    /// The typical value of `variable`, if its entry in the table names one.
    pub fn get(&self, variable: &Variable) -> Option<f64> {
        let Prediction { max_force, max_indentation, max_contact_radius, energy, .. } = self.prediction;
        let size = match variable.nominal_from.as_deref()? {
            "max_force" => max_force,
            "max_indentation" => max_indentation,
            "max_contact_radius" => max_contact_radius,
            "max_mean_pressure" => max_force / (PI * max_contact_radius * max_contact_radius),
            "max_stiffness" => self.stiffness,
            "energy" => energy,
            "speed" => self.speed,
            "max_friction" => self.friction * max_force,
            "tangential_momentum" => self.friction * 2.0 * energy / self.speed,
            "momentum" => 2.0 * energy / self.speed,
            // an impulse of this size acts for half of the time
            "moment" => energy / self.speed * self.prediction.contact_time(),
            other => unreachable!("variables.toml names the nominal size {other}, which nobody computes"),
        };
        Some(one_digit(size, f64::round))
    }
}

/// `value` > 0 with one significant digit; `round` rounds its mantissa.
fn one_digit(value: f64, round: fn(f64) -> f64) -> f64 {
    let exponent = libm::log10(value).floor() as i32;
    let mantissa = round(value / libm::pow(10.0, f64::from(exponent)));
    // converted through text, so that the result is the nearest number to what a person would write
    format!("{mantissa}e{exponent}").parse().expect("a number and an exponent")
}

/// Step size and stop time that suit the scene.
pub struct Experiment {
    /// Step size \[s\].
    pub step: f64,
    /// Stop time \[s\].
    pub stop: f64,
}

/// Steps per contact for the suggested step size. For the impact of the default scene, the restitution is then accurate to 2 %
/// if the force comes one step late, and to 1e-5 with leap-frog.
const STEPS_PER_CONTACT: f64 = 256.0;

/// Step size and stop time for the scene's impact on its first contact. The contact takes 256 steps and ends before the stop
/// time.
pub fn experiment(scene: &Scene) -> Experiment {
    let contact_time = scene.predictions[0].contact_time();
    let step = one_digit(contact_time / STEPS_PER_CONTACT, |mantissa| match mantissa {
        m if m >= 5.0 => 5.0,
        m if m >= 2.0 => 2.0,
        _ => 1.0,
    });
    let gap = scene.group_value(0, "initial_gap").unwrap_or(0.0).max(0.0);
    let stop = one_digit(2.0 * contact_time + gap / scene.impact.speed, f64::ceil);
    Experiment { step, stop }
}
