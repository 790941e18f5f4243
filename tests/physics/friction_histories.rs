//! Friction in two directions makes no force and no energy, whatever the history: every pair of laws, steps of any size, dents that
//! grow. See `friction_passive` for one direction.

use super::friction_growth::{Model, models};
use crate::physics::{AnyModel, Random};
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::tangential::{Friction, FrictionalContact, PlaneContact, Sliding};
use brinell_contact::{Contact, Pair};
use brinell_testing::long;
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
        contact.step(&RatePolynomial::held(rise / STEP), STEP, || model).expect("within range");
        let size = |[x, y]: [f64; 2]| x.hypot(y);
        let force = Contact::<Model>::force(&contact, 0.0);
        limit = limit.max(coefficient * force);
        let mean = before.normal().mean_force(&model.normal, rise / STEP, STEP).expect("within range");
        bound += coefficient * mean * size(rates) * STEP;
        scale = scale.max(contact.normal().elastic_energy(&model.normal)).max(bound);
        let excess = |one: f64, other: f64, size: f64| if one > other { (one - other) / size.max(1e-300) } else { 0.0 };
        let now = [
            excess(size(contact.tangential_forces(&model, 0.0)), coefficient * force, limit),
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

/// How far two directions are from one direction along the same line, over 2 to 50 steps: force, mean force, impulse, stored
/// energy, friction work, each relative to its largest size so far.
fn from_one_direction(model: &Model, seed: u64) -> [f64; 5] {
    let mut random = Random(seed);
    let coefficient = 10f64.powf(3.0 * random.next() - 2.0);
    let model = Model { friction: Friction { coefficient, ..model.friction }, ..*model };
    let unit = model.normal.yield_point().indentation.min(2e-6);
    let deepest = unit * 10f64.powf(2.5 * random.next());
    let angle = [0.0, 0.5 * PI, PI, 0.3, 2.0, 4.0, 5.5, 1e-9][seed as usize % 8];
    let mut plane = PlaneContact::<64>::start(&model, 0.0).expect("within range");
    let mut line = FrictionalContact::<64>::start(&model, 0.0).expect("within range");
    let (mut found, mut limit, mut time, mut scale) = ([0.0_f64; 5], 0.0_f64, 0.0, 0.0_f64);
    for _ in 0..2 + (48.0 * random.next()) as usize {
        let here = Contact::<Model>::indentation(&plane);
        let mut rise = any_size(&mut random, deepest, 10.0);
        if !(-0.1 * deepest..deepest).contains(&(here + rise)) {
            rise = -rise;
        }
        let slip = any_size(&mut random, 10.0 * deepest, 10.0);
        let before = line;
        let way = RatePolynomial::held(rise / STEP);
        plane.set_tangential_rates([angle.cos(), angle.sin()].map(|along| along * slip / STEP));
        plane.step(&way, STEP, || model).expect("within range");
        line.set_tangential_rate(slip / STEP);
        line.step(&way, STEP, || model).expect("within range");
        let ends = [&before, &line].map(|contact| coefficient * contact.normal().force());
        limit = limit.max(ends[0]).max(ends[1]);
        scale = scale.max(coefficient / model.friction.scale() * line.normal().elastic_energy(&model.normal));
        scale = scale.max(limit * slip.abs());
        time += STEP;
        let apart = |[x, y]: [f64; 2], expected: f64| (x - expected * angle.cos()).hypot(y - expected * angle.sin());
        let relative = |error: f64, size: f64| if size > 0.0 { error / size } else { error };
        let now = [
            relative(apart(plane.tangential_forces(&model, 0.0), line.tangential_force(&model)), limit),
            relative(apart(plane.mean_tangential_forces(), line.mean_tangential_force()), limit),
            relative(apart(plane.tangential_impulses(), line.tangential_impulse()), limit * time),
            relative((plane.tangential_energy(&model) - line.tangential_energy(&model)).abs(), scale),
            relative((plane.friction_work(&model) - line.friction_work(&model)).abs(), scale),
        ];
        let slides = [plane.sliding(), line.sliding()].map(|state| state == Sliding::Sliding);
        assert_eq!(slides[0], slides[1], "the whole contact slides, seed {seed}");
        found = std::array::from_fn(|index| found[index].max(now[index]));
    }
    found
}

#[test]
fn along_one_line_two_directions_are_one_direction_whatever_the_history() {
    let mut failed = Vec::new();
    for (name, model) in models() {
        for yield_strength in [300e6, 3e4, 30e9] {
            let pair = Pair { yield_strength, ..model.normal.pair };
            let model = Model { normal: AnyModel { pair, ..model.normal }, ..model };
            let all = (0..long::cases(100)).map(|seed| from_one_direction(&model, seed));
            let worst = all.fold([0.0_f64; 5], |sum, one| std::array::from_fn(|index| sum[index].max(one[index])));
            let text = worst.map(|error| format!("{error:.1e}")).join(", ");
            println!("{name}, {yield_strength:e} Pa: {text}");
            if !worst.iter().all(|error| *error <= 1e-10) {
                failed.push(format!("{name}, {yield_strength:e} Pa: {text}"));
            }
        }
    }
    assert!(failed.is_empty(), "force, mean force, impulse, energy, friction work:\n{}", failed.join("\n"));
}
