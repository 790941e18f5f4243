//! The sphere and the half-space of the reference tables, and every pair of laws.

use crate::{laws, long};
use brinell_contact::loading::AnyLoading;
use brinell_contact::material::YieldPoint;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Body, History, Loading, Model, Numbered, OtherBody, Pair, Surface, TwoBodies};
use std::f64::consts::PI;
use std::mem::discriminant;

/// A model with laws chosen at run time.
pub type AnyModel = Model<AnyLoading, AnyUnloading>;

/// Mass of the sphere of [`mild`]: radius 5 mm, 7850 kg/m^3 \[kg\].
pub const MASS: f64 = 4.0 / 3.0 * PI * 0.005 * 0.005 * 0.005 * 7850.0;

/// The "mild" pair of the tables: a rigid sphere of 5 mm on steel with a yield strength of 300 MPa.
pub fn mild() -> Pair {
    let sphere = Body { radius: 0.005, youngs_modulus: f64::INFINITY, poissons_ratio: 0.3 };
    let steel = Body { radius: f64::INFINITY, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    Pair::new(&sphere, &steel, 300e6).expect("a sphere on a plane touches in one point")
}

/// Any bodies that an FMU accepts: Poisson's ratio from -0.99 to 0.5, `E*/S` from 0.1 to 1e9, an impactor that is rigid or
/// softer than the target.
pub fn random_bodies(random: &mut Random) -> Pair {
    let mut decades = |low: f64, high: f64| 10f64.powf(low + (high - low) * random.next());
    let (radius, modulus) = (decades(-9.0, 3.0), decades(3.0, 15.0));
    let yield_strength = modulus / decades(-1.0, 9.0);
    let softness = decades(0.0, 2.0);
    let poissons_ratio = -0.99 + 1.49 * random.next();
    let youngs_modulus = softness * modulus * (1.0 - poissons_ratio * poissons_ratio);
    Pair { radius, modulus, yield_strength, youngs_modulus, poissons_ratio }
}

/// A rigid sphere of effective radius `radius` \[m\] on a half-space of effective modulus `modulus` \[Pa\], nu = 0.3.
pub fn pair_of(radius: f64, modulus: f64, yield_strength: f64) -> Pair {
    let poissons_ratio = 0.3;
    let youngs_modulus = modulus * (1.0 - poissons_ratio * poissons_ratio);
    Pair { radius, modulus, yield_strength, youngs_modulus, poissons_ratio }
}

/// The elastic body beside the one that yields: what the moduli of the pair leave for it, rigid if nothing is left.
pub fn elastic_partner(pair: &Pair) -> OtherBody {
    let rest = 1.0 / pair.modulus - 1.0 / pair.yielding_modulus();
    let modulus = if rest * pair.modulus > 1e-12 { 1.0 / rest } else { f64::INFINITY };
    OtherBody { modulus, poissons_ratio: 0.3, ..OtherBody::RIGID }
}

/// The law `brinell` for `pair` and what it needs to know beside that, as FMUs have it.
pub fn brinell(pair: Pair, bodies: TwoBodies) -> AnyModel {
    construction(pair, bodies).prepared()
}

/// The same, which asks the construction at each point.
pub fn construction(pair: Pair, bodies: TwoBodies) -> AnyModel {
    let plain = AnyModel { pair, ..model("brinell", "brinell") };
    AnyModel { loading: plain.loading.of_bodies(bodies), ..plain }
}

/// The unit of indentation and force of every table: the point where the mean pressure reaches 1.1 S.
///
/// It is the same for all laws, so that Hertz's law, which never yields, has a scale too.
pub fn unit(pair: &Pair) -> YieldPoint {
    pair.yield_point(1.1)
}

/// The loading law of that name.
pub fn loading(name: &str) -> AnyLoading {
    let found = AnyLoading::ALL.into_iter().find(|(candidate, _)| *candidate == name);
    found.unwrap_or_else(|| panic!("no loading law is called {name}")).1
}

/// The unloading law of that name.
pub fn unloading(name: &str) -> AnyUnloading {
    let found = AnyUnloading::ALL.into_iter().find(|(candidate, _)| *candidate == name);
    found.unwrap_or_else(|| panic!("no unloading law is called {name}")).1
}

/// The mild pair with two laws of these names on a surface that keeps its dent.
pub fn model(loading_name: &str, unloading_name: &str) -> AnyModel {
    Model {
        pair: mild(),
        loading: loading(loading_name),
        unloading: unloading(unloading_name),
        surface: Surface::Dented,
    }
    .prepared()
}

/// Whether the two laws can be combined, according to the table of laws.
pub fn belong_together(loading_name: &str, unloading_name: &str) -> bool {
    let (loading, unloading) = (laws::entry("loading", loading_name), laws::entry("unloading", unloading_name));
    let own = loading.get("unloading").and_then(|own| own.as_str());
    let has_another = loading.contains_key("no_other_unloading") && own != Some(unloading_name);
    let made_for = unloading.get("made_for").map(|made| made["loading"].as_str().expect("a law's name"));
    !has_another
        && made_for.is_none_or(|made_for| made_for == loading_name)
        && !(laws::says(loading, "above_hertz") && laws::says(unloading, "lowers_hertz"))
}

/// The entry of the loading law of `model`. If several laws have the same type and the constants belong to none of them, it is
/// the first of these laws.
fn loading_entry(model: &AnyModel) -> &'static toml::Table {
    let same = |(_, law): &&(&str, AnyLoading)| *law == model.loading;
    let alike = |(_, law): &&(&str, AnyLoading)| discriminant(law) == discriminant(&model.loading);
    let found = AnyLoading::ALL.iter().find(same).or(AnyLoading::ALL.iter().find(alike));
    laws::entry("loading", found.expect("every law has a name").0)
}

/// The Poisson's ratio of the target from which two laws are passive, according to the table of laws; -1 if they always are,
/// `None` if they never need be.
pub fn passive_from(loading_name: &str, unloading_name: &str) -> Option<f64> {
    let Some(energy) = laws::entry("loading", loading_name).get("energy") else { return Some(-1.0) };
    let mut passive = energy["passive"].as_array().expect("a list").iter();
    let with = passive.find(|passive| passive["unloading"].as_str() == Some(unloading_name))?;
    Some(with.get("from_poissons_ratio").map_or(-1.0, |from| from.as_float().expect("a number")))
}

/// Whether the laws of `model` are passive for its bodies. They then unload below the loading curve, and leave a dent that is
/// not above the surface and deepens.
pub fn is_passive(model: &AnyModel) -> bool {
    let alike = |(_, law): &&(&str, AnyUnloading)| discriminant(law) == discriminant(&model.unloading);
    let unloading = AnyUnloading::ALL.iter().find(alike).expect("every law has a name").0;
    let loading = laws::text(loading_entry(model), "name");
    passive_from(loading, unloading).is_some_and(|from| model.pair.poissons_ratio >= from)
}

/// Whether the force of the loading curve jumps, as published, where one fit ends and the next begins.
pub fn has_jumps(model: &AnyModel) -> bool {
    laws::says(loading_entry(model), "jumps")
}

/// The fraction by which the contact radius falls at a corner, as published.
pub fn radius_falls_by(model: &AnyModel) -> f64 {
    loading_entry(model).get("radius_falls_by").map_or(0.0, |part| part.as_float().expect("a number"))
}

/// Whether the normalised loading curve is the same for all `E*/S`.
pub fn is_scale_free(model: &AnyModel) -> bool {
    !laws::says(loading_entry(model), "depends_on_modulus_ratio")
}

/// Force on the unloading path from `largest` \[m\] at `indentation` \[m\], \[N\].
pub fn unloading_force(model: &AnyModel, largest: f64, indentation: f64) -> f64 {
    model.unloading_segment(largest, indentation).force(indentation)
}

/// Stiffness at the same point \[N/m\].
pub fn unloading_stiffness(model: &AnyModel, largest: f64, indentation: f64) -> f64 {
    model.unloading_segment(largest, indentation).stiffness(indentation)
}

/// Whether the loading law of `model` yields at all.
pub fn yields(model: &AnyModel) -> bool {
    model.loading.yield_point(&model.pair).indentation < f64::INFINITY
}

/// Every loading law with every unloading law that it can be combined with, on `pair`, with a name for messages.
pub fn all_models(pair: Pair) -> Vec<(String, AnyModel)> {
    models(pair, |_, _| true)
}

/// In a long run [`all_models`]; in a usual one a third of them, with each law of both kinds, and each pair that was published as one.
pub fn some_models(pair: Pair) -> Vec<(String, AnyModel)> {
    models(pair, |place, is_own| long::is_asked() || is_own || place % 3 == 0)
}

/// Those that are taken, by the sum of their places in the lists, and whether the laws were published as one.
fn models(pair: Pair, takes: impl Fn(usize, bool) -> bool) -> Vec<(String, AnyModel)> {
    let mut models = Vec::new();
    for (row, (loading_name, loading)) in AnyLoading::ALL.into_iter().enumerate() {
        let own = laws::entry("loading", loading_name).get("unloading").and_then(|own| own.as_str());
        for (column, (unloading_name, unloading)) in AnyUnloading::ALL.into_iter().enumerate() {
            if belong_together(loading_name, unloading_name) && takes(row + column, own == Some(unloading_name)) {
                let model = Model { pair, loading, unloading, surface: Surface::Dented };
                models.push((format!("{loading_name} with {unloading_name}"), model.prepared()));
            }
        }
    }
    models
}

/// A contact of `model` that has been loaded to `indentation` \[m\].
pub fn pressed(model: &AnyModel, indentation: f64) -> History {
    History::start(model, -indentation).expect("within range")
}

/// Moves `history` by `increment` \[m\], which must be within range.
pub fn advance(history: &mut History, model: &AnyModel, increment: f64) {
    history.advance(model, increment).expect("within range");
}

/// Moves `history` to `indentation` \[m\], up to the rounding of one sum.
pub fn go(history: &mut History, model: &AnyModel, indentation: f64) {
    advance(history, model, indentation - history.indentation());
}

/// Force on the loading curve \[N\].
pub fn loading_force(model: &AnyModel, indentation: f64) -> f64 {
    model.loading.segment(&model.pair, indentation).force(indentation)
}

/// The corners of the loading curve \[m\], in order: every end of a smooth piece except the last.
pub fn corners(model: &AnyModel) -> Vec<f64> {
    let mut corners = Vec::new();
    let mut corner = model.loading.next_corner(&model.pair, 0.0);
    while corner < brinell_contact::LARGEST_INDENTATION {
        corners.push(corner);
        corner = model.loading.next_corner(&model.pair, corner);
    }
    corners
}

/// `count` numbers from `first` to `last` in geometric progression.
pub fn logarithmic(first: f64, last: f64, count: usize) -> impl Iterator<Item = f64> {
    // computed with logarithms, because the ratio of the two may overflow
    let step = (last.ln() - first.ln()) / (count - 1) as f64;
    (0..count).map(move |index| (first.ln() + step * index as f64).exp())
}

/// A small deterministic generator of numbers in [0, 1): PCG's output of a linear congruential state.
///
/// Reference: M. E. O'Neill, *PCG*, HMC-CS-2014-0905.
pub struct Random(pub u64);

impl Random {
    /// The next number.
    #[allow(clippy::should_implement_trait, reason = "it never ends, and has no other use of an iterator")]
    pub fn next(&mut self) -> f64 {
        let state = self.0;
        self.0 = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let shifted = (((state >> 18) ^ state) >> 27) as u32;
        f64::from(shifted.rotate_right((state >> 59) as u32)) / 4_294_967_296.0
    }

    /// A log-uniform number from `low` to `high`.
    pub fn log_uniform(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// `x` yield indentations \[m\] on a grid of powers of two, on which sums and differences are exact.
pub fn on_grid(x: f64) -> f64 {
    const GRID: f64 = (1u64 << 62) as f64;
    (x * unit(&mild()).indentation * GRID).round() / GRID
}

/// Moves exactly to `target` \[m\] > 0, from one side: each step at most halves or doubles the indentation, which causes no
/// rounding.
pub fn exactly(history: &mut History, model: &AnyModel, target: f64) {
    while history.indentation() != target {
        let now = history.indentation();
        let step = if target < 0.5 * now {
            -0.5 * now
        } else if target > 2.0 * now {
            now
        } else {
            target - now
        };
        advance(history, model, step);
    }
}

/// Turning points in yield indentations: through yield, reversal, separation, a new contact, deeper than before.
pub const TURNS: [f64; 13] = [0.5, 0.2, 3.0, 2.5, -1.0, 2.0, 40.0, 30.0, 39.0, -5.0, 100.0, 90.0, 200.0];
