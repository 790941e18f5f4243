//! Choosing laws by name, and which go together.

use crate::model::{AnyModel, Dampings};
use crate::parameters;
use crate::scene::Scene;
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

/// Unloading laws that were fitted to one loading law, in its units.
const FITTED_TO: [(&str, &str); 3] =
    [("etsion", "kogut-etsion"), ("jackson", "jackson-green"), ("vu-quoc-zhang", "vu-quoc-zhang")];

/// Loading laws that go only with the unloading law of the same name, and why.
const MADE_FOR_ITSELF: [(&str, &str); 2] = [
    ("walton-braun", "it has no elastic part"),
    ("luding", "it has no elastic part, and a limit beyond which it is elastic again"),
];

/// Loading laws that are above Hertz's curve in places, so that Hertz's curve can't be lowered to them.
const ABOVE_HERTZ: [&str; 8] = [
    "stronge",
    "johnson",
    "kogut-etsion",
    "jackson-green",
    "ghaednia",
    "brake-2012-tangent",
    "brake-2012-line",
    "brake-2015",
];

/// Refuses two laws that don't make sense together.
///
/// # Errors
/// Why they don't, and what does.
pub fn check_pairing(loading: &str, unloading: &str) -> Result<(), String> {
    let pair = format!("law.loading = \"{loading}\" doesn't go with law.unloading = \"{unloading}\"");
    if let Some((own, why)) = MADE_FOR_ITSELF.iter().find(|(own, _)| *own == loading && loading != unloading) {
        return Err(format!("{pair}: {why}, and unloads by \"{own}\""));
    }
    if loading != "luding" && unloading == "luding" {
        return Err(format!("{pair}: that stiffens up to the limit of the loading law \"luding\""));
    }
    if unloading == "hertz-shift" && ABOVE_HERTZ.contains(&loading) {
        return Err(format!("{pair}: its curve is above Hertz's in places, which can't be lowered to it"));
    }
    match FITTED_TO.iter().find(|(name, fitted)| *name == unloading && *fitted != loading) {
        Some((_, fitted)) => Err(format!("{pair}: that was fitted to the loading law \"{fitted}\"")),
        None => Ok(()),
    }
}

/// Refuses two laws whose constants contradict each other.
///
/// # Errors
/// What must be the same, or stay as published.
pub fn check_ties(loading: (&str, AnyLoading), unloading: (&str, AnyUnloading)) -> Result<(), String> {
    parameters::check_ties((loading.0, &loading.1, &published(loading.0)), (unloading.0, &unloading.1))
}

/// The loading law `name`, which there is, with its reference constants.
pub fn published(name: &str) -> AnyLoading {
    let found = AnyLoading::ALL.into_iter().find(|(known, _)| *known == name);
    found.expect("a law that was found by its name").1
}

/// The unloading law of a scene that names none: "contact-radius", where it can be.
pub fn default_unloading(loading: &str) -> &'static str {
    MADE_FOR_ITSELF.iter().find(|(own, _)| *own == loading).map_or("contact-radius", |(own, _)| own)
}

/// Loading laws that were published with an unloading law of another name.
const OWN_UNLOADING: [(&str, &str); 8] = [
    ("yigit-christoforou", "hertz-shift"),
    ("brake-2012-tangent", "thornton"),
    ("brake-2012-line", "thornton"),
    ("brake-2015", "thornton"),
    ("ghaednia", "thornton"),
    ("kogut-etsion", "etsion"),
    ("jackson-green", "jackson"),
    ("ma-liu", "thornton"),
];

/// The unloading that belongs to a loading law: the one it was published with, or the scene's.
pub fn unloading_of(loading: &str, scene: &Scene) -> (&'static str, AnyUnloading) {
    let published = OWN_UNLOADING.iter().find(|(name, _)| *name == loading).map_or(loading, |(_, own)| own);
    let own = AnyUnloading::ALL.into_iter().find(|(name, _)| *name == published);
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
        check_pairing(loading_name, chosen).map_err(UnknownLaw::Pairing)?;
        check_ties((loading_name, loading), (chosen, unloading)).map_err(UnknownLaw::Pairing)?;
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
    let restitution = given.or_else(|| scene.any_model().restitution(&scene.impact)).filter(|e| *e > 0.0);
    let restitution = restitution.map_or(1.0, |e| e.min(1.0));
    let model = damped::Model { pair: scene.model().pair, law, restitution, mass: scene.impact.mass };
    Ok(Choice { name: name.into(), model: AnyModel::Damped(model) })
}
