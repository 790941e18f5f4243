//! Histories in two tangential directions, and a contact that follows them.

use crate::friction::hertz;
use crate::physics::Random;
use brinell_contact::Segment;
use brinell_contact::tangential::{Motion, PlayOperator};
use std::f64::consts::PI;

pub const MODULUS: f64 = 2e11;
pub const RADIUS: f64 = 5e-3;
pub const DEEPEST: f64 = 2e-5;

/// A step: changes of the indentation and of the scaled tangential displacement [m].
pub type Step = (f64, [f64; 2]);

pub fn length([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

pub fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    length([one[0] - other[0], one[1] - other[1]])
}

/// A number of either sign, with a size of up to five decades below `largest`.
fn any_size(random: &mut Random, largest: f64) -> f64 {
    let size = largest * 10f64.powf(-5.0 * random.next());
    if random.next() < 0.5 { size } else { -size }
}

/// Steps of any size over five decades, some of one motion only, some along one line, some out of contact.
pub fn any_sizes(seed: u64, length: usize) -> Vec<Step> {
    let mut random = Random(seed);
    let (mut indentation, mut angle): (f64, f64) = (0.0, 0.0);
    let step = |_| {
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
        (rise, [shift * angle.cos(), shift * angle.sin()])
    };
    (0..length).map(step).collect()
}

/// Steps like those of the table `two`: after the pressing, tangential displacements of a third of the indentation, normally
/// distributed, and changes of the indentation by up to a half.
pub fn like_the_table(seed: u64, length: usize) -> Vec<Step> {
    let mut random = Random(seed);
    let mut indentation = 1e-5;
    let mut steps = vec![(indentation, [3e-7, 3.8e-6])];
    while steps.len() < length {
        let rise = 6e-6 * any_size(&mut random, 1.0);
        let rise = rise.signum() * (rise.abs() / 6e-6).powf(0.4) * 6e-6;
        let rise = [rise, -rise, 0.0].into_iter().find(|rise| (1e-6..1.2e-5).contains(&(indentation + rise)));
        let rise = rise.unwrap_or(0.0);
        indentation += rise;
        let size = 3.6e-6 * (-2.0 * (1.0 - random.next()).ln()).sqrt();
        let (sine, cosine) = (2.0 * PI * random.next()).sin_cos();
        steps.push((rise, [size * cosine, size * sine]));
    }
    steps
}

/// Circles of the tangential displacement, of any size, with a swinging indentation.
pub fn circles(seed: u64, length: usize) -> Vec<Step> {
    let mut random = Random(seed);
    let (size, turn) = (1e-5 * 10f64.powf(-2.0 * random.next()), 0.05 + 1.5 * random.next());
    let (swing, phase) = (8e-6 * random.next(), 6.0 * random.next());
    let at = |index: usize| {
        let angle = turn * index as f64;
        (swing * (0.37 * angle + phase).sin(), [size * (angle.cos() - 1.0), size * angle.sin()])
    };
    let steps = (1..length).map(|index| {
        let ((height, [x, y]), (next, [next_x, next_y])) = (at(index - 1), at(index));
        (next - height, [next_x - x, next_y - y])
    });
    core::iter::once((1e-5, [0.0, 0.0])).chain(steps).collect()
}

/// A contact on Hertz's curve that goes from step to step.
#[derive(Clone, Copy)]
pub struct Run<const N: usize> {
    pub curve: Segment,
    pub stuck: PlayOperator<2, N>,
    pub indentation: f64,
}

impl<const N: usize> Run<N> {
    pub fn new() -> Run<N> {
        Run { curve: hertz(MODULUS, RADIUS), stuck: PlayOperator::APART, indentation: 0.0 }
    }

    pub fn step(&mut self, (rise, shift): Step) {
        self.stuck.advance(&self.curve, &Motion::straight(self.indentation, self.indentation + rise, shift));
        self.indentation += rise;
    }

    /// One step in equal `parts`.
    pub fn in_parts(&mut self, (rise, shift): Step, parts: u32) {
        let (from, share) = (self.indentation, 1.0 / f64::from(parts));
        for part in 1..=parts {
            let to = from + rise * (f64::from(part) * share);
            let part = shift.map(|shift| shift * share);
            let way = Motion { from: self.indentation, to, shift: part, normal: rise, tangential: shift };
            self.stuck.advance(&self.curve, &way);
            self.indentation = to;
        }
    }

    /// One step in equal `parts`. Returns the work of the pull over the step, with `then` called after each part.
    pub fn divided(&mut self, (rise, shift): Step, parts: u32, mut then: impl FnMut(&Self)) -> f64 {
        let from = self.indentation;
        let share = 1.0 / f64::from(parts);
        let mut work = 0.0;
        for part in 1..=parts {
            let to = from + rise * (f64::from(part) * share);
            let shift_of_part = shift.map(|shift| shift * share);
            let way = Motion { from: self.indentation, to, shift: shift_of_part, normal: rise, tangential: shift };
            let mean = self.stuck.mean_pull(&self.curve, &way);
            work += mean[0] * shift_of_part[0] + mean[1] * shift_of_part[1];
            self.stuck.advance(&self.curve, &way);
            self.indentation = to;
            then(self);
        }
        work
    }

    pub fn pull(&self) -> [f64; 2] {
        self.stuck.pull(&self.curve, self.indentation)
    }

    pub fn force(&self) -> f64 {
        self.curve.force(self.indentation)
    }

    pub fn energy(&self) -> f64 {
        self.stuck.energy(&self.curve, self.indentation)
    }
}
