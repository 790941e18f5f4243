//! The paths of the contacts, as rates.

use std::f64::consts::{PI, TAU};

/// Number of steps of an impact; half of them close.
pub const STEPS: usize = 1000;

/// Step size of an impact [s].
pub const STEP: f64 = 1e-6;

/// Largest indentation of the impact [m]: about 200 yield indentations of a ball on steel, which all FMUs model.
pub const PEAK: f64 = 200.0 * 5.9e-8;

/// Rates [m/s] of an impact with an assumed constant force: they decrease linearly from closing to opening, so that each step
/// has a different rate. Half of the steps load the contact, a quarter unloads it, the rest is flight.
pub fn impact() -> Vec<f64> {
    let largest = 4.0 * PEAK / (STEPS as f64 * STEP);
    (0..STEPS).map(|index| largest * (1.0 - (2 * index + 1) as f64 / STEPS as f64)).collect()
}

/// Factor of the rates of one of many contacts, so that not all leave their branches in the same step. It is 1 for the first
/// contact.
pub fn share(contact: usize) -> f64 {
    1.0 - (contact % 16) as f64 / 100.0
}

/// Indentation at which the contact of the default scene yields [m], at a mean pressure of 1.1 yield strengths.
pub fn yield_indentation() -> f64 {
    let (radius, youngs_modulus, poissons_ratio, strength) = (5e-3, 206e9, 0.3, 300e6);
    let modulus = youngs_modulus / (1.0 - poissons_ratio * poissons_ratio);
    let strain = 0.75 * PI * 1.1 * strength / modulus;
    radius * strain * strain
}

/// Total number of steps of all cycles.
pub const CYCLE_STEPS: usize = 8192;

/// Step size of a cycle [s].
pub const CYCLE_STEP: f64 = 1e-7;

/// Typical numbers of steps of a cycle.
pub const STEPS_PER_CYCLE: [usize; 4] = [1024, 128, 64, 32];

/// Rates [m/s] of cycles of this number of steps, whose peaks grow from half a yield indentation to 200. Before its peak, each
/// cycle goes back and in again for a part of the way, and likewise on its way out. It ends where it began.
pub fn cycles(steps_per_cycle: usize) -> Vec<f64> {
    let cycles = CYCLE_STEPS / steps_per_cycle;
    let steps = steps_per_cycle as f64;
    let rate = |index: usize| {
        let peak = 0.5 * 400_f64.powf((index / steps_per_cycle) as f64 / (cycles - 1) as f64);
        let phase = TAU * ((index % steps_per_cycle) as f64 + 0.5) / steps;
        let shape = phase.sin() + 1.5 * (3.0 * phase).sin();
        peak * yield_indentation() / 3.0 * shape * (TAU / steps) / CYCLE_STEP
    };
    (0..CYCLE_STEPS).map(rate).collect()
}
