//! Integrals of smooth functions with a fractional power at an end.

use libm::{exp, log};

/// Integral over `[low, high]` with panels that shrink towards both ends, where a fractional power may begin. The sign of
/// the interval counts as usual.
pub fn graded_integral(low: f64, high: f64, integrand: &impl Fn(f64) -> f64) -> f64 {
    const PANELS: u32 = 12;
    let middle = 0.5 * (low + high);
    let half = |end: f64| {
        let mut outer = middle;
        let mut sum = 0.0;
        for _ in 1..PANELS {
            let inner = 0.5 * (outer + end);
            sum += gauss(inner, outer, integrand);
            outer = inner;
        }
        sum + gauss(end, outer, integrand)
    };
    half(low) - half(high)
}

/// Gauss-Legendre rule with ten points.
///
/// Reference: M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, table 25.4.
pub fn gauss(from: f64, to: f64, integrand: &impl Fn(f64) -> f64) -> f64 {
    const NODES_AND_WEIGHTS: [(f64, f64); 5] = [
        (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
        (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
        (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
        (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
        (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
    ];
    let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
    let mut sum = 0.0;
    for (node, weight) in NODES_AND_WEIGHTS {
        sum += weight * (integrand(centre - half * node) + integrand(centre + half * node));
    }
    sum * half
}

/// Integral of a function of the powers of `y` over `[low, high]`, `0 < low`: in `u = ln y` powers are entire functions, and
/// equal panels of Gauss's rule converge to rounding. They are wide where only one power is left.
pub fn logarithmic_integral(low: f64, high: f64, integrand: &impl Fn(f64) -> f64) -> f64 {
    const NARROW: f64 = 0.5;
    const WIDE: f64 = 2.0;
    /// `ln y` from which panels are wide.
    const FAR: f64 = 18.0;
    /// More than there are between the logarithms of any two numbers, so that one up to infinity ends too.
    const MOST_PANELS: u32 = 2000;
    let (mut from, end) = (log(low), log(high));
    let mut sum = 0.0;
    for _ in 0..MOST_PANELS {
        if from >= end {
            break;
        }
        let next = from + if from < FAR { NARROW } else { WIDE };
        let to = if next < end { next } else { end };
        sum += gauss(from, to, &|u: f64| {
            let y = exp(u);
            integrand(y) * y
        });
        from = to;
    }
    sum
}
