//! `brinell check`: loads an FMU like any importer and runs the impact of its scene.

mod apart;
mod bounded_output;
mod error;
mod impact;
mod oblique;
mod together;
mod trial;

use crate::importer::{Archive, Description, ImportError, Instance};
use apart::Found;
use brinell_exporter::layout::{harmless, json_line, paragraph, shown, without_middle};
use brinell_exporter::numbers::quantity;
use brinell_exporter::scene::Scene;
use error::CheckError;
use impact::STEPS_PER_CONTACT;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Duration;
use trial::{Trial, write_some};

/// Largest allowed relative difference between prediction and simulation.
const TOLERANCE: f64 = 1e-3;

/// The default time limit of a check [s]. A check of 100,000 contacts takes a tenth of it.
const TIME_LIMIT: u64 = 600;

/// What to check.
#[derive(clap::Args)]
pub struct Arguments {
    /// The FMU
    fmu: PathBuf,
    /// How long the FMU may take [s]
    #[arg(long, value_name = "SECONDS", default_value_t = TIME_LIMIT, value_parser = clap::value_parser!(u64).range(1..))]
    time_limit: u64,
    /// Check in this process, and write what is found to this file
    #[arg(long, hide = true)]
    found: Option<PathBuf>,
}

/// The command: checks an FMU and prints the result. Returns whether it passed.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<bool, CheckError> {
    let Some(file) = &arguments.found else {
        return in_own_process(&arguments.fmu, as_json, Duration::from_secs(arguments.time_limit));
    };
    let found = match check(&arguments.fmu) {
        Ok(outcome) => Found::Outcome { text: outcome.text(as_json), passed: outcome.passed },
        Err(error) => Found::Error(error.to_string()),
    };
    found.write(file)?;
    Ok(true)
}

/// Checks the FMU that was just exported to `path`.
pub fn exported(path: &Path, as_json: bool) -> Result<bool, CheckError> {
    in_own_process(path, as_json, Duration::from_secs(TIME_LIMIT))
}

fn in_own_process(path: &Path, as_json: bool, limit: Duration) -> Result<bool, CheckError> {
    match apart::check(path, as_json, limit)? {
        Found::Outcome { text, passed } => {
            print!("{text}");
            Ok(passed)
        }
        Found::Error(said) => Err(CheckError::Said(said)),
    }
}

/// The result of a check.
#[derive(Debug, Serialize)]
pub struct Outcome {
    #[serde(serialize_with = "crate::files::path_in_json")]
    pub fmu: PathBuf,
    pub platforms: Vec<String>,
    pub variables: usize,
    pub impact: ImpactNumbers,
    pub impact_is_assumed: bool,
    /// What is assumed then.
    #[serde(skip)]
    assumption: &'static str,
    /// The method of the prediction.
    pub prediction: &'static str,
    pub steps_per_contact: u32,
    /// Whether all contacts move together.
    #[serde(skip)]
    moves_together: bool,
    /// For an FMU with plain variable names.
    #[serde(flatten)]
    pub plain: Option<Trial>,
    /// For an FMU with named contacts: the first contact of each group.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<Trial>,
    /// Start values that differ between the model description and the binary.
    pub wrong_starts: Vec<String>,
    pub passed: bool,
}

/// The impact that was run.
#[derive(Debug, Serialize)]
pub struct ImpactNumbers {
    /// Mass [kg].
    pub mass: f64,
    /// Closing speed [m/s].
    pub speed: f64,
}

/// Loads the FMU at `path` and runs the impact of its scene.
///
/// # Errors
/// [`CheckError`] if it cannot be loaded or a call fails. Numbers that differ are part of the result.
fn check(path: &Path) -> Result<Outcome, CheckError> {
    let import_error = |source| CheckError::Import { path: path.into(), source };
    let archive = Archive::open(path).map_err(import_error)?;
    let text = archive.scene.clone().ok_or_else(|| CheckError::NoScene(path.into()))?;
    let scene = Scene::parse(text, &path.join("resources/scene.toml"));
    let scene = scene.map_err(|source| CheckError::Scene { path: path.into(), source })?;
    try_out(&archive, &scene, path).map_err(import_error)
}

fn try_out(archive: &Archive, scene: &Scene, path: &Path) -> Result<Outcome, ImportError> {
    let description = &archive.description;
    let unit = archive.load()?;
    let trial = |group| Trial::run(archive, &unit, scene, group);
    let trials = (0..scene.contacts.len()).map(trial).collect::<Result<Vec<_>, ImportError>>()?;
    let (plain, contacts): (Vec<_>, Vec<_>) = trials.into_iter().partition(|trial| trial.contact.is_none());
    let wrong_starts = wrong_starts(&mut unit.instantiate()?, description)?;
    let all = || plain.iter().chain(&contacts);
    let agree = all().flat_map(|trial| &trial.rows).all(|row| row.difference.abs() < TOLERANCE);
    let passed = agree && wrong_starts.is_empty() && all().all(|trial| trial.disturbed.is_empty());
    Ok(Outcome {
        fmu: path.into(),
        platforms: archive.platforms.iter().cloned().collect(),
        variables: description.variables.len(),
        impact: ImpactNumbers { mass: scene.impact.mass, speed: scene.impact.speed },
        impact_is_assumed: scene.impact_is_assumed,
        assumption: scene.assumption(),
        prediction: scene.any_model().method(),
        steps_per_contact: STEPS_PER_CONTACT,
        moves_together: scene.inverse_masses().is_some(),
        plain: plain.into_iter().next(),
        contacts,
        wrong_starts,
        passed,
    })
}

/// Start values in the XML that differ from those of the binary.
fn wrong_starts(instance: &mut Instance, description: &Description) -> Result<Vec<String>, ImportError> {
    let mut wrong = Vec::new();
    instance.setup_experiment(0.0)?;
    instance.call("fmi2EnterInitializationMode")?;
    for (name, variable) in &description.variables {
        let Some(start) = variable.start() else { continue };
        let value = instance.real(variable.reference)?;
        if value.to_bits() != start.to_bits() {
            wrong.push(format!("{name}: {start:?} in the XML, {value:?} in the binary"));
        }
    }
    wrong.sort();
    Ok(wrong)
}

impl Outcome {
    /// As it is printed.
    fn text(&self, as_json: bool) -> String {
        if as_json { json_line(self) } else { harmless(&self.to_string()) }
    }
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ImpactNumbers { mass, speed } = self.impact;
        let assumption = format!(" (the scene names no impact: {})", self.assumption);
        let assumed = if self.impact_is_assumed { assumption.as_str() } else { "" };
        writeln!(f, "{}", shown(&self.fmu))?;
        let platforms = without_middle(&self.platforms.join(", "));
        writeln!(f, "  platforms: {platforms}; {} variables", self.variables)?;
        write_some(f, &self.wrong_starts, |wrong| format!("start value differs: {wrong}"))?;
        let trials = || self.plain.iter().chain(&self.contacts);
        if trials().any(|trial| trial.skipped.is_none()) {
            writeln!(f, "  impact of {} at {}{assumed}", quantity(mass, "kg"), quantity(speed, "m/s"))?;
            let steps = match &self.plain {
                Some(Trial { step, .. }) => {
                    format!("steps of {} ({} per contact)", quantity(*step, "s"), self.steps_per_contact)
                }
                None => format!("{} steps per contact", self.steps_per_contact),
            };
            let methods = if self.moves_together {
                "the bodies of all contacts, predicted by the library, simulated in three long steps".into()
            } else {
                format!("predicted {}, simulated by explicit co-simulation with {steps}", self.prediction)
            };
            write!(f, "{}", paragraph("  ", &methods))?;
        }
        for trial in trials() {
            write!(f, "{trial}")?;
        }
        if trials().all(|trial| trial.skipped.is_some()) {
            return Ok(());
        }
        let verdict = if self.passed { "agreement" } else { "NO AGREEMENT" };
        let tolerance = 100.0 * TOLERANCE;
        let scale = if self.moves_together {
            "an impulse relative to the largest"
        } else {
            "the dent relative to the largest indentation"
        };
        writeln!(f, "\n  {verdict} within {tolerance} % (error of {scale})")
    }
}
