//! Work and time of laws without closed form: Gauss's rule on panels, for functions that may have a fractional power at an end.

use libm::{exp, fabs, log};

/// Integral over `[low, high]` on panels that shrink towards both ends, where a fractional power may begin. Swapping the bounds
/// changes the sign, as usual.
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

/// Positive nodes of the Gauss-Legendre rule with six points, and their weights.
///
/// Reference: M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions*, table 25.4.
pub(crate) const SIX: [(f64, f64); 3] = [
    (0.238_619_186_083_196_9, 0.467_913_934_572_691_05),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_35),
];

/// The same with ten points.
pub(crate) const TEN: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// Gauss-Legendre rule with ten points.
pub fn gauss(from: f64, to: f64, integrand: &impl Fn(f64) -> f64) -> f64 {
    let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
    let mut sum = 0.0;
    for (node, weight) in TEN {
        sum += weight * (integrand(centre - half * node) + integrand(centre + half * node));
    }
    sum * half
}

/// Number of points of the larger rule, and of coefficients of the polynomial through them.
pub const POINTS: usize = 16;

/// Nodes and weights of the Gauss-Legendre rule with sixteen points, and the weights of the coefficients of `P_14` and `P_15`.
/// By symmetry, half of them are enough.
///
/// Reference: Abramowitz and Stegun, as for [`gauss`]. A coefficient is `(k + 1/2)` times the sum that the rule gives for
/// `P_k f`.
const RULE: [(f64, f64, f64, f64); POINTS / 2] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5, -0.109_041_815_957_682_07, -0.593_615_928_942_801_8),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_58, 0.305_833_437_439_604, 0.561_746_144_829_279_1),
    (0.458_016_777_657_227_37, 0.169_156_519_395_002_54, -0.443_540_612_107_892_1, -0.500_893_349_715_964_4),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_74, 0.497_702_236_751_718_26, 0.416_640_377_025_961_35),
    (0.755_404_408_355_003, 0.124_628_971_255_533_88, -0.462_844_787_664_526_36, -0.316_919_617_797_220_83),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_79, 0.354_121_494_955_794_7, 0.211_598_530_631_884_44),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_894, -0.204_935_403_870_139_92, -0.112_220_912_450_588_4),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_096, 0.062_705_450_453_123_47, 0.032_781_303_963_861_74),
];

/// The integral by the rule, and the smoothness of the integrand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// The integral.
    pub integral: f64,
    /// The size of the last two Legendre coefficients of the integrand. It estimates the error of a polynomial through the
    /// samples.
    ///
    /// If the coefficients fall like a geometric series, the integral is far more accurate: its relative error is about a
    /// thousandth of the square of this number, taken relative to the mean.
    pub tail: f64,
}

/// The largest tail, as a fraction of the mean of the integrand, for which the integral is right to rounding.
pub const SMOOTH: f64 = 2e-6;

/// Integral over `[from, to]` by Gauss's rule with sixteen points, with an estimate of how smooth the integrand is.
pub fn sixteen(from: f64, to: f64, integrand: impl Fn(f64) -> f64) -> Sampled {
    let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut sum, mut even, mut odd) = (0.0, 0.0, 0.0);
    for (node, weight, even_weight, odd_weight) in RULE {
        let (below, above) = (integrand(centre - half * node), integrand(centre + half * node));
        sum += weight * (below + above);
        even += even_weight * (below + above);
        odd += odd_weight * (above - below);
    }
    Sampled { integral: sum * half, tail: fabs(even) + fabs(odd) }
}

/// The coefficients of `1, t, t^2, ...` of the polynomial that equals `function` at sixteen points of `[0, 1]`, and the size of
/// its last two Legendre coefficients, which estimates its error between the points.
///
/// The powers lose digits only where the Legendre coefficients do not fall faster than `5.8^-k`; the error is large there
/// anyway.
pub fn powers(function: impl Fn(f64) -> f64) -> ([f64; POINTS], f64) {
    let mut legendre = [0.0; POINTS];
    for (node, weight, ..) in RULE {
        for node in [-node, node] {
            let sample = weight * function(0.5 + 0.5 * node);
            let (mut before, mut polynomial) = (0.0, 1.0);
            for (k, slot) in legendre.iter_mut().enumerate() {
                let k = k as f64;
                *slot += (k + 0.5) * sample * polynomial;
                (before, polynomial) = (polynomial, ((2.0 * k + 1.0) * node * polynomial - k * before) / (k + 1.0));
            }
        }
    }
    let (mut powers, mut sign) = ([0.0; POINTS], 1.0);
    for (k, coefficient) in legendre.into_iter().enumerate() {
        // P_k(2 t - 1) is the sum of (-1)^(k + j) (k over j) (k + j over j) t^j
        let (k, mut term) = (k as f64, sign * coefficient);
        sign = -sign;
        for (j, slot) in powers.iter_mut().enumerate() {
            let j = j as f64;
            *slot += term;
            term *= -(k - j) * (k + j + 1.0) / ((j + 1.0) * (j + 1.0));
        }
    }
    let tail = legendre.iter().skip(POINTS - 2).map(|coefficient| fabs(*coefficient)).sum();
    (powers, tail)
}

/// Integral of a function of the powers of `y` over `[low, high]`, with `0 < low`. In `u = ln y` powers are entire functions,
/// and equal panels of Gauss's rule converge to rounding. The panels are wide where only one power is left.
pub fn logarithmic_integral(low: f64, high: f64, integrand: &impl Fn(f64) -> f64) -> f64 {
    const NARROW: f64 = 0.5;
    const WIDE: f64 = 2.0;
    /// `ln y` from which the panels are wide.
    const FAR: f64 = 18.0;
    /// More panels than fit between the logarithms of any two numbers, so that an integral up to infinity also ends.
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
