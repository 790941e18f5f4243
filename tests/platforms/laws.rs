//! What contacts do over random histories, by any laws, as one number: its bits are the same wherever it is computed, or the
//! laws are not.
//!
//! This is a module of tests/same_bits.rs and, compiled by itself, a library for other platforms. So it uses nothing but the
//! physics, and no function whose last digit a system may choose.
#![cfg_attr(not(test), no_std)]

use brinell::contact::damped::{self, AnyDamped};
use brinell::contact::impact::{self, Impact, Prediction};
use brinell::contact::loading::AnyLoading;
use brinell::contact::motion::{self, Drive};
use brinell::contact::path::Course;
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Contact, History, Model, Pair, Surface};

/// Steps of a history.
const STEPS: u32 = 200;

/// The histories there are.
pub const WAYS: u32 = 3;

/// Random numbers.
///
/// Reference: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014 (SplitMix64).
struct Random(u64);

impl Random {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        word ^ (word >> 31)
    }

    /// In [0, 1).
    fn part(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// One of `count` numbers from 0 on.
    fn below(&mut self, count: u64) -> u64 {
        self.word() % count
    }

    /// From `2^low` to `2^high`, each octave as often as another.
    fn octaves(&mut self, low: i32, high: i32) -> f64 {
        let octave = low + self.below((high - low) as u64) as i32;
        f64::from_bits(((octave + 1023) as u64) << 52) * (1.0 + self.part())
    }

    /// The same, of both signs.
    fn signed(&mut self, low: i32, high: i32) -> f64 {
        let size = self.octaves(low, high);
        if self.below(2) == 0 { size } else { -size }
    }
}

/// A sum of bits.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm" (FNV-1a).
struct Digest(u64);

impl Digest {
    fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
        }
    }

    fn number(&mut self, number: f64) {
        // what is no number has a sign and bits that each processor chooses
        self.word(if number.is_nan() { f64::NAN.to_bits() & !(1 << 63) } else { number.to_bits() });
    }

    /// All that `contact` shows with `rate` [m/s].
    fn contact<M, C: Contact<M>>(&mut self, contact: &C, model: &M, rate: f64) {
        self.word(contact.regime() as u64);
        let numbers = [
            contact.force(rate),
            contact.indentation(),
            contact.max_indentation(),
            contact.residual_indentation(model),
            contact.stiffness(rate),
            contact.damping(rate),
            contact.curvature(model, rate),
            contact.contact_radius(model),
            contact.mean_pressure(model, rate),
            contact.elastic_energy(model),
            contact.dissipated_energy(model),
        ];
        for number in numbers {
            self.number(number);
        }
    }

    fn prediction(&mut self, prediction: Option<Prediction>) {
        let Some(prediction) = prediction else { return self.word(1) };
        self.word(prediction.regime as u64);
        let numbers = [
            prediction.max_indentation,
            prediction.max_force,
            prediction.max_contact_radius,
            prediction.residual_indentation,
            prediction.energy,
            prediction.rebound_energy,
            prediction.restitution,
            prediction.loading_time,
            prediction.unloading_time,
        ];
        for number in numbers {
            self.number(number);
        }
    }
}

/// The bodies of a history: those of the reference tables, or others of any size.
fn bodies(random: &mut Random, way: u32) -> Pair {
    if way == 0 {
        let poissons_ratio = 0.3;
        let (youngs_modulus, yield_strength) = (206e9, 300e6);
        let modulus = youngs_modulus / (1.0 - poissons_ratio * poissons_ratio);
        return Pair { radius: 5e-3, modulus, yield_strength, youngs_modulus, poissons_ratio };
    }
    let (radius, modulus) = (random.octaves(-30, 10), random.octaves(10, 50));
    let yield_strength = modulus / random.octaves(-3, 30);
    let poissons_ratio = -0.99 + 1.49 * random.part();
    let youngs_modulus = random.octaves(0, 6) * modulus * (1.0 - poissons_ratio * poissons_ratio);
    Pair { radius, modulus, yield_strength, youngs_modulus, poissons_ratio }
}

/// The next increment \[m\] of a contact whose unit of length is `unit` \[m\].
fn increment(random: &mut Random, way: u32, unit: f64, indentation: f64, deepest: f64) -> f64 {
    match way {
        // as a contact is used
        0 => unit * (random.part() - 0.45) * random.octaves(-3, 6),
        // of any size, mostly pressing
        1 if random.below(3) > 0 => unit * random.octaves(-60, 12),
        1 => unit * random.signed(-60, 12),
        // as nobody uses it
        _ => match random.below(14) {
            0 => 0.0,
            1 => -0.0,
            2 => -indentation,
            3 => deepest - indentation,
            4 => (deepest - indentation).next_up(),
            5 => f64::from_bits(1),
            6 => -f64::from_bits(1),
            7 => -0.5 * indentation,
            8 => random.signed(-1020, 1020),
            9 => [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.below(3) as usize % 3],
            10 => unit * random.signed(20, 60),
            _ => unit * random.signed(-10, 10),
        },
    }
}

/// A history of a contact of `model`, on which a mass is moved too if the contact can be followed.
fn history<M: Copy, C: Contact<M>>(
    digest: &mut Digest,
    random: &mut Random,
    (way, unit): (u32, f64),
    model: &M,
    follow: impl Fn(&mut C, &M, &Drive, f64, f64) -> Option<[f64; 3]>,
) {
    let gap = if way == 0 { unit } else { unit * random.signed(-10, 3) };
    let Ok(mut contact) = C::start(model, gap) else { return digest.word(2) };
    for _ in 0..STEPS {
        let step = random.octaves(-30, -3);
        let increment = increment(random, way, unit, contact.indentation(), contact.max_indentation());
        let mut rate = increment / step;
        let before = contact;
        match random.below(8) {
            0 => {
                let course = Course { rate, slope: random.signed(-2, 3) * rate / step, bend: 0.0 };
                match contact.step_with_mean_force(&course, step, || *model) {
                    Ok((deepest, mean_force)) => [deepest, mean_force].into_iter().for_each(|n| digest.number(n)),
                    Err(_) => digest.word(3),
                }
            }
            1 if way == 0 => {
                let drive = Drive { mass: 4e-3, acceleration: 0.1 * rate / step };
                match follow(&mut contact, model, &drive, rate, step) {
                    Some(numbers) => numbers.into_iter().for_each(|number| digest.number(number)),
                    // somewhere on the way
                    None => contact = before,
                }
            }
            _ => {
                let short = !C::FOLLOWS_RATE && contact.short_step(rate * step);
                let kept = C::kept(model);
                if !short && contact.step_held(rate, step, &kept, || *model).is_err() {
                    digest.word(4);
                }
            }
        }
        // a refused rate was none
        if !(rate * step < f64::INFINITY && rate * step > f64::NEG_INFINITY) {
            rate = 0.0;
        }
        digest.contact(&contact, model, rate);
    }
}

/// The bits of an impact of `mass` on the bodies.
fn impact(random: &mut Random, way: u32) -> Impact {
    match way {
        0 => Impact { mass: 4e-3, speed: random.octaves(-8, 4) },
        _ => Impact { mass: random.octaves(-40, 10), speed: random.octaves(-20, 7) },
    }
}

/// What a contact by the laws at these places of the lists does on history `seed` of this kind; `guarded` takes the form of the
/// unloading law with the passivity guard. 0 if there is no such law.
pub fn elastoplastic(loading: usize, unloading: usize, guarded: bool, way: u32, seed: u64) -> u64 {
    let (Some((_, loading)), Some((_, unloading))) = (AnyLoading::ALL.get(loading), AnyUnloading::ALL.get(unloading))
    else {
        return 0;
    };
    let Some(unloading) = (if guarded { unloading.guarded() } else { Some(*unloading) }) else { return 0 };
    let (mut random, mut digest) = (Random(seed), Digest(0xcbf2_9ce4_8422_2325));
    let surface = if random.below(2) == 0 { Surface::Dented } else { Surface::Fresh };
    let model = Model { pair: bodies(&mut random, way), loading: *loading, unloading, surface };
    let unit = model.pair.yield_point(1.1).indentation;
    history(&mut digest, &mut random, (way, unit), &model, |history: &mut History, model, drive, speed, step| {
        let outcome = motion::follow(history, model, drive, speed, step).ok()?;
        Some([outcome.speed, outcome.taken, outcome.deepest])
    });
    digest.prediction(impact::predict(&model, &impact(&mut random, way)));
    digest.0
}

/// The same by the rate-dependent law at this place of the list.
pub fn rate_dependent(law: usize, way: u32, seed: u64) -> u64 {
    let Some((_, law)) = AnyDamped::ALL.get(law) else { return 0 };
    let (mut random, mut digest) = (Random(seed), Digest(0xcbf2_9ce4_8422_2325));
    let (pair, mass) = (bodies(&mut random, way), random.octaves(-20, 5));
    let model = damped::Model { pair, law: *law, restitution: 0.01 + 0.99 * random.part(), mass };
    let unit = pair.yield_point(1.1).indentation;
    let not_followed = |_: &mut damped::History<AnyDamped>, _: &_, _: &Drive, _, _| None;
    history(&mut digest, &mut random, (way, unit), &model, not_followed);
    if way == 0 {
        digest.prediction(damped::impact::predict(&model, &impact(&mut random, way)));
    }
    digest.0
}

/// For other platforms: one of the above, with `unloading` 1000 for a rate-dependent law, and 100 more for a guarded one.
#[cfg(not(test))]
#[unsafe(no_mangle)]
pub extern "C" fn brinell_digest(law: u32, unloading: u32, way: u32, seed: u64) -> u64 {
    match unloading {
        1000 => rate_dependent(law as usize, way, seed),
        _ => elastoplastic(law as usize, unloading as usize % 100, unloading >= 100, way, seed),
    }
}

#[cfg(not(test))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {}
}
