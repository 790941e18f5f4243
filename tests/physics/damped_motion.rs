//! Bodies that the rate-dependent laws stop and throw back.

use crate::physics::Random;
use brinell_contact::damped::{Adams, AnyDamped, Damped};
use brinell_contact::impact::Impact;
use brinell_contact::loading::Elastic;
use brinell_contact::losses::{self, Damper, History, follow, impact};
use brinell_contact::motion::{ExternalLoad, Outcome};
use brinell_contact::unloading::ContactRadius;
use brinell_contact::{Contact, Pair};

type Model = losses::Model<Elastic, ContactRadius, Damper>;

const MASS: f64 = 4.11e-3;

fn pair() -> Pair {
    Pair { radius: 5e-3, modulus: 226e9, yield_strength: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio: 0.3 }
}

/// Every law, each with two restitutions.
fn models() -> impl Iterator<Item = (&'static str, Model)> {
    AnyDamped::ALL
        .into_iter()
        .flat_map(|(name, law)| [0.4, 0.9].map(|restitution| (name, law.model(pair(), restitution, MASS))))
}

/// The law of Adams with random numbers: its surface lags behind, and grips again below an exponent of 2.
fn random_adams(random: &mut Random) -> Model {
    let law = Adams {
        stiffness: 0.0,
        stiffness_factor: random.log_uniform(0.1, 10.0),
        exponent: if random.next() < 0.8 { 1.0 + random.next() } else { 2.0 + random.next() },
        full_damping: random.log_uniform(1.0, 1e4),
        damping_depth: random.log_uniform(1e-7, 1e-4),
    };
    law.model(pair(), 1.0, MASS)
}

#[derive(Debug)]
struct Ball<'a> {
    model: &'a Model,
    history: History<Damper>,
    speed: f64,
}

impl Ball<'_> {
    fn new(model: &Model, gap: f64, speed: f64) -> Ball<'_> {
        Ball { model, history: History::start(model, gap).expect("within range"), speed }
    }

    fn step(&mut self, step: f64) -> Outcome {
        let load = ExternalLoad { mass: MASS, acceleration: 0.0 };
        let outcome = follow(&mut self.history, self.model, &load, self.speed, step);
        let outcome = outcome.unwrap_or_else(|reason| panic!("{reason:?}: {self:?}"));
        // the momentum is balanced
        let expected = self.speed - outcome.speed_removed;
        let size = self.speed.abs() + outcome.speed_removed;
        assert!((outcome.speed - expected).abs() <= 1e-12 * size, "{outcome:?} {expected}");
        self.speed = outcome.speed;
        outcome
    }

    fn dissipated(&self) -> f64 {
        Contact::<Model>::dissipated_energy(&self.history, self.model)
    }

    fn stored(&self) -> f64 {
        Contact::<Model>::elastic_energy(&self.history, self.model)
    }

    fn has_parted(&self) -> bool {
        self.speed < 0.0 && self.history.plastic().indentation() <= 0.0
    }
}

#[test]
fn a_rebound_is_the_predicted_one_at_any_speed_and_in_any_steps() {
    let mut worst = 0.0f64;
    for (name, model) in models() {
        for speed in [0.01, 0.1, 1.0, 10.0, 100.0] {
            let expected = impact::predict(&model, &Impact { mass: MASS, speed }).expect("within range");
            for parts in [1.0, 10.0, 1000.0] {
                let step = 1.6 * expected.contact_time() / parts;
                let mut ball = Ball::new(&model, 0.3 * speed * step, speed);
                let mut deepest = 0.0f64;
                for _ in 0..10_000 {
                    deepest = deepest.max(ball.step(step).deepest);
                    if ball.has_parted() {
                        break;
                    }
                }
                let error = (-ball.speed / speed / expected.restitution - 1.0).abs();
                worst = worst.max(error);
                assert!(error < 1e-9, "{name}, {speed} m/s in {parts}: {error:e}");
                assert!((deepest / expected.max_indentation - 1.0).abs() < 1e-9, "{name}, {speed} m/s in {parts}");
                let lost = 0.5 * MASS * (speed * speed - ball.speed * ball.speed);
                assert!((ball.dissipated() / lost - 1.0).abs() < 1e-9, "{name}, {speed} m/s in {parts}");
                assert_eq!(ball.stored(), 0.0);
            }
        }
    }
    println!("largest error of the restitution: {worst:.1e}");
}

#[test]
fn the_second_grip_of_a_surface_is_followed_in_any_parts() {
    // the reference: classical Runge-Kutta in 4e5 steps
    let law = AnyDamped::Adams(Adams::REFERENCE);
    let soft = Pair { radius: 5e-3, modulus: 103e9 / 0.91, youngs_modulus: 103e9, ..pair() };
    let known = (law.model(soft, 1.0, MASS), 0.08578898438347915, 3.2225550329902224);
    let mut random = Random(61);
    let drawn = std::iter::repeat_with(|| {
        let model = random_adams(&mut random);
        (model, random.log_uniform(1e-4, 1e2), random.log_uniform(1e-3, 1e2))
    });
    for (place, (model, mass, speed)) in std::iter::once(known).chain(drawn.take(60)).enumerate() {
        let Some(expected) = impact::predict(&model, &Impact { mass, speed }) else { continue };
        if place == 0 {
            assert!((expected.restitution * speed / 3.0453515172 - 1.0).abs() < 1e-10, "{expected:?}");
        }
        let load = ExternalLoad { mass, acceleration: 0.0 };
        for parts in [1, 3, 5, 10, 17, 50, 400] {
            let (mut history, mut now) = (History::start(&model, 0.0).unwrap(), speed);
            for _ in 0..parts {
                let step = 3.0 * expected.contact_time() / f64::from(parts);
                let outcome = follow(&mut history, &model, &load, now, step);
                now = outcome
                    .unwrap_or_else(|reason| {
                        panic!("{reason:?}: {:?}, {mass} kg at {speed} m/s in {parts}: {expected:?}", model)
                    })
                    .speed;
            }
            let error = (-now / speed - expected.restitution).abs();
            assert!(error < 1e-9, "{:?}, {mass} kg at {speed} m/s in {parts}: {error:e}", model);
            let lost = 0.5 * mass * (speed * speed - now * now);
            let dissipated = Contact::<Model>::dissipated_energy(&history, &model);
            assert!((dissipated - lost).abs() <= 1e-9 * mass * speed * speed, "{:?} in {parts}", model);
        }
    }
}
