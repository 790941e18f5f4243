//! The laws of a scene as types.

use super::MEMORY;
use crate::scene::{Loss, Scene, SceneLaws};
use std::fmt::Debug;

/// The laws, as a type of `brinell_fmu::scene::library::kinds`.
pub fn of(scene: &Scene) -> String {
    let loading = match scene.laws {
        SceneLaws::Damped(..) => "contact::loading::Elastic".into(),
        // the form for two bodies
        _ if scene.is_paired() && !scene.is_line() => "contact::loading::Paired".into(),
        laws => type_of("loading", &laws.loading().1),
    };
    // an elastic contact never unloads by another law; the compiler leaves out whatever is here
    let unloading = type_of("unloading", &scene.laws.plain_unloading());
    let laws = format!("{loading}, {unloading}");
    let loss = match scene.laws.loss() {
        _ if scene.is_damped() => Some("contact::losses::Damper"),
        Some(Loss::Fitted(_)) => Some("contact::losses::RestitutionFitted"),
        Some(Loss::Waves) => Some("contact::losses::HalfSpaceRadiation"),
        Some(Loss::Plate(_)) => Some("contact::losses::Plate"),
        None => None,
    };
    match loss {
        _ if scene.has_friction() => frictional(scene, &laws, loss),
        _ => {
            let plain = loss.map_or(format!("kinds::Plastic<{laws}>"), |loss| format!("kinds::Lossy<{laws}, {loss}>"));
            if scene.finds_strength() { format!("kinds::Rated<{plain}>") } else { plain }
        }
    }
}

/// Laws with friction. The mean tangential force is computed only if an output needs it.
fn frictional(scene: &Scene, laws: &str, loss: Option<&str>) -> String {
    let needs_mean = ["mean_tangential_force", "tangential_impulse", "friction_work"];
    let mean = scene.outputs.iter().any(|output| needs_mean.contains(&output.as_str()));
    let contact = if scene.directions > 1 { "PlaneContact" } else { "FrictionalContact" };
    let normal = loss.map_or(String::new(), |loss| format!(", contact::losses::History<{loss}>"));
    let loss = loss.unwrap_or("()");
    format!("kinds::Frictional<contact::tangential::{contact}<{MEMORY}, {mean}{normal}>, {laws}, {loss}>")
}

/// The type of a law in a `module`: the variant of the enum that holds it.
fn type_of(module: &str, law: &impl Debug) -> String {
    let text = format!("{law:?}");
    let (variant, _) = text.split_once('(').expect("a variant of an enum holds the law");
    match variant.strip_prefix("Guarded") {
        Some(bare) => format!("contact::{module}::Guarded<contact::{module}::{bare}>"),
        None => format!("contact::{module}::{variant}"),
    }
}
