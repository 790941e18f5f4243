//! What a unit that moves its bodies notices of its master, and what can be set while it runs.

use crate::masters::{MASS, Master, PATTERNS, Parallel, Pattern, Serial, WiredParallel, WiredSerial, choice};
use crate::physics::{AnyModel, Random, all_models, mild};
use crate::scenes::{Choice, Chosen, Massive, choose, ready, set_rate, words};
use brinell_contact::Surface;
use brinell_contact::impact::{Impact, predict};
use brinell_fmu::instance::{Cause, Fault, Instance, Warning};
use brinell_fmu::scene::{Coupled, Present, Real, Scene};

type SeveralWired = Chosen<Massive<Coupled<Present, Present, Present>>, 3, Present>;

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

#[test]
fn the_other_order_of_execution_is_told_within_the_first_impact_whatever_else_accelerates_the_bodies() {
    rows(1.0, |row, model| {
        let (found, over) = row.run_with(!row.parallel, model, 400, Disturbance::None);
        let Some((index, Warning::Miswired { cause: Cause::Order { parallel }, .. })) = found else {
            panic!("{row:?}: {found:?}")
        };
        assert!(parallel != row.parallel && index <= over + 1, "{row:?}: step {index} of {over}, {parallel}");
    });
}

#[test]
fn the_right_order_of_execution_raises_no_alarm_whatever_else_accelerates_the_bodies() {
    rows(1.0, |row, model| {
        for what in [Disturbance::None, Disturbance::Switched, Disturbance::Spring, Disturbance::Rounded] {
            let (found, _) = row.run_with(row.parallel, model, 300, what);
            assert_eq!(found, None, "{row:?}, {what:?}");
        }
    });
}

#[test]
fn a_spring_switched_forces_and_single_precision_hide_no_wrong_order() {
    for what in [Disturbance::Switched, Disturbance::Spring, Disturbance::Rounded] {
        rows(1.0, |row, model| {
            // the momentum of a step is far above what the disturbance gives
            if row.speed < 1.0 || row.size > 5e-6 {
                return;
            }
            let (found, _) = row.run_with(!row.parallel, model, 400, what);
            let Some((_, Warning::Miswired { cause: Cause::Order { parallel }, .. })) = found else {
                panic!("{row:?}, {what:?}: {found:?}")
            };
            assert!(parallel != row.parallel, "{row:?}, {what:?}");
        });
    }
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

/// Reset, and states of another moment, in the middle of contacts.
fn with_resets_and_states<S: Scene>(parallel: bool, wired: bool) {
    for size in [1e-6, 5e-6, 2e-3] {
        let mut master = Master::<S>::new(default_choice(0.0), parallel, wired, 1.0, 9.81);
        let saved_at = if size > 1e-4 { 1 } else { 4 };
        let mut saved = None;
        for count in 0..12 {
            if count == saved_at {
                saved = Some((words(&master.instance), master.speed));
            }
            master.step(size);
            assert_eq!(master.instance.take_miswired(), None);
        }
        let end = KEPT.map(|output| master.get(output).to_bits());
        let (state, speed) = saved.unwrap();
        let bytes: Vec<[u8; 8]> = state.iter().map(|word| word.to_le_bytes()).collect();
        for fresh in [false, true] {
            if fresh {
                master.instance = ready::<S>();
            }
            assert!(master.instance.load(&bytes));
            master.speed = speed;
            for _ in saved_at..12 {
                master.step(size);
                assert_eq!(master.instance.take_miswired(), None, "{size} s, restored");
            }
            assert_eq!(KEPT.map(|output| master.get(output).to_bits()), end, "{size} s: other bits than before");
        }
        master.instance.reset().unwrap();
        master.instance.set_experiment(0.0, None).unwrap();
        master.instance.enter_initialization().unwrap();
        master.instance.exit_initialization().unwrap();
        master.speed = 0.4;
        for _ in 0..12 {
            master.step(size);
            assert_eq!(master.instance.take_miswired(), None, "{size} s, after a reset");
        }
    }
}

#[test]
fn resets_and_restored_states_raise_no_false_alarm_and_go_on_with_the_same_bits() {
    with_resets_and_states::<Serial>(false, false);
    with_resets_and_states::<Parallel>(true, false);
    with_resets_and_states::<WiredSerial>(false, true);
    with_resets_and_states::<WiredParallel>(true, true);
}

#[test]
fn every_contact_of_several_keeps_its_own_account_and_mass() {
    for size in [1e-6, 2e-5, 1e-3] {
        let choice = default_choice(0.0);
        choose(choice);
        let mut several = ready::<SeveralWired>();
        let masses = [4e-3, 1e-2, 7e-4];
        let (mut speeds, speed) = ([1.0, 0.5, 3.0], [1.0, 0.5, 3.0]);
        for _ in 0..10_000 {
            let forces = [0, 1, 2].map(|contact| several.real((Real::MeanForce, contact)));
            for contact in 0..3 {
                several.set_real((Real::EffectiveMass, contact), masses[contact]);
                set_rate(&mut several, contact, speeds[contact]);
                speeds[contact] -= size * forces[contact] / masses[contact];
            }
            let time = several.time();
            several.do_step(time, size).unwrap();
            assert_eq!(several.take_miswired(), None);
            let reached = [0, 1, 2].map(|contact| several.real((Real::ClosingSpeed, contact)));
            let close = |contact: usize| (speeds[contact] - reached[contact]).abs() < 1e-13;
            if reached.iter().all(|&speed| speed < 0.0) && (0..3).all(close) {
                break;
            }
        }
        for contact in 0..3 {
            let impact = Impact { mass: masses[contact], speed: speed[contact] };
            // the target of each is stiffer than the last by a tenth
            let mut model =
                all_models(mild()).into_iter().find(|(name, _)| name == "big-alabo with contact-radius").unwrap().1;
            let factor = 1.1f64.powi(contact as i32);
            model.pair.modulus *= factor;
            model.pair.youngs_modulus *= factor;
            let expected = predict(&model, &impact).unwrap().restitution;
            let error = -speeds[contact] / speed[contact] / expected - 1.0;
            assert!(error.abs() < 1e-11, "contact {contact}, {size} s: {error:e}");
        }
    }
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
    for parallel in [false, true] {
        if parallel { change_mass::<WiredParallel>(parallel) } else { change_mass::<WiredSerial>(parallel) }
    }
}

fn change_mass<S: Scene>(parallel: bool) {
    let step = 3e-6;
    let mut master = Master::<S>::new(default_choice(0.0), parallel, true, 1.0, 0.0);
    let mut before = (0.0, 0.0);
    for count in 0..40 {
        let kept = KEPT.map(|output| master.get(output));
        master.mass = MASS * (1.0 + 0.5 * f64::sin(0.4 * f64::from(count)));
        master.instance.set_real((Real::EffectiveMass, 0), master.mass);
        assert_eq!(KEPT.map(|output| master.get(output)), kept, "the change itself has done something");
        assert_eq!(master.get(Real::EffectiveMass), master.mass);
        // momentum and energy of the step, by the mass that it is made with
        let start = if parallel { before.0 } else { master.speed };
        let (work, impulse) = (master.get(Real::Work), master.get(Real::Impulse));
        let start = if count == 0 { 1.0 } else { start };
        master.step(step);
        let end = master.get(Real::ClosingSpeed);
        if !parallel {
            let given = master.get(Real::Impulse) - impulse;
            assert!((master.mass * (start - end) - given).abs() < 1e-15 * MASS, "step {count}");
            let done = master.get(Real::Work) - work;
            let taken = 0.5 * master.mass * (start * start - end * end);
            assert!((taken - done).abs() < 1e-14 * MASS, "step {count}: {taken:e} and {done:e}");
        }
        before = (end, 0.0);
    }
}

#[test]
fn inputs_are_checked_by_name_and_derivatives_are_refused_with_them() {
    choose(default_choice(0.0));
    let mut instance: Instance<WiredSerial> = ready();
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e31, 1e-31] {
        let refused = instance.check_real((Real::EffectiveMass, 0), mass);
        assert!(matches!(refused, Err(Fault::InputOutOfRange { value: told, .. }) if told.to_bits() == mass.to_bits()));
    }
    for acceleration in [f64::NAN, f64::INFINITY] {
        let refused = instance.check_real((Real::ExternalAcceleration, 0), acceleration);
        assert!(matches!(refused, Err(Fault::NotFinite { name: "external_acceleration", .. })));
    }
    for acceleration in [-1.0001e40, 1e305] {
        let refused = instance.check_real((Real::ExternalAcceleration, 0), acceleration);
        let (name, unit) = ("external_acceleration", "m/s^2");
        assert_eq!(refused, Err(Fault::AccelerationOutOfRange { name, unit, value: acceleration }));
    }
    let derivative = instance.check_input_derivative((Real::IndentationRate, 0), 1, 9.81);
    assert_eq!(derivative, Err(Fault::NoInputDerivatives));
    instance.set_real((Real::ExternalAcceleration, 0), -3.5);
    assert_eq!(instance.real((Real::ExternalAcceleration, 0)), -3.5);
    // and a scene without them has none
    let plain: Instance<Serial> = ready();
    for input in [Real::EffectiveMass, Real::ExternalAcceleration] {
        assert_eq!(plain.check_real((input, 0), 1.0), Err(Fault::NotSettable));
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
