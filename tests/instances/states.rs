//! A saved state comes back: every kind of instance shows what the saved one has shown, at once and later, to the bit. Random scenes do the
//! same in `tests/exported/differential.rs`; here without an export, so that deliberate mistakes and sanitizers see it.

use crate::physics::{Random, mild};
use crate::scenes::{
    Choice, Chosen, Damped, DampedMassive, Elastoplastic, Frictional, FrictionalPlane, Held, Lossy, LossyMassive,
    Massive, OUTPUTS, Rated, choose, frictions, outputs, ready, set_rate, words,
};
use crate::{LOSSES, some_pairings};
use brinell_contact::damped::AnyDamped;
use brinell_contact::{Contact, Surface};
use brinell_fmu::instance::{Fault, Instance, Phase};
use brinell_fmu::scene::{Absent, Coupled, Coupling, Presence, Present, Real, Scene};
use brinell_testing::long;
use brinell_unit::known::Exported;

/// Everything that an instance shows.
fn shown<S: Scene>(instance: &Instance<S>) -> Vec<u64> {
    let mut all: Vec<u64> = outputs(instance).iter().map(|number| number.to_bits()).collect();
    for contact in 0..S::contacts() {
        let speed = <S::Coupling as Coupling>::Ending::IS_PRESENT.then_some(Real::ClosingSpeed);
        all.extend(speed.map(|output| instance.real((output, contact)).to_bits()));
        for output in OUTPUTS.into_iter().take(10).chain(frictions::<S>()).chain(speed) {
            for order in [1, 2] {
                let derivative = instance.output_derivative((output, contact), order);
                all.push(derivative.map_or(1, f64::to_bits));
            }
        }
    }
    all.push(instance.time().to_bits());
    all
}

fn in_bytes<S: Scene>(instance: &Instance<S>) -> Vec<[u8; 8]> {
    words(instance).iter().map(|word| word.to_le_bytes()).collect()
}

/// Moves all contacts through yield, reversal, flight and new contacts, with derivatives of the inputs now and then.
fn step<S: Scene>(instance: &mut Instance<S>, random: &mut Random) {
    for contact in 0..S::contacts() {
        set_rate(instance, contact, 2.0 * random.next() - 0.95);
        let inputs = [Real::TangentialRate, Real::SecondTangentialRate];
        for input in inputs.into_iter().take(S::Contact::DIRECTIONS) {
            instance.set_real((input, contact), 2.0 * random.next() - 0.95);
        }
        if S::has_input(Real::ExternalAcceleration) {
            instance.set_real((Real::ExternalAcceleration, contact), 100.0 * random.next());
        }
        let slope = 1e5 * (random.next() - 0.5);
        let allowed = instance.check_input_derivative((Real::IndentationRate, contact), 1, slope).is_ok();
        if random.next() < 0.2 && allowed {
            instance.set_input_derivative((Real::IndentationRate, contact), 1, slope);
        }
    }
    let time = instance.time();
    instance.do_step(time, 1e-6).expect("within the range of the law");
}

/// An instance that is saved, moved on and restored before each step shows what one shows that isn't; and so does a reset one.
fn comes_back<S: Scene>(name: &str) {
    let (mut instance, mut other, mut spare) = (ready::<S>(), ready::<S>(), ready::<S>());
    let [mut random, mut same] = [5, 5].map(Random);
    let mut first = Vec::new();
    for turn in 0..60 {
        step(&mut instance, &mut random);
        step(&mut other, &mut same);
        assert_eq!(shown(&other), shown(&instance), "{name} in step {turn}");
        assert!(outputs(&instance).iter().all(|number| number.is_finite()), "{name} in step {turn}");
        assert_eq!(words(&other), words(&instance), "{name}: equal instances have equal words");
        first.push(shown(&instance));
        // a step that the saved instance has not made
        let bytes = in_bytes(&other);
        spare.copy(&other);
        let time = other.time();
        let _ = other.do_step(time, 3e-6);
        match turn % 2 {
            0 => assert!(other.load(&bytes), "{name}: its own words are refused"),
            _ => other.copy(&spare),
        }
        assert_eq!(shown(&other), first[turn], "{name}: at once, in step {turn}");
    }
    instance.reset().unwrap();
    assert_eq!(instance.phase(), Phase::Instantiated);
    instance.set_experiment(0.0, None).unwrap();
    instance.enter_initialization().unwrap();
    assert!(other.load(&in_bytes(&instance)) && other.phase() == Phase::Initialization, "{name}");
    other.exit_initialization().unwrap();
    let mut random = Random(5);
    for (turn, first) in first.iter().enumerate().take(20) {
        step(&mut other, &mut random);
        assert_eq!(shown(&other), *first, "{name}: step {turn} after a reset");
    }
}

type Inputs = Coupled<Present, Present, Present>;

#[test]
fn a_restored_state_continues_with_the_same_bits() {
    for (name, choice) in long::some(some_pairings(), 2) {
        choose(choice);
        comes_back::<Chosen<Elastoplastic, 1, Absent>>(&name);
        comes_back::<Chosen<Held<Elastoplastic>, 1, Present>>(&format!("{name}, held"));
        comes_back::<Chosen<Elastoplastic, 5, Present>>(&format!("{name}, five contacts"));
        comes_back::<Chosen<Massive, 1, Present>>(&format!("{name}, moved"));
        comes_back::<Chosen<Massive<Coupled<Present>>, 1, Present>>(&format!("{name}, parallel"));
        comes_back::<Chosen<Massive<Inputs>, 2, Present>>(&format!("{name}, wired"));
        comes_back::<Chosen<Frictional, 3, Present>>(&format!("{name}, friction"));
        comes_back::<Chosen<Held<Frictional>, 1, Absent>>(&format!("{name}, friction, held"));
        comes_back::<Chosen<FrictionalPlane, 3, Present>>(&format!("{name}, friction in two directions"));
        comes_back::<Chosen<FrictionalPlane<false>, 1, Absent>>(&format!("{name}, no mean force"));
        choose(Choice { surface: Surface::Fresh, ..choice });
        comes_back::<Chosen<Elastoplastic, 1, Present>>(&format!("{name}, fresh"));
        comes_back::<Chosen<Rated<Inputs>, 1, Present>>(&format!("{name}, rated, wired"));
        for loss in LOSSES {
            choose(Choice { loss, ..choice });
            comes_back::<Chosen<Lossy, 1, Present>>(&format!("{name}, {loss:?}"));
            comes_back::<Chosen<LossyMassive<Coupled<Present>>, 1, Present>>(&format!("{name}, {loss:?}, parallel"));
        }
    }
    for (name, damped) in AnyDamped::ALL {
        choose(Choice { damped, ..some_pairings()[0].1 });
        comes_back::<Chosen<Damped, 3, Present>>(name);
        comes_back::<Chosen<DampedMassive<Coupled<Present>>, 1, Present>>(&format!("{name}, parallel"));
    }
    comes_back::<Exported>("the default scene");
}

#[test]
fn states_of_parameters_that_do_not_fit_come_back_from_their_own_words() {
    type One = Chosen<Elastoplastic, 1, Present>;
    let laws = crate::physics::model("big-alabo", "contact-radius");
    choose(Choice { poissons_ratio: mild().poissons_ratio, ..Choice::of(laws.loading, laws.unloading) });
    let mut instance = Instance::<One>::new().unwrap();
    // the socket has a radius of 1 km
    instance.set_real((Real::Parameter(0), 0), 2e3);
    instance.parameters_are_set();
    let mut restored = Instance::<One>::new().unwrap();
    assert!(restored.load(&in_bytes(&instance)), "its own words are refused");
    assert_eq!((words(&restored), shown(&restored)), (words(&instance), shown(&instance)));
    // the bodies from before are a radius and a modulus, after phase, flags, three times and three values
    for (word, number) in [8, 9].into_iter().flat_map(|word| [0.0, -0.0, -5e-3, f64::NAN].map(|number| (word, number)))
    {
        let mut bytes = in_bytes(&instance);
        bytes[word] = f64::to_le_bytes(number);
        assert!(!Instance::<One>::new().unwrap().load(&bytes), "{number} in word {word}");
    }
    restored.set_experiment(0.0, None).unwrap();
    restored.enter_initialization().unwrap();
    assert!(matches!(restored.exit_initialization(), Err(Fault::NoPointContact { .. })));
    restored.fail();
    assert!(Instance::<One>::new().unwrap().load(&in_bytes(&restored)), "in the error state, too");
    // but no simulation continues with such bodies
    let mut bytes = in_bytes(&ready::<One>());
    bytes[5] = 2e3f64.to_le_bytes();
    assert!(!Instance::<One>::new().unwrap().load(&bytes));
}
