//! Which of the two bodies yields: the softer one.

use super::Scene;
use super::contacts::Contacts;
use super::error::Mistake;
use super::numbers::{IMPACTOR_HARDENING, IMPACTOR_STRENGTH};
use crate::numbers::{cell, in_message, quantity};
use brinell_contact::impact::Prediction;
use std::f64::consts::PI;

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    Impactor,
    Target,
}

impl Body {
    /// The name of its table in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Body::Impactor => "impactor",
            Body::Target => "target",
        }
    }

    /// The name of its yield strength.
    pub const fn yield_strength(self) -> &'static str {
        match self {
            Body::Impactor => "impactor.yield_strength",
            Body::Target => "target.yield_strength",
        }
    }

    /// The name of its hardening modulus.
    pub const fn hardening_modulus(self) -> &'static str {
        match self {
            Body::Impactor => "impactor.hardening_modulus",
            Body::Target => "target.hardening_modulus",
        }
    }

    pub fn other(self) -> Body {
        match self {
            Body::Impactor => Body::Target,
            Body::Target => Body::Impactor,
        }
    }
}

/// A value for each of the two bodies.
#[derive(Clone, Copy, Debug, Default)]
pub struct Both<T> {
    pub impactor: T,
    pub target: T,
}

impl<T> Both<T> {
    pub fn of(&self, body: Body) -> &T {
        match body {
            Body::Impactor => &self.impactor,
            Body::Target => &self.target,
        }
    }
}

/// The softer body: the impactor only if its strength is below that of the target.
pub fn softer_of(impactor_strength: f64, target_strength: f64) -> Body {
    if impactor_strength < target_strength { Body::Impactor } else { Body::Target }
}

/// Mean pressure over yield strength at first yield of the law `brinell`, rounded down: the harder body is elastic below.
const FIRST_YIELD: f64 = 1.07;

/// Strengths this close to each other count as equal.
const EQUAL: f64 = 0.01;

/// Rejects a strength or a hardening of the impactor of the contact `index` that cannot have an effect. `given` is whether the
/// scene gives them, rather than by a material.
pub fn check(contacts: &Contacts, index: usize, given: bool) -> Result<(), Mistake> {
    let hardening = contacts.number(index, IMPACTOR_HARDENING);
    let Some(strength) = contacts.number(index, IMPACTOR_STRENGTH) else {
        return hardening.map_or(Ok(()), |hardening| {
            let message = "the hardening of the impactor needs impactor.yield_strength, or a material";
            Err(Mistake(hardening.span(), contacts.said(index, message)))
        });
    };
    let is_rigid = contacts.number(index, "impactor.youngs_modulus").is_none();
    if given && is_rigid {
        let message = format!(
            "impactor.yield_strength = {}: a rigid impactor cannot yield; give impactor.youngs_modulus and poissons_ratio, or \
             a material, or leave the strength out",
            in_message(*strength.get_ref())
        );
        return Err(Mistake(strength.span(), contacts.said(index, &message)));
    }
    Ok(())
}

/// The message about bodies of which `softer` is the softer one under a slow load, and not in the scene's impact.
pub fn exchanged(softer: Body) -> String {
    let (name, other) = (softer.name(), softer.other().name());
    format!(
        "under a slow load the {name} is the softer body, and in the scene's impact the {other}: give the strengths of the impact \
         (yield_strength) instead of a rate or a power law"
    )
}

impl Scene {
    /// The body of `group` that yields.
    pub fn softer(&self, group: usize) -> Body {
        self.softer_with(group, &[])
    }

    /// The same with other values for some of the parameters.
    pub fn softer_with(&self, group: usize, values: &[(&str, f64)]) -> Body {
        let strength = |body: Body| {
            let other = values.iter().find(|(known, _)| *known == body.yield_strength()).map(|(_, value)| *value);
            other.or_else(|| self.group_value(group, body.yield_strength())).unwrap_or(f64::INFINITY)
        };
        softer_of(strength(Body::Impactor), strength(Body::Target))
    }

    /// The strength of the harder body of `group` [Pa], if it is known.
    fn harder_strength(&self, group: usize) -> Option<f64> {
        match self.softer(group) {
            Body::Impactor => self.group_value(group, Body::Target.yield_strength()),
            Body::Target => self.contacts[group].impactor_strength,
        }
    }
}

/// Notes on the bodies of the first contact in an impact with this `prediction`.
pub fn notes(scene: &Scene, prediction: &Prediction) -> Vec<String> {
    let Some(soft) = scene.yield_strength.filter(|_| prediction.residual_indentation > 0.0) else { return Vec::new() };
    let softer = scene.softer(0);
    let (name, other) = (softer.name(), softer.other().name());
    let mut notes = Vec::new();
    if softer == Body::Impactor {
        notes.push("The impactor is the softer body: it yields, and the dent is in the impactor.".into());
    }
    let Some(hard) = scene.harder_strength(0) else { return notes };
    if (hard / soft - 1.0).abs() <= EQUAL {
        return vec![
            "Both bodies are equally strong and yield alike: force over indentation is the same, and each of them has half of \
             the dent."
                .into(),
        ];
    }
    let radius = prediction.max_contact_radius;
    let pressure = prediction.max_force / (PI * radius * radius);
    if pressure > FIRST_YIELD * hard {
        notes.push(format!(
            "The mean pressure reaches {} times the yield strength of the {other}, {}. From {FIRST_YIELD} on it yields, too. The \
             prediction is that of two bodies of the strength of the {name}. With a stronger {other} the contact is harder: by \
             finite elements with equal moduli, up to 5 % in force at the same depth if it is 1.2 times as strong, 9 % if twice.",
            cell(pressure / hard, 1.0),
            quantity(hard, "Pa")
        ));
    }
    notes
}
