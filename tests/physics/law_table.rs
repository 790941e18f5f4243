//! The statements of the table of laws about a curve hold for the curve, for any bodies.

use crate::physics::{
    AnyModel, Random, belong_together, corners, loading_force, logarithmic, model, pair_of, passive_from,
    random_bodies, unit,
};
use brinell_contact::Model;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_testing::laws::{self, entry, says, text};

/// The law of this name, with an arbitrary unloading law.
fn of(name: &str) -> AnyModel {
    model(name, "contact-radius")
}

#[test]
fn every_law_that_an_entry_names_is_one_and_has_the_constants_that_are_tied() {
    for law in laws::entries("loading") {
        let own = text(law, "unloading");
        assert!(own.is_empty() || AnyUnloading::ALL.iter().any(|(name, _)| *name == own), "{own}");
        let is_alone = law.contains_key("no_other_unloading");
        assert!(!is_alone || !own.is_empty(), "{}: it goes with no other, and with none", text(law, "name"));
    }
    for law in laws::entries("unloading") {
        let Some(made_for) = law.get("made_for").map(|made| made.as_table().unwrap()) else { continue };
        let loading = entry("loading", text(made_for, "loading"));
        assert_eq!(text(loading, "unloading"), text(law, "name"), "the loading law has it for its own");
        let names = |key| made_for.get(key).and_then(|names| names.as_array()).cloned().unwrap_or_default();
        let has = |law: &toml::Table, constant: &toml::Value| {
            law["parameters"].as_array().unwrap().iter().any(|parameter| &parameter["name"] == constant)
        };
        assert!(names("same").iter().all(|name| has(loading, name) && has(law, name)), "{made_for}");
        assert!(names("as_published").iter().all(|name| has(loading, name)), "{made_for}");
    }
}

#[test]
fn exactly_the_laws_above_hertz_are_listed_as_such() {
    let mut random = Random(1882);
    for (name, loading) in AnyLoading::ALL {
        // a law without an elastic part is skipped: it can only be combined with its own unloading law
        if entry("loading", name).contains_key("no_other_unloading") {
            continue;
        }
        let is_above = (0..60).any(|_| {
            let model = Model { loading, pair: random_bodies(&mut random), ..of(name) };
            let stiffness = model.pair.hertz_stiffness();
            let unit = unit(&model.pair).indentation;
            let near_corners = corners(&model).into_iter().flat_map(|corner| [corner, 1.001 * corner, 1.1 * corner]);
            let mut depths = near_corners.chain(logarithmic(0.01 * unit, 1e5 * unit, 200));
            depths.any(|depth| loading_force(&model, depth) > stiffness * depth.powf(1.5) * (1.0 + 1e-12))
        });
        assert_eq!(is_above, says(entry("loading", name), "above_hertz"), "{name}");
    }
}

/// A dent above the original surface: its depth is negative, and the contact opens at a negative indentation.
fn is_above_surface(model: &AnyModel) -> bool {
    let unit = unit(&model.pair).indentation;
    let corners = corners(model).into_iter().flat_map(|corner| [corner, 1.001 * corner, 1.1 * corner]);
    let mut depths = corners.chain(logarithmic(0.1 * unit, 1e5 * unit, 200));
    depths.any(|depth| !model.is_elastic_at(depth) && model.unloading_path(depth).lower < 0.0)
}

/// Passive laws leave none. Laws that make energy may, as published: at the least for some bodies where they are not passive.
#[test]
fn exactly_the_laws_that_leave_dents_above_the_surface_are_listed_as_such() {
    let mut random = Random(3129);
    let bodies: Vec<_> = (0..60).map(|_| random_bodies(&mut random)).collect();
    for (loading_name, loading) in AnyLoading::ALL {
        let energy = entry("loading", loading_name).get("energy");
        let listed = energy.and_then(|energy| energy.get("dents_above_surface")).and_then(|list| list.as_array());
        for (unloading_name, unloading) in AnyUnloading::ALL {
            if !belong_together(loading_name, unloading_name) {
                continue;
            }
            let what = format!("{loading_name} with {unloading_name}");
            let mut above = false;
            for &pair in &bodies {
                let model = Model { loading, unloading, pair, ..of(loading_name) };
                if is_above_surface(&model) {
                    above = true;
                    let from = passive_from(loading_name, unloading_name);
                    assert!(from.is_none_or(|from| pair.poissons_ratio < from), "{what} is passive for {pair:?}");
                }
            }
            let is_listed = listed.is_some_and(|list| list.iter().any(|name| name.as_str() == Some(unloading_name)));
            assert_eq!(above, is_listed, "{what}");
        }
    }
}

#[test]
fn exactly_the_laws_whose_force_jumps_are_listed_as_such() {
    let mut random = Random(2002);
    for (name, loading) in AnyLoading::ALL {
        let jumps = (0..60).any(|_| {
            let model = Model { loading, pair: random_bodies(&mut random), ..of(name) };
            corners(&model).into_iter().any(|corner| {
                let (below, above) = (loading_force(&model, corner.next_down()), loading_force(&model, corner));
                (above - below).abs() > 1e-12 * above
            })
        });
        assert_eq!(jumps, says(entry("loading", name), "jumps"), "{name}");
    }
}

#[test]
fn exactly_the_laws_whose_normalised_curve_depends_on_the_moduli_are_listed_as_such() {
    for (name, _) in AnyLoading::ALL {
        let forces = |ratio: f64| {
            let model = Model { pair: pair_of(0.005, 2e11, 2e11 / ratio), ..of(name) };
            let unit = unit(&model.pair);
            let force = move |x: f64| loading_force(&model, x * unit.indentation) / unit.force;
            logarithmic(0.01, 1e4, 100).map(force).collect::<Vec<_>>()
        };
        let differs = |(one, other): (f64, f64)| (one - other).abs() > 1e-10 * one;
        let depends = forces(100.0).into_iter().zip(forces(1e4)).any(differs);
        assert_eq!(depends, says(entry("loading", name), "depends_on_modulus_ratio"), "{name}");
    }
}
