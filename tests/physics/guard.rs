//! The passivity guard: no impact gains energy, and laws that need no guard do not change.

use crate::physics::{AnyModel, MASS, loading_force, logarithmic, mild, model, unit, unloading, unloading_force};
use brinell_contact::impact::{Impact, predict};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Loading, Pair};
use brinell_testing::laws;

/// Loading laws that are not passive with some unloading law.
fn making_energy() -> impl Iterator<Item = &'static str> {
    laws::entries("loading").filter(|law| law.contains_key("energy")).map(|law| laws::text(law, "name"))
}

/// Unloading laws that have a guarded form: those whose whole path is Hertz's, with their dent and radius.
const WITH_GUARD: [&str; 4] = ["contact-radius", "deformed-radius", "original-radius", "thornton"];

/// The pairings of these, without and with guard.
fn pairings() -> Vec<(String, AnyModel, AnyModel)> {
    let pairing = |loading: &str, unloading: &str| {
        // for this target none of them is passive: some are from a certain Poisson's ratio on
        let pair = Pair { poissons_ratio: 0.1, ..mild() };
        let plain = AnyModel { pair, ..model(loading, unloading) };
        let guarded = AnyModel { unloading: plain.unloading.guarded().expect("it has a guarded form"), ..plain };
        (format!("{loading} with {unloading}"), plain, guarded)
    };
    let loadings = making_energy().chain(["big-alabo", "brinell"]);
    loadings.flat_map(|loading| WITH_GUARD.map(|unloading| pairing(loading, unloading))).collect()
}

/// Largest indentations [m] from before yield to far beyond every energy gain.
fn depths() -> impl Iterator<Item = f64> {
    let d_y = unit(&mild()).indentation;
    logarithmic(0.5, 1e5, 500).map(move |x| x * d_y)
}

#[test]
fn with_the_guard_no_unloading_gives_back_more_than_was_put_in() {
    for (name, _, guarded) in pairings() {
        for largest in depths() {
            let work = guarded.loading.work(&guarded.pair, largest);
            let recovered = guarded.recovered_work(largest, largest);
            assert!(recovered <= work * (1.0 + 1e-13), "{name} at {largest:e}: {recovered:e} of {work:e}");
        }
    }
}

#[test]
fn with_the_guard_no_impact_ends_faster_than_it_began() {
    for (name, _, guarded) in pairings() {
        for speed in logarithmic(1e-3, 1e3, 31) {
            let prediction = predict(&guarded, &Impact { mass: MASS, speed }).expect("an ordinary impact");
            assert!(prediction.restitution <= 1.0 + 1e-13, "{name} at {speed} m/s: {}", prediction.restitution);
        }
    }
}

#[test]
fn without_the_guard_each_of_these_laws_gains_energy_with_some_unloading() {
    for loading in making_energy() {
        let gains = |(_, plain, guarded): &(String, AnyModel, AnyModel)| {
            depths().any(|d| {
                let gain = plain.recovered_work(d, d) > 1.001 * plain.loading.work(&plain.pair, d);
                assert!(!gain || guarded.is_held_back_at(d), "{loading} at {d:e} gains, and the guard doesn't act");
                gain
            })
        };
        let of_law = |(name, ..): &&(String, AnyModel, AnyModel)| name.starts_with(&format!("{loading} "));
        assert!(pairings().iter().filter(of_law).any(gains), "{loading} needs no guard");
    }
}

#[test]
fn where_the_guard_does_not_act_nothing_is_changed() {
    let (mut same, mut other) = (0, 0);
    for (name, plain, guarded) in pairings() {
        for largest in depths() {
            let (before, after) = (plain.unloading_path(largest), guarded.unloading_path(largest));
            if guarded.is_held_back_at(largest) {
                assert!(after.lower > before.lower, "{name} at {largest:e}: the dent is deeper with the guard");
                other += 1;
            } else {
                assert_eq!(before, after, "{name} at {largest:e}");
                same += 1;
            }
        }
    }
    assert!(same > 10_000 && other > 1_000, "both happen: {same}, {other}");
}

#[test]
fn the_guarded_path_begins_at_the_peak() {
    for (name, _, guarded) in pairings() {
        for largest in depths().filter(|&largest| guarded.is_held_back_at(largest)) {
            let (peak, force) = (loading_force(&guarded, largest), unloading_force(&guarded, largest, largest));
            assert!((peak - force).abs() <= 8.0 * f64::EPSILON * peak, "{name} at {largest:e}: {force:e}, {peak:e}");
        }
    }
}

#[test]
fn the_laws_with_paths_of_their_own_have_no_guard() {
    for (name, law) in AnyUnloading::ALL {
        assert_eq!(law.guarded().is_some(), WITH_GUARD.contains(&name), "{name}");
    }
    // a guarded law cannot be guarded again
    assert!(unloading("thornton").guarded().and_then(AnyUnloading::guarded).is_none());
}
