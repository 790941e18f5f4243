//! Contacts with friction that share bodies: what must hold for any bodies and any step, and how they come to rest.

use crate::moved_bodies::{Group, LosingOneWay, LosingTwoWays, OneWay, Rough};
use crate::physics::{AnyModel, Random, loading, pair_of, unloading};
use brinell_contact::losses::{AnyLoss, RestitutionFitted};
use brinell_contact::shared::{Refused, SharedContact};
use brinell_contact::tangential::{Friction, FrictionalModel, Quantity};
use brinell_contact::{Contact, Surface};

type Model = Rough<()>;
type LosingModel = Rough<AnyLoss>;

const G: f64 = 9.81;

/// Ratio of the stiffnesses for a Poisson's ratio of 0.3.
const RATIO: f64 = 2.0 * 0.7 / 1.7;

/// A box on spherical feet of 5 mm.
struct Feet {
    mass: f64,
    inertia: [f64; 3],
    /// From the centre of mass [m].
    arms: [[f64; 3]; 4],
}

const BOX: Feet = Feet {
    mass: 0.3,
    inertia: [2e-4, 3e-4, 4e-4],
    arms: [[0.03, 0.02, -0.01], [-0.03, 0.02, -0.01], [0.03, -0.02, -0.01], [-0.03, -0.02, -0.01]],
};

impl Feet {
    /// The upper triangle of the inverse masses, with so many tangential `directions` [1/kg].
    fn inverse_masses(&self, directions: usize) -> Vec<f64> {
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let axes = [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let rows: Vec<_> = axes[..=directions]
            .iter()
            .flat_map(|&axis| self.arms.iter().map(move |&arm| (axis, cross(arm, axis))))
            .collect();
        let mut entries = Vec::new();
        for (i, one) in rows.iter().enumerate() {
            for other in &rows[i..] {
                let of = |axis: usize| {
                    one.0[axis] * other.0[axis] / self.mass + one.1[axis] * other.1[axis] / self.inertia[axis]
                };
                entries.push((0..3).map(of).sum());
            }
        }
        entries
    }
}

fn rough(law: (&str, &str), coefficient: f64) -> Model {
    let normal = AnyModel {
        pair: pair_of(5e-3, 1.13e11, 3e8),
        loading: loading(law.0),
        unloading: unloading(law.1),
        surface: Surface::Dented,
    };
    FrictionalModel { normal, friction: Friction { coefficient, stiffness_ratio: RATIO }, loss: () }
}

fn losing(law: (&str, &str), coefficient: f64) -> LosingModel {
    let FrictionalModel { normal, friction, .. } = rough(law, coefficient);
    FrictionalModel { normal, friction, loss: AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.9 }) }
}

/// The box on a slope, in so many directions.
fn on_slope<M, C: Contact<M> + SharedContact<M>>(model: impl Fn() -> M, slope: f64, gap: f64) -> Group<M, C> {
    let directions = <C as Contact<M>>::DIRECTIONS;
    let mut accelerations = vec![G * slope.cos(); 4];
    accelerations.extend([G * slope.sin(); 4]);
    accelerations.resize(4 * (1 + directions), 0.0);
    let rates = vec![0.0; accelerations.len()];
    Group::new((0..4).map(|_| model()).collect(), &[gap; 4], BOX.inverse_masses(directions), accelerations, rates)
}

/// The box after it was dropped from 1 mm and has come to rest, and the time that took [ms].
fn at_rest<M, C: Contact<M> + SharedContact<M> + Clone>(model: impl Fn() -> M, slope: f64) -> (Group<M, C>, u32)
where
    M: Clone,
{
    let mut group: Group<M, C> = on_slope(model, slope, 1e-3);
    for steps in 1..1000 {
        group.step(1e-3);
        if group.rates.iter().all(|rate| rate.abs() < 1e-14) {
            return (group, steps);
        }
    }
    panic!("{:?}", group.rates)
}

#[test]
fn a_box_that_is_dropped_on_a_slope_comes_to_rest_and_stays_there() {
    let slope: f64 = 0.2;
    let law = ("brinell", "brinell");
    let (mut group, time): (Group<LosingModel, LosingOneWay>, u32) = at_rest(|| losing(law, 0.5), slope);
    println!("at rest after {time} ms and {} evaluations", group.evaluations);
    // the energy of the fall
    assert!(group.imbalance < 1e-10 * BOX.mass * G * 1e-3, "{:e}", group.imbalance);
    let depths = group.depths();
    group.evaluations = 0;
    for _ in 0..100_000 {
        group.impulses.fill(0.0);
        group.step(1e-3);
        assert!(group.rates.iter().all(|rate| rate.abs() < 1e-14), "{:?}", group.rates);
    }
    assert_eq!(group.depths(), depths);
    assert!(group.evaluations <= 100_000 * 12, "{} evaluations", group.evaluations);
    let (normal, tangential) = group.impulses.split_at(4);
    for (found, expected) in [(normal, slope.cos()), (tangential, slope.sin())] {
        let weight = 1e-3 * BOX.mass * G * expected;
        let off = found.iter().sum::<f64>() / weight - 1.0;
        assert!(off.abs() < 1e-12, "{off:.1e}: {found:?}");
    }
    // anything that changes wakes it
    for row in 0..8 {
        let mut group = group.clone();
        group.accelerations[row] -= 5.0;
        group.step(1e-3);
        assert!(group.rates.iter().any(|rate| rate.abs() > 1e-5), "{:?}", group.rates);
    }
}

#[test]
fn a_box_in_two_directions_comes_to_rest() {
    let (group, time): (Group<LosingModel, LosingTwoWays>, u32) =
        at_rest(|| losing(("hertz", "contact-radius"), 0.3), 0.1);
    println!("at rest after {time} ms and {} evaluations", group.evaluations);
}

#[test]
fn a_box_that_slides_loses_the_work_of_friction() {
    let (slope, coefficient): (f64, f64) = (0.4, 0.1);
    let model = || losing(("hertz", "contact-radius"), coefficient);
    let mut group: Group<LosingModel, LosingOneWay> = on_slope(model, slope, 1e-6);
    (0..300).for_each(|_| group.step(1e-3));
    let energy = |group: &Group<LosingModel, LosingOneWay>| -> f64 {
        group.contacts.iter().zip(&group.models).map(|(contact, model)| contact.friction_work(model)).sum()
    };
    let (before, rate) = (energy(&group), group.rates[4]);
    group.impulses.fill(0.0);
    (0..100).for_each(|_| group.step(1e-3));
    let gained = group.rates[4] - rate;
    let expected = 0.1 * G * (slope.sin() - coefficient * slope.cos());
    assert!((gained / expected - 1.0).abs() < 1e-6, "{gained} instead of {expected} m/s");
    let way = 0.1 * (rate + 0.5 * gained);
    let work = coefficient * BOX.mass * G * slope.cos() * way;
    let lost = energy(&group) - before;
    assert!((lost / work - 1.0).abs() < 1e-6, "{lost} instead of {work} J");
}

/// The limits of the springs follow the normal force with its loss, and what sticks doesn't reach its limit. Another speed of the bodies
/// changes the normal force, and not the pull; on a dent that has grown, a little slips at the edge.
#[test]
fn what_sticks_pulls_alike_whatever_a_loss_makes_of_the_normal_force() {
    for law in [("hertz", "contact-radius"), ("brinell", "brinell"), ("thornton", "thornton")] {
        let loss = AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.5 });
        let model = LosingModel { loss, ..losing(law, 10.0) };
        let entries = vec![250.0, 0.0, 250.0];
        let mut group: Group<LosingModel, LosingOneWay> =
            Group::new(vec![model], &[0.0], entries, vec![0.0; 2], vec![0.5, 1e-3]);
        let mut pressed = 0;
        for _ in 0..100 {
            group.step(1e-6);
            let (contact, model, rate) = (&group.contacts[0], &group.models[0], group.rates[0]);
            let force = |part: f64| Contact::<LosingModel>::force(contact, part * rate);
            let [at_rest, moving] = [force(0.0), force(1.0)];
            if at_rest < 1.0 || moving < 0.1 * at_rest {
                continue;
            }
            pressed += usize::from((moving / at_rest - 1.0).abs() > 0.01);
            let [pull] = contact.tangential_forces(model, 0.0);
            for part in [0.5, 1.0] {
                let [other] = contact.tangential_forces(model, part * rate);
                assert!(
                    (other - pull).abs() < 1e-4 * pull.abs(),
                    "{law:?}, {indentation}, {at_rest} {moving} N: {pull} at rest, {other} at {rate} m/s",
                    indentation = contact.normal().indentation()
                );
            }
        }
        assert!(pressed > 10, "{law:?}: {pressed} steps");
    }
}

/// Balls of 1 g to 1 kg on each other and on the ground, dropped from up to 10 um with a slip at the ground, and their number.
fn random_stack<C: Contact<LosingModel> + SharedContact<LosingModel>>(random: &mut Random) -> Group<LosingModel, C> {
    let rows = 1 + <C as Contact<LosingModel>>::DIRECTIONS;
    let count = 2 + (3.0 * random.next()) as usize;
    let masses: Vec<f64> = (0..count).map(|_| 10_f64.powf(-3.0 * random.next())).collect();
    let mut entries = Vec::new();
    for row in 0..rows * count {
        for column in row..rows * count {
            let (one, other) = (row % count, column % count);
            let below = if one > 0 { 1.0 / masses[one - 1] } else { 0.0 };
            entries.push(match (row / count == column / count, other.abs_diff(one)) {
                (true, 0) => (1.0 / masses[one] + below) * if row < count { 1.0 } else { 3.5 },
                (true, 1) => -1.0 / masses[one],
                _ => 0.0,
            });
        }
    }
    let law = if random.next() < 0.5 { ("hertz", "contact-radius") } else { ("brinell", "brinell") };
    let models = (0..count).map(|_| LosingModel {
        loss: AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.3 + 0.7 * random.next() }),
        ..losing(law, 0.05 + 0.75 * random.next())
    });
    let models: Vec<LosingModel> = models.collect();
    let drop = if random.next() < 0.3 { 0.0 } else { 1e-5 * random.next() };
    let (mut accelerations, mut rates) = (vec![0.0; rows * count], vec![0.0; rows * count]);
    (accelerations[0], accelerations[count]) = (G, random.next());
    rates[count] = 0.02 * random.next();
    Group::new(models, &vec![drop; count], entries, accelerations, rates)
}

/// Follows random stacks in steps of a millisecond; returns the differences to the same in three parts, in rising order.
fn stacks<C: Contact<LosingModel> + SharedContact<LosingModel> + Clone>(seed: u64, count: u32) -> Vec<f64> {
    let mut random = Random(seed);
    let mut differences = Vec::new();
    let lost = |group: &Group<LosingModel, C>| -> f64 {
        let of = |(contact, model): (&C, &LosingModel)| {
            contact.dissipated_energy(model) + contact.tangential(model, Quantity::FrictionWork, 0.0)
        };
        group.contacts.iter().zip(&group.models).map(of).sum()
    };
    for index in 0..count {
        let mut group = random_stack::<C>(&mut random);
        let most = (0..group.rates.len()).map(|row| group.masses().of(row, row)).fold(0.0, f64::max);
        for step in 0..12 {
            let (mut cut, before) = (group.clone(), lost(&group));
            group.try_step(1e-3).unwrap_or_else(|refused| panic!("stack {index}, step {step}: {refused:?}"));
            // the weight of the lightest body on a micrometre is little
            let energy = group.energy() + 1e-6 * G / most;
            // while a dent grows, the springs store a little too much for a time
            assert!(group.imbalance < 1e-7 * energy, "{index}: {:e} of {energy:e} J", group.imbalance);
            let gained = before - lost(&group);
            assert!(gained < 1e-15 * energy, "stack {index}, step {step}: gained {gained:e} of {energy:e} J");
            if step % 4 == 0 {
                (0..3).for_each(|_| cut.step(1e-3 / 3.0));
                differences.push(group.difference(&cut, (2.0 * energy * most).sqrt(), 1e-5));
            }
        }
    }
    differences.sort_by(f64::total_cmp);
    differences
}

#[test]
fn no_stack_is_refused_a_step_of_a_millisecond_or_gains_energy() {
    for differences in [stacks::<LosingOneWay>(31, 16), stacks::<LosingTwoWays>(32, 4)] {
        let at = |part: usize| differences[differences.len() * part / 100];
        let (median, most) = (at(50), at(95));
        println!("{} differences: median {median:.1e}, 95 % below {most:.1e}", differences.len());
        assert!(median < 1e-6 && most < 1e-4, "{median:.1e}, {most:.1e}");
    }
}

#[test]
fn the_smallest_and_largest_rates_are_followed_or_refused() {
    for rate in [5e-324, 1e-310, 1e-200, 1e-100, 1e-30, 1e10, 1e30] {
        for slip in [0.0, rate, -0.3 * rate] {
            let model = || losing(("big-alabo", "contact-radius"), 0.4);
            let mut group: Group<LosingModel, LosingTwoWays> = on_slope(model, 0.0, 0.0);
            group.accelerations.fill(0.0);
            (group.rates[0], group.rates[4]) = (rate, slip);
            let outcome = group.try_step(1e-6);
            let is_followed = outcome.is_ok() && group.rates.iter().all(|rate| rate.is_finite());
            let is_too_long = matches!(outcome, Err(Refused::TooLong { .. }));
            assert!(is_followed || rate > 1e20 && is_too_long, "{rate:e}, {slip:e}: {outcome:?}");
        }
    }
}

#[test]
fn a_fresh_surface_forgets_the_dent_in_a_flight_of_any_length() {
    let FrictionalModel { normal, friction, .. } = rough(("thornton", "thornton"), 0.3);
    let model = FrictionalModel { normal: AnyModel { surface: Surface::Fresh, ..normal }, friction, loss: () };
    let start = || -> Group<Model, OneWay> {
        Group::new(vec![model], &[0.0], vec![30.0, 2.0, 100.0], vec![200.0, 0.0], vec![0.5, 0.1])
    };
    // it hits, flies, and hits again, not so often that its phase is lost
    let (mut whole, mut cut) = (start(), start());
    whole.step(3.5e-3);
    (0..200).for_each(|_| cut.step(1.75e-5));
    assert!(whole.impulses[0] > 1.5 * 0.5 / 30.0, "{:?}", whole.impulses);
    let difference = whole.difference(&cut, 0.5, 1e-5);
    assert!(difference < 1e-3, "{difference:.1e}: {:?} {:?}", whole.rates, cut.rates);
}
