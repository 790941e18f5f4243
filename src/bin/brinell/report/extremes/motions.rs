//! Motions that no sane master would make.

use super::impacts::Bodies;
use super::{Case, EXACT};
use crate::importer::ImportError;
use crate::report::unit::Contact;
use brinell::contact::{Loading, Surface};

/// Motions that are prescribed on the bodies of the scene, in and out again; what they dissipate is known.
pub fn run(contact: &mut Contact, bodies: &Bodies, quick: bool) -> Vec<Case> {
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
        contact.set_derivatives(&[-8.0 * depth, 0.0])?;
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
    let mut case = Case::new(name, EXACT);
    (case.indentation, case.step) = (depth, step);
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
