//! Forged states: the words of an instance, changed as nobody but a stranger who knows the checksum would change them.
//!
//! A state is refused and changes nothing, or it is taken, and what comes back from it is taken again. Nothing panics or hangs, whatever
//! follows. The checksum protects from damage, not from malice: a forged state that is taken may give any force.
//! `BRINELL_HOSTILE=1e6` sets the number of states of each kind.

use crate::physics::{Random, all_models, mild};
use crate::scenes::{Choice, Chosen, Damped, Elastoplastic, Massive, choose, outputs, ready, set_rate, words};
use brinell_contact::damped::AnyDamped;
use brinell_fmu::instance::{Instance, Phase};
use brinell_fmu::scene::{Coupled, Present, Real, Scene};
use brinell_unit::known::Exported;

type One = Chosen<Elastoplastic, 1, Present>;
type Several = Chosen<Elastoplastic, 3, Present>;
type DampedOne = Chosen<Damped, 1, Present>;
type MassiveOne = Chosen<Massive, 1, Present>;
type WiredSeveral = Chosen<Massive<Coupled<Present, Present, Present>>, 2, Present>;

/// Words that are at an end of something; the other sign of each, too.
const EXTREMES: [f64; 9] =
    [0.0, 1.0, f64::NAN, f64::INFINITY, f64::MAX, f64::MIN_POSITIVE, 5e-324, 1e300, f64::EPSILON];

/// The number of forged states of each kind of instance.
fn states() -> usize {
    let wanted = std::env::var("BRINELL_HOSTILE").ok();
    wanted.map_or(60, |count| count.parse::<f64>().expect("BRINELL_HOSTILE is a number, such as 1e6") as usize)
}

/// A whole number below `limit`.
fn below(random: &mut Random, limit: usize) -> usize {
    ((random.next() * limit as f64) as usize).min(limit - 1)
}

/// Another word in place of `word`.
fn forged(random: &mut Random, word: u64, all: &[u64]) -> u64 {
    let value = f64::from_bits(word);
    match below(random, 9) {
        0 => EXTREMES[below(random, EXTREMES.len())].to_bits() ^ (below(random, 2) as u64) << 63,
        1 => word ^ 1 << below(random, 64),
        2 => all[below(random, all.len())],
        3 => word.wrapping_add(1),
        4 => word.wrapping_sub(1),
        5 => (-value).to_bits(),
        // a little, or by many orders of magnitude
        6 => (value * 10f64.powf(0.1 * random.next() - 0.05)).to_bits(),
        7 => (value * 10f64.powf(80.0 * random.next() - 40.0)).to_bits(),
        _ => below(random, 8) as u64,
    }
}

fn in_bytes(words: &[u64]) -> Vec<[u8; 8]> {
    words.iter().map(|word| word.to_le_bytes()).collect()
}

/// Forges states of `S` from different moments of a motion. Returns how many were taken.
fn forge<S: Scene>(name: &str, seed: u64) -> usize {
    let mut random = Random(seed);
    let (mut instance, mut taken) = (ready::<S>(), 0);
    for index in 0..states() {
        if index % 20 == 0 {
            instance = ready::<S>();
            for _ in 0..below(&mut random, 60) {
                (0..S::contacts()).for_each(|contact| set_rate(&mut instance, contact, 4.0 * random.next() - 1.9));
                let time = instance.time();
                instance.do_step(time, 1e-6).expect("within the range of the law");
            }
        }
        let good = words(&instance);
        let mut bad = good.clone();
        for _ in 0..=below(&mut random, 3) {
            let place = below(&mut random, bad.len());
            bad[place] = forged(&mut random, bad[place], &good);
        }
        let mut taker = ready::<S>();
        if !taker.load(&in_bytes(&bad)) {
            assert!(taker.load(&in_bytes(&good)), "{name}, state {index}: a refused state leaves nothing behind");
            assert_eq!(words(&taker), good, "{name}, state {index}: a refused state leaves nothing behind");
            continue;
        }
        taken += 1;
        // what follows from other words is computed again
        let back = words(&taker);
        assert!(taker.load(&in_bytes(&back)), "{name}, state {index}: what comes back is refused");
        assert_eq!(words(&taker), back, "{name}, state {index}: other words come back");
        continues(&mut taker, &mut random);
    }
    taken
}

/// Steps from a taken state to and fro, of many sizes. Each is made or refused, and every output can be read.
fn continues<S: Scene>(instance: &mut Instance<S>, random: &mut Random) {
    for _ in 0..12 {
        let rate = (4.0 * random.next() - 2.0) * 10f64.powf(6.0 * random.next() - 4.0);
        for contact in 0..S::contacts() {
            let variable = (Real::IndentationRate, contact);
            // forged parameters may allow slow rates only
            if instance.check_real(variable, rate).is_ok() {
                instance.set_real(variable, rate);
            }
        }
        let (time, step) = (instance.time(), 10f64.powf(6.0 * random.next() - 9.0));
        if instance.phase() == Phase::StepComplete {
            let _ = instance.do_step(time, step);
        }
        outputs(instance);
    }
    assert_eq!(words(instance).len(), Instance::<S>::words());
}

#[test]
fn a_forged_state_is_refused_or_taken_and_nothing_panics_or_hangs() {
    let mut taken = 0;
    let models = all_models(mild());
    for (index, (name, model)) in models.iter().enumerate() {
        let seed = index as u64;
        choose(Choice::of(model.loading, model.unloading));
        taken += forge::<One>(name, seed) + forge::<MassiveOne>(name, seed);
        if index % 8 == 0 {
            taken += forge::<Several>(name, seed) + forge::<WiredSeveral>(name, seed);
        }
    }
    let any = Choice::of(models[0].1.loading, models[0].1.unloading);
    for (index, (name, damped)) in AnyDamped::ALL.into_iter().enumerate() {
        choose(Choice { damped, ..any });
        taken += forge::<DampedOne>(name, index as u64);
    }
    taken += forge::<Exported>("the default scene", 1);
    assert!(taken > 1000, "{taken} states were taken, so that little was tested");
}
