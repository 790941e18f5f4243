//! Every word of a saved state matters: a restored instance shows what the saved one has shown, at once and later, and another
//! word in any place shows, or is refused.

use crate::physics::Random;
use crate::scenes::{
    Choice, Chosen, DampedMassive, LossyMassive, OUTPUTS, Rated, choose, frictions, outputs, ready, set_rate, words,
};
use crate::{
    DampedOne, DampedSeveral, MassiveOne, One, ParallelOne, RoughOne, RoughPlaneOne, Several, WiredSeveral,
    some_pairings,
};
use brinell::contact::Contact;
use brinell::contact::damped::AnyDamped;
use brinell::instance::Instance;
use brinell::scene::{Presence, Present, Real, Scene};

/// Sets all inputs of a contact.
fn set<S: Scene>(instance: &mut Instance<S>, contact: usize, rate: f64, [one, two]: [f64; 2]) {
    set_rate(instance, contact, rate);
    let both = [(Real::TangentialRate, one), (Real::SecondTangentialRate, two)];
    for (input, rate) in both.into_iter().take(S::Contact::DIRECTIONS) {
        instance.set_real((input, contact), rate);
    }
}

/// States of many kinds: touched, dented, with long lists of springs, with derivatives of the inputs, apart again.
fn states<S: Scene>() -> Vec<Vec<u64>> {
    let mut states = Vec::new();
    for seed in 0..4 {
        let (mut random, mut instance) = (Random(seed), ready::<S>());
        let mut step = |instance: &mut Instance<S>, size: f64, curved: bool| {
            for contact in 0..S::CONTACTS {
                let mut any = || size * (2.0 * random.next() - 1.0);
                set(instance, contact, 0.1 * any(), [any(), any()]);
                if curved {
                    let input = (Real::IndentationRate, contact);
                    for order in 1..=Instance::<S>::INPUT_ORDER {
                        if instance.check_input_derivative(input, order, 1.0).is_ok() {
                            instance.set_input_derivative(input, order, 1e5 * any());
                        }
                    }
                }
            }
            let time = instance.time();
            instance.do_step(time, 1e-7).expect("within the range of the law");
        };
        (0..S::CONTACTS).for_each(|contact| set(&mut instance, contact, 1.0 + 0.1 * contact as f64, [0.3, -0.2]));
        instance.do_step(0.0, 2e-6).expect("within the range of the law");
        states.push(words(&instance));
        // a vibration that dies away leaves a long list of springs
        for turn in 0..40 {
            step(&mut instance, 0.5 * 0.8f64.powi(turn), false);
        }
        states.push(words(&instance));
        step(&mut instance, 0.1, true);
        states.push(words(&instance));
    }
    states
}

/// Everything that an instance shows.
fn shown<S: Scene>(instance: &Instance<S>) -> Vec<u64> {
    let mut all: Vec<u64> = outputs(instance).iter().map(|number| number.to_bits()).collect();
    for contact in 0..S::CONTACTS {
        let shown = OUTPUTS.into_iter().filter(|output| {
            S::Momentum::IS_PRESENT || !matches!(output, Real::Impulse | Real::MeanForce | Real::PredictedForce)
        });
        for output in shown.chain(frictions::<S>()) {
            for order in [1, 2] {
                let derivative = instance.output_derivative((output, contact), order);
                all.push(derivative.map_or(1, f64::to_bits));
            }
        }
    }
    all.push(instance.time().to_bits());
    all
}

/// What an instance with these `words` shows at once, in two steps with the inputs that it has, in two others, and after a step
/// that is too long for a stop time; `None` if it refuses them.
fn course<S: Scene>(words: &[u64]) -> Option<Vec<u64>> {
    let mut instance = ready::<S>();
    let bytes: Vec<[u8; 8]> = words.iter().map(|word| word.to_le_bytes()).collect();
    if !instance.load(&bytes) {
        return None;
    }
    let mut all = shown(&instance);
    for (rate, length) in
        [(None, 1e-7), (None, 1e-7), (Some(-0.2), 2e-7), (Some(0.3), 3e-7), (Some(-2.0), 1e-5), (Some(0.1), 1.0)]
    {
        if let Some(rate) = rate {
            (0..S::CONTACTS).for_each(|contact| set(&mut instance, contact, rate, [-rate, 0.5 * rate]));
        }
        let time = instance.time();
        let made = match instance.phase() {
            brinell::instance::Phase::StepComplete => instance.do_step(time, length).is_ok(),
            _ => false,
        };
        all.push(u64::from(made));
        all.extend(shown(&instance));
    }
    Some(all)
}

/// The words of an instance of `S` that don't matter in any state, although they are not the same in all.
fn idle<S: Scene>(name: &str) -> Vec<usize> {
    let states = states::<S>();
    let expected: Vec<Option<Vec<u64>>> = states.iter().map(|state| course::<S>(state)).collect();
    let matters = |place: usize| {
        states.iter().zip(&expected).any(|(state, expected)| {
            let number = f64::from_bits(state[place]);
            let others = [
                0,
                (1.01 * number).to_bits(),
                (-number).to_bits(),
                1e-9f64.to_bits(),
                1.0f64.to_bits(),
                state[place] ^ 1,
                state[place] ^ 2,
            ];
            others.into_iter().filter(|&other| other != state[place]).any(|other| {
                let mut changed = state.clone();
                changed[place] = other;
                course::<S>(&changed).is_none_or(|found| Some(&found) != expected.as_ref())
            })
        })
    };
    let idle: Vec<usize> = (0..Instance::<S>::WORDS).filter(|&place| !matters(place)).collect();
    println!("{name}: {} of {} words are idle: {idle:?}", idle.len(), Instance::<S>::WORDS);
    idle
}

/// Runs on from the saved state and from its words: everything shown is the same to the bit, at once and later.
fn comes_back<S: Scene>(name: &str) {
    let mut instance = ready::<S>();
    let mut random = Random(5);
    for step in 0..60 {
        for contact in 0..S::CONTACTS {
            let mut any = || 2.0 * random.next() - 0.95;
            set(&mut instance, contact, any(), [any(), any()]);
        }
        let time = instance.time();
        instance.do_step(time, 1e-6).expect("within the range of the law");
        let bytes: Vec<[u8; 8]> = words(&instance).iter().map(|word| word.to_le_bytes()).collect();
        let before = shown(&instance);
        let mut other = ready::<S>();
        other.copy(&instance);
        // a step that the saved instance has not made
        let _ = other.do_step(time + 1e-6, 3e-6);
        assert!(other.load(&bytes), "{name}: its own words are refused");
        assert_eq!(shown(&other), before, "{name}: at once, in step {step}");
        if step % 2 == 0 {
            instance = other;
        }
    }
}

/// Words that do not matter: the initial gap acts at initialization only; radius and modulus follow from the parameters.
const FOLLOW: [usize; 3] = [7, 8, 9];

#[test]
fn a_saved_state_comes_back_to_the_bit() {
    for (name, choice) in some_pairings() {
        choose(choice);
        comes_back::<RoughPlaneOne>(&format!("{name}, friction in two directions"));
        comes_back::<RoughOne>(&format!("{name}, friction"));
        comes_back::<One>(&name);
        comes_back::<Several>(&format!("{name}, several"));
        comes_back::<MassiveOne>(&format!("{name}, with its mass"));
        comes_back::<ParallelOne>(&format!("{name}, coupled"));
        comes_back::<WiredSeveral>(&format!("{name}, wired"));
        comes_back::<Chosen<LossyMassive, 1, Present>>(&format!("{name}, lossy"));
        comes_back::<Chosen<Rated, 1, Present>>(&format!("{name}, rated"));
    }
    for (name, damped) in AnyDamped::ALL {
        choose(Choice { damped, ..some_pairings()[0].1 });
        comes_back::<DampedOne>(name);
        comes_back::<DampedSeveral>(name);
        comes_back::<Chosen<DampedMassive, 1, Present>>(&format!("{name}, with its mass"));
    }
}

#[test]
fn each_word_of_a_saved_contact_matters_with_and_without_friction() {
    for (name, choice) in some_pairings() {
        choose(choice);
        assert_eq!(idle::<One>(&name), FOLLOW, "{name}");
        let idle = idle::<RoughPlaneOne>(&name);
        // the last one is the lower end of the branch: a step that leaves it too early finds the same branch again
        assert_eq!(idle, [FOLLOW.as_slice(), &[14]].concat(), "{name}");
    }
}
