//! The card at the top of a report: the scene, the outcome of its impact, and two pictures of it.

use super::runs::Figure;
use brinell_contact::impact::Prediction;
use brinell_exporter::numbers::{cell, percent, quantity, significant, with_band};
use brinell_exporter::plot::{Picture, Series, View};
use brinell_exporter::predict::spread;
use brinell_exporter::predict::time_history::moments;
use brinell_exporter::scene::{Body, Scene};
use brinell_exporter::{bodies, documentation, table};

/// A name and its value.
pub type Fact = (&'static str, String);

/// The bodies and the impact.
pub fn facts(scene: &Scene) -> Vec<Fact> {
    let (impactor, target) = bodies::words(scene, 0);
    let unloading = scene.laws.unloading().map(|(name, _)| format!(", unloading by {name}"));
    let law = format!("{}{}", scene.laws.name(), unloading.unwrap_or_default());
    let mut facts = vec![
        ("Contact", format!("{impactor} on {target}")),
        ("Effective mass", quantity(scene.impact.mass, "kg")),
        ("Closing speed", quantity(scene.impact.speed, "m/s")),
        ("Law", law),
    ];
    facts.extend(Body::ALL.into_iter().filter_map(|body| {
        let measured = scene.measured(0, body)?;
        let name = match body {
            Body::Impactor => "Impactor's strength from",
            Body::Target => "Target's strength from",
        };
        let given = measured.given.trim_end_matches(',');
        Some((name, format!("{given} \u{b1} {} %", cell(100.0 * measured.uncertainty, 1.0))))
    }));
    let shown = |name: &str| !matches!(name, "initial_gap" | "effective_mass");
    facts.extend(bodies::numbers(scene, 0).into_iter().filter(|(name, ..)| shown(name)).map(|(name, value, unit)| {
        (name, if unit.is_empty() { significant(value, 4) } else { quantity(value, unit) })
    }));
    facts
}

/// What was made of a hardness or a tensile test, in sentences.
pub fn readings(scene: &Scene) -> Vec<String> {
    let found = scene.in_impact(0, &scene.impact);
    let words = |body| scene.measured_words(0, body, found.as_ref()?);
    Body::ALL.into_iter().filter_map(words).collect()
}

/// The outcome of the impact.
pub fn outcome(scene: &Scene, prediction: &Prediction) -> Vec<Fact> {
    let bands = spread::of_impact(scene, &scene.impact, None).map(|(_, bands)| bands);
    let spread = |name: &str, value: f64, unit| with_band(value, bands.as_ref().and_then(|it| it.get(name)), unit);
    let mut outcome = vec![
        ("Coefficient of restitution", spread("restitution", prediction.restitution, "")),
        ("Largest force", spread("largest force", prediction.max_force, "N")),
        ("Largest indentation", spread("largest indentation", prediction.max_indentation, "m")),
    ];
    if !scene.is_damped() {
        outcome.push(("Dent left behind", spread("dent", prediction.residual_indentation, "m")));
    }
    outcome.push(("Contact time", quantity(prediction.contact_time(), "s")));
    outcome.push(("Energy lost", percent(1.0 - prediction.rebound_energy / prediction.energy).replace('+', "")));
    if !scene.is_damped() {
        let items = &table::variable("regime").items;
        let regime = items.get(prediction.regime as usize).map_or("", |item| item.name.as_str());
        outcome.push(("Regime at the largest load", regime.replace('_', " ")));
    }
    outcome
}

/// Force over indentation, and over time.
pub fn figures(scene: &Scene) -> Vec<Figure> {
    let over_indentation = documentation::force_over_indentation(scene, &scene.predictions[0]);
    let moments = moments(&scene.any_model(), &scene.impact).unwrap_or_default();
    let points = moments.iter().map(|moment| (1e6 * moment.time, moment.force));
    let over_time = Picture::new(("time [\u{b5}s]", "force [N]"), (false, false), vec![Series::line("force", points)]);
    let view = View::default();
    vec![
        Figure::new("force-over-indentation", "Force over indentation", &over_indentation, &view),
        Figure::new("force-over-time", "Force over time", &over_time, &view),
    ]
}
