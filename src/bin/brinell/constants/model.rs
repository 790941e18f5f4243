//! The model of a contact, as an expression.

use super::{File, groups, literal};
use crate::scene::{Body, Loss, Rate, Scene};

/// Number of segments in which the springs of a contact with friction in one direction remember its past.
pub const MEMORY: usize = 12;

/// The same for two directions.
pub const PLANE_MEMORY: usize = 16;

/// The expressions of a model of each kind, from its laws.
pub const DAMPED_MODEL: &str = "let (restitution, mass) = (value(Parameter::Restitution), value(Parameter::EffectiveMass));\n\
                            damped::Model { pair, law: LAW, restitution, mass }";

/// Whether the FMU needs the form of its loading law, and of its unloading law, for targets that harden and for their Poisson's
/// ratio.
pub fn strengthened_forms(scene: &Scene) -> [bool; 2] {
    let unloads = scene.plain_unloading().strengthened(0.0).is_some();
    [scene.is_strengthened(), scene.is_strengthened() && unloads]
}

/// The expression of a model by elastoplastic laws; `value` is one of the hardening modulus, `surface` of the surface.
pub fn model_of(scene: &Scene, value: &str, surface: &str) -> String {
    let [loading, unloading] = strengthened_forms(scene);
    let law = |module: &str, constant: &str, has| match has {
        true => format!("{module}::Strengthened {{ law: {constant}, hardening_modulus }}"),
        false => constant.to_string(),
    };
    if !loading {
        return format!("contact::Model {{ pair, loading: LOADING, unloading: UNLOADING, {surface} }}");
    }
    format!(
        "let hardening_modulus = {value};\n\
         contact::Model {{\n    pair,\n    loading: {},\n    unloading: {},\n    {surface},\n}}",
        law("loading", "LOADING", true),
        law("unloading", "UNLOADING", unloading)
    )
}

/// The type of a loss.
pub fn kind_of(loss: Loss) -> &'static str {
    match loss {
        Loss::Fitted(_) => "Fitted",
        Loss::Waves => "Waves",
        Loss::Plate(_) => "Plate",
    }
}

/// The expression of a model with this `loss`, from that of its `plastic` part.
fn with_loss(loss: Loss, plastic: &str) -> String {
    let value = "let value = |which| Self::parameter(which, group, values);\n";
    let target = "let target = losses::Solid {\n    density: Self::density(group).unwrap_or(f64::NAN),\n    \
                  youngs_modulus: value(Parameter::TargetYoungsModulus),\n    \
                  poissons_ratio: value(Parameter::TargetPoissonsRatio),\n};\n";
    let (target, fields) = match loss {
        Loss::Fitted(_) => ("", "restitution: value(Parameter::ElasticRestitution)"),
        Loss::Waves => (target, "target"),
        Loss::Plate(_) => (target, "target, thickness: value(Parameter::TargetPlateThickness)"),
    };
    let (first, last) = plastic.split_once(";\n").unwrap_or(("", plastic));
    let first = if first.is_empty() { String::new() } else { format!("{first};\n") };
    let kind = kind_of(loss);
    format!(
        "{value}{target}{first}let plastic = {last};\nlosses::Model {{ plastic, loss: losses::{kind} {{ {fields} }} }}"
    )
}

/// The model of a group.
pub fn add_model(file: &mut File, scene: &Scene) {
    if scene.damped.is_some() {
        file.add_method(
            "model(pair: Pair, group: usize, values: &Self::Values) -> Self::Model",
            &format!("let value = |which| Self::parameter(which, group, values);\n{DAMPED_MODEL}"),
        );
        return;
    }
    let (group, surface) = groups::surface(file, scene);
    let chooses_rate = scene.finds_strength() && scene.has_two_strengths();
    let needs_group = scene.is_strengthened() || scene.has_friction() || chooses_rate || scene.loss.is_some();
    let group = if needs_group { "group" } else { group };
    let values = if needs_group { "values" } else { "_values" };
    let hardening_modulus = "Self::hardening_modulus(group, values)";
    let plastic = model_of(scene, hardening_modulus, &format!("surface: {surface}"));
    let model = match scene.loss {
        _ if scene.has_friction() => with_friction(&plastic),
        Some(loss) => with_loss(loss, &plastic),
        None if scene.finds_strength() => with_rate(scene, &plastic),
        None => plastic,
    };
    file.add_method(&format!("model(pair: Pair, {group}: usize, {values}: &Self::Values) -> Self::Model"), &model);
}

/// The expression of a model whose strength depends on the impact, from that `slow` one.
fn with_rate(scene: &Scene, slow: &str) -> String {
    let (first, last) =
        slow.split_once(";\n").map_or((String::new(), slow), |(first, last)| (format!("{first};\n"), last));
    let rate = match scene.has_two_strengths() {
        true => "rate: if Self::impactor_yields(group, values) { IMPACTOR_RATE } else { RATE }",
        false => "rate: RATE",
    };
    format!("{first}let slow = {last};\nrate::Model {{ slow, {rate} }}")
}

/// The same strength at any strain rate.
const NO_RATE: Rate = Rate::JohnsonCook { c: 0.0, reference_rate: 1.0 };

/// Adds the models of the strain rate, if the unit finds the strength of each impact.
pub fn add_rate(file: &mut File, scene: &Scene) {
    if !scene.finds_strength() {
        return;
    }
    add_rate_of(file, Body::Target, "RATE", scene.rates.target);
    if scene.has_two_strengths() {
        add_rate_of(file, Body::Impactor, "IMPACTOR_RATE", scene.rates.impactor);
    }
}

/// Adds the model of the strain rate of a `body` as a constant.
fn add_rate_of(file: &mut File, body: Body, constant: &str, rate: Option<Rate>) {
    let (name, fields) = match rate.unwrap_or(NO_RATE) {
        Rate::JohnsonCook { c, reference_rate } => ("JohnsonCook", [("c", c), ("reference_rate", reference_rate)]),
        Rate::CowperSymonds { d, q } => ("CowperSymonds", [("d", d), ("q", q)]),
    };
    let [one, other] = fields.map(|(field, value)| format!("{field}: {}", literal(value)));
    file.add_item(&format!(
        "/// The strength of the {} over the strain rate.\nconst {constant}: rate::Rate = rate::Rate::{name} {{ {one}, {other} }};\n",
        body.name()
    ));
}

/// The expression of a model with friction, from that of its normal part.
fn with_friction(normal: &str) -> String {
    let normal = match normal.rsplit_once("contact::Model") {
        Some((before, model)) => format!("{before}let normal = contact::Model{model};"),
        None => normal.to_string(),
    };
    format!("{normal}\nwith_friction(normal, |which| Self::parameter(which, group, values))")
}
