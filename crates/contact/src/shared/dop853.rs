//! The Runge-Kutta pair of order 8 with the two estimates of its error, of orders 5 and 3.
//!
//! Reference: E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer, 1993,
//! section II.5; the coefficients are those of its program DOP853.

use crate::numerics::{largest, quotient};
use libm::sqrt;

/// Number of slopes of a step.
pub const STAGES: usize = 12;

/// The numbers of one contact in the motion.
pub type Numbers = [f64; 4];

/// A weighted sum of slopes: the place of each, and its weight.
type Weights = &'static [(usize, f64)];

/// The weights of the earlier slopes in each stage.
const EARLIER: [Weights; STAGES] = [
    &[],
    &[(0, 0.05260015195876773)],
    &[(0, 0.0197250569845379), (1, 0.0591751709536137)],
    &[(0, 0.02958758547680685), (2, 0.08876275643042054)],
    &[(0, 0.2413651341592667), (2, -0.8845494793282861), (3, 0.924834003261792)],
    &[(0, 0.037037037037037035), (3, 0.17082860872947386), (4, 0.12546768756682242)],
    &[(0, 0.037109375), (3, 0.17025221101954405), (4, 0.06021653898045596), (5, -0.017578125)],
    &[
        (0, 0.03709200011850479),
        (3, 0.17038392571223998),
        (4, 0.10726203044637328),
        (5, -0.015319437748624402),
        (6, 0.008273789163814023),
    ],
    &[
        (0, 0.6241109587160757),
        (3, -3.3608926294469414),
        (4, -0.868219346841726),
        (5, 27.59209969944671),
        (6, 20.154067550477894),
        (7, -43.48988418106996),
    ],
    &[
        (0, 0.47766253643826434),
        (3, -2.4881146199716677),
        (4, -0.590290826836843),
        (5, 21.230051448181193),
        (6, 15.279233632882423),
        (7, -33.28821096898486),
        (8, -0.020331201708508627),
    ],
    &[
        (0, -0.9371424300859873),
        (3, 5.186372428844064),
        (4, 1.0914373489967295),
        (5, -8.149787010746927),
        (6, -18.52006565999696),
        (7, 22.739487099350505),
        (8, 2.4936055526796523),
        (9, -3.0467644718982196),
    ],
    &[
        (0, 2.273310147516538),
        (3, -10.53449546673725),
        (4, -2.0008720582248625),
        (5, -17.9589318631188),
        (6, 27.94888452941996),
        (7, -2.8589982771350235),
        (8, -8.87285693353063),
        (9, 12.360567175794303),
        (10, 0.6433927460157636),
    ],
];

/// The weights of the step itself.
const END: Weights = &[
    (0, 0.054293734116568765),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, 0.3111643669578199),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.04471061572777259),
];

/// The difference from a method of order 5.
const FIFTH: Weights = &[
    (0, 0.01312004499419488),
    (5, -1.2251564463762044),
    (6, -0.4957589496572502),
    (7, 1.6643771824549864),
    (8, -0.35032884874997366),
    (9, 0.3341791187130175),
    (10, 0.08192320648511571),
    (11, -0.022355307863886294),
];

/// The difference from a method of order 3.
const THIRD: Weights = &[
    (0, -0.18980075407240762),
    (5, 4.450312892752409),
    (6, 1.8915178993145003),
    (7, -5.801203960010585),
    (8, -0.4226823213237919),
    (9, -0.1521609496625161),
    (10, 0.20136540080403034),
    (11, 0.02265179219836082),
];

/// Smaller errors count as this one.
const LEAST: f64 = 1e-30;

/// The slopes of the numbers of one contact, or of another part of the motion, over a step.
#[derive(Clone, Copy, Debug)]
pub struct Slopes<const N: usize>([[f64; N]; STAGES]);

impl<const N: usize> Slopes<N> {
    /// No slopes yet.
    pub const NONE: Slopes<N> = Slopes([[0.0; N]; STAGES]);

    /// Stores the slopes of a `stage`.
    #[inline(always)]
    pub fn set(&mut self, stage: usize, slopes: [f64; N]) {
        if let Some(slot) = self.0.get_mut(stage) {
            *slot = slopes;
        }
    }

    #[inline(always)]
    fn sum(&self, weights: Weights) -> [f64; N] {
        let mut sum = [0.0; N];
        for &(stage, weight) in weights {
            if let Some(slopes) = self.0.get(stage) {
                for (number, slope) in sum.iter_mut().zip(slopes) {
                    *number += weight * slope;
                }
            }
        }
        sum
    }

    #[inline(always)]
    fn moved(&self, from: &[f64; N], length: f64, weights: Weights) -> [f64; N] {
        let mut to = *from;
        for (number, slope) in to.iter_mut().zip(self.sum(weights)) {
            *number += length * slope;
        }
        to
    }

    /// The numbers `from` at a `stage` of a step of this `length`.
    #[inline(always)]
    pub fn at_stage(&self, stage: usize, from: &[f64; N], length: f64) -> [f64; N] {
        self.moved(from, length, EARLIER.get(stage).copied().unwrap_or_default())
    }

    /// The numbers `from` after a step of this `length`.
    #[inline(always)]
    pub fn at_end(&self, from: &[f64; N], length: f64) -> [f64; N] {
        self.moved(from, length, END)
    }

    /// The two differences from methods of lower order, of a step of length 1.
    #[inline(always)]
    pub fn differences(&self) -> ([f64; N], [f64; N]) {
        (self.sum(FIFTH), self.sum(THIRD))
    }
}

/// The error of a step from its `fifth` and `third` differences, which are not negative.
pub fn error(fifth: f64, third: f64) -> f64 {
    let exists = fifth > 0.0 && third < 1e100 * fifth;
    let ratio = 0.1 * quotient(third, fifth, exists, 0.0);
    fifth / sqrt(1.0 + ratio * ratio)
}

/// The factor on a step with this `error`, as a multiple of the tolerance, after which it would be just below the tolerance;
/// NaN for an error that is none.
pub fn factor(error: f64) -> f64 {
    // in this order NaN stays NaN; the step is of order 8
    0.9 / sqrt(sqrt(sqrt(largest(LEAST, error))))
}

#[cfg(test)]
mod tests {
    use super::{STAGES, Slopes};

    /// The error at the end of an oscillation of one unit of time, in this number of steps.
    fn missed(steps: u32) -> f64 {
        let length = 1.0 / f64::from(steps);
        let mut numbers = [0.0, 1.0];
        for _ in 0..steps {
            let mut slopes = Slopes::NONE;
            for stage in 0..STAGES {
                let [way, speed] = slopes.at_stage(stage, &numbers, length);
                slopes.set(stage, [speed, -way]);
            }
            numbers = slopes.at_end(&numbers, length);
        }
        (numbers[0] - 1f64.sin()).abs()
    }

    #[test]
    fn the_error_falls_with_the_eighth_power_of_the_step() {
        let order = (missed(1) / missed(2)).log2();
        assert!((7.5..9.5).contains(&order), "{order}");
        assert!(missed(4) < 1e-12, "{:e}", missed(4));
    }

    #[test]
    fn an_error_that_is_no_number_makes_no_step_longer() {
        assert!(super::factor(f64::NAN).is_nan());
        assert!(super::factor(1.0) < 1.0 && super::factor(0.0) > 5.0 && super::error(0.0, 0.0) == 0.0);
    }
}
