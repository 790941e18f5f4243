//! Contacts with losses that share bodies: what must hold for any step, and how they come to rest.

use crate::moved_bodies::{LOSSES, Losing, LosingModel, STEEL};
use crate::physics::{AnyModel, Random, all_models, loading, model, pair_of, unloading};
use brinell_contact::losses::{self, AnyLoss, Plate, RestitutionFitted};
use brinell_contact::{Loading, Surface, Unloading};

/// The number of evaluations of a step over one impact, above the most that the machine states; of a law without segments ten times as many.
const MOST_OF_AN_IMPACT: u32 = 4000;

/// A contact of two steel balls of 10 mm.
fn steel(law: (&str, &str), loss: AnyLoss) -> LosingModel {
    let (loading, unloading) = (loading(law.0), unloading(law.1));
    let plastic = AnyModel { pair: pair_of(5e-3, 1.13e11, 3e8), loading, unloading, surface: Surface::Dented };
    losses::Model { plastic: plastic.prepared(), loss }
}

/// The inverse masses of three balls of 33 g on the ground.
fn stack_of_three() -> Vec<f64> {
    let one = 1.0 / 0.033;
    vec![one, -one, 0.0, 2.0 * one, -one, 2.0 * one]
}

/// Three balls that fall from this height [m] above the ground, on each other.
fn stack(model: LosingModel, height: f64) -> Losing {
    let models = vec![model; 3];
    Losing::new(models, &[height, 0.0, 0.0], stack_of_three(), vec![9.81, 0.0, 0.0], vec![0.0; 3])
}

/// After a fast touch, events that were none once took 27,600 evaluations.
#[test]
fn a_step_over_an_impact_takes_few_evaluations_whatever_the_law_the_loss_and_the_speed() {
    let (mut of_published, mut of_table, mut most) = (Random(4711), Random(4712), [0; 2]);
    let plate = |thickness: f64| AnyLoss::Plate(Plate { target: STEEL, thickness });
    for _ in 0..3 {
        for (name, plastic) in all_models(pair_of(5e-3, 1.13e11, 3e8)) {
            let fitted = [0.01, 0.1, 0.3, 0.59, 0.7, 0.98]
                .map(|restitution| AnyLoss::RestitutionFitted(RestitutionFitted { restitution }));
            let random = if plastic.loading.table().is_some() { &mut of_table } else { &mut of_published };
            for loss in fitted.into_iter().chain([LOSSES[2], plate(0.003), plate(0.03)]) {
                let (speed, pull) = (random.log_uniform(1e-4, 20.0), random.log_uniform(1e-3, 1e3));
                let model = losses::Model { plastic, loss };
                let mut group = Losing::new(vec![model], &[0.0], vec![30.0], vec![-pull], vec![speed]);
                let what = format!("{name}, {loss:?}, {speed:e} m/s, pulled by {pull:e} m/s^2");
                let outcome = group.try_step(3e-3).unwrap_or_else(|reason| panic!("{what}: {reason:?}"));
                let is_costly = !(plastic.loading.is_segmented() && plastic.unloading.is_segmented());
                let limit = MOST_OF_AN_IMPACT * if is_costly { 10 } else { 1 };
                most[usize::from(is_costly)] = most[usize::from(is_costly)].max(outcome.evaluations);
                if outcome.evaluations > limit {
                    println!("{what}: {} evaluations", outcome.evaluations);
                }
            }
        }
    }
    println!("at most {most:?} evaluations, with and without segments");
    assert!(most[0] <= MOST_OF_AN_IMPACT && most[1] <= 10 * MOST_OF_AN_IMPACT, "{most:?}");
}

#[test]
fn a_stack_that_is_dropped_comes_to_rest_and_stays_there() {
    let mut group = stack(steel(("brinell", "brinell"), LOSSES[0]), 1e-3);
    let mut time = 0.0;
    loop {
        group.step(1e-3);
        time += 1e-3;
        if group.rates == [0.0; 3] {
            break;
        }
        assert!(time < 0.25, "{:?}", group.rates);
    }
    println!("at rest after {time:.3} s and {} evaluations", group.evaluations);
    assert!(group.imbalance < 1e-12 * 0.099 * 9.81 * 1e-3, "{:e}", group.imbalance);
    let (still, depths) = (group.clone(), group.depths());
    group.evaluations = 0;
    for _ in 0..100_000 {
        group.step(1e-3);
    }
    assert!(group.evaluations <= 100_000 * 12, "{} evaluations", group.evaluations);
    group.impulses.fill(0.0);
    group.step(1e-3);
    for contact in 0..3 {
        assert!((group.depths()[contact] - depths[contact]).abs() < 1e-16, "{:?}, not {depths:?}", group.depths());
        assert!(group.rates[contact].abs() < 1e-15, "{:?}", group.rates);
        let weight = 0.033 * 9.81 * f64::from(3 - contact as u32);
        assert!((group.impulses[contact] / (weight * 1e-3) - 1.0).abs() < 1e-14, "{:?}", group.impulses);
    }
    // anything that changes wakes it
    let wake: [fn(&mut Losing); 3] = [
        |group| group.entries.iter_mut().for_each(|entry| *entry *= 0.5),
        |group| group.rates[1] = 1e-6,
        |group| group.accelerations[0] *= -1.0,
    ];
    for wake in wake {
        let mut group = still.clone();
        wake(&mut group);
        group.step(1e-3);
        assert!(group.rates != [0.0; 3] || group.depths() != depths, "it sleeps on");
    }
}

#[test]
fn a_box_on_four_feet_comes_to_rest() {
    // the matrix is singular: four feet, three freedoms
    let feet = [(0.03, 0.02), (-0.03, 0.02), (0.03, -0.02), (-0.03, -0.02)];
    let mut entries = Vec::new();
    for (i, one) in feet.iter().enumerate() {
        for other in &feet[i..] {
            entries.push(1.0 / 0.3 + one.0 * other.0 / 3e-4 + one.1 * other.1 / 2e-4);
        }
    }
    let models = vec![steel(("hertz", "contact-radius"), LOSSES[0]); 4];
    let gaps = [1e-3, 1.01e-3, 1.02e-3, 1.03e-3];
    let mut group = Losing::new(models, &gaps, entries, vec![9.81; 4], vec![0.0; 4]);
    let mut steps = 0;
    while group.rates != [0.0; 4] || steps == 0 {
        group.step(1e-3);
        steps += 1;
        assert!(steps < 2000, "{:?}", group.rates);
    }
    println!("at rest after {steps} ms and {} evaluations", group.evaluations);
    group.impulses.fill(0.0);
    group.step(1e-3);
    let sum: f64 = group.impulses.iter().sum();
    assert!((sum / (0.3 * 9.81 * 1e-3) - 1.0).abs() < 1e-12, "{sum}");
}

#[test]
fn a_body_on_a_plate_gives_way_at_a_steady_rate() {
    let loss = LOSSES[3];
    let model = losses::Model { plastic: model("hertz", "contact-radius"), loss };
    let mut group = Losing::new(vec![model; 2], &[0.0; 2], vec![30.0, -30.0, 60.0], vec![9.81, 0.0], vec![0.0; 2]);
    for _ in 0..300 {
        group.step(1e-3);
    }
    let mobility = losses::Loss::factor(&loss);
    group.impulses.fill(0.0);
    group.step(1e-3);
    for contact in 0..2 {
        let force = group.impulses[contact] / 1e-3;
        assert!((group.rates[contact] / (mobility * force) - 1.0).abs() < 1e-9, "{:?}", group.rates);
    }
}
