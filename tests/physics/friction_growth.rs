//! Properties of every history of a yielding contact with friction, for all pairs of laws whose unloading is one segment.

use crate::friction;
use crate::physics::{self, AnyModel, Random, is_passive, mild, some_models, unit};
use brinell_contact::tangential::{Friction, Frictional, FrictionalModel, Mean, SpringsOf};
use brinell_contact::{Contact, History};
use brinell_contact::{loading::AnyLoading, unloading::AnyUnloading};
use brinell_testing::laws;
use std::f64::consts::PI;

pub const FRICTION: Friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };
/// The allowed error of two directions on a growing dent, relative to Coulomb's limit or to the work of a step.
const IN_TWO_DIRECTIONS: f64 = 3e-3;
/// Segments of the springs of an FMU.
const MEMORY: usize = 16;

pub type Model = FrictionalModel<AnyLoading, AnyUnloading>;

/// Whether a pair of laws, with its name, is passive in normal motion and supports friction.
pub fn has_friction((name, model): &(String, AnyModel)) -> bool {
    let unloading = name.rsplit(' ').next().expect("a law's name");
    is_passive(model) && laws::entry("unloading", unloading).get("no_friction").is_none()
}

/// All of them.
pub fn models() -> Vec<(String, Model)> {
    let models = some_models(mild()).into_iter().filter(has_friction);
    models.map(|(name, normal)| (name, FrictionalModel { normal, friction: FRICTION, loss: () })).collect()
}

/// The allowed error of friction for the pair of laws called `name`, relative to Coulomb's limit.
pub fn allowed(name: &str) -> f64 {
    let (loading, unloading) = name.split_once(" with ").expect("two laws");
    let entry = laws::entry("unloading", unloading);
    let of_pair = entry.get("friction_error_of").and_then(|errors| errors.get(loading));
    let error = of_pair.or(entry.get("friction_error")).and_then(|error| error.as_float());
    error.unwrap_or_else(|| panic!("{unloading} has an error of friction"))
}

/// Steps of a random history [m]: up to about a hundred yield indentations, with separations.
pub fn history(seed: u64, length: usize) -> Vec<(f64, f64)> {
    let mut random = Random(seed);
    let unit = unit(&mild()).indentation;
    let deepest = unit * 10f64.powf(0.3 + 2.2 * random.next());
    let mut indentation: f64 = 0.0;
    (0..length)
        .map(|_| {
            let mut size =
                || 0.5 * deepest * 10f64.powf(-3.0 * random.next()) * if random.next() < 0.5 { -1.0 } else { 1.0 };
            let (mut rise, slip) = (size(), 0.4 * size());
            if indentation + rise > deepest || indentation + rise < -0.1 * deepest {
                rise = -rise;
            }
            indentation += rise;
            (rise, slip)
        })
        .collect()
}

/// A contact with its springs in `D` directions.
#[derive(Clone, Copy)]
pub struct Run<const D: usize, const N: usize> {
    pub contact: History,
    pub springs: SpringsOf<D, N, true>,
}

impl<const D: usize, const N: usize> Run<D, N> {
    pub fn new(model: &Model) -> Self {
        let contact = History::start(&model.normal, 0.0).expect("within range");
        Run { contact, springs: SpringsOf::start(model, &contact) }
    }

    /// One step, divided into `parts`. Returns the work of the tangential force.
    pub fn step(&mut self, model: &Model, (rise, slip): (f64, [f64; D]), parts: u32) -> f64 {
        let part = 1.0 / f64::from(parts);
        let mut work = 0.0;
        for _ in 0..parts {
            let way = (rise * part, slip.map(|slip| slip * part));
            let mean = self.springs.advance_along(&mut self.contact, model, way, (rise, slip), Mean::Exact);
            work += mean.expect("within range").iter().zip(way.1).map(|(mean, way)| mean * way).sum::<f64>();
        }
        work
    }

    pub fn pull(&self) -> [f64; D] {
        self.springs.forces(&FRICTION, self.contact.indentation())
    }

    pub fn energy(&self) -> f64 {
        self.springs.energy(&FRICTION, self.contact.indentation())
    }
}

impl<const N: usize> Run<1, N> {
    fn go(&mut self, model: &Model, (rise, slip): (f64, f64), parts: u32) -> f64 {
        self.step(model, (rise, [slip]), parts)
    }
}

/// Random numbers whose first ones differ much between neighbouring seeds.
fn mixed(seed: u64) -> Random {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    for _ in 0..4 {
        random.next();
    }
    random
}

/// The distance of two points.
fn distance<const D: usize>(one: [f64; D], other: [f64; D]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other) * (one - other)).sum::<f64>().sqrt()
}

/// A way of the length `slip` [m]: in any direction of a plane, or along a line.
pub fn way_of<const D: usize>(slip: f64, random: &mut Random) -> [f64; D] {
    let angle = 2.0 * PI * random.next();
    std::array::from_fn(|direction| match (D, direction) {
        (1, _) => slip,
        (_, 0) => slip * angle.cos(),
        _ => slip * angle.sin(),
    })
}

/// Steps of random histories [m] over four decades of either sign: up to some three hundred yield indentations, or to a sixth
/// of the radius.
fn histories<const D: usize>(seed: u64) -> Vec<(f64, [f64; D])> {
    let mut random = mixed(seed);
    let depth = random.next();
    let deepest = match seed % 4 {
        3 => 0.15 * mild().radius * 10f64.powf(-2.5 * depth),
        _ => unit(&mild()).indentation * 10f64.powf(-0.1 + 2.6 * depth),
    };
    let mut indentation = 0.0;
    let steps = (0..12).map(|_| {
        let mut size = |positive: f64| {
            let sign = if random.next() < positive { 1.0 } else { -1.0 };
            sign * deepest * 10f64.powf(-4.0 * random.next())
        };
        let (mut rise, slip) = (size(0.65), 0.4 * size(0.5));
        if indentation + rise < -0.1 * deepest || indentation + rise > deepest {
            rise = -rise;
        }
        if indentation + rise > deepest {
            rise = 0.5 * (deepest - indentation);
        }
        indentation += rise;
        (rise, way_of(slip, &mut random))
    });
    steps.collect()
}

/// The errors of steps in comparison with their parts.
#[derive(Default)]
struct Errors {
    /// Of the tangential force after each step of a history, relative to Coulomb's limit.
    forces: Vec<f64>,
    /// Of the force after the steps in which the dent grew.
    growing: Vec<f64>,
    /// Of the stored energy and the work of a step that begins like its parts, relative to the largest work of the step and what was
    /// stored before.
    energy: f64,
    work: f64,
}

/// The errors of random histories of `model`, in `D` directions.
fn errors<const D: usize>(model: &Model, seeds: std::ops::Range<u64>, most_parts: f64, errors: &mut Errors) {
    for seed in seeds {
        let (mut at_once, mut divided) = (Run::<D, MEMORY>::new(model), Run::<D, MEMORY>::new(model));
        let mut random = mixed(seed + 900);
        let parts = most_parts.powf(random.next()).round() as u32;
        for step in histories::<D>(seed) {
            let (mut whole, before, depth) = (divided, divided.energy(), divided.contact.max_indentation());
            at_once.step(model, step, 1);
            let work = [whole.step(model, step, 1), divided.step(model, step, parts)];
            let limit = FRICTION.coefficient * divided.contact.force();
            if limit <= 0.0 {
                continue;
            }
            let error = distance(at_once.pull(), divided.pull()) / limit;
            errors.forces.push(error);
            if divided.contact.max_indentation() > depth {
                errors.growing.push(error);
            }
            let most = limit * distance(step.1, [0.0; D]) + before;
            errors.energy = errors.energy.max((whole.energy() - divided.energy()).abs() / most);
            errors.work = errors.work.max((work[0] - work[1]).abs() / most);
        }
    }
}

/// Checks every pairing over so many histories along a line and in a plane, and prints a line for each.
fn check_steps_of_any_length(along_a_line: u64, in_a_plane: u64) {
    let mut failed = Vec::new();
    for (name, model) in models() {
        let (mut line, mut plane) = (Errors::default(), Errors::default());
        errors::<1>(&model, 0..along_a_line, 400.0, &mut line);
        errors::<2>(&model, 0..in_a_plane, 400.0, &mut plane);
        let mut text = String::new();
        for (errors, least, most_energy) in [(&mut line, 0.0, 3e-3), (&mut plane, IN_TWO_DIRECTIONS, IN_TWO_DIRECTIONS)]
        {
            errors.forces.sort_by(f64::total_cmp);
            errors.growing.sort_by(f64::total_cmp);
            let worst = errors.forces[errors.forces.len() - 1];
            let median = errors.growing[errors.growing.len() / 2];
            text += &format!("  {worst:.1e} median {median:.1e} energy {:.1e} work {:.1e}", errors.energy, errors.work);
            // the mean force with `jackson` is off in one of two hundred histories
            let most_work = if name.ends_with("jackson") { 2e-2 } else { most_energy };
            let is_off = errors.energy > most_energy || errors.work > most_work;
            if worst > allowed(&name).max(least) || median > 1e-5 || is_off {
                failed.push(format!("{name}: {text}"));
            }
        }
        println!("{name:36} {text}");
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn a_step_of_any_length_is_that_of_its_parts_within_the_error_of_the_law() {
    check_steps_of_any_length(16, 4);
}

#[test]
#[ignore = "takes a minute"]
fn the_errors_of_the_laws_hold_over_many_histories() {
    check_steps_of_any_length(200, 32);
}

/// The largest change of the friction work, and of its sum with the stored energy, over short steps after the steps of random
/// histories, relative to what they were, beyond what such a step can do.
fn changes_of_short_steps<const D: usize>(model: &Model, seed: u64, shortest: f64) -> [f64; 2] {
    type Kind<const D: usize> = Frictional<D, MEMORY, true>;
    let mut contact = Kind::<D>::start(model, 0.0).expect("within range");
    let kept = <Kind<D> as Contact<Model>>::kept(model);
    let (mut random, mut largest) = (mixed(seed + 77), [0.0_f64; 2]);
    let time = 1e-6;
    for (index, (rise, slip)) in histories::<D>(seed).into_iter().enumerate() {
        // many small turns fill the list
        for part in 0..6 {
            let turned = if part % 2 == 0 { slip } else { way_of(distance(slip, [0.0; D]), &mut random) };
            contact.set_tangential_rates(turned.map(|slip| slip / 6.0 / time));
            contact.step_held(rise / 6.0 / time, time, &kept, || *model).expect("within range");
        }
        let mut short = contact;
        let length = shortest * 10f64.powf(-3.0 * (index % 3) as f64 / 2.0);
        short.set_tangential_rates(way_of(distance(slip, [0.0; D]) / time, &mut random));
        short.step_held(rise / time, length * time, &kept, || *model).expect("within range");
        let of = |contact: &Kind<D>| [contact.friction_work(model), contact.tangential_energy(model)];
        let ([lost, stored], [lost_after, stored_after]) = (of(&contact), of(&short));
        let limit = FRICTION.coefficient * contact.normal().force().max(short.normal().force());
        let possible = limit * distance(slip, [0.0; D]) * length;
        let scale = (lost + stored).max(1e-30);
        let beyond = |change: f64| (change.abs() - 2.0 * possible).max(0.0) / scale;
        largest[0] = largest[0].max(beyond(lost_after - lost));
        largest[1] = largest[1].max(beyond(lost_after + stored_after - lost - stored));
    }
    largest
}

/// Changes as text.
fn shown(changes: &[[f64; 2]]) -> String {
    let shown = changes.iter().flatten().map(|change| format!("{change:.1e}"));
    shown.collect::<Vec<_>>().join(" ")
}

#[test]
fn a_step_too_short_to_matter_hardly_changes_the_energies() {
    let mut failed = Vec::new();
    for (name, model) in models() {
        let mut worst = [[0.0_f64; 2]; 2];
        // with the seed 80 a step on a full list, part of which is steeper than the cones, once forgot more than it changed
        for seed in (0..20).chain([80]) {
            let found =
                [changes_of_short_steps::<1>(&model, seed, 1e-11), changes_of_short_steps::<2>(&model, seed, 1e-11)];
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = [worst[0].max(found[0]), worst[1].max(found[1])];
            }
        }
        println!("{name:36} {}", shown(&worst));
        // in two directions springs on an elastic curve may still be slightly beyond their limit, and return to it
        if worst[0].iter().any(|change| *change > 1e-6) || worst[1][0] > 2e-3 || worst[1][1] > 1e-3 {
            failed.push(format!("{name}: {}", shown(&worst)));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn before_yield_every_law_has_the_friction_of_hertz() {
    let hertz = FrictionalModel { normal: physics::model("hertz", "contact-radius"), friction: FRICTION, loss: () };
    for (name, model) in models() {
        let yields_at = model.normal.yield_point().indentation;
        if !(yields_at > 0.0 && yields_at < f64::INFINITY) {
            continue;
        }
        let (mut run, mut elastic) = (Run::<1, 12>::new(&model), Run::<1, 12>::new(&hertz));
        let mut random = Random(5);
        let mut indentation = 0.0;
        for _ in 0..40 {
            let target = yields_at * (1.1 * random.next() - 0.15);
            let target = if target > yields_at { 0.99 * yields_at } else { target };
            let step = (target - indentation, yields_at * (random.next() - 0.5));
            indentation = target;
            run.go(&model, step, 1);
            elastic.go(&hertz, step, 1);
            let size = 0.3 * hertz.normal.peak(yields_at).force;
            friction::assert_close(&name, run.pull()[0], elastic.pull()[0], size, 1e-12);
        }
    }
}

#[test]
fn a_fresh_surface_leaves_no_dent_for_the_springs() {
    let unit = unit(&mild()).indentation;
    for (name, mut model) in models() {
        model.normal.surface = brinell_contact::Surface::Fresh;
        let mut run = Run::<1, 12>::new(&model);
        run.go(&model, (50.0 * unit, 20.0 * unit), 10);
        let back = -unit - run.contact.indentation();
        run.go(&model, (back, 0.0), 1);
        let mut fresh = Run::<1, 12>::new(&model);
        fresh.go(&model, (-unit, 0.0), 1);
        for step in [(1.5 * unit, unit), (3.0 * unit, -0.5 * unit), (-2.0 * unit, 0.2 * unit), (4.0 * unit, unit)] {
            run.go(&model, step, 3);
            fresh.go(&model, step, 3);
            let size = 0.3 * model.normal.peak(6.0 * unit).force;
            friction::assert_close(&name, run.pull()[0], fresh.pull()[0], size, allowed(&name).max(1e-9));
        }
    }
}
