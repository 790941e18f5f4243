//! Whether a law is passive: whether the dissipated energy never decreases as the indentation grows.
//!
//! Where it decreases, an impact into the dent returns more energy than was put in. If the dissipated energy becomes negative,
//! the same holds for an impact on an untouched surface: its restitution is above 1. The table of laws states this for the
//! published constants and all bodies, and tests verify it. For other constants, the program evaluates the law.

use crate::scene::{Scene, SceneLaws};
use crate::{pairing, table};
use brinell_contact::LARGEST_INDENTATION;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Loading, Model, Pair};

/// Whether the FMU of a scene can return energy that was not put in, for all values of its settable parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Energy {
    /// The dissipated energy never decreases.
    Passive,
    /// The guard ensures that a contact returns no more energy than it took. The dissipated energy may decrease.
    Guarded,
    /// The dissipated energy may decrease.
    MayBeMade {
        /// The laws are passive if Poisson's ratio of the softer body is at least this value; `None` if they may always return too
        /// much.
        below_poissons_ratio: Option<f64>,
    },
}

/// The energy balance of the FMU of `scene`.
pub fn of(scene: &Scene) -> Energy {
    // rate-dependent laws and Hertz's law have no unloading law
    let SceneLaws::Plastic { loading, unloading, passivity_guard, .. } = scene.laws else { return Energy::Passive };
    let below = if is_published(scene) { told(loading.0, unloading.0) } else { found(scene, unloading.1) };
    let lowest = (0..scene.contacts.len()).map(|group| lowest_poissons_ratio(scene, group)).fold(0.5, f64::min);
    match below {
        Below::Never => Energy::Passive,
        Below::Ratio(below) if lowest >= below => Energy::Passive,
        _ if passivity_guard => Energy::Guarded,
        Below::Ratio(below) => Energy::MayBeMade { below_poissons_ratio: Some(below) },
        Below::Any => Energy::MayBeMade { below_poissons_ratio: None },
    }
}

/// Whether the FMU of `scene`, whose laws have this `energy` balance, may leave a dent above the original surface. Other
/// constants than the published ones may always do so where the laws are not passive.
pub fn dents_above_surface(scene: &Scene, energy: Energy) -> bool {
    energy != Energy::Passive
        && (!is_published(scene) || may_dent_above(scene.laws.loading().0, scene.laws.unloading()))
}

/// Whether two laws with their published constants may leave a dent above the original surface, according to the table.
fn may_dent_above(loading: &str, unloading: Option<(&str, AnyUnloading)>) -> bool {
    let energy = table::loading_law(loading).energy.as_ref();
    let listed = |name| energy.is_some_and(|energy| energy.dents_above_surface.iter().any(|other| other == name));
    unloading.is_some_and(|(name, _)| listed(name))
}

/// The energy balance of the FMU of `scene`, in words.
pub fn words(scene: &Scene) -> String {
    match of(scene) {
        Energy::Passive => "Together, these laws make no energy: dissipated energy never falls.".into(),
        Energy::Guarded => {
            "With the guard, no contact returns more energy than it took. Dissipated energy may still fall \
            where a deeper dent loses less."
                .into()
        }
        Energy::MayBeMade { below_poissons_ratio } => {
            let below = below_poissons_ratio.map(|ratio| format!(" below a Poisson's ratio of {ratio}"));
            format!(
                "Together, these laws may make energy{}: dissipated energy may fall, and an impact on an untouched surface \
                 may have a restitution above 1.{}",
                below.unwrap_or_default(),
                published_words(scene)
            )
        }
    }
}

/// The statement of the table about the surplus of the laws of `scene`, if they have their published constants.
fn published_words(scene: &Scene) -> String {
    let law = table::loading_law(scene.laws.loading().0);
    let Some(energy) = law.energy.as_ref().filter(|_| is_published(scene)) else { return String::new() };
    let partner = law.unloading.as_deref().unwrap_or("contact-radius");
    let largest = match scene.laws.unloading() {
        Some((unloading, _)) if unloading == partner => format!(
            " The largest is {} ({} below a Poisson's ratio of 0).",
            energy.restitution, energy.auxetic_restitution
        ),
        _ => String::new(),
    };
    format!("{largest} {}", energy.why)
}

/// Whether both laws of `scene` have their published constants.
fn is_published(scene: &Scene) -> bool {
    let (loading, unloading) = (scene.laws.loading(), scene.laws.unloading());
    // a curve of one's own is made passive
    if loading.1.table().is_some() {
        return true;
    }
    pairing::published(loading.0) == loading.1
        && unloading.is_none_or(|unloading| AnyUnloading::ALL.contains(&unloading))
}

/// The Poisson's ratio below which laws may return too much energy.
enum Below {
    Never,
    Ratio(f64),
    Any,
}

/// The statement of the table about two laws.
fn told(loading: &str, unloading: &str) -> Below {
    let Some(energy) = &table::loading_law(loading).energy else { return Below::Never };
    match energy.passive.iter().find(|passive| passive.unloading == unloading) {
        Some(passive) => passive.from_poissons_ratio.map_or(Below::Never, Below::Ratio),
        None => Below::Any,
    }
}

/// Whether two laws with their published constants are passive for all bodies; if not, the Poisson's ratio of the target from
/// which they are, if any.
pub fn is_passive(loading: &str, unloading: &str) -> (bool, Option<f64>) {
    match told(loading, unloading) {
        Below::Never => (true, None),
        Below::Ratio(ratio) => (false, Some(ratio)),
        Below::Any => (false, None),
    }
}

/// The result of evaluating the laws of `scene`, without a guard on its `unloading`, on bodies that its FMU can have.
fn found(scene: &Scene, unloading: AnyUnloading) -> Below {
    let everywhere = table::loading_law(scene.laws.loading().0).depends_on_modulus_ratio;
    let mut looked_at = Vec::new();
    for group in 0..scene.contacts.len() {
        let model = Model { unloading, ..scene.model_of(group) };
        let settable = |names: &[&str]| names.iter().any(|name| is_settable(scene, group, name));
        let one = |value: f64| (value, value);
        let Pair { poissons_ratio, modulus, yield_strength, .. } = model.pair;
        let ratios = if settable(poissons_ratios(scene)) { POISSONS_RATIO } else { one(poissons_ratio) };
        let moduli = match modulus / yield_strength {
            _ if !everywhere => one(ANY_MODULUS_RATIO),
            _ if settable(&STIFFNESS) => MODULUS_RATIO,
            own => one(own),
        };
        if looked_at.contains(&(ratios, moduli)) {
            continue;
        }
        if bodies(&model.pair, ratios, moduli).any(|pair| makes_energy(&Model { pair, ..model })) {
            return Below::Any;
        }
        looked_at.push((ratios, moduli));
    }
    Below::Never
}

/// The parameters on which `E*/S` depends.
const STIFFNESS: [&str; 5] = [
    "target.youngs_modulus",
    "target.yield_strength",
    "impactor.youngs_modulus",
    "impactor.poissons_ratio",
    "impactor.yield_strength",
];

/// Poisson's ratios of the bodies that may yield.
fn poissons_ratios(scene: &Scene) -> &'static [&'static str] {
    const BOTH: [&str; 2] = ["target.poissons_ratio", "impactor.poissons_ratio"];
    if scene.has_two_strengths() { &BOTH } else { &BOTH[..1] }
}

fn is_settable(scene: &Scene, group: usize, name: &str) -> bool {
    let mut all = scene.contacts[group].own.iter().chain(&scene.parameters);
    all.find(|parameter| parameter.name == name).is_some_and(|parameter| parameter.settable)
}

/// The lowest Poisson's ratio that a body of `group` which may yield can have.
fn lowest_poissons_ratio(scene: &Scene, group: usize) -> f64 {
    let of = |name: &&str| {
        let value = scene.group_value(group, name).unwrap_or(POISSONS_RATIO.0);
        if is_settable(scene, group, name) { POISSONS_RATIO.0 } else { value }
    };
    poissons_ratios(scene).iter().map(of).fold(POISSONS_RATIO.1, f64::min)
}

/// Range of Poisson's ratios that an FMU accepts.
const POISSONS_RATIO: (f64, f64) = (-0.99, 0.5);

/// Range of `E*/S` for the evaluation: far beyond all metals at both ends.
const MODULUS_RATIO: (f64, f64) = (1.0, 1e9);

/// One `E*/S` for laws whose normalised curve does not depend on it.
const ANY_MODULUS_RATIO: f64 = 1e3;

/// Bodies with the size and modulus of `pair`, over ranges of Poisson's ratio and `E*/S`, with a rigid impactor.
fn bodies(pair: &Pair, poissons_ratio: (f64, f64), modulus_ratio: (f64, f64)) -> impl Iterator<Item = Pair> {
    const STEPS: u32 = 8;
    let steps = |(low, high): (f64, f64)| 0..=if low == high { 0 } else { STEPS };
    let part = |step: u32| f64::from(step) / f64::from(STEPS);
    let pair = *pair;
    steps(poissons_ratio).flat_map(move |first| {
        let ratio = poissons_ratio.0 + (poissons_ratio.1 - poissons_ratio.0) * part(first);
        steps(modulus_ratio).map(move |second| {
            let modulus_ratio = modulus_ratio.0 * libm::pow(modulus_ratio.1 / modulus_ratio.0, part(second));
            Pair {
                yield_strength: pair.modulus / modulus_ratio,
                youngs_modulus: pair.modulus * (1.0 - ratio * ratio),
                poissons_ratio: ratio,
                ..pair
            }
        })
    })
}

/// A surplus up to this fraction of the work is attributed to rounding and to the integrals.
const ROUNDING: f64 = 1e-10;

/// Mean pressure over the yield strength at the depth that is the unit of the evaluated range.
const UNIT_PRESSURE_FACTOR: f64 = 1.1;

/// Whether the dissipated energy decreases anywhere as the largest indentation grows, as far as the law can be evaluated.
fn makes_energy(model: &Model<AnyLoading, AnyUnloading>) -> bool {
    let (mut before, mut work, mut most_lost) = (0.0, 0.0, 0.0f64);
    for depth in depths(model) {
        // an integral continues from the previous depth
        let more = model.loading.work_between(&model.pair, before, depth);
        work = more.map_or_else(|| model.loading.work(&model.pair, depth), |more| work + more);
        let recovered = model.recovered_work(depth, depth);
        if !(work.is_finite() && recovered.is_finite()) {
            return false;
        }
        let lost = work - recovered;
        if lost < most_lost - ROUNDING * work {
            return true;
        }
        most_lost = most_lost.max(lost);
        before = depth;
    }
    false
}

/// Increasing depths \[m\]: over the decades around yield, and close to the corners of the law on both sides.
fn depths(model: &Model<AnyLoading, AnyUnloading>) -> Vec<f64> {
    let unit = model.pair.yield_point(UNIT_PRESSURE_FACTOR).indentation;
    let mut depths: Vec<f64> = (0..=420).map(|step| unit * libm::pow(10.0, f64::from(step) / 60.0 - 2.0)).collect();
    let mut corner = model.loading.next_corner(&model.pair, 0.0);
    while corner < LARGEST_INDENTATION {
        let near = (0..24).map(|step| libm::pow(10.0, f64::from(step) / 3.0 - 8.5));
        depths.extend(near.flat_map(|part| [corner * (1.0 - part), corner * (1.0 + part)]).chain([corner]));
        corner = model.loading.next_corner(&model.pair, corner);
    }
    depths.sort_by(f64::total_cmp);
    depths
}
