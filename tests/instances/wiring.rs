//! What a unit that moves its bodies notices of its master, and what can be set while it runs.

use crate::physics::{AnyModel, Random, all_models, mild};
use crate::scenes::{Choice, choose, ready, set_rate};
use brinell_contact::Surface;
use brinell_fmu::instance::{Cause, Warning};
use brinell_fmu::scene::{Real, Scene};
use brinell_testing::masters::{MASS, Master, PATTERNS, Parallel, Pattern, Serial, WiredParallel, WiredSerial, choice};

/// The laws of the default scene, with a gap [m].
fn default_choice(gap: f64) -> Choice {
    let (_, model) = all_models(mild()).into_iter().find(|(name, _)| name == "big-alabo with contact-radius").unwrap();
    choice(&model, Surface::Dented, gap)
}

/// How an importer tells the FMU of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Told {
    Wired,
    Derivative,
    Not,
}

/// What an importer does, and the first impact in it.
#[derive(Clone, Copy, Debug)]
struct Row {
    parallel: bool,
    told: Told,
    gravity: f64,
    /// The part of the force that it applies.
    share: f64,
    size: f64,
    pattern: Pattern,
    speed: f64,
    /// Number of steps before the contact.
    flight: f64,
}

/// What else accelerates the bodies, without the FMU's knowledge.
#[derive(Clone, Copy, Debug)]
enum Disturbance {
    None,
    /// Forces that are switched, by up to a hundred thousand m/s^2.
    Switched,
    /// A spring of a thousand radians a second, and a damper.
    Spring,
    /// An importer that computes in single precision.
    Rounded,
}

impl Row {
    fn master<S: Scene>(&self, choice: Choice) -> Master<S> {
        let Row { parallel, told, gravity, share, speed, .. } = *self;
        let (told_of, untold) = if told == Told::Not { (0.0, gravity) } else { (gravity, 0.0) };
        let master = Master::<S>::new(choice, parallel, told == Told::Wired, speed, told_of);
        Master { untold, share, ..master }
    }

    fn choice(&self, model: &AnyModel) -> Choice {
        let fall = self.speed + 0.5 * self.gravity * self.size * self.flight;
        choice(model, Surface::Dented, fall * self.size * self.flight)
    }

    /// The first warning with its step, and the step with which the first impact is over: the bodies are apart and no force is left to
    /// apply.
    fn run<S: Scene>(&self, model: &AnyModel, count: usize, what: Disturbance) -> (Option<(usize, Warning)>, usize) {
        let mut master = self.master::<S>(self.choice(model));
        let (mut random, mut chance) = (Random(3), Random(29));
        let (mut found, mut touched, mut over, mut way) = (None, false, count, 0.0);
        for index in 0..count {
            let step = self.size * self.pattern.factor(index, &mut random);
            match what {
                Disturbance::None => {}
                Disturbance::Switched if chance.next() < 0.2 => {
                    master.untold = (2.0 * chance.next() - 1.0) * 10f64.powf(7.0 * chance.next() - 2.0);
                }
                Disturbance::Switched => {}
                Disturbance::Spring => {
                    way += step * master.speed;
                    master.untold = -1e6 * way - 100.0 * master.speed;
                }
                Disturbance::Rounded => master.speed = f64::from(master.speed as f32),
            }
            if master.speed.abs() > 100.0 {
                break;
            }
            master.step(step);
            found = found.or(master.instance.take_miswired().map(|warning| (index, warning)));
            let pushes = [Real::Force, Real::MeanForce].into_iter().any(|output| master.get(output) != 0.0);
            touched |= pushes;
            if touched && !pushes {
                over = over.min(index);
            }
            if found.is_some() {
                break;
            }
        }
        (found, over)
    }

    /// The same with the scene for this importer, or for the other order.
    fn run_with(
        &self,
        for_parallel: bool,
        model: &AnyModel,
        count: usize,
        what: Disturbance,
    ) -> (Option<(usize, Warning)>, usize) {
        match (for_parallel, self.told == Told::Wired) {
            (false, false) => self.run::<Serial>(model, count, what),
            (true, false) => self.run::<Parallel>(model, count, what),
            (false, true) => self.run::<WiredSerial>(model, count, what),
            (true, true) => self.run::<WiredParallel>(model, count, what),
        }
    }
}

/// Rows of every kind with a law each, whose bodies move on by the `share` of the force.
fn rows(share: f64, mut each: impl FnMut(Row, &AnyModel)) {
    let models: Vec<AnyModel> = all_models(mild()).into_iter().map(|(_, model)| model).collect();
    let mut count = 0;
    for parallel in [false, true] {
        for told in [Told::Wired, Told::Derivative, Told::Not] {
            for gravity in [0.0, 0.01, 9.81, 1000.0] {
                for size in [1e-6, 3e-6, 3e-5, 3e-4, 2e-3] {
                    for speed in [0.01, 1.0, 10.0] {
                        for flight in [0.0, 0.4, 3.3] {
                            count += 1;
                            let pattern = PATTERNS[count % PATTERNS.len()];
                            let model = &models[count % models.len()];
                            each(Row { parallel, told, gravity, share, size, pattern, speed, flight }, model);
                        }
                    }
                }
            }
        }
    }
}

const DISTURBANCES: [Disturbance; 4] =
    [Disturbance::None, Disturbance::Switched, Disturbance::Spring, Disturbance::Rounded];

#[test]
fn the_other_order_of_execution_is_told_and_the_right_one_raises_no_alarm_whatever_else_accelerates_the_bodies() {
    rows(1.0, |row, model| {
        for what in DISTURBANCES {
            let (found, _) = row.run_with(row.parallel, model, 300, what);
            assert_eq!(found, None, "{row:?}, {what:?}");
            // the momentum of a step is far above what the disturbance gives
            if !matches!(what, Disturbance::None) && (row.speed < 1.0 || row.size > 5e-6) {
                continue;
            }
            let (found, over) = row.run_with(!row.parallel, model, 400, what);
            let Some((index, Warning::Miswired { cause: Cause::Order { parallel }, .. })) = found else {
                panic!("{row:?}, {what:?}: {found:?}")
            };
            let in_time = !matches!(what, Disturbance::None) || index <= over + 1;
            assert!(parallel != row.parallel && in_time, "{row:?}, {what:?}: step {index} of {over}, {parallel}");
        }
    });
}

#[test]
fn an_importer_that_moves_another_mass_or_none_is_told_so_and_nothing_else() {
    for share in [0.0, 0.1, 0.5, 0.9, 2.0, 5.0] {
        rows(share, |row, model| {
            // in the other order, that is told first
            let orders = [false, true].into_iter().filter(|&order| share == 0.0 || order == row.parallel);
            for for_parallel in orders {
                let (found, _) = row.run_with(for_parallel, model, 300, Disturbance::None);
                let Some((_, Warning::Miswired { cause, .. })) = found else {
                    // a single change of the force tells no multiple
                    let may_hide = share != 0.0 && (row.flight < 1.0 || row.size > 1e-5 || row.speed < 1.0);
                    assert!(may_hide, "{row:?}, for_parallel {for_parallel}: {found:?}");
                    continue;
                };
                let is_told = match cause {
                    Cause::Unmoved => share == 0.0,
                    Cause::Mass { moved, known } => (known / moved / share - 1.0).abs() < 1e-2,
                    Cause::Order { .. } | Cause::Shared { .. } => false,
                };
                assert!(is_told, "{row:?}, for_parallel {for_parallel}: {cause:?}");
            }
        });
    }
}

#[test]
fn a_prescribed_motion_is_told_to_follow_no_force() {
    // in and out, at once or with ramps
    let held = |time: f64| if time < 1e-4 { 0.1 } else { -0.1 };
    let ramp = |time: f64| 0.1 - 1e3 * time;
    for motion in [&held as &dyn Fn(f64) -> f64, &ramp] {
        for size in [1e-7, 1e-6, 1e-5, 3e-5] {
            for parallel in [false, true] {
                let found = if parallel { follows::<Parallel>(motion, size) } else { follows::<Serial>(motion, size) };
                assert_eq!(found, Some(Cause::Unmoved), "{size} s, parallel {parallel}");
            }
        }
    }
}

/// What a scene says of a prescribed rate [m/s].
fn follows<S: Scene>(motion: &dyn Fn(f64) -> f64, size: f64) -> Option<Cause> {
    choose(default_choice(0.0));
    let mut instance = ready::<S>();
    (0..1000).find_map(|index| {
        let time = f64::from(index) * size;
        set_rate(&mut instance, 0, motion(time).max(-0.1));
        let now = instance.time();
        instance.do_step(now, size).unwrap();
        instance.take_miswired().map(|warning| match warning {
            Warning::Miswired { cause, .. } => cause,
            other => panic!("{other:?}"),
        })
    })
}

/// The outputs that a change of mass must leave as they are.
const KEPT: [Real; 9] = [
    Real::Force,
    Real::Indentation,
    Real::MaxIndentation,
    Real::Work,
    Real::ElasticEnergy,
    Real::DissipatedEnergy,
    Real::Impulse,
    Real::MeanForce,
    Real::ClosingSpeed,
];

#[test]
fn another_mass_between_steps_changes_only_what_follows() {
    let mut master = Master::<WiredParallel>::new(default_choice(0.0), true, true, 1.0, 0.0);
    for count in 0..40 {
        let kept = KEPT.map(|output| master.get(output));
        master.mass = MASS * (1.0 + 0.5 * f64::sin(0.4 * f64::from(count)));
        master.instance.set_real((Real::EffectiveMass, 0), master.mass);
        assert_eq!(KEPT.map(|output| master.get(output)), kept, "the change itself has done something");
        assert_eq!(master.get(Real::EffectiveMass), master.mass);
        master.step(3e-6);
    }
}

#[test]
fn a_debt_is_paid_whatever_the_pattern_of_steps_up_to_one_in_eight() {
    for short in 1..16 {
        for ratio in [2.0, 5.0, 8.0] {
            let mut master = Master::<Parallel>::new(default_choice(0.0), true, false, 1.0, 0.0);
            let mut count = 0;
            while !master.has_parted() {
                master.step(1e-5 * if count % (short + 1) == short { ratio } else { 1.0 });
                count += 1;
                assert!(count < 1000, "{short} short steps and one {ratio} times as long: the debt isn't paid");
            }
        }
    }
}
