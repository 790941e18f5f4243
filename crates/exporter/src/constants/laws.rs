//! The laws of a scene with their constants, and what is added to them.

use super::{MEMORY, literal};
use crate::scene::{Loss, Rate, Scene};
use std::fmt::Debug;

/// The laws, as the entry `laws`.
pub fn of(scene: &Scene) -> String {
    if let Some((_, law)) = &scene.damped {
        return format!("damped {{ {} }}", value_of(law));
    }
    let kind = match scene.loss {
        _ if scene.has_friction() => friction(scene),
        Some(Loss::Fitted(_)) => "(loss Fitted)".into(),
        Some(Loss::Waves) => "(loss Waves)".into(),
        Some(Loss::Plate(_)) => "(loss Plate)".into(),
        None if scene.finds_strength() => rate(scene),
        None => "plain".into(),
    };
    let unloading = scene.plain_unloading();
    // the form for two bodies
    let of_loading = if scene.is_paired() { "paired" } else { "plain" };
    // an elastic contact never unloads by another law; the compiler leaves out whatever is here
    let unloading = scene.unloading.map_or("ContactRadius {}".into(), |_| value_of(&unloading));
    let (of_unloading, unloading) = match unloading.strip_prefix("Guarded(") {
        Some(guarded) => ("guarded", guarded.replace(')', "")),
        None => ("plain", unloading),
    };
    let loading = value_of(&scene.loading.1);
    format!("{kind} {{\n        {of_loading} {loading},\n        {of_unloading} {unloading}\n    }}")
}

/// The type of a contact with friction. The mean tangential force is computed only if an output needs it.
fn friction(scene: &Scene) -> String {
    let needs_mean = ["mean_tangential_force", "tangential_impulse", "friction_work"];
    let mean = scene.outputs.iter().any(|output| needs_mean.contains(&output.as_str()));
    let loss = match scene.loss {
        Some(Loss::Fitted(_)) => " Fitted",
        Some(Loss::Waves) => " Waves",
        Some(Loss::Plate(_)) => " Plate",
        None => "",
    };
    match scene.directions {
        2 => format!("(friction PlaneContact {MEMORY} {mean}{loss})"),
        _ => format!("(friction RoughContact {MEMORY} {mean}{loss})"),
    }
}

/// The models of the strain rate: of the target, and of the impactor if it may yield.
fn rate(scene: &Scene) -> String {
    let of = |rate: Option<Rate>| match rate.unwrap_or(Rate::NONE) {
        Rate::JohnsonCook { c, reference_rate } => {
            format!("JohnsonCook {{ c: {}, reference_rate: {} }}", literal(c), literal(reference_rate))
        }
        Rate::CowperSymonds { d, q } => format!("CowperSymonds {{ d: {}, q: {} }}", literal(d), literal(q)),
    };
    match scene.has_two_strengths() {
        true => format!("(rate {} {})", of(scene.rates.target), of(scene.rates.impactor)),
        false => format!("(rate {})", of(scene.rates.target)),
    }
}

/// The Rust expression of a law: the Debug form of the enum that holds it, without the enum, and with braces.
fn value_of(law: &impl Debug) -> String {
    let text = format!("{law:?}");
    let (_, inner) = text.split_once('(').expect("a variant of an enum holds the law");
    let inner = inner.strip_suffix(')').unwrap_or(inner);
    if inner.contains('{') { inner.into() } else { format!("{inner} {{}}") }
}
