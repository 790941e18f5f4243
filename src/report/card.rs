//! The card at the top of a report: the scene, the outcome of its impact, and the reliability of the law.

use super::contact::Contact;
use super::spread::Laws;
use super::ways::{Body, LEAP_FROG};
use super::{Figure, ReportError};
use crate::bodies;
use crate::documentation;
use crate::html::escape;
use crate::model::AnyModel;
use crate::numbers::{percent, quantity, significant};
use crate::plot::{NameAt, Picture, Series, View};
use crate::scene::Scene;
use crate::table;
use crate::validity;
use brinell_contact::impact::Prediction;
use brinell_contact::validity::LARGEST_RADIUS_RATIO;
use serde_json::{Value, json};

/// Number of steps in the time history of the force.
const STEPS: u32 = 400;

/// The card.
pub struct Card {
    /// Names and values of the three columns.
    pub scene: Vec<(&'static str, String)>,
    pub outcome: Vec<(&'static str, String)>,
    /// Sentences about the law.
    pub trust: Vec<String>,
    /// The exceeded limits of the law's validity.
    pub warnings: Vec<String>,
    pub figures: [Figure; 2],
    /// The outcome for programs.
    pub json: Value,
}

/// The card of `scene`, which has one contact. Its `contact` is stepped through the impact.
///
/// # Errors
/// [`ReportError::Import`] if the FMU rejects a step.
pub fn of(scene: &Scene, contact: &mut Contact, laws: &Laws) -> Result<Card, ReportError> {
    let prediction = &scene.predictions[0];
    let model = scene.any_model();
    let ratio = prediction.max_contact_radius / model.pair().radius;
    let warnings = validity::warnings(&model.pair(), scene.contacts[0].density, prediction, scene.impact.speed);
    let mut trust: Vec<String> = laws.verdict();
    if matches!(model, AnyModel::Elastoplastic(_)) {
        let relation = if ratio > LARGEST_RADIUS_RATIO { "above" } else { "within" };
        trust.push(format!(
            "Contact radius over effective radius: {}, {relation} the limit of {LARGEST_RADIUS_RATIO}.",
            significant(ratio, 2)
        ));
    }
    let outcome = outcome(scene, prediction);
    let json = json!({
        "largest_force_N": prediction.max_force,
        "largest_indentation_m": prediction.max_indentation,
        "dent_m": prediction.residual_indentation,
        "restitution": prediction.restitution,
        "contact_time_s": prediction.contact_time(),
        "contact_radius_over_effective_radius": ratio,
        "warnings": warnings,
    });
    Ok(Card {
        scene: facts(scene),
        outcome,
        trust,
        warnings,
        figures: [indentation(scene), time(scene, contact)?],
        json,
    })
}

/// The bodies.
fn facts(scene: &Scene) -> Vec<(&'static str, String)> {
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
fn outcome(scene: &Scene, prediction: &Prediction) -> Vec<(&'static str, String)> {
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

/// Force over indentation.
fn indentation(scene: &Scene) -> Figure {
    let view = View { name_at: NameAt::Top, ..View::default() };
    let svg = documentation::force_over_indentation(scene, &scene.predictions[0]).labelled(430, 300, &view);
    Figure { name: "force-over-indentation", caption: "Force over indentation".into(), svg, folded: false }
}

/// Force over time, as an importer with small steps computes it.
fn time(scene: &Scene, contact: &mut Contact) -> Result<Figure, ReportError> {
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
    let picture = Picture {
        x_title: "time [us]".into(),
        y_title: "force [N]".into(),
        logarithmic: (false, false),
        series: vec![Series { label: "force".into(), points, dots: false }],
    };
    let view = View { name_at: NameAt::Nowhere, ..View::default() };
    Ok(Figure {
        name: "force-over-time",
        caption: "Force over time".into(),
        svg: picture.labelled(430, 300, &view),
        folded: false,
    })
}

impl Card {
    /// The card as HTML.
    pub fn html(&self) -> String {
        let rows = |rows: &[(&str, String)]| {
            let row = |(name, value): &(&str, String)| {
                format!("<tr><th>{}</th><td>{}</td></tr>\n", escape(name), escape(value))
            };
            rows.iter().map(row).collect::<String>()
        };
        let sentences = |sentences: &[String]| {
            sentences.iter().map(|text| format!("<li>{}</li>\n", escape(text))).collect::<String>()
        };
        let warnings: Vec<_> =
            self.warnings.iter().map(|warning| format!("Outside the law's validity: {warning}.")).collect();
        let figures: String = self.figures.iter().map(Figure::html).collect();
        format!(
            "<section class=\"card\">\n<div><h2>Scene</h2>\n<table class=\"facts\">\n{}</table></div>\n\
             <div><h2>What happens</h2>\n<table class=\"facts outcome\">\n{}</table></div>\n\
             <div><h2>Can I trust the law?</h2>\n<ul>\n{}</ul>\n<ul class=\"warning\">\n{}</ul></div>\n\
             <div class=\"pictures\">\n{figures}</div>\n</section>\n",
            rows(&self.scene),
            rows(&self.outcome),
            sentences(&self.trust),
            sentences(&warnings)
        )
    }
}
