//! Contacts that share bodies: what must hold for any bodies, any laws and any step.

use crate::moved_bodies::{Plain, random_bodies};
use crate::physics::{AnyModel, Random, all_models, has_jumps, loading, model, pair_of, unloading};
use brinell_contact::motion::{self, ExternalLoad};
use brinell_contact::shared::{InverseMasses, NotInverseMasses, Refused, inverse_masses};
use brinell_contact::{History, Surface};

/// The inverse masses of balls in a row.
fn row_of_balls(masses: &[f64]) -> Vec<f64> {
    let count = masses.len() - 1;
    let mut entries = Vec::new();
    for row in 0..count {
        for column in row..count {
            entries.push(match column - row {
                0 => 1.0 / masses[row] + 1.0 / masses[row + 1],
                1 => -1.0 / masses[column],
                _ => 0.0,
            });
        }
    }
    entries
}

/// A contact of two steel balls of 10 mm.
fn steel(loading_name: &str, unloading_name: &str) -> AnyModel {
    let (loading, unloading) = (loading(loading_name), unloading(unloading_name));
    AnyModel { pair: pair_of(5e-3, 1.13e11, 3e8), loading, unloading, surface: Surface::Dented }
}

/// Five balls of 33 g, the first one swift.
fn cradle(law: (&str, &str), gap: f64) -> Plain {
    let gaps = [0.0, gap, gap, gap];
    let rates = vec![1.0, 0.0, 0.0, 0.0];
    Plain::new(vec![steel(law.0, law.1); 4], &gaps, row_of_balls(&[0.033; 5]), vec![0.0; 4], rates)
}

const LAWS: [(&str, &str); 5] = [
    ("hertz", "contact-radius"),
    ("thornton", "thornton"),
    ("brinell", "brinell"),
    ("vu-quoc-zhang", "vu-quoc-zhang"),
    // its force jumps at a corner, so that the place of an event decides more
    ("kogut-etsion", "etsion"),
];

/// Rounding of a motion with one of the [`LAWS`].
fn rounding(model: &AnyModel) -> f64 {
    if has_jumps(model) { 1e-11 } else { 1e-13 }
}

#[test]
fn contacts_that_are_not_coupled_move_as_if_each_were_alone() {
    let mut random = Random(5);
    let models = all_models(pair_of(5e-3, 1.13e11, 3e8));
    for (name, model) in models.into_iter().step_by(3) {
        let rates: Vec<f64> = (0..4).map(|_| random.next() - 0.3).collect();
        // the first and the last one are coupled
        let entries = vec![100.0, 0.0, 0.0, 30.0, 5.0, 0.0, 0.0, 0.3, 0.0, 120.0];
        let accelerations = vec![0.0, 9.81, -3.0, 0.0];
        let mut group = Plain::new(vec![model; 4], &[0.0; 4], entries, accelerations.clone(), rates.clone());
        let mut pair =
            Plain::new(vec![model; 2], &[0.0; 2], vec![100.0, 30.0, 120.0], vec![0.0; 2], vec![rates[0], rates[3]]);
        let mut alone: Vec<History> = group.contacts.clone();
        let mut speeds = rates;
        for _ in 0..5 {
            group.step(1e-4);
            pair.step(1e-4);
            for contact in 1..3 {
                let mass = 1.0 / [0.0, 5.0, 0.3][contact];
                let load = ExternalLoad { mass, acceleration: accelerations[contact] };
                let outcome =
                    motion::follow(&mut alone[contact], &model, &load, speeds[contact], 1e-4).expect("a motion");
                speeds[contact] = outcome.speed;
                assert_eq!(group.rates[contact].to_bits(), outcome.speed.to_bits(), "{name}");
                assert_eq!(group.contacts[contact], alone[contact], "{name}");
            }
            for (contact, other) in [(0, 0), (3, 1)] {
                assert_eq!(group.rates[contact].to_bits(), pair.rates[other].to_bits(), "{name}");
                assert_eq!(group.contacts[contact], pair.contacts[other], "{name}");
            }
        }
    }
}

#[test]
fn a_ball_between_two_walls_is_as_far_from_one_as_it_is_in_the_other() {
    for law in LAWS {
        for step in [1e-2_f64, 1e-4, 1e-6] {
            let entries = vec![30.0, -30.0, 30.0];
            let mut group = Plain::new(vec![steel(law.0, law.1); 2], &[0.0; 2], entries, vec![0.0; 2], vec![1.0, -1.0]);
            for _ in 0..(1e-2 / step).min(1000.0) as u32 {
                group.step(step);
                let depths = group.depths();
                assert!((depths[0] + depths[1]).abs() < 1e-14, "{law:?}, {step:e} s: {depths:?}");
                assert!((group.rates[0] + group.rates[1]).abs() < 1e-12, "{law:?}: {:?}", group.rates);
            }
        }
    }
}

#[test]
fn a_symmetric_arrangement_stays_symmetric() {
    for law in LAWS {
        // a box on four feet that falls flat
        let (mass, inertia) = (0.3, [2e-4, 3e-4]);
        let feet = [(0.03, 0.02), (-0.03, 0.02), (0.03, -0.02), (-0.03, -0.02)];
        let mut entries = Vec::new();
        for (i, one) in feet.iter().enumerate() {
            for other in &feet[i..] {
                entries.push(1.0 / mass + one.0 * other.0 / inertia[1] + one.1 * other.1 / inertia[0]);
            }
        }
        let models = vec![steel(law.0, law.1); 4];
        let small = rounding(&models[0]);
        let mut group = Plain::new(models, &[1e-4; 4], entries, vec![9.81; 4], vec![0.2; 4]);
        for _ in 0..10 {
            group.step(1e-3);
            for contact in 1..4 {
                assert!((group.rates[contact] - group.rates[0]).abs() < 0.2 * small, "{law:?}: {:?}", group.rates);
                let depths = group.depths();
                assert!((depths[contact] - depths[0]).abs() < 1e-4 * small, "{law:?}: {depths:?}");
            }
        }
        // two balls that hit two at rest from both sides
        let mut group = Plain::new(
            vec![steel(law.0, law.1); 3],
            &[0.0, 2e-6, 0.0],
            row_of_balls(&[0.033; 4]),
            vec![0.0; 3],
            vec![0.4, 0.0, 0.4],
        );
        group.step(5e-4);
        assert!((group.rates[0] - group.rates[2]).abs() < small, "{law:?}: {:?}", group.rates);
    }
}

#[test]
fn powers_of_two_in_mass_length_and_time_change_nothing_else() {
    // mass, length, time: force, stiffness and strength follow
    for law in LAWS {
        for (mass, length, time) in [(4.0, 1.0, 1.0), (1.0, 16.0, 1.0), (1.0, 1.0, 0.25), (0.5, 0.25, 4.0)] {
            let mut group = cradle(law, 2e-6);
            let mut scaled = group.clone();
            let pressure = mass / (length * time * time);
            let rescale = |model: &AnyModel| {
                let pair = model.pair;
                let (modulus, strength) = (pressure * pair.modulus, pressure * pair.yield_strength);
                AnyModel { pair: pair_of(length * pair.radius, modulus, strength), ..*model }
            };
            scaled.models = group.models.iter().map(rescale).collect();
            let gaps: Vec<f64> = group.depths().iter().map(|depth| -length * depth).collect();
            let entries = group.entries.iter().map(|entry| entry / mass).collect();
            let rates = group.rates.iter().map(|rate| length / time * rate).collect();
            let mut scaled = Plain::new(scaled.models.clone(), &gaps, entries, vec![0.0; 4], rates);
            group.step(2e-4);
            scaled.step(2e-4 * time);
            let small = 10.0 * rounding(&group.models[0]);
            for contact in 0..4 {
                let rate = scaled.rates[contact] * time / length;
                assert!((rate - group.rates[contact]).abs() < small, "{law:?}: {rate} and {}", group.rates[contact]);
                let depth = scaled.depths()[contact] / length;
                assert!((depth - group.depths()[contact]).abs() < small * 1e-4, "{law:?}: {depth}");
            }
        }
    }
}

#[test]
fn numbers_that_are_no_inverse_masses_are_refused_with_their_contacts() {
    let check = |count: usize, entries: &[f64]| {
        let mut scratch = vec![0.0; entries.len()];
        InverseMasses::new(count, entries)?.check(&mut scratch)
    };
    assert_eq!(check(2, &[1.0, 0.0]), Err(NotInverseMasses::Count { needed: 3, given: 2 }));
    assert_eq!(check(2, &[1.0, 0.5, 0.0]), Err(NotInverseMasses::Entry { row: 1, column: 1, value: 0.0 }));
    assert!(matches!(check(2, &[1.0, f64::NAN, 1.0]), Err(NotInverseMasses::Entry { row: 0, column: 1, .. })));
    assert!(matches!(check(2, &[1.0, 1.01, 1.0]), Err(NotInverseMasses::Indefinite { with: 0 | 1, pivot: ..0.0, .. })));
    let three = [1.0, 0.0, 0.1, 1.0, 1.2, 1.0];
    assert!(matches!(
        check(3, &three),
        Err(NotInverseMasses::Indefinite { contact: 1 | 2, with: 1 | 2, pivot: ..0.0 })
    ));
    // singular: walls, and four feet
    assert_eq!(check(2, &[3.0, -3.0, 3.0]), Ok(()));
    assert_eq!(check(0, &[]), Ok(()));
    assert_eq!(inverse_masses::entries(64), 2080);
    let mut random = Random(3);
    for _ in 0..200 {
        let group = random_bodies(&mut random, 8, 0).group;
        let mut scratch = vec![0.0; group.entries.len()];
        assert_eq!(group.masses().check(&mut scratch), Ok(()));
        // an inverse mass that is too small for the couplings
        let mut entries = group.entries.clone();
        entries[0] *= 0.3;
        let is_coupled = entries[1..8].iter().any(|entry| entry.abs() > 0.0);
        let refused = InverseMasses::new(8, &entries).expect("a triangle").check(&mut scratch);
        if !is_coupled {
            assert_eq!(refused, Ok(()));
        }
    }
}

#[test]
fn a_step_with_too_many_events_is_refused_and_moves_nothing() {
    // a grain between two bodies of 1 kg
    let entries = row_of_balls(&[1.0, 1e-9, 1.0]);
    let models = vec![steel("hertz", "contact-radius"); 2];
    let mut group = Plain::new(models, &[0.0; 2], entries, vec![0.0; 2], vec![0.5, 0.0]);
    let before = group.clone();
    let refused = group.try_step(3e-4).expect_err("too many");
    assert!(matches!(refused, Refused::TooLong { left } if left > 0.0 && left < 3e-4), "{refused:?}");
    assert_eq!(group.contacts, before.contacts);
    assert_eq!(group.rates, before.rates);
    let Refused::TooLong { left } = refused else { unreachable!() };
    group.try_step(0.9 * (3e-4 - left)).expect("a shorter step");
}

#[test]
fn sizes_and_numbers_that_do_not_fit_are_refused() {
    let mut group = cradle(("hertz", "contact-radius"), 0.0);
    let before = group.clone();
    group.rates.pop();
    assert_eq!(group.try_step(1e-4), Err(Refused::Sizes));
    let mut group = before.clone();
    group.rates[2] = f64::NAN;
    assert!(matches!(group.try_step(1e-4), Err(Refused::TooDeep(2, _))));
    assert_eq!(group.contacts, before.contacts);
}

#[test]
fn a_body_at_rest_stays_at_rest() {
    // three balls in a row that touch
    let mut group = Plain::new(
        vec![model("hertz", "contact-radius"); 2],
        &[0.0; 2],
        row_of_balls(&[0.033; 3]),
        vec![0.0; 2],
        vec![0.0; 2],
    );
    for _ in 0..100 {
        group.step(1e-3);
    }
    assert_eq!((group.rates.clone(), group.depths()), (vec![0.0; 2], vec![0.0; 2]));
    assert!(group.evaluations < 100 * 2 * 30, "{}", group.evaluations);
}
