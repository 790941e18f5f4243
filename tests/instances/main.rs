//! Instances of one contact, of several, of rate-dependent laws and of known mass, as ordinary values: no export, no C.
//!
//! The same tests run under the address sanitizer, see `tests/c_functions.rs`. Instances of any scene, against its FMU:
//! `tests/exported/differential.rs`.

mod damped_motion;
mod derivatives;
mod extremes;
mod friction;
mod hostile_states;
mod input_derivatives;
mod masters;
mod passivity_guard;
mod stability_warning;
mod states;
mod wiring;

use brinell_contact::losses::{AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_fmu::instance::{Fault, Instance, Phase, Plain};
use brinell_fmu::scene::{Present, Real, Scene};
use brinell_testing::{physics, scenes};
use physics::{all_models, mild};
use scenes::{
    Choice, Chosen, Damped, Elastoplastic, Frictional, FrictionalPlane, Massive, choose, ready, set_rate, words,
};

type One = Chosen<Elastoplastic, 1, Present>;
type Several = Chosen<Elastoplastic, 5, Present>;
type DampedOne = Chosen<Damped, 1, Present>;
type FrictionalOne = Chosen<Frictional, 1, Present>;
type FrictionalSeveral = Chosen<Frictional, 3, Present>;
type RoughPlaneOne = Chosen<FrictionalPlane, 1, Present>;
type RoughPlaneSeveral = Chosen<FrictionalPlane, 3, Present>;
type MassiveOne = Chosen<Massive, 1, Present>;

/// The target of the losses: steel.
const TARGET: Solid = Solid { density: 7850.0, youngs_modulus: 206e9, poissons_ratio: 0.3 };

/// Every loss; a thin plate makes the motion stiff.
const LOSSES: [AnyLoss; 4] = [
    AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.9 }),
    AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target: TARGET }),
    AnyLoss::Plate(Plate { target: TARGET, thickness: 0.01 }),
    AnyLoss::Plate(Plate { target: TARGET, thickness: 1e-3 }),
];

/// Length of the steps [s].
const STEP: f64 = 1e-6;

/// Every pairing of laws on the bodies of the default scene.
fn every_pairing() -> Vec<(String, Choice)> {
    let models = all_models(mild());
    models.into_iter().map(|(name, model)| (name, Choice::of(model.loading, model.unloading))).collect()
}

/// Some pairings: all kinds of branches, and laws without segments.
fn some_pairings() -> Vec<(String, Choice)> {
    let wanted =
        ["big-alabo with contact-radius", "brinell with brinell", "jackson-green with jackson", "luding with luding"];
    every_pairing().into_iter().filter(|(name, _)| wanted.contains(&name.as_str())).collect()
}

/// A ball of 5 mm on a plane, on larger and smaller balls, and in sockets that hardly differ from it.
#[test]
fn a_wide_contact_is_told_at_three_tenths_of_the_smaller_radius_and_refused_at_that_radius() {
    for target in [f64::INFINITY, 2e-2, 1e-3, -1.0, -6e-3, -5.1e-3] {
        for (name, choice) in some_pairings() {
            choose(Choice { target_radius: target, ..choice });
            let effective = choice.radius / (1.0 + choice.radius / target);
            let size = choice.radius.min(target.abs());
            widen::<One>(&name, effective, size);
            widen::<Several>(&name, effective, size);
            widen::<FrictionalOne>(&name, effective, size);
        }
    }
}

/// Presses the first contact in, until it is refused.
fn widen<S: Scene>(name: &str, effective: f64, size: f64) {
    let limit = 0.3 * effective.min(size);
    let width = |instance: &Instance<S>| instance.real((Real::ContactRadius, 0));
    // as an importer does: warnings are taken after each step
    let step = |instance: &mut Instance<S>, by: f64| {
        let time = instance.time();
        let done = instance.do_step(time, by);
        (done, instance.take_deep())
    };
    let mut instance = ready::<S>();
    let mut before = 0.0;
    set_rate(&mut instance, 0, 1.0);
    let told = (0..20_000).any(|_| {
        before = width(&instance);
        let (done, warning) = step(&mut instance, 1e-3 * limit);
        done.unwrap();
        warning.is_some()
    });
    let what = format!("{name} with {size} m: told between {before:e} and {:e} m", width(&instance));
    assert!(told && before < limit && width(&instance) >= limit, "{what}, not at {limit:e} m");
    let depth = instance.real((Real::Indentation, 0));
    let refused = (0..20_000).find_map(|_| {
        let (state, now) = (words(&instance), width(&instance));
        match step(&mut instance, 0.02 * depth) {
            (Ok(()), None) => {
                before = now;
                None
            }
            (Err(fault), None) => Some((state, fault)),
            (_, warning) => panic!("{name} with {size} m: {warning:?} again"),
        }
    });
    let Some((state, fault)) = refused else { panic!("{name} with {size} m: {:e} m is not refused", width(&instance)) };
    assert_eq!(fault, Fault::TooWide { contact: 0, size }, "{name}");
    let what = format!("{name} with {size} m: refused between {before:e} and {:e} m", width(&instance));
    assert!(before < size && width(&instance) >= size * (1.0 - 1e-12), "{what}");
    assert_eq!(words(&instance), state, "{name}: a refused step changes nothing");
    // nor does a copy go on, nor the same state from its words
    let time = instance.time();
    assert_ne!(instance.do_plain_step(time, 1e-9), Plain::Done);
    let mut copy = ready::<S>();
    copy.copy(&instance);
    assert_eq!(step(&mut copy, 1e-9).0, Err(fault), "{name}: a copy");
    let bytes: Vec<_> = state.iter().map(|word| word.to_le_bytes()).collect();
    assert!(copy.load(&bytes), "{name}: a state");
    assert_eq!(step(&mut copy, 1e-9).0, Err(fault), "{name}: from words");
    // a state from before goes on
    copy.copy(&ready::<S>());
    assert_eq!(step(&mut copy, 1e-9), (Ok(()), None), "{name}: another state");
    instance.reset().unwrap();
    assert_eq!(instance.phase(), Phase::Instantiated);
}
