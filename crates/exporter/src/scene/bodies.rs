//! The bodies of each contact, which of the two yields, and values that follow from them alone.

use super::Scene;
use crate::numbers::{cell, quantity};
use brinell_contact::impact::Prediction;
use brinell_contact::losses::Loss;
use brinell_contact::rate::Factors;
use brinell_contact::{OtherBody, Pair, TwoBodies};
use std::collections::HashMap;
use std::f64::consts::PI;

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    Impactor,
    Target,
}

/// The properties that a contact may override.
const IMPACTOR: [&str; 6] = [
    "impactor.radius",
    "impactor.youngs_modulus",
    "impactor.poissons_ratio",
    "impactor.yield_strength",
    "impactor.hardening_modulus",
    "impactor.density",
];
const TARGET: [&str; 6] = [
    "target.radius",
    "target.youngs_modulus",
    "target.poissons_ratio",
    "target.yield_strength",
    "target.hardening_modulus",
    "target.density",
];

impl Body {
    pub const ALL: [Body; 2] = [Body::Impactor, Body::Target];

    /// The name of its table in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Body::Impactor => "impactor",
            Body::Target => "target",
        }
    }

    /// The names of its properties. Its density, the last one, is not a variable of the FMU.
    pub const fn properties(self) -> [&'static str; 6] {
        match self {
            Body::Impactor => IMPACTOR,
            Body::Target => TARGET,
        }
    }

    pub const fn radius(self) -> &'static str {
        self.properties()[0]
    }

    pub const fn youngs_modulus(self) -> &'static str {
        self.properties()[1]
    }

    pub const fn poissons_ratio(self) -> &'static str {
        self.properties()[2]
    }

    pub const fn yield_strength(self) -> &'static str {
        self.properties()[3]
    }

    pub const fn hardening_modulus(self) -> &'static str {
        self.properties()[4]
    }

    pub const fn density(self) -> &'static str {
        self.properties()[5]
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
    /// What `value` gives for each body.
    pub fn each(mut value: impl FnMut(Body) -> T) -> Both<T> {
        Both { impactor: value(Body::Impactor), target: value(Body::Target) }
    }

    /// The same where `value` may fail: the impactor's failure first.
    pub fn try_each<E>(mut value: impl FnMut(Body) -> Result<T, E>) -> Result<Both<T>, E> {
        Ok(Both { impactor: value(Body::Impactor)?, target: value(Body::Target)? })
    }

    pub fn of(&self, body: Body) -> &T {
        match body {
            Body::Impactor => &self.impactor,
            Body::Target => &self.target,
        }
    }
}

impl Scene {
    /// The bodies of the contacts of `group`; `None` if they do not fit.
    pub(super) fn pair_of(&self, group: usize) -> Option<Pair> {
        self.pair_with(group, &[])
    }

    /// The same bodies with other values for some of their parameters.
    pub fn pair_with(&self, group: usize, values: &[(&str, f64)]) -> Option<Pair> {
        let [impactor, target] = self.bodies_with(group, values);
        let softer = self.softer_with(group, values);
        let other = values.iter().find(|(known, _)| *known == softer.yield_strength()).map(|(_, value)| *value);
        let factor = self.factors[group].softer;
        let own = || self.group_value(group, softer.yield_strength()).map(|strength| strength * factor);
        let strength = other.or_else(own).unwrap_or(f64::INFINITY);
        let pair = Pair::new(&impactor, &target, strength)?;
        Some(if softer == Body::Impactor { pair.yielding_in(&impactor, strength) } else { pair })
    }

    /// What the law `brinell` needs to know of the bodies of `group` beside their pair.
    pub fn two_bodies(&self, group: usize) -> TwoBodies {
        self.two_bodies_with(group, &[])
    }

    /// The same bodies with other values for some of their parameters.
    pub fn two_bodies_with(&self, group: usize, values: &[(&str, f64)]) -> TwoBodies {
        let Factors { softer: factor, harder: others } = self.factors[group];
        let value = |name: &str, without: f64, factor: f64| {
            let other = values.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
            other.or_else(|| self.group_value(group, name).map(|own| own * factor)).unwrap_or(without)
        };
        let softer = self.softer_with(group, values);
        let [impactor, target] = self.bodies_with(group, values);
        let body = if softer == Body::Impactor { target } else { impactor };
        TwoBodies {
            hardening_modulus: value(softer.hardening_modulus(), 0.0, factor),
            other: OtherBody {
                modulus: body.plane_strain_modulus(),
                poissons_ratio: body.poissons_ratio,
                yield_strength: value(softer.other().yield_strength(), f64::INFINITY, others),
                hardening_modulus: value(softer.other().hardening_modulus(), 0.0, others),
            },
        }
    }

    /// Impactor and target of `group`, with other values for some of their parameters. An impactor without moduli is rigid, a target
    /// without a radius is flat.
    pub fn bodies_with(&self, group: usize, values: &[(&str, f64)]) -> [brinell_contact::Body; 2] {
        let value = |name, without| self.value_with(group, name, values).unwrap_or(without);
        let of = |body: Body, [radius, youngs_modulus, poissons_ratio]: [f64; 3]| brinell_contact::Body {
            radius: value(body.radius(), radius),
            youngs_modulus: value(body.youngs_modulus(), youngs_modulus),
            poissons_ratio: value(body.poissons_ratio(), poissons_ratio),
        };
        [of(Body::Impactor, [f64::NAN, f64::INFINITY, 0.0]), of(Body::Target, [f64::INFINITY, f64::NAN, f64::NAN])]
    }

    /// The number `name` of `group`: the one in `values`, otherwise that of the scene.
    pub(super) fn value_with(&self, group: usize, name: &str, values: &[(&str, f64)]) -> Option<f64> {
        let other = values.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
        other.or_else(|| self.group_value(group, name))
    }

    /// The result of `of` for each group. Ten thousand groups may have the same bodies. A result that follows only from the
    /// bodies, their mass and the laws of the scene is computed once for all of them.
    pub fn by_bodies<T: Clone>(&self, mut of: impl FnMut(usize) -> T) -> Vec<T> {
        let mut known: HashMap<_, T> = HashMap::new();
        let groups = 0..self.contacts.len();
        groups
            .map(|group| {
                let bodies = self.pair_of(group).map(|pair| {
                    let Pair { radius, modulus, yield_strength, youngs_modulus, poissons_ratio } = pair;
                    let restitution = self.group_value(group, "restitution").unwrap_or(f64::NAN);
                    // it follows from the density, which the pair doesn't know
                    let loss = self.loss_with(group, &[]).map_or(f64::NAN, |loss| loss.factor());
                    let TwoBodies { hardening_modulus, other } = self.two_bodies(group);
                    let softer = [yield_strength, youngs_modulus, poissons_ratio, hardening_modulus];
                    let harder = [other.yield_strength, other.modulus, other.poissons_ratio, other.hardening_modulus];
                    let rest = [radius, modulus, restitution, loss, self.impact_of(group).mass];
                    (softer.map(f64::to_bits), harder.map(f64::to_bits), rest.map(f64::to_bits))
                });
                known.entry(bodies).or_insert_with(|| of(group)).clone()
            })
            .collect()
    }

    /// The body of `group` that yields.
    pub fn softer(&self, group: usize) -> Body {
        self.softer_with(group, &[])
    }

    /// The same with other values for some of the parameters.
    pub fn softer_with(&self, group: usize, values: &[(&str, f64)]) -> Body {
        let strength = |body: Body| self.value_with(group, body.yield_strength(), values).unwrap_or(f64::INFINITY);
        if strength(Body::Impactor) < strength(Body::Target) { Body::Impactor } else { Body::Target }
    }

    /// The strength of the harder body of `group` \[Pa\], if it is known.
    fn harder_strength(&self, group: usize) -> Option<f64> {
        match self.softer(group) {
            Body::Impactor => self.group_value(group, Body::Target.yield_strength()),
            Body::Target => self.contacts[group].impactor_strength,
        }
    }
}

/// The message about bodies of which `softer` is the softer one under a slow load, and not in the scene's impact.
pub fn exchanged(softer: Body) -> String {
    let (name, other) = (softer.name(), softer.other().name());
    format!(
        "under a slow load the {name} is the softer body, and in the scene's impact the {other}: give the strengths of the impact \
         (yield_strength) instead of a rate or a power law"
    )
}

/// Mean pressure over yield strength at first yield of the law `brinell`, rounded down: the harder body is elastic below.
const FIRST_YIELD: f64 = 1.07;

/// Strengths this close to each other count as equal.
const EQUAL: f64 = 0.01;

/// Notes on the bodies of the first contact in an impact with this `prediction`.
pub fn notes(scene: &Scene, prediction: &Prediction) -> Vec<String> {
    let Some(soft) = scene.yield_strength.filter(|_| prediction.residual_indentation > 0.0) else { return Vec::new() };
    let softer = scene.softer(0);
    let (name, other) = (softer.name(), softer.other().name());
    let mut notes = Vec::new();
    if softer == Body::Impactor {
        notes.push("The impactor is the softer body: it yields, and the dent is in the impactor.".into());
    }
    let Some(hard) = scene.harder_strength(0) else {
        notes.extend(beside_elastic(scene));
        return notes;
    };
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
    } else {
        notes.extend(beside_elastic(scene));
    }
    notes
}

/// How much too soft the law `brinell` is beside an elastic body: the modulus of the body that yields over that of the other, the
/// other way round in words, and the largest errors of force and restitution \[%\]. By finite elements of both bodies, for Poisson's
/// ratios of 0.3, no hardening and small strain; the guide has the table.
const BESIDE_ELASTIC: [(f64, &str, &str, &str); 3] = [
    (1.0 / 3.0, "three times the", "4.5", "2"),
    (1.0, "the same", "9", "4 to 5"),
    (3.0, "a third of the", "15", "7 to 9"),
];

/// Below this ratio of the moduli the elastic body is nearly rigid.
const NEARLY_RIGID: f64 = 0.1;

/// Above this ratio of the moduli no finite elements of pairs are near.
const SOFTEST: f64 = 4.5;

/// What the elastic body of the first contact means for the accuracy of the laws, which take both bodies as one of the effective
/// modulus. `None` if no body yields, or if the other one is rigid.
pub fn beside_elastic(scene: &Scene) -> Option<String> {
    scene.yield_strength?;
    let softer = scene.softer(0);
    let [impactor, target] =
        scene.bodies_with(0, &[]).map(|body| body.youngs_modulus / (1.0 - body.poissons_ratio.powi(2)));
    let ratio = if softer == Body::Target { target / impactor } else { impactor / target };
    if ratio < NEARLY_RIGID {
        return None;
    }
    let distance = |(known, ..): &(f64, &str, &str, &str)| (ratio / known).ln().abs();
    let nearest = BESIDE_ELASTIC.iter().min_by(|one, other| distance(one).total_cmp(&distance(other)))?;
    let (_, modulus, force, restitution) = nearest;
    let more =
        if ratio > SOFTEST { "; here it is more, since the error grows as the elastic body gets softer" } else { "" };
    Some(format!(
        "The {} stays elastic, and its modulus is {} times that of the {}. The laws take both bodies as one of the effective modulus, \
         which is too soft. By finite elements with {modulus} modulus, the law brinell is too low by up to {force} % in force at the \
         same depth and {restitution} % in restitution{more}.",
        softer.other().name(),
        cell(1.0 / ratio, 1.0),
        softer.name(),
    ))
}
