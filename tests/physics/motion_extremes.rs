//! A contact that knows the mass, over the whole range of numbers: every step ends with finite results and the right energy.

use crate::physics::{AnyModel, Random, all_models, pair_of};
use brinell_contact::motion::{ExternalLoad, MOST_EVALUATIONS, NoMotion, Outcome, follow};
use brinell_contact::{History, Surface};

/// Log-uniform, or zero, or the smallest number, of either sign.
fn signed(random: &mut Random, low: f64, high: f64) -> f64 {
    let number = random.log_uniform(low, high);
    let sign = if random.next() < 0.5 { 1.0 } else { -1.0 };
    match random.next() {
        0.0..0.15 => 0.0,
        0.15..0.2 => sign * f64::from_bits(1),
        _ => sign * number,
    }
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
    let history = History::start(&model, signed(random, 1e-20, 1e-3)).ok()?;
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
fn a_step_of_any_size_ends_in_numbers_and_keeps_the_energy() {
    let models = all_models(pair_of(0.005, 2e11, 1e9));
    let mut random = Random(5);
    let (mut steps, mut refused) = (0, 0);
    while steps < 20_000 {
        let Some((mut step, mut history)) = draw(&mut random, &models) else { continue };
        for _ in 0..3 {
            let before = history;
            let result = follow(&mut history, &step.model, &step.load, step.speed, step.time);
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
            assert!(numbers.iter().all(|number| number.is_finite()), "{what}");
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
