//! Friction in two directions on contacts that yield, for all pairs of laws that support friction.

use super::friction_growth::{Run, allowed, history, models};
use crate::physics::Random;
use brinell_contact::tangential::Sliding;
use std::f64::consts::PI;

/// A direction that turns in most steps.
fn turning(seed: u64) -> impl FnMut(f64) -> [f64; 2] {
    let mut random = Random(seed);
    move |slip| {
        let (sine, cosine) = (2.0 * PI * random.next()).sin_cos();
        [slip * cosine, slip * sine]
    }
}

#[test]
fn the_force_keeps_coulombs_bound_and_friction_dissipates_energy_however_the_motion_turns() {
    for (name, model) in models() {
        let (mut excess, mut gain, mut divided) = (0.0_f64, 0.0_f64, 0.0_f64);
        for seed in 100..104 {
            let (mut run, mut fine) = (Run::<2, 16>::new(&model), Run::<2, 16>::new(&model));
            let (mut lost, mut most, mut scale, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
            let mut turn = turning(seed);
            for (rise, slip) in history(seed, 30) {
                let (before, slip) = (run.energy(), turn(slip));
                lost += run.step(&model, (rise, slip), 4) - (run.energy() - before);
                fine.step(&model, (rise, slip), 40);
                let force = run.contact.force();
                largest = largest.max(force);
                let ratio = model.friction.coefficient / model.friction.scale();
                scale = scale.max(ratio * run.contact.elastic_energy(&model.normal));
                let ([x, y], [u, v]) = (run.pull(), fine.pull());
                excess = excess.max((x.hypot(y) - 0.3 * force) / (0.3 * largest).max(1e-30));
                divided = divided.max((x - u).hypot(y - v) / (0.3 * largest).max(1e-30));
                most = most.max(lost);
                gain = gain.max((most - lost) / scale.max(1e-30));
                assert!(run.energy() >= -1e-12 * scale, "{name}, seed {seed}: {:e}", run.energy());
                assert_eq!(run.springs.sliding() == Sliding::Apart, force == 0.0, "{name}, seed {seed}");
            }
        }
        println!("{name}: above Coulomb {excess:.1e}, friction work falls by {gain:.1e}, in 40 parts {divided:.1e}");
        assert!(excess <= 1e-12 && gain <= 1e-2 && divided <= allowed(&name).max(2e-3), "{name}");
    }
}
