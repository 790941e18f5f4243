//! Stiff and extreme cases, each judged: impacts far from the scene's, and extreme prescribed motions.

use super::runs::Progress;
use super::units::first_contact;
use crate::importer::ImportError;
use crate::master::Contact;
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO};
use brinell_contact::{Loading, Model, Surface};
use brinell_exporter::master::{Coupled, LEAP_FROG, Requirements};
use brinell_exporter::model::AnyModel;
use brinell_exporter::scene::{Body, Scene};
use brinell_exporter::validity::{self, Beyond};
use serde::Serialize;

/// Tolerances of an impact with leap-frog: energy relative to the incoming energy, force relative to itself.
const TOLERANCE: f64 = 0.01;

/// Tolerance of the dissipated energy of a prescribed motion, relative to the work of its loading; and for the rounding of a
/// restitution of one.
const EXACT: f64 = 1e-9;

/// Factor of a finer step if the importer has missed the peak of the force: for a damped contact it may be just after
/// first touch. Each attempt may take more steps.
const FINER: [f64; 2] = [8.0, 64.0];

/// The result of a case. Numbers that it doesn't have are null.
#[derive(Default, Serialize)]
pub struct Case {
    #[serde(rename = "case")]
    pub name: String,
    #[serde(rename = "largest_indentation_m")]
    indentation: f64,
    #[serde(rename = "step_s")]
    step: f64,
    /// Contact radius over the effective radius.
    #[serde(rename = "a/R")]
    width: Option<f64>,
    #[serde(rename = "error_of_force")]
    force_error: Option<f64>,
    #[serde(rename = "error_of_energy")]
    energy_error: Option<f64>,
    tolerance: f64,
    verdict: String,
    /// The exceeded limits of the law's validity, and whether the law itself returns more energy than it received.
    beyond_validity: String,
    #[serde(skip)]
    pub outcome: Outcome,
}

/// What a run has shown.
struct Finding {
    force_error: f64,
    energy_error: f64,
    /// Whether the law itself returns more energy than it received.
    law_gains: bool,
}

/// The outcome of a case.
#[derive(Clone, Copy, Default, PartialEq)]
pub enum Outcome {
    Right,
    /// The FMU rejected it, correctly and with the reason.
    Refused,
    /// There is no reference to judge it.
    #[default]
    NotJudged,
    Failed,
}

/// Runs all cases.
pub fn measure(contact: &mut Contact, scene: &Scene, quick: bool, progress: &Progress) -> Vec<Case> {
    progress.say("stiff and extreme cases");
    let limits = if quick { (256.0, 2e5) } else { (1024.0, 2e6) };
    let possible = changes().into_iter().filter_map(|change| Some((name_of(&change), Bodies::of(scene, change)?)));
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
        Case { name: name.into(), indentation, step, tolerance, ..Case::default() }
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

    /// Judges a run whose largest contact radius is `radius` \[m\] by the law. It fails if an error exceeds its tolerance, or if a
    /// warning is missing or wrong. A contact as wide as its smaller body must be refused.
    fn judged(
        mut self,
        contact: &mut Contact,
        bodies: &Bodies,
        radius: f64,
        run: Result<Finding, ImportError>,
    ) -> Case {
        let Finding { force_error, energy_error, law_gains } = match run {
            Ok(_) if radius > (1.0 + TOLERANCE) * bodies.size => {
                return self.with(Outcome::Failed, "the contact is wider than the smaller body, and the unit goes on");
            }
            Ok(finding) => finding,
            Err(error) if radius > (1.0 - TOLERANCE) * bodies.size => {
                return self.with(Outcome::Refused, &error.to_string());
            }
            Err(error) => return self.with(Outcome::Failed, &error.to_string()),
        };
        let pair = bodies.model.pair();
        let beyond = validity::beyond((&pair, bodies.size), bodies.line, bodies.density, radius, contact.fastest);
        let (due, told) = (beyond.len(), contact.instance.take_warnings().len());
        let words = beyond.iter().map(|beyond| match beyond {
            Beyond::Width(_) | Beyond::Size { .. } => format!("a/R above {LARGEST_RADIUS_RATIO}"),
            Beyond::Speed { .. } => format!("speed above {LARGEST_SPEED_RATIO} of the wave speed"),
            // an FMU does not know that a body is a rod
            other => validity::words(*other),
        });
        let words: Vec<_> = words.chain(law_gains.then(|| "the law gains energy".into())).collect();
        self.width = Some(radius / pair.radius);
        (self.force_error, self.energy_error) = (Some(force_error), Some(energy_error));
        self.beyond_validity = words.join(", ");
        // NaN counts as wrong
        let right = |error: f64| error <= self.tolerance;
        let failure = if !right(force_error) {
            format!("the force is off by {force_error:e}")
        } else if !right(energy_error) {
            format!("the energy is off by {energy_error:e}")
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
    /// That of the smaller body [m].
    size: f64,
    /// The same of a line contact [m].
    line: Option<f64>,
}

/// The quantities that differ from the scene's, with their units and values: target's Young's modulus, yield strain, radius,
/// speed.
const QUANTITIES: [(&str, &str, &[f64]); 4] = [
    ("E =", "Pa", &[1e3, 1e6, 1e9, 1e12, 1e15]),
    ("S/E =", "", &[1e-9, 1e-7, 1e-5, 1e-3, 0.1, 1.0]),
    ("R =", "m", &[1e-9, 1e-6, 1e-3, 1.0, 1e3]),
    ("speed", "m/s", &[1e-9, 1e-6, 1e-3, 10.0, 100.0, 1e4]),
];

/// A value for each of these quantities that isn't the scene's.
type Change = [Option<f64>; QUANTITIES.len()];

/// The impacts: each quantity alone, then the corners: every combination of the first and the last values.
fn changes() -> Vec<Change> {
    let alone = |place: usize| {
        let only = move |value: &f64| std::array::from_fn(|other| (other == place).then_some(*value));
        QUANTITIES[place].2.iter().map(only)
    };
    let corner = |index: usize| {
        let is_last = |place: usize| index >> (QUANTITIES.len() - 1 - place) & 1 == 1;
        std::array::from_fn(|place| {
            if is_last(place) { QUANTITIES[place].2.last() } else { QUANTITIES[place].2.first() }.copied()
        })
    };
    (0..QUANTITIES.len()).flat_map(alone).chain((0..1 << QUANTITIES.len()).map(corner)).collect()
}

/// The changed quantities in words.
fn name_of(change: &Change) -> String {
    let named = QUANTITIES.iter().zip(change).filter_map(|((name, unit, _), value)| {
        let value = (*value)?;
        Some(format!("{name} {value:e} {unit}").trim_end().to_string())
    });
    named.collect::<Vec<_>>().join(", ")
}

impl Bodies {
    /// The bodies of `scene` with a `change`. The yield strain stays the same unless it is changed; the mass scales
    /// with the volume.
    fn of(scene: &Scene, [modulus, strain, radius, speed]: Change) -> Option<Bodies> {
        let old = |name| scene.value(name).unwrap_or(f64::NAN);
        let old_strain = scene.value(scene.softer(0).yield_strength()).map(|own| own / old("target.youngs_modulus"));
        // an elastic contact has no yield strain
        if strain.is_some() && old_strain.is_none() {
            return None;
        }
        // the depth of a line contact depends on its sizes, which are constants
        if radius.is_some() && scene.is_line() {
            return None;
        }
        // so is the ball in place of an ellipse
        if (radius.is_some() || modulus.is_some()) && scene.contacts[0].ellipse.is_some() {
            return None;
        }
        let larger = radius.map_or(1.0, |radius| radius / old("impactor.radius"));
        let stiffer = modulus.map_or(1.0, |modulus| modulus / old("target.youngs_modulus"));
        // both bodies keep the ratio of their strengths
        let stronger = stiffer * strain.zip(old_strain).map_or(1.0, |(strain, old)| strain / old);
        let mut changed = first_contact(scene, Requirements::Force);
        let mut parameters = Vec::new();
        for parameter in &mut changed.parameters {
            let factor = match parameter.name {
                // a target that is a sphere, or a socket, keeps its shape
                "impactor.radius" | "target.radius" => larger,
                "target.youngs_modulus" => stiffer,
                name if Body::ALL.iter().any(|body| body.yield_strength() == name) => stronger,
                _ => continue,
            };
            parameter.value *= factor;
            parameters.push((parameter.name, parameter.value));
        }
        let impact = Impact { mass: scene.impact.mass * larger.powi(3), speed: speed.unwrap_or(scene.impact.speed) };
        let size = changed.smaller_radius(0);
        Some(Bodies {
            parameters,
            model: changed.any_model(),
            impact,
            density: scene.contacts[0].density,
            size,
            line: changed.line_size(0),
        })
    }

    /// A contact of these bodies with warnings about its validity enabled.
    fn start(&self, contact: &mut Contact) -> Result<(), ImportError> {
        let parameters: Vec<_> = self.parameters.iter().copied().chain([("initial_gap", 0.0)]).collect();
        contact.start(&parameters)?;
        contact.instance.take_warnings();
        contact.instance.ask_for_warnings()
    }
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
    let Impact { mass, speed } = bodies.impact;
    let expected = prediction.rebound_energy / prediction.energy;
    let run = bodies.start(contact).and_then(|()| LEAP_FROG.impact(contact, mass, speed, step));
    let finding = run.map(|rebound| {
        let energy = (rebound.speed / speed).powi(2);
        Finding {
            force_error: (rebound.max_force / prediction.max_force - 1.0).abs(),
            energy_error: (energy - expected).abs(),
            law_gains: expected > 1.0 + EXACT,
        }
    });
    Case::new(name, prediction.max_indentation, step, TOLERANCE).judged(
        contact,
        bodies,
        prediction.max_contact_radius,
        finding,
    )
}

/// An impact without a prediction. Beyond the range of the law, the FMU must report an error. A strongly damped
/// contact, from which the bodies creep apart indefinitely, can't be judged; nor one with a loss, whose rebound then is
/// below the rounding of the indentation, or ends as slowly.
fn without_prediction(contact: &mut Contact, name: &str, bodies: &Bodies, steps: f64) -> Case {
    let case = |step| Case::new(name, f64::NAN, step, TOLERANCE);
    let not_judged = |why| case(f64::NAN).with(Outcome::NotJudged, why);
    match bodies.model {
        AnyModel::Lossy(_, Some(_)) => return not_judged("the bodies creep apart without end"),
        AnyModel::Lossy(_, None) => return not_judged("the loss leaves no rebound that can be predicted"),
        AnyModel::Elastoplastic(_) => {}
    }
    let Impact { mass, speed } = bodies.impact;
    // as deep as with Hertz's law; a law that yields is softer
    let depth = (bodies.impact.energy() / (0.4 * bodies.model.pair().hertz_stiffness())).powf(0.4);
    let step = depth / speed / steps;
    match bodies.start(contact).and_then(|()| LEAP_FROG.impact(contact, mass, speed, step)) {
        Ok(_) => case(step).with(Outcome::Failed, "there is no prediction, and the unit goes on"),
        Err(error) => case(step).with(Outcome::Refused, &error.to_string()),
    }
}

/// A step [s] of a prescribed motion.
#[derive(Clone)]
struct Leg {
    /// At its begin [m/s].
    rate: f64,
    /// \[m/s^2\]
    acceleration: f64,
    step: f64,
}

/// A motion of the bodies, in and out.
struct Motion {
    name: String,
    /// Depth [m].
    depth: f64,
    /// Longest step [s].
    step: f64,
    /// Number of times it yields at that depth.
    yields: u32,
    /// Its parts, each repeated a number of times.
    parts: Vec<(u32, Vec<Leg>)>,
}

/// To `depth` [m] in the first half of the `steps` [s], and back in the second half.
fn in_and_out(depth: f64, steps: &[f64]) -> Vec<Leg> {
    let (there, back) = steps.split_at(steps.len() / 2);
    let legs = [(there, depth), (back, -depth)].into_iter().flat_map(|(steps, way)| {
        let rate = way / steps.iter().sum::<f64>();
        steps.iter().map(move |step| Leg { rate, acceleration: 0.0, step: *step })
    });
    legs.collect()
}

/// All motions; those with the size of the scene's impact reach `depth` [m].
fn motions(depth: f64, quick: bool, surface: Surface) -> Vec<Motion> {
    let (cycles, still) = if quick { (10_000, 1_000_000) } else { (100_000, 100_000_000) };
    let motion = |name: &str, parts| Motion { name: name.into(), depth, step: 1.0, yields: 1, parts };
    let once = |depth: f64, steps: &[f64]| vec![(1, in_and_out(depth, steps))];
    let alternating: [f64; 32] = std::array::from_fn(|index| if index % 2 == 0 { 1e-12 } else { 1.0 });
    let whole = in_and_out(depth, &[1.0, 1.0]);
    // 4 d t (1 - t): the largest indentation in the middle of a step of one second
    let within_one = Leg { rate: 4.0 * depth, acceleration: -8.0 * depth, step: 1.0 };
    let chatter = vec![(1, whole.clone()), (cycles, in_and_out(1e-12 * depth, &[1e-6, 1e-6]))];
    let rest = Leg { rate: 0.0, acceleration: 0.0, step: 1.0 };
    let (into, out) = whole.split_at(1);
    let rest = vec![(1, into.to_vec()), (still, vec![rest]), (1, out.to_vec())];
    let lengths = [1e-15, 1e-9, 1e-3, 1.0, 1e6];
    let by_length = |step| Motion { step, ..motion(&format!("{step:e} s steps"), once(depth, &[step; 32])) };
    let mut all: Vec<Motion> = lengths.map(by_length).into();
    all.extend([
        motion("steps of 1e-12 s and 1 s in turn", once(depth, &alternating)),
        motion("in and out within one step", vec![(1, vec![within_one])]),
        motion("chatter at the surface after the impact", chatter),
        motion(&format!("{still} steps at rest in the dent"), rest),
    ]);
    let by_depth = |depth| Motion { depth, ..motion(&format!("indentation of {depth:e} m"), once(depth, &[1.0, 1.0])) };
    all.extend([5e-324, 1e-300, 1e-30, 1e30, 1e39].map(by_depth));
    // a fresh surface yields each time
    let yields = if surface == Surface::Fresh { cycles } else { 1 };
    all.push(Motion { yields, ..motion(&format!("{cycles} load cycles at one dent"), vec![(cycles, whole)]) });
    all
}

impl Motion {
    /// Runs the motion; the force [N] and the dissipated energy [J] at its end.
    fn run(&self, contact: &mut Contact, bodies: &Bodies) -> Result<(f64, f64), ImportError> {
        bodies.start(contact)?;
        let mut held = f64::NAN;
        for (times, legs) in &self.parts {
            for Leg { rate, acceleration, step } in (0..*times).flat_map(|_| legs) {
                // a rate holds until it is set again
                if *rate != held {
                    contact.set_rate(*rate)?;
                    held = *rate;
                }
                if *acceleration != 0.0 {
                    contact.set_derivatives(&[*acceleration])?;
                }
                contact.step(*step)?;
            }
        }
        Ok((contact.force()?, contact.output("dissipated_energy")?))
    }

    /// Runs the motion and compares the dissipated energy.
    fn judge(self, contact: &mut Contact, bodies: &Bodies, model: &Model<AnyLoading, AnyUnloading>) -> Case {
        let Motion { depth, yields, .. } = self;
        let once = model.loading.work(&model.pair, depth);
        let (work, recovered) = (f64::from(yields) * once, f64::from(yields) * model.recovered_work(depth, depth));
        // a law that creates energy may keep the contact closed beyond the original surface, where the motion ends
        let holds_on = model.unloading_path(depth).lower < 0.0;
        let left = if holds_on { model.unloading_segment(depth, 0.0).force(0.0) } else { 0.0 };
        let largest = model.loading.segment(&model.pair, depth).force(depth);
        let finding = self.run(contact, bodies).map(|(force, dissipated)| Finding {
            // an elastic contact may show the rounding of the path
            force_error: if largest > 0.0 { (force - left).abs() / largest } else { force.abs() },
            // the energy of a tiny indentation underflows
            energy_error: if work > 0.0 { (dissipated - (work - recovered)).abs() / work } else { dissipated.abs() },
            law_gains: recovered > work * (1.0 + EXACT),
        });
        Case::new(&self.name, depth, self.step, EXACT).judged(
            contact,
            bodies,
            model.loading.contact_radius(&model.pair, depth),
            finding,
        )
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
