//! Instances of one contact, of several, of rate-dependent laws and of known mass, as ordinary values: no export, no C.
//!
//! The same tests run under the address sanitizer, see `tests/c_functions.rs`.

mod damped_motion;
mod derivatives;
mod extreme_inputs;
mod friction;
mod hostile_states;
mod input_derivatives;
mod orders_of_execution;
mod passivity_guard;
mod rate_unit;
mod saved_words;
mod smallest_gaps;
mod stability_warning;
mod wiring;

use brinell_contact::Contact;
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_contact::unloading::AnyUnloading;
use brinell_fmu::instance::{FASTEST, Fault, Instance, LATEST, Phase, Plain, SHORTEST};
use brinell_fmu::scene::{Coupled, Present, Real, Scene};
use brinell_testing::{masters, physics, scenes};
use brinell_unit::known::Exported;
use physics::{Random, all_models, mild};
use scenes::{
    Choice, Chosen, Damped, Elastoplastic, Frictional, FrictionalPlane, Massive, OUTPUTS, choose, outputs, ready,
    set_rate, set_tangential_rate, words,
};

type One = Chosen<Elastoplastic, 1, Present>;
type Several = Chosen<Elastoplastic, 5, Present>;
type DampedOne = Chosen<Damped, 1, Present>;
type DampedSeveral = Chosen<Damped, 3, Present>;
type FrictionalOne = Chosen<Frictional, 1, Present>;
type FrictionalSeveral = Chosen<Frictional, 3, Present>;
type RoughPlaneOne = Chosen<FrictionalPlane, 1, Present>;
type RoughPlaneSeveral = Chosen<FrictionalPlane, 3, Present>;
type MassiveOne = Chosen<Massive, 1, Present>;
type MassiveSeveral = Chosen<Massive, 2, Present>;
type ParallelOne = Chosen<Massive<Coupled<Present>>, 1, Present>;
type WiredSeveral = Chosen<Massive<Coupled<Present, Present, Present>>, 2, Present>;

/// The target of the losses: steel.
const TARGET: Solid = Solid { density: 7850.0, youngs_modulus: 206e9, poissons_ratio: 0.3 };

/// Every loss; a thin plate makes the motion stiff.
const LOSSES: [AnyLoss; 4] = [
    AnyLoss::RestitutionFitted(RestitutionFitted { restitution: 0.9 }),
    AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target: TARGET }),
    AnyLoss::Plate(Plate { target: TARGET, thickness: 0.01 }),
    AnyLoss::Plate(Plate { target: TARGET, thickness: 1e-3 }),
];

/// Length of the steps [s].
const STEP: f64 = 1e-6;

/// Every pairing of laws on the bodies of the default scene.
fn every_pairing() -> Vec<(String, Choice)> {
    let models = all_models(mild());
    models.into_iter().map(|(name, model)| (name, Choice::of(model.loading, model.unloading))).collect()
}

/// Some pairings: all kinds of branches, and laws without segments.
fn some_pairings() -> Vec<(String, Choice)> {
    let wanted =
        ["big-alabo with contact-radius", "brinell with brinell", "jackson-green with jackson", "luding with luding"];
    every_pairing().into_iter().filter(|(name, _)| wanted.contains(&name.as_str())).collect()
}

/// Moves all contacts through yield, reversal, flight and new contacts, and returns their outputs after each step.
fn drive<S: Scene>(instance: &mut Instance<S>, steps: usize, seed: u64) -> Vec<f64> {
    let mut random = Random(seed);
    let mut shown = Vec::new();
    for _ in 0..steps {
        for contact in 0..S::contacts() {
            set_rate(instance, contact, 4.0 * random.next() - 1.9);
            if S::Contact::HAS_FRICTION {
                set_tangential_rate(instance, contact, 2.0 * random.next() - 0.9);
            }
        }
        let time = instance.time();
        instance.do_step(time, STEP).expect("within the range of the law");
        shown.extend(outputs(instance));
    }
    shown
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// Every kind of instance has finite outputs, and the same ones from a copy, from words and after a reset.
fn behaves<S: Scene>(name: &str) {
    let mut instance = ready::<S>();
    let first = drive(&mut instance, 40, 7);
    assert!(first.iter().all(|number| number.is_finite()), "{name}");
    let saved = words(&instance);
    let bytes: Vec<[u8; 8]> = saved.iter().map(|word| word.to_le_bytes()).collect();
    let mut copy = ready::<S>();
    copy.copy(&instance);
    let mut restored = ready::<S>();
    assert!(restored.load(&bytes), "{name}: its own words are refused");
    assert_eq!(words(&restored), saved, "{name}: equal instances have equal words");
    let on = drive(&mut instance, 40, 8);
    assert_eq!(bits(&drive(&mut copy, 40, 8)), bits(&on), "{name}: from a copy");
    assert_eq!(bits(&drive(&mut restored, 40, 8)), bits(&on), "{name}: from words");
    instance.reset().unwrap();
    assert_eq!(instance.phase(), Phase::Instantiated);
    instance.set_experiment(0.0, None).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    assert_eq!(bits(&drive(&mut instance, 40, 7)), bits(&first), "{name}: after a reset");
}

#[test]
fn instances_of_every_kind_run_copy_save_and_reset_to_the_bit() {
    for (name, choice) in some_pairings() {
        choose(choice);
        behaves::<One>(&name);
        behaves::<Several>(&name);
        behaves::<MassiveOne>(&name);
        behaves::<MassiveSeveral>(&name);
        behaves::<ParallelOne>(&name);
        behaves::<WiredSeveral>(&name);
        behaves::<FrictionalOne>(&name);
        behaves::<FrictionalSeveral>(&name);
        behaves::<RoughPlaneOne>(&name);
        behaves::<RoughPlaneSeveral>(&name);
    }
    for (name, damped) in AnyDamped::ALL {
        choose(Choice { damped, ..some_pairings()[0].1 });
        behaves::<DampedOne>(name);
        behaves::<DampedSeveral>(name);
    }
    behaves::<Exported>("the default scene");
}

#[test]
fn a_contact_among_several_does_what_it_does_alone() {
    for (name, choice) in some_pairings() {
        choose(choice);
        let mut several = ready::<Several>();
        let mut one = ready::<One>();
        let mut random = Random(3);
        for step in 0..60 {
            let rate = 4.0 * random.next() - 1.9;
            set_rate(&mut several, 0, rate);
            (1..5).for_each(|contact| set_rate(&mut several, contact, random.next()));
            set_rate(&mut one, 0, rate);
            let (time, other) = (several.time(), one.time());
            several.do_step(time, STEP).unwrap();
            one.do_step(other, STEP).unwrap();
            for output in OUTPUTS {
                let (own, alone) = (several.real((output, 0)), one.real((output, 0)));
                assert_eq!(own.to_bits(), alone.to_bits(), "{name}, {output:?} in step {step}: {own} and {alone}");
            }
        }
    }
}

/// The look-ahead once assumed that only a rate above 1e40 m/s can fail; fitted laws can fail too.
#[test]
fn a_refused_step_of_several_contacts_moves_none_of_them() {
    let pairings = every_pairing();
    let (_, choice) = pairings.iter().find(|(name, _)| name == "jackson-green with jackson").unwrap();
    // each following target is stiffer by a tenth: the fit ends earlier for the first ones
    choose(Choice { youngs_modulus: 91e9, yield_strength: 1e11, radius: 5e-3, ..*choice });
    let mut instance = ready::<Several>();
    (0..5).for_each(|contact| set_rate(&mut instance, contact, 1.0));
    instance.do_step(0.0, 1e-6).unwrap();
    let before = words(&instance);
    let time = instance.time();
    // the other order: the last contact fails
    (0..4).for_each(|contact| set_rate(&mut instance, contact, 1e-6));
    let moved = words(&instance);
    let refused = instance.do_step(time, 1.0).unwrap_err();
    assert!(matches!(refused, Fault::TooDeep { contact: 4, .. }), "{refused:?}");
    assert_eq!(words(&instance), moved);
    (0..4).for_each(|contact| set_rate(&mut instance, contact, 1.0));
    assert_ne!(instance.do_plain_step(time, 1.0), Plain::Done, "a refused step is not plain");
    assert_eq!(words(&instance), before);
    assert!(matches!(instance.do_step(time, 1.0), Err(Fault::TooDeep { contact: 0, .. })));
    assert_eq!(words(&instance), before);
}

/// A ball of 5 mm on a plane, on larger and smaller balls, and in sockets that hardly differ from it.
#[test]
fn a_wide_contact_is_told_at_three_tenths_of_the_smaller_radius_and_refused_at_that_radius() {
    for target in [f64::INFINITY, 2e-2, 1e-3, -1.0, -6e-3, -5.1e-3] {
        for (name, choice) in some_pairings() {
            choose(Choice { target_radius: target, ..choice });
            let effective = choice.radius / (1.0 + choice.radius / target);
            let size = choice.radius.min(target.abs());
            widen::<One>(&name, effective, size);
            widen::<Several>(&name, effective, size);
            widen::<FrictionalOne>(&name, effective, size);
        }
    }
}

/// Presses the first contact in, until it is refused.
fn widen<S: Scene>(name: &str, effective: f64, size: f64) {
    let limit = 0.3 * effective.min(size);
    let width = |instance: &Instance<S>| instance.real((Real::ContactRadius, 0));
    // as an importer does: warnings are taken after each step
    let step = |instance: &mut Instance<S>, by: f64| {
        let time = instance.time();
        let done = instance.do_step(time, by);
        (done, instance.take_deep())
    };
    let mut instance = ready::<S>();
    let mut before = 0.0;
    set_rate(&mut instance, 0, 1.0);
    let told = (0..20_000).any(|_| {
        before = width(&instance);
        let (done, warning) = step(&mut instance, 1e-3 * limit);
        done.unwrap();
        warning.is_some()
    });
    let what = format!("{name} with {size} m: told between {before:e} and {:e} m", width(&instance));
    assert!(told && before < limit && width(&instance) >= limit, "{what}, not at {limit:e} m");
    let depth = instance.real((Real::Indentation, 0));
    let refused = (0..20_000).find_map(|_| {
        let (state, now) = (words(&instance), width(&instance));
        match step(&mut instance, 0.02 * depth) {
            (Ok(()), None) => {
                before = now;
                None
            }
            (Err(fault), None) => Some((state, fault)),
            (_, warning) => panic!("{name} with {size} m: {warning:?} again"),
        }
    });
    let Some((state, fault)) = refused else { panic!("{name} with {size} m: {:e} m is not refused", width(&instance)) };
    assert_eq!(fault, Fault::TooWide { contact: 0, size }, "{name}");
    let what = format!("{name} with {size} m: refused between {before:e} and {:e} m", width(&instance));
    assert!(before < size && width(&instance) >= size * (1.0 - 1e-12), "{what}");
    assert_eq!(words(&instance), state, "{name}: a refused step changes nothing");
    // nor does a copy go on, nor the same state from its words
    let time = instance.time();
    assert_ne!(instance.do_plain_step(time, 1e-9), Plain::Done);
    let mut copy = ready::<S>();
    copy.copy(&instance);
    assert_eq!(step(&mut copy, 1e-9).0, Err(fault), "{name}: a copy");
    let bytes: Vec<_> = state.iter().map(|word| word.to_le_bytes()).collect();
    assert!(copy.load(&bytes), "{name}: a state");
    assert_eq!(step(&mut copy, 1e-9).0, Err(fault), "{name}: from words");
    // a state from before goes on
    copy.copy(&ready::<S>());
    assert_eq!(step(&mut copy, 1e-9), (Ok(()), None), "{name}: another state");
    instance.reset().unwrap();
    assert_eq!(instance.phase(), Phase::Instantiated);
}

#[test]
fn unreasonable_rates_and_times_are_refused_by_name() {
    choose(some_pairings()[0].1);
    let mut instance = ready::<One>();
    for rate in [1.1 * FASTEST, -1e300, f64::MAX] {
        let refused = instance.check_real((Real::IndentationRate, 0), rate).unwrap_err();
        assert_eq!(refused, Fault::RateOutOfRange { rate });
    }
    for rate in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(instance.check_real((Real::IndentationRate, 0), rate), Err(Fault::NotFinite { .. })));
    }
    for step in [f64::INFINITY, f64::NAN, 0.0, -1.0, 5e-324, SHORTEST] {
        assert_ne!(instance.do_plain_step(0.0, step), Plain::Done, "{step}");
        assert!(matches!(instance.do_step(0.0, step), Err(Fault::StepSize { .. })), "{step}");
    }
    for step in [1.1 * LATEST, 1e306] {
        assert_ne!(instance.do_plain_step(0.0, step), Plain::Done, "{step}");
        assert_eq!(instance.do_step(0.0, step), Err(Fault::TooLate { end: step }));
    }
    let mut made = Instance::<One>::new().unwrap();
    for start in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, -f64::MAX, 1.1 * LATEST, -1.1 * LATEST] {
        assert!(matches!(made.set_experiment(start, None), Err(Fault::Experiment { .. })), "{start}");
    }
    // a start time of -DBL_MAX once allowed a step in Initialization Mode
    for start in [0.0, -LATEST, LATEST] {
        let mut made = Instance::<One>::new().unwrap();
        made.set_experiment(start, None).unwrap();
        made.enter_initialization().unwrap();
        for step in [1e-6, 1e40, f64::INFINITY] {
            assert_ne!(made.do_plain_step(start, step), Plain::Done, "{start} {step}");
            assert_ne!(made.do_plain_step(-f64::MAX, step), Plain::Done, "{start} {step}");
            assert_ne!(made.do_plain_step(f64::NEG_INFINITY, step), Plain::Done, "{start} {step}");
        }
    }
}

#[test]
fn the_fastest_rates_over_the_longest_steps_give_finite_outputs_or_are_refused() {
    for (name, choice) in every_pairing() {
        choose(choice);
        for rate in [FASTEST, -FASTEST, 1e-300, -1e-300, 5e-324, 1e20] {
            for step in [SHORTEST.next_up(), 1e-6, 1e9, 1e49] {
                let mut instance = ready::<One>();
                set_rate(&mut instance, 0, rate);
                for _ in 0..2 {
                    let before = words(&instance);
                    let time = instance.time();
                    match instance.do_step(time, step) {
                        Ok(()) => {}
                        Err(_) => assert_eq!(words(&instance), before, "{name}: {rate} over {step}"),
                    }
                    let shown = outputs(&instance);
                    assert!(shown.iter().all(|number| number.is_finite()), "{name}: {rate} over {step}: {shown:?}");
                }
            }
        }
    }
}

#[test]
fn states_of_parameters_that_do_not_fit_come_back_from_their_own_words() {
    choose(some_pairings()[0].1);
    let mut instance = Instance::<One>::new().unwrap();
    // the socket has a radius of 1 km
    instance.set_real((Real::Parameter(0), 0), 2e3);
    instance.parameters_are_set();
    let saved = words(&instance);
    let bytes: Vec<[u8; 8]> = saved.iter().map(|word| word.to_le_bytes()).collect();
    let mut restored = Instance::<One>::new().unwrap();
    assert!(restored.load(&bytes), "its own words are refused");
    assert_eq!(words(&restored), saved);
    assert_eq!(bits(&outputs(&restored)), bits(&outputs(&instance)));
    // the bodies from before are a radius and a modulus, after phase, flags, three times and three values
    for (word, number) in [8, 9].into_iter().flat_map(|word| [0.0, -0.0, -5e-3, f64::NAN].map(|number| (word, number)))
    {
        let mut bytes = bytes.clone();
        assert!(f64::from_bits(saved[word]) > 0.0);
        bytes[word] = number.to_le_bytes();
        assert!(!Instance::<One>::new().unwrap().load(&bytes), "{number} in word {word}");
    }
    restored.set_experiment(0.0, None).unwrap();
    restored.enter_initialization().unwrap();
    assert!(matches!(restored.exit_initialization(), Err(Fault::NoPointContact { .. })));
    restored.fail();
    let failed = words(&restored);
    let bytes: Vec<[u8; 8]> = failed.iter().map(|word| word.to_le_bytes()).collect();
    let mut again = Instance::<One>::new().unwrap();
    assert!(again.load(&bytes), "in the error state, too");
    // but no simulation continues with such bodies
    let mut ready_words = words(&ready::<One>());
    ready_words[5] = 2e3f64.to_bits();
    let bytes: Vec<[u8; 8]> = ready_words.iter().map(|word| word.to_le_bytes()).collect();
    assert!(!again.load(&bytes));
}

/// Stale derivatives of an input were once saved with states that have none.
#[test]
fn equal_states_have_equal_words_whatever_came_before() {
    choose(some_pairings()[0].1);
    let mut curved = ready::<Several>();
    let plain = ready::<Several>();
    curved.set_input_derivative((Real::IndentationRate, 2), 1, -3e4);
    set_rate(&mut curved, 2, 1.0);
    curved.do_step(0.0, STEP).unwrap();
    curved.copy(&plain);
    assert_eq!(words(&curved), words(&plain));
}

/// A contact that was touched at almost zero speed once had an infinite damping.
#[test]
fn a_rate_dependent_contact_can_be_touched_at_next_to_no_speed() {
    for (name, damped) in AnyDamped::ALL {
        for rate in [1e-300, 1e-200, 1e-100, 1e-30] {
            choose(Choice { damped, ..some_pairings()[0].1 });
            let mut instance = ready::<DampedOne>();
            set_rate(&mut instance, 0, rate);
            // indentation of one micrometre
            instance.do_step(0.0, if rate > 1e-50 { 1e-6 / rate } else { 1e49 }).unwrap_or_else(|fault| {
                panic!("{name} at {rate} m/s: {fault:?}");
            });
            let shown = outputs(&instance);
            assert!(shown.iter().all(|number| number.is_finite()), "{name} at {rate} m/s: {shown:?}");
        }
    }
}

/// The laws of a scene that is read from memory equal those of a scene of constants, bit for bit.
#[test]
fn a_scene_from_memory_does_what_one_of_constants_does() {
    let (_, loading) = AnyLoading::ALL.into_iter().find(|(name, _)| *name == "big-alabo").unwrap();
    let (_, unloading) = AnyUnloading::ALL.into_iter().find(|(name, _)| *name == "contact-radius").unwrap();
    choose(Choice { target_radius: f64::INFINITY, ..Choice::of(loading, unloading) });
    let (mut constants, mut memory) = (ready::<Exported>(), ready::<One>());
    let mut random = Random(5);
    for _ in 0..300 {
        let rate = 4.0 * random.next() - 1.9;
        set_rate(&mut constants, 0, rate);
        set_rate(&mut memory, 0, rate);
        let time = constants.time();
        constants.do_step(time, STEP).unwrap();
        memory.do_step(time, STEP).unwrap();
        for output in [Real::Force, Real::Indentation, Real::ResidualIndentation, Real::DissipatedEnergy] {
            assert_eq!(constants.real((output, 0)).to_bits(), memory.real((output, 0)).to_bits(), "{output:?}");
        }
    }
}
