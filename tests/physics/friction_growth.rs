//! Properties of every history of a yielding contact with friction, for all pairs of laws whose unloading is one segment.

use crate::friction;
use crate::physics::{self, Random, all_models, is_passive, mild, unit};
use brinell_contact::History;
use brinell_contact::tangential::{Friction, Mean, RoughModel, Sliding, Springs};
use brinell_contact::{loading::AnyLoading, unloading::AnyUnloading};
use brinell_testing::laws;

pub const FRICTION: Friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };
const LATTICE: bool = true;

pub type Model = RoughModel<AnyLoading, AnyUnloading>;

/// Pairs of laws that are passive in normal motion and support friction.
pub fn models() -> Vec<(String, Model)> {
    let models = all_models(mild()).into_iter().filter(|(name, model)| {
        let unloading = name.rsplit(' ').next().expect("a law's name");
        is_passive(model) && laws::entry("unloading", unloading).get("no_friction").is_none()
    });
    models.map(|(name, normal)| (name, RoughModel { normal, friction: FRICTION, loss: () })).collect()
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

struct Run<const N: usize> {
    contact: History,
    springs: Springs<N, LATTICE>,
}

impl<const N: usize> Run<N> {
    fn new(model: &Model) -> Run<N> {
        let contact = History::start(&model.normal, 0.0).expect("within range");
        Run { contact, springs: Springs::start(model, &contact) }
    }

    /// One step, divided into `parts`. Returns the mean force.
    fn step(&mut self, model: &Model, (rise, slip): (f64, f64), parts: u32) -> f64 {
        let part = 1.0 / f64::from(parts);
        let mut mean = 0.0;
        for _ in 0..parts {
            let way = (rise * part, slip * part);
            mean += part
                * self.springs.advance(&mut self.contact, model, way, (rise, slip), Mean::Exact).expect("within range");
        }
        mean
    }

    fn pull(&self) -> f64 {
        self.springs.force(&FRICTION, self.contact.indentation())
    }

    fn energy(&self) -> f64 {
        self.springs.energy(&FRICTION, self.contact.indentation())
    }
}

#[test]
fn a_step_divided_into_parts_ends_with_the_same_force_within_the_error_of_the_law() {
    let mut failed = Vec::new();
    for (name, model) in models() {
        let mut worst = 0.0_f64;
        for seed in 0..30 {
            let (mut whole, mut divided) = (Run::<64>::new(&model), Run::<64>::new(&model));
            let mut largest = 0.0_f64;
            for step in history(seed, 25) {
                whole.step(&model, step, 1);
                divided.step(&model, step, 40);
                largest = largest.max(FRICTION.coefficient * whole.contact.force());
                worst = worst.max((whole.pull() - divided.pull()).abs() / largest.max(1e-30));
            }
        }
        println!("{name}: {worst:.1e}");
        if worst > allowed(&name) {
            failed.push(format!("{name}: {worst:.1e}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn the_force_keeps_coulombs_bound_and_friction_dissipates_energy() {
    let mut failed = Vec::new();
    for (name, model) in models() {
        let (mut excess, mut gain) = (0.0_f64, 0.0_f64);
        for seed in 100..140 {
            let mut run = Run::<12>::new(&model);
            let (mut lost, mut most, mut scale, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
            for step in history(seed, 40) {
                let before = run.energy();
                lost += run.step(&model, step, 4) * step.1 - (run.energy() - before);
                let force = run.contact.force();
                largest = largest.max(force);
                scale = scale.max(
                    model.friction.coefficient / model.friction.scale() * run.contact.elastic_energy(&model.normal),
                );
                excess = excess.max((run.pull().abs() - 0.3 * force) / (0.3 * largest).max(1e-30));
                most = most.max(lost);
                gain = gain.max((most - lost) / scale.max(1e-30));
                assert!(run.energy() >= -1e-12 * scale, "{name}, seed {seed}: {:e}", run.energy());
                assert_eq!(run.springs.sliding() == Sliding::Apart, run.contact.force() == 0.0, "{name}, seed {seed}");
            }
        }
        println!("{name}: above Coulomb's bound {excess:.1e}, friction work falls by {gain:.1e}");
        if excess > 1e-12 || gain > 1e-2 {
            failed.push(format!("{name}: {excess:.1e}, {gain:.1e}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn before_yield_every_law_has_the_friction_of_hertz() {
    let hertz = RoughModel { normal: physics::model("hertz", "contact-radius"), friction: FRICTION, loss: () };
    for (name, model) in models() {
        let yields_at = model.normal.yield_point().indentation;
        if !(yields_at > 0.0 && yields_at < f64::INFINITY) {
            continue;
        }
        let (mut run, mut elastic) = (Run::<12>::new(&model), Run::<12>::new(&hertz));
        let mut random = Random(5);
        let mut indentation = 0.0;
        for _ in 0..40 {
            let target = yields_at * (1.1 * random.next() - 0.15);
            let target = if target > yields_at { 0.99 * yields_at } else { target };
            let step = (target - indentation, yields_at * (random.next() - 0.5));
            indentation = target;
            run.step(&model, step, 1);
            elastic.step(&hertz, step, 1);
            let size = 0.3 * hertz.normal.peak(yields_at).force;
            friction::assert_close(&name, run.pull(), elastic.pull(), size, 1e-12);
        }
    }
}

#[test]
fn a_restored_contact_continues_with_the_same_bits() {
    for (name, model) in models() {
        for seed in 200..205 {
            let mut run = Run::<12>::new(&model);
            for step in history(seed, 30) {
                let mut words = Vec::new();
                run.springs.save(&mut |word| words.push(word));
                let springs =
                    Springs::load(&mut words.iter().copied(), &model, &run.contact).expect("words of a contact");
                let mut other = Run::<12> { contact: run.contact, springs };
                run.step(&model, step, 2);
                other.step(&model, step, 2);
                assert_eq!(run.pull().to_bits(), other.pull().to_bits(), "{name}, seed {seed}");
            }
        }
    }
}

#[test]
fn a_fresh_surface_leaves_no_dent_for_the_springs() {
    let unit = unit(&mild()).indentation;
    for (name, mut model) in models() {
        model.normal.surface = brinell_contact::Surface::Fresh;
        let mut run = Run::<12>::new(&model);
        run.step(&model, (50.0 * unit, 20.0 * unit), 10);
        let back = -unit - run.contact.indentation();
        run.step(&model, (back, 0.0), 1);
        let mut fresh = Run::<12>::new(&model);
        fresh.step(&model, (-unit, 0.0), 1);
        for step in [(1.5 * unit, unit), (3.0 * unit, -0.5 * unit), (-2.0 * unit, 0.2 * unit), (4.0 * unit, unit)] {
            run.step(&model, step, 3);
            fresh.step(&model, step, 3);
            let size = 0.3 * model.normal.peak(6.0 * unit).force;
            friction::assert_close(&name, run.pull(), fresh.pull(), size, allowed(&name).max(1e-9));
        }
    }
}
