//! Inputs of any size, to the ends of the numbers, in every kind of instance: a value is refused, or everything stays finite.

use crate::physics::{Random, all_models, mild};
use crate::scenes::{
    Choice, Chosen, Damped, DampedMassive, Elastoplastic, Frictional, FrictionalPlane, Lossy, LossyMassive, Massive,
    OUTPUTS, Rated, choose, outputs, words,
};
use crate::{AnyDamped, LOSSES};
use brinell_contact::Surface;
use brinell_fmu::instance::{Fault, Instance, Phase};
use brinell_fmu::scene::{Coupled, Present, Real, Scene};

/// All inputs, and parameters.
const INPUTS: [Real; 9] = [
    Real::IndentationRate,
    Real::TangentialRate,
    Real::SecondTangentialRate,
    Real::EffectiveMass,
    Real::ExternalAcceleration,
    Real::ExternalTangentialAcceleration,
    Real::Parameter(0),
    Real::Parameter(1),
    Real::Parameter(2),
];

/// Any double: a third of them as in a simulation, the others of any size and with both signs.
fn any(random: &mut Random, usual: f64) -> f64 {
    let size = match random.next() {
        part if part < 0.33 => usual * random.log_uniform(0.1, 10.0),
        part if part < 0.4 => [0.0, f64::from_bits(1), f64::MIN_POSITIVE, f64::MAX][(4.0 * random.next()) as usize % 4],
        _ => 2f64.powf(2098.0 * random.next() - 1074.0),
    };
    if random.next() < 0.7 { size } else { -size }
}

/// Sets what is allowed, and steps. Returns the number of steps that were done.
fn run<S: Scene>(name: &str, seed: u64) -> usize {
    let (mut random, mut done) = (Random(seed), 0);
    for _ in 0..6 {
        let mut instance = Instance::<S>::new().expect("the bodies fit");
        let set = |instance: &mut Instance<S>, random: &mut Random| {
            for contact in 0..S::contacts() {
                let input = INPUTS[(random.next() * 9.0) as usize % 9];
                let usual = match input {
                    Real::EffectiveMass => 4e-3,
                    Real::Parameter(0) => 5e-3,
                    Real::Parameter(1) => 3e8,
                    Real::Parameter(_) => 1e-6,
                    _ => 1.0,
                };
                let value = any(random, usual);
                if instance.check_real((input, contact), value).is_ok() && instance.set_real((input, contact), value) {
                    instance.parameters_are_set();
                }
                let (input, order, slope) =
                    (INPUTS[(random.next() * 3.0) as usize % 3], 1 + (2.0 * random.next()) as i32, any(random, 1e5));
                if random.next() < 0.3 && instance.check_input_derivative((input, contact), order, slope).is_ok() {
                    instance.set_input_derivative((input, contact), order, slope);
                }
            }
        };
        set(&mut instance, &mut random);
        instance.set_experiment(0.0, None).expect("zero is a time");
        instance.enter_initialization().expect("there is a start time");
        (0..3).for_each(|_| set(&mut instance, &mut random));
        if instance.exit_initialization().is_err() {
            continue;
        }
        for _ in 0..8 {
            set(&mut instance, &mut random);
            let (before, time, step) = (words(&instance), instance.time(), any(&mut random, 1e-5));
            match instance.do_step(time, step) {
                Ok(()) => done += 1,
                Err(_) => {
                    // a refused step changes no contact, and the state before can be restored
                    let bytes: Vec<_> = before.iter().map(|word| word.to_le_bytes()).collect();
                    assert!(instance.load(&bytes), "{name}: the state before a refused step can't be restored");
                }
            }
            let all = outputs(&instance);
            assert!(all.iter().all(|value| value.is_finite()), "{name} at step {step:e}: {all:?}");
            for (output, contact) in
                OUTPUTS.into_iter().flat_map(|output| (0..S::contacts()).map(move |contact| (output, contact)))
            {
                if let Ok(derivative) = instance.output_derivative((output, contact), 1) {
                    assert!(derivative.is_finite(), "{name}: {output:?}");
                }
            }
            let saved: Vec<_> = words(&instance).iter().map(|word| word.to_le_bytes()).collect();
            let mut other = Instance::<S>::new().expect("the bodies fit");
            assert!(other.load(&saved) && outputs(&other) == all, "{name}: a saved state can't be restored");
        }
    }
    done
}

#[test]
fn inputs_of_any_size_are_refused_or_leave_everything_finite() {
    type Inputs = Coupled<Present, Present, Present>;
    let mut done = 0;
    for (index, (name, model)) in all_models(mild()).into_iter().step_by(4).enumerate() {
        let seed = index as u64;
        let loss = LOSSES[index % LOSSES.len()];
        let surface = [Surface::Dented, Surface::Fresh][index % 2];
        let damped = AnyDamped::ALL[index % AnyDamped::ALL.len()].1;
        choose(Choice { loss, surface, damped, ..Choice::of(model.loading, model.unloading) });
        done += run::<Chosen<Elastoplastic, 1, Present>>(&name, seed);
        done += run::<Chosen<Massive, 1, Present>>(&name, seed);
        done += run::<Chosen<Massive<Inputs>, 2, Present>>(&name, seed);
        done += match index % 6 {
            0 => run::<Chosen<Lossy, 1, Present>>(&name, seed),
            1 => run::<Chosen<LossyMassive, 1, Present>>(&name, seed),
            2 => run::<Chosen<Frictional, 1, Present>>(&name, seed),
            3 => run::<Chosen<FrictionalPlane, 1, Present>>(&name, seed),
            4 => run::<Chosen<Rated<Inputs>, 1, Present>>(&name, seed),
            _ => run::<Chosen<Damped, 1, Present>>(&name, seed) + run::<Chosen<DampedMassive, 1, Present>>(&name, seed),
        };
    }
    assert!(done > 400, "{done} steps were done, so that little was tested");
}

/// Importers that connect FMUs pass on a zero while the mass is not known yet.
#[test]
fn a_mass_of_zero_before_the_first_step_is_not_known_yet() {
    type Wired = Chosen<Massive<Coupled<Present, Present, Present>>, 2, Present>;
    let models = all_models(mild());
    choose(Choice::of(models[0].1.loading, models[0].1.unloading));
    let mut instance = Instance::<Wired>::new().expect("the bodies fit");
    let set = |instance: &mut Instance<Wired>, contact: usize, mass: f64| {
        instance
            .check_real((Real::EffectiveMass, contact), mass)
            .map(|()| instance.set_real((Real::EffectiveMass, contact), mass))
    };
    set(&mut instance, 1, 0.0).expect("not known yet");
    instance.set_experiment(0.0, None).expect("zero is a time");
    instance.enter_initialization().expect("there is a start time");
    set(&mut instance, 0, 0.0).expect("not known yet");
    assert!(set(&mut instance, 0, -1.0).is_err() && set(&mut instance, 0, 1e-31).is_err());
    instance.exit_initialization().expect("the masses may follow");
    let bytes: Vec<_> = words(&instance).iter().map(|word| word.to_le_bytes()).collect();
    assert!(instance.load(&bytes), "a state without masses can be restored");
    assert_eq!(instance.do_step(0.0, 1e-6), Err(Fault::UnknownMass { contact: 0 }));
    set(&mut instance, 0, 1e-3).expect("a mass");
    assert_eq!(instance.do_step(0.0, 1e-6), Err(Fault::UnknownMass { contact: 1 }));
    set(&mut instance, 1, 2e-3).expect("a mass");
    instance.do_step(0.0, 1e-6).expect("all masses are known");
    assert_eq!(instance.phase(), Phase::StepComplete);
    assert!(set(&mut instance, 0, 0.0).is_err(), "a known mass can't become unknown");
}
