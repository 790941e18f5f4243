//! Stiff and extreme cases: impacts far from the scene's, and motions that no sane master would make, each judged.

use super::data::{Table, number, text};
use super::unit::Contact;
use super::ways::LEAP_FROG;
use crate::importer::ImportError;
use crate::model::AnyModel;
use crate::scene::Scene;
use brinell::contact::impact::{Impact, Prediction};
use brinell::contact::{Loading, Surface};

/// Largest error of an impact by leap-frog: of the energy relative to the incoming one, of the force relative to itself.
pub const TOLERANCE: f64 = 0.01;

/// Largest error of the dissipated energy of a motion that is prescribed, relative to the work of its loading.
pub const EXACT: f64 = 1e-9;

/// Beyond this contact radius over the sphere's radius no law of small contacts holds.
const WIDE: f64 = 0.3;

/// What came out of a case.
pub struct Case {
    pub name: String,
    /// Of the case [m], [s].
    pub indentation: f64,
    pub step: f64,
    /// Contact radius over the sphere's.
    pub width: f64,
    /// Of force and energy.
    pub errors: (f64, f64),
    pub tolerance: f64,
    /// Why it failed.
    pub failure: Option<String>,
}

/// Bodies and impact that are not the scene's.
struct Bodies {
    parameters: Vec<(&'static str, f64)>,
    model: AnyModel,
    impact: Impact,
    radius: f64,
}

/// Factors to the scene: target's Young's modulus [Pa], yield strain, radius [m], speed [m/s]; none: as in the scene.
#[derive(Clone, Copy, Default)]
struct Change {
    modulus: Option<f64>,
    strain: Option<f64>,
    radius: Option<f64>,
    speed: Option<f64>,
}

impl Bodies {
    /// The bodies of `scene` with a `change`: the yield strain stays if it isn't changed, and the mass grows as the volume.
    fn of(scene: &Scene, change: Change) -> Option<Bodies> {
        let old = |name| scene.value(name).unwrap_or(f64::NAN);
        let (old_modulus, old_radius) = (old("target.youngs_modulus"), old("impactor.radius"));
        let modulus = change.modulus.unwrap_or(old_modulus);
        let radius = change.radius.unwrap_or(old_radius);
        let mass = scene.impact.mass * (radius / old_radius).powi(3);
        let strain = change.strain.unwrap_or(old("target.yield_strength") / old_modulus);
        let all = [
            ("impactor.radius", radius),
            // a target that is a sphere, or a socket, keeps its shape
            ("target.radius", old("target.radius") * radius / old_radius),
            ("target.youngs_modulus", modulus),
            ("target.yield_strength", strain * modulus),
            ("effective_mass", mass),
        ];
        let mut changed = super::unit::first_contact(scene, None);
        let mut parameters = Vec::new();
        for (name, value) in all {
            if let Some(parameter) = changed.parameters.iter_mut().find(|parameter| parameter.name == name) {
                parameter.value = value;
                parameters.push((name, value));
            }
        }
        let asked = change.strain.is_none() || scene.value("target.yield_strength").is_some();
        let impact = Impact { mass, speed: change.speed.unwrap_or(scene.impact.speed) };
        asked.then(|| Bodies { parameters, model: changed.any_model(), impact, radius })
    }

    fn predict(&self) -> Option<Prediction> {
        self.model.predict(&self.impact)
    }

    fn start(&self, contact: &mut Contact) -> Result<(), ImportError> {
        let mut parameters = self.parameters.clone();
        parameters.push(("initial_gap", 0.0));
        contact.start(&parameters)
    }
}

/// The impacts: one quantity after the other, then the corners.
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

/// Runs all cases.
pub fn measure(contact: &mut Contact, scene: &Scene, quick: bool) -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, change) in changes() {
        // an elastic contact has no yield strain to change
        let Some(bodies) = Bodies::of(scene, change) else { continue };
        cases.push(impact(contact, name, &bodies, if quick { 256.0 } else { 1024.0 }));
    }
    if let (None, Some(bodies)) = (scene.damped, Bodies::of(scene, Change::default())) {
        cases.extend(motions(contact, &bodies, quick));
    }
    cases
}

/// Most steps of an impact.
const MOST: f64 = 2e6;

/// An impact by leap-frog with so many steps of its shorter half.
fn impact(contact: &mut Contact, name: String, bodies: &Bodies, steps: f64) -> Case {
    let mut case = Case {
        name,
        indentation: f64::NAN,
        step: f64::NAN,
        width: f64::NAN,
        errors: (f64::NAN, f64::NAN),
        tolerance: TOLERANCE,
        failure: None,
    };
    let Some(prediction) = bodies.predict() else {
        case.failure = Some("there is no prediction".into());
        return case;
    };
    case.indentation = prediction.max_indentation;
    case.width = prediction.max_contact_radius / bodies.radius;
    let shorter = prediction.loading_time.min(prediction.unloading_time);
    case.step = (shorter / steps).max(prediction.contact_time() / MOST);
    let Impact { mass, speed } = bodies.impact;
    let run = bodies.start(contact).and_then(|()| (LEAP_FROG.master)(contact, mass, speed, case.step));
    let rebound = match run {
        Ok(rebound) => rebound,
        Err(error) => {
            case.failure = Some(error.to_string());
            return case;
        }
    };
    let energy = (rebound.speed / speed).powi(2);
    case.errors = (
        (rebound.max_force / prediction.max_force - 1.0).abs(),
        (energy - prediction.rebound_energy / prediction.energy).abs(),
    );
    case.judge(energy <= 1.0 + TOLERANCE);
    case
}

impl Case {
    /// Fails the case if it isn't right to its tolerance, or if `passive` is false.
    fn judge(&mut self, passive: bool) {
        let (force, energy) = self.errors;
        // NaN is not right
        let right = |error: f64| error <= self.tolerance;
        self.failure = if !right(force) {
            Some(format!("the force is off by {force:e}"))
        } else if !right(energy) {
            Some(format!("the energy is off by {energy:e}"))
        } else if !passive {
            Some("it makes energy".into())
        } else {
            None
        };
    }
}

/// Motions that are prescribed on the bodies of the scene, in and out again; what they dissipate is known.
fn motions(contact: &mut Contact, bodies: &Bodies, quick: bool) -> Vec<Case> {
    let Some(prediction) = bodies.predict() else { return Vec::new() };
    let depth = prediction.max_indentation;
    let mut cases = Vec::new();
    let mut add =
        |name: String, depth: f64, step: f64, motion: &mut dyn FnMut(&mut Contact) -> Result<(), ImportError>| {
            cases.push(prescribed(contact, bodies, name, (depth, step, 1), motion));
        };
    for step in [1e-15, 1e-9, 1e-3, 1.0, 1e6] {
        add(format!("{step:e} s steps"), depth, step, &mut |contact| in_and_out(contact, depth, &[step; 32]));
    }
    let alternating: Vec<f64> = (0..32).map(|index| if index % 2 == 0 { 1e-12 } else { 1.0 }).collect();
    add("steps of 1e-12 s and 1 s in turn".into(), depth, 1.0, &mut |contact| in_and_out(contact, depth, &alternating));
    add("in and out within one step".into(), depth, 1.0, &mut |contact| {
        // 4 d t (1 - t): the largest indentation in the middle of a step of one second
        contact.set_rate(4.0 * depth)?;
        contact.set_derivatives([-8.0 * depth, 0.0])?;
        contact.step(1.0)
    });
    let cycles = if quick { 10_000 } else { 100_000 };
    add("chatter at the surface after the impact".into(), depth, 1.0, &mut |contact| {
        in_and_out(contact, depth, &[1.0, 1.0])?;
        (0..cycles).try_for_each(|_| in_and_out(contact, 1e-12 * depth, &[1e-6, 1e-6]))
    });
    let still = if quick { 1_000_000 } else { 100_000_000 };
    add(format!("{still} steps at rest in the dent"), depth, 1.0, &mut |contact| {
        contact.set_rate(depth)?;
        contact.step(1.0)?;
        contact.set_rate(0.0)?;
        (0..still).try_for_each(|_| contact.step(1.0))?;
        contact.set_rate(-depth)?;
        contact.step(1.0)
    });
    for depth in [5e-324, 1e-300, 1e-30, 1e30, 1e99] {
        let name = format!("indentation of {depth:e} m");
        add(name, depth, 1.0, &mut |contact| in_and_out(contact, depth, &[1.0, 1.0]));
    }
    // a surface that is fresh each time yields each time
    let fresh = bodies.model.elastoplastic().is_some_and(|model| model.surface == Surface::Fresh);
    let (name, yields) = (format!("{cycles} load cycles at one dent"), if fresh { cycles } else { 1 });
    cases.push(prescribed(contact, bodies, name, (depth, 1.0, yields), &mut |contact| {
        (0..cycles).try_for_each(|_| in_and_out(contact, depth, &[1.0, 1.0]))
    }));
    cases
}

/// To `depth` [m] in the first half of the `steps` [s], and back in the second.
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

/// Runs `motion`, which loads to `depth` [m] and yields there so many times, and compares what it has dissipated.
fn prescribed(
    contact: &mut Contact,
    bodies: &Bodies,
    name: String,
    (depth, step, yields): (f64, f64, u32),
    motion: &mut dyn FnMut(&mut Contact) -> Result<(), ImportError>,
) -> Case {
    let mut case = Case {
        name,
        indentation: depth,
        step,
        width: f64::NAN,
        errors: (f64::NAN, f64::NAN),
        tolerance: EXACT,
        failure: None,
    };
    let Some(model) = bodies.model.elastoplastic() else { return case };
    let once = model.loading.work(&model.pair, depth);
    let (work, recovered) = (f64::from(yields) * once, f64::from(yields) * model.recovered_work(depth, depth));
    let segment = model.loading.segment(&model.pair, depth);
    case.width = model.loading.contact_radius(&model.pair, depth) / bodies.radius;
    let run = bodies.start(contact).and_then(|()| motion(contact));
    let ended = run.and_then(|()| Ok((contact.force()?, contact.output("dissipated_energy")?)));
    match ended {
        Err(error) => case.failure = Some(error.to_string()),
        Ok((force, dissipated)) => {
            // the energy of a tiny indentation is below the smallest number
            let energy = if work > 0.0 { (dissipated - (work - recovered)).abs() / work } else { dissipated.abs() };
            // rounding of the path may leave a trace of an elastic contact
            let largest = segment.force(depth);
            case.errors = (if largest > 0.0 { force.abs() / largest } else { force.abs() }, energy);
            case.judge(dissipated >= -EXACT * work);
        }
    }
    case
}

/// The cases as a table.
pub fn table(cases: &[Case]) -> Table {
    let mut table = Table::new(
        "extremes",
        [
            ("case", ""),
            ("largest indentation", "m"),
            ("step", "s"),
            ("a/R", ""),
            ("error of force", ""),
            ("error of energy", ""),
            ("tolerance", ""),
            ("verdict", ""),
            ("warning", ""),
        ],
    );
    for case in cases {
        let verdict = case.failure.as_ref().map_or("right".into(), |why| format!("FAILED: {why}"));
        let warning = if case.width > WIDE { "a/R above 0.3: beyond the law's validity" } else { "" };
        table.rows.push(vec![
            text(&case.name),
            number(case.indentation),
            number(case.step),
            number(case.width),
            number(case.errors.0),
            number(case.errors.1),
            number(case.tolerance),
            text(verdict),
            text(warning),
        ]);
    }
    table
}
