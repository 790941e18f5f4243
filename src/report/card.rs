//! The card at the top of a report: the scene, the outcome of its impact, and two pictures of it.

use super::contact::Contact;
use super::ways::{Body, LEAP_FROG};
use super::{Figure, ReportError};
use brinell_contact::impact::Prediction;
use brinell_exporter::numbers::{percent, quantity, significant};
use brinell_exporter::plot::{Picture, Series, View};
use brinell_exporter::scene::Scene;
use brinell_exporter::{bodies, documentation, table};

/// Number of steps in the time history of the force.
const STEPS: u32 = 400;

/// A name and its value.
pub type Fact = (&'static str, String);

/// The bodies and the impact.
pub fn facts(scene: &Scene) -> Vec<Fact> {
    let (impactor, target) = bodies::words(scene, 0);
    let law = match (scene.damped, scene.unloading) {
        (Some((name, _)), _) => name.to_string(),
        (None, Some((unloading, _))) => format!("{}, unloading by {unloading}", scene.loading.0),
        (None, None) => scene.loading.0.to_string(),
    };
    let mut facts = vec![
        ("Contact", format!("{impactor} on {target}")),
        ("Effective mass", quantity(scene.impact.mass, "kg")),
        ("Closing speed", quantity(scene.impact.speed, "m/s")),
        ("Law", law),
    ];
    let shown = |name: &str| !matches!(name, "initial_gap" | "effective_mass");
    facts.extend(bodies::numbers(scene, 0).into_iter().filter(|(name, ..)| shown(name)).map(|(name, value, unit)| {
        (name, if unit.is_empty() { significant(value, 4) } else { quantity(value, unit) })
    }));
    facts
}

/// The outcome of the impact.
pub fn outcome(scene: &Scene, prediction: &Prediction) -> Vec<Fact> {
    let mut outcome = vec![
        ("Coefficient of restitution", significant(prediction.restitution, 4)),
        ("Largest force", quantity(prediction.max_force, "N")),
        ("Largest indentation", quantity(prediction.max_indentation, "m")),
    ];
    if scene.damped.is_none() {
        outcome.push(("Dent left behind", quantity(prediction.residual_indentation, "m")));
    }
    outcome.push(("Contact time", quantity(prediction.contact_time(), "s")));
    outcome.push(("Energy lost", percent(1.0 - prediction.rebound_energy / prediction.energy).replace('+', "")));
    if scene.damped.is_none() {
        let items = &table::variable("regime").items;
        let regime = items.get(prediction.regime as usize).map_or("", |item| item.name.as_str());
        outcome.push(("Regime at the largest load", regime.replace('_', " ")));
    }
    outcome
}

/// Force over indentation, and over time as an importer with small steps computes it.
///
/// # Errors
/// [`ReportError::Import`] if the FMU rejects a step.
pub fn figures(scene: &Scene, contact: &mut Contact) -> Result<Vec<Figure>, ReportError> {
    let prediction = &scene.predictions[0];
    let step = prediction.contact_time() / f64::from(STEPS);
    contact.start_apart(0.0, step)?;
    let mut body = Body::flying(scene.impact.mass, scene.impact.speed);
    let mut points = vec![(0.0, 0.0)];
    // a force that follows the rate may end after the bodies have separated
    for index in 1..=2 * STEPS {
        (LEAP_FROG.advance)(contact, &mut body, step)?;
        points.push((1e6 * step * f64::from(index), body.force));
        if body.force <= 0.0 && body.speed <= 0.0 {
            break;
        }
    }
    let over_time = Picture {
        x_title: "time [us]".into(),
        y_title: "force [N]".into(),
        logarithmic: (false, false),
        series: vec![Series { label: "force".into(), points, dots: false }],
    };
    let over_indentation = documentation::force_over_indentation(scene, prediction);
    let view = View::default();
    Ok(vec![
        Figure::new("force-over-indentation", "Force over indentation", &over_indentation, &view, false),
        Figure::new("force-over-time", "Force over time", &over_time, &view, false),
    ])
}
