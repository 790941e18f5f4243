//! Properties of every history of a contact with friction on an elastic curve.

use crate::friction::{assert_close, hertz};
use crate::physics::Random;
use brinell_contact::Segment;
use brinell_contact::tangential::{Friction, Motion, PlayOperator, Sliding};
use std::f64::consts::PI;

const MODULUS: f64 = 2e11;
const RADIUS: f64 = 5e-3;
const FRICTION: Friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };
const DEEPEST: f64 = 2e-5;

/// A number of either sign, with a size of up to five decades below `largest`.
fn any_size(random: &mut Random, largest: f64) -> f64 {
    let size = largest * 10f64.powf(-5.0 * random.next());
    if random.next() < 0.5 { size } else { -size }
}

/// Steps of a random history: changes of the indentation and of the scaled tangential displacement [m]. In some steps
/// only one of them changes.
fn history(seed: u64, length: usize) -> Vec<(f64, f64)> {
    let mut random = Random(seed);
    let mut indentation: f64 = 0.0;
    let mut steps = Vec::new();
    for _ in 0..length {
        let kind = random.next();
        let mut rise = if kind < 0.15 { 0.0 } else { any_size(&mut random, 1e-5) };
        let shift = if kind > 0.85 { 0.0 } else { any_size(&mut random, 1e-5) };
        if indentation + rise > DEEPEST || indentation + rise < -2e-6 {
            rise = -rise;
        }
        indentation += rise;
        steps.push((rise, shift));
    }
    steps
}

/// A contact on Hertz's curve that goes from step to step.
struct Run<const N: usize> {
    curve: Segment,
    stuck: PlayOperator<1, N>,
    indentation: f64,
}

impl<const N: usize> Run<N> {
    fn new(curve: Segment) -> Run<N> {
        Run { curve, stuck: PlayOperator::APART, indentation: 0.0 }
    }

    /// One step, divided into `parts`. Returns the mean force.
    fn step(&mut self, (rise, shift): (f64, f64), parts: u32) -> f64 {
        let from = self.indentation;
        let mut mean = 0.0;
        for part in 1..=parts {
            let to = from + rise * (f64::from(part) / f64::from(parts));
            let shift_of_part = shift / f64::from(parts);
            let way = Motion { from: self.indentation, to, shift: [shift_of_part], normal: rise, tangential: [shift] };
            mean += self.stuck.mean_pull(&self.curve, &way)[0] / f64::from(parts);
            self.stuck.advance(&self.curve, &way);
            self.indentation = to;
        }
        mean
    }

    fn pull(&self) -> f64 {
        self.stuck.pull(&self.curve, self.indentation)[0]
    }

    fn force(&self) -> f64 {
        self.curve.force(self.indentation)
    }

    fn energy(&self) -> f64 {
        self.stuck.energy(&self.curve, self.indentation)
    }
}

#[test]
fn a_step_divided_into_up_to_a_thousand_parts_ends_with_the_same_forces() {
    let largest = hertz(MODULUS, RADIUS).force(DEEPEST);
    let (mut worst, mut worst_mean) = (0.0_f64, 0.0_f64);
    for seed in 0..40 {
        for parts in [2, 3, 10, 101, 1000] {
            let mut whole = Run::<512>::new(hertz(MODULUS, RADIUS));
            let mut divided = Run::<512>::new(hertz(MODULUS, RADIUS));
            for step in history(seed, 30) {
                let mean = whole.step(step, 1);
                let mean_of_parts = divided.step(step, parts);
                worst = worst.max((whole.pull() - divided.pull()).abs() / largest);
                worst_mean = worst_mean.max((mean - mean_of_parts).abs() / largest);
            }
        }
    }
    println!("pull {worst:.1e}, mean {worst_mean:.1e}");
    assert!(worst < 1e-12, "pull: {worst:e}");
    assert!(worst_mean < 1e-11, "mean: {worst_mean:e}");
}

#[test]
fn the_stored_energy_is_never_negative_however_small_a_tangential_motion_is() {
    let mut random = Random(5);
    let size = |random: &mut Random, decades: f64| 10f64.powf(-5.0 - decades * random.next());
    let (mut largest, mut smallest) = (0.0_f64, f64::INFINITY);
    for seed in 0..3000 {
        let mut run = Run::<16>::new(hertz(MODULUS, RADIUS));
        for _ in 0..8 {
            let rise = size(&mut random, 14.0) * if random.next() < 0.3 { -1.0 } else { 1.0 };
            let rise = if run.indentation + rise > DEEPEST { -rise } else { rise };
            let shift = size(&mut random, 45.0) * if random.next() < 0.5 { -1.0 } else { 1.0 };
            run.step((rise, if random.next() < 0.4 { 0.0 } else { shift }), 1);
            let energy = run.energy();
            assert!(energy >= 0.0, "seed {seed}: {energy:e}");
            assert!(run.pull().abs() <= run.force().max(0.0), "seed {seed}: {:e}", run.pull());
            if energy > 0.0 {
                (largest, smallest) = (largest.max(energy), smallest.min(energy));
            }
        }
    }
    println!("energies from {smallest:.1e} to {largest:.1e} J");
    assert!(largest > 1e-6 && smallest < 1e-60, "{smallest:e} {largest:e}");
}

/// Many independent springs as a reference.
struct Springs {
    indentation: f64,
    displacement: f64,
    /// Height and offset; `None` before the spring touches.
    springs: Vec<(f64, Option<f64>)>,
    width: f64,
}

impl Springs {
    fn new(count: u32) -> Springs {
        let width = (RADIUS * 1.2 * DEEPEST).sqrt() / f64::from(count);
        let place = |index: u32| (f64::from(index) + 0.5) * width;
        let springs = (0..count).map(|index| (place(index).powi(2) / RADIUS, None)).collect();
        Springs { indentation: 0.0, displacement: 0.0, springs, width }
    }

    fn step(&mut self, (rise, shift): (f64, f64)) {
        let (from, start) = (self.indentation, self.displacement);
        self.indentation += rise;
        self.displacement += shift;
        for (height, offset) in &mut self.springs {
            if self.indentation <= *height {
                *offset = None;
                continue;
            }
            let touch = start + shift * if rise != 0.0 { (*height - from) / rise } else { 0.0 };
            let limit = self.indentation - *height;
            let stuck = offset.unwrap_or(touch);
            *offset = Some(stuck.clamp(self.displacement - limit, self.displacement + limit));
        }
    }

    fn pull(&self) -> f64 {
        let strain = |(_, offset): &(f64, Option<f64>)| offset.map_or(0.0, |offset| self.displacement - offset);
        2.0 * MODULUS * self.width * self.springs.iter().map(strain).sum::<f64>()
    }
}

#[test]
fn four_thousand_springs_have_the_same_tangential_force() {
    let largest = hertz(MODULUS, RADIUS).force(DEEPEST);
    let mut worst = 0.0_f64;
    for seed in 1000..1020 {
        let (mut run, mut springs) = (Run::<512>::new(hertz(MODULUS, RADIUS)), Springs::new(4000));
        for step in history(seed, 50) {
            run.step(step, 1);
            springs.step(step);
            worst = worst.max((run.pull() - springs.pull()).abs() / largest);
        }
    }
    println!("worst difference: {worst:.1e}");
    assert!(worst < 2e-6, "{worst:e}");
}

#[test]
fn a_cycle_at_constant_normal_force_dissipates_as_mindlin_and_deresiewicz_derived() {
    let curve = hertz(MODULUS, RADIUS);
    let indentation = 1e-5;
    let limit = FRICTION.coefficient * curve.force(indentation);
    let shear = FRICTION.stiffness_ratio * MODULUS / 4.0;
    let contact_radius = (RADIUS * indentation).sqrt();
    for part in [0.01_f64, 0.1, 0.5, 0.9, 0.999] {
        // displacement at a tangential force of `part` of the limit
        let amplitude = indentation * (1.0 - (1.0 - part).powf(2.0 / 3.0));
        let mut run = Run::<16>::new(curve);
        run.step((indentation, 0.0), 1);
        run.step((0.0, amplitude), 1);
        assert_close("force", FRICTION.coefficient * run.pull(), part * limit, limit, 1e-13);
        let stick = curve.stiffness(run.stuck.stick_height(indentation)) / (2.0 * MODULUS);
        assert_close("stick radius", stick, contact_radius * (1.0 - part).cbrt(), contact_radius, 1e-12);
        let mut lost = 0.0;
        for way in [-2.0 * amplitude, 2.0 * amplitude] {
            lost += FRICTION.coefficient / FRICTION.scale() * run.step((0.0, way), 1) * way;
        }
        let bracket = 1.0 - (1.0 - part).powf(5.0 / 3.0) - 5.0 * part / 6.0 * (1.0 + (1.0 - part).powf(2.0 / 3.0));
        let expected = 9.0 * limit * limit / (10.0 * contact_radius * shear) * bracket;
        assert_close(&format!("loss at {part}"), lost, expected, expected, 1e-12 / (part * part * part));
        assert_eq!(run.stuck.sliding(), Sliding::PartialSlip);
    }
}

/// The largest error of a list of sixteen segments on a path over `steps`, each to an indentation and a displacement
/// [m], relative to the force.
fn error_of_sixteen(steps: u32, place: impl Fn(f64) -> (f64, f64)) -> f64 {
    let curve = hertz(MODULUS, RADIUS);
    let (mut full, mut short) = (Run::<512>::new(curve), Run::<16>::new(curve));
    let (mut before, mut worst) = ((0.0, 0.0), 0.0_f64);
    for step in 1..=steps {
        let here = place(f64::from(step));
        let way = (here.0 - before.0, here.1 - before.1);
        before = here;
        full.step(way, 1);
        short.step(way, 1);
        worst = worst.max((full.pull() - short.pull()).abs() / full.force());
    }
    worst
}

#[test]
fn a_list_of_sixteen_is_close_to_one_that_is_never_full() {
    let quadrature = |step: f64| {
        let phase = 2.0 * PI * step / 200.0;
        (1e-5 * (1.0 + 0.6 * phase.sin()), 3e-6 * phase.cos())
    };
    let decaying = |step: f64| (1e-5, 8e-6 * (-step / 800.0).exp() * (2.0 * PI * step / 20.0).sin());
    let two_frequencies = |step: f64| {
        let wave = 0.3 * (step / 7.0).sin() + 0.25 * (step / 31.0).sin();
        (1e-5 * (1.0 + wave), 6e-6 * (step / 211.0).sin())
    };
    let ratchet = |step: f64| (1e-8 * step + 1e-6 * (step / 3.0).sin() + 2e-6, 2e-9 * step + 5e-7 * (step / 3.0).cos());
    let errors = [
        ("quadrature", error_of_sixteen(1000, quadrature)),
        ("decaying vibration", error_of_sixteen(800, decaying)),
        ("two frequencies", error_of_sixteen(2000, two_frequencies)),
        ("ratchet", error_of_sixteen(1000, ratchet)),
    ];
    for (name, error) in errors {
        println!("{name}: {error:.1e}");
        assert!(error < 1e-2, "{name}: {error:e}");
    }
}

#[test]
fn a_long_vibration_does_not_add_segments() {
    let mut run = Run::<16>::new(hertz(MODULUS, RADIUS));
    let mut random = Random(7);
    run.step((1e-5, 0.0), 1);
    let mut first = None;
    for cycle in 0..300 {
        for (rise, shift) in [(1e-6, 3e-6), (-1e-6, -4e-6), (0.0, 1e-6)] {
            let noise = |random: &mut Random| 1.0 + 1e-15 * (random.next() - 0.5);
            run.step((rise * noise(&mut random), shift * noise(&mut random)), 1);
        }
        if cycle == 1 {
            first = Some(run.pull());
        }
        assert!(run.stuck.segments() <= 4, "cycle {cycle}: {}", run.stuck.segments());
    }
    let first = first.expect("two cycles");
    assert_close("after 300 cycles", run.pull(), first, run.force(), 1e-12);
}

#[test]
fn the_derivative_of_the_force_is_the_limit_of_small_steps() {
    let curve = hertz(MODULUS, RADIUS);
    let mut checked = 0;
    for seed in 2000..2100 {
        let mut run = Run::<512>::new(curve);
        for step in history(seed, 20) {
            run.step(step, 1);
        }
        let mut random = Random(seed);
        let rates = (any_size(&mut random, 1e-3), any_size(&mut random, 1e-3));
        if run.indentation < 1e-6 {
            continue;
        }
        let time = 1e-12 / rates.0.abs().max(rates.1.abs());
        let (here, none) = (run.indentation, [0.0]);
        let way = Motion { from: here, to: here, shift: none, normal: rates.0, tangential: [rates.1] };
        let [[rate], _] = run.stuck.pull_rates(&curve, &way, (0.0, none));
        let before = run.pull();
        run.step((time * rates.0, time * rates.1), 1);
        let size = curve.stiffness(run.indentation) * rates.0.abs().max(rates.1.abs());
        assert_close(&format!("seed {seed}, {rates:?}"), (run.pull() - before) / time, rate, size, 1e-3);
        checked += 1;
    }
    assert!(checked > 30, "{checked}");
}

#[test]
fn a_stiffness_ratio_follows_from_the_bodies() {
    use brinell_contact::{Body, Pair};
    let steel = Body { radius: 5e-3, youngs_modulus: 206e9, poissons_ratio: 0.3 };
    let flat = Body { radius: f64::INFINITY, ..steel };
    let rigid = Body { radius: 5e-3, youngs_modulus: f64::INFINITY, poissons_ratio: 0.1 };
    for impactor in [steel, rigid] {
        let pair = Pair::new(&impactor, &flat, 3e8).expect("a ball on a plane");
        let ratio = Friction::between(&impactor, &flat, pair.modulus, 0.3).stiffness_ratio;
        assert_close("4 G*/E*", ratio, 2.0 * 0.7 / 1.7, 1.0, 1e-15);
    }
}
