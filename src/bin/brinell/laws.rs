//! Choosing laws by name.

use crate::model::{AnyModel, Dampings};
use crate::pairing;
use crate::scene::Scene;
use crate::table;
use brinell::contact::damped::{self, AnyDamped};
use brinell::contact::loading::AnyLoading;
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Model, Pair};

/// A model of the scene with laws that may be others than the scene's.
#[derive(Clone)]
pub struct Choice {
    /// The laws' names.
    pub name: String,
    pub model: AnyModel,
}

/// Laws that can't be had.
#[derive(Debug, thiserror::Error)]
pub enum UnknownLaw {
    #[error("unknown {kind} law `{name}`, expected one of `{known}`")]
    Name { kind: &'static str, name: String, known: String },
    #[error("{0}")]
    Pairing(String),
    #[error("the law {0} needs target.yield_strength (or a material), which the scene hasn't got")]
    NoYieldStrength(String),
}

/// The loading law `name`, which there is, with its reference constants.
pub fn published(name: &str) -> AnyLoading {
    let found = AnyLoading::ALL.into_iter().find(|(known, _)| *known == name);
    found.expect("a law that was found by its name").1
}

/// The unloading that belongs to a loading law: the one it was published with, or the scene's.
pub fn unloading_of(loading: &str, scene: &Scene) -> (&'static str, AnyUnloading) {
    let published = table::loading_law(loading).unloading.as_deref();
    let own = AnyUnloading::ALL.into_iter().find(|(name, _)| published == Some(*name));
    own.or(scene.unloading).unwrap_or(AnyUnloading::ALL[0])
}

/// The laws of these names: with the scene's constants if they are the scene's own, else with those of the reference.
fn find_loading(name: &str, scene: &Scene) -> Option<(&'static str, AnyLoading)> {
    [scene.loading].into_iter().chain(AnyLoading::ALL).find(|(known, _)| *known == name)
}

fn find_unloading(name: &str, scene: &Scene) -> Option<(&'static str, AnyUnloading)> {
    scene.unloading.into_iter().chain(AnyUnloading::ALL).find(|(known, _)| *known == name)
}

/// The models that `names` mean: `LOADING`, `LOADING/UNLOADING` or `RATE-DEPENDENT/DAMPING`, or the scene's own if there are
/// none; "all" is every loading law, "damped" every rate-dependent one. Laws that are the scene's have its constants; its
/// loading law alone means its unloading law too.
///
/// # Errors
/// [`UnknownLaw`]
pub fn choose(scene: &Scene, names: &[String]) -> Result<Vec<Choice>, UnknownLaw> {
    if names.is_empty() {
        let guard = if scene.passivity_guard { " guarded" } else { "" };
        let name = scene.damped.map_or(scene.loading.0, |(name, _)| name);
        return Ok(vec![Choice { name: format!("{name}{guard}"), model: scene.any_model() }]);
    }
    let every = |name: &String| match name.as_str() {
        "all" => AnyLoading::ALL.iter().map(|(name, _)| (*name).to_string()).collect(),
        "damped" => AnyDamped::ALL.iter().map(|(name, _)| (*name).to_string()).collect(),
        _ => vec![name.clone()],
    };
    names.iter().flat_map(every).map(|name| choose_one(scene, &name)).collect()
}

fn choose_one(scene: &Scene, name: &str) -> Result<Choice, UnknownLaw> {
    let (loading_name, other_name) = name.split_once('/').map_or((name, None), |(one, other)| (one, Some(other)));
    if let Some((_, law)) = AnyDamped::ALL.into_iter().find(|(known, _)| *known == loading_name) {
        return choose_damped(scene, name, law, other_name);
    }
    let loading = find_loading(loading_name, scene);
    let (_, loading) = loading.ok_or_else(|| {
        let damped = AnyDamped::ALL.iter().map(|(name, _)| *name);
        unknown("loading", loading_name, AnyLoading::ALL.iter().map(|(name, _)| *name).chain(damped).collect())
    })?;
    if loading_name == "hertz" && other_name.is_none() {
        return Ok(Choice { name: name.into(), model: AnyModel::Elastoplastic(Model { loading, ..scene.model() }) });
    }
    let unloading = match other_name {
        None if loading_name == scene.loading.0 => scene.unloading.or(Some(unloading_of(loading_name, scene))),
        None => find_unloading(unloading_of(loading_name, scene).0, scene),
        Some(asked) => find_unloading(asked, scene),
    };
    let known = || AnyUnloading::ALL.iter().map(|(name, _)| *name).collect();
    let asked = other_name.unwrap_or_default();
    let (chosen, unloading) = unloading.ok_or_else(|| unknown("unloading", asked, known()))?;
    if loading_name != "hertz" {
        pairing::check(loading_name, chosen).map_err(UnknownLaw::Pairing)?;
        pairing::check_ties((loading_name, loading), (chosen, unloading)).map_err(UnknownLaw::Pairing)?;
    }
    let yield_strength = scene.yield_strength.ok_or_else(|| UnknownLaw::NoYieldStrength(name.into()))?;
    let pair = Pair { yield_strength, ..scene.model().pair };
    let model = Model { pair, loading, unloading, surface: scene.contacts[0].surface };
    Ok(Choice { name: name.into(), model: AnyModel::Elastoplastic(model) })
}

fn unknown(kind: &'static str, name: &str, known: Vec<&str>) -> UnknownLaw {
    UnknownLaw::Name { kind, name: name.into(), known: known.join("`, `") }
}

/// A rate-dependent law beside the scene's own: made for the restitution that the scene asks for, or that its law gives the
/// scene's impact.
fn choose_damped(scene: &Scene, name: &str, law: AnyDamped, damping: Option<&str>) -> Result<Choice, UnknownLaw> {
    let own = scene.damped.filter(|(own, _)| name.split('/').next() == Some(own));
    let law = match (damping, own) {
        (Some(asked), _) => law.with_damping(asked).ok_or_else(|| unknown("damping", asked, law.dampings()))?,
        (None, Some((_, own))) => own,
        (None, None) => law,
    };
    let given = scene.value("restitution");
    let restitution = given.or_else(|| scene.any_model().restitution(&scene.impact_of(0))).filter(|e| *e > 0.0);
    let restitution = restitution.map_or(1.0, |e| e.min(1.0));
    let model = damped::Model { pair: scene.model().pair, law, restitution, mass: scene.impact_of(0).mass };
    Ok(Choice { name: name.into(), model: AnyModel::Damped(model) })
}
