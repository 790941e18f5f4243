//! A unit tells of a master whose steps are unstable, and of no other.

#[path = "support/masters.rs"]
mod masters;
#[path = "support/physics.rs"]
mod physics;
#[path = "support/scenes.rs"]
mod scenes;

use brinell::contact::Surface;
use brinell::contact::impact::{Impact, predict};
use brinell::instance::Warning;
use brinell::scene::{Absent, Present, Real, Scene};
use masters::{MASS, choice};
use physics::{AnyModel, Random, all_models, mild};
use scenes::{Chosen, Elastoplastic, choose, ready, set_rate};

type One = Chosen<Elastoplastic, 1, Absent>;
type WithMomentum = Chosen<Elastoplastic, 1, Present>;
type Several = Chosen<Elastoplastic, 3, Absent>;

/// The largest stable step where an impact at 1 m/s is deepest [s].
fn stable_step(model: &AnyModel) -> f64 {
    let deepest = predict(model, &Impact { mass: MASS, speed: 1.0 }).unwrap().max_indentation;
    2.0 * (MASS / model.unloading_segment(deepest, deepest).stiffness(deepest)).sqrt()
}

/// The warning of unstable steps that a mass raises which the contact's force moves, and how fast it has become.
fn coupled<S: Scene>(model: &AnyModel, step: f64, count: usize) -> (Option<Warning>, f64) {
    // a touch leaves the branch of a flight
    choose(choice(model, Surface::Dented, 0.3 * step));
    let mut instance = ready::<S>();
    let contact = S::CONTACTS - 1;
    let (mut speed, mut told, mut fastest) = (1.0, None, 0.0f64);
    for _ in 0..count {
        set_rate(&mut instance, contact, speed);
        let time = instance.time();
        if instance.do_step(time, step).is_err() {
            break;
        }
        told = told.or(instance.take_deep().filter(|warning| matches!(warning, Warning::Unstable { .. })));
        speed -= step * instance.real((Real::Force, contact)) / MASS;
        fastest = fastest.max(speed.abs());
    }
    (told, fastest)
}

#[test]
fn a_mass_in_steps_that_are_too_long_is_told_and_one_in_shorter_steps_is_not() {
    for (name, model) in all_models(mild()) {
        let stable = stable_step(&model);
        for factor in [15.0, 40.0, 150.0] {
            for (told, fastest) in [
                coupled::<One>(&model, factor * stable, 30),
                coupled::<WithMomentum>(&model, factor * stable, 30),
                coupled::<Several>(&model, factor * stable, 30),
            ] {
                assert!(fastest > 1.0, "{name}, {factor} stable steps: not unstable at all");
                let step = factor * stable;
                assert_eq!(told, Some(Warning::Unstable { step, mass: MASS }), "{name}, {factor} stable steps");
            }
        }
        for factor in [1e-2, 0.1, 0.3] {
            let count = (20.0 / factor) as usize;
            let (told, _) = coupled::<One>(&model, factor * stable, count);
            assert_eq!(told, None, "{name}, {factor} stable steps");
        }
    }
}

#[test]
fn a_motion_that_is_prescribed_is_never_warned_of() {
    let mut random = Random(29);
    for (name, model) in all_models(mild()) {
        let stable = stable_step(&model);
        for factor in [1.0, 10.0, 1e3, 1e5] {
            let step = factor * stable;
            // in and out, by some micrometres: held rates, ramps, waves and anything
            let motions: [&mut dyn FnMut(usize) -> f64; 4] = [
                &mut |count| if count % 10 < 5 { 2e-6 } else { -2e-6 },
                &mut |count| 1e-7 * (count % 40) as f64 - 2e-6,
                &mut |count| 3e-6 * f64::cos(0.3 * count as f64),
                &mut |_| 6e-6 * random.next() - 3e-6,
            ];
            for (kind, motion) in motions.into_iter().enumerate() {
                choose(choice(&model, Surface::Dented, 0.0));
                let mut instance = ready::<One>();
                for count in 0..300 {
                    set_rate(&mut instance, 0, motion(count) / step);
                    let time = instance.time();
                    instance.do_step(time, step).unwrap();
                    let told = instance.take_deep().filter(|warning| matches!(warning, Warning::Unstable { .. }));
                    assert_eq!(told, None, "{name}, motion {kind}, {factor} stable steps, step {count}");
                }
            }
        }
    }
}
