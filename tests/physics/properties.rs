//! Properties that hold for every material, sphere, pair of laws and path: random cases, the same in every run, so that a
//! failure is caused by a change. A failure prints its case.

use crate::physics::{self, AnyModel, Random, advance, is_scale_free, loading_force, mild, pressed, some_models, unit};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Body, History, Pair, Surface};
use std::fmt::Debug;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Random cases of each property.
const CASES: usize = 256;

/// Checks random cases; one that fails is printed.
fn check_all<T: Debug>(case: impl Fn(&mut Random) -> T, check: impl Fn(&T)) {
    let mut random = Random(1900);
    for number in 0..CASES {
        let case = case(&mut random);
        if let Err(failure) = catch_unwind(AssertUnwindSafe(|| check(&case))) {
            eprintln!("case {number}: {case:#?}");
            resume_unwind(failure);
        }
    }
}

/// Any model: E from rubber to beyond diamond, S/E from lead to glass, spheres from a grain of powder to a boulder.
fn any_model(random: &mut Random) -> AnyModel {
    let youngs_modulus = random.log_uniform(1e6, 3e12);
    let (strain, radius) = (random.log_uniform(1e-5, 0.1), random.log_uniform(1e-6, 10.0));
    let (poissons_ratio, is_rigid, is_fresh) = (0.5 * random.next(), random.next() < 0.5, random.next() < 0.5);
    let models = some_models(mild());
    let (_, laws) = models[(random.next() * models.len() as f64) as usize];
    let impactor_modulus = if is_rigid { f64::INFINITY } else { 3.0 * youngs_modulus };
    let sphere = Body { radius, youngs_modulus: impactor_modulus, poissons_ratio: 0.3 };
    // these laws depend on the contact radius over R, and hold where it is small
    let strain = if is_scale_free(&laws) { strain } else { strain.min(1e-3) };
    let target = Body { radius: f64::INFINITY, youngs_modulus, poissons_ratio };
    let pair = Pair::new(&sphere, &target, strain * youngs_modulus).expect("a sphere on a plane");
    let surface = if is_fresh { Surface::Fresh } else { Surface::Dented };
    AnyModel { pair, surface, ..laws }
}

/// Turning points in yield indentations, over five decades; one in five is apart.
fn any_turns(random: &mut Random) -> Vec<f64> {
    let count = 1 + (11.0 * random.next()) as usize;
    let mut turn = || if random.next() < 0.2 { -random.log_uniform(0.01, 10.0) } else { random.log_uniform(0.01, 1e3) };
    (0..count).map(|_| turn()).collect()
}

fn any_path(random: &mut Random) -> (AnyModel, Vec<f64>) {
    (any_model(random), any_turns(random))
}

/// Energies that cancel in the results [J]: the work of loading and, for Hertz's lowered curve, Hertz's own.
fn energy_size(model: &AnyModel, largest: f64) -> f64 {
    0.4 * model.pair.hertz_stiffness() * largest.powf(2.5) + loading_force(model, largest) * largest
}

/// Forces that cancel in the results [N], for the same reason.
fn force_size(model: &AnyModel, largest: f64) -> f64 {
    let shift = matches!(model.unloading, AnyUnloading::HertzShift(_));
    let hertz = if shift { model.pair.hertz_stiffness() * largest.powf(1.5) } else { 0.0 };
    hertz.max(loading_force(model, largest))
}

/// Moves through `turns`, and after each part calls `check` with the history before and after it.
fn follow(model: &AnyModel, turns: &[f64], mut check: impl FnMut(&History, &History, f64)) {
    let d_y = unit(&model.pair).indentation;
    let (mut history, mut largest) = (pressed(model, 0.0), 0.0_f64);
    for turn in turns {
        let before = history;
        physics::go(&mut history, model, turn * d_y);
        largest = largest.max(history.indentation());
        check(&before, &history, largest);
    }
}

#[test]
fn a_step_may_be_cut_anywhere() {
    check_all(
        |random| (any_path(random), random.next()),
        |&((ref model, ref turns), cut)| {
            let deepest =
                turns.iter().fold(0.0_f64, |deepest, &turn| deepest.max(turn)) * unit(&model.pair).indentation;
            // within 1e-12 of the largest force, and at the end of Hertz's lowered curve, of the forces that cancel in it
            let force_rounding = 1e-12 * force_size(model, deepest);
            let energy_rounding = 1e-12 * energy_size(model, deepest);
            follow(model, turns, |before, whole, _| {
                let increment = whole.indentation() - before.indentation();
                let mut parts = *before;
                advance(&mut parts, model, cut * increment);
                advance(&mut parts, model, increment - cut * increment);
                let (one, two) = (whole.force(), parts.force());
                assert!((one - two).abs() <= force_rounding, "{one:e} in one step, {two:e} in two");
                let (one, two) = (whole.work(model), parts.work(model));
                assert!((one - two).abs() <= energy_rounding, "{one:e} J in one step, {two:e} J in two");
            });
        },
    );
}

/// Largest indentation [m], restitution and duration [s] of an impact, by leapfrog steps of `1/steps` of `duration`.
fn leapfrog(model: &AnyModel, impact: &Impact, duration: f64, steps: u32) -> (f64, f64, f64) {
    let step = duration / f64::from(steps);
    let mut history = pressed(model, 0.0);
    let (mut speed, mut largest, mut time) = (impact.speed, 0.0_f64, 0.0);
    loop {
        speed -= 0.5 * step * history.force() / impact.mass;
        advance(&mut history, model, step * speed);
        speed -= 0.5 * step * history.force() / impact.mass;
        largest = largest.max(history.indentation());
        time += step;
        if speed < 0.0 && history.force() == 0.0 {
            // the bodies separated within the last step: go back to the residual indentation at the speed of separation
            let passed = (history.residual_indentation(model) - history.indentation()) / -speed;
            return (largest, -speed / impact.speed, time - passed);
        }
    }
}

#[test]
fn predictions_agree_with_a_fine_simulation() {
    for (name, model) in some_models(mild()) {
        for speed in [1e-3, 4e-3, 0.03, 0.2, 2.0] {
            let impact = Impact { mass: physics::MASS, speed };
            let prediction = predict(&model, &impact).expect("an ordinary impact");
            let duration = prediction.contact_time();
            let (largest, restitution, time) = leapfrog(&model, &impact, duration, 20_000);
            // second order: (1/20000)^2 times some tens, and ten times that for the corners of the curves
            let errors = [
                largest / prediction.max_indentation - 1.0,
                restitution - prediction.restitution,
                time / duration - 1.0,
            ];
            for error in errors {
                assert!(error.abs() <= 1e-6, "{name} at {speed} m/s: {errors:?}, {prediction:?}");
            }
        }
    }
}
