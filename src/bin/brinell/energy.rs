//! Whether the laws of a scene give back more than they took, found by looking.

use crate::scene::Scene;
use brinell::contact::history::LARGEST_INDENTATION;
use brinell::contact::loading::AnyLoading;
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Loading, Model, Pair};

/// What a contact loses, over the depth that it has been loaded to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Losses {
    /// The more the deeper.
    Grow,
    /// Somewhere less the deeper.
    Fall,
    /// Somewhere less than nothing: unloading gives back more than loading took.
    BelowZero,
}

/// Largest indentations that are looked at, in yield indentations for [`UNIT_PRESSURE_FACTOR`], and how many.
const DEPTHS: (f64, f64, u32) = (0.1, 1e4, 300);

/// Mean pressure over the yield strength at the depth that is the unit of [`DEPTHS`].
const UNIT_PRESSURE_FACTOR: f64 = 1.1;

/// More corners than any law has.
const MOST_CORNERS: usize = 64;

/// Energies that differ by no more than this part are the same: a few roundings, and quadrature.
const ROUNDING: f64 = 1e-12;

/// Bodies that stand for all, if parameters of the unit can be set: effective modulus over yield strength, and Poisson's ratio.
const MODULI: [f64; 4] = [10.0, 100.0, 1e3, 1e5];
const POISSONS_RATIOS: [f64; 3] = [-0.99, 0.0, 0.5];

/// Parameters that don't change the bodies.
const NO_BODIES: [&str; 3] = ["initial_gap", "restitution", "effective_mass"];

/// How the losses change with the depth, at worst, on the bodies that the unit of `scene` can have.
pub fn losses(scene: &Scene) -> Losses {
    // what these laws do is damping, or nothing
    if scene.damped.is_some() || scene.unloading.is_none() {
        return Losses::Grow;
    }
    let of_groups = scene.by_bodies(|group| losses_of(&scene.model_of(group)));
    let mut worst = of_groups.into_iter().max().unwrap_or(Losses::Grow);
    let own = scene.contacts.iter().flat_map(|group| &group.own);
    if scene.parameters.iter().chain(own).any(|parameter| parameter.settable && !NO_BODIES.contains(&parameter.name)) {
        for (modulus, poissons_ratio) in
            MODULI.iter().flat_map(|modulus| POISSONS_RATIOS.map(|ratio| (*modulus, ratio)))
        {
            if worst == Losses::BelowZero {
                break;
            }
            let model = scene.model();
            let modulus = modulus * model.pair.yield_strength;
            let youngs_modulus = modulus * (1.0 - poissons_ratio * poissons_ratio);
            let pair = Pair { modulus, youngs_modulus, poissons_ratio, ..model.pair };
            worst = worst.max(losses_of(&Model { pair, ..model }));
        }
    }
    worst
}

fn losses_of(model: &Model<AnyLoading, AnyUnloading>) -> Losses {
    let mut worst = Losses::Grow;
    let mut before = 0.0;
    for depth in depths(model) {
        let work = model.loading.work(&model.pair, depth);
        let loss = work - model.recovered_work(depth, depth);
        if !loss.is_finite() {
            // the law ends here
            break;
        }
        if loss < -ROUNDING * work {
            return Losses::BelowZero;
        }
        if loss < before - ROUNDING * work {
            worst = Losses::Fall;
        }
        before = loss;
    }
    worst
}

/// The depths that are looked at [m], in order, among them both sides of every corner.
fn depths(model: &Model<AnyLoading, AnyUnloading>) -> Vec<f64> {
    let (low, high, count) = DEPTHS;
    let unit = model.pair.yield_point(UNIT_PRESSURE_FACTOR).indentation;
    let depth = |step| unit * low * (high / low).powf(f64::from(step) / f64::from(count));
    let mut depths: Vec<f64> = (0..=count).map(depth).collect();
    let mut corner = 0.0;
    for _ in 0..MOST_CORNERS {
        corner = model.loading.next_corner(&model.pair, corner);
        if corner >= unit * high || corner >= LARGEST_INDENTATION {
            break;
        }
        depths.extend([corner.next_down(), corner]);
    }
    depths.sort_by(f64::total_cmp);
    depths
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn losses_by(law: &str, more: &str) -> Losses {
        let text = format!(
            "name = \"ball\"\nimpactor = {{ radius = 5e-3 }}\n\
             target = {{ youngs_modulus = 2e11, poissons_ratio = 0.3, yield_strength = 3e8 }}\nlaw = {{ {law} }}\n{more}"
        );
        losses(&Scene::parse(text, Path::new("scene.toml")).unwrap_or_else(|error| panic!("{law}: {error}")))
    }

    /// What is known of them: `tests/support/physics.rs` has the reasons.
    #[test]
    fn laws_that_make_energy_are_told_from_those_that_do_not() {
        for loading in ["big-alabo", "brinell", "thornton", "zhao-maietta-chang", "walton-braun", "luding", "hertz"] {
            assert_eq!(losses_by(&format!("loading = \"{loading}\""), ""), Losses::Grow, "{loading}");
        }
        for loading in ["stronge", "johnson", "kogut-etsion", "ghaednia", "brake-2012-tangent", "brake-2015"] {
            assert_eq!(losses_by(&format!("loading = \"{loading}\""), ""), Losses::BelowZero, "{loading}");
        }
        assert_eq!(losses_by("loading = \"tsuji\", restitution = 0.5", ""), Losses::Grow);
    }

    /// With this unloading the law loses something on every body; the guard leaves no law below zero.
    #[test]
    fn what_a_law_makes_depends_on_its_unloading_and_on_the_guard() {
        let guarded = losses_by("loading = \"stronge\", passivity_guard = true", "");
        assert!(guarded < Losses::BelowZero, "{guarded:?}");
        assert_eq!(losses_by("loading = \"stronge\", unloading = \"walton-braun\"", ""), Losses::Grow);
    }

    /// `jackson-green` with its own unloading loses energy on these bodies, and makes some on others.
    #[test]
    fn bodies_that_can_be_set_count() {
        let law = "loading = \"jackson-green\", unloading = \"jackson\"";
        assert_eq!(losses_by(law, ""), Losses::BelowZero);
        assert_eq!(losses_by(law, "fmu = { parameters = [\"initial_gap\"] }"), Losses::Grow);
    }
}
