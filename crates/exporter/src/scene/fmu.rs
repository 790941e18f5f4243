//! The FMU: its description, the mass that it moves, and what the table `[fmu]` asks for.

use super::contacts::Parameter;
use super::file::{CouplingTable, Fmu, MasterName};
use super::quantities::check_quantity;
use super::{Coupling, Scene};
use crate::mistake::Spanned;
use crate::mistake::{Mistake, positive};
use crate::nearest::unknown;
use crate::numbers::in_message;
use crate::table::{self, Causality, VARIABLES};
use crate::xml;
use std::collections::HashSet;

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

/// The coupling in this table, which the unit has without it, too, if its contacts share bodies; and the mass. `damps_by_mass` is
/// the name of the law if its damping follows from the mass.
pub fn check_coupling(
    given: Option<&Spanned<CouplingTable>>,
    damps_by_mass: Option<&str>,
    shares_bodies: bool,
) -> Result<(Option<Coupling>, Option<Spanned<f64>>), Mistake> {
    let Some(table) = given else { return Ok((shares_bodies.then(Coupling::default), None)) };
    let CouplingTable { effective_mass, master, inputs, .. } = table.get_ref();
    effective_mass.as_ref().map(|mass| positive("coupling.effective_mass", mass)).transpose()?;
    for input in inputs {
        if !INPUTS.contains(&input.get_ref().as_str()) {
            return Err(Mistake(input.span(), unknown("input", input.get_ref(), INPUTS.into_iter())));
        }
    }
    let mass = inputs.iter().find(|input| input.get_ref() == "effective_mass");
    if let (Some(name), Some(mass)) = (damps_by_mass, mass) {
        let message = format!(
            "coupling.inputs = [\"effective_mass\"]: the damping of {name} is computed from the mass before the first step, so \
             the mass can't change; leave it a parameter"
        );
        return Err(Mistake(mass.span(), message));
    }
    let [acceleration_input, mass_input] = INPUTS.map(|name| inputs.iter().any(|input| input.get_ref() == name));
    let parallel = *master == Some(MasterName::Parallel);
    Ok((Some(Coupling { parallel, acceleration_input, mass_input }), effective_mass.clone()))
}

/// Makes settable only the parameters in `chosen`, or all: those of all contacts and those of one contact.
pub fn choose_settable(scene: &mut Scene, chosen: Option<&[Spanned<String>]>) -> Result<(), Mistake> {
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

/// What an FMU has that some outputs need.
pub struct Has {
    pub mass: bool,
    pub shared_bodies: bool,
    pub friction: bool,
}

/// The outputs beside the force, each once.
pub fn check_outputs(chosen: &[Spanned<String>], has: &Has) -> Result<Vec<String>, Mistake> {
    let Has { mass: knows_mass, shared_bodies, friction } = *has;
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
        if table::OF_SHARED.contains(&text.as_str()) && !shared_bodies {
            let message = format!("the output {text} needs contacts that share bodies: tables [[body]]");
            return Err(Mistake(name.span(), message));
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

/// Whether the inputs may have derivatives, as far as the law allows.
pub fn check_input_derivatives(
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

/// Step size and stop time that the scene suggests to importers \[s\], as far as it gives them.
pub fn check_experiment(given: &Fmu) -> Result<(Option<f64>, Option<f64>), Mistake> {
    for (name, time) in [("fmu.step_size", &given.step_size), ("fmu.stop_time", &given.stop_time)] {
        time.as_ref().map(|time| check_quantity(name, "", time)).transpose()?;
    }
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
