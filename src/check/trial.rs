//! The impact of a scene on one contact of its FMU, compared with the prediction.

use super::impact::{Row, STEPS_PER_CONTACT, Simulated, simulate, way_of};
use super::{oblique, together};
use crate::importer::{Archive, Description, ImportError, Unit};
use crate::master::Contact;
use brinell_contact::impact::Prediction;
use brinell_exporter::layout::table;
use brinell_exporter::numbers::{percent, quantity};
use brinell_exporter::scene::{Parameter, Scene};
use serde::Serialize;

/// The impact on one contact.
#[derive(Debug, Serialize)]
pub struct Trial {
    /// The name of the contact, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<String>,
    /// Number of contacts equal to this one, including itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// The reason why no impact was run.
    pub skipped: Option<String>,
    /// Step size [s].
    pub step: f64,
    pub rows: Vec<Row>,
    /// Contacts at rest whose force changed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub disturbed: Vec<String>,
}

impl Trial {
    /// The impact on the first contact of `group`; all others are at rest.
    pub fn run(archive: &Archive, unit: &Unit, scene: &Scene, group: usize) -> Result<Trial, ImportError> {
        let given = &scene.contacts[group];
        let prefix = given.prefix(0);
        let prediction = &scene.predictions[group];
        let step = prediction.contact_time() / f64::from(STEPS_PER_CONTACT);
        let name = given.name.is_some().then(|| prefix.trim_end_matches('.').to_string());
        let mut trial =
            Trial { contact: name, count: given.count, skipped: None, step, rows: Vec::new(), disturbed: Vec::new() };
        if let Some(masses) = scene.inverse_masses() {
            trial.rows = together::compare(archive, unit, scene, group, &together::entries(masses, scene))?;
            return Ok(trial);
        }
        // the impact begins at first contact; a gap that is a constant of the FMU has to be crossed
        let (settable, given_gap) = gap(scene, group);
        let gap = if settable.is_some() { 0.0 } else { given_gap };
        let start: Vec<_> = settable.iter().map(|name| (name.as_str(), gap)).collect();
        let mut contact = Contact::new(archive, unit, &prefix, &[])?;
        contact.start(&start)?;
        if gap < 0.0 {
            trial.skipped = Some("the scene starts pressed in, and initial_gap is a constant of it".into());
            return Ok(trial);
        }
        let at_rest = others_at_rest(scene, group, &archive.description)?;
        let before = forces(&mut contact, &at_rest)?;
        // the force of a line ends nearly straight
        let power = if scene.is_line() { 1.0 } else { 1.5 };
        let simulated = simulate(&mut contact, way_of(scene), &scene.impact_of(group), (gap, power), step)?;
        trial.rows = compare(prediction, &simulated);
        if scene.follows_rate() {
            // the force ends before the bodies reach the dent, or there is none
            trial.rows.retain(|row| row.quantity != "dent");
        }
        if scene.laws.loss().is_some_and(|loss| !loss.follows_rate()) {
            // the bodies move farther than the indentation, by the distance that the plate gives way
            trial.rows.retain(|row| !["largest indentation", "dent"].contains(&row.quantity.as_ref()));
        }
        let after = forces(&mut contact, &at_rest)?;
        let changed = at_rest.into_iter().zip(before.iter().zip(&after)).filter(|(_, (before, after))| before != after);
        trial.disturbed = changed.map(|((name, _), _)| name).collect();
        contact.instance.call("fmi2Terminate")?;
        if scene.has_friction() {
            contact.start(&start)?;
            trial.rows.extend(oblique::compare(&mut contact, scene, group, (gap, step))?);
        }
        Ok(trial)
    }
}

/// Name of the initial gap of the contacts of `group`, if it can be set, and its value [m].
fn gap(scene: &Scene, group: usize) -> (Option<String>, f64) {
    let given = &scene.contacts[group];
    let is_gap = |parameter: &&Parameter| parameter.name == "initial_gap";
    let name = match given.own.iter().find(is_gap) {
        Some(own) => own.settable.then(|| given.own_variable(own, 0)),
        None => scene.settable().find(is_gap).map(|shared| shared.name.to_string()),
    };
    (name, scene.group_value(group, "initial_gap").unwrap_or(0.0))
}

/// Names and value references of the forces of all contacts except the first of `group`.
fn others_at_rest(scene: &Scene, group: usize, description: &Description) -> Result<Vec<(String, u32)>, ImportError> {
    let mut forces = Vec::new();
    for (place, other) in scene.contacts.iter().enumerate() {
        for index in usize::from(place == group)..other.size() {
            let name = format!("{}force", other.prefix(index));
            let reference = description.real(&name)?;
            forces.push((name, reference));
        }
    }
    Ok(forces)
}

/// The forces of these contacts, as bits.
fn forces(contact: &mut Contact, contacts: &[(String, u32)]) -> Result<Vec<u64>, ImportError> {
    contacts.iter().map(|(_, reference)| Ok(contact.instance.real(*reference)?.to_bits())).collect()
}

fn compare(predicted: &Prediction, simulated: &Simulated) -> Vec<Row> {
    let Prediction { max_indentation, max_force, residual_indentation, restitution, .. } = *predicted;
    let contact_time = predicted.contact_time();
    vec![
        Row::new("largest force", "N", max_force, simulated.max_force, max_force),
        Row::new("largest indentation", "m", max_indentation, simulated.max_indentation, max_indentation),
        // a dent may be zero, so its error is relative to the largest indentation
        Row::new("dent", "m", residual_indentation, simulated.residual_indentation, max_indentation),
        Row::new("restitution", "", restitution, simulated.restitution, restitution),
        Row::new("contact time", "s", contact_time, simulated.contact_time, contact_time),
    ]
}

impl std::fmt::Display for Trial {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = match (&self.contact, self.count) {
            (None, _) => String::new(),
            (Some(name), None) => name.clone(),
            (Some(name), Some(count)) => format!("{name}, one of {count}"),
        };
        if let Some(reason) = &self.skipped {
            let separator = if name.is_empty() { "" } else { ": " };
            return writeln!(f, "  {name}{separator}no impact was run: {reason}");
        }
        let mut rows = vec![vec![name, "predicted".into(), "simulated".into(), "difference".into()]];
        for Row { quantity: name, unit, predicted, simulated, difference } in &self.rows {
            rows.push(vec![
                name.to_string(),
                quantity(*predicted, unit),
                quantity(*simulated, unit),
                percent(*difference),
            ]);
        }
        write!(f, "\n{}", table(&rows, 1, 2))?;
        let line = |other: &str| format!("{other} has changed although its contact was at rest");
        write_some(f, &self.disturbed, line)
    }
}

/// Writes a line for each of the first `items`, and the number of the others: an FMU may have a hundred thousand contacts.
pub fn write_some(
    f: &mut std::fmt::Formatter<'_>,
    items: &[String],
    line: impl Fn(&str) -> String,
) -> std::fmt::Result {
    const SHOWN: usize = 20;
    for item in items.iter().take(SHOWN) {
        writeln!(f, "  {}", line(item))?;
    }
    if items.len() > SHOWN {
        writeln!(f, "  and {} more (--json lists all)", items.len() - SHOWN)?;
    }
    Ok(())
}
