//! Every pairing of laws for any bodies that an FMU accepts: continuity, balance of energy, and the same bits from a library
//! compiled at any level of optimisation.

use crate::physics::{
    AnyModel, Random, all_models, corners, has_jumps, loading_force, random_bodies, some_models, unit,
};
use brinell_contact::{History, Loading};
use brinell_testing::long::some;
use brinell_testing::places::temporary;
use std::env;
use std::process::Command;

/// Set where all bits are to be printed.
const PRINTS: &str = "BRINELL_PRINTS_BITS";

/// The bodies of a test.
const BODIES: usize = 60;

fn decades(random: &mut Random, low: f64, high: f64) -> f64 {
    10f64.powf(low + (high - low) * random.next())
}

/// The largest error by rounding of a force and an energy at `largest` \[m\], [N] and [J]: that of Hertz's curve, since some
/// laws are differences from it.
fn sizes(model: &AnyModel, largest: f64) -> (f64, f64) {
    let (hertz, force) = (model.pair.hertz_stiffness() * largest.powf(1.5), loading_force(model, largest));
    (hertz.max(force), hertz.max(force) * largest)
}

#[test]
fn force_work_and_contact_radius_are_continuous_for_any_bodies() {
    let (mut random, mut compared) = (Random(16), 0);
    for _ in 0..BODIES {
        let pair = random_bodies(&mut random);
        for (name, model) in all_models(pair).into_iter().filter(|(_, model)| !has_jumps(model)) {
            for corner in corners(&model) {
                let curve = |at: f64| {
                    let (law, pair) = (&model.loading, &model.pair);
                    [loading_force(&model, at), law.work(pair, at), law.contact_radius(pair, at)]
                };
                let (below, above) = (curve(corner.next_down()), curve(corner));
                for (left, right) in below.into_iter().zip(above) {
                    // beyond the end of a fit there is no number, on either side
                    assert_eq!(left.is_finite(), right.is_finite(), "{name}, {pair:?} at {corner:e}: {left} {right}");
                    // a few units in the last place; a sum of large parts of opposite signs, as on the pieces of a line contact, has more
                    let is_sum = model.loading.is_line() || model.loading.table().is_some();
                    let digits = if is_sum { 1e-13 } else { 4e-15 };
                    let allowed = digits * right + f64::MIN_POSITIVE;
                    let is_close = !left.is_finite() || (left - right).abs() <= allowed;
                    assert!(is_close, "{name}, {pair:?} at {corner:e}: {left:e} {right:e}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 3000, "{compared} values were compared");
}

/// Moves `history` to a random indentation. Returns whether the law reaches so far.
fn move_anywhere(history: &mut History, model: &AnyModel, random: &mut Random) -> bool {
    let d_y = unit(&model.pair).indentation;
    let to = match random.next() < 0.2 {
        true => -d_y * decades(random, -3.0, 1.0),
        false => d_y * decades(random, -3.0, 4.0),
    };
    history.advance(model, to - history.indentation()).is_ok()
}

#[test]
fn energies_balance_and_the_force_never_pulls_for_any_bodies() {
    let (mut random, mut made, mut refused) = (Random(17), 0, 0);
    for _ in 0..BODIES {
        let pair = random_bodies(&mut random);
        for (name, model) in some_models(pair) {
            let mut history = History::start(&model, 0.0).expect("at the surface");
            let mut sum = 0.0;
            for _ in 0..8 {
                if !move_anywhere(&mut history, &model, &mut random) {
                    refused += 1;
                    continue;
                }
                made += 1;
                let what = || format!("{name}, {pair:?}: {history:?}");
                let force = history.force();
                assert!(force >= 0.0 && force.is_finite(), "force {force}; {}", what());
                let (work, elastic) = (history.work(&model), history.elastic_energy(&model));
                let dissipated = history.dissipated_energy(&model);
                sum += sizes(&model, history.max_indentation().max(0.0)).1;
                let rounding = 32.0 * f64::EPSILON * sum + f64::MIN_POSITIVE;
                assert!(elastic >= -rounding, "elastic energy {elastic:e}; {}", what());
                assert!(
                    (work - elastic - dissipated).abs() <= rounding,
                    "{work:e} {elastic:e} {dissipated:e}; {}",
                    what()
                );
            }
        }
    }
    assert!(made > 50 * refused, "{made} motions and {refused} refused");
}

/// Mixes the bits of `number` into `hash` (FNV-1a by words).
fn mix(hash: &mut u64, number: f64) {
    *hash = (*hash ^ number.to_bits()).wrapping_mul(0x100_0000_01b3).rotate_left(29);
}

/// A line for each pairing, with a hash of all bits of random motions of 20 pairs of bodies.
fn bits() -> Vec<String> {
    let mut random = Random(18);
    let bodies: Vec<_> = (0..20).map(|_| random_bodies(&mut random)).collect();
    let of = |index: usize| {
        let (mut hash, mut name, mut random) = (0xcbf2_9ce4_8422_2325, String::new(), Random(index as u64));
        for pair in &bodies {
            let (named, model) = all_models(*pair).swap_remove(index);
            name = named;
            let mut history = History::start(&model, 0.0).expect("at the surface");
            for _ in 0..40 {
                let moved = move_anywhere(&mut history, &model, &mut random);
                let energies =
                    [history.work(&model), history.elastic_energy(&model), history.dissipated_energy(&model)];
                let shown = [history.force(), history.stiffness(), history.contact_radius(&model)];
                energies.into_iter().chain(shown).for_each(|number| mix(&mut hash, number));
                mix(&mut hash, f64::from(u8::from(moved)));
            }
        }
        format!("BITS {name}: {hash:016x}")
    };
    let taken = 0..all_models(bodies[0]).len();
    match env::var_os(PRINTS) {
        Some(_) => taken.map(of).collect(),
        None => some(taken, 4).map(of).collect(),
    }
}

/// What the test below compares.
#[test]
fn motions_for_any_bodies_are_the_same_each_time() {
    let lines = bits();
    assert!(lines.len() > 12 && lines == bits());
    if env::var_os(PRINTS).is_some() {
        lines.iter().for_each(|line| println!("{line}"));
    }
}

/// The library and libm at each level of optimisation, in a folder of their own.
#[test]
#[ignore = "compiles the library six times: cargo test --release --test physics laws_everywhere -- --ignored"]
fn every_level_of_optimisation_gives_the_same_bits() {
    let mut all: Vec<(&str, Vec<String>)> = Vec::new();
    for level in ["0", "1", "2", "3", "\"s\"", "\"z\""] {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["test", "--quiet", "--release", "--no-default-features", "--test", "physics"]);
        for package in ["brinell-contact", "libm"] {
            cargo.args(["--config", &format!("profile.release.package.{package}.opt-level={level}")]);
        }
        let test = "laws_everywhere::motions_for_any_bodies_are_the_same_each_time";
        cargo.args(["--", "--exact", test, "--nocapture"]);
        let output = cargo
            .env(PRINTS, "1")
            .env("CARGO_TARGET_DIR", temporary().join("levels"))
            .output()
            .expect("cargo can be started");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{level}: {text}{}", String::from_utf8_lossy(&output.stderr));
        let lines = text.lines().filter_map(|line| Some(line[line.find("BITS ")?..].to_string())).collect::<Vec<_>>();
        assert!(lines.len() > 50, "{level}: {text}");
        all.push((level, lines));
    }
    for (level, lines) in &all[1..] {
        let pairs = lines.iter().zip(&all[0].1);
        let different: Vec<_> = pairs.filter(|(one, other)| one != other).collect();
        assert!(different.is_empty() && lines.len() == all[0].1.len(), "at {level}: {different:?}");
    }
}
