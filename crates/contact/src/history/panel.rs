//! The force over time on one segment, while the indentation is a cubic polynomial in time.
//!
//! Everything in a segment except its power is integrated in closed form. The power is smooth in time as long as its base is
//! not near zero. A few points of Gauss's rule are then exact to rounding, and their number is known in advance. Where the base
//! is zero at an end, the rule has the power as its weight.

use crate::history::path::RatePolynomial;
use crate::numerics::quadrature::{SIX, TEN};
use crate::numerics::{largest, root};
use crate::segment::Segment;
use libm::{fabs, sqrt};

/// Six points of Gauss's rule are exact to rounding for the power 1.5 of a polynomial that has no zero within this distance of
/// the middle of its interval, in half-widths. The other two constants are for the rule with ten points and for the rule whose
/// base is zero at an end. They were found on random polynomials; the errors are below 2e-16, 1e-16 and 3e-16.
const FREE_FOR_SIX: f64 = 8.0;
const FREE_FOR_TEN: f64 = 2.4;
const FREE_AT_ORIGIN: f64 = 3.3;

/// The shortest panel, as a fraction of the path. If the power begins there, this panel contains less than 1e-18 of its
/// integral.
const SHORTEST: f64 = 1.0 / 16_777_216.0;

/// Far more panels than fit between the shortest panel and the whole path.
const MOST_PANELS: u32 = 500;

/// Nodes and weights of the Gauss-Jacobi rule on `[0, 1]` with the weight `w^1.5`, eight points.
///
/// Reference: M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, 25.4.33; computed with 40 digits.
const WITH_POWER: [(f64, f64); 8] = [
    (0.057_911_748_148_151_225, 0.001_161_023_042_635_218_3),
    (0.164_656_392_719_433_6, 0.008_561_760_496_781_147),
    (0.309_311_723_511_976_7, 0.027_246_077_116_022_496),
    (0.475_370_277_346_284_24, 0.055_893_767_138_740_66),
    (0.643_864_519_488_226_6, 0.084_320_262_958_941_75),
    (0.795_546_871_717_636_7, 0.097_379_330_155_505_38),
    (0.913_092_652_268_472_6, 0.083_407_222_400_305_34),
    (0.983_102_957_656_961_2, 0.042_030_556_691_067_806),
];

/// Impulse \[N.s\] on `segment` along `course`, from one time \[s\] and indentation \[m\] to another. In between, the
/// indentation must not be below the origin of the segment.
pub fn impulse_on(segment: &Segment, course: &RatePolynomial, (start, from): (f64, f64), (end, to): (f64, f64)) -> f64 {
    if course.is_held() {
        return (end - start) * segment.mean_force(from, to);
    }
    let [mut base, last] = [from, to].map(|indentation| largest(indentation - segment.origin, 0.0));
    let (mut rest, mut now) = (end - start, start);
    let shortest = SHORTEST * rest;
    let mut sum = 0.0;
    for panels in 0..MOST_PANELS {
        let course = course.after(now);
        let mut length = rest;
        let (panel, power) = loop {
            let panel = Panel::of(base, &course, length);
            let first = base <= f64::EPSILON * panel.middle;
            let back = length == rest && last <= f64::EPSILON * panel.middle;
            let power = match segment.power != 0.0 {
                true if first => power_from_zero(&course, length),
                true if back => power_from_zero(&course.after(length).reversed(), length),
                true => panel.power(),
                false => Some(0.0),
            };
            if let Some(power) = power {
                break (panel, power);
            }
            if length <= shortest || panels + 1 == MOST_PANELS {
                break (panel, panel.middle * root(panel.middle));
            }
            length *= 0.5;
        };
        let mean = segment.constant + segment.linear * panel.mean() + segment.power * power;
        let square = if segment.square != 0.0 { segment.square * panel.mean_square() } else { 0.0 };
        sum += length * (mean + square);
        if length == rest {
            break;
        }
        base = largest(base + course.way(length), 0.0);
        rest -= length;
        now += length;
    }
    sum
}

/// A polynomial on `[-1, 1]`, given by its coefficients.
#[derive(Clone, Copy)]
struct Panel {
    middle: f64,
    first: f64,
    second: f64,
    third: f64,
}

impl Panel {
    /// `base` \[m\] plus the distance covered over `length` \[s\].
    #[inline(always)]
    fn of(base: f64, course: &RatePolynomial, length: f64) -> Panel {
        let half = 0.5 * length;
        let RatePolynomial { rate, slope, bend } = course.after(half);
        Panel {
            middle: base + course.way(half),
            first: rate * half,
            second: 0.5 * slope * half * half,
            third: bend * half * half * half * (1.0 / 6.0),
        }
    }

    /// Whether it certainly has no zero within `distance` of the middle, in the complex plane.
    #[inline(always)]
    fn is_free(&self, distance: f64) -> bool {
        let farthest = fabs(self.second) + distance * fabs(self.third);
        distance * (fabs(self.first) + distance * farthest) <= self.middle
    }

    fn mean(&self) -> f64 {
        self.middle + self.second * (1.0 / 3.0)
    }

    fn mean_square(&self) -> f64 {
        let Panel { middle, first, second, third } = *self;
        middle * middle
            + (2.0 * middle * second + first * first) / 3.0
            + (second * second + 2.0 * first * third) / 5.0
            + third * third / 7.0
    }

    /// The mean of its power 1.5; `None` if the power is not smooth.
    #[inline(always)]
    fn power(&self) -> Option<f64> {
        let rule = match self.is_free(FREE_FOR_SIX) {
            true => SIX.as_slice(),
            false if self.is_free(FREE_FOR_TEN) => TEN.as_slice(),
            false => return None,
        };
        let mut sum = 0.0;
        for &(node, weight) in rule {
            let square = node * node;
            let (even, odd) = (self.middle + self.second * square, node * (self.first + self.third * square));
            let (below, above) = (even - odd, even + odd);
            sum += weight * (below * sqrt(below) + above * sqrt(above));
        }
        Some(0.5 * sum)
    }
}

/// The mean of the power 1.5 of the distance covered over `length` \[s\]; `None` if distance over time is not smooth.
fn power_from_zero(course: &RatePolynomial, length: f64) -> Option<f64> {
    let RatePolynomial { rate, slope, bend } = *course;
    let (zeroth, first, second) =
        (rate * length, 0.5 * slope * length * length, bend * length * length * length * (1.0 / 6.0));
    // distance over the fraction of the time, on [-1, 1]
    let ratio = Panel {
        middle: zeroth + 0.5 * first + 0.25 * second,
        first: 0.5 * (first + second),
        second: 0.25 * second,
        third: 0.0,
    };
    if !ratio.is_free(FREE_AT_ORIGIN) {
        return None;
    }
    let mut sum = 0.0;
    for (part, weight) in WITH_POWER {
        let ratio = zeroth + part * (first + part * second);
        sum += weight * ratio * sqrt(ratio);
    }
    Some(sum)
}
