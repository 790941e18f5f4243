//! Friction in two directions: a table from another program, and properties of every history on an elastic curve.

#[path = "support/friction.rs"]
mod friction;
#[path = "support/physics.rs"]
mod physics;

use brinell::contact::Segment;
use brinell::contact::tangential::plane::{Stuck, Way};
use brinell::contact::tangential::{self, Friction};
use friction::{assert_close, hertz, table};
use physics::Random;
use std::f64::consts::PI;

const MODULUS: f64 = 2e11;
const RADIUS: f64 = 5e-3;
const FRICTION: Friction = Friction { coefficient: 0.3, stiffness_ratio: 1.4 / 1.7 };
const DEEPEST: f64 = 2e-5;

/// A list that is hardly ever full.
const UNBOUNDED: usize = 512;

/// A step: changes of the indentation and of the scaled tangential displacement [m].
type Step = (f64, [f64; 2]);

/// A number of either sign, with a size of up to five decades below `largest`.
fn any_size(random: &mut Random, largest: f64) -> f64 {
    let size = largest * 10f64.powf(-5.0 * random.next());
    if random.next() < 0.5 { size } else { -size }
}

/// Steps of a random history of `length` steps. In some steps only one of the motions changes; some are collinear.
fn history(seed: u64, length: usize) -> Vec<Step> {
    let mut random = Random(seed);
    let (mut indentation, mut angle): (f64, f64) = (0.0, 0.0);
    let mut steps = Vec::new();
    for _ in 0..length {
        let kind = random.next();
        let mut rise = if kind < 0.15 { 0.0 } else { any_size(&mut random, 1e-5) };
        let shift = if kind > 0.85 { 0.0 } else { any_size(&mut random, 1e-5) };
        if random.next() < 0.8 {
            angle = 2.0 * PI * random.next();
        }
        if indentation + rise > DEEPEST || indentation + rise < -2e-6 {
            rise = -rise;
        }
        indentation += rise;
        steps.push((rise, [shift * angle.cos(), shift * angle.sin()]));
    }
    steps
}

fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    length([one[0] - other[0], one[1] - other[1]])
}

/// A contact on Hertz's curve that goes from step to step.
#[derive(Clone, Copy)]
struct Run<const N: usize> {
    curve: Segment,
    stuck: Stuck<N>,
    indentation: f64,
}

impl<const N: usize> Run<N> {
    fn new() -> Run<N> {
        Run { curve: hertz(MODULUS, RADIUS), stuck: Stuck::APART, indentation: 0.0 }
    }

    fn step(&mut self, (rise, shift): Step) {
        self.stuck.advance(&self.curve, &Way::straight(self.indentation, self.indentation + rise, shift));
        self.indentation += rise;
    }

    /// One step in equal `parts`. Returns the work of the pull over the step, with `then` called after each part.
    fn divided(&mut self, (rise, shift): Step, parts: u32, mut then: impl FnMut(&Self)) -> f64 {
        let from = self.indentation;
        let share = 1.0 / f64::from(parts);
        let mut work = 0.0;
        for part in 1..=parts {
            let to = from + rise * (f64::from(part) * share);
            let shift_of_part = shift.map(|shift| shift * share);
            let way = Way { from: self.indentation, to, shift: shift_of_part, normal: rise, tangential: shift };
            let mean = self.stuck.mean_pull(&self.curve, &way);
            work += mean[0] * shift_of_part[0] + mean[1] * shift_of_part[1];
            self.stuck.advance(&self.curve, &way);
            self.indentation = to;
            then(self);
        }
        work
    }

    fn pull(&self) -> [f64; 2] {
        self.stuck.pull(&self.curve, self.indentation)
    }

    fn force(&self) -> f64 {
        self.curve.force(self.indentation)
    }

    fn energy(&self) -> f64 {
        self.stuck.energy(&self.curve, self.indentation)
    }
}

#[test]
fn a_history_that_turns_has_the_forces_and_energies_of_the_table() {
    let kappa = FRICTION.scale();
    let (mut run, mut short) = (Run::<UNBOUNDED>::new(), Run::<16>::new());
    let (mut worst, mut worst_of_sixteen) = (0.0_f64, 0.0_f64);
    for (index, row) in table("two").iter().enumerate() {
        let step = (row.get("d_delta"), [kappa * row.get("d_s1"), kappa * row.get("d_s2")]);
        run.step(step);
        short.step(step);
        assert_close(&format!("row {index}, force"), run.force(), row.get("F"), 600.0, 1e-13);
        let size = FRICTION.coefficient * run.force();
        let expected = [row.get("T1"), row.get("T2")];
        let pull = run.pull().map(|pull| FRICTION.coefficient * pull);
        for (found, expected) in pull.into_iter().zip(expected) {
            assert_close(&format!("row {index}, tangential force"), found, expected, size, 1e-12);
        }
        let energy = FRICTION.coefficient / kappa * run.energy();
        assert_close(&format!("row {index}, energy"), energy, row.get("energy"), 1e-4, 1e-12);
        assert_eq!(run.stuck.segments(), row.get("segments") as usize, "row {index}");
        worst = worst.max(distance(pull, expected) / size);
        let pull = short.pull().map(|pull| FRICTION.coefficient * pull);
        worst_of_sixteen = worst_of_sixteen.max(distance(pull, expected) / size);
    }
    println!("worst error of T: {worst:.1e} of mu F; with sixteen segments {worst_of_sixteen:.1e}");
    assert!(worst_of_sixteen < 2e-3, "{worst_of_sixteen:e}");
}

#[test]
fn motion_along_one_line_has_nearly_the_force_and_energy_of_one_direction() {
    let curve = hertz(MODULUS, RADIUS);
    let (mut worst, mut worst_energy, mut across) = (0.0_f64, 0.0_f64, 0.0_f64);
    for seed in 0..300 {
        let angle: f64 = [0.0, 0.5 * PI, PI, 0.3, 2.0, 4.0, 5.5, 1e-9][seed as usize % 8];
        let direction = [angle.cos(), angle.sin()];
        let mut run = Run::<UNBOUNDED>::new();
        let mut line = tangential::Stuck::<UNBOUNDED>::APART;
        let mut random = Random(seed);
        for (rise, shift) in history(seed, 60) {
            let way = if random.next() < 0.5 { length(shift) } else { -length(shift) };
            let to = run.indentation + rise;
            line.advance(&curve, &tangential::Way::straight(run.indentation, to, way));
            run.step((rise, direction.map(|part| part * way)));
            if to <= 1e-6 {
                continue;
            }
            let (pull, expected) = (run.pull(), line.pull(&curve, to));
            let along = pull[0] * direction[0] + pull[1] * direction[1];
            worst = worst.max((along - expected).abs() / run.force());
            across = across.max((pull[1] * direction[0] - pull[0] * direction[1]).abs() / run.force());
            worst_energy = worst_energy.max((run.energy() - line.energy(&curve, to)).abs() / curve.work(to));
        }
    }
    println!("force {worst:.1e}, across {across:.1e}, energy {worst_energy:.1e}");
    assert!(worst <= 5e-9 && across <= 1e-12, "{worst:e} {across:e}");
    assert!(worst_energy <= 5e-9, "{worst_energy:e}");
}

/// Many independent springs as a reference.
struct Springs {
    indentation: f64,
    displacement: [f64; 2],
    /// Height and offset; `None` before the spring touches.
    springs: Vec<(f64, Option<[f64; 2]>)>,
    width: f64,
}

impl Springs {
    fn new(count: u32) -> Springs {
        let width = (RADIUS * 1.2 * DEEPEST).sqrt() / f64::from(count);
        let place = |index: u32| (f64::from(index) + 0.5) * width;
        let springs = (0..count).map(|index| (place(index).powi(2) / RADIUS, None)).collect();
        Springs { indentation: 0.0, displacement: [0.0; 2], springs, width }
    }

    /// Moves all springs by one of many small parts of a step. A spring that exceeds its limit goes straight back to it.
    fn step(&mut self, (rise, shift): Step) {
        let (from, start) = (self.indentation, self.displacement);
        self.indentation += rise;
        for (displacement, shift) in self.displacement.iter_mut().zip(shift) {
            *displacement += shift;
        }
        for (height, offset) in &mut self.springs {
            let limit = self.indentation - *height;
            if limit <= 0.0 {
                *offset = None;
                continue;
            }
            let part = if rise != 0.0 { (*height - from) / rise } else { 0.0 };
            let touch = [start[0] + part * shift[0], start[1] + part * shift[1]];
            let stuck = offset.unwrap_or(touch);
            let tension = distance(self.displacement, stuck);
            let back = if tension > limit { limit / tension } else { 1.0 };
            let [x, y] = self.displacement;
            *offset = Some([x - back * (x - stuck[0]), y - back * (y - stuck[1])]);
        }
    }

    fn pull(&self) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (_, offset) in &self.springs {
            if let Some([x, y]) = offset {
                sum[0] += self.displacement[0] - x;
                sum[1] += self.displacement[1] - y;
            }
        }
        sum.map(|sum| 2.0 * MODULUS * self.width * sum)
    }
}

/// The largest difference between lists and springs over these `seeds`, relative to the force, for lists with steps in
/// 1, 8 and 64 parts. The springs move in `fine` parts. Contacts shallower than 1e-6 m, with few springs, are left out.
fn errors<const N: usize>(seeds: std::ops::Range<u64>, count: u32, fine: u32) -> [f64; 3] {
    const PARTS: [u32; 3] = [1, 8, 64];
    let mut worst = [0.0_f64; 3];
    for seed in seeds {
        let mut runs = PARTS.map(|_| Run::<N>::new());
        let mut springs = Springs::new(count);
        for (rise, shift) in history(seed, 25) {
            let share = 1.0 / f64::from(fine);
            for _ in 0..fine {
                springs.step((rise * share, shift.map(|shift| shift * share)));
            }
            for ((run, parts), worst) in runs.iter_mut().zip(PARTS).zip(&mut worst) {
                run.divided((rise, shift), parts, |_| ());
                if run.indentation > 1e-6 {
                    *worst = worst.max(distance(run.pull(), springs.pull()) / run.force());
                }
            }
        }
    }
    worst
}

#[test]
fn many_vector_springs_have_a_tangential_force_within_three_hundredths() {
    let errors = errors::<16>(1000..1012, 1500, 300);
    println!("16 segments, steps in 1, 8 and 64 parts: {errors:?}");
    assert!(errors.iter().all(|&error| error < 3e-2), "{errors:?}");
}

/// The largest excess over Coulomb's bound, and the largest friction work below zero relative to the largest energy, if
/// each step is divided into `parts`.
fn bounds<const N: usize>(seeds: std::ops::Range<u64>, parts: u32) -> (f64, f64) {
    let scale = hertz(MODULUS, RADIUS).work(DEEPEST);
    let (mut excess, mut gain) = (0.0_f64, 0.0_f64);
    for seed in seeds {
        let mut run = Run::<N>::new();
        let mut energy = 0.0;
        for step in history(seed, 60) {
            let work = run.divided(step, parts, |run| {
                excess = excess.max(length(run.pull()) / run.force().max(f64::MIN_POSITIVE) - 1.0);
            });
            let lost = work - (run.energy() - energy);
            energy = run.energy();
            gain = gain.max(-lost / scale);
            assert!(energy >= -1e-13 * scale, "seed {seed}: {energy:e}");
        }
    }
    (excess, gain)
}

#[test]
fn the_tangential_force_never_exceeds_coulombs_bound_and_friction_hardly_does_work() {
    // the work of a step is integrated by Simpson's rule in each part
    for (parts, tolerance) in [(1, 1e-3), (8, 1e-4)] {
        let (excess, gain) = bounds::<UNBOUNDED>(100..140, parts);
        println!("{UNBOUNDED} segments, {parts} parts: {excess:.1e} {gain:.1e}");
        assert!(excess <= 1e-12 && gain <= tolerance, "{excess:e} {gain:e}");
        let (excess, gain) = bounds::<16>(100..300, parts);
        println!("16 segments, {parts} parts: {excess:.1e} {gain:.1e}");
        assert!(excess <= 1e-12 && gain <= tolerance, "{excess:e} {gain:e}");
    }
}

#[test]
fn a_rotated_history_has_the_rotated_force_within_a_hundredth() {
    let mut worst = 0.0_f64;
    for seed in 500..600 {
        let angle = 0.1 * seed as f64;
        let (sine, cosine) = angle.sin_cos();
        let rotated = |[x, y]: [f64; 2]| [cosine * x - sine * y, sine * x + cosine * y];
        let (mut run, mut other) = (Run::<16>::new(), Run::<16>::new());
        for (rise, shift) in history(seed, 60) {
            run.step((rise, shift));
            other.step((rise, rotated(shift)));
            if run.indentation > 0.0 {
                worst = worst.max(distance(rotated(run.pull()), other.pull()) / run.force());
            }
        }
    }
    println!("worst difference: {worst:.1e}");
    assert!(worst < 1e-2, "{worst:e}");
}

#[test]
fn restored_springs_continue_with_the_same_bits() {
    for seed in 3000..3030 {
        let mut run = Run::<16>::new();
        for step in history(seed, 40) {
            let mut words = Vec::new();
            run.stuck.save(&mut |word| words.push(word));
            assert_eq!(words.len(), Stuck::<16>::WORDS);
            let stuck = Stuck::load(&mut words.iter().copied(), &run.curve).expect("words of a contact");
            let mut other = Run::<16> { stuck, ..run };
            run.step(step);
            other.step(step);
            assert_eq!(run.pull().map(f64::to_bits), other.pull().map(f64::to_bits), "seed {seed}");
            assert_eq!(run.energy().to_bits(), other.energy().to_bits(), "seed {seed}");
        }
    }
}

#[test]
fn damaged_words_are_rejected() {
    let mut run = Run::<16>::new();
    run.step((1e-6, [1e-7, 2e-7]));
    let mut words = Vec::new();
    run.stuck.save(&mut |word| words.push(word));
    let load = |words: &[u64]| Stuck::<16>::load(&mut words.iter().copied(), &run.curve);
    assert!(load(&words).is_some());
    assert!(load(&words[1..]).is_none(), "a word is missing");
    for (place, word) in [(0, f64::NAN.to_bits()), (4, 17), (6, f64::INFINITY.to_bits())] {
        let mut damaged = words.clone();
        damaged[place] = word;
        assert!(load(&damaged).is_none(), "word {place}");
    }
}
