//! Passivity of the laws: the table of laws describes it for all bodies that an FMU accepts.

use crate::physics::{
    self, AnyModel, Random, belong_together, corners, logarithmic, pair_of, passive_from, random_bodies, unit,
};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Loading, Model, Pair, Surface};
use brinell_testing::laws::{entry, text};

/// A surplus up to this fraction of the work is attributed to rounding and to the integrals.
const ROUNDING: f64 = 1e-10;

/// Increasing indentations [m] from far below yield to far beyond it, and on both sides of each corner.
fn indentations(model: &AnyModel) -> Vec<f64> {
    let d_y = unit(&model.pair).indentation;
    let mut points: Vec<f64> = logarithmic(1e-2 * d_y, 1e5 * d_y, 250).collect();
    for corner in corners(model) {
        let near = logarithmic(1e-9, 0.5, 30).flat_map(|part| [corner * (1.0 - part), corner * (1.0 + part)]);
        points.extend(near.chain([corner.next_down(), corner, corner.next_up()]));
    }
    points.sort_by(f64::total_cmp);
    points
}

/// The loading with a law on some bodies: indentations [m] with the work up to there [J], as far as the law is defined.
struct Loaded {
    pair: Pair,
    loading: AnyLoading,
    points: Vec<(f64, f64)>,
}

/// The energy that unloading returns.
#[derive(Debug)]
struct Returned {
    largest_restitution: f64,
    /// The largest decrease of the dissipated energy, over the work.
    fall: f64,
}

impl Loaded {
    fn new(loading: AnyLoading, pair: Pair) -> Loaded {
        let model = Model { pair, loading, unloading: AnyUnloading::ALL[0].1, surface: Surface::Dented };
        let points = indentations(&model).into_iter().map(|depth| (depth, loading.work(&pair, depth)));
        Loaded { pair, loading, points: points.take_while(|(_, work)| work.is_finite()).collect() }
    }

    fn returned(&self, unloading: AnyUnloading) -> Returned {
        let model = Model { pair: self.pair, loading: self.loading, unloading, surface: Surface::Dented };
        let mut most_lost = 0.0f64;
        let mut returned = Returned { largest_restitution: 0.0, fall: 0.0 };
        for &(depth, work) in &self.points {
            let recovered = model.recovered_work(depth, depth);
            let lost = work - recovered;
            returned.largest_restitution = returned.largest_restitution.max((recovered / work).sqrt());
            returned.fall = returned.fall.max((most_lost - lost) / work);
            most_lost = most_lost.max(lost);
        }
        returned
    }
}

/// The unloading laws with which a loading law can be combined.
fn partners(loading: &str) -> impl Iterator<Item = (&'static str, AnyUnloading)> {
    AnyUnloading::ALL.into_iter().filter(move |(unloading, _)| belong_together(loading, unloading))
}

#[test]
fn laws_listed_as_passive_are_passive_for_any_bodies() {
    let mut random = Random(2005);
    let (mut passive, mut others) = (0, 0);
    for (name, loading) in AnyLoading::of_balls() {
        for _ in 0..40 {
            let loaded = Loaded::new(loading, random_bodies(&mut random));
            for (unloading_name, unloading) in partners(name) {
                if passive_from(name, unloading_name).is_none_or(|from| loaded.pair.poissons_ratio < from) {
                    others += 1;
                    continue;
                }
                let Returned { largest_restitution, fall } = loaded.returned(unloading);
                let what = format!("{name} with {unloading_name}, {:?}", loaded.pair);
                assert!(largest_restitution <= 1.0 + ROUNDING, "{what}: restitution {largest_restitution}");
                assert!(fall <= ROUNDING, "{what}: dissipated energy falls by {fall:e} of the work");
                passive += 1;
            }
        }
    }
    assert!(passive > 2000 && others > 500, "{passive} and {others}");
}

#[test]
fn laws_not_listed_as_passive_gain_energy_below_their_limit() {
    for (name, loading) in AnyLoading::of_balls() {
        for (unloading_name, unloading) in partners(name) {
            let from = passive_from(name, unloading_name).unwrap_or(0.5);
            if from <= -0.99 {
                continue;
            }
            // so that the limit is off by at most 0.02
            let makes_energy = [3.0, 1e3].into_iter().any(|modulus_ratio| {
                let pair = pair_of(0.005, 2e11, 2e11 / modulus_ratio);
                let loaded = Loaded::new(loading, Pair { poissons_ratio: from - 0.02, ..pair });
                loaded.returned(unloading).fall > 1e-6
            });
            assert!(makes_energy, "{name} with {unloading_name} makes no energy below nu = {from}");
        }
    }
}

#[test]
fn the_largest_restitution_with_the_own_unloading_law_is_the_listed_one() {
    let mut random = Random(1997);
    for (name, loading) in AnyLoading::of_balls() {
        let law = entry("loading", name);
        let Some(energy) = law.get("energy").map(|energy| energy.as_table().unwrap()) else { continue };
        let own = if text(law, "unloading").is_empty() { "contact-radius" } else { text(law, "unloading") };
        let unloading = physics::unloading(own);
        for (key, low, high) in [("restitution", 0.0, 0.5), ("auxetic_restitution", -0.99, -1e-9)] {
            let said = energy[key].as_float().unwrap();
            let mut largest = 0.0f64;
            // for some moduli, the maximum is at or near an end of the range
            for step in 0..24 {
                let poissons_ratio = if step % 2 == 0 { low } else { low + (high - low) * random.next() };
                let pair = Pair { poissons_ratio, ..random_bodies(&mut random) };
                largest = largest.max(Loaded::new(loading, pair).returned(unloading).largest_restitution);
            }
            // three decimals, and the error between the indentations that are evaluated
            assert!((largest - said).abs() < 1e-3, "{name} with {own}, {key}: {largest}, not {said}");
        }
    }
}
