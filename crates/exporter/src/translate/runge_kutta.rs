//! The pair of Runge-Kutta methods of orders 5 and 4 that follows motions whose law has no exact one.
//!
//! Reference: J. R. Dormand, P. J. Prince, *J. Comput. Appl. Math.* 6 (1980) 19-26.

use brinell_contact::numerics::largest;
use libm::pow;

/// The weights of the earlier slopes in each stage; the last stage is the step itself.
const STAGES: [[f64; 6]; 7] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// The difference between the methods of order 5 and 4.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Smaller errors count as this one.
const LEAST: f64 = 1e-30;

/// The numbers `from` after `step`, and the difference between the two methods. `slope` gives the derivatives by time; `None` if it has
/// none in a stage.
pub fn step<const N: usize>(
    from: &[f64; N],
    step: f64,
    mut slope: impl FnMut(&[f64; N]) -> Option<[f64; N]>,
) -> Option<([f64; N], [f64; N])> {
    let (mut slopes, mut next) = ([[0.0; N]; 7], *from);
    let add = |to: &mut [f64; N], weights: &[f64], slopes: &[[f64; N]]| {
        for (weight, slopes) in weights.iter().zip(slopes) {
            for (number, slope) in to.iter_mut().zip(slopes) {
                *number += step * weight * slope;
            }
        }
    };
    for (stage, weights) in STAGES.iter().enumerate() {
        next = *from;
        add(&mut next, weights, &slopes);
        if let Some(slot) = slopes.get_mut(stage) {
            *slot = slope(&next)?;
        }
    }
    let mut error = [0.0; N];
    add(&mut error, &ERROR, &slopes);
    Some((next, error))
}

/// The factor on a step with this relative `error` for which the error would be just below the `tolerance`; NaN for an error that is
/// none.
pub fn factor(tolerance: f64, error: f64) -> f64 {
    // in this order NaN stays NaN, and no step becomes longer by it
    0.9 * pow(tolerance / largest(LEAST, error), 0.2)
}
