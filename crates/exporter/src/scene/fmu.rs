//! The FMU: its description, the mass that it moves, and what the table `[fmu]` asks for.

use super::checked::{Coupling, Masses, Parameter, Scene};
use super::file::{CouplingTable, Fmu, MasterName, SceneFile};
use super::inverse_masses::InverseMasses;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::nearest::unknown;
use crate::numbers::in_message;
use crate::table::{self, Causality, VARIABLES};
use crate::xml;
use std::collections::HashSet;
use std::ops::Range;

/// The text of the `key`, which the model description must be able to contain; empty if it is not given.
pub fn check_text(key: &str, given: Option<&Spanned<String>>) -> Result<String, Mistake> {
    let Some(text) = given else { return Ok(String::new()) };
    match xml::forbidden(text.get_ref()) {
        None => Ok(text.get_ref().clone()),
        Some((place, character)) => {
            let number = text.get_ref()[..place].chars().count() + 1;
            let character = xml::name(character);
            let message = format!("{key} has {character} as character {number}, which XML doesn't allow");
            Err(Mistake(text.span(), message))
        }
    }
}

/// Inputs that an FMU can have in addition to the rate.
pub const INPUTS: [&str; 2] = ["external_acceleration", "effective_mass"];

/// The coupling in this table, which the unit has without it, too, if its contacts share bodies with these inverse masses; and the mass.
pub fn check_coupling(
    given: Option<&Spanned<CouplingTable>>,
    shared: Option<InverseMasses>,
) -> Result<(Option<Coupling>, Option<Spanned<f64>>), Mistake> {
    let Some(table) = given else {
        let alone = |masses| Coupling { parallel: false, acceleration_input: false, masses: Masses::Shared(masses) };
        return Ok((shared.map(alone), None));
    };
    let CouplingTable { effective_mass, master, inputs, .. } = table.get_ref();
    for input in inputs {
        if !INPUTS.contains(&input.get_ref().as_str()) {
            return Err(Mistake(input.span(), unknown("input", input.get_ref(), INPUTS.into_iter())));
        }
    }
    let [acceleration_input, mass_input] = INPUTS.map(|name| inputs.iter().any(|input| input.get_ref() == name));
    let parallel = *master == Some(MasterName::Parallel);
    let masses = shared.map_or(Masses::Effective { is_input: mass_input }, Masses::Shared);
    Ok((Some(Coupling { parallel, acceleration_input, masses }), effective_mass.clone()))
}

/// Makes settable only the parameters in `chosen`, or all: those of all contacts and those of one contact.
pub fn choose_settable(scene: &mut Scene, chosen: Option<&[Spanned<String>]>) -> Result<(), Mistake> {
    let Some(chosen) = chosen else { return Ok(()) };
    let names: HashSet<&str> = chosen.iter().map(|name| name.get_ref().as_str()).collect();
    let mut known = Vec::new();
    let mass_is_input = scene.mass_is_input();
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

/// Makes the parameters that are `is_fixed` constants, by their names in the FMU. `place` is where the scene has what they belong to, and
/// `of` says what that is and why.
pub fn fix(
    scene: &mut Scene,
    file: &SceneFile,
    place: &Range<usize>,
    is_fixed: impl Fn(&str) -> bool,
    of: &str,
) -> Result<(), Mistake> {
    let named = file.fmu.parameters.iter().flatten().find(|name| is_fixed(name.get_ref()));
    let per_contact =
        scene.contacts.iter().flat_map(|group| &group.own).find(|own| own.per_contact && is_fixed(own.name));
    let named = named.map(|name| (name.get_ref().as_str(), name.span()));
    if let Some((name, span)) = named.or(per_contact.map(|own| (own.name, place.clone()))) {
        return Err(Mistake(span, format!("{name} is no parameter of {of}")));
    }
    let own = scene.contacts.iter_mut().flat_map(|group| &mut group.own);
    own.chain(&mut scene.parameters).filter(|own| is_fixed(own.name)).for_each(|own| own.settable = false);
    Ok(())
}

/// The outputs beside the force, each once.
pub fn check_outputs(chosen: &[Spanned<String>]) -> Result<Vec<String>, Mistake> {
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
        if text != "force" && !outputs.contains(text) {
            outputs.push(text.clone());
        }
    }
    Ok(outputs)
}

/// Step size and stop time that the scene suggests to importers \[s\], as far as it gives them.
pub fn check_experiment(given: &Fmu) -> Result<(Option<f64>, Option<f64>), Mistake> {
    let value = |time: &Option<Spanned<f64>>| time.as_ref().map(|time| *time.get_ref());
    let (step, stop) = (value(&given.step_size), value(&given.stop_time));
    match (step, stop, &given.stop_time) {
        (Some(step), Some(stop), Some(place)) if stop < step => {
            let [stop, step] = [stop, step].map(in_message);
            let message =
                format!("fmu.stop_time = {stop} s is before the end of the first step of fmu.step_size = {step} s");
            Err(Mistake(place.span(), message))
        }
        _ => Ok((step, stop)),
    }
}
