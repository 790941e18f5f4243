//! Which of the two bodies yields: the softer one, which must be the target.

use super::contacts::Contacts;
use super::file::{File, Impactor, Target};
use super::numbers::IMPACTOR_STRENGTH;
use super::{Mistake, Scene};
use crate::numbers::{cell, quantity};
use crate::table::{MATERIALS, Material};
use brinell::contact::impact::Prediction;
use std::f64::consts::PI;
use toml::Spanned;

/// The way to a scene in which the softer body is the target.
const EXCHANGE: &str = "exchange the bodies: the normal contact depends on effective radius and modulus, which stay the same \
                        (a flat body as impactor is one with radius = 1e9)";

/// Mean pressure over yield strength at first yield of the law `brinell`, rounded down: the harder body is elastic below.
const FIRST_YIELD: f64 = 1.07;

/// Strengths this close to each other count as equal.
const EQUAL: f64 = 0.01;

/// Rejects a yield strength of the impactor below that of the target of the contact `index`.
pub fn check(file: &File, contacts: &Contacts, index: usize) -> Result<(), Mistake> {
    let Some(impactor) = contacts.number(index, IMPACTOR_STRENGTH) else { return Ok(()) };
    let own = file.contact.iter().flat_map(|all| all.get_ref()).map(|contact| &contact.get_ref().impactor);
    let given = file.impactor.iter().map(Spanned::get_ref).chain(own);
    // that of a material is doubted instead: the scene may mean another heat treatment
    let is_given = given.filter_map(|body| body.yield_strength.as_ref()).any(|number| number.span() == impactor.span());
    let Some(target) = contacts.number(index, "target.yield_strength").filter(|_| is_given) else { return Ok(()) };
    let (strength, other) = (*impactor.get_ref(), *target.get_ref());
    if strength >= other * (1.0 - EQUAL) {
        return Ok(());
    }
    let message = format!(
        "impactor.yield_strength = {strength:?} is below target.yield_strength = {other:?}: the softer body must be the target; \
         {EXCHANGE}"
    );
    Err(Mistake(impactor.span(), contacts.said(index, &message)))
}

/// The doubt about an impactor whose material is softer than the target.
pub fn doubts(file: &File) -> Vec<Mistake> {
    let standard = (Impactor::default(), Target::default());
    let impactor = file.impactor.as_ref().map_or(&standard.0, Spanned::get_ref);
    let target = file.target.as_ref().map_or(&standard.1, Spanned::get_ref);
    let strength = |material: Option<&Spanned<String>>| material.and_then(known).map(|known| known.yield_strength);
    let mut doubts = Vec::new();
    let mut compare = |owner: &str, one: &Impactor, other: &Target| {
        let Some(material) = one.material.as_ref().or(impactor.material.as_ref()) else { return };
        let given = one.yield_strength.as_ref().or(impactor.yield_strength.as_ref()).is_some();
        let of_target =
            other.yield_strength.as_ref().or(target.yield_strength.as_ref()).map(|number| *number.get_ref());
        let of_target = of_target.or_else(|| strength(other.material.as_ref().or(target.material.as_ref())));
        let (Some(soft), Some(hard)) = (strength(Some(material)), of_target) else { return };
        if !given && soft < hard * (1.0 - EQUAL) {
            let message = format!(
                "{owner}impactor.material = \"{}\" (yield strength {}) is softer than the target ({}), but the target yields; \
                 {EXCHANGE}, or give impactor.yield_strength",
                material.get_ref(),
                quantity(soft, "Pa"),
                quantity(hard, "Pa")
            );
            doubts.push(Mistake(material.span(), message));
        }
    };
    match &file.contact {
        None => compare("", impactor, target),
        Some(contacts) => contacts.get_ref().iter().map(Spanned::get_ref).for_each(|contact| {
            compare(&format!("{}.", contact.name.get_ref()), &contact.impactor, &contact.target);
        }),
    }
    doubts
}

fn known(name: &Spanned<String>) -> Option<&'static Material> {
    MATERIALS.iter().find(|material| &material.name == name.get_ref())
}

/// Notes on the impactor of the first contact, whose strength is known, in an impact with this `prediction`.
pub fn notes(scene: &Scene, prediction: &Prediction) -> Option<String> {
    let (impactor, target) = (scene.contacts[0].impactor_strength?, scene.yield_strength?);
    if prediction.residual_indentation <= 0.0 {
        return None;
    }
    let ratio = impactor / target;
    if (ratio - 1.0).abs() <= EQUAL {
        return Some(
            "Both bodies are equally strong and yield alike: force over indentation is the same, and each of them has half of \
             the dent."
                .into(),
        );
    }
    let radius = prediction.max_contact_radius;
    let pressure = prediction.max_force / (PI * radius * radius);
    (ratio > 1.0 && pressure > FIRST_YIELD * impactor).then(|| {
        format!(
            "The mean pressure reaches {} of the yield strength of the impactor. From {FIRST_YIELD} on it yields, too; the \
             prediction keeps it elastic. Where both yield, the contact is softer than this, at most as soft as with two bodies \
             of the strength of the target.",
            cell(pressure / impactor, 1.0)
        )
    })
}
