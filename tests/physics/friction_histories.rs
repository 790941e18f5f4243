//! Friction in two directions makes no force and no energy, whatever the history: every pair of laws, steps of any size, dents that
//! grow. See `friction_passive` for one direction.

use super::friction_growth::{Model, models};
use crate::physics::Random;
use brinell::contact::Contact;
use brinell::contact::path::Course;
use brinell::contact::tangential::{Friction, PlaneContact};
use std::f64::consts::PI;

const STEP: f64 = 1e-6;

/// A size over these decades below `largest`, of either sign.
fn any_size(random: &mut Random, largest: f64, decades: f64) -> f64 {
    let size = largest * 10f64.powf(-decades * random.next());
    if random.next() < 0.5 { size } else { -size }
}

/// Worst excess over Coulomb's bound, fall of the friction work and excess over what friction can take, and of the stick radius,
/// over 2 to 50 steps.
fn worst(model: &Model, seed: u64) -> [f64; 4] {
    let mut random = Random(seed);
    let coefficient = 10f64.powf(3.0 * random.next() - 2.0);
    let model = Model { friction: Friction { coefficient, ..model.friction }, ..*model };
    let unit = model.normal.yield_point().indentation.min(2e-6);
    let deepest = unit * 10f64.powf(2.5 * random.next());
    let mut contact = PlaneContact::<16>::start(&model, 0.0).expect("within range");
    let (mut found, mut bound, mut scale, mut limit) = ([0.0_f64; 4], 0.0, 0.0_f64, 0.0_f64);
    for _ in 0..2 + (48.0 * random.next()) as usize {
        let here = Contact::<Model>::indentation(&contact);
        let mut rise = any_size(&mut random, deepest, 10.0);
        if !(-0.1 * deepest..deepest).contains(&(here + rise)) {
            rise = -rise;
        }
        let (slip, angle) = (any_size(&mut random, 10.0 * deepest, 10.0), 2.0 * PI * random.next());
        let rates = [angle.cos(), angle.sin()].map(|along| along * slip / STEP);
        let (before, work) = (contact, contact.friction_work(&model));
        contact.set_tangential_rates(rates);
        contact.step(&Course::held(rise / STEP), STEP, || model).expect("within range");
        let size = |[x, y]: [f64; 2]| x.hypot(y);
        let force = Contact::<Model>::force(&contact, 0.0);
        limit = limit.max(coefficient * force);
        let mean = before.normal().mean_force(&model.normal, rise / STEP, STEP).expect("within range");
        bound += coefficient * mean * size(rates) * STEP;
        scale = scale.max(contact.normal().elastic_energy(&model.normal)).max(bound);
        let excess = |one: f64, other: f64, size: f64| if one > other { (one - other) / size.max(1e-300) } else { 0.0 };
        let now = [
            excess(size(contact.tangential_forces(&model)), coefficient * force, limit),
            excess(work, contact.friction_work(&model), scale),
            excess(contact.friction_work(&model), bound, scale),
            excess(contact.stick_radius(&model), contact.contact_radius(&model), contact.contact_radius(&model)),
        ];
        found = std::array::from_fn(|index| found[index].max(now[index]));
        assert!(contact.tangential_energy(&model) >= 0.0);
    }
    found
}

#[test]
fn friction_in_two_directions_keeps_coulombs_bound_and_its_work_never_falls() {
    let mut failed = Vec::new();
    for (name, model) in models() {
        let all = (0..40).map(|seed| worst(&model, seed));
        let found = all.fold([0.0_f64; 4], |sum, one| std::array::from_fn(|index| sum[index].max(one[index])));
        if !(found[0] <= 1e-12 && found[1] <= 1e-15 && found[2] <= 1e-6 && found[3] <= 1e-12) {
            failed.push(format!("{name}: {found:?}"));
        }
    }
    assert!(failed.is_empty(), "above Coulomb, falls, above mu F times the way, stick radius:\n{}", failed.join("\n"));
}
