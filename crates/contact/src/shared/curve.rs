//! A number of the motion over one step, as a polynomial: where it crosses zero.

use crate::numerics::quotient;
use libm::fabs;

/// A polynomial of order 5 of the part of a step, from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub struct Curve([f64; 6]);

/// Largest number of iterations in search of a root: Newton's method takes about five.
const STEPS: u32 = 80;

/// A correction of a root, as a part of the step, below which it is known.
const CONVERGED: f64 = 1e-14;

impl Curve {
    /// The polynomial with this value, slope and curvature at both ends.
    pub fn quintic([y0, s0, b0]: [f64; 3], [y1, s1, b1]: [f64; 3]) -> Curve {
        let (rise, first, second) = (y1 - y0 - s0 - 0.5 * b0, s1 - s0 - b0, b1 - b0);
        let cubic = 10.0 * rise - 4.0 * first + 0.5 * second;
        let fourth = -15.0 * rise + 7.0 * first - second;
        let fifth = 6.0 * rise - 3.0 * first + 0.5 * second;
        Curve([y0, s0, 0.5 * b0, cubic, fourth, fifth])
    }

    /// The polynomial with this value and slope at both ends.
    pub fn cubic([y0, s0]: [f64; 2], [y1, s1]: [f64; 2]) -> Curve {
        let (rise, first) = (y1 - y0 - s0, s1 - s0);
        Curve([y0, s0, 3.0 * rise - first, first - 2.0 * rise, 0.0, 0.0])
    }

    /// `sign (threshold - y)`.
    pub fn below(&self, threshold: f64, sign: f64) -> Curve {
        let Curve([y, rest @ ..]) = *self;
        let [a, b, c, d, e] = rest.map(|number| -sign * number);
        Curve([sign * (threshold - y), a, b, c, d, e])
    }

    /// The value at a part of the step.
    pub fn at(&self, part: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, coefficient| sum * part + coefficient)
    }

    /// The derivative by the part.
    pub fn slope(&self) -> Curve {
        let Curve([_, a, b, c, d, e]) = *self;
        Curve([a, 2.0 * b, 3.0 * c, 4.0 * d, 5.0 * e, 0.0])
    }

    /// Where the value falls through zero, between two parts with a positive and a negative value.
    fn root(&self, mut high: f64, mut low: f64) -> f64 {
        let slope = self.slope();
        let mut part = 0.5 * (high + low);
        for _ in 0..STEPS {
            let value = self.at(part);
            *(if value > 0.0 { &mut high } else { &mut low }) = part;
            let slope = slope.at(part);
            let step = quotient(-value, slope, fabs(value) < fabs(slope), 2.0);
            let next = part + step;
            let inside = (next > high && next < low) || (next < high && next > low);
            let next = if inside { next } else { 0.5 * (high + low) };
            let is_known = fabs(next - part) <= CONVERGED;
            part = next;
            if is_known {
                break;
            }
        }
        part
    }

    /// The first part of the step, up to `end`, at which the value has fallen from above zero to below it. A value that
    /// starts within `near` has fallen where it is below `-near`: what it does in between is rounding. A dip between two
    /// positive ends is found if the slope changes its sign.
    pub fn first_fall(&self, end: f64, near: f64) -> Option<f64> {
        let (start, last, slope) = (self.at(0.0), self.at(end), self.slope());
        let (rises, ends_rising) = (slope.at(0.0) > 0.0, slope.at(end) > 0.0);
        if start > near {
            if last < 0.0 {
                return Some(self.root(0.0, end));
            }
            if !rises && ends_rising {
                let bottom = slope.below(0.0, 1.0).root(0.0, end);
                return (self.at(bottom) < -near).then(|| self.root(0.0, bottom));
            }
            return None;
        }
        let top = if rises { slope.root(0.0, end) } else { 0.0 };
        let Curve([value, a, b, c, d, e]) = *self;
        let lower = Curve([value + near, a, b, c, d, e]);
        (last < -near).then(|| if lower.at(top) > 0.0 { lower.root(top, end) } else { top })
    }

    /// The largest value inside the step, if there is a maximum.
    pub fn top(&self) -> Option<f64> {
        let slope = self.slope();
        (slope.at(0.0) > 0.0 && slope.at(1.0) < 0.0).then(|| self.at(slope.root(0.0, 1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::Curve;

    #[test]
    fn roots_are_those_of_a_known_polynomial() {
        // (x - 0.3) (x - 0.8)
        let value = |x: f64| [(x - 0.3) * (x - 0.8), 2.0 * x - 1.1, 2.0];
        let curve = Curve::quintic(value(0.0), value(1.0));
        assert!((curve.first_fall(1.0, 0.0).unwrap() - 0.3).abs() < 1e-13);
        assert!((curve.first_fall(0.5, 0.0).unwrap() - 0.3).abs() < 1e-13);
        assert!(curve.first_fall(0.2, 0.0).is_none());
        assert!(curve.below(-1.0, -1.0).first_fall(1.0, 0.0).is_none());
        let falls = Curve::cubic([0.0, 1.0], [-1.0, -3.0]);
        assert!(falls.first_fall(1.0, 1e-12).unwrap() > 0.1, "it rises first");
        assert!((Curve::cubic([0.0, -1.0], [-1.0, -1.0]).first_fall(1.0, 0.1).unwrap() - 0.1).abs() < 1e-13);
        assert_eq!(Curve::cubic([-0.2, -1.0], [-1.2, -1.0]).first_fall(1.0, 0.1), Some(0.0));
        assert!((Curve::cubic([0.0, 1.0], [0.0, -1.0]).top().unwrap() - 0.25).abs() < 1e-13);
    }
}
