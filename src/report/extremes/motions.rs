//! Extreme prescribed motions.

use super::impacts::Bodies;
use super::{Case, EXACT, Verdict};
use crate::importer::ImportError;
use crate::report::contact::Contact;
use crate::report::progress::{Progress, Work};
use brinell_contact::loading::AnyLoading;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Loading, Model, Surface};

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

/// Number of motions.
pub fn count(quick: bool) -> usize {
    motions(0.0, quick, Surface::Dented).len()
}

/// Runs all motions on the bodies of the scene, for which the dissipated energy is known.
pub fn run(contact: &mut Contact, bodies: &Bodies, quick: bool, progress: &Progress) -> Vec<Case> {
    let (Some(prediction), Some(model)) = (bodies.predict(), bodies.model.elastoplastic()) else { return Vec::new() };
    let motions = motions(prediction.max_indentation, quick, model.surface);
    let run = |motion: Motion| {
        progress.detail(&motion.name);
        let case = judge(contact, bodies, model, motion);
        progress.done(Work::Case);
        case
    };
    motions.into_iter().map(run).collect()
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

/// Runs `motion` and compares the dissipated energy.
fn judge(contact: &mut Contact, bodies: &Bodies, model: &Model<AnyLoading, AnyUnloading>, motion: Motion) -> Case {
    let Motion { name, depth, step, yields, run } = motion;
    let mut case = Case::new(&name, EXACT);
    (case.indentation, case.step) = (depth, step);
    let once = model.loading.work(&model.pair, depth);
    let (work, recovered) = (f64::from(yields) * once, f64::from(yields) * model.recovered_work(depth, depth));
    let segment = model.loading.segment(&model.pair, depth);
    // a law that creates energy may keep the contact closed beyond the original surface, where the motion ends
    let holds_on = model.unloading_path(depth).lower < 0.0;
    let left = if holds_on { model.unloading_segment(depth, 0.0).force(0.0) } else { 0.0 };
    case.makes_energy = recovered > work * (1.0 + EXACT);
    let ran = bodies.start(contact).and_then(|()| run(contact));
    let ended = ran.and_then(|()| Ok((contact.force()?, contact.output("dissipated_energy")?)));
    match ended {
        Err(error) => case.verdict = Verdict::Failed(error.to_string()),
        Ok((force, dissipated)) => {
            case.note_validity(contact, bodies, model.loading.contact_radius(&model.pair, depth));
            // the energy of a tiny indentation underflows
            let energy = if work > 0.0 { (dissipated - (work - recovered)).abs() / work } else { dissipated.abs() };
            // an elastic contact may show the rounding of the path
            let largest = segment.force(depth);
            case.errors = (if largest > 0.0 { (force - left).abs() / largest } else { force.abs() }, energy);
            case.judge(case.makes_energy || dissipated >= -EXACT * work);
        }
    }
    case
}
