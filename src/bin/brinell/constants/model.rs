//! The model of a contact, as an expression.

use super::{File, groups};
use crate::scene::Scene;

/// Number of segments in which the springs of a contact with friction remember its past.
pub const MEMORY: usize = 12;

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
    let (group, values) = match scene.is_strengthened() || scene.friction {
        true => ("group", "values"),
        false => (group, "_values"),
    };
    let model = model_of(
        scene,
        "Self::parameter(Parameter::TargetHardeningModulus, group, values)",
        &format!("surface: {surface}"),
    );
    let model = match scene.friction {
        true => with_friction(&model),
        false => model,
    };
    file.add_method(&format!("model(pair: Pair, {group}: usize, {values}: &Self::Values) -> Self::Model"), &model);
}

/// The expression of a model with friction, from that of its normal part.
fn with_friction(normal: &str) -> String {
    let normal = match normal.rsplit_once("contact::Model") {
        Some((before, model)) => format!("{before}let normal = contact::Model{model};"),
        None => normal.to_string(),
    };
    format!("{normal}\nwith_friction(normal, |which| Self::parameter(which, group, values))")
}
