//! What the table `[fmu]` asks for: parameters, outputs, and derivatives of the inputs.

use super::Scene;
use super::contacts::Parameter;
use crate::mistake::Mistake;
use crate::nearest::unknown;
use crate::table::{self, Causality, VARIABLES};
use std::collections::HashSet;
use toml::Spanned;

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

/// The outputs beside the force, each once.
pub fn check_outputs(chosen: &[Spanned<String>], knows_mass: bool, friction: bool) -> Result<Vec<String>, Mistake> {
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
