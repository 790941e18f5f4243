//! The scene file: what is in contact, by which laws, and what the unit shows of it.

use crate::law_check;
use crate::laws;
use crate::model::{AnyModel, Dampings};
use crate::parameters::{self, Given};
use crate::table::{self, Causality, MATERIALS, VARIABLES};
use brinell::contact::damped::{self, AnyDamped};
use brinell::contact::impact::Impact;
use brinell::contact::loading::{AnyLoading, Hertz};
use brinell::contact::unloading::AnyUnloading;
use brinell::contact::{Body, Model, Pair, Surface};
use serde::Deserialize;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// A scene that has been checked.
#[derive(Debug)]
pub struct Scene {
    /// Name of the unit: a C identifier.
    pub name: String,
    pub description: String,
    /// The parameters the scene has, in the order of the table.
    pub parameters: Vec<Parameter>,
    /// The chosen outputs beside force.
    pub outputs: Vec<String>,
    pub loading: (&'static str, AnyLoading),
    /// None for an elastic contact.
    pub unloading: Option<(&'static str, AnyUnloading)>,
    /// The law of a contact whose force depends on the rate; it has no other.
    pub damped: Option<(&'static str, AnyDamped)>,
    /// Unloading gives back no more than loading took.
    pub passivity_guard: bool,
    pub surface: Surface,
    /// Yield strength of the target [Pa], if it has one, whether or not the scene's law asks for it.
    pub yield_strength: Option<f64>,
    pub impact: Impact,
    /// The scene doesn't name an impact: a solid steel ball at 1 m/s is meant.
    pub impact_is_assumed: bool,
    /// The file as it is.
    pub text: String,
}

/// A parameter of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    pub name: &'static str,
    pub value: f64,
    /// Whether it stays settable; otherwise it is a constant of the unit.
    pub settable: bool,
}

/// A scene that can't be used: where, and why.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    #[error("{}: {source}", path.display())]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error("{}:{line}:{column}: {message}", path.display())]
    Wrong { path: PathBuf, line: usize, column: usize, message: String },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: Spanned<String>,
    #[serde(default)]
    description: String,
    impactor: Impactor,
    target: Spanned<Target>,
    #[serde(default)]
    law: Law,
    #[serde(default)]
    fmu: Fmu,
    impact: Option<Spanned<ImpactTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Impactor {
    radius: Spanned<f64>,
    youngs_modulus: Option<Spanned<f64>>,
    poissons_ratio: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Target {
    material: Option<Spanned<String>>,
    youngs_modulus: Option<Spanned<f64>>,
    poissons_ratio: Option<Spanned<f64>>,
    yield_strength: Option<Spanned<f64>>,
    radius: Option<Spanned<f64>>,
    #[serde(default)]
    surface: SurfaceName,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SurfaceName {
    #[default]
    Dented,
    Fresh,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Law {
    loading: Option<Spanned<String>>,
    loading_parameters: Option<Given>,
    unloading: Option<Spanned<String>>,
    restitution: Option<Spanned<f64>>,
    damping: Option<Spanned<String>>,
    unloading_parameters: Option<Given>,
    passivity_guard: Option<Spanned<bool>>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Fmu {
    #[serde(default)]
    outputs: Vec<Spanned<String>>,
    parameters: Option<Vec<Spanned<String>>>,
    initial_gap: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ImpactTable {
    mass: Spanned<f64>,
    speed: Spanned<f64>,
}

/// A mistake at a place in the text.
pub struct Mistake(pub std::ops::Range<usize>, pub String);

impl Scene {
    /// Reads and checks the scene at `path`.
    ///
    /// # Errors
    /// [`SceneError`] with line and column of the first mistake, and what is allowed there.
    pub fn read(path: &Path) -> Result<Scene, SceneError> {
        let unreadable = |source| SceneError::Unreadable { path: path.into(), source };
        Scene::parse(std::fs::read_to_string(path).map_err(unreadable)?, path)
    }

    /// Checks the scene `text`; `path` is for messages.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn parse(text: String, path: &Path) -> Result<Scene, SceneError> {
        let checked = toml::from_str::<File>(&text)
            .map_err(|error| {
                let span = error.span().unwrap_or(0..0);
                // the parser speaks of Rust's types and doesn't name the key: the line does
                let message = error.message().replace("expected f64", "expected a number");
                let line = text[..span.start].rfind('\n').map_or(0, |end| end + 1);
                let line = text[line..].lines().next().unwrap_or_default().trim();
                Mistake(span, format!("{message} in `{line}`"))
            })
            .and_then(check);
        match checked {
            Ok(scene) => Ok(Scene { text, ..scene }),
            Err(Mistake(span, message)) => {
                let before = &text[..span.start];
                let line = before.matches('\n').count() + 1;
                let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
                Err(SceneError::Wrong { path: path.into(), line, column, message })
            }
        }
    }

    /// The value of a parameter, or of what it stands for if the scene hasn't got it.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.parameters.iter().find(|parameter| parameter.name == name).map(|parameter| parameter.value)
    }

    /// The parameters that stay settable.
    pub fn settable(&self) -> impl Iterator<Item = &Parameter> {
        self.parameters.iter().filter(|parameter| parameter.settable)
    }

    /// The bodies; none if they don't fit.
    fn pair(&self) -> Option<Pair> {
        let value = |name| self.value(name);
        let impactor = Body {
            radius: value("impactor.radius").unwrap_or(f64::NAN),
            youngs_modulus: value("impactor.youngs_modulus").unwrap_or(f64::INFINITY),
            poissons_ratio: value("impactor.poissons_ratio").unwrap_or(0.0),
        };
        let target = Body {
            radius: value("target.radius").unwrap_or(f64::INFINITY),
            youngs_modulus: value("target.youngs_modulus").unwrap_or(f64::NAN),
            poissons_ratio: value("target.poissons_ratio").unwrap_or(f64::NAN),
        };
        let strength = value("target.yield_strength").unwrap_or(f64::INFINITY);
        Pair::new(&impactor, &target, strength)
    }

    /// The contact as the physics sees it.
    pub fn any_model(&self) -> AnyModel {
        let Some((_, law)) = self.damped else { return AnyModel::Elastoplastic(self.model()) };
        AnyModel::Damped(damped::Model {
            pair: self.pair().expect("a checked scene has bodies that fit"),
            law,
            restitution: self.value("restitution").unwrap_or(1.0),
            mass: self.value("effective_mass").unwrap_or(f64::INFINITY),
        })
    }

    /// The contact by its elastoplastic laws; the unloading of an elastic contact is never asked for.
    pub fn model(&self) -> Model<AnyLoading, AnyUnloading> {
        let pair = self.pair().expect("a checked scene has bodies that fit");
        let unloading = self.unloading.map_or(AnyUnloading::ALL[0].1, |(_, law)| law);
        let guarded = if self.passivity_guard { unloading.guarded() } else { None };
        let unloading = guarded.unwrap_or(unloading);
        Model { pair, loading: self.loading.1, unloading, surface: self.surface }
    }
}

fn check(file: File) -> Result<Scene, Mistake> {
    let name = check_name(&file.name)?;
    let impactor = &file.impactor;
    let target = file.target.get_ref();
    let material = target.material.as_ref().map(find_material).transpose()?;
    // a number in the scene stands before the material's
    let property = |given: &Option<Spanned<f64>>, of: fn(&table::Material) -> f64| match (given, material) {
        (Some(value), _) => Some(value.clone()),
        (None, Some(material)) => {
            let span = target.material.as_ref().map_or(0..0, Spanned::span);
            Some(Spanned::new(span, of(material)))
        }
        (None, None) => None,
    };
    let modulus = property(&target.youngs_modulus, |material| material.youngs_modulus);
    let ratio = property(&target.poissons_ratio, |material| material.poissons_ratio);
    let strength = property(&target.yield_strength, |material| material.yield_strength);
    if modulus.is_none() || ratio.is_none() {
        let names = MATERIALS.iter().map(|material| material.name.as_str()).collect::<Vec<_>>().join("`, `");
        let message =
            format!("the target needs `youngs_modulus` and `poissons_ratio`, or a `material`: there are `{names}`");
        return Err(Mistake(file.target.span(), message));
    }
    if impactor.youngs_modulus.is_some() != impactor.poissons_ratio.is_some() {
        let given = impactor.youngs_modulus.as_ref().or(impactor.poissons_ratio.as_ref());
        let message = "an elastic impactor needs both `youngs_modulus` and `poissons_ratio`; a rigid one neither";
        return Err(Mistake(given.map_or(0..0, Spanned::span), message.into()));
    }
    let damped = find_damped(&file.law)?;
    let yield_strength = strength.as_ref().map(|strength| *strength.get_ref());
    let loading = match damped {
        Some(_) => ("hertz", AnyLoading::Hertz(Hertz)),
        None => check_loading(&file.law, strength.is_some())?,
    };
    let elastic = matches!(loading.1, AnyLoading::Hertz(_));
    let unloading = check_unloading(&file.law, loading.0, elastic)?;
    check_parameters(&file.law, &loading, unloading.as_ref())?;

    let radius = *impactor.radius.get_ref();
    let steel_ball = Impact { mass: 7850.0 * 4.0 / 3.0 * PI * radius * radius * radius, speed: 1.0 };
    let mass = file.impact.as_ref().map_or(Spanned::new(0..0, steel_ball.mass), |table| table.get_ref().mass.clone());
    let passivity_guard = check_guard(file.law.passivity_guard.as_ref(), unloading)?;

    let values = [
        ("impactor.radius", Some(impactor.radius.clone())),
        ("impactor.youngs_modulus", impactor.youngs_modulus.clone()),
        ("impactor.poissons_ratio", impactor.poissons_ratio.clone()),
        ("target.radius", target.radius.clone()),
        ("target.youngs_modulus", modulus),
        ("target.poissons_ratio", ratio),
        ("target.yield_strength", if elastic { None } else { strength }),
        ("restitution", file.law.restitution.clone()),
        ("effective_mass", damped.is_some_and(|(_, law)| law.needs_mass()).then_some(mass)),
        ("initial_gap", Some(file.fmu.initial_gap.clone().unwrap_or(Spanned::new(0..0, 0.0)))),
    ];
    let mut parameters = Vec::new();
    for (name, value) in values {
        let Some(value) = value else { continue };
        check_limits(name, &value)?;
        parameters.push(Parameter { name, value: *value.get_ref(), settable: true });
    }
    choose_settable(&mut parameters, file.fmu.parameters.as_deref())?;
    let outputs = check_outputs(&file.fmu.outputs)?;

    let impact_is_assumed = file.impact.is_none();
    let impact_span = file.impact.as_ref().map_or(0..0, Spanned::span);
    let impact = match file.impact.as_ref().map(Spanned::get_ref) {
        Some(table) => {
            Impact { mass: positive("impact.mass", &table.mass)?, speed: positive("impact.speed", &table.speed)? }
        }
        None => steel_ball,
    };
    let surface = match target.surface {
        SurfaceName::Dented => Surface::Dented,
        SurfaceName::Fresh => Surface::Fresh,
    };
    let scene = Scene {
        name,
        description: file.description,
        parameters,
        outputs,
        loading,
        unloading,
        damped,
        passivity_guard,
        surface,
        yield_strength,
        impact,
        impact_is_assumed,
        text: String::new(),
    };
    if scene.pair().is_none() {
        let socket = target.radius.clone().unwrap_or(Spanned::new(0..0, f64::NAN));
        let message = format!(
            "target.radius = {:?} does not fit impactor.radius = {radius:?}: a socket (negative) must be wider than the \
             impactor, and no radius is below 1e-12 m",
            socket.get_ref()
        );
        return Err(Mistake(socket.span(), message));
    }
    check_curves(&file.law, &scene)?;
    if scene.any_model().predict(&scene.impact).is_none() {
        let Impact { mass, speed } = scene.impact;
        let message = format!(
            "the impact of mass = {mass:?} kg and speed = {speed:?} m/s drives the bodies deeper than the law can be evaluated"
        );
        return Err(Mistake(impact_span, message));
    }
    Ok(scene)
}

fn check_name(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = name.get_ref();
    let mut characters = text.chars();
    let begins = characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    // the name is that of a file too
    let short = text.len() <= 100;
    if short && begins && characters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Ok(text.clone());
    }
    let message = format!(
        "name = {text:?} is not a C identifier of at most 100 letters, digits and `_`, not beginning with a digit"
    );
    Err(Mistake(name.span(), message))
}

fn find_material(name: &Spanned<String>) -> Result<&'static table::Material, Mistake> {
    MATERIALS.iter().find(|material| &material.name == name.get_ref()).ok_or_else(|| {
        let names = MATERIALS.iter().map(|material| material.name.as_str());
        Mistake(name.span(), unknown("material", name.get_ref(), names))
    })
}

/// The rate-dependent law that the scene names, with what belongs to it.
fn find_damped(law: &Law) -> Result<Option<(&'static str, AnyDamped)>, Mistake> {
    let asked = law.loading.as_ref();
    let found = asked.and_then(|asked| AnyDamped::ALL.into_iter().find(|(name, _)| name == asked.get_ref()));
    let needs_restitution = found.is_some_and(|(_, law)| law.needs_restitution());
    match (&law.restitution, asked) {
        (Some(restitution), _) if !needs_restitution => {
            let names = AnyDamped::ALL.iter().filter(|(_, law)| law.needs_restitution()).map(|(name, _)| *name);
            let names = names.collect::<Vec<_>>().join("\", \"");
            let message = format!("law.restitution is for the loading laws \"{names}\"; this one has its own");
            return Err(Mistake(restitution.span(), message));
        }
        (None, Some(asked)) if needs_restitution => {
            let message = format!("law.loading = \"{}\" needs law.restitution, from 0.001 to 1", asked.get_ref());
            return Err(Mistake(asked.span(), message));
        }
        _ => {}
    }
    if let (Some((name, _)), Some(unloading)) = (found, &law.unloading) {
        let asked = unloading.get_ref();
        let message = format!("law.unloading = \"{asked}\" has no meaning here: {name} leaves no dent");
        return Err(Mistake(unloading.span(), message));
    }
    let Some((name, reference)) = found else {
        return match &law.damping {
            Some(damping) => Err(Mistake(damping.span(), format!("law.damping is for \"{}\"", with_dampings()))),
            None => Ok(None),
        };
    };
    let chosen = match &law.damping {
        Some(damping) => with_damping(name, reference, damping)?,
        None => reference,
    };
    let parameters = law.loading_parameters.as_ref();
    Ok(Some((name, parameters::apply(chosen, "law.loading", parameters, table::damped_law(name))?)))
}

/// The names of the laws with several dampings, for a message.
fn with_dampings() -> String {
    let several = AnyDamped::ALL.into_iter().filter(|(_, law)| !law.dampings().is_empty());
    several.map(|(name, _)| name).collect::<Vec<_>>().join("\" and \"")
}

/// The law `name` with the damping that the scene names.
fn with_damping(name: &str, law: AnyDamped, asked: &Spanned<String>) -> Result<AnyDamped, Mistake> {
    let dampings = law.dampings();
    if dampings.is_empty() {
        let message = format!("law.damping is for \"{}\"; {name} has one damping", with_dampings());
        return Err(Mistake(asked.span(), message));
    }
    law.with_damping(asked.get_ref())
        .ok_or_else(|| Mistake(asked.span(), unknown("law.damping", asked.get_ref(), dampings.into_iter())))
}

fn check_loading(given: &Law, yields: bool) -> Result<(&'static str, AnyLoading), Mistake> {
    let name = given.loading.as_ref();
    let default = if yields { "big-alabo" } else { "hertz" };
    let asked = name.map_or(default, |name| name.get_ref().as_str());
    let span = name.map_or(0..0, Spanned::span);
    let law = AnyLoading::ALL.into_iter().find(|(name, _)| *name == asked).ok_or_else(|| {
        let names = AnyLoading::ALL.iter().map(|(name, _)| *name);
        let names = names.chain(AnyDamped::ALL.iter().map(|(name, _)| *name));
        Mistake(span.clone(), unknown("law.loading", asked, names))
    })?;
    if !yields && law.0 != "hertz" {
        let message =
            format!("law.loading = \"{asked}\" needs target.yield_strength (or a material); \"hertz\" doesn't");
        return Err(Mistake(span, message));
    }
    let parameters = given.loading_parameters.as_ref();
    Ok((law.0, parameters::apply(law.1, "law.loading", parameters, table::loading_law(law.0))?))
}

fn check_unloading(given: &Law, loading: &str, elastic: bool) -> Result<Option<(&'static str, AnyUnloading)>, Mistake> {
    let name = given.unloading.as_ref();
    let parameters = given.unloading_parameters.as_ref();
    let span = name.map_or(0..0, Spanned::span);
    let asked = name.map_or(laws::default_unloading(loading), |name| name.get_ref().as_str());
    if elastic {
        let message = format!("law.unloading = \"{asked}\" has no meaning here: hertz unloads along the loading curve");
        return match (name, parameters) {
            (Some(_), _) => Err(Mistake(span, message)),
            (None, Some(parameters)) => {
                let message = "law.unloading_parameters has no meaning here: hertz unloads along the loading curve";
                Err(Mistake(parameters.span(), message.into()))
            }
            (None, None) => Ok(None),
        };
    }
    let law = AnyUnloading::ALL.into_iter().find(|(name, _)| *name == asked).ok_or_else(|| {
        let names = AnyUnloading::ALL.iter().map(|(name, _)| *name);
        Mistake(span.clone(), unknown("law.unloading", asked, names))
    })?;
    laws::check_pairing(loading, asked).map_err(|message| Mistake(span, message))?;
    Ok(Some((law.0, parameters::apply(law.1, "law.unloading", parameters, table::unloading_law(law.0))?)))
}

/// Where the scene gives constants to its laws, if it does.
fn parameters_span(given: &Law) -> Option<std::ops::Range<usize>> {
    given.loading_parameters.as_ref().or(given.unloading_parameters.as_ref()).map(Spanned::span)
}

/// Refuses constants of the two laws that contradict each other.
fn check_parameters(
    given: &Law,
    loading: &(&'static str, AnyLoading),
    unloading: Option<&(&'static str, AnyUnloading)>,
) -> Result<(), Mistake> {
    let (Some(span), Some(unloading)) = (parameters_span(given), unloading) else { return Ok(()) };
    laws::check_ties(*loading, *unloading).map_err(|message| Mistake(span, message))
}

/// Refuses laws that the scene's constants have made useless on its bodies.
fn check_curves(given: &Law, scene: &Scene) -> Result<(), Mistake> {
    let Some(span) = parameters_span(given).filter(|_| scene.unloading.is_some()) else { return Ok(()) };
    let model = scene.model();
    let unloading = given.unloading_parameters.as_ref().map_or(span.clone(), Spanned::span);
    law_check::check_loading(&model, laws::published(scene.loading.0))
        .map_err(|message| Mistake(span, format!("with these parameters {message}")))?;
    law_check::check_unloading(&model).map_err(|message| Mistake(unloading, format!("with these parameters {message}")))
}

/// Whether the guard is asked for, of an unloading law that has a guarded form.
fn check_guard(asked: Option<&Spanned<bool>>, unloading: Option<(&str, AnyUnloading)>) -> Result<bool, Mistake> {
    let Some(asked) = asked.filter(|asked| *asked.get_ref()) else { return Ok(false) };
    let Some((name, law)) = unloading else {
        let message = "law.passivity_guard has no meaning here: hertz gives back just what was put in";
        return Err(Mistake(asked.span(), message.into()));
    };
    if law.guarded().is_some() {
        return Ok(true);
    }
    let guarded = AnyUnloading::ALL.iter().filter(|(_, law)| law.guarded().is_some()).map(|(name, _)| *name);
    let names = guarded.collect::<Vec<_>>().join("`, `");
    let message = format!("law.unloading = \"{name}\" has no passivity guard: `{names}` have one");
    Err(Mistake(asked.span(), message))
}

pub fn unknown<'a>(what: &str, asked: &str, names: impl Iterator<Item = &'a str>) -> String {
    let names = names.collect::<Vec<_>>().join("`, `");
    format!("unknown {what} `{asked}`, expected one of `{names}`")
}

fn check_limits(name: &str, value: &Spanned<f64>) -> Result<(), Mistake> {
    let variable = table::variable(name);
    let (minimum, maximum) = (variable.minimum.unwrap_or(f64::MIN), variable.maximum.unwrap_or(f64::MAX));
    if (minimum..=maximum).contains(value.get_ref()) {
        return Ok(());
    }
    let unit = variable.unit.as_deref().unwrap_or("");
    let message =
        format!("{name} = {:?} is out of range: allowed is {minimum:?} to {maximum:?} {unit}", value.get_ref());
    Err(Mistake(value.span(), message.trim_end().into()))
}

fn positive(name: &str, value: &Spanned<f64>) -> Result<f64, Mistake> {
    let number = *value.get_ref();
    if number > 0.0 && number.is_finite() {
        return Ok(number);
    }
    Err(Mistake(value.span(), format!("{name} = {number:?} must be positive and finite")))
}

/// Leaves settable what `chosen` names, or everything.
fn choose_settable(parameters: &mut [Parameter], chosen: Option<&[Spanned<String>]>) -> Result<(), Mistake> {
    let Some(chosen) = chosen else { return Ok(()) };
    for name in chosen {
        if !parameters.iter().any(|parameter| parameter.name == name.get_ref()) {
            let names = parameters.iter().map(|parameter| parameter.name);
            return Err(Mistake(name.span(), unknown("parameter", name.get_ref(), names)));
        }
    }
    for parameter in parameters {
        parameter.settable = chosen.iter().any(|name| name.get_ref() == parameter.name);
    }
    Ok(())
}

fn check_outputs(chosen: &[Spanned<String>]) -> Result<Vec<String>, Mistake> {
    let available = || VARIABLES.iter().filter(|v| v.causality == Causality::Output).map(|v| v.name.as_str());
    let mut outputs: Vec<String> = Vec::new();
    for name in chosen {
        let text = name.get_ref();
        if !available().any(|output| output == text) {
            return Err(Mistake(name.span(), unknown("output", text, available())));
        }
        if text != "force" && !outputs.contains(text) {
            outputs.push(text.clone());
        }
    }
    Ok(outputs)
}
