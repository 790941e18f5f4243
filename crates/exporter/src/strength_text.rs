//! What the page in an FMU says about a strength that depends on the impact.

use crate::html::prose;
use crate::numbers::{cell, quantity};
use crate::scene::{Rate, Scene};
use std::fmt::Write;

/// Writes the section about the strain rate of `scene`, if its strength depends on that.
pub fn section(page: &mut String, scene: &Scene) -> std::fmt::Result {
    let Some(rate) = scene.rate(0) else { return Ok(()) };
    let model = match rate {
        Rate::JohnsonCook { c, reference_rate } => {
            format!("1 + {c} ln(rate/({reference_rate} 1/s)), and 1 below that rate (Johnson and Cook 1983)")
        }
        Rate::CowperSymonds { d, q } => format!("1 + (rate/({d} 1/s))^(1/{q}) (Cowper and Symonds 1957)"),
    };
    let Some(found) = scene.in_impact(0, &scene.impact_of(0)) else { return Ok(()) };
    let (body, radius) = (scene.softer(0).name(), quantity(found.indenter_radius, "m"));
    let found = cell(found.factor, 1.0);
    let what = format!(
        "The strength of the {body} is its strength under a slow load times {model}. The rate is the mean strain rate of the \
         loading: 0.2 a/R at the largest contact radius a, over the time from first contact to that radius. R is {radius}, the \
         radius of the rigid sphere that would press the {body} in the same way. In the impact of the scene the factor is \
         {found}."
    );
    writeln!(page, "<h3>Strain rate</h3>\n<p>{}</p>\n<p>{}</p>", prose(&what), prose(use_of(scene)))
}

/// What the FMU does with the strength.
fn use_of(scene: &Scene) -> &'static str {
    match scene.finds_strength() {
        true => {
            "The parameters are the strength under a slow load. At the first touch of each impact, the FMU finds the strength \
             from the closing speed and the mass, for a free impact. It keeps this strength until the bodies part. A dent that \
             is met again keeps the strength that made it. A contact that starts indented has the strength under a slow load."
        }
        false if scene.loss.is_some() && scene.coupling.is_some() => {
            "The parameters, and every contact, have the strength of the scene's impact: with a loss below yield, the FMU \
             does not find a strength for each impact."
        }
        false => {
            "The parameters, and every contact, have the strength of the scene's impact: an FMU that doesn't know the mass \
             can't find another one."
        }
    }
}
