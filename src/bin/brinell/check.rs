//! `brinell check`: a packed unit, loaded as any importer would, runs the impact that its scene is made for.

use crate::importer::{Archive, ImportError, Instance};
use crate::interface::prediction;
use crate::scene::{Scene, SceneError};
use brinell::contact::impact::{Impact, Prediction};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Steps of the simulated contact. The method is of second order: at this number its error is far below the tolerance.
const STEPS_PER_CONTACT: u32 = 4096;

/// Largest relative difference between prediction and simulation.
const TOLERANCE: f64 = 1e-3;

/// How often a force that follows the rate is asked for again with the speed that it leads to.
const ITERATIONS: u32 = 3;

/// A unit that couldn't be checked.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    #[error("{}: {source}", path.display())]
    Import { path: PathBuf, source: ImportError },
    #[error("{}: there is no resources/scene.toml: it was not made by brinell, so that there is no impact to run", .0.display())]
    NoScene(PathBuf),
    #[error("{}: its scene can't be read: {source}", path.display())]
    Scene { path: PathBuf, source: SceneError },
}

/// What came out.
#[derive(Debug, Serialize)]
pub struct Outcome {
    pub fmu: PathBuf,
    pub platforms: Vec<String>,
    pub variables: usize,
    pub impact: ImpactNumbers,
    pub impact_is_assumed: bool,
    /// How the predicted numbers were found.
    pub prediction: &'static str,
    /// Why no impact was run.
    pub skipped: Option<String>,
    /// [s]
    pub step: f64,
    pub steps_per_contact: u32,
    pub rows: Vec<Row>,
    /// Start values whose binary differs from the model description.
    pub wrong_starts: Vec<String>,
    pub passed: bool,
}

/// The impact that was run.
#[derive(Debug, Serialize)]
pub struct ImpactNumbers {
    /// [kg]
    pub mass: f64,
    /// [m/s]
    pub speed: f64,
}

/// One quantity, by energy balance and by co-simulation.
#[derive(Debug, Serialize)]
pub struct Row {
    pub quantity: &'static str,
    pub unit: &'static str,
    pub predicted: f64,
    pub simulated: f64,
    /// Relative to the predicted value, or to `scale`.
    pub difference: f64,
}

/// Loads the unit at `path` and runs the impact of its scene.
///
/// # Errors
/// [`CheckError`] if it can't be loaded or a call fails; numbers that differ are in the outcome.
pub fn check(path: &Path) -> Result<Outcome, CheckError> {
    let import_error = |source| CheckError::Import { path: path.into(), source };
    let archive = Archive::open(path).map_err(import_error)?;
    let text = archive.scene.clone().ok_or_else(|| CheckError::NoScene(path.into()))?;
    let scene = Scene::parse(text, &path.join("resources/scene.toml"));
    let scene = scene.map_err(|source| CheckError::Scene { path: path.into(), source })?;
    run(&archive, &scene, path).map_err(import_error)
}

fn run(archive: &Archive, scene: &Scene, path: &Path) -> Result<Outcome, ImportError> {
    let description = &archive.description;
    let unit = archive.load()?;
    let mut instance = unit.instantiate(&description.guid)?;
    let prediction = prediction(scene);
    let step = prediction.contact_time() / f64::from(STEPS_PER_CONTACT);
    let mut outcome = Outcome {
        fmu: path.into(),
        platforms: archive.platforms.iter().cloned().collect(),
        variables: description.variables.len(),
        impact: ImpactNumbers { mass: scene.impact.mass, speed: scene.impact.speed },
        impact_is_assumed: scene.impact_is_assumed,
        prediction: scene.any_model().method(),
        skipped: None,
        step,
        steps_per_contact: STEPS_PER_CONTACT,
        rows: Vec::new(),
        wrong_starts: Vec::new(),
        passed: false,
    };
    instance.setup_experiment(0.0)?;
    instance.call("fmi2EnterInitializationMode")?;
    for (name, variable) in &description.variables {
        let Some(start) = variable.start else { continue };
        let value = instance.real(variable.reference)?;
        if value.to_bits() != start.to_bits() {
            outcome.wrong_starts.push(format!("{name}: {start:?} in the XML, {value:?} in the binary"));
        }
    }
    // the impact begins at first contact; a gap that is a constant of the unit is crossed first
    if let Ok(gap) = description.real("initial_gap") {
        instance.set_real(gap, 0.0)?;
    }
    instance.call("fmi2ExitInitializationMode")?;
    let settable = scene.settable().any(|parameter| parameter.name == "initial_gap");
    let gap = if settable { 0.0 } else { scene.value("initial_gap").unwrap_or(0.0) };
    if gap < 0.0 {
        outcome.skipped = Some("the scene starts pressed in, and initial_gap is a constant of it".into());
    } else {
        let rate = description.real("indentation_rate")?;
        let force = description.real("force")?;
        let follows = scene.damped.is_some();
        let mut master = Master { instance: &mut instance, rate, force, time: 0.0, follows };
        let simulated = master.impact(&scene.impact, gap, step)?;
        outcome.rows = compare(&prediction, &simulated);
        if follows {
            // nothing remains, and where the force ends says nothing
            outcome.rows.retain(|row| row.quantity != "dent");
        }
    }
    instance.call("fmi2Terminate")?;
    let agree = outcome.rows.iter().all(|row| row.difference.abs() < TOLERANCE);
    outcome.passed = agree && outcome.wrong_starts.is_empty();
    Ok(outcome)
}

/// What an explicit co-simulation finds.
struct Simulated {
    max_indentation: f64,
    max_force: f64,
    residual_indentation: f64,
    restitution: f64,
    contact_time: f64,
}

/// A master that moves the mass and holds the rate over each step: the leap-frog method, of second order, and explicit.
struct Master<'a, 'b> {
    instance: &'a mut Instance<'b>,
    rate: u32,
    force: u32,
    time: f64,
    /// Whether the force follows the rate at the same instant.
    follows: bool,
}

impl Master<'_, '_> {
    /// Steps with `rate` [m/s] and gives the force at the end [N].
    fn step(&mut self, rate: f64, step: f64) -> Result<f64, ImportError> {
        self.instance.set_real(self.rate, rate)?;
        self.instance.do_step(self.time, step)?;
        self.time += step;
        self.instance.real(self.force)
    }

    /// The force at this moment with `rate` [m/s], [N].
    fn force_at(&mut self, rate: f64) -> Result<f64, ImportError> {
        self.instance.set_real(self.rate, rate)?;
        self.instance.real(self.force)
    }

    fn impact(&mut self, impact: &Impact, gap: f64, step: f64) -> Result<Simulated, ImportError> {
        if gap > 0.0 {
            self.step(impact.speed, gap / impact.speed)?;
        }
        // the speed in the middle of each step; that the force at first contact may not be zero is an error of one step
        let mut speed = impact.speed;
        let (mut indentation, mut time) = (0.0, 0.0);
        let (mut max_indentation, mut max_force) = (0.0, 0.0);
        // indentation and force at the ends of the last two steps
        let mut before = [(0.0, 0.0); 2];
        loop {
            indentation += speed * step;
            time += step;
            let mut force = self.step(speed, step)?;
            for _ in 0..if self.follows { ITERATIONS } else { 0 } {
                force = self.force_at(speed - 0.5 * step * force / impact.mass)?;
            }
            max_indentation = f64::max(max_indentation, indentation);
            max_force = f64::max(max_force, force);
            if force <= 0.0 && speed < 0.0 {
                let residual = end_of_contact(before);
                return Ok(Simulated {
                    max_indentation,
                    max_force,
                    residual_indentation: residual,
                    restitution: -speed / impact.speed,
                    contact_time: time - (residual - indentation) / -speed,
                });
            }
            before = [before[1], (indentation, force)];
            speed -= step * force / impact.mass;
        }
    }
}

/// Where the force ends [m], from the last two points of the contact: it vanishes as `(d - d_f)^1.5`.
fn end_of_contact([(first, first_force), (last, last_force)]: [(f64, f64); 2]) -> f64 {
    let (first_root, last_root) = (f64::powf(first_force, 2.0 / 3.0), f64::powf(last_force, 2.0 / 3.0));
    last - last_root * (first - last) / (first_root - last_root)
}

fn compare(predicted: &Prediction, simulated: &Simulated) -> Vec<Row> {
    let row = |quantity, unit, predicted: f64, simulated: f64, scale: f64| Row {
        quantity,
        unit,
        predicted,
        simulated,
        difference: (simulated - predicted) / scale,
    };
    let Prediction { max_indentation, max_force, residual_indentation, restitution, .. } = *predicted;
    let contact_time = predicted.contact_time();
    vec![
        row("largest force", "N", max_force, simulated.max_force, max_force),
        row("largest indentation", "m", max_indentation, simulated.max_indentation, max_indentation),
        // a dent may be zero: its difference is told in largest indentations
        row("dent", "m", residual_indentation, simulated.residual_indentation, max_indentation),
        row("restitution", "", restitution, simulated.restitution, restitution),
        row("contact time", "s", contact_time, simulated.contact_time, contact_time),
    ]
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ImpactNumbers { mass, speed } = self.impact;
        let assumed =
            if self.impact_is_assumed { " (the scene names no impact: a solid steel ball is assumed)" } else { "" };
        writeln!(f, "{}", self.fmu.display())?;
        writeln!(f, "  platforms {}; {} variables", self.platforms.join(", "), self.variables)?;
        for wrong in &self.wrong_starts {
            writeln!(f, "  start value differs: {wrong}")?;
        }
        if let Some(reason) = &self.skipped {
            return writeln!(f, "  no impact was run: {reason}");
        }
        writeln!(f, "  impact of {mass} kg at {speed} m/s{assumed}")?;
        writeln!(
            f,
            "  predicted {}, simulated by explicit co-simulation with {:.3e} s steps ({} per contact)\n",
            self.prediction, self.step, self.steps_per_contact
        )?;
        writeln!(f, "  {:<20} {:>14} {:>14}    {:>11}", "", "predicted", "simulated", "difference")?;
        for Row { quantity, unit, predicted, simulated, difference } in &self.rows {
            let difference = 100.0 * difference;
            writeln!(f, "  {quantity:<20} {predicted:>14.6e} {simulated:>14.6e} {unit:<2} {difference:>+11.5} %")?;
        }
        let verdict = if self.passed { "agree" } else { "DO NOT AGREE" };
        writeln!(f, "\n  they {verdict} to {} % (dent: of the largest indentation)", 100.0 * TOLERANCE)
    }
}
