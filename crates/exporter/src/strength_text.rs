//! What the page in an FMU says about a strength that depends on the impact.

use crate::html::prose;
use crate::measured::MeasuredStrength;
use crate::numbers::{cell, quantity};
use crate::plot::{Picture, Series};
use crate::scene::{Body, InImpact, Rate, Scene};
use std::fmt::Write;

/// Writes the sections about the strengths that follow from a reading or a tensile test, and about the strain rate of `scene`, if its
/// strength depends on that.
pub fn section(page: &mut String, scene: &Scene) -> std::fmt::Result {
    readings(page, scene)?;
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

/// What was made of a hardness, a tensile strength, a tensile test or a material of the first contact, with a picture of a test.
fn readings(page: &mut String, scene: &Scene) -> std::fmt::Result {
    let has_words = Body::ALL.iter().any(|body| scene.measured(0, *body).is_some());
    let Some(found) = has_words.then(|| scene.in_impact(0, &scene.impact_of(0))).flatten() else { return Ok(()) };
    writeln!(page, "<h3>Strength</h3>")?;
    for body in Body::ALL {
        let Some(words) = scene.measured_words(0, body, &found) else { continue };
        writeln!(page, "<p>{}</p>", prose(&words))?;
        if let Some(picture) =
            scene.measured(0, body).and_then(|measured| test(measured, scene.softer(0) == body, &found))
        {
            writeln!(page, "<figure>\n{}</figure>", picture.svg(560, 340))?;
        }
    }
    Ok(())
}

/// The points of a tensile test, the power law through them, and what the impact takes of it if this is the softer body.
fn test(measured: &MeasuredStrength, is_softer: bool, found: &InImpact) -> Option<Picture> {
    const POINTS: u32 = 100;
    let test = measured.tension.as_ref()?;
    let strain = found.strains.softer;
    let most = test.range.1.max(if is_softer { 1.5 * strain } else { 0.0 });
    let megapascals = |point: &(f64, f64)| (point.0, 1e-6 * point.1);
    let points = test.points.iter().filter(|point| point.0 <= 1.2 * most).map(megapascals).collect();
    // denser where the law is steep
    let along = |to: f64| (0..=POINTS).map(move |step| to * (f64::from(step) / f64::from(POINTS)).powi(3));
    let law = along(most).map(|strain| (strain, 1e-6 * measured.at(strain)));
    let mut series = vec![Series { label: "test".into(), points, dots: true }, Series::line("power law", law)];
    if is_softer {
        let line = measured.hardening(strain);
        let approximation = along(strain).map(|at| (at, 1e-6 * (line.yield_strength + line.hardening_modulus * at)));
        series.push(Series::line("taken", approximation));
    }
    Some(Picture::new(("plastic strain", "true stress [MPa]"), (false, false), series))
}

/// What the FMU does with the strength.
fn use_of(scene: &Scene) -> &'static str {
    match scene.finds_strength() {
        true => {
            "The parameters are the strength under a slow load. At the first touch of each impact, the FMU finds the strength \
             from the closing speed and the mass, for a free impact. It keeps this strength until the bodies part. A dent that \
             is met again keeps the strength that made it. A contact that starts indented has the strength under a slow load."
        }
        false => {
            "The parameters, and every contact, have the strength of the scene's impact: an FMU that doesn't know the mass \
             can't find another one."
        }
    }
}
