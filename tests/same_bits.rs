//! Every law gives the same bits in a unit as in this program: powers and logarithms are those of `libm`, and no compiler makes
//! another sum of a formula. tests/other_systems.rs compares other systems and processors in the same way.
#![cfg(all(target_os = "linux", target_arch = "x86_64", target_env = "gnu"))]

#[path = "support/digests.rs"]
mod digests;
#[path = "support/hosts.rs"]
mod hosts;
#[path = "platforms/laws.rs"]
mod laws;
#[path = "support/laws_library.rs"]
mod laws_library;
#[path = "support/physics.rs"]
mod physics;
#[path = "support/python.rs"]
mod python;

use hosts::{Host, Loading, cc, compile};
use std::collections::HashSet;

/// Histories of each kind for each pairing of laws.
const SEEDS: u64 = 20;

/// What tests compile is optimized for speed, in many pieces; a unit for size, as one.
#[test]
fn every_law_gives_the_same_bits_when_it_is_compiled_as_in_a_unit() {
    let library = laws_library::here().build().unwrap_or_else(|why| panic!("{why}"));
    let host =
        compile("digests", "digests.c", Loading::BySystem, &cc(), &["-ldl"]).unwrap_or_else(|why| panic!("{why}"));
    let cases = digests::cases(SEEDS);
    let (found, _) = digests::by(&Host::program(host), &library, &cases).unwrap_or_else(|why| panic!("{why}"));
    digests::assert_same(&cases, &found, "compiled as in a unit");
}

/// Otherwise nothing would be compared.
#[test]
fn no_two_histories_give_the_same_bits() {
    let cases = digests::cases(SEEDS);
    let different: HashSet<_> = cases.iter().map(digests::Case::here).collect();
    assert!(!different.contains(&0), "a law that isn't there");
    // hostile bodies are refused at once
    assert!(different.len() as f64 > 0.95 * cases.len() as f64, "{} of {}", different.len(), cases.len());
    let laws: HashSet<_> = cases.iter().map(|case| &case.name).collect();
    assert!(laws.len() > 150, "{} pairings", laws.len());
}
