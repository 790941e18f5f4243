//! What a unit that moves its bodies notices of its master, and what can be set while it runs.

use crate::masters::{MASS, Master, PATTERNS, Parallel, Serial, WiredParallel, WiredSerial, choice};
use crate::physics::{Random, all_models, mild};
use crate::scenes::{Choice, Chosen, Massive, choose, ready, set_rate, words};
use brinell_contact::Surface;
use brinell_contact::impact::{Impact, predict};
use brinell_fmu::instance::{Fault, Instance, Warning};
use brinell_fmu::scene::{Coupled, Present, Real, Scene};

type SeveralWired = Chosen<Massive<Coupled<Present, Present, Present>>, 3, Present>;

/// The laws of the default scene, with a gap [m].
fn default_choice(gap: f64) -> Choice {
    let (_, model) = all_models(mild()).into_iter().find(|(name, _)| name == "big-alabo with contact-radius").unwrap();
    choice(&model, Surface::Dented, gap)
}

/// Lets `master` run for so many steps: whether the unit noticed anything.
fn notices<S: Scene>(master: &mut Master<S>, count: usize, mut step: impl FnMut(usize) -> f64) -> Option<Warning> {
    (0..count).find_map(|index| {
        master.step(step(index));
        master.instance.take_miswired()
    })
}

#[test]
fn a_master_of_the_other_order_of_execution_is_noticed_in_the_first_contact() {
    for (name, model) in all_models(mild()) {
        for size in [1e-6, 7e-6, 1e-4, 2e-3] {
            for pattern in PATTERNS {
                let choice = choice(&model, Surface::Dented, 0.4 * size);
                let mut random = Random(3);
                let mut steps = |index: usize| size * pattern.factor(index, &mut random);
                let what = format!("{name}, {size} s, {pattern:?}");
                let found = notices(&mut Master::<Serial>::new(choice, true, false, 1.0, 0.0), 1000, &mut steps);
                let Some(Warning::Miswired { parallel: false, .. }) = found else {
                    panic!("{what}: a serial unit in a parallel master: {found:?}")
                };
                let found = notices(&mut Master::<Parallel>::new(choice, false, false, 1.0, 0.0), 1000, &mut steps);
                let Some(Warning::Miswired { parallel: true, .. }) = found else {
                    panic!("{what}: a parallel unit in a serial master: {found:?}")
                };
            }
        }
    }
}

/// An importer with forces that the FMU does not know: constant and arbitrary, large and small.
fn with_untold_forces<S: Scene>(parallel: bool) {
    let mut random = Random(17);
    for size in [1e-6, 1e-5, 1e-4, 2e-3] {
        for other in [9.81, -30.0, 1e3, 1e5] {
            for varies in [false, true] {
                let mut master = Master::<S>::new(default_choice(0.0), parallel, false, 0.3, 0.0);
                for count in 0..3000 {
                    master.step(size);
                    let factor = if varies { 2.0 * random.next() - 1.0 } else { 1.0 };
                    master.speed += size * other * factor;
                    // it may be driven out of all range
                    if master.speed.abs() > 100.0 {
                        break;
                    }
                    let found = master.instance.take_miswired();
                    assert_eq!(
                        found, None,
                        "parallel {parallel}, {size} s, {other} m/s^2, varies {varies}, step {count}"
                    );
                }
            }
        }
    }
}

#[test]
fn forces_unknown_to_the_fmu_raise_no_false_alarm() {
    with_untold_forces::<Serial>(false);
    with_untold_forces::<Parallel>(true);
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
fn steps_of_any_length_in_any_order_leave_numbers() {
    let mut random = Random(23);
    for trial in 0..200 {
        let mut master = Master::<WiredParallel>::new(default_choice(1e-6), true, true, 1.0, 50.0);
        for _ in 0..60 {
            let exponent = if trial % 2 == 0 { -9.0 + 9.0 * random.next() } else { -50.0 + 51.0 * random.next() };
            let step = 10f64.powf(exponent);
            master.step(step);
            for output in KEPT {
                assert!(master.get(output).is_finite(), "trial {trial}, {step:e} s: {output:?}");
            }
        }
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
