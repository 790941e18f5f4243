//! Stiff and extreme cases, each judged: impacts far from the scene's, and extreme prescribed motions.

use super::Progress;
use super::contact::Contact;
use super::units::first_contact;
use super::ways::{LEAP_FROG, Needs};
use crate::importer::ImportError;
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO};
use brinell_contact::{Loading, Model, Surface};
use brinell_exporter::model::AnyModel;
use brinell_exporter::scene::{Body, Scene};
use brinell_exporter::validity::{self, Beyond};
use serde::Serialize;

/// Tolerances of an impact with leap-frog: energy relative to the incoming energy, force relative to itself.
pub const TOLERANCE: f64 = 0.01;

/// Tolerance of the dissipated energy of a prescribed motion, relative to the work of its loading.
pub const EXACT: f64 = 1e-9;

/// Tolerance for the rounding of a restitution of one.
const ROUNDING: f64 = 1e-9;

/// Factor of a finer step if the importer has missed the peak of the force: for a damped contact it may be just after
/// first touch. Each attempt may take more steps.
const FINER: [f64; 2] = [8.0, 64.0];

/// The result of a case.
#[derive(Serialize)]
pub struct Case {
    #[serde(rename = "case")]
    pub name: String,
    #[serde(rename = "largest_indentation_m")]
    indentation: f64,
    #[serde(rename = "step_s")]
    step: f64,
    /// Contact radius over the effective radius.
    #[serde(rename = "a/R")]
    width: f64,
    #[serde(rename = "error_of_force")]
    force_error: f64,
    #[serde(rename = "error_of_energy")]
    energy_error: f64,
    tolerance: f64,
    verdict: String,
    /// The exceeded limits of the law's validity, and whether the law itself returns more energy than it received.
    beyond_validity: String,
    #[serde(skip)]
    pub outcome: Outcome,
    /// The numbers of exceeded limits and of warnings from the FMU.
    #[serde(skip)]
    warned: (usize, usize),
}

/// The outcome of a case.
#[derive(Clone, Copy, PartialEq)]
pub enum Outcome {
    Right,
    /// The FMU rejected it, correctly and with the reason.
    Refused,
    /// There is no reference to judge it.
    NotJudged,
    Failed,
}

/// Runs all cases.
pub fn measure(contact: &mut Contact, scene: &Scene, quick: bool, progress: &Progress) -> Vec<Case> {
    progress.say("stiff and extreme cases");
    let limits = if quick { (256.0, 2e5) } else { (1024.0, 2e6) };
    // an elastic contact has no yield strain
    let possible = changes().into_iter().filter_map(|(name, change)| Some((name, Bodies::of(scene, change)?)));
    let mut cases: Vec<Case> = possible.map(|(name, bodies)| impact(contact, &name, &bodies, limits)).collect();
    let own = Bodies::of(scene, Change::default()).filter(|_| !scene.is_rate_dependent());
    if let Some(bodies) = own
        && let (Some(prediction), Some(model)) = (bodies.model.predict(&bodies.impact), bodies.model.elastoplastic())
    {
        let motions = motions(prediction.max_indentation, quick, model.surface);
        cases.extend(motions.into_iter().map(|motion| motion.judge(contact, &bodies, model)));
    }
    cases
}

impl Case {
    /// A case before its run.
    fn new(name: &str, indentation: f64, step: f64, tolerance: f64) -> Case {
        Case {
            name: name.into(),
            indentation,
            step,
            width: f64::NAN,
            force_error: f64::NAN,
            energy_error: f64::NAN,
            tolerance,
            verdict: String::new(),
            beyond_validity: String::new(),
            outcome: Outcome::NotJudged,
            warned: (0, 0),
        }
    }

    /// The same with an outcome and its reason.
    fn with(mut self, outcome: Outcome, why: &str) -> Case {
        self.outcome = outcome;
        self.verdict = match outcome {
            Outcome::Right => "right".into(),
            Outcome::Refused => format!("rejected, correctly: {why}"),
            Outcome::NotJudged => format!("not judged: {why}"),
            Outcome::Failed => format!("FAILED: {why}"),
        };
        self
    }

    /// Records the exceeded limits at this contact `radius` [m], and how many of them the FMU reported.
    fn note_validity(&mut self, contact: &mut Contact, bodies: &Bodies, radius: f64, makes_energy: bool) {
        self.width = radius / bodies.model.pair().radius;
        let beyond = validity::beyond(&bodies.model.pair(), bodies.density, radius, contact.fastest);
        self.warned = (beyond.len(), contact.warnings().len());
        let words = beyond.iter().map(|beyond| match beyond {
            Beyond::Width(_) => format!("a/R above {LARGEST_RADIUS_RATIO}"),
            Beyond::Speed { .. } => format!("speed above {LARGEST_SPEED_RATIO} of the wave speed"),
        });
        let words: Vec<_> = words.chain(makes_energy.then(|| "the law gains energy".into())).collect();
        self.beyond_validity = words.join(", ");
    }

    /// Fails the case if an error exceeds its tolerance, if `passive` is false, or if a warning is missing or wrong.
    fn judged(self, passive: bool) -> Case {
        // NaN counts as wrong
        let right = |error: f64| error <= self.tolerance;
        let (due, told) = self.warned;
        let failure = if !right(self.force_error) {
            format!("the force is off by {:e}", self.force_error)
        } else if !right(self.energy_error) {
            format!("the energy is off by {:e}", self.energy_error)
        } else if !passive {
            "it gains energy".into()
        } else if told != due {
            format!("{due} limits of validity were left, and the FMU logged {told}")
        } else {
            return self.with(Outcome::Right, "");
        };
        self.with(Outcome::Failed, &failure)
    }
}

/// Bodies and impact that differ from the scene's.
struct Bodies {
    parameters: Vec<(&'static str, f64)>,
    model: AnyModel,
    impact: Impact,
    density: Option<f64>,
}

/// Other values than the scene's: target's Young's modulus [Pa], yield strain, radius [m], speed [m/s].
#[derive(Clone, Copy, Default)]
struct Change {
    modulus: Option<f64>,
    strain: Option<f64>,
    radius: Option<f64>,
    speed: Option<f64>,
}

impl Bodies {
    /// The bodies of `scene` with a `change`. The yield strain stays the same unless it is changed; the mass scales
    /// with the volume.
    fn of(scene: &Scene, change: Change) -> Option<Bodies> {
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
        let mut changed = first_contact(scene, Needs::Force);
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

    /// A contact of these bodies with warnings about its validity enabled.
    fn start(&self, contact: &mut Contact) -> Result<(), ImportError> {
        let parameters: Vec<_> = self.parameters.iter().copied().chain([("initial_gap", 0.0)]).collect();
        contact.start(&parameters)?;
        contact.ask_for_warnings()
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
                let [modulus, strain, radius, speed] = [modulus, strain, radius, speed].map(Some);
                all.push((name, Change { modulus, strain, radius, speed }));
            }
        }
    }
    all
}

/// An impact with leap-frog: `steps` in its shorter half, at most `most` in total.
fn impact(contact: &mut Contact, name: &str, bodies: &Bodies, (steps, most): (f64, f64)) -> Case {
    let Some(prediction) = bodies.model.predict(&bodies.impact) else {
        return without_prediction(contact, name, bodies, steps);
    };
    let shorter = prediction.loading_time.min(prediction.unloading_time);
    let step = |finer: f64| (shorter / steps / finer).max(prediction.contact_time() / most / finer.sqrt());
    let mut case = by_steps(contact, name, bodies, &prediction, step(1.0));
    for step in FINER.map(step) {
        if case.outcome == Outcome::Failed && step < case.step {
            case = by_steps(contact, name, bodies, &prediction, step);
        }
    }
    case
}

/// The impact with steps of this length [s].
fn by_steps(contact: &mut Contact, name: &str, bodies: &Bodies, prediction: &Prediction, step: f64) -> Case {
    let mut case = Case::new(name, prediction.max_indentation, step, TOLERANCE);
    let Impact { mass, speed } = bodies.impact;
    let run = bodies.start(contact).and_then(|()| LEAP_FROG.impact(contact, mass, speed, step));
    let rebound = match run {
        Ok(rebound) => rebound,
        Err(error) => return case.with(Outcome::Failed, &error.to_string()),
    };
    let (energy, expected) = ((rebound.speed / speed).powi(2), prediction.rebound_energy / prediction.energy);
    case.note_validity(contact, bodies, prediction.max_contact_radius, expected > 1.0 + ROUNDING);
    case.force_error = (rebound.max_force / prediction.max_force - 1.0).abs();
    case.energy_error = (energy - expected).abs();
    case.judged(energy <= f64::max(expected, 1.0) + TOLERANCE)
}

/// An impact without a prediction. Beyond the range of the law, the FMU must report an error. A strongly damped
/// contact, from which the bodies creep apart indefinitely, can't be judged; nor one with a loss, whose rebound then is
/// below the rounding of the indentation, or ends as slowly.
fn without_prediction(contact: &mut Contact, name: &str, bodies: &Bodies, steps: f64) -> Case {
    let Impact { mass, speed } = bodies.impact;
    // as deep as with Hertz's law; a law that yields is softer
    let depth = (bodies.impact.energy() / (0.4 * bodies.model.pair().hertz_stiffness())).powf(0.4);
    let case = |step| Case::new(name, f64::NAN, step, TOLERANCE);
    match bodies.model {
        AnyModel::Damped(_) => return case(f64::NAN).with(Outcome::NotJudged, "the bodies creep apart without end"),
        AnyModel::Lossy(_) => {
            let why = "the loss leaves no rebound that can be predicted";
            return case(f64::NAN).with(Outcome::NotJudged, why);
        }
        AnyModel::Elastoplastic(_) => {}
    }
    let step = depth / speed / steps;
    match bodies.start(contact).and_then(|()| LEAP_FROG.impact(contact, mass, speed, step)) {
        Ok(_) => case(step).with(Outcome::Failed, "there is no prediction, and the unit goes on"),
        Err(error) => case(step).with(Outcome::Refused, &error.to_string()),
    }
}

/// The driver of a contact.
type Run = Box<dyn Fn(&mut Contact) -> Result<(), ImportError>>;

/// A motion of the bodies, in and out.
struct Motion {
    name: String,
    /// Depth [m].
    depth: f64,
    /// Longest step [s].
    step: f64,
    /// Number of times it yields at that depth.
    yields: u32,
    run: Run,
}

/// All motions; those with the size of the scene's impact reach `depth` [m].
fn motions(depth: f64, quick: bool, surface: Surface) -> Vec<Motion> {
    let mut all = Vec::new();
    let mut add = |name: String, depth: f64, step: f64, run: Run| {
        all.push(Motion { name, depth, step, yields: 1, run });
    };
    for step in [1e-15, 1e-9, 1e-3, 1.0, 1e6] {
        add(format!("{step:e} s steps"), depth, step, Box::new(move |contact| in_and_out(contact, depth, &[step; 32])));
    }
    let alternating: Vec<f64> = (0..32).map(|index| if index % 2 == 0 { 1e-12 } else { 1.0 }).collect();
    let run = Box::new(move |contact: &mut Contact| in_and_out(contact, depth, &alternating));
    add("steps of 1e-12 s and 1 s in turn".into(), depth, 1.0, run);
    let run = Box::new(move |contact: &mut Contact| {
        // 4 d t (1 - t): the largest indentation in the middle of a step of one second
        contact.set_rate(4.0 * depth)?;
        contact.set_derivatives(&[-8.0 * depth, 0.0])?;
        contact.step(1.0)
    });
    add("in and out within one step".into(), depth, 1.0, run);
    let cycles = if quick { 10_000 } else { 100_000 };
    let run = Box::new(move |contact: &mut Contact| {
        in_and_out(contact, depth, &[1.0, 1.0])?;
        (0..cycles).try_for_each(|_| in_and_out(contact, 1e-12 * depth, &[1e-6, 1e-6]))
    });
    add("chatter at the surface after the impact".into(), depth, 1.0, run);
    let still = if quick { 1_000_000 } else { 100_000_000 };
    let run = Box::new(move |contact: &mut Contact| {
        contact.set_rate(depth)?;
        contact.step(1.0)?;
        contact.set_rate(0.0)?;
        (0..still).try_for_each(|_| contact.step(1.0))?;
        contact.set_rate(-depth)?;
        contact.step(1.0)
    });
    add(format!("{still} steps at rest in the dent"), depth, 1.0, run);
    for depth in [5e-324, 1e-300, 1e-30, 1e30, 1e39] {
        let run = Box::new(move |contact: &mut Contact| in_and_out(contact, depth, &[1.0, 1.0]));
        add(format!("indentation of {depth:e} m"), depth, 1.0, run);
    }
    // a fresh surface yields each time
    let yields = if surface == Surface::Fresh { cycles } else { 1 };
    let run =
        Box::new(move |contact: &mut Contact| (0..cycles).try_for_each(|_| in_and_out(contact, depth, &[1.0, 1.0])));
    all.push(Motion { name: format!("{cycles} load cycles at one dent"), depth, step: 1.0, yields, run });
    all
}

/// To `depth` [m] in the first half of the `steps` [s], and back in the second half.
fn in_and_out(contact: &mut Contact, depth: f64, steps: &[f64]) -> Result<(), ImportError> {
    let (there, back) = steps.split_at(steps.len() / 2);
    for (way, sign) in [(there, 1.0), (back, -1.0)] {
        let rate = sign * depth / way.iter().sum::<f64>();
        for step in way {
            contact.set_rate(rate)?;
            contact.step(*step)?;
        }
    }
    Ok(())
}

impl Motion {
    /// Runs the motion and compares the dissipated energy.
    fn judge(self, contact: &mut Contact, bodies: &Bodies, model: &Model<AnyLoading, AnyUnloading>) -> Case {
        let Motion { name, depth, step, yields, run } = self;
        let mut case = Case::new(&name, depth, step, EXACT);
        let once = model.loading.work(&model.pair, depth);
        let (work, recovered) = (f64::from(yields) * once, f64::from(yields) * model.recovered_work(depth, depth));
        // a law that creates energy may keep the contact closed beyond the original surface, where the motion ends
        let holds_on = model.unloading_path(depth).lower < 0.0;
        let left = if holds_on { model.unloading_segment(depth, 0.0).force(0.0) } else { 0.0 };
        let makes_energy = recovered > work * (1.0 + EXACT);
        let ran = bodies.start(contact).and_then(|()| run(contact));
        let ended = ran.and_then(|()| Ok((contact.force()?, contact.output("dissipated_energy")?)));
        let (force, dissipated) = match ended {
            Ok(ended) => ended,
            Err(error) => return case.with(Outcome::Failed, &error.to_string()),
        };
        case.note_validity(contact, bodies, model.loading.contact_radius(&model.pair, depth), makes_energy);
        // an elastic contact may show the rounding of the path
        let largest = model.loading.segment(&model.pair, depth).force(depth);
        case.force_error = if largest > 0.0 { (force - left).abs() / largest } else { force.abs() };
        // the energy of a tiny indentation underflows
        case.energy_error = if work > 0.0 { (dissipated - (work - recovered)).abs() / work } else { dissipated.abs() };
        case.judged(makes_energy || dissipated >= -EXACT * work)
    }
}

/// The finding in words.
pub fn words(cases: &[Case]) -> String {
    let count = |outcome: Outcome| cases.iter().filter(|case| case.outcome == outcome).count();
    let (failed, judged) = (count(Outcome::Failed), cases.len() - count(Outcome::NotJudged));
    let mut words = format!("{} of {judged} stiff and extreme cases are correct.", judged - failed);
    for case in cases.iter().filter(|case| case.outcome == Outcome::Failed) {
        words.push_str(&format!(" Failed: {}.", case.name));
    }
    words
}
