//! Bodies of known mass under the rate-dependent laws, without FMI.

use crate::physics::{self, Random};
use crate::scenes::{Choice, Chosen, DampedMassive, choose, ready, set_rate};
use brinell_contact::damped::{Adams, AnyDamped, Damped};
use brinell_contact::impact::Impact;
use brinell_contact::loading::Elastic;
use brinell_contact::losses::{self, Damper, History, follow, impact};
use brinell_contact::motion::{ExternalLoad, Outcome};
use brinell_contact::unloading::ContactRadius;
use brinell_contact::{Contact, Pair};
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::{Present, Real};

type Model = losses::Model<Elastic, ContactRadius, Damper>;
type One = Chosen<DampedMassive, 1, Present>;

const MASS: f64 = 4.11e-3;
const GRAVITY: f64 = 9.81;

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
    acceleration: f64,
    /// Distance by which it has come closer [m].
    way: f64,
}

impl Ball<'_> {
    fn new(model: &Model, gap: f64, speed: f64, acceleration: f64) -> Ball<'_> {
        Ball { model, history: History::start(model, gap).expect("within range"), speed, acceleration, way: 0.0 }
    }

    fn step(&mut self, step: f64) -> Outcome {
        let load = ExternalLoad { mass: MASS, acceleration: self.acceleration };
        let before = self.history.plastic().indentation();
        let outcome = follow(&mut self.history, self.model, &load, self.speed, step);
        let outcome = outcome.unwrap_or_else(|reason| panic!("{reason:?}: {self:?}"));
        self.way += self.history.plastic().indentation() - before;
        // the momentum is balanced
        let expected = self.speed + self.acceleration * step - outcome.speed_removed;
        let size = self.speed.abs() + self.acceleration.abs() * step + outcome.speed_removed;
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
                let mut ball = Ball::new(&model, 0.3 * speed * step, speed, 0.0);
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

#[test]
fn a_dropped_ball_comes_to_rest_with_each_law_and_no_energy_gets_lost() {
    for (place, (name, model)) in models().enumerate() {
        // the damping of this law fades with the depth: its last bounces are many
        let (fades, repeated) =
            (name == "adams-impact", !["hunt-crossley", "kelvin-voigt", "tsuji"].contains(&name) && place % 2 == 0);
        let (goal, steps) = if fades { (1e-3, &[3.3e-3][..]) } else { (1e-6, &[1e-4, 3.3e-3][..]) };
        for &step in if repeated { &[] } else { steps } {
            let height = 0.5;
            let mut ball = Ball::new(&model, height, 0.0, GRAVITY);
            let energy = MASS * GRAVITY * height;
            let (mut time, mut left, mut worst, mut lost) = (0.0, energy, 0.0f64, 0.0);
            while left > goal * energy {
                ball.step(step);
                time += step;
                let kinetic = 0.5 * MASS * ball.speed * ball.speed;
                let balance = MASS * GRAVITY * ball.way - kinetic - ball.stored() - ball.dissipated();
                worst = worst.max(balance.abs() / energy);
                assert!(ball.dissipated() >= lost - 1e-12 * energy, "{name}: heat falls");
                lost = ball.dissipated();
                left = kinetic + ball.stored() + MASS * GRAVITY * (-ball.history.plastic().indentation()).max(0.0);
                assert!(time < 120.0, "{name} with {:?}: {:e} is left", model.loss, left / energy);
            }
            assert!(worst < 1e-9, "{name}: {worst:e}");
        }
    }
}

#[test]
fn the_force_of_an_instance_is_that_at_the_own_speed_of_its_bodies() {
    for (name, damped) in AnyDamped::ALL {
        let laws = physics::model("hertz", "contact-radius");
        let choice = Choice { damped, ..Choice::of(laws.loading, laws.unloading) };
        choose(choice);
        let mut instance = ready::<One>();
        let (step, mut speed, mut before, mut largest) = (2e-8, 1.0, 0.0, 0.0f64);
        for place in 0..1500 {
            set_rate(&mut instance, 0, speed);
            instance.do_step(instance.time(), step).unwrap();
            let force = instance.real((Real::Force, 0));
            let end = instance.real((Real::ClosingSpeed, 0));
            largest = largest.max(force);
            // the momentum says the same as the forces at both ends of the step, if the force is smooth within it
            let taken = choice.effective_mass * (speed - end) / step;
            if place > 100 && before > 0.0 && force > 0.0 {
                let error = (0.5 * (before + force) - taken).abs() / largest;
                assert!(error < 1e-5, "{name} in step {place}: {error:e}");
            }
            (before, speed) = (force, end);
            // an input for the next step changes neither the force nor any other output of the last step
            let outputs = [Real::Force, Real::MeanPressure, Real::Stiffness, Real::PredictedForce];
            let all = |instance: &Instance<One>| outputs.map(|output| instance.real((output, 0)));
            let shown = all(&instance);
            set_rate(&mut instance, 0, 0.5 * end + 0.1);
            assert_eq!(all(&instance).map(f64::to_bits), shown.map(f64::to_bits), "{name} in step {place}");
            for output in outputs {
                let slope = instance.derivative_by_input((output, 0), (Real::IndentationRate, 0));
                assert_eq!(slope.unwrap(), 0.0, "{name}, {output:?}");
            }
        }
        assert!(speed < 0.0 && largest > 100.0, "{name}: {speed} m/s after {largest} N");
    }
}
