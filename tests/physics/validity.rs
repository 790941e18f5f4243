//! The valid range of the laws.

use crate::physics::{AnyModel, Random, all_models, mild, pair_of};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::losses;
use brinell_contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO, largest_speed};
use brinell_contact::{Contact, History, Loading};

/// The size of the smaller body is from a hundred thousandth of the effective radius, as of a ball in a socket that hardly differs from it, or
/// of a pin with a blunt end, to twice that, as of two equal balls.
#[test]
fn at_the_valid_depth_the_contact_radius_is_three_tenths_of_the_smaller_radius_with_every_law() {
    let mut random = Random(4);
    // steel, rubber-like, a huge sphere, and a target so hard that it hardly yields
    for pair in [mild(), pair_of(1e-2, 1e7, 5e5), pair_of(1e6, 200e9, 1e9), pair_of(5e-3, 100e9, 20e9)] {
        for round in 0..12 {
            let size = pair.radius * if round == 0 { 1.0 } else { random.log_uniform(1e-5, 2.0) };
            let right = |name: &str, radius: f64| {
                let error = radius / (LARGEST_RADIUS_RATIO * size.min(pair.radius)) - 1.0;
                assert!(error.abs() <= 1e-12, "{name} on {pair:?} with {size:e} m: off by {error:e}");
            };
            // a line has limits of its own, and a curve of one's own that of its file
            let models = all_models(pair).into_iter();
            for (name, model) in models.filter(|(name, model)| !model.loading.is_line() && !name.starts_with("table "))
            {
                right(&name, model.loading.contact_radius(&pair, model.valid_depth(size)));
            }
            for (name, law) in AnyDamped::ALL {
                let model = law.model(pair, 0.5, 1.0);
                let history = losses::History::start(&model, -model.plastic.valid_depth(size)).unwrap();
                right(name, history.contact_radius(&model));
            }
        }
    }
}

/// A mark on the way makes the step evaluate its branch again, and the branch does not change.
#[test]
fn a_mark_on_the_way_changes_no_bit_of_the_force() {
    for (name, model) in all_models(mild()) {
        let depth = model.valid_depth(f64::INFINITY);
        for mark in [0.3 * depth, depth, 1.7 * depth] {
            let (mut marked, mut plain) = (History::start(&model, 0.0).unwrap(), History::start(&model, 0.0).unwrap());
            for step in 1..400 {
                let increment = if step % 7 == 0 { -0.02 * depth } else { 0.01 * depth };
                Contact::<AnyModel>::stays_within(&mut marked, mark);
                marked.advance(&model, increment).unwrap();
                plain.advance(&model, increment).unwrap();
                assert_eq!(marked.force().to_bits(), plain.force().to_bits(), "{name} at {}", plain.indentation());
                assert_eq!(marked.max_indentation(), plain.max_indentation(), "{name}");
            }
            assert!(plain.max_indentation() > mark, "the mark was passed");
        }
    }
}

#[test]
fn the_largest_speed_is_a_hundredth_of_that_of_waves_in_a_rod() {
    assert_eq!(LARGEST_SPEED_RATIO, 0.01);
    // steel: 5 km/s
    assert!((largest_speed(200e9, 8000.0) - 50.0).abs() < 1e-12);
}
