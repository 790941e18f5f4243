//! Checks a scene: from the contents of the file to a scene that can be built.

use super::bodies;
use super::checked::{Coupling, Group, Parameter, Scene, SceneLaws};
use super::contacts::{self, Contacts};
use super::cylinders::{self, Cylinders};
use super::ellipses::Elliptic;
use super::file::{BodyTable, ImpactTable, NamesName, Radius, SceneFile};
use super::fmu::{self, check_outputs, check_text, choose_settable};
use super::laws;
use super::losses::Loss;
use super::names::check_name;
use super::own_materials::{self, ReferencedFiles};
use super::plausible::{self, STEEL};
use super::quantities::check_quantity;
use super::shared_bodies;
use super::tabulated;
use crate::body::{Body, Both};
use crate::mistake::{Mistake, SceneError, Spanned};
use crate::model::{AnyModel, check_energy, speed_of_height};
use crate::numbers::in_message;
use crate::predict::check_width;
use crate::table::VARIABLES;
use brinell_contact::damped::Damped;
use brinell_contact::impact::Impact;
use brinell_contact::material::hardening::Hardening;
use brinell_contact::rate::Factors;
use std::f64::consts::PI;
use std::ops::Range;
use std::path::Path;

impl Scene {
    /// Checks the scene `text`. `path` is used in messages.
    ///
    /// # Errors
    /// [`SceneError`] with line and column of the first error, and what is allowed there.
    pub fn parse(text: String, path: &Path) -> Result<Scene, SceneError> {
        Ok(Scene::parse_with_files(&text, path, &ReferencedFiles::default())?.0)
    }

    /// The scene with this `text`, with the files `referenced` by it, and the numbers in it that are implausible.
    ///
    /// # Errors
    /// As for [`Scene::parse`].
    pub fn parse_with_files(
        text: &str,
        path: &Path,
        referenced: &ReferencedFiles,
    ) -> Result<(Scene, Vec<SceneError>), SceneError> {
        let checked = SceneFile::read(text, referenced).and_then(|mut file| {
            let warnings = plausible::warnings(&file);
            let alone = std::mem::take(&mut file.alone);
            Ok((Scene { text: alone, ..check(file, &warnings)? }, warnings))
        });
        let placed = |mistake: Mistake| mistake.in_file(text, path);
        let (scene, warnings) = checked.map_err(placed)?;
        Ok((scene, warnings.into_iter().map(placed).collect()))
    }
}

/// The scene of `file`, without its text.
///
/// # Errors
/// The first mistake.
fn check(mut file: SceneFile, warnings: &[Mistake]) -> Result<Scene, Mistake> {
    let name = check_name(&file.name)?;
    let description = check_text("description", file.description.as_ref())?;
    let author = check_text("author", file.author.as_ref())?;
    if let Some(mistake) = file.broken.take() {
        return Err(mistake);
    }
    let (step_size, stop_time) = fmu::check_experiment(&file.fmu)?;
    let mut contacts = Contacts::of(&file)?;
    let broken = file.broken_by_laws[usize::from(contacts.any_yields())].take();
    let no_table = BodyTable::default();
    let cylinders = Cylinders::of(&file, &no_table, &contacts)?;
    let loss = Loss::of(&file)?;
    let laws = laws::of(&file.law, &contacts, loss, cylinders.is_some(), broken)?;
    if laws.loading().1.takes_both_bodies() {
        contacts.let_both_yield();
    }
    let yield_strength = contacts.yield_strength(0);
    if laws.has_no_strength() {
        contacts.forget_strength();
    }
    let damps_by_mass = matches!(laws, SceneLaws::Damped(_, law) if law.needs_mass());
    let directions = file.friction.as_ref().map_or(Ok(0), |friction| contacts::check_directions(friction.get_ref()))?;
    let friction = directions > 0;
    let inverse_masses = shared_bodies::check(&file, directions)?;
    let shared = inverse_masses.is_some();
    let shared_mass =
        inverse_masses.as_ref().and_then(|masses| masses.effective_mass(0, contacts.count() * (1 + directions)));
    let (coupling, known_mass) = fmu::check_coupling(file.coupling.as_ref(), inverse_masses)?;
    let impact_mass = known_mass.clone().or(shared_mass.map(|mass| Spanned::new(0..0, mass)));
    let impact = check_impact(file.impact.as_ref(), impact_mass.as_ref(), &contacts, cylinders.is_some())?;
    if impact.mass.is_nan() {
        let message = "a body with two radii is no ball, and its mass isn't known: give impact.mass and impact.speed, or [coupling] effective_mass";
        return Err(Mistake(contacts.radius(0, Body::Impactor).map_or(0..0, Spanned::span), message.into()));
    }
    let impact_span = file.impact.as_ref().map_or(0..0, Spanned::span);
    check_energy(&impact).map_err(|error| Mistake(impact_span.clone(), error.to_string()))?;
    let span = file.impact.as_ref().and_then(|table| Some(table.get_ref().mass.as_ref()?.span()));
    let mass = known_mass.or(damps_by_mass.then(|| Spanned::new(span.unwrap_or(0..0), impact.mass)));
    let mass_is_input = Coupling::mass_is_input(coupling.as_ref());
    let numbers = [("restitution", file.law.restitution.clone()), ("effective_mass", mass)];
    let (parameters, groups) = check_parameters(&contacts, loss, numbers, mass_is_input)?;
    let mut outputs = check_outputs(&file.fmu.outputs)?;
    // without them such an FMU is useless
    let needed = [
        (coupling.is_some(), "mean_force"),
        (shared, "impulse_moment"),
        (friction, "tangential_force"),
        (shared && friction, "mean_tangential_force"),
        (shared && friction, "tangential_impulse_moment"),
    ];
    for (needed, name) in needed {
        if needed && !outputs.iter().any(|output| output == name) {
            outputs.push(name.into());
        }
    }
    let factors = vec![Factors::SLOW; groups.len()];
    let mut scene = Scene {
        name,
        description,
        author,
        parameters,
        contacts: groups,
        outputs,
        laws,
        law_words: None,
        yield_strength,
        rates: contacts.rates(),
        quasi_static: Vec::new(),
        factors,
        // for an importer that moves the mass itself, with a law that has a stable step size
        watches: coupling.is_none()
            && !laws.depends_on_rate()
            && file.impact.as_ref().is_some_and(|impact| impact.get_ref().watch != Some(false)),
        coupling,
        directions,
        impact,
        predictions: Vec::new(),
        input_derivatives: file.fmu.input_derivatives != Some(false),
        // a name with an index is a structured one
        structured_names: directions > 1
            || file.fmu.names.map_or(file.contact.is_some(), |names| names == NamesName::Structured),
        step_size,
        stop_time,
        standalone: file.fmu.standalone == Some(true),
        impact_is_assumed: file.impact.is_none(),
        materials: own_materials::words(file.materials_used(), &file.own),
        text: String::new(),
    };
    choose_settable(&mut scene, file.fmu.parameters.as_deref())?;
    settle_ellipses(&mut scene, &file, &contacts)?;
    for group in 0..scene.contacts.len() {
        let of_contact = |Mistake(span, message)| Mistake(span, contacts.said(group, &message));
        check_pair(&scene, group, &contacts).map_err(of_contact)?;
        laws::check_curves(&file.law, &scene, group).map_err(of_contact)?;
    }
    if let Some(cylinders) = cylinders {
        cylinders.settle(&mut scene, &file, &contacts)?;
    }
    tabulated::settle(&mut scene, &file, &contacts)?;
    // an impact that can't be may be one in a wrong unit
    let with_warnings = |Mistake(span, message)| {
        let warnings = warnings.iter().map(|Mistake(_, warning)| format!("; {warning}"));
        Mistake(span, message + &warnings.collect::<String>())
    };
    settle(scene, &contacts, &impact_span).map_err(with_warnings)
}

/// The parameters of all contacts, also those of the loss and the `numbers` that the scene gives for all, and the groups with their
/// own parameters.
fn check_parameters(
    contacts: &Contacts,
    loss: Option<Loss>,
    numbers: [(&'static str, Option<Spanned<f64>>); 2],
    mass_is_input: bool,
) -> Result<(Vec<Parameter>, Vec<Group>), Mistake> {
    let (mut parameters, mut groups) = contacts.parameters();
    let is_input = |name: &str| name == "effective_mass" && mass_is_input;
    if let Some((name, value)) = loss.and_then(Loss::parameter) {
        parameters.push(Parameter::shared(name, value, true));
    }
    for (name, value) in numbers {
        let Some(value) = value else { continue };
        check_quantity(name, "", &value)?;
        parameters.push(Parameter::shared(name, *value.get_ref(), !is_input(name)));
    }
    groups.iter_mut().flat_map(|group| &mut group.own).for_each(|own| own.settable = !is_input(own.name));
    contacts.divide(&parameters, &mut groups)?;
    // a value that every contact has for itself is not shared
    parameters.retain(|shared| !groups.iter().all(|group| group.own.iter().any(|own| own.name == shared.name)));
    parameters.sort_by_key(|parameter| VARIABLES.iter().position(|variable| variable.name == parameter.name));
    Ok((parameters, groups))
}

/// The scene with the strengths that its impact gives the bodies, and with the predictions of each contact's impact. `place` is
/// where the scene has its impact.
fn settle(mut scene: Scene, contacts: &Contacts, place: &Range<usize>) -> Result<Scene, Mistake> {
    let of = |group, body: Body| Hardening {
        yield_strength: scene.group_value(group, body.yield_strength()).unwrap_or(f64::INFINITY),
        hardening_modulus: scene.group_value(group, body.hardening_modulus()).unwrap_or(0.0),
    };
    let quasi_static = |group| Both::each(|body| of(group, body));
    scene.quasi_static = (0..scene.contacts.len()).map(quasi_static).collect();
    let message = too_hard(&scene, 0);
    let softer = |scene: &Scene| (0..scene.contacts.len()).map(|group| scene.softer(group)).collect::<Vec<_>>();
    let slow = softer(&scene);
    scene = scene.with_strengths_for(None).ok_or_else(|| Mistake(place.clone(), message))?;
    if let Some(group) = softer(&scene).iter().zip(&slow).position(|(now, before)| now != before) {
        return Err(Mistake(place.clone(), contacts.said(group, &bodies::exchanged(slow[group]))));
    }
    let no_prediction = |group| Mistake(place.clone(), contacts.said(group, &too_hard(&scene, group)));
    let predict = |group| scene.any_model_of(group).predict(&scene.impact_of(group));
    let predictions = scene.by_bodies(predict).into_iter().enumerate();
    let predictions = predictions.map(|(group, prediction)| prediction.ok_or_else(|| no_prediction(group)));
    scene.predictions = predictions.collect::<Result<_, _>>()?;
    // an impact that nobody has asked for may be
    if !scene.impact_is_assumed {
        for (group, prediction) in scene.predictions.iter().enumerate() {
            let checked = check_width(&scene, group, scene.laws.name(), &scene.impact_of(group), prediction);
            checked.map_err(|error| Mistake(place.clone(), contacts.said(group, &error.to_string())))?;
        }
    }
    Ok(scene)
}

/// The impact of the scene, or an impact at 1 m/s. Its mass is the given mass, otherwise the mass that the FMU knows, otherwise
/// that of the first contact's impactor, a solid ball with its radius and density, or a rod. Without an `[impact]`, the density of
/// the ball may be that of steel.
fn check_impact(
    given: Option<&Spanned<ImpactTable>>,
    known: Option<&Spanned<f64>>,
    contacts: &Contacts,
    is_line: bool,
) -> Result<Impact, Mistake> {
    let number = |name| contacts.number(0, name).map(|number| *number.get_ref());
    let radius = match contacts.radius(0, Body::Impactor).map(Spanned::get_ref) {
        Some(Radius::One(radius)) => *radius,
        _ => f64::NAN,
    };
    let rod = number(Body::Impactor.length()).zip(number(Body::Impactor.area()));
    let length = number(Body::Impactor.length()).filter(|_| is_line);
    let solid = |density: f64| match rod {
        None if length.is_some() => cylinders::mass(density, radius, length.unwrap_or(f64::NAN)),
        Some((length, area)) => density * length * area,
        None => density * 4.0 / 3.0 * PI * radius * radius * radius,
    };
    let Some(table) = given else {
        let mass = known.map(|mass| *mass.get_ref());
        let mass = mass.unwrap_or_else(|| solid(number(Body::Impactor.density()).unwrap_or(STEEL)));
        return Ok(Impact { mass, speed: 1.0 });
    };
    let ImpactTable { mass, speed, drop_height, .. } = table.get_ref();
    let height = || drop_height.as_ref().map_or(f64::NAN, |height| *height.get_ref());
    let speed = speed.as_ref().map_or_else(|| speed_of_height(height()), |speed| *speed.get_ref());
    let Some(given) = mass else {
        let mass = known.map(|mass| *mass.get_ref()).or_else(|| number(Body::Impactor.density()).map(solid)).ok_or_else(|| {
            let message = "missing field `mass` in [impact]: give it, or the density or material of [impactor], which is then \
                           taken for a solid ball or cylinder";
            Mistake(table.span(), message.into())
        })?;
        return Ok(Impact { mass, speed });
    };
    let mass = *given.get_ref();
    if let Some(known) = known.map(Spanned::get_ref).filter(|known| **known != mass) {
        let [mass, known] = [mass, *known].map(in_message);
        let message = format!("impact.mass = {mass} and coupling.effective_mass = {known} must be the same mass");
        return Err(Mistake(given.span(), message));
    }
    Ok(Impact { mass, speed })
}

/// Rejects bodies that do not touch at one point.
fn check_pair(scene: &Scene, group: usize, contacts: &Contacts) -> Result<(), Mistake> {
    if scene.pair_of(group).is_some() {
        return Ok(());
    }
    let flat = Spanned::new(0..0, f64::NAN);
    let socket = contacts.number(group, "target.radius").unwrap_or(&flat);
    let radius = scene.group_value(group, "impactor.radius").unwrap_or(f64::NAN);
    let message = format!(
        "target.radius = {} does not fit impactor.radius = {}: a socket (negative) must be wider than the impactor, and no \
         radius is below 1e-12 m",
        in_message(*socket.get_ref()),
        in_message(radius)
    );
    Err(Mistake(socket.span(), message))
}

/// Gives the groups whose bodies have two radii their ellipses. What these follow from is then a constant of the FMU.
fn settle_ellipses(scene: &mut Scene, file: &SceneFile, contacts: &Contacts) -> Result<(), Mistake> {
    let mut place = None;
    for group in 0..scene.contacts.len() {
        let radii = Both::each(|body| contacts.radius(group, body));
        let both = [radii.impactor, radii.target];
        let Some(two) = both.into_iter().flatten().find(|radius| matches!(radius.get_ref(), Radius::Two(_))) else {
            continue;
        };
        let values = |radius: Option<&Spanned<Radius>>| match radius.map(Spanned::get_ref) {
            Some(Radius::Two(two)) => *two,
            Some(Radius::One(one)) => [*one; 2],
            None => [f64::INFINITY; 2],
        };
        let elliptic = Elliptic::of(Both::each(|body| values(*radii.of(body))));
        let elliptic = elliptic.map_err(|why| Mistake(two.span(), contacts.said(group, &why)))?;
        scene.contacts[group].ellipse = Some(elliptic);
        let [_, target] = scene.bodies(group);
        let [_, ball] = scene.as_balls(group, [target; 2]);
        // the speed of waves is that of the body
        let density = &mut scene.contacts[group].density;
        *density = density.map(|density| density * (ball.youngs_modulus / target.youngs_modulus));
        place = Some(two.span());
    }
    let Some(place) = place else { return Ok(()) };
    let fixed =
        Body::ALL.map(|body| [body.radius(), body.youngs_modulus(), body.poissons_ratio(), body.hardening_modulus()]);
    let is_fixed =
        |name: &str| fixed.iter().flatten().any(|fixed| name == *fixed || name.ends_with(&format!(".{fixed}")));
    fmu::fix(scene, file, &place, is_fixed, "an ellipse: the ball that has its force follows from it")
}

/// The message about an impact for which the law cannot be evaluated.
fn too_hard(scene: &Scene, group: usize) -> String {
    let impact = scene.impact_of(group);
    // on a thick target of this material it ends
    let thick = || AnyModel::Elastoplastic(scene.model_of(group)).predict(&impact);
    if let Some(Loss::Plate(thickness)) = scene.laws.loss()
        && thick().is_some()
    {
        return format!(
            "the impact of mass = {} kg and speed = {} m/s never ends: target.plate_thickness = {} m is so thin that the sheet bends \
             and moves on with the body, until waves come back from its edge, which the loss leaves out; {}",
            in_message(impact.mass),
            in_message(impact.speed),
            in_message(thickness),
            "a thicker plate, a lighter body or a target without plate_thickness can be computed"
        );
    }
    let [mass, speed] = [impact.mass, impact.speed].map(in_message);
    let what = match scene.is_rate_dependent() {
        false => "drives the bodies deeper than the law can be evaluated",
        true => "drives the bodies deeper than the law can be evaluated, or is damped so strongly that it never ends",
    };
    format!("the impact of mass = {mass} kg and speed = {speed} m/s {what}")
}
