//! The passivity guard is told once, in the step in which it first acts, although most steps look at no contact.

use crate::physics::Random;
use crate::scenes::{Choice, Chosen, Guarded, choose, ready, set_rate, words};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_fmu::instance::{Instance, Plain};
use brinell_fmu::scene::{Absent, Scene};

/// Every loading law with each unloading law that can be guarded.
fn every_guarded() -> impl Iterator<Item = (String, Choice)> {
    AnyLoading::of_balls().flat_map(|(name, loading)| {
        let unloading = AnyUnloading::ALL.into_iter().filter_map(|(of, law)| Some((of, law.guarded()?)));
        unloading.map(move |(of, law)| (format!("{name} with {of}"), Choice::of(loading, law)))
    })
}

/// A step as the C interface makes it, and whether the guard is told.
fn step<S: Scene>(instance: &mut Instance<S>, length: f64) -> bool {
    let time = instance.time();
    if instance.do_plain_step(time, length) != Plain::Done {
        instance.do_step(time, length).expect("within the range of the law");
    } else if !instance.is_guard_seen() {
        return false;
    }
    instance.take_guard().is_some()
}

/// Whether the guard acts in a contact, when all of them are looked at.
fn acts<S: Scene>(instance: &Instance<S>) -> bool {
    let mut other = ready::<S>();
    other.copy(instance);
    other.take_guard().is_some()
}

/// Returns the number of times that the guard has been told.
fn tells<S: Scene>(name: &str, seed: u64) -> u32 {
    let (mut random, mut instance, mut is_told, mut count) = (Random(seed), ready::<S>(), false, 0);
    for turn in 0..120 {
        // about the depth of yield, which is 7.6e-8 m
        (0..S::contacts()).for_each(|contact| set_rate(&mut instance, contact, 0.1 * random.next() - 0.048));
        let told = step(&mut instance, 1e-6);
        assert_eq!(told, !is_told && acts(&instance), "{name} in step {turn}");
        is_told |= told;
        count += u32::from(told);
        match random.next() {
            // the category of warnings is enabled anew
            0.0..0.03 => instance.look(),
            0.03..0.06 => {
                let mut other = ready::<S>();
                other.copy(&instance);
                instance = other;
            }
            0.06..0.09 => {
                let bytes: Vec<[u8; 8]> = words(&instance).iter().map(|word| word.to_le_bytes()).collect();
                assert!(instance.load(&bytes), "{name}: its own words are refused");
            }
            _ => continue,
        }
        is_told = false;
    }
    count
}

#[test]
fn the_guard_is_told_in_the_step_in_which_it_first_acts() {
    let mut told = 0;
    for (place, (name, choice)) in every_guarded().enumerate() {
        choose(choice);
        told += tells::<Chosen<Guarded, 1, Absent>>(&name, place as u64);
        told += tells::<Chosen<Guarded, 5, Absent>>(&format!("{name}, several"), place as u64);
    }
    assert!(told > 100, "{told} times");
}
