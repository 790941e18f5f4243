//! A contact that knows the mass reaches the same state, however the time is divided into steps.

use crate::physics::{AnyModel, Random, all_models, pair_of};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::motion::{ExternalLoad, follow};
use brinell_contact::{History, Surface};

/// A motion to be divided into steps.
#[derive(Debug)]
struct Case {
    model: AnyModel,
    load: ExternalLoad,
    gap: f64,
    speed: f64,
    time: f64,
}

/// Its final state.
#[derive(Clone, Copy, Debug)]
struct State {
    speed: f64,
    indentation: f64,
    max_indentation: f64,
    dissipated: f64,
    force: f64,
    taken: f64,
    turns: u32,
}

/// A body that touches a fresh surface or an earlier dent is driven there or pulled away, and touches it up to five times.
fn draw(random: &mut Random, models: &[(String, AnyModel)]) -> Option<Case> {
    let (_, model) = &models[(random.next() * models.len() as f64) as usize];
    let surface = if random.next() < 0.5 { Surface::Dented } else { Surface::Fresh };
    let modulus = random.log_uniform(1e8, 1e12);
    let pair = pair_of(random.log_uniform(1e-4, 1.0), modulus, modulus / random.log_uniform(50.0, 1000.0));
    let model = AnyModel { pair, surface, ..*model };
    let mass = random.log_uniform(1e-9, 1e3);
    let yields = pair.yield_point(1.1);
    let yield_speed = (0.8 * yields.force * yields.indentation / mass).sqrt();
    let speed = yield_speed * random.log_uniform(0.05, 30.0);
    let prediction = predict(&model, &Impact { mass, speed })?;
    let sign = if random.next() < 0.5 { 1.0 } else { -1.0 };
    // from negligible beside the contact to so strong that the bodies cannot separate
    let contact = prediction.contact_time();
    let acceleration = sign * speed / contact * random.log_uniform(1e-6, 1e3);
    let flights = if sign > 0.0 { 2.0 * speed / acceleration } else { 0.0 };
    let time = contact * 2.0 * random.next() + flights * 4.0 * random.next().powi(3);
    let gap = if random.next() < 0.5 { 0.0 } else { -prediction.max_indentation * (random.next() - 0.5) };
    Some(Case { model, load: ExternalLoad { mass, acceleration }, gap, speed, time })
}

/// The state after all of the steps.
fn run(case: &Case, steps: &[f64]) -> State {
    let Case { model, load, .. } = case;
    let mut history = History::start(model, case.gap).expect("within range");
    let (mut speed, mut max_indentation, mut taken, mut turns) = (case.speed, 0.0, 0.0, 0);
    for &step in steps {
        let outcome = follow(&mut history, model, load, speed, step)
            .unwrap_or_else(|fault| panic!("{case:?} in {} steps: {fault:?}", steps.len()));
        turns += u32::from(speed > 0.0 && outcome.speed <= 0.0);
        speed = outcome.speed;
        taken += outcome.speed_removed;
        max_indentation = outcome.deepest.max(max_indentation);
    }
    let dissipated = history.dissipated_energy(model);
    State {
        speed,
        indentation: history.indentation(),
        max_indentation,
        dissipated,
        force: history.force(),
        taken,
        turns,
    }
}

/// `time` [s] in `count` steps, equal or of any length.
fn cut(random: &mut Random, time: f64, count: usize) -> Vec<f64> {
    if random.next() < 0.5 {
        return vec![time / count as f64; count];
    }
    let parts: Vec<f64> = (0..count).map(|_| random.log_uniform(1e-3, 1.0)).collect();
    let sum: f64 = parts.iter().sum();
    parts.iter().map(|part| time * part / sum).collect()
}

/// The difference of two states, relative to the initial energy or to that from the other forces.
fn difference(case: &Case, one: &State, other: &State) -> f64 {
    let ExternalLoad { mass, acceleration } = case.load;
    let start = History::start(&case.model, case.gap).unwrap();
    let kinetic = |speed: f64| 0.5 * mass * speed * speed;
    let work = mass * acceleration.abs() * (one.indentation.abs() + one.max_indentation);
    let energy = [kinetic(case.speed) + start.elastic_energy(&case.model), kinetic(one.speed), work]
        .into_iter()
        .fold(0.0, f64::max);
    let peak = History::start(&case.model, -one.max_indentation).unwrap().force();
    let by_speed = (kinetic(one.speed) - kinetic(other.speed)).abs();
    let by_way = (mass * acceleration.abs() + one.force) * (one.indentation - other.indentation).abs();
    let by_depth = peak * (one.max_indentation - other.max_indentation).abs();
    let by_loss = (one.dissipated - other.dissipated).abs();
    let impulse = mass * (one.taken - other.taken).abs() / one.taken.max(case.speed) * case.speed * case.speed;
    [by_speed, by_way, by_depth, by_loss, impulse].into_iter().fold(0.0, f64::max) / energy
}

#[test]
fn a_step_is_the_sum_of_its_parts_whatever_pulls_the_bodies() {
    let models = all_models(pair_of(0.005, 2e11, 1e9));
    let mut random = Random(11);
    let (mut cases, mut turns) = (0, [0; 6]);
    while cases < 500 {
        let Some(case) = draw(&mut random, &models) else { continue };
        let whole = run(&case, &[case.time]);
        let count = random.log_uniform(2.0, 1001.0) as usize;
        let steps = cut(&mut random, case.time, count);
        let parts = run(&case, &steps);
        // the rounding errors of many impacts add up
        let Some(seen) = turns.get_mut(parts.turns as usize) else { continue };
        *seen += 1;
        let off = difference(&case, &whole, &parts);
        assert!(off < 1e-11, "{case:?} in {count} steps is off by {off:e}: {whole:?} in one, {parts:?}");
        cases += 1;
    }
    assert!(turns.iter().all(|&seen| seen > 0), "cases by their impacts: {turns:?}");
}

/// A body that touches at a speed far below what its acceleration gives it afterwards is where one is that touches at rest, a
/// little earlier: near the surface, the contact force is negligible.
#[test]
fn a_touch_that_is_slow_beside_the_motion_after_it_is_as_exact_as_any() {
    // a line contact is so stiff that the body has turned many times by then
    let of_balls = |(_, model): &(String, AnyModel)| !model.loading.is_line();
    for (name, model) in all_models(pair_of(0.005, 2e11, 4e8)).into_iter().filter(of_balls) {
        let yields = model.pair.yield_point(1.1);
        let mass = 1.0;
        // the body stays in the elastic range of the laws that have one
        let acceleration = 0.05 * yields.force / mass;
        let scale = (0.1 * yields.indentation / acceleration).sqrt();
        for time in [0.1 * scale, 0.3 * scale, scale] {
            for part in [1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12, 1e-14] {
                let speed = part * acceleration * time;
                let end = |speed: f64, time: f64| {
                    let mut history = History::start(&model, 0.0).expect("within range");
                    let outcome = follow(&mut history, &model, &ExternalLoad { mass, acceleration }, speed, time);
                    (history.indentation(), outcome.expect("within range").speed)
                };
                let (slow, rest) = (end(speed, time), end(0.0, time + speed / acceleration));
                let largest = acceleration * time;
                let off = ((slow.0 - rest.0) / rest.0).abs().max((slow.1 - rest.1).abs() / largest);
                assert!(off < 1e-12 + part * part, "{name}: {off:e} after {time:e} s from {part:e} of the speed");
            }
        }
    }
}
