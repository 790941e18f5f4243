//! An FMU warns about an importer with unstable steps or a force that comes late, and about no other; or an unstable step makes the
//! contact as wide as its smaller body before it can be known, and the next one is refused.

use crate::physics::{AnyModel, Random, all_models, mild};
use crate::scenes::{Choice, Chosen, Elastoplastic, choose, ready, set_rate};
use brinell_contact::Surface;
use brinell_contact::impact::{Impact, predict};
use brinell_fmu::instance::{Fault, Instance, Warning};
use brinell_fmu::scene::{Absent, Present, Real, Scene};
use brinell_testing::masters::{MASS, PATTERNS, Pattern, choice};

type One = Chosen<Elastoplastic, 1, Absent>;
type WithMomentum = Chosen<Elastoplastic, 1, Present>;
type Several = Chosen<Elastoplastic, 3, Absent>;

/// The longest stable step at the largest indentation of an impact at 1 m/s [s].
fn stable_step(model: &AnyModel, mass: f64) -> f64 {
    let deepest = predict(model, &Impact { mass, speed: 1.0 }).unwrap().max_indentation;
    2.0 * (mass / model.unloading_segment(deepest, deepest).stiffness(deepest)).sqrt()
}

/// What an importer is told.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Told {
    Warned(Warning),
    /// [`Fault::TooWide`], [`Fault::TooDeep`]
    Refused,
}

/// A step, and what the importer is told of its masters.
fn stepped<S: Scene>(instance: &mut Instance<S>, time: f64, step: f64) -> Option<Told> {
    match instance.do_step(time, step) {
        Ok(()) => instance.take_deep().filter(|warning| !matches!(warning, Warning::Deep { .. })).map(Told::Warned),
        Err(Fault::TooWide { .. } | Fault::TooDeep { .. }) => Some(Told::Refused),
        Err(fault) => panic!("{fault:?}"),
    }
}

/// The force that an importer applies over a step.
#[derive(Clone, Copy, Debug)]
enum Applied {
    /// The force at the end of the step: semi-implicit Euler, or leap-frog for rates half a step off.
    New,
    /// The force at the start of the step: explicit Euler.
    Old,
    /// Their mean: trapezoidal rule, velocity Verlet.
    Mean,
    /// The new force, extrapolated by half a step: the two-step Adams-Bashforth method.
    Extrapolated,
    /// The output `mean_force`.
    MeanForce,
}

const APPLIED: [Applied; 5] = [Applied::New, Applied::Old, Applied::Mean, Applied::Extrapolated, Applied::MeanForce];

/// A mass that an importer moves.
#[derive(Clone, Copy, Debug)]
struct Moved {
    applied: Applied,
    pattern: Pattern,
    mass: f64,
    /// Length of the steps [s].
    step: f64,
    gap: f64,
    /// Acceleration by all other forces [m/s^2], and whether the importer gives it as the derivative of the rate.
    acceleration: f64,
    told: bool,
}

impl Moved {
    /// Any importer, mass, gap and gravity, with a step from 1.05 to 1000 times the longest stable one at the largest
    /// indentation of an impact at 1 m/s.
    fn any(model: &AnyModel, random: &mut Random) -> Moved {
        let mut decades = |low: f64, high: f64| 10f64.powf(low + (high - low) * random.next());
        let mass = MASS * decades(-3.0, 3.0);
        let step = decades(1.05f64.log10(), 3.0) * stable_step(model, mass);
        let (gap, pull) = (step * decades(-3.0, 0.7), decades(-5.0, -0.5) / step);
        let acceleration = [0.0, pull, -pull][(3.0 * random.next()) as usize];
        let applied = APPLIED[(5.0 * random.next()) as usize];
        // that method has equal steps
        let pattern = if matches!(applied, Applied::Extrapolated) { 0 } else { (4.0 * random.next()) as usize };
        let told = random.next() < 0.5;
        Moved { applied, pattern: PATTERNS[pattern], mass, step, gap, acceleration, told }
    }

    /// Moves the mass by `count` steps. Returns the first step that was too long, and the first step with a warning.
    fn run<S: Scene>(&self, model: &AnyModel, count: usize) -> (Option<usize>, Option<usize>) {
        let Moved { applied, pattern, mass, step, gap, acceleration, told: is_told } = *self;
        choose(Choice { effective_mass: mass, ..choice(model, Surface::Dented, gap) });
        let (mut instance, mut random, contact) = (ready::<S>(), Random(7), S::contacts() - 1);
        let (mut speed, mut old, mut long, mut told) = (1.0, 0.0, None, None);
        for index in 0..count {
            let step = step * pattern.factor(index, &mut random);
            let [force, stiffness] = [Real::Force, Real::Stiffness].map(|output| instance.real((output, contact)));
            let is_long = force > 0.0 && step * step * stiffness / mass > 4.0;
            long = long.or(is_long.then_some(index));
            set_rate(&mut instance, contact, speed);
            if is_told && acceleration != 0.0 {
                instance.set_input_derivative((Real::IndentationRate, contact), 1, acceleration);
            }
            // an importer may add up the time, or multiply
            let time = if matches!(pattern, Pattern::Equal) { index as f64 * step } else { instance.time() };
            let found = stepped(&mut instance, time, step).filter(|told| *told != Told::Warned(Warning::Late));
            // a law may be so wide that it is refused, whatever the step
            if found == Some(Told::Refused) && long.is_none() {
                break;
            }
            told = told.or(found.map(|_| index));
            if let Some(Told::Warned(Warning::Unstable { step: of, mass: known })) = found {
                // by at most the largest ratio of two steps of a pattern
                let is_right =
                    if matches!(pattern, Pattern::Equal) { of == step } else { (of / step).ln().abs() < 2.2 };
                assert!(known == mass && is_right, "{self:?}: {of} s, {known} kg");
            }
            if found == Some(Told::Refused) {
                break;
            }
            let new = instance.real((Real::Force, contact));
            let force = match applied {
                Applied::New => new,
                Applied::Old => old,
                Applied::Mean => 0.5 * (new + old),
                Applied::Extrapolated => 1.5 * new - 0.5 * old,
                Applied::MeanForce => instance.real((Real::MeanForce, contact)),
            };
            speed += step * (acceleration - force / mass);
            old = new;
        }
        (long, told)
    }
}

#[test]
fn every_importer_with_steps_that_are_too_long_is_warned_within_three_steps() {
    let mut random = Random(41);
    let (mut cases, mut unstable) = (0, 0);
    for (name, model) in all_models(mild()) {
        for _ in 0..40 {
            let moved = Moved::any(&model, &mut random);
            let (long, told) = match moved.applied {
                Applied::MeanForce => moved.run::<WithMomentum>(&model, 60),
                // derivatives of several contacts are not watched
                Applied::Mean => Moved { told: false, ..moved }.run::<Several>(&model, 60),
                _ => moved.run::<One>(&model, 60),
            };
            cases += 1;
            match (long, told) {
                (None, None) => continue,
                (Some(long), Some(told)) if told >= long && told <= long + 3 => unstable += 1,
                // the bodies leave the range of the law before
                (Some(long), None) if long + 3 >= 60 => {}
                _ => panic!("{name}, {moved:?}: too long from step {long:?}, warned in {told:?}"),
            }
        }
    }
    assert!(2 * unstable > cases, "{unstable} of {cases} masters are unstable");
}

#[test]
fn a_prescribed_motion_never_causes_a_warning() {
    let mut random = Random(29);
    for (name, model) in all_models(mild()) {
        let stable = stable_step(&model, MASS);
        for factor in [1.0, 10.0, 1e3, 1e5] {
            let step = factor * stable;
            // in and out, by a few micrometres: held rates, ramps, waves and random motion
            let motions: [&mut dyn FnMut(usize) -> f64; 7] = [
                // one that slows down, by itself or in cycles, and one that reverses in each step
                &mut |count| 4e-6 * 0.9f64.powi(count as i32),
                &mut |count| 3e-6 * 0.99f64.powi(count as i32) * f64::cos(1.3 * count as f64),
                &mut |count| if count % 2 == 0 { 2e-6 } else { -2e-6 },
                &mut |count| if count % 10 < 5 { 2e-6 } else { -2e-6 },
                &mut |count| 1e-7 * (count % 40) as f64 - 2e-6,
                &mut |count| 3e-6 * f64::cos(0.3 * count as f64),
                &mut |_| 6e-6 * random.next() - 3e-6,
            ];
            for (kind, motion) in motions.into_iter().enumerate() {
                choose(choice(&model, Surface::Dented, 0.0));
                let mut instance = ready::<One>();
                for count in 0..300 {
                    set_rate(&mut instance, 0, motion(count) / step);
                    let time = instance.time();
                    let told = stepped(&mut instance, time, step);
                    // random motion may leave the range of a law
                    if told == Some(Told::Refused) {
                        break;
                    }
                    assert_eq!(told, None, "{name}, motion {kind}, {factor} stable steps, step {count}");
                }
            }
        }
    }
}

/// What an importer does with the outputs of a contact that knows no mass.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// It steps the contact first, and applies `force`.
    First,
    /// It sets the rate, reads `predicted_force`, and steps both.
    Predicted,
    /// It reads `predicted_force`, sets the rate, and steps both, as libcosim, Ecos and FMU containers do.
    ReadBefore,
    /// It applies `force` one step late.
    Late,
    /// It steps the contact first, and applies `predicted_force`.
    Early,
}

/// The rebound of 4 g at 1 m/s, and the warning.
fn rebound(way: Way, model: &AnyModel, step: f64, gap: f64) -> (f64, Option<Warning>) {
    choose(choice(model, Surface::Dented, gap));
    let mut instance = ready::<WithMomentum>();
    let (mut speed, mut told, mut touched) = (1.0, None, false);
    for _ in 0..100_000 {
        let read = |instance: &Instance<WithMomentum>, output| instance.real((output, 0));
        let (old, unset) = (read(&instance, Real::Force), read(&instance, Real::PredictedForce));
        set_rate(&mut instance, 0, speed);
        let predicted = read(&instance, Real::PredictedForce);
        let time = instance.time();
        instance.do_step(time, step).expect("within the range of the law");
        told = told.or(instance.take_deep().filter(|warning| !matches!(warning, Warning::Deep { .. })));
        let force = read(&instance, Real::Force);
        speed -= step / MASS
            * match way {
                Way::First => force,
                Way::Predicted => predicted,
                Way::ReadBefore => unset,
                Way::Late => old,
                Way::Early => read(&instance, Real::PredictedForce),
            };
        touched |= force > 0.0;
        if touched && force == 0.0 && speed < 0.0 {
            break;
        }
    }
    (-speed, told)
}

#[test]
fn a_force_that_comes_late_is_told_and_the_others_have_the_stated_errors() {
    let errors = |model: &AnyModel, way: Way, told: Option<Warning>| {
        let impact = predict(model, &Impact { mass: MASS, speed: 1.0 }).unwrap();
        let step = (impact.loading_time + impact.unloading_time) / 50.0;
        let errors = (0..8).map(|place| {
            let (speed, found) = rebound(way, model, step, (1.0 + (f64::from(place) + 0.5) / 8.0) * step);
            assert_eq!(found, told, "{way:?}, {place}");
            speed / impact.restitution - 1.0
        });
        let errors: Vec<f64> = errors.collect();
        let sum = |power: i32| errors.iter().map(|error| error.powi(power)).sum::<f64>() / errors.len() as f64;
        (sum(1), sum(2).sqrt())
    };
    let late = Some(Warning::Late);
    let ways =
        [(Way::First, None), (Way::Predicted, None), (Way::ReadBefore, None), (Way::Late, late), (Way::Early, None)];
    for (name, model) in all_models(mild()) {
        for (way, told) in ways {
            let (mean, size) = errors(&model, way, told);
            println!("{name}, {way:?}: {mean:.2e}, root mean square {size:.2e}");
            // the guide's numbers
            let allowed = match way {
                Way::First | Way::Predicted => 2e-3,
                Way::ReadBefore => 2e-2,
                Way::Late | Way::Early => 0.3,
            };
            assert!(size < allowed, "{name}, {way:?}: {size:e}");
        }
    }
}
