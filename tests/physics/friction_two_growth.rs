//! Friction in two directions on contacts that yield, for all pairs of laws that support friction.

use super::friction_growth::{FRICTION, Model, allowed, history, models};
use crate::physics::Random;
use brinell_contact::History;
use brinell_contact::tangential::{Mean, PlaneSprings, Sliding};
use std::f64::consts::PI;

struct Run<const N: usize> {
    contact: History,
    springs: PlaneSprings<N>,
}

impl<const N: usize> Run<N> {
    fn new(model: &Model) -> Run<N> {
        let contact = History::start(&model.normal, 0.0).expect("within range");
        Run { contact, springs: PlaneSprings::start(model, &contact) }
    }

    /// One step, divided into `parts`. Returns the work of the tangential force.
    fn step(&mut self, model: &Model, (rise, slip): (f64, [f64; 2]), parts: u32) -> f64 {
        let part = 1.0 / f64::from(parts);
        let mut work = 0.0;
        for _ in 0..parts {
            let way = (rise * part, slip.map(|slip| slip * part));
            let mean = self.springs.advance_along(&mut self.contact, model, way, (rise, slip), Mean::Exact);
            let [mean, other] = mean.expect("within range");
            work += mean * way.1[0] + other * way.1[1];
        }
        work
    }

    fn pull(&self) -> [f64; 2] {
        self.springs.forces(&FRICTION, self.contact.indentation())
    }

    fn energy(&self) -> f64 {
        self.springs.energy(&FRICTION, self.contact.indentation())
    }
}

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
            let (mut run, mut fine) = (Run::<16>::new(&model), Run::<16>::new(&model));
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
