//! The models of a scene's bodies with laws chosen by name, as commands compare them. `scene/laws.rs` checks those of the scene.

use crate::model::{AnyModel, Dampings, RateLaw, paired};
use crate::nearest::unknown;
use crate::pairing::{self, LINE, TABLE, unloading_of};
use crate::scene::{Scene, SceneLaws};
use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Model, Pair};

/// A model of the scene, with laws that may differ from the scene's.
#[derive(Clone)]
pub struct Choice {
    /// The law as requested.
    pub name: String,
    /// The names of both laws: `big-alabo/contact-radius`, or `hunt-crossley/exact`.
    pub laws: String,
    pub model: AnyModel,
}

/// End of the names of laws with the passivity guard.
const GUARDED: &str = " guarded";

impl Choice {
    /// The same laws on another form of their scene.
    pub fn on(&self, scene: &Scene) -> Option<Choice> {
        let own = own(scene);
        if own.laws == self.laws { Some(own) } else { choose_one(scene, &self.name).ok() }
    }

    /// The names of the loading law and of the unloading law. An elastic law has no unloading law; a rate-dependent law has the
    /// name of its damping instead.
    pub fn names(&self) -> (&str, Option<&str>) {
        let laws = self.laws.strip_suffix(GUARDED).unwrap_or(&self.laws);
        laws.split_once('/').map_or((laws, None), |(loading, other)| (loading, Some(other)))
    }

    /// Whether the laws have the passivity guard.
    pub fn is_guarded(&self) -> bool {
        self.laws.ends_with(GUARDED)
    }

    /// Whether a body can yield.
    pub fn yields(&self) -> bool {
        self.model.elastoplastic().is_some() && self.laws != "hertz"
    }
}

/// Laws that a scene cannot have.
#[derive(Debug, thiserror::Error)]
pub enum UnknownLaw {
    #[error("{0}")]
    Name(String),
    #[error("{0}")]
    Pairing(String),
    #[error("the law {0} needs target.yield_strength (or a material), which the scene doesn't give")]
    NoYieldStrength(String),
}

/// The loading law of this name: with the scene's constants if it is the scene's own, otherwise with the reference constants.
fn find_loading(name: &str, scene: &Scene) -> Option<(&'static str, AnyLoading)> {
    [scene.laws.loading()].into_iter().chain(AnyLoading::ALL).find(|(known, _)| *known == name)
}

fn find_unloading(name: &str, scene: &Scene) -> Option<(&'static str, AnyUnloading)> {
    scene.laws.unloading().into_iter().chain(AnyUnloading::ALL).find(|(known, _)| *known == name)
}

/// The names of all loading laws, elastoplastic and rate-dependent.
pub fn loading_names() -> impl Iterator<Item = &'static str> {
    let damped = AnyDamped::ALL.into_iter().map(|(name, _)| name);
    AnyLoading::ALL.into_iter().map(|(name, _)| name).chain(damped)
}

/// The models for `names`: `LOADING`, `LOADING/UNLOADING` or `RATE-DEPENDENT/DAMPING`, or the scene's own if there are none.
/// "all" means every loading law, "damped" every rate-dependent law. The scene's own laws have its constants; its loading law
/// alone implies its unloading law. Any other loading law alone has the unloading law with which it was published, as in a
/// scene that names no unloading law.
///
/// # Errors
/// [`UnknownLaw`]
pub fn choose(scene: &Scene, names: &[String]) -> Result<Vec<Choice>, UnknownLaw> {
    if names.is_empty() {
        return Ok(vec![own(scene)]);
    }
    let every = |name: &String| match name.as_str() {
        "all" => {
            let all = AnyLoading::ALL.iter().filter(|(name, law)| {
                law.is_line() == scene.is_line() && (law.table().is_none() || *name == scene.laws.loading().0)
            });
            all.map(|(name, _)| (*name).to_string()).collect()
        }
        "damped" => AnyDamped::ALL.iter().map(|(name, _)| (*name).to_string()).collect(),
        _ => vec![name.clone()],
    };
    names.iter().flat_map(every).map(|name| choose_one(scene, &name)).collect()
}

/// The laws of the scene itself.
fn own(scene: &Scene) -> Choice {
    let guard = if scene.laws.is_guarded() { GUARDED } else { "" };
    let name = scene.laws.name();
    let laws = match scene.laws {
        SceneLaws::Damped(_, law) => damped_laws(name, &law),
        SceneLaws::Plastic { unloading, .. } => format!("{name}/{}", unloading.0),
        SceneLaws::Elastic { .. } => name.into(),
    };
    Choice { name: format!("{name}{guard}"), laws: format!("{laws}{guard}"), model: scene.any_model() }
}

/// A rate-dependent law with the name of its damping, if it has several.
fn damped_laws(name: &str, law: &AnyDamped) -> String {
    let dampings = law.dampings();
    let own = dampings.into_iter().find(|damping| law.with_damping(damping) == Some(*law));
    own.map_or(name.into(), |damping| format!("{name}/{damping}"))
}

fn choose_one(scene: &Scene, name: &str) -> Result<Choice, UnknownLaw> {
    let (loading_name, other_name) = name.split_once('/').map_or((name, None), |(one, other)| (one, Some(other)));
    let is_line = loading_name == LINE;
    if loading_name == TABLE && scene.laws.name() != TABLE {
        let message =
            "table is a curve of one's own, and the scene names no file: law = { loading = { table = \"file.csv\" } }";
        return Err(UnknownLaw::Pairing(message.into()));
    }
    if is_line != scene.is_line() && loading_names().any(|known| known == loading_name) {
        let [law, body] = if is_line { ["cylinders", "ball"] } else { ["balls", "cylinder"] };
        let message = format!("{loading_name} is a law of {law}, and the impactor of the scene is a {body}");
        return Err(UnknownLaw::Pairing(message));
    }
    if let Some((_, law)) = AnyDamped::ALL.into_iter().find(|(known, _)| *known == loading_name) {
        return choose_damped(scene, name, law, other_name);
    }
    let no_loading = || UnknownLaw::Name(unknown("loading law", loading_name, loading_names()));
    let (_, loading) = find_loading(loading_name, scene).ok_or_else(no_loading)?;
    if loading_name == "hertz" && other_name.is_none() {
        let model = scene.with_loss(0, Model { loading, ..scene.model() });
        return Ok(Choice { name: name.into(), laws: name.into(), model });
    }
    let is_own = loading_name == scene.laws.name();
    let unloading = match other_name {
        None if is_own => scene.laws.unloading().or(Some(unloading_of(loading_name))),
        None => find_unloading(unloading_of(loading_name).0, scene),
        Some(asked) => find_unloading(asked, scene),
    };
    let (chosen, unloading) = unloading.ok_or_else(|| {
        let known = AnyUnloading::ALL.iter().map(|(name, _)| *name);
        UnknownLaw::Name(unknown("unloading law", other_name.unwrap_or_default(), known))
    })?;
    if loading_name != "hertz" {
        pairing::check(loading_name, chosen).map_err(UnknownLaw::Pairing)?;
        pairing::check_ties((loading_name, loading), (chosen, unloading)).map_err(UnknownLaw::Pairing)?;
    }
    let yield_strength = scene.yield_strength_for(&loading).ok_or_else(|| UnknownLaw::NoYieldStrength(name.into()))?;
    let pair = Pair { yield_strength, ..scene.model().pair };
    let model = Model { pair, loading, unloading, surface: scene.contacts[0].surface };
    let model = paired(&model, scene.two_bodies(0), scene.softer(0)).prepared();
    let laws = format!("{loading_name}/{chosen}");
    Ok(Choice { name: name.into(), laws, model: scene.with_loss(0, model) })
}

/// A rate-dependent law for comparison with the scene's own. Its damping is for the restitution that the scene requires, or for
/// that of the scene's impact with its own law.
fn choose_damped(scene: &Scene, name: &str, law: AnyDamped, damping: Option<&str>) -> Result<Choice, UnknownLaw> {
    let law = match (damping, scene.laws) {
        (Some(asked), _) => law
            .with_damping(asked)
            .ok_or_else(|| UnknownLaw::Name(unknown("damping", asked, law.dampings().into_iter())))?,
        (None, SceneLaws::Damped(own, law)) if own == name => law,
        _ => law,
    };
    let given = scene.value("restitution");
    let restitution = given.or_else(|| scene.any_model().restitution(&scene.impact_of(0))).filter(|e| *e > 0.0);
    let restitution = restitution.map_or(1.0, |e| e.min(1.0));
    let model = RateLaw { law, restitution, mass: scene.impact_of(0).mass }.on(scene.model().pair);
    let laws = damped_laws(name.split('/').next().unwrap_or_default(), &law);
    Ok(Choice { name: name.into(), laws, model })
}
