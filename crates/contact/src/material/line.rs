//! Line contact: a cylinder of parabolic gap, pressed along a line of some length.
//!
//! The elastic approach of two bodies in line contact depends on their size, because the strain of a line load falls only as one over the
//! distance. With the force per length `F'`, `q = F'/(pi E*)` and the half-width `a`, a body `i` gives way by
//! `(E*/E_i) q 2 ln(s_i/a)`: its *reach* `s_i` is all that the law needs to know of its size. For a body of size `t` whose elastic
//! compression is `F'/(pi E_i) (2 ln(2t/a) + k)` it is `s = 2 t e^(k/2)`.
//!
//! For every convex profile without friction `dd/dF' = (2 ln(s/a) - 1)/(pi E*)` with the present half-width: a flat punch is pushed in. So an
//! unloading needs only the half-width as a function of the force.

use crate::numerics::{quotient, smallest};
use crate::segment::Segment;
use libm::log;

/// Forces of a way back, relative to its largest one, between which one segment holds: the force is within 0.1 % of the formula. Below the
/// last one the force is less exact, relative to itself; it is then below 1e-9 of the largest one.
const KNOTS: [f64; 12] = {
    let mut knots = [1.0; 12];
    let mut place = 1;
    while place < knots.len() {
        knots[place] = match place {
            1 => 0.4,
            2 => 0.05,
            _ => 0.125 * knots[place - 1],
        };
        place += 1;
    }
    knots
};

/// The smallest part of a series that is summed and not computed as a difference.
const SERIES: f64 = 0.1;

/// A way back of a line contact from a force `F_m`, as a chain of [segments](Segment) by force and slope at fixed parts `s` of this force.
///
/// The half-width is `a^2 = a_m^2 ((1 + g) s - g s^2)`: exact for the pressure of Hertz (`g = 0`) and for a uniform one (`g = 1`). The
/// indentation above the end of the force is
///
/// `z(s) = q [ (K + 1) s - s ln s - G(s) ]`, `G(s) = integral of ln(1 + g - g s)` from 0 to `s`,
///
/// with `q = F_m'/(pi E*)` and the compliance `K = 2 ln(s/a_m) - 1` at the peak, in units of `1/(pi E*)`. For `g = 0` it is the elastic law.
///
/// Reference: K. L. Johnson, *Contact Mechanics*, 1985, section 5.6 (cylinders between plates) and 2.8 (flat punch).
#[derive(Clone, Copy)]
pub(crate) struct Chain {
    /// `F_m` \[N\].
    pub force: f64,
    /// `q` \[m\].
    pub scale: f64,
    /// `K` > 0.
    pub compliance: f64,
    /// `g`, from 0 to 1.
    pub shape: f64,
}

impl Chain {
    /// `z` \[m\] at the part `s` of the force, in `q`.
    fn way(&self, s: f64) -> f64 {
        let whole = 1.0 + self.shape;
        // ln(1 + g - g s) = ln(1 + g) + ln(1 - b s)
        let b = self.shape / whole;
        let bent = quotient(entropy(b * s), b, b > 0.0, 0.0);
        s * (self.compliance + 1.0 - log(s) - log(whole)) + bent
    }

    /// `dz/ds` in `q`.
    fn slope(&self, s: f64) -> f64 {
        self.compliance - log(s * (1.0 + self.shape * (1.0 - s)))
    }

    /// The indentation given back \[m\].
    pub fn recovery(&self) -> f64 {
        self.scale * self.way(1.0)
    }

    /// The segments from the upper end down to the origin at zero, where the whole way is `length` \[m\].
    fn segments(&self, length: f64) -> impl Iterator<Item = Segment> {
        let (chain, unit) = (*self, length / self.way(1.0));
        let knot = move |s: f64| [unit * chain.way(s), s * chain.force, chain.force / (unit * chain.slope(s))];
        let mut upper = [length, self.force, self.force / (unit * self.slope(1.0))];
        let lower = KNOTS.iter().skip(1).map(|&s| Some(s)).chain([None]);
        lower.map(move |s| match s {
            Some(s) => {
                let lower = knot(s);
                Segment::between(lower, core::mem::replace(&mut upper, lower))
            }
            None => Segment::from_zero(upper),
        })
    }

    /// The segment that holds at and just above `indentation` \[m\] on the way from `residual` to `largest` \[m\].
    #[inline(never)]
    pub fn segment(&self, indentation: f64, residual: f64, largest: f64) -> Segment {
        let length = largest - residual;
        // the borders as numbers that an indentation can be: neighbours have the same, and one contains every indentation
        let place = |way: f64| if way == length { largest } else { residual + way };
        let mut found = Segment::NOTHING;
        for segment in self.segments(length) {
            let (lower, upper) = (place(segment.lower), place(segment.upper));
            found = Segment { lower, upper, origin: residual, ..segment };
            if lower <= indentation {
                break;
            }
        }
        found
    }

    /// Work \[J\] from the end of the force to `way` \[m\].
    #[inline(never)]
    pub fn work(&self, way: f64, length: f64) -> f64 {
        self.segments(length).fold(0.0, |sum, segment| {
            let end = smallest(way, segment.upper);
            if end > segment.lower { sum + segment.work(end) } else { sum }
        })
    }
}

/// `(1 - x) ln(1 - x) + x`, without cancellation, for `x` from 0 to 0.5.
fn entropy(x: f64) -> f64 {
    if x > SERIES {
        return (1.0 - x) * log(1.0 - x) + x;
    }
    // the sum of x^n/(n (n - 1)) from n = 2
    let sum = (2..16).rev().fold(0.0, |sum, n| {
        let n = f64::from(n);
        sum * x + 1.0 / (n * (n - 1.0))
    });
    x * x * sum
}
