//! A body of known mass under a contact with a loss reaches the same state, however the time is divided into steps.

use crate::physics::{AnyModel, Random, all_models, pair_of};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::losses::{
    AnyLoss, HalfSpaceRadiation, History, Model, Plate, RestitutionFitted, Solid, follow, impact,
};
use brinell_contact::motion::ExternalLoad;
use brinell_contact::{Contact, Loading, Surface};
use brinell_testing::long::some;

type Lossy = Model<brinell_contact::loading::AnyLoading, brinell_contact::unloading::AnyUnloading, AnyLoss>;

/// A motion to be divided into steps.
#[derive(Debug)]
struct Case {
    name: String,
    model: Lossy,
    load: ExternalLoad,
    gap: f64,
    speed: f64,
    time: f64,
}

/// Its final state: energies \[J\] and the indentation \[m\].
#[derive(Clone, Copy, Debug)]
struct State {
    kinetic: f64,
    dissipated: f64,
    elastic: f64,
    indentation: f64,
    /// Energy that the bodies had or got \[J\].
    energy: f64,
}

/// A loss of this kind on the bodies of `plastic`, which takes a noticeable part of the energy.
fn draw_loss(random: &mut Random, plastic: &AnyModel, kind: usize, impact: &Impact) -> AnyLoss {
    let pair = plastic.pair;
    // density for a speed of waves that is far above that of the impact
    let wave_speed = impact.speed * random.log_uniform(50.0, 1e4);
    let density = pair.youngs_modulus / (wave_speed * wave_speed);
    let target = Solid { density, youngs_modulus: pair.youngs_modulus, poissons_ratio: pair.poissons_ratio };
    match kind {
        0 => AnyLoss::RestitutionFitted(RestitutionFitted {
            restitution: [0.3, 0.7, 0.9, 0.98][(random.next() * 4.0) as usize],
        }),
        1 => AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target }),
        _ => {
            let depth = predict(plastic, impact).map_or(pair.radius, |found| found.max_indentation);
            let thickness = (depth * pair.radius).sqrt() * random.log_uniform(0.5, 30.0);
            AnyLoss::Plate(Plate { target, thickness })
        }
    }
}

/// A body that touches a fresh surface or an earlier dent and is pressed there or pulled away, and may touch it again.
fn draw(random: &mut Random, (name, model): &(String, AnyModel), kind: usize) -> Option<Case> {
    let surface = if random.next() < 0.5 { Surface::Dented } else { Surface::Fresh };
    let modulus = random.log_uniform(1e9, 1e12);
    let pair = pair_of(random.log_uniform(1e-4, 1.0), modulus, modulus / random.log_uniform(50.0, 1000.0));
    let plastic = AnyModel { pair, surface, ..*model };
    let mass = random.log_uniform(1e-9, 1e3);
    let yields = pair.yield_point(1.1);
    let yield_speed = (0.8 * yields.force * yields.indentation / mass).sqrt();
    let speed = yield_speed * random.log_uniform(0.05, 30.0);
    let impact = Impact { mass, speed };
    let prediction = predict(&plastic, &impact)?;
    let sign = if random.next() < 0.6 { 1.0 } else { -1.0 };
    // from negligible beside the contact to so strong that the bodies cannot separate
    let contact = prediction.contact_time();
    let acceleration = sign * speed / contact * random.log_uniform(1e-4, 1e2);
    let time = contact * 3.0 * random.next();
    let gap = if random.next() < 0.5 { 0.0 } else { -prediction.max_indentation * (random.next() - 0.5) };
    let loss = draw_loss(random, &plastic, kind, &impact);
    let model = Lossy { plastic, loss };
    Some(Case { name: name.clone(), model, load: ExternalLoad { mass, acceleration }, gap, speed, time })
}

/// The state after `parts` steps; `None` beyond the range of the law.
fn run(case: &Case, parts: u32) -> Option<State> {
    let Case { model, load, .. } = case;
    let mut history = History::start(model, case.gap).ok()?;
    let mut speed = case.speed;
    for _ in 0..parts {
        let outcome = follow(&mut history, model, load, speed, case.time / f64::from(parts)).ok()?;
        speed = outcome.speed;
    }
    let kinetic = 0.5 * load.mass * speed * speed;
    let dissipated = history.dissipated_energy(model);
    let elastic = history.elastic_energy(model);
    let energy = (0.5 * load.mass * case.speed * case.speed).max(kinetic + dissipated + elastic);
    Some(State { kinetic, dissipated, elastic, indentation: history.plastic().indentation(), energy })
}

/// The largest difference, relative to the energy.
fn difference(one: &State, other: &State) -> f64 {
    let energies = [one.kinetic - other.kinetic, one.dissipated - other.dissipated, one.elastic - other.elastic];
    energies.into_iter().fold(0.0, |worst: f64, change| worst.max(change.abs())) / one.energy
}

#[test]
fn a_step_is_the_sum_of_its_parts_whatever_pulls_the_bodies_and_wherever_the_force_has_a_kink() {
    let mut random = Random(77);
    let (mut worst, mut cases) = ([0.0f64; 3], 0);
    for _ in 0..rounds() {
        for model in all_models(crate::physics::mild()) {
            for (kind, worst) in worst.iter_mut().enumerate() {
                let Some(case) = draw(&mut random, &model, kind) else { continue };
                let Some(whole) = run(&case, 1) else { continue };
                // a law without segments takes its time
                let counts: &[u32] = if model.1.loading.is_segmented() { &[2, 7, 100, 1000] } else { &[3, 50] };
                for &parts in counts {
                    let other = run(&case, parts).unwrap_or_else(|| panic!("{case:?} fails in {parts} steps"));
                    let off = difference(&whole, &other);
                    if off > *worst {
                        println!("{off:.1e} in {parts}: {} {:?}", case.name, case.model.loss);
                    }
                    *worst = worst.max(off);
                    assert!(off < 2e-9, "{case:?} in {parts} steps is off by {off:e}: {whole:?} in one, {other:?}");
                }
                // nothing is lost between the accounts
                let start = History::start(&case.model, case.gap).unwrap();
                let given = 0.5 * case.load.mass * case.speed * case.speed + start.elastic_energy(&case.model);
                let closer = whole.indentation + case.gap;
                let balance = given + case.load.mass * case.load.acceleration * closer
                    - (whole.kinetic + whole.elastic + whole.dissipated - start.dissipated_energy(&case.model));
                // a plate moves, too
                assert!(
                    kind == 2 || balance.abs() < 1e-9 * whole.energy,
                    "{case:?}: {balance:e} of {:e} J",
                    whole.energy
                );
                cases += 1;
            }
        }
    }
    println!("{cases} cases, worst {worst:?}");
    assert!(cases > 100);
}

#[test]
fn the_contact_time_of_a_prediction_is_that_of_the_force() {
    const STEPS: u32 = 400;
    let (mut random, mut cases) = (Random(4407), 0);
    for model in some(all_models(crate::physics::mild()), 3) {
        for kind in 0..3 {
            let Some(case) = draw(&mut random, &model, kind) else { continue };
            let found = impact::predict(&case.model, &Impact { mass: case.load.mass, speed: case.speed });
            let Some(found) = found else { continue };
            // in a target that gives way easily the force fades out
            let (expected, least) = (found.contact_time(), 1e-12 * found.max_force);
            let mut history = History::start(&case.model, 0.0).expect("a touch");
            let (load, mut speed) = (ExternalLoad { acceleration: 0.0, ..case.load }, case.speed);
            // to a quarter beyond, so that a force that lasts longer is seen
            let step = expected / f64::from(STEPS);
            let mut last = 0;
            for number in 1..=STEPS + STEPS / 4 {
                speed = follow(&mut history, &case.model, &load, speed, step).expect("within range").speed;
                last = if history.force(speed) > least { number } else { last };
            }
            assert!(STEPS.abs_diff(last) <= 1, "{case:?}: the force ends after {last} of {STEPS} steps");
            cases += 1;
        }
    }
    assert!(cases > 50, "only {cases} cases");
}

#[test]
fn bodies_that_leave_a_surface_that_lags_behind_them_may_come_back_within_the_same_step() {
    let mut cases = 0;
    for (name, plastic) in all_models(crate::physics::mild()) {
        let yields = plastic.pair.yield_point(1.1);
        let (mass, depth) = (1.0, 0.1 * yields.indentation);
        for (restitution, slowness) in [(0.3, 1.0), (0.3, 100.0), (0.6, 1.0)] {
            let speed = -(yields.force * yields.indentation / mass).sqrt() / slowness;
            // up to three yield indentations, down again, and a tenth of that longer
            let acceleration = speed * speed / (6.0 * yields.indentation);
            let model = Lossy { plastic, loss: AnyLoss::RestitutionFitted(RestitutionFitted { restitution }) };
            let load = ExternalLoad { mass, acceleration };
            let time = -2.2 * speed / acceleration;
            let case = Case { name: name.clone(), model, load, gap: -depth, speed, time };
            let [whole, parts] =
                [1, 100].map(|parts| run(&case, parts).unwrap_or_else(|| panic!("{case:?} fails in {parts} steps")));
            let off = difference(&whole, &parts);
            assert!(off < 2e-9, "{case:?} in 100 steps is off by {off:e}: {whole:?} in one, {parts:?}");
            let start = History::start(&case.model, case.gap).expect("within range");
            let given = 0.5 * mass * speed * speed + start.elastic_energy(&case.model);
            let balance = given + mass * acceleration * (whole.indentation + case.gap)
                - (whole.kinetic + whole.elastic + whole.dissipated - start.dissipated_energy(&case.model));
            assert!(balance.abs() < 1e-9 * whole.energy, "{case:?}: {balance:e} of {:e} J", whole.energy);
            cases += 1;
        }
    }
    assert!(cases > 50, "only {cases} cases");
}

#[test]
fn bodies_that_are_pulled_back_hard_feel_the_whole_law_on_their_way() {
    let mut cases = 0;
    for (name, plastic) in all_models(crate::physics::mild()) {
        let yields = plastic.pair.yield_point(1.1);
        // the force at yield is far below the pull, as the change of speed by it is below the error of the integration
        let (speed, depth) = (1.0, 2000.0 * yields.indentation);
        let acceleration = -speed * speed / (2.0 * depth);
        let mass = 1e11 * yields.force / -acceleration;
        let loss = AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.8 });
        let (model, load) = (Lossy { plastic, loss }, ExternalLoad { mass, acceleration });
        let time = -2.5 * speed / acceleration;
        let case = Case { name: name.clone(), model, load, gap: 0.0, speed, time };
        let [whole, parts] =
            [1, 100].map(|parts| run(&case, parts).unwrap_or_else(|| panic!("{case:?} fails in {parts} steps")));
        let off = (whole.dissipated - parts.dissipated).abs() / parts.dissipated;
        assert!(off < 1e-3, "{case:?} in 100 steps is off by {off:e}: {whole:?} in one, {parts:?}");
        cases += 1;
    }
    assert!(cases > 20, "only {cases} cases");
}

#[test]
fn a_flight_after_the_contact_is_no_heat_however_fast_it_gets() {
    for (name, plastic) in all_models(crate::physics::mild()) {
        let yields = plastic.pair.yield_point(1.1);
        let (speed, mass) = (1.0, 100.0 * yields.force * yields.indentation);
        // the contact takes a small part of the energy, and the flight gives a billion times as much
        let acceleration = -speed * speed / (40.0 * yields.indentation);
        for restitution in [0.3, 0.9] {
            let loss = AnyLoss::RestitutionFitted(RestitutionFitted { restitution });
            let (model, load) = (Lossy { plastic, loss }, ExternalLoad { mass, acceleration });
            let case = |time: f64| Case { name: name.clone(), model, load, gap: 0.0, speed, time };
            let short = run(&case(-3.0 * speed / acceleration), 1).expect("within range");
            let long = run(&case(-1e6 * speed / acceleration), 1).expect("within range");
            assert!(long.kinetic > 1e9 * short.kinetic && short.dissipated != 0.0, "{name}: {short:?}, {long:?}");
            let off = (long.dissipated / short.dissipated - 1.0).abs();
            assert!(off < 1e-8, "{name}, e = {restitution}: {off:e}");
        }
    }
}

/// Bodies near rest are slower than the rounding of the forces on them. A step of some oscillations then took forty times the
/// evaluations, or failed.
#[test]
fn bodies_come_to_rest_in_steps_of_few_evaluations_wherever_they_rest() {
    let mut random = Random(99);
    let mut most = 0;
    for (name, plastic) in all_models(crate::physics::mild()) {
        let modulus = random.log_uniform(1e9, 1e12);
        let pair = pair_of(random.log_uniform(1e-4, 1.0), modulus, modulus / random.log_uniform(50.0, 1000.0));
        let plastic = AnyModel { pair, ..plastic };
        let yields = pair.yield_point(1.1);
        for restitution in [0.3, 0.7, 0.9] {
            // where the bodies rest, or how deep they have been before
            let (rest, dent) = (random.log_uniform(1e-4, 0.1), [0.0, random.log_uniform(2.0, 100.0)]);
            let mass = random.log_uniform(1e-9, 1e3);
            let resting =
                brinell_contact::history::History::start(&plastic, -rest * yields.indentation).expect("within range");
            let acceleration = resting.force() / mass;
            let swing = (yields.indentation * rest / acceleration).sqrt();
            let speed = acceleration * swing * random.log_uniform(0.1, 3.0);
            for dent in dent {
                let model = Lossy { plastic, loss: AnyLoss::RestitutionFitted(RestitutionFitted { restitution }) };
                let depth = dent * yields.indentation;
                let mut history = History::start(&model, -depth).expect("within range");
                // up to the surface of the dent
                let bottom = history.plastic().residual_indentation(&plastic);
                history.advance(&model, -1.0, depth - bottom).expect("within range");
                let load = ExternalLoad { mass, acceleration };
                let (mut speed, mut steps) = (speed, 0);
                while steps == 0 || speed != 0.0 && steps < 30 {
                    let what = format!("{name}, e = {restitution}, dent {dent}, rest {rest}, step {steps}");
                    let outcome = follow(&mut history, &model, &load, speed, 20.0 * swing);
                    let outcome = outcome.unwrap_or_else(|reason| panic!("{what}: {reason:?}"));
                    most = most.max(outcome.evaluations);
                    assert!(outcome.evaluations < 100_000, "{what}: {} evaluations", outcome.evaluations);
                    speed = outcome.speed;
                    steps += 1;
                }
                let left = speed.abs() / (acceleration * swing);
                assert!(left < 0.1, "{name}, e = {restitution}, dent {dent}: {left} of the speed is left");
            }
        }
    }
    println!("at most {most} evaluations in a step");
}

/// How often every pair of laws is tried; `BRINELL_ROUNDS` asks for more.
fn rounds() -> u32 {
    std::env::var("BRINELL_ROUNDS").map_or(1, |text| text.parse().expect("a number"))
}
