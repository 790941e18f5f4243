//! Checks a scene: from the contents of the file to a scene that can be built.

use super::contacts::Contacts;
use super::coupling;
use super::file::{File, ImpactTable, NamesName};
use super::friction;
use super::laws;
use super::losses::{self, Loss};
use super::numbers::IMPACTOR_DENSITY;
use super::softer::{self, Body, Both};
use super::{Mistake, Parameter, QuasiStatic, Scene};
use crate::layout::shortened;
use crate::nearest::unknown;
use crate::predict;
use crate::table::{self, Causality, VARIABLES};
use crate::xml;
use brinell::contact::damped::Damped;
use brinell::contact::impact::Impact;
use brinell::contact::loading::{AnyLoading, Hertz};
use std::collections::HashSet;
use std::f64::consts::PI;
use std::ops::RangeInclusive;
use toml::Spanned;

/// The scene of `file`, without its text.
///
/// # Errors
/// The first mistake.
pub fn check(file: File) -> Result<Scene, Mistake> {
    let name = check_name(&file.name)?;
    let description = check_description(file.description.as_ref())?;
    let mut contacts = Contacts::of(&file)?;
    let damped = laws::find_damped(&file.law)?;
    let loading = match damped {
        Some(_) => ("hertz", AnyLoading::Hertz(Hertz)),
        None => laws::check_loading(&file.law, &contacts)?,
    };
    let elastic = matches!(loading.1, AnyLoading::Hertz(_));
    let hardens = damped.is_none() && table::loading_law(loading.0).strengthened;
    contacts.check_rate(damped.is_some() || elastic)?;
    contacts.check_hardening(damped.map_or(loading.0, |(name, _)| name), hardens)?;
    let unloading = laws::check_unloading(&file.law, loading.0, elastic)?;
    laws::check_parameters(&file.law, &loading, unloading.as_ref())?;
    let passivity_guard = laws::check_guard(file.law.passivity_guard.as_ref(), unloading)?;
    let yield_strength = contacts.yield_strength(0);
    if elastic {
        contacts.forget_strength();
    }
    let loss = losses::check(&file, &contacts, damped.map(|(name, _)| name))?;
    let damps_by_mass = damped.filter(|(_, law)| law.needs_mass()).map(|(name, _)| name);
    let coupling = coupling::check(file.coupling.as_ref(), damps_by_mass)?;
    let (coupling, known_mass) = coupling.unzip();
    let with_friction = friction::Given {
        damped: damped.map(|(name, _)| name),
        unloading: unloading.map(|(name, _)| name),
        passivity_guard,
        has_loss: loss.is_some(),
        knows_mass: coupling.is_some(),
    };
    let directions = friction::check(file.friction.as_ref(), &with_friction)?;
    let friction = directions > 0;
    contacts.check_friction()?;
    let follows_rate = damped.is_some() || loss.is_some();
    let input_derivatives =
        check_input_derivatives(file.fmu.input_derivatives.as_ref(), coupling.is_some(), follows_rate)?;
    let impact = check_impact(file.impact.as_ref(), known_mass.as_ref(), &contacts)?;
    let impact_span = file.impact.as_ref().map_or(0..0, Spanned::span);
    predict::check_energy(&impact).map_err(|error| Mistake(impact_span.clone(), error.to_string()))?;
    let (mut parameters, mut groups) = contacts.parameters();
    let mass = damped.is_some_and(|(_, law)| law.needs_mass()).then_some(impact.mass);
    let span = file.impact.as_ref().and_then(|table| Some(table.get_ref().mass.as_ref()?.span()));
    let mass = known_mass.or(mass.map(|mass| Spanned::new(span.unwrap_or(0..0), mass)));
    contacts.check_masses(mass.is_some())?;
    let is_input = |name: &str| name == "effective_mass" && coupling.is_some_and(|coupling| coupling.mass_input);
    if let Some((name, value)) = loss.and_then(Loss::parameter) {
        parameters.push(Parameter::shared(name, value, true));
    }
    for (name, value) in [("restitution", file.law.restitution.clone()), ("effective_mass", mass)] {
        let Some(value) = value else { continue };
        check_limits(name, "", &value)?;
        parameters.push(Parameter::shared(name, *value.get_ref(), !is_input(name)));
    }
    groups.iter_mut().flat_map(|group| &mut group.own).for_each(|own| own.settable = !is_input(own.name));
    contacts.divide(&parameters, &mut groups, is_input)?;
    // a value that every contact has for itself is not shared
    parameters.retain(|shared| !groups.iter().all(|group| group.own.iter().any(|own| own.name == shared.name)));
    parameters.sort_by_key(|parameter| VARIABLES.iter().position(|variable| variable.name == parameter.name));
    let mut outputs = check_outputs(&file.fmu.outputs, coupling.is_some(), friction)?;
    // without them such an FMU is useless
    for (needed, name) in [(coupling.is_some(), "mean_force"), (friction, "tangential_force")] {
        if needed && !outputs.iter().any(|output| output == name) {
            outputs.push(name.into());
        }
    }
    let factors = vec![1.0; groups.len()];
    let mut scene = Scene {
        name,
        description,
        parameters,
        contacts: groups,
        outputs,
        loading,
        unloading,
        damped,
        loss,
        passivity_guard,
        yield_strength,
        power_laws: contacts.power_laws,
        rates: contacts.rates,
        quasi_static: Vec::new(),
        factors,
        coupling,
        directions,
        impact,
        predictions: Vec::new(),
        // for an importer that moves the mass itself, with a law that has a stable step size
        watches: coupling.is_none()
            && damped.is_none()
            && loss.is_none()
            && file.impact.as_ref().is_some_and(|impact| impact.get_ref().watch != Some(false)),
        input_derivatives,
        // a name with an index is a structured one
        structured_names: directions > 1
            || file.fmu.names.map_or(file.contact.is_some(), |names| names == NamesName::Structured),
        standalone: file.fmu.standalone == Some(true),
        impact_is_assumed: file.impact.is_none(),
        text: String::new(),
    };
    choose_settable(&mut scene, file.fmu.parameters.as_deref())?;
    for group in 0..scene.contacts.len() {
        let of_contact = |Mistake(span, message)| Mistake(span, contacts.said(group, &message));
        check_pair(&scene, group, &contacts).map_err(of_contact)?;
        laws::check_curves(&file.law, &scene, group).map_err(of_contact)?;
    }
    let of = |group, body: Body| QuasiStatic {
        yield_strength: scene.group_value(group, body.yield_strength()).unwrap_or(f64::INFINITY),
        hardening_modulus: scene.group_value(group, body.hardening_modulus()).unwrap_or(0.0),
    };
    let quasi_static = |group| Both { impactor: of(group, Body::Impactor), target: of(group, Body::Target) };
    scene.quasi_static = (0..scene.contacts.len()).map(quasi_static).collect();
    let message = too_hard(&scene, 0);
    let softer = |scene: &Scene| (0..scene.contacts.len()).map(|group| scene.softer(group)).collect::<Vec<_>>();
    let slow = softer(&scene);
    scene = scene.with_strengths_for(None).ok_or_else(|| Mistake(impact_span.clone(), message))?;
    if let Some(group) = softer(&scene).iter().zip(&slow).position(|(now, before)| now != before) {
        return Err(Mistake(impact_span, contacts.said(group, &softer::exchanged(slow[group]))));
    }
    let no_prediction = |group| Mistake(impact_span.clone(), contacts.said(group, &too_hard(&scene, group)));
    let predict = |group| scene.any_model_of(group).predict(&scene.impact_of(group));
    let predictions = scene.by_bodies(predict).into_iter().enumerate();
    let predictions = predictions.map(|(group, prediction)| prediction.ok_or_else(|| no_prediction(group)));
    scene.predictions = predictions.collect::<Result<_, _>>()?;
    Ok(scene)
}

/// The name of an FMU: a C identifier that every operating system accepts as a file name.
///
/// Reference: "Naming Files, Paths, and Namespaces" in the documentation of Windows.
fn check_name(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = check_identifier(name)?;
    let lower = text.to_ascii_lowercase();
    let port = lower.strip_prefix("com").or(lower.strip_prefix("lpt"));
    let is_port = port.is_some_and(|number| number.len() == 1 && number.bytes().all(|digit| digit.is_ascii_digit()));
    if is_port || ["con", "prn", "aux", "nul"].contains(&lower.as_str()) {
        let message =
            format!("name = {text:?} is that of a device on Windows, where no library can have it: call it otherwise");
        return Err(Mistake(name.span(), message));
    }
    Ok(text)
}

/// Text that is a C identifier.
pub fn check_identifier(name: &Spanned<String>) -> Result<String, Mistake> {
    let text = name.get_ref();
    let mut characters = text.chars();
    let begins = characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    // the name is also used for a file
    let short = text.len() <= 100;
    if short && begins && characters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return Ok(text.clone());
    }
    let message = format!(
        "name = {:?} is not a C identifier: at most 100 letters, digits and `_`, and no digit at the beginning",
        shortened(text)
    );
    Err(Mistake(name.span(), message))
}

/// A text that the model description can contain.
fn check_description(given: Option<&Spanned<String>>) -> Result<String, Mistake> {
    let Some(text) = given else { return Ok(String::new()) };
    match xml::forbidden(text.get_ref()) {
        None => Ok(text.get_ref().clone()),
        Some((place, character)) => {
            let number = text.get_ref()[..place].chars().count() + 1;
            let character = xml::name(character);
            let message = format!("description has {character} as character {number}, which XML doesn't allow");
            Err(Mistake(text.span(), message))
        }
    }
}

/// The impact of the scene, or an impact at 1 m/s. Its mass is the given mass, otherwise the mass that the FMU knows, otherwise
/// that of a solid ball with the radius and the density of the first contact's impactor. Without an `[impact]`, the density may
/// be that of steel.
fn check_impact(
    given: Option<&Spanned<ImpactTable>>,
    known: Option<&Spanned<f64>>,
    contacts: &Contacts,
) -> Result<Impact, Mistake> {
    let number = |name| contacts.number(0, name).map(|number| *number.get_ref());
    let radius = number("impactor.radius").unwrap_or(f64::NAN);
    let ball = |density: f64| density * 4.0 / 3.0 * PI * radius * radius * radius;
    let Some(table) = given else {
        let mass = known.map(|mass| *mass.get_ref());
        let mass = mass.unwrap_or_else(|| ball(number(IMPACTOR_DENSITY).unwrap_or(STEEL)));
        return Ok(Impact { mass, speed: 1.0 });
    };
    let ImpactTable { mass, speed, .. } = table.get_ref();
    let speed = positive("impact.speed", speed)?;
    let Some(given) = mass else {
        let mass = known.map(|mass| *mass.get_ref()).or_else(|| number(IMPACTOR_DENSITY).map(ball)).ok_or_else(|| {
            let message = "missing field `mass` in [impact]: give it, or the density or material of [impactor], which is then \
                           taken for a solid ball";
            Mistake(table.span(), message.into())
        })?;
        return Ok(Impact { mass, speed });
    };
    let mass = positive("impact.mass", given)?;
    if let Some(known) = known.map(Spanned::get_ref).filter(|known| **known != mass) {
        let message = format!("impact.mass = {mass:?} and coupling.effective_mass = {known:?} must be the same mass");
        return Err(Mistake(given.span(), message));
    }
    Ok(Impact { mass, speed })
}

/// Assumed density of the ball without an `[impact]` [kg/m^3].
const STEEL: f64 = 7850.0;

/// Rejects bodies that do not touch at one point.
fn check_pair(scene: &Scene, group: usize, contacts: &Contacts) -> Result<(), Mistake> {
    if scene.pair_of(group).is_some() {
        return Ok(());
    }
    let flat = Spanned::new(0..0, f64::NAN);
    let socket = contacts.number(group, "target.radius").unwrap_or(&flat);
    let radius = scene.group_value(group, "impactor.radius").unwrap_or(f64::NAN);
    let message = format!(
        "target.radius = {:?} does not fit impactor.radius = {radius:?}: a socket (negative) must be wider than the \
         impactor, and no radius is below 1e-12 m",
        socket.get_ref()
    );
    Err(Mistake(socket.span(), message))
}

/// Whether the inputs may have derivatives, as far as the law allows.
fn check_input_derivatives(
    asked: Option<&Spanned<bool>>,
    knows_mass: bool,
    follows_rate: bool,
) -> Result<bool, Mistake> {
    let Some(asked) = asked else { return Ok(true) };
    let reason = match *asked.get_ref() {
        false if knows_mass => "an FMU with [coupling] needs them to move the bodies; leave this key out",
        true if follows_rate && !knows_mass => "a law that depends on the rate allows none; leave this key out",
        wanted => return Ok(wanted),
    };
    Err(Mistake(asked.span(), format!("fmu.input_derivatives = {}: {reason}", asked.get_ref())))
}

/// The message about an impact for which the law cannot be evaluated.
fn too_hard(scene: &Scene, group: usize) -> String {
    let Impact { mass, speed } = scene.impact_of(group);
    let what = match scene.is_rate_dependent() {
        false => "drives the bodies deeper than the law can be evaluated",
        true => "drives the bodies deeper than the law can be evaluated, or is damped so strongly that it never ends",
    };
    format!("the impact of mass = {mass:?} kg and speed = {speed:?} m/s {what}")
}

/// Rejects a value of the parameter `name` outside its range. `owner` precedes the name in the message.
pub fn check_limits(name: &str, owner: &str, value: &Spanned<f64>) -> Result<(), Mistake> {
    let variable = table::variable(name);
    let allowed = variable.minimum.unwrap_or(f64::MIN)..=variable.maximum.unwrap_or(f64::MAX);
    check_range((name, variable.unit.as_deref().unwrap_or("")), owner, value, allowed)
}

/// Rejects a value with this name and unit unless it is `allowed`. `owner` precedes the name in the message.
pub fn check_range(
    (name, unit): (&str, &str),
    owner: &str,
    value: &Spanned<f64>,
    allowed: RangeInclusive<f64>,
) -> Result<(), Mistake> {
    if allowed.contains(value.get_ref()) {
        return Ok(());
    }
    let (given, minimum, maximum) = (value.get_ref(), allowed.start(), allowed.end());
    let message = format!("{owner}{name} = {given:?} is out of range: allowed is {minimum:?} to {maximum:?} {unit}");
    Err(Mistake(value.span(), message.trim_end().into()))
}

pub fn positive(name: &str, value: &Spanned<f64>) -> Result<f64, Mistake> {
    let number = *value.get_ref();
    if number > 0.0 && number.is_finite() {
        return Ok(number);
    }
    Err(Mistake(value.span(), format!("{name} = {number:?} must be positive and finite")))
}

/// Makes settable only the parameters in `chosen`, or all: those of all contacts and those of one contact.
fn choose_settable(scene: &mut Scene, chosen: Option<&[Spanned<String>]>) -> Result<(), Mistake> {
    let Some(chosen) = chosen else { return Ok(()) };
    let names: HashSet<&str> = chosen.iter().map(|name| name.get_ref().as_str()).collect();
    let mut known = Vec::new();
    let mass_is_input = scene.coupling.is_some_and(|coupling| coupling.mass_input);
    let mut choose = |parameter: &mut Parameter, name: String| {
        if mass_is_input && parameter.name == "effective_mass" {
            return;
        }
        // a parameter that each contact has for itself is meant to be set
        parameter.settable = parameter.per_contact || names.contains(name.as_str());
        known.push(name);
    };
    for parameter in &mut scene.parameters {
        choose(parameter, parameter.name.to_string());
    }
    for group in &mut scene.contacts {
        let mut own = std::mem::take(&mut group.own);
        own.iter_mut().for_each(|parameter| choose(parameter, group.variable(parameter.name)));
        group.own = own;
    }
    let known_names: HashSet<&str> = known.iter().map(String::as_str).collect();
    match chosen.iter().find(|name| !known_names.contains(name.get_ref().as_str())) {
        Some(name) => {
            let message = unknown("parameter", name.get_ref(), known.iter().map(String::as_str));
            Err(Mistake(name.span(), message))
        }
        None => Ok(()),
    }
}

fn check_outputs(chosen: &[Spanned<String>], knows_mass: bool, friction: bool) -> Result<Vec<String>, Mistake> {
    let is_listed =
        |variable: &&table::Variable| variable.causality == Causality::Output && variable.second_of.is_none();
    let available = || VARIABLES.iter().filter(is_listed).map(|variable| variable.name.as_str());
    let mut outputs: Vec<String> = Vec::new();
    for name in chosen {
        let text = name.get_ref();
        if let Some(both) = text.strip_suffix("[1]").or(text.strip_suffix("[2]"))
            && available().any(|output| output == both)
        {
            let message = format!(
                "the output {text} has no index here: `{both}` is enough, and gives both components if \
                 friction.directions = 2"
            );
            return Err(Mistake(name.span(), message));
        }
        if !available().any(|output| output == text) {
            return Err(Mistake(name.span(), unknown("output", text, available())));
        }
        if text == "closing_speed" && !knows_mass {
            let message =
                "the output closing_speed needs [coupling] effective_mass: the FMU must move the bodies itself";
            return Err(Mistake(name.span(), message.into()));
        }
        if table::variable(text).friction && !friction {
            let message = format!("the output {text} needs friction: give [friction] coefficient");
            return Err(Mistake(name.span(), message));
        }
        if text != "force" && !outputs.contains(text) {
            outputs.push(text.clone());
        }
    }
    Ok(outputs)
}
