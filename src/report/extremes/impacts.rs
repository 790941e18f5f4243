//! Impacts far from the scene's: harder or softer, stronger or weaker, larger or smaller, faster or slower.

use super::{Case, TOLERANCE, Verdict};
use crate::importer::ImportError;
use crate::model::AnyModel;
use crate::report::contact::Contact;
use crate::report::progress::{Progress, Work};
use crate::report::unit;
use crate::report::ways::{LEAP_FROG, Needs};
use crate::scene::{Body, Scene};
use crate::validity::{self, Beyond};
use brinell_contact::impact::{Impact, Prediction};

/// Bodies and impact that differ from the scene's.
pub struct Bodies {
    parameters: Vec<(&'static str, f64)>,
    pub model: AnyModel,
    impact: Impact,
    density: Option<f64>,
}

/// Factors relative to the scene: target's Young's modulus [Pa], yield strain, radius [m], speed [m/s]; `None` keeps
/// the scene's value.
#[derive(Clone, Copy, Default)]
pub struct Change {
    modulus: Option<f64>,
    strain: Option<f64>,
    radius: Option<f64>,
    speed: Option<f64>,
}

impl Bodies {
    /// The bodies of `scene` with a `change`. The yield strain stays the same unless it is changed; the mass scales
    /// with the volume.
    pub fn of(scene: &Scene, change: Change) -> Option<Bodies> {
        let old = |name| scene.value(name).unwrap_or(f64::NAN);
        let (old_modulus, old_radius) = (old("target.youngs_modulus"), old("impactor.radius"));
        let modulus = change.modulus.unwrap_or(old_modulus);
        let radius = change.radius.unwrap_or(old_radius);
        let mass = scene.impact.mass * (radius / old_radius).powi(3);
        let target_strength = old(Body::Target.yield_strength());
        let softer_strength = old(scene.softer(0).yield_strength());
        let strain = change.strain.unwrap_or(softer_strength / old_modulus);
        // both bodies keep the ratio of their strengths
        let stronger = strain * modulus / softer_strength;
        let strength = |body: Body, old: f64| if scene.softer(0) == body { strain * modulus } else { old * stronger };
        let all = [
            ("impactor.radius", radius),
            // a target that is a sphere, or a socket, keeps its shape
            ("target.radius", old("target.radius") * radius / old_radius),
            ("target.youngs_modulus", modulus),
            (Body::Target.yield_strength(), strength(Body::Target, target_strength)),
            (Body::Impactor.yield_strength(), strength(Body::Impactor, old(Body::Impactor.yield_strength()))),
            ("effective_mass", mass),
        ];
        let mut changed = unit::first_contact(scene, Needs::Force);
        let mut parameters = Vec::new();
        for (name, value) in all {
            if let Some(parameter) = changed.parameters.iter_mut().find(|parameter| parameter.name == name) {
                parameter.value = value;
                parameters.push((name, value));
            }
        }
        let asked = change.strain.is_none() || scene.value(scene.softer(0).yield_strength()).is_some();
        let impact = Impact { mass, speed: change.speed.unwrap_or(scene.impact.speed) };
        asked.then(|| Bodies { parameters, model: changed.any_model(), impact, density: scene.contacts[0].density })
    }

    pub fn predict(&self) -> Option<Prediction> {
        self.model.predict(&self.impact)
    }

    /// A contact of these bodies with warnings about its validity enabled.
    pub fn start(&self, contact: &mut Contact) -> Result<(), ImportError> {
        let mut parameters = self.parameters.clone();
        parameters.push(("initial_gap", 0.0));
        contact.start(&parameters)?;
        contact.ask_for_warnings()
    }

    /// The limits exceeded by a contact with this contact `radius` [m] and closing `speed` [m/s].
    pub fn beyond(&self, radius: f64, speed: f64) -> Vec<Beyond> {
        validity::beyond(&self.model.pair(), self.density, radius, speed)
    }
}

/// The impacts: each quantity alone, then the corners.
fn changes() -> Vec<(String, Change)> {
    let mut all = Vec::new();
    let none = Change::default();
    for modulus in [1e3, 1e6, 1e9, 1e12, 1e15] {
        all.push((format!("E = {modulus:e} Pa"), Change { modulus: Some(modulus), ..none }));
    }
    for strain in [1e-9, 1e-7, 1e-5, 1e-3, 0.1, 1.0] {
        all.push((format!("S/E = {strain:e}"), Change { strain: Some(strain), ..none }));
    }
    for radius in [1e-9, 1e-6, 1e-3, 1.0, 1e3] {
        all.push((format!("R = {radius:e} m"), Change { radius: Some(radius), ..none }));
    }
    for speed in [1e-9, 1e-6, 1e-3, 10.0, 100.0, 1e4] {
        all.push((format!("speed {speed:e} m/s"), Change { speed: Some(speed), ..none }));
    }
    for modulus in [1e3, 1e15] {
        for strain in [1e-9, 1.0] {
            for (radius, speed) in [(1e-9, 1e-9), (1e-9, 1e4), (1e3, 1e-9), (1e3, 1e4)] {
                let name = format!("E = {modulus:e} Pa, S/E = {strain:e}, R = {radius:e} m, speed {speed:e} m/s");
                let change =
                    Change { modulus: Some(modulus), strain: Some(strain), radius: Some(radius), speed: Some(speed) };
                all.push((name, change));
            }
        }
    }
    all
}

/// The impacts for `scene`: an elastic contact has no yield strain.
fn possible(scene: &Scene) -> impl Iterator<Item = (String, Bodies)> {
    changes().into_iter().filter_map(|(name, change)| Some((name, Bodies::of(scene, change)?)))
}

/// Number of impacts.
pub fn count(scene: &Scene) -> usize {
    possible(scene).count()
}

/// Runs all impacts.
pub fn run(contact: &mut Contact, scene: &Scene, quick: bool, progress: &Progress) -> Vec<Case> {
    let limits = if quick { (256.0, 2e5) } else { (1024.0, 2e6) };
    let run = |(name, bodies): (String, Bodies)| {
        progress.detail(&name);
        let case = impact(contact, &name, &bodies, limits);
        progress.done(Work::Case);
        case
    };
    possible(scene).map(run).collect()
}

/// Factor of a finer step if the importer has missed the peak of the force: for a damped contact it may be just after
/// first touch. Each attempt may take more steps.
const FINER: [f64; 2] = [8.0, 64.0];

/// An impact with leap-frog: `steps` in its shorter half, at most `most` in total.
fn impact(contact: &mut Contact, name: &str, bodies: &Bodies, (steps, most): (f64, f64)) -> Case {
    let Some(prediction) = bodies.predict() else { return without_prediction(contact, name, bodies, steps) };
    let shorter = prediction.loading_time.min(prediction.unloading_time);
    let step = |finer: f64| (shorter / steps / finer).max(prediction.contact_time() / most / finer.sqrt());
    let mut case = by_steps(contact, name, bodies, &prediction, step(1.0));
    for step in FINER.map(step) {
        if case.has_failed() && step < case.step {
            case = by_steps(contact, name, bodies, &prediction, step);
        }
    }
    case
}

/// The impact with steps of this length [s].
fn by_steps(contact: &mut Contact, name: &str, bodies: &Bodies, prediction: &Prediction, step: f64) -> Case {
    let mut case = Case::new(name, TOLERANCE);
    (case.indentation, case.step) = (prediction.max_indentation, step);
    let Impact { mass, speed } = bodies.impact;
    let run = bodies.start(contact).and_then(|()| LEAP_FROG.impact(contact, mass, speed, step));
    let rebound = match run {
        Ok(rebound) => rebound,
        Err(error) => {
            case.verdict = Verdict::Failed(error.to_string());
            return case;
        }
    };
    case.note_validity(contact, bodies, prediction.max_contact_radius);
    let (energy, expected) = ((rebound.speed / speed).powi(2), prediction.rebound_energy / prediction.energy);
    case.makes_energy = expected > 1.0 + ROUNDING;
    case.errors = ((rebound.max_force / prediction.max_force - 1.0).abs(), (energy - expected).abs());
    case.judge(energy <= f64::max(expected, 1.0) + TOLERANCE);
    case
}

/// Tolerance for the rounding of a restitution of one.
const ROUNDING: f64 = 1e-9;

/// An impact without a prediction. Beyond the range of the law, the FMU must report an error. A strongly damped
/// contact, from which the bodies creep apart indefinitely, can't be judged; nor one with a loss, whose rebound then is
/// below the rounding of the indentation, or ends as slowly.
fn without_prediction(contact: &mut Contact, name: &str, bodies: &Bodies, steps: f64) -> Case {
    let mut case = Case::new(name, TOLERANCE);
    if bodies.model.elastoplastic().is_none() {
        case.verdict = Verdict::NotJudged("the bodies creep apart without end");
        return case;
    }
    if let AnyModel::Lossy(_) = bodies.model {
        case.verdict = Verdict::NotJudged("the loss leaves no rebound that can be predicted");
        return case;
    }
    let Impact { mass, speed } = bodies.impact;
    // as deep as with Hertz's law; a law that yields is softer
    let depth = (0.5 * mass * speed * speed / (0.4 * bodies.model.pair().hertz_stiffness())).powf(0.4);
    case.step = depth / speed / steps;
    case.verdict = match bodies.start(contact).and_then(|()| LEAP_FROG.impact(contact, mass, speed, case.step)) {
        Ok(_) => Verdict::Failed("there is no prediction, and the unit goes on".into()),
        Err(error) => Verdict::Refused(error.to_string()),
    };
    case
}
