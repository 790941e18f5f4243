//! Integrals of smooth functions with a fractional power at an end.

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
