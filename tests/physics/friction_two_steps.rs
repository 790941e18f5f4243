//! Quantities of whole steps in two directions, for all pairs of laws that support friction: mean force, impulse, friction work;
//! and the outputs that describe the end of a step: stick radius, derivatives.

use super::friction_growth::{Model, history, models};
use crate::physics::Random;
use brinell_contact::Contact;
use brinell_contact::history::path::RatePolynomial;
use brinell_contact::tangential::{FrictionalContact, PlaneContact, Quantity, Sliding};
use brinell_testing::long;
use std::f64::consts::PI;

/// Long enough that no list is ever full.
type Plane = PlaneContact<64>;
type Line = FrictionalContact<64>;

/// One step of 1 s over a distance along the normal and one in the plane [m], in equal `parts`.
fn go(contact: &mut Plane, model: &Model, (rise, slip): (f64, [f64; 2]), parts: u32) {
    contact.set_tangential_rates(slip);
    for _ in 0..parts {
        contact.step_held(rise, 1.0 / f64::from(parts), &model.normal.yield_point(), || *model).expect("within range");
    }
}

fn start(model: &Model) -> Plane {
    Plane::start(model, 0.0).expect("within range")
}

/// The pairs whose contact never yields in these histories.
fn elastic_models() -> impl Iterator<Item = (String, Model)> {
    models().into_iter().filter(|(name, _)| name.starts_with("hertz "))
}

/// The same `slip` in a direction that is new in most steps.
fn turned(random: &mut Random, slip: f64) -> [f64; 2] {
    let (sine, cosine) = (2.0 * PI * random.next()).sin_cos();
    [slip * cosine, slip * sine]
}

/// What a `contact` has lost by slip, relative to the largest energy so far.
struct Losses {
    work: f64,
    scale: f64,
    fall: f64,
}

impl Losses {
    const NONE: Losses = Losses { work: 0.0, scale: f64::MIN_POSITIVE, fall: 0.0 };

    fn look(&mut self, contact: &Plane, model: &Model) {
        let ratio = model.friction.coefficient / model.friction.scale();
        self.scale = self.scale.max(ratio * contact.elastic_energy(model));
        let work = contact.friction_work(model);
        self.fall = self.fall.max((self.work - work) / self.scale);
        self.work = work;
    }
}

#[test]
fn without_slip_friction_does_no_work() {
    for (name, model) in elastic_models() {
        let (mut contact, mut losses, mut random) = (start(&model), Losses::NONE, Random(3));
        for _ in 0..60 {
            let rise = 1e-8 * 10f64.powf(-3.0 * random.next());
            let slip = turned(&mut random, 0.99 * rise / model.friction.scale());
            go(&mut contact, &model, (rise, slip), 1);
            losses.look(&contact, &model);
            assert_eq!(contact.sliding(), Sliding::Stick, "{name}");
            assert!(losses.work.abs() <= 1e-14 * losses.scale, "{name}: {:e} of {:e} J", losses.work, losses.scale);
        }
    }
}

/// Touch, onset of slip, reversal of slip and separation are inside the steps.
#[test]
fn a_touch_and_a_separation_in_two_steps_have_the_impulse_and_friction_work_of_a_thousand() {
    for (name, model) in elastic_models() {
        let mut worst = [0.0_f64; 2];
        for seed in 0..long::cases(60) {
            let mut random = Random(seed);
            let (depth, gap) = (1e-7, 4e-8 * random.next());
            let size = depth / model.friction.scale();
            let [first, second] = [0, 1].map(|_| {
                let slip = 4.0 * size * (random.next() - 0.3);
                turned(&mut random, slip)
            });
            let steps = [(-gap, [0.0; 2]), (depth + gap, first), (-depth - gap, second)];
            let [whole, fine] = [1, 500].map(|parts| {
                let mut contact = start(&model);
                steps.into_iter().for_each(|step| go(&mut contact, &model, step, parts));
                contact
            });
            let ([x, y], [u, v]) = (whole.tangential_impulses(), fine.tangential_impulses());
            let force = 0.3 * model.normal.peak(depth).force;
            let work = whole.friction_work(&model) - fine.friction_work(&model);
            worst[0] = worst[0].max((x - u).hypot(y - v) / force);
            worst[1] = worst[1].max(work.abs() / (force * size));
        }
        println!("{name}: impulse {:.1e}, friction work {:.1e}", worst[0], worst[1]);
        assert!(worst[0] <= 1e-3 && worst[1] <= 1e-3, "{name}: {worst:?}");
    }
}

#[test]
fn the_stick_radius_is_zero_in_sliding_and_never_above_the_contact_radius() {
    fn check<C: Contact<Model>>(name: &str, contact: &C, model: &Model) {
        let (stick, radius) = (contact.tangential(model, Quantity::StickRadius, 0.0), contact.contact_radius(model));
        let what = format!("{name}: {stick:e} of {radius:e} m, {:?}", contact.sliding());
        match contact.sliding() {
            Sliding::Apart | Sliding::Sliding => assert_eq!(stick, 0.0, "{what}"),
            Sliding::Stick => assert!((stick - radius).abs() <= 1e-15 * radius, "{what}"),
            Sliding::PartialSlip => assert!(stick <= radius && stick >= 0.0, "{what}"),
        }
    }
    for (name, model) in models() {
        for seed in 0..20 {
            let (mut plane, mut line) = (start(&model), Line::start(&model, 0.0).expect("within range"));
            let mut random = Random(seed);
            for (rise, slip) in history(seed, 40) {
                let slip = 4.0 * slip;
                go(&mut plane, &model, (rise, turned(&mut random, slip)), 1);
                line.set_tangential_rate(slip);
                line.step_held(rise, 1.0, &model.normal.yield_point(), || model).expect("within range");
                check(&name, &plane, &model);
                check(&name, &line, &model);
            }
        }
    }
}

#[test]
fn derivatives_of_the_force_have_the_sign_of_its_change_while_the_motion_turns() {
    for (name, model) in elastic_models() {
        let (mut wrong, mut count) = (0, 0);
        for seed in 0..40 {
            let mut random = Random(seed);
            // the first number of a small seed is zero
            random.next();
            let mut contact = start(&model);
            let (depth, size) = (1e-7, 1e-7 / model.friction.scale());
            go(&mut contact, &model, (depth, [0.0; 2]), 1);
            let (radius, turn) = (3.0 * size * random.next(), 0.02 + 0.2 * random.next());
            let swing = 0.3 * depth * random.next();
            for step in 1..60 {
                let angle = turn * f64::from(step);
                let rise = swing * turn * angle.cos();
                let slip = [-radius * turn * angle.sin(), radius * turn * angle.cos()];
                go(&mut contact, &model, (rise, slip), 1);
                // the next step, and a short part of it
                let mut next = contact;
                let after = turn * f64::from(step + 1);
                let (rise, slip) =
                    (swing * turn * after.cos(), [-radius * turn * after.sin(), radius * turn * after.cos()]);
                let normal = RatePolynomial::held(rise);
                let tangential = slip.map(RatePolynomial::held);
                go(&mut next, &model, (rise, slip), 1);
                let limit = 0.3 * contact.normal().force() * radius * turn / size;
                for direction in 0..2 {
                    let force = Quantity::Force(direction);
                    let first = contact.tangential_derivatives(&model, force, &normal, &tangential).0;
                    let change = next.tangential(&model, force, 0.0) - contact.tangential(&model, force, 0.0);
                    assert!(first.is_finite(), "{name}: {first:e}");
                    count += 1;
                    wrong += i32::from(first * change < 0.0 && change.abs() > 0.05 * limit);
                }
            }
        }
        println!("{name}: {wrong} of {count} signs are wrong");
        // where the force turns within the step
        assert!(wrong * 200 < count, "{name}: {wrong} of {count}");
    }
}

/// Where the direction of the motion jumps, the springs at the edge turn at once, and there is no second derivative. The
/// difference that is offered instead has to be of use.
#[test]
fn a_force_is_extrapolated_better_with_its_second_derivative_than_without() {
    let dents = ["thornton with thornton", "brinell with brinell"];
    for (name, model) in models() {
        if !(name.starts_with("hertz ") || dents.contains(&name.as_str())) {
            continue;
        }
        for kind in ["held", "accelerated", "random"] {
            let (mut with, mut without) = (Vec::new(), Vec::new());
            for seed in 0..long::cases(8) {
                let mut random = Random(seed);
                random.next();
                let (depth, size) = (1e-7, 1e-7 / model.friction.scale());
                let mut contact = start(&model);
                // below the depth of its dent
                go(&mut contact, &model, (2.0 * depth, [0.0; 2]), 1);
                go(&mut contact, &model, (-depth, [0.0; 2]), 1);
                let (radius, turn) = (3.0 * size * random.next(), 0.02 + 0.2 * random.next());
                let swing = 0.3 * depth * random.next();
                let mut rates = |step: i32| {
                    if kind == "random" {
                        let slip = size * 10f64.powf(-3.0 * random.next());
                        let rise = 0.3 * depth * 10f64.powf(-3.0 * random.next()) * (random.next() - 0.5);
                        return (rise, turned(&mut random, slip));
                    }
                    let (sine, cosine) = (turn * f64::from(step)).sin_cos();
                    (swing * turn * cosine, [-radius * turn * sine, radius * turn * cosine])
                };
                let mut next = rates(0);
                for step in 1..60 {
                    go(&mut contact, &model, next, 1);
                    next = rates(step);
                    let (rise, [slip, other]) = next;
                    let turn = if kind == "accelerated" { turn } else { 0.0 };
                    let normal = RatePolynomial { rate: rise, slope: -turn * turn * rise, bend: 0.0 };
                    let tangential = [(slip, -other * turn), (other, slip * turn)];
                    let tangential = tangential.map(|(rate, slope)| RatePolynomial { rate, slope, bend: 0.0 });
                    let speed = rise.abs() + model.friction.scale() * slip.hypot(other);
                    let time = 1e-2 * contact.normal().indentation() / speed;
                    let limit = 0.3 * contact.normal().force();
                    let mut moved = contact;
                    for part in 0..16 {
                        let middle = (f64::from(part) + 0.5) / 16.0 * time;
                        moved.set_tangential_rates(tangential.map(|course| course.rate + middle * course.slope));
                        let way = RatePolynomial::held(normal.rate + middle * normal.slope);
                        moved.step(&way, time / 16.0, || model).expect("within range");
                    }
                    for direction in 0..2 {
                        let force = Quantity::Force(direction);
                        let (first, second) = contact.tangential_derivatives(&model, force, &normal, &tangential);
                        let change = moved.tangential(&model, force, 0.0)
                            - contact.tangential(&model, force, 0.0)
                            - first * time;
                        without.push(change.abs() / limit);
                        with.push((change - 0.5 * second * time * time).abs() / limit);
                    }
                }
            }
            let [with, without] = [with, without].map(|mut errors| {
                errors.sort_by(f64::total_cmp);
                [0.5, 0.99, 1.0].map(|part| errors[(part * (errors.len() - 1) as f64) as usize])
            });
            println!("{name}, {kind}: with {with:?}, without {without:?}");
            assert!(
                with[0] <= 0.6 * without[0] && with[1] <= 3.0 * without[1],
                "{name}, {kind}: {with:?}, {without:?}"
            );
            assert!(with[2] <= 3.0 * without[2], "{name}, {kind}: {with:?}, {without:?}");
        }
    }
}
