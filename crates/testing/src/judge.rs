//! Invariants for the values of every FMU after any calls.

use crate::face::Face;
use std::collections::HashMap;

/// The observations of an instance after its last call.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The dissipated energy of each contact \[J\], by the prefix of its variables.
    dissipated: HashMap<String, f64>,
}

/// Relative error from rounding in an energy balance, and between a step and its parts.
const TOLERANCE: f64 = 1e-12;

/// The prefixes of the contacts' variables.
fn contacts(face: &Face) -> impl Iterator<Item = &str> {
    face.named
        .keys()
        .filter_map(|name| name.strip_suffix("force"))
        .filter(|prefix| prefix.is_empty() || prefix.ends_with('.'))
}

/// Checks the values of all Real outputs, in the order of `face.outputs`; `before` are the values before the step.
///
/// # Errors
/// A description of the violation.
pub fn check_values(face: &Face, values: &[f64], before: &Seen) -> Result<Seen, String> {
    let by_reference: HashMap<u32, f64> = face.outputs.iter().copied().zip(values.iter().copied()).collect();
    for (name, reference) in &face.named {
        let value = by_reference[reference];
        if !value.is_finite() {
            return Err(format!("{name} is {value}"));
        }
        let (minimum, maximum) = face.limits[reference];
        if !(minimum <= value && value <= maximum) {
            return Err(format!("{name} is {value:e}, but declared as {minimum:e} to {maximum:e}"));
        }
    }
    let mut seen = Seen::default();
    for prefix in contacts(face) {
        let value = |name: &str| face.named.get(&format!("{prefix}{name}")).map(|reference| by_reference[reference]);
        let force = value("force").expect("every contact has a force");
        if force < 0.0 {
            return Err(format!("{prefix}force is {force:e} N"));
        }
        // the dent of some laws is above the original surface, which is zero
        let dent = value("residual_indentation").unwrap_or(0.0);
        if let Some(indentation) = value("indentation")
            && indentation < dent
            && force != 0.0
        {
            return Err(format!(
                "{prefix}force is {force:e} N at an indentation of {indentation:e} m, with a dent of {dent:e} m"
            ));
        }
        let components = ["tangential_force", "tangential_force[1]", "tangential_force[2]"].map(value);
        let pull = components.into_iter().flatten().reduce(f64::hypot);
        if let Some(pull) = pull
            && pull.abs() > ROUGHEST * force * (1.0 + 1e-9)
        {
            return Err(format!("{prefix}tangential_force is {pull:e} N at a force of {force:e} N"));
        }
        let energies = (value("work"), value("elastic_energy"), value("dissipated_energy"));
        if let (Some(work), Some(elastic), Some(dissipated)) = energies {
            let scale = work.abs().max(elastic.abs()).max(dissipated.abs());
            let rest = work - elastic - dissipated;
            if rest.abs() > TOLERANCE * scale {
                return Err(format!("{prefix}work {work:e} J isn't {elastic:e} J + {dissipated:e} J"));
            }
            if face.passive
                && let Some(earlier) = before.dissipated.get(prefix)
                && dissipated < earlier - TOLERANCE * scale
            {
                return Err(format!("{prefix}dissipated_energy falls from {earlier:e} J to {dissipated:e} J"));
            }
            seen.dissipated.insert(prefix.to_string(), dissipated);
        }
    }
    Ok(seen)
}

/// The largest coefficient of friction.
const ROUGHEST: f64 = 10.0;

/// Outputs that belong to the last step and not to its end.
const OF_THE_STEP: [&str; 5] =
    ["mean_force", "impulse", "predicted_force", "mean_tangential_force", "predicted_tangential_force"];

/// Outputs that depend on the division into steps while a dent grows.
const OF_FRICTION: [&str; 4] = ["tangential_force", "tangential_energy", "friction_work", "stick_radius"];

/// Checks that a step and its parts end at the same values.
///
/// # Errors
/// The first variable that differs.
pub fn same_values(face: &Face, whole: &[f64], pieces: &[f64]) -> Result<(), String> {
    for (name, reference) in &face.named {
        let name = name.trim_end_matches(['[', ']', '1', '2']);
        if OF_THE_STEP.iter().any(|other| name.ends_with(other)) {
            continue;
        }
        if face.yields && OF_FRICTION.iter().any(|other| name.ends_with(other)) {
            continue;
        }
        let place = face.outputs.iter().position(|other| other == reference).expect("it is an output");
        let (one, other) = (whole[place], pieces[place]);
        // they jump at a change of branch, which rounding can move
        let jumps = name.ends_with("stiffness") || name.ends_with("_number");
        if !jumps && (one - other).abs() > 1e-9 * one.abs().max(other.abs()) && (one - other).abs() > 1e-15 {
            return Err(format!("{name} is {one:e} after a step, and {other:e} after its parts"));
        }
    }
    Ok(())
}
