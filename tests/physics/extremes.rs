//! Steps over the whole range of numbers end in numbers, with the right energy. They raise no floating-point exception except inexact and
//! underflow: a host may trap the others.

use crate::moved_bodies::{Losing, as_rollers, random_bodies, with_any_loss};
use crate::physics::{AnyModel, Random, all_models, pair_of};
use brinell_contact::history::momentum::impulse;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::motion::{ExternalLoad, MOST_EVALUATIONS, NoMotion, Outcome, follow};
use brinell_contact::shared::{self, InverseMasses, SharedContact, Work};
use brinell_contact::{Contact, History, Model, Surface, loading, unloading};
#[cfg(target_arch = "x86_64")]
use brinell_testing::arithmetic::{control, set_control};
use std::fmt::Debug;

/// Invalid operation, division by zero and overflow, as bits of the control and status register.
#[cfg(target_arch = "x86_64")]
const TRAPPED: u32 = 0b1101;

/// The result of `step`, and the exceptions of `TRAPPED` that it raised; on other processors none are seen.
#[cfg(not(target_arch = "x86_64"))]
fn raised<T>(step: impl FnOnce() -> T) -> (T, u32) {
    (step(), 0)
}

/// The same.
#[cfg(target_arch = "x86_64")]
fn raised<T>(step: impl FnOnce() -> T) -> (T, u32) {
    set_control(control() & !0b11_1111);
    // prevents any earlier computation
    let step = std::hint::black_box(step);
    let result = std::hint::black_box(step());
    (result, control() & TRAPPED)
}

/// A log-uniform number from `low` to `high` of either sign, or zero, or the smallest number.
fn signed(random: &mut Random, low: f64, high: f64) -> f64 {
    let number = (low.ln() + (high.ln() - low.ln()) * random.next()).exp();
    let sign = if random.next() < 0.5 { 1.0 } else { -1.0 };
    match random.next() {
        0.0..0.2 => 0.0,
        0.2..0.25 => sign * f64::from_bits(1),
        _ => sign * number,
    }
}

/// A contact with any two laws on any surface, at any indentation.
fn contact(random: &mut Random, models: &[(String, AnyModel)]) -> Option<(String, AnyModel, History)> {
    let (name, model) = &models[(random.next() * models.len() as f64) as usize];
    let surface = if random.next() < 0.5 { Surface::Dented } else { Surface::Fresh };
    let model = AnyModel { surface, ..*model };
    let mut history = History::start(&model, signed(random, 1e-20, 1e-4)).ok()?;
    history.advance(&model, -random.next() * history.indentation()).ok()?;
    Some((format!("{name} on a {surface:?} surface"), model, history))
}

#[cfg(target_arch = "x86_64")]
#[test]
fn the_flags_are_seen() {
    let zero = std::hint::black_box(0.0);
    assert_eq!(raised(|| 1.0 / zero).1, 0b100);
    assert_eq!(raised(|| zero / zero).1, 0b1);
    assert_eq!(raised(|| std::hint::black_box(f64::MAX) * 2.0).1, 0b1000);
    assert_eq!(raised(|| std::hint::black_box(1e-200) * 1e-200 + 0.1).1, 0);
}

struct Step {
    model: AnyModel,
    name: String,
    load: ExternalLoad,
    speed: f64,
    time: f64,
}

/// A step of bodies of any size and speed, and the initial contact.
fn draw(random: &mut Random, models: &[(String, AnyModel)]) -> Option<(Step, History)> {
    let (name, model) = &models[(random.next() * models.len() as f64) as usize];
    let surface = if random.next() < 0.5 { Surface::Dented } else { Surface::Fresh };
    let modulus = random.log_uniform(1e8, 1e12);
    let pair = pair_of(random.log_uniform(1e-4, 1.0), modulus, modulus / random.log_uniform(50.0, 1000.0));
    let model = AnyModel { pair, surface, ..*model };
    let mass = random.log_uniform(1e-12, 1e6);
    let mut history = History::start(&model, signed(random, 1e-20, 1e-3)).ok()?;
    history.advance(&model, -random.next() * history.indentation()).ok()?;
    let acceleration = match random.next() {
        0.0..0.2 => history.force() / mass,
        0.2..0.6 => signed(random, 1e-30, 1e30),
        _ => signed(random, 1e-3, 1e3),
    };
    let speed = if random.next() < 0.5 { signed(random, 1e-160, 1e3) } else { signed(random, 1e-9, 1e3) };
    let time = random.log_uniform(1e-18, 1e3);
    let step = Step { model, name: name.clone(), load: ExternalLoad { mass, acceleration }, speed, time };
    Some((step, history))
}

fn describe(step: &Step, before: &History, result: &Result<Outcome, NoMotion>) -> String {
    let Step { model, name, load, speed, time } = step;
    let (from, largest) = (before.indentation(), before.max_indentation());
    format!(
        "{name} on a {:?} surface, {:?}, {load:?}, at {speed:e} m/s for {time:e} s from {from:e} m (at most {largest:e}): {result:?}",
        model.surface, model.pair
    )
}

/// Kinetic energy, potential energy of the acceleration, and energy of the contact [J]; and the size of the largest of them.
fn energy(step: &Step, history: &History, speed: f64) -> (f64, f64) {
    let ExternalLoad { mass, acceleration } = step.load;
    let parts = [
        0.5 * mass * speed * speed,
        -mass * acceleration * history.indentation(),
        history.elastic_energy(&step.model),
        history.dissipated_energy(&step.model),
    ];
    (parts.iter().sum(), parts.iter().fold(0.0, |size: f64, part| size.max(part.abs())))
}

#[test]
fn a_step_of_any_size_ends_in_numbers_keeps_the_energy_and_raises_no_exception() {
    let models = all_models(pair_of(0.005, 2e11, 1e9));
    let mut random = Random(5);
    let (mut steps, mut refused) = (0, 0);
    while steps < 20_000 {
        let Some((mut step, mut history)) = draw(&mut random, &models) else { continue };
        for _ in 0..3 {
            let before = history;
            let (result, flags) = raised(|| follow(&mut history, &step.model, &step.load, step.speed, step.time));
            let what = describe(&step, &before, &result);
            steps += 1;
            let outcome = match result {
                Ok(outcome) => outcome,
                Err(NoMotion::TooLong) => {
                    refused += 1;
                    break;
                }
                Err(NoMotion::TooDeep(_)) => panic!("{what}"),
            };
            let numbers =
                [outcome.speed, outcome.speed_removed, outcome.deepest, history.indentation(), history.force()];
            assert!(flags == 0 && numbers.iter().all(|number| number.is_finite()), "{flags:b}: {what}");
            assert!(outcome.speed_removed >= 0.0 && outcome.deepest >= history.max_indentation(), "{what}");
            assert!(outcome.evaluations <= MOST_EVALUATIONS, "{what}");
            let (was, size) = energy(&step, &before, step.speed);
            let (is, other) = energy(&step, &history, outcome.speed);
            let fallen = step.load.mass * step.load.acceleration.abs() * outcome.deepest;
            let size = size.max(other).max(fallen);
            // some laws do not compute their own work more accurately at larger depths, and smaller numbers have fewer digits
            if outcome.deepest < step.model.pair.radius && size > 1e-280 {
                assert!((is - was).abs() < 1e-11 * size, "off by {:e} of {size:e} J: {what}", is - was);
            }
            step.speed = outcome.speed;
        }
    }
    assert!(refused < steps / 500, "{refused} of {steps} steps refused");
}

/// Moves `contacts` that share bodies twice, and returns the number of successful steps. None may raise an exception.
fn shared_steps<M: Debug, C: SharedContact<M> + Debug>(
    random: &mut Random,
    models: &[M],
    mut contacts: Vec<C>,
    entries: &[f64],
    mut rates: Vec<f64>,
) -> u32 {
    for rate in &mut rates {
        *rate *= match random.next() {
            0.0..0.1 => 0.0,
            0.1..0.2 => 1e-160,
            0.2..0.3 => 1e-9,
            _ => 1.0,
        };
    }
    let accelerations: Vec<f64> = rates.iter().map(|_| signed(random, 1e-6, 1e6)).collect();
    let step = signed(random, 1e-9, 1e-3).abs().max(1e-9);
    let masses = InverseMasses::new(models.len(), entries).expect("a triangle");
    let mut work: Vec<_> = contacts.iter().map(|&contact| Work::new(contact)).collect();
    let mut done = 0;
    for _ in 0..2 {
        let model = |contact: usize| &models[contact];
        let before = format!("{contacts:?} {rates:?} {accelerations:?} {step:e} s");
        let (result, flags) =
            raised(|| shared::follow(&mut contacts, model, &masses, &accelerations, &mut rates, &mut work, step));
        assert_eq!(flags, 0, "{before} of {models:?}: {result:?}");
        done += u32::from(result.is_ok());
    }
    done
}

#[test]
fn no_motion_of_shared_bodies_raises_an_exception() {
    let mut random = Random(17);
    let mut done = 0;
    for index in 0..2_000 {
        let group = random_bodies(&mut random, 2 + index % 5, 0).group;
        let group = if index % 4 == 3 { as_rollers(group) } else { group };
        done += shared_steps(&mut random, &group.models, group.contacts, &group.entries, group.rates);
        let group = random_bodies(&mut random, 1 + index % 5, 0).group;
        let group: Losing = group.with_models(|model| with_any_loss(&mut random, model));
        done += shared_steps(&mut random, &group.models, group.contacts, &group.entries, group.rates);
    }
    println!("{done} of 8000 steps");
    assert!(done > 7_000, "{done}");
}

/// A course of any size, and the length of its step [s].
fn any_course(random: &mut Random) -> (RatePolynomial, f64) {
    let step = signed(random, 1e-18, 1e3).abs().max(1e-18);
    let size = signed(random, 1e-30, 1e-4).abs();
    let mut derivative = |order: i32| {
        let number = if random.next() < 0.3 { signed(random, 1e-300, 1e-4) } else { size * (random.next() - 0.5) };
        number / step.powi(order)
    };
    (RatePolynomial { rate: derivative(1), slope: derivative(2), bend: derivative(3) }, step)
}

#[test]
fn no_step_along_a_course_raises_an_exception() {
    let models = all_models(pair_of(0.005, 2e11, 3e8));
    let mut random = Random(4);
    for _ in 0..30_000 {
        let Some((name, model, mut history)) = contact(&mut random, &models) else { continue };
        let (course, step) = any_course(&mut random);
        let (result, flags) = raised(|| impulse(&history, &model, &course, step));
        let what = format!("{name}, {course:?} for {step:e} s from {} m", history.indentation());
        if result.is_ok() {
            assert_eq!(flags, 0, "impulse by {what}");
        }
        let before = history;
        let (result, flags) = raised(|| history.step(&course, step, || model));
        if result.is_ok() {
            assert_eq!(flags, 0, "step by {what} ({} m)", before.max_indentation());
        }
    }
}

/// Along the branches of a law known at compile time, which uses other code than the models above.
#[test]
fn no_mean_force_along_branches_raises_an_exception() {
    let model = Model {
        pair: pair_of(0.005, 2e11, 3e8),
        loading: loading::Brinell::REFERENCE,
        unloading: unloading::Brinell::REFERENCE,
        surface: Surface::Dented,
    };
    let mut random = Random(6);
    for _ in 0..30_000 {
        let Ok(mut history) = History::start(&model, -signed(&mut random, 1e-30, 1e-3)) else { continue };
        for _ in 0..4 {
            let (course, step) = any_course(&mut random);
            let from = history.indentation();
            let (result, flags) = raised(|| history.step_with_mean_force(&course, step, || &model));
            assert!(result.is_err() || flags == 0, "{course:?} for {step:e} s from {from} m: {result:?}");
        }
    }
}
