//! The impact of a scene on one contact of its FMU, compared with the prediction.

use super::master::{Master, STEPS_PER_CONTACT, Simulated};
use super::oblique;
use super::row::Row;
use crate::importer::{Description, ImportError, Instance};
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
    pub fn run(
        instance: &mut Instance,
        description: &Description,
        scene: &Scene,
        group: usize,
    ) -> Result<Trial, ImportError> {
        let given = &scene.contacts[group];
        let prefix = given.prefix(0);
        let prediction = &scene.predictions[group];
        let step = prediction.contact_time() / f64::from(STEPS_PER_CONTACT);
        let contact = given.name.is_some().then(|| prefix.trim_end_matches('.').to_string());
        let mut trial =
            Trial { contact, count: given.count, skipped: None, step, rows: Vec::new(), disturbed: Vec::new() };
        let gap = begin(instance, description, scene, group)?;
        if gap < 0.0 {
            trial.skipped = Some("the scene starts pressed in, and initial_gap is a constant of it".into());
            return Ok(trial);
        }
        let rate = description.real(&format!("{prefix}indentation_rate"))?;
        let force = description.real(&format!("{prefix}force"))?;
        let at_rest = others_at_rest(scene, group, description)?;
        let before = forces(instance, &at_rest)?;
        let follows = scene.follows_rate();
        let mean_force = format!("{prefix}mean_force");
        let mean_force = if scene.coupling.is_some() { Some(description.real(&mean_force)?) } else { None };
        let parallel = scene.coupling.is_some_and(|coupling| coupling.parallel);
        let mut master = Master {
            instance: &mut *instance,
            rate,
            force,
            time: 0.0,
            follows: follows && scene.coupling.is_none(),
            mean_force,
            parallel,
        };
        let simulated = master.impact(&scene.impact_of(group), gap, step)?;
        trial.rows = compare(prediction, &simulated);
        if follows {
            // no dent remains, and the end of the force has no meaning
            trial.rows.retain(|row| row.quantity != "dent");
        }
        if scene.loss.is_some_and(|loss| !loss.follows_rate()) {
            // the bodies move farther than the indentation, by the distance that the plate gives way
            trial.rows.retain(|row| !["largest indentation", "dent", "contact time"].contains(&row.quantity));
        }
        let after = forces(instance, &at_rest)?;
        let changed = at_rest.into_iter().zip(before.iter().zip(&after)).filter(|(_, (before, after))| before != after);
        trial.disturbed = changed.map(|((name, _), _)| name).collect();
        instance.call("fmi2Terminate")?;
        if scene.has_friction() {
            instance.call("fmi2Reset")?;
            let gap = begin(instance, description, scene, group)?;
            trial.rows.extend(oblique::compare(instance, description, scene, group, (gap, step))?);
        }
        Ok(trial)
    }
}

/// Initializes the FMU for an impact on the first contact of `group`, and returns its gap [m]. The impact begins at first
/// contact; a gap that is a constant of the FMU has to be crossed.
fn begin(instance: &mut Instance, description: &Description, scene: &Scene, group: usize) -> Result<f64, ImportError> {
    instance.setup_experiment(0.0)?;
    instance.call("fmi2EnterInitializationMode")?;
    let (gap_variable, mut gap) = gap(scene, group);
    if let Some(name) = gap_variable {
        instance.set_real(description.real(&name)?, 0.0)?;
        gap = 0.0;
    }
    instance.call("fmi2ExitInitializationMode")?;
    Ok(gap)
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
        for index in usize::from(place == group)..other.count() {
            let name = format!("{}force", other.prefix(index));
            let reference = description.real(&name)?;
            forces.push((name, reference));
        }
    }
    Ok(forces)
}

/// The forces of these contacts, as bits.
fn forces(instance: &mut Instance, contacts: &[(String, u32)]) -> Result<Vec<u64>, ImportError> {
    contacts.iter().map(|(_, reference)| Ok(instance.real(*reference)?.to_bits())).collect()
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
                (*name).into(),
                quantity(*predicted, unit),
                quantity(*simulated, unit),
                percent(*difference),
            ]);
        }
        write!(f, "\n{}", table(&rows, 1, 2))?;
        let line = |other: &str| format!("{other} has changed although its contact was at rest");
        super::write_some(f, &self.disturbed, line)
    }
}
