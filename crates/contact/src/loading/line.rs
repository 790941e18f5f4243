//! Line contact of cylinders that yield, fitted to finite elements in plane strain.

use super::{Loading, MOST_SEGMENTS, RecoveryOf};
use crate::loading::two_bodies::{OtherBody, TwoBodies};
use crate::material::line::Chain;
use crate::material::{Pair, YieldPoint};
use crate::numerics::{largest, quotient, smallest};
use crate::regime::{LARGEST_INDENTATION, Regime};
use crate::segment::Segment;
use crate::unloading::Recovery;
use crate::validity::largest_radius;
use core::f64::consts::{FRAC_PI_4, LN_2, PI};
use libm::{exp, fabs, log, pow, sqrt};

/// A cylinder pressed along a line. Per length, with `f = F/F_y`, `A = a/a_y`, `d_y = a_y^2/R`, `a_y = 2 R p/E*`,
/// `F_y' = pi R p^2/E*` and the largest pressure `p` at first yield (1.7937 S for a Poisson's ratio of 0.3):
///
/// - `d/d_y = f/4 (C - ln f) + g(f)`: the logarithm is elastic, `g` is plastic. `C = sum of (E*/E_i) 2 ln(s_i/a_y)` with the
///   [reach](crate::material::line) `s_i` of each body;
/// - `f <= 1`: `A = sqrt f`, `g = 0`;
/// - above: `g = (f - 1)^2 (0.10057 + 0.02924/f^2.13 - 0.03941 f/(f + 67.2))`,
///   `A = 1 + (f - 1) (0.6186 - 0.1208/f - 0.1829 f/(f + 16.1))`.
///
/// **Size.** The boundary of a body puts a sideways tension `c F'/(pi t)` under the contact, into which it yields: with `tau = c/t` its depth
/// is larger by `0.749 w tau a^3/R_i`, `w = 1 - exp(-(f - 1)/1.89)`, and the half-width by the factor `1 + 0.54 w tau a`. The table has the
/// second one without `w`, by which it would jump at yield.
///
/// **Hardening and Poisson's ratio.** `g = t^2 g(f/t^2)` with `t = 1 + 0.8924 h (f^0.6138 - 1)`, `h = eta/(1 + 5.581 eta)`, `eta = H/E_i`; `A = t A(f/t^2)`
/// with `t = 1 + 1.0181 h (f^0.6778 - 1)`, `h = eta/(1 + 5.527 eta)`. With `r = p/(1.7937 S)`: `g` times
/// `1 + (r^1.493 - 1) (1 - 0.636 f^-0.993)`, `A` times `1 + (r^0.951 - 1) (1 - f^-0.416)`, with the `r` of 0.2 below that ratio, and that of 0.4 above.
///
/// **Two bodies.** Each follows its own curve under a rigid cylinder of a radius `R_i` of its own, at equal mean pressure, as in
/// [`two_bodies`](crate::loading::two_bodies).
///
/// Against the finite elements in `data/truth/line`: depth within 0.45 %, `g` 0.56 %, half-width 0.8 %; two bodies 1 % (1.6 % beside an
/// elastic body of a third of the modulus); plates and rollers up to a half-width of 0.04 of their size 0.8 %. The curve has value and slope of
/// the formulas at the [knots](KNOTS), and is a chain of segments between them, within 0.1 %. Beyond the last knot it is a straight line.
///
/// `a` is the half-width of the contact wherever other laws have its radius. Length, reach and tension are in units of the effective radius.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Line {
    /// Length of the contact `[R]`.
    pub length: f64,
    /// Reach of the impactor `[R]`; without effect for a rigid one.
    pub impactor_reach: f64,
    /// Sideways tension of the impactor `c/t` `[1/R]`.
    pub impactor_tension: f64,
    /// Reach of the target `[R]`.
    pub target_reach: f64,
    /// Sideways tension of the target `[1/R]`.
    pub target_tension: f64,
    /// The bodies beside the pair.
    #[cfg_attr(feature = "serde", serde(skip, default = "alone"))]
    pub(crate) bodies: TwoBodies,
    /// Whether the pair describes the impactor, and not the target.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) is_impactor: bool,
    /// The knots, if the law is prepared for a pair.
    #[cfg_attr(feature = "serde", serde(skip, default = "none"))]
    pub(crate) curve: Curve,
}

#[cfg(feature = "serde")]
fn alone() -> TwoBodies {
    TwoBodies::under_rigid(0.0)
}

#[cfg(feature = "serde")]
fn none() -> Curve {
    Curve::NONE
}

/// Loads of the body that leads, in its own yield loads, at which the curve has value and slope of the formulas.
pub const KNOTS: [f64; 18] = [
    1.0, 1.5, 2.5, 5.0, 10.0, 20.0, 32.0, 50.0, 80.0, 130.0, 210.0, 340.0, 550.0, 900.0, 1500.0, 2500.0, 4000.0, 6500.0,
];

/// The knots at which the second region and the fully plastic one begin: mean pressures of 2.19 S and 2.88 S, 3 % below that of slip lines.
const REGIONS: [usize; 2] = [3, 7];

/// Largest pressure at first yield over the strength, for a Poisson's ratio of 0.3.
const STANDARD: f64 = 1.7937;

/// Poisson's ratios that were compared with finite elements.
const COMPARED: [f64; 2] = [0.2, 0.4];

/// The error of the pressure at first yield, below which a Poisson's ratio counts as 0.3.
const EXACT: f64 = 1e-4;

/// Relative distance between the loads from which slopes are taken.
const NEAR: f64 = 3e-5;

/// A smaller part of the compliance is that of a rigid body, but for rounding.
const LEAST: f64 = 1e-12;

/// A contact that is not narrower than the effective radius has no law: there, at the latest, the elastic part ends. The pressure is then this
/// part of the modulus.
const WIDEST: f64 = 0.5;

/// The part of the size of a body up to which a half-width is small beside it.
pub const LARGEST_PART: f64 = 0.1;

/// A body and what the law knows of it.
#[derive(Clone, Copy)]
struct Body {
    /// Plane-strain modulus \[Pa\].
    modulus: f64,
    /// Largest pressure at first yield \[Pa\]; infinite for a body that stays elastic.
    pressure: f64,
    /// What is added to 1 in the factors of `g` and of `A`, without their decay, for another Poisson's ratio than 0.3.
    of_ratio: [f64; 2],
    /// `h` of `g` and of `A`.
    hardening: [f64; 2],
    /// Reach \[m\].
    reach: f64,
    /// Tension \[1/m\].
    tension: f64,
}

/// The largest pressure at first yield over the strength: the largest equivalent stress of von Mises under Hertz's pressure lies on the axis
/// or, for small Poisson's ratios, at the surface.
///
/// Within 5e-5 for all Poisson's ratios. Reference: K. L. Johnson, *Contact Mechanics*, 1985, eq. 4.45 to 4.49.
fn pressure_at_yield(nu: f64) -> f64 {
    let away = nu - 0.3;
    // the depth of the largest stress over the half-width, to which the stress is stationary
    let z = 0.704 + away * (0.94 - 2.8 * away);
    let root = sqrt(1.0 + z * z);
    let (along, down) = (2.0 * z - (1.0 + 2.0 * z * z) / root, -1.0 / root);
    let across = nu * (along + down);
    let squares = [along - across, across - down, down - along].map(|difference| difference * difference);
    let inside = sqrt(0.5 * squares.iter().sum::<f64>());
    1.0 / largest(inside, 1.0 - 2.0 * nu)
}

/// The factor and the exponent in `t` of `g` and of `A`.
const SCALES: [[f64; 2]; 2] = [[0.8924, 0.6138], [1.0181, 0.6778]];

/// `t` with this `h`.
fn scale(f: f64, h: f64, [factor, exponent]: [f64; 2]) -> f64 {
    if h > 0.0 { 1.0 + factor * h * (pow(f, exponent) - 1.0) } else { 1.0 }
}

impl Body {
    fn new(body: &OtherBody, reach: f64, tension: f64) -> Body {
        let OtherBody { modulus, poissons_ratio, yield_strength, hardening_modulus } = *body;
        let pressure = pressure_at_yield(poissons_ratio);
        let eta = hardening_modulus / modulus;
        let hardening = [5.581, 5.527].map(|limit| eta / (1.0 + limit * eta));
        // beyond the ratios that were compared, the factors are those of the nearest one
        let nearest = largest(COMPARED[0], smallest(poissons_ratio, COMPARED[1]));
        let ratio = pressure_at_yield(nearest) / STANDARD;
        let is_standard = fabs(ratio - 1.0) < EXACT;
        let of_ratio = [1.493, 0.951].map(|power| if is_standard { 0.0 } else { pow(ratio, power) - 1.0 });
        Body { modulus, pressure: pressure * yield_strength, of_ratio, hardening, reach, tension }
    }

    /// `g` at `f >= 1`.
    fn depth(&self, f: f64) -> f64 {
        let t = scale(f, self.hardening[0], SCALES[0]);
        let scaled = largest(f / (t * t), 1.0);
        let plain = 0.10057 + 0.02924 / pow(scaled, 2.13) - 0.03941 * (scaled / (scaled + 67.2));
        let [ratio, _] = self.of_ratio;
        let factor = if ratio == 0.0 { 0.0 } else { ratio * (1.0 - 0.636 * pow(f, -0.993)) };
        t * t * (scaled - 1.0) * (scaled - 1.0) * plain * (1.0 + factor)
    }

    /// `A` at `f >= 1`.
    fn width(&self, f: f64) -> f64 {
        let t = scale(f, self.hardening[1], SCALES[1]);
        let scaled = f / (t * t);
        let plain = 1.0 + (scaled - 1.0) * (0.6186 - 0.1208 / scaled - 0.1829 * (scaled / (scaled + 16.1)));
        let plain = if scaled < 1.0 { sqrt(scaled) } else { plain };
        let [_, ratio] = self.of_ratio;
        let factor = if ratio == 0.0 { 0.0 } else { ratio * (1.0 - pow(f, -0.416)) };
        t * plain * (1.0 + factor)
    }

    /// Mean pressure \[Pa\] at `f >= 1`.
    fn mean(&self, f: f64) -> f64 {
        if self.pressure < f64::INFINITY { FRAC_PI_4 * self.pressure * f / self.width(f) } else { f64::INFINITY }
    }

    /// The load at this `mean` pressure \[Pa\], at most `most`; below 1 the body is elastic.
    fn load(&self, mean: f64, most: f64) -> f64 {
        let part = mean / (FRAC_PI_4 * self.pressure);
        if part <= 1.0 {
            return part * part;
        }
        // the Illinois method over the logarithm of the load: the mean pressure rises
        let excess = |at: f64| self.mean(exp(at)) / mean - 1.0;
        let (mut low, mut high) = ((0.0, 1.0 / part - 1.0), (log(most), excess(log(most))));
        if high.1 <= 0.0 {
            return most;
        }
        let (mut found, mut was_high) = (high.0, None);
        for _ in 0..60 {
            found = low.0 + (high.0 - low.0) * (low.1 / (low.1 - high.1));
            let beyond = excess(found);
            if fabs(beyond) < 4.0 * f64::EPSILON {
                break;
            }
            let is_high = beyond > 0.0;
            let again = was_high == Some(is_high);
            if is_high {
                high = (found, beyond);
                low.1 *= if again { 0.5 } else { 1.0 };
            } else {
                low = (found, beyond);
                high.1 *= if again { 0.5 } else { 1.0 };
            }
            was_high = Some(is_high);
        }
        exp(found)
    }

    /// `2 ln(s/a)`. A contact that is wider than half the reach has no law; it is as stiff as one of this width.
    fn compliance(&self, half_width: f64) -> f64 {
        2.0 * largest(log(self.reach / half_width), LN_2)
    }

    /// `1 - exp(-(f - 1)/1.89)`.
    fn yielded(f: f64) -> f64 {
        if f > 1.0 { 1.0 - exp((1.0 - f) / 1.89) } else { 0.0 }
    }
}

/// A point of the curve: indentation, force and half-width \[m, N, m\].
#[derive(Clone, Copy)]
struct Point {
    indentation: f64,
    force: f64,
    half_width: f64,
}

/// Both bodies of a pair.
struct LinePair {
    both: [Body; 2],
    radius: f64,
    modulus: f64,
    /// Length of the contact \[m\].
    length: f64,
}

impl LinePair {
    fn of(law: &Line, pair: &Pair) -> LinePair {
        let Line { bodies, is_impactor, .. } = *law;
        let impactor = (law.impactor_reach, law.impactor_tension);
        let target = (law.target_reach, law.target_tension);
        let (own, other) = if is_impactor { (impactor, target) } else { (target, impactor) };
        let softer = OtherBody {
            modulus: pair.yielding_modulus(),
            poissons_ratio: pair.poissons_ratio,
            yield_strength: pair.yield_strength,
            hardening_modulus: bodies.hardening_modulus,
        };
        // the part of the compliance that the moduli of the pair leave
        let rest = 1.0 - pair.modulus / softer.modulus;
        let modulus = quotient(pair.modulus, rest, rest > LEAST, f64::INFINITY);
        let harder = OtherBody { modulus, ..bodies.other };
        let new = |body, (reach, tension): (f64, f64)| Body::new(body, reach * pair.radius, tension / pair.radius);
        let (mut one, two) = (new(&softer, own), new(&harder, other));
        if one.pressure <= two.pressure {
            one.pressure = smallest(one.pressure, WIDEST * pair.modulus);
        }
        let both = if two.pressure < one.pressure { [two, one] } else { [one, two] };
        LinePair { both, radius: pair.radius, modulus: pair.modulus, length: law.length * pair.radius }
    }

    /// The parts of the bodies in the elastic compliance.
    fn parts(&self) -> [f64; 2] {
        self.both.map(|body| self.modulus / body.modulus)
    }

    /// `K`, the compliance of a flat punch of this half-width \[m\] in units of `1/(pi E* L)`.
    fn compliance(&self, half_width: f64) -> f64 {
        let own = self.both.iter().zip(self.parts());
        own.fold(-1.0, |sum, (body, part)| if part > 0.0 { sum + part * body.compliance(half_width) } else { sum })
    }

    /// `q` \[m\] of a force \[N\].
    fn scale(&self, force: f64) -> f64 {
        force / (PI * self.modulus * self.length)
    }

    /// The half-width of an elastic contact \[m\] under a force \[N\].
    fn elastic_width(&self, force: f64) -> f64 {
        sqrt(4.0 * self.scale(force) * self.radius)
    }

    /// The elastic part, up to first yield of the first body.
    fn elastic(&self) -> Chain {
        let [first, _] = self.both;
        let width = 2.0 * self.radius * (first.pressure / self.modulus);
        let force = 0.5 * PI * width * first.pressure * self.length;
        Chain { force, scale: self.scale(force), compliance: self.compliance(width), shape: 0.0 }
    }

    /// The point where the body with the lower mean pressure has the load `f >= 1` of its own.
    #[inline(never)]
    fn at(&self, f: f64) -> Point {
        let [one, two] = self.both.map(|body| body.mean(f));
        let mean = smallest(one, two);
        let load = |body: &Body, own: f64| if own == mean { f } else { body.load(mean, f) };
        let loads = [load(&self.both[0], one), load(&self.both[1], two)];
        // the curvature that each body takes on, over that of the pair's half-width
        let bend = |body: &Body, f: f64| match f > 1.0 {
            true => body.pressure * body.width(f) / body.modulus,
            false => mean / (FRAC_PI_4 * body.modulus),
        };
        let bends = [bend(&self.both[0], loads[0]), bend(&self.both[1], loads[1])];
        let whole = bends[0] + bends[1];
        let width = 2.0 * self.radius * whole;
        let force = 2.0 * width * mean * self.length;
        let scale = self.scale(force);
        let mut indentation = scale * (self.compliance(width) + 1.0);
        let mut wider = 0.0;
        for (((body, f), bend), part) in self.both.iter().zip(loads).zip(bends).zip(self.parts()) {
            if f > 1.0 {
                let (own, yielded) = (body.width(f), Body::yielded(f));
                // one over the radius of the cylinder that the body sees
                let curvature = bend / (whole * self.radius);
                let plastic = body.depth(f) / (own * own) + 0.749 * yielded * body.tension * width;
                indentation += part * scale * log(own * own / f) + width * width * curvature * plastic;
                wider += 0.54 * (bend / whole) * yielded * body.tension * width;
            }
        }
        // just beyond yield the fit is narrower than Hertz's contact, which would give back more than it took
        Point { indentation, force, half_width: largest(width * (1.0 + wider), self.elastic_width(force)) }
    }

    /// The shape of the pressure under a `force` \[N\].
    fn shape(&self, force: f64) -> f64 {
        let [first, _] = self.both;
        let f = force / self.elastic().force;
        let t = scale(f, first.hardening[1], SCALES[1]);
        let scaled = f / (t * t);
        let u = if scaled > 1.0 { pow(scaled, 0.861) - 1.0 } else { 0.0 };
        smallest(1.027 * (u / (u + 2.156)), 1.0)
    }
}

/// A knot, and the piece that begins there.
#[derive(Clone, Copy, PartialEq)]
struct Row {
    /// Indentation \[m\].
    lower: f64,
    /// Force \[N\].
    force: f64,
    /// Work up to here \[J\].
    work: f64,
    /// Coefficients of the [segment](Segment): `c0`, `c1`, `c2` and `c3`.
    coefficients: [f64; 4],
    /// Half-width \[m\], and its slope over the force \[m/N\].
    width: [f64; 2],
}

/// The curve of a pair beyond yield.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Curve {
    /// The number of knots: none in a law that is not prepared.
    knots: usize,
    pair: Pair,
    rows: [Row; KNOTS.len()],
}

impl core::fmt::Debug for Curve {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Curve").field("knots", &self.knots).finish_non_exhaustive()
    }
}

impl Curve {
    pub(crate) const NONE: Curve = Curve {
        knots: 0,
        pair: Pair { radius: 0.0, modulus: 0.0, yield_strength: 0.0, youngs_modulus: 0.0, poissons_ratio: 0.0 },
        rows: [Row { lower: 0.0, force: 0.0, work: 0.0, coefficients: [0.0; 4], width: [0.0; 2] }; KNOTS.len()],
    };

    /// The curve of a pair, up to a knot beyond this indentation \[m\].
    #[inline(never)]
    fn of(law: &Line, pair: &Pair, to: f64) -> Curve {
        let bodies = LinePair::of(law, pair);
        let elastic = bodies.elastic();
        let yields_at = elastic.recovery();
        let mut curve = Curve { pair: *pair, ..Curve::NONE };
        // a wider contact has no law
        let wide = 2.0 * pair.radius;
        let mut last: Option<[f64; 3]> = None;
        let mut work = elastic.work(yields_at, yields_at);
        for (place, (row, &f)) in curve.rows.iter_mut().zip(&KNOTS).enumerate() {
            let [below, point, above] = [f * (1.0 - NEAR), f, f * (1.0 + NEAR)].map(|f| bodies.at(largest(f, 1.0)));
            let rise = (above.force - below.force) / (above.indentation - below.indentation);
            let widens = (above.half_width - below.half_width) / (above.force - below.force);
            let knot = match place {
                // exactly where the elastic part ends
                0 => [yields_at, elastic.force, elastic.force / (elastic.scale * elastic.compliance)],
                _ => [point.indentation, point.force, rise],
            };
            if let Some(before) = last.replace(knot) {
                let piece = Segment::between(before, knot);
                work += piece.work(piece.upper);
            }
            let [lower, force, stiffness] = knot;
            *row = Row {
                lower,
                force,
                work,
                coefficients: [force, stiffness, 0.0, 0.0],
                width: [point.half_width, widens],
            };
            curve.knots = place + 1;
            if point.half_width > wide || lower > to {
                break;
            }
        }
        curve.fill();
        curve
    }

    /// Puts the coefficients of the pieces in place of force and stiffness at their beginnings.
    fn fill(&mut self) {
        let knots = self.rows.map(|row| [row.lower, row.coefficients[0], row.coefficients[1]]);
        for ((row, begin), end) in self.rows.iter_mut().zip(knots).zip(knots.into_iter().skip(1)).take(self.knots - 1) {
            let Segment { constant, linear, power, square, .. } = Segment::between(begin, end);
            row.coefficients = [constant, linear, power, square];
        }
    }

    /// The place of the piece that holds at and just above `indentation` \[m\]; `None` before yield.
    fn place(&self, indentation: f64) -> Option<usize> {
        let rows = self.rows.get(..self.knots)?;
        rows.partition_point(|row| row.lower <= indentation).checked_sub(1)
    }

    /// The row of this place, and the next one, if it is not the last.
    fn rows(&self, place: usize) -> Option<(&Row, Option<&Row>)> {
        Some((self.rows.get(place)?, self.rows.get(place + 1).filter(|_| place + 1 < self.knots)))
    }

    fn piece(&self, place: usize) -> Option<Segment> {
        let (row, next) = self.rows(place)?;
        let [constant, linear, power, square] = row.coefficients;
        Some(match next {
            Some(next) => Segment { lower: row.lower, upper: next.lower, origin: 0.0, constant, linear, power, square },
            None => Segment::beyond([row.lower, constant, linear]),
        })
    }

    /// The half-width \[m\] under a `force` \[N\] on the piece of this place: a cubic by value and slope at both ends.
    fn width(&self, place: usize, force: f64) -> Option<f64> {
        let (row, next) = self.rows(place)?;
        let [width, slope] = row.width;
        let Some(next) = next else { return Some(width + slope * (force - row.force)) };
        let length = next.force - row.force;
        let part = (force - row.force) / length;
        let (difference, [_, arriving]) = (next.width[0] - width, next.width);
        let (leaving, arriving) = (slope * length - difference, difference - arriving * length);
        Some(width + part * difference + part * (1.0 - part) * ((1.0 - part) * leaving + part * arriving))
    }
}

impl Line {
    /// Two rollers of steel whose contact is as long as its effective radius.
    pub const REFERENCE: Line = Line {
        length: 1.0,
        impactor_reach: ROLLER,
        impactor_tension: 1.0,
        target_reach: ROLLER,
        target_tension: 1.0,
        bodies: TwoBodies::under_rigid(0.0),
        is_impactor: false,
        curve: Curve::NONE,
    };

    /// The law of a contact of this length `[R]` between bodies of this reach `[R]` and sideways tension `[1/R]`.
    pub const fn new(length: f64, impactor: [f64; 2], target: [f64; 2]) -> Line {
        let ([impactor_reach, impactor_tension], [target_reach, target_tension]) = (impactor, target);
        Line { length, impactor_reach, impactor_tension, target_reach, target_tension, ..Line::REFERENCE }
    }

    /// The law of a contact of this length `[R]` whose elastic compliance at first yield is `constant`, between bodies without sideways
    /// tension.
    pub fn of_constant(length: f64, constant: f64, pair: &Pair, bodies: TwoBodies, is_impactor: bool) -> Line {
        let unit = Line::new(length, [1.0, 0.0], [1.0, 0.0]);
        let [first, _] = LinePair::of(&unit.along(bodies, is_impactor), pair).both;
        // in units of the radius
        let reach = 2.0 * (first.pressure / pair.modulus) * exp(0.5 * constant);
        Line::new(length, [reach, 0.0], [reach, 0.0])
    }

    /// The law for these bodies; the pair describes the impactor or the target.
    #[must_use]
    pub const fn along(self, bodies: TwoBodies, is_impactor: bool) -> Line {
        Line { bodies, is_impactor, curve: Curve::NONE, ..self }
    }

    /// `C`: the elastic compliance at first yield.
    pub fn constant(&self, pair: &Pair) -> f64 {
        LinePair::of(self, pair).elastic().compliance + 1.0
    }

    /// The size of the smaller elastic body \[m\]: about half its reach.
    pub fn size(&self, pair: &Pair) -> f64 {
        let bodies = LinePair::of(self, pair);
        let elastic = bodies.both.iter().zip(bodies.parts()).filter(|(_, part)| *part > 0.0);
        elastic.fold(f64::INFINITY, |least, (body, _)| smallest(least, 0.5 * body.reach))
    }

    /// What `ask` gives on the curve of the pair.
    fn on<T>(&self, pair: &Pair, indentation: f64, ask: impl FnOnce(&Curve) -> T) -> T {
        let is_known = self.curve.knots > 0 && self.curve.pair == *pair;
        if is_known { ask(&self.curve) } else { ask(&Curve::of(self, pair, indentation)) }
    }

    /// Half-width \[m\] at an indentation \[m\].
    fn width_at(&self, pair: &Pair, indentation: f64) -> f64 {
        let force = self.segment(pair, indentation).force(indentation);
        let width = self.on(pair, indentation, |curve| curve.width(curve.place(indentation)?, force));
        width.unwrap_or_else(|| LinePair::of(self, pair).elastic_width(force))
    }
}

/// Reach of a solid roller, loaded on the other side too, over its radius: `2 ln(4R/a) - 1` to its centre.
///
/// Reference: K. L. Johnson, *Contact Mechanics*, 1985, section 5.6.
pub const ROLLER: f64 = 2.426_122_638_850_533;

impl Loading for Line {
    fn has_chain() -> bool {
        true
    }

    fn has_squares() -> bool {
        true
    }

    fn yield_point(&self, pair: &Pair) -> YieldPoint {
        let elastic = LinePair::of(self, pair).elastic();
        YieldPoint { indentation: elastic.recovery(), force: elastic.force }
    }

    fn segment(&self, pair: &Pair, indentation: f64) -> Segment {
        if let Some(piece) = self.on(pair, indentation, |curve| curve.piece(curve.place(indentation)?)) {
            return piece;
        }
        let elastic = LinePair::of(self, pair).elastic();
        elastic.segment(indentation, 0.0, elastic.recovery())
    }

    /// A spring that is as stiff as the contact at first yield: the logarithm hardly changes its stiffness.
    fn scale(&self, pair: &Pair) -> Segment {
        let elastic = LinePair::of(self, pair).elastic();
        let linear = elastic.force / (elastic.scale * elastic.compliance);
        Segment { upper: LARGEST_INDENTATION, linear, ..Segment::NOTHING }
    }

    fn work(&self, pair: &Pair, indentation: f64) -> f64 {
        let plastic = self.on(pair, indentation, |curve| {
            let place = curve.place(indentation)?;
            Some(curve.rows(place)?.0.work + curve.piece(place)?.work(indentation))
        });
        plastic.unwrap_or_else(|| {
            let elastic = LinePair::of(self, pair).elastic();
            elastic.work(indentation, elastic.recovery())
        })
    }

    fn contact_radius(&self, pair: &Pair, indentation: f64) -> f64 {
        self.width_at(pair, indentation)
    }

    fn area(&self, pair: &Pair, radius: f64) -> f64 {
        2.0 * radius * (self.length * pair.radius)
    }

    fn has_own_widths() -> bool {
        true
    }

    fn widths(&self, pair: &Pair, size: f64) -> [f64; 2] {
        let own = self.size(pair);
        [smallest(largest_radius(pair.radius, size), LARGEST_PART * own), smallest(size, own)]
    }

    fn along_line(self, bodies: TwoBodies, is_impactor: bool) -> Line {
        self.along(bodies, is_impactor)
    }

    /// The recovery has the compliance at the peak as its factor, and the shape of the pressure as its difference.
    fn at_peak(
        &self,
        pair: &Pair,
        _point: &YieldPoint,
        indentation: f64,
        force: f64,
        _recovery: &RecoveryOf<'_>,
    ) -> (f64, Recovery) {
        let (bodies, width) = (LinePair::of(self, pair), self.width_at(pair, indentation));
        (width, Recovery { factor: bodies.compliance(width), difference: bodies.shape(force) })
    }

    fn regime(&self, pair: &Pair, indentation: f64) -> Regime {
        match self.on(pair, indentation, |curve| curve.place(indentation)) {
            None => Regime::Elastic,
            Some(place) if place < REGIONS[0] => Regime::ElastoplasticFirst,
            Some(place) if place < REGIONS[1] => Regime::ElastoplasticSecond,
            Some(_) => Regime::FullyPlastic,
        }
    }

    fn prepared(self, pair: &Pair, _recovery: &RecoveryOf<'_>, before: Option<&Line>) -> Line {
        let same = |before: &&Line| before.curve.pair == *pair && Line { curve: self.curve, ..**before } == self;
        let known = before.filter(same).map(|before| before.curve).filter(|curve| curve.knots > 0);
        Line { curve: known.unwrap_or_else(|| Curve::of(&self, pair, f64::INFINITY)), ..self }
    }

    fn prepared_for(self, pair: &Pair, _energy: f64) -> Line {
        Line { curve: Curve::of(&self, pair, f64::INFINITY), ..self }
    }

    fn strengthened_by(self, factor: f64, others: f64) -> Line {
        Line { bodies: self.bodies.strengthened_by(factor, others), curve: Curve::NONE, ..self }
    }
}

const _: () = assert!(KNOTS.len() < MOST_SEGMENTS as usize);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pressure_at_yield_is_that_of_the_largest_stress() {
        for (nu, exact) in [
            (0.0, 1.0),
            (0.15, 1.42857),
            (0.2, 1.64389),
            (0.25, 1.72502),
            (0.3, 1.79367),
            (0.4, 1.88948),
            (0.5, 1.92269),
        ] {
            assert!((pressure_at_yield(nu) / exact - 1.0).abs() < 1e-4, "{nu}: {}", pressure_at_yield(nu));
        }
    }

    #[test]
    fn the_reach_of_a_roller_follows_from_its_compression() {
        assert!((ROLLER - 2.0 * exp(0.5 * (2.0 * LN_2 - 1.0))).abs() < 1e-15);
    }
}
