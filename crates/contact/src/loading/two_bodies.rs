//! Two bodies pressed together, from the law `brinell` of each.
//!
//! The surface between the bodies stays nearly a paraboloid. Each body then sees a rigid sphere of an effective radius of its own,
//! `R_1` or `R_2`. Force and contact radius are the same for both, and the curvatures add up to that of the gap:
//! `1/R_1 + 1/R_2 = 1/R`. It follows that **both have the same mean pressure**. The mean pressure of a body does not depend on the
//! radius of its sphere, but only on its depth in yield depths, `k`. With contact radius `a_i` and depth `d_i` of a body under a
//! sphere of radius 1 at this mean pressure `P`:
//!
//! - `R_1 = R (1 + a_2/a_1)`, `R_2 = R (1 + a_1/a_2)`;
//! - contact radius `a = R (a_1 + a_2)`, force `F = pi a^2 P`, indentation `d = R_1 d_1 + R_2 d_2 = a (d_1/a_1 + d_2/a_2)`.
//!
//! No number is fitted. The curve is exact for a rigid partner, for two bodies that are equally strong and do not harden, for equal
//! bodies, and at first yield; below, it is Hertz's. Against finite elements of two bodies (`data/truth/pairs`): force within 1.2 %,
//! restitution within 0.9 %, dent within 2 %; within 1.7 %, 1.1 % and 4.5 % where a body yields that is three times as stiff as an
//! elastic partner.
//!
//! These laws are those of small strain. [`large_strain`](mod@crate::material::large_strain) corrects force, contact radius and recovery of each
//! body that yields. The mean pressure of a body then falls beyond a maximum, so that the construction itself stays with small strain.
//! To first order, a body that is softer by a factor `q_i` makes the pair softer by `q_i^w_i`, where `w_i` is its part of the compliance:
//! of all bodies together, the product of these factors. This is exact for a rigid partner and for equal bodies.

use crate::loading::Brinell;
use crate::material::large_strain::{Correction, Pressed, correction};
use crate::material::strength::{RADIUS_POWER, Strength, area_factor};
use crate::material::{Pair, YieldPoint};
use crate::numerics::dual::Dual;
use crate::numerics::{largest, quotient, smallest};
use core::f64::consts::PI;
use libm::{exp, fabs, log, pow, sqrt};

/// Depths `k` of each body at which the curve of two bodies has value and slope of the construction. They go
/// on geometrically far beyond everything that bodies reach, so that hard ones come near Hertz's law everywhere.
pub const KNOTS: [f64; 53] = {
    let first = [1.0, 2.0, 5.0, 12.0, 30.0, 80.0, 160.0, 250.0, 500.0, 700.0, 1000.0, 2000.0];
    let mut knots = [0.0; 53];
    let mut place = 0;
    while place < knots.len() {
        knots[place] = if place < first.len() { first[place] } else { 2.5 * knots[place - 1] };
        place += 1;
    }
    knots
};

/// The last of them.
const LAST: f64 = KNOTS[KNOTS.len() - 1];

/// Growth of a mean pressure that counts as fully plastic: the depth of the body then grows like that of the other.
const FLAT: f64 = 1e-9;

/// Largest number of iterations of a search.
const GUESSES: u32 = 100;

/// Relative error of a depth `k` after a search.
const CLOSE: f64 = 1e-14;

/// The rounding of what is searched for: a smaller excess is none.
const EXACT: f64 = 4.0 * f64::EPSILON;

/// The body of a pair that [`Pair`] does not describe: the harder one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct OtherBody {
    /// Plane-strain modulus `E/(1 - nu^2)` \[Pa\]; infinite for a rigid body.
    pub modulus: f64,
    /// Poisson's ratio \[-\].
    pub poissons_ratio: f64,
    /// Yield strength \[Pa\]; infinite for a body that stays elastic.
    pub yield_strength: f64,
    /// Hardening modulus \[Pa\].
    pub hardening_modulus: f64,
}

impl OtherBody {
    /// A rigid body.
    pub const RIGID: OtherBody = OtherBody {
        modulus: f64::INFINITY,
        poissons_ratio: 0.0,
        yield_strength: f64::INFINITY,
        hardening_modulus: 0.0,
    };
}

/// What the law `brinell` needs to know of two bodies beside their [`Pair`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct TwoBodies {
    /// Hardening modulus `H` of the softer body, which the pair describes \[Pa\]: `sigma = S + H eps_p`.
    pub hardening_modulus: f64,
    /// The part of the gap's curvature `1/R` that is the softer body's own: `R` over its radius. 0 for a plane, 1 for a sphere on a
    /// plane, below 0 for a socket \[-\].
    pub curvature: f64,
    /// The harder body.
    pub other: OtherBody,
}

impl TwoBodies {
    /// A rigid sphere on a plane with this hardening modulus \[Pa\].
    pub const fn under_rigid(hardening_modulus: f64) -> TwoBodies {
        TwoBodies { hardening_modulus, curvature: 0.0, other: OtherBody::RIGID }
    }

    /// The bodies with `factor` times the hardening of the softer one, and `others` times strength and hardening of the other one.
    pub fn strengthened_by(self, factor: f64, others: f64) -> TwoBodies {
        let other = OtherBody {
            yield_strength: others * self.other.yield_strength,
            hardening_modulus: others * self.other.hardening_modulus,
            ..self.other
        };
        TwoBodies { hardening_modulus: factor * self.hardening_modulus, other, ..self }
    }
}

/// A body that yields, under a rigid sphere of radius 1.
#[derive(Clone, Copy)]
pub struct Yielding {
    /// Plane-strain modulus \[Pa\].
    pub modulus: f64,
    /// The form of the law for its hardening and its Poisson's ratio, if it needs one.
    pub strength: Option<Strength>,
    /// Depth at first yield.
    depth: f64,
    /// Mean pressure at first yield \[Pa\].
    pressure: f64,
    /// The yield strength at the pressure of first yield, over the modulus.
    flexibility: f64,
    /// The part of the gap's curvature that is its own.
    curvature: f64,
}

/// Force over yield force and `a^2/(R d_y)` of a body at its own depth `k` in yield depths, with their slopes over `k`.
#[derive(Clone, Copy)]
pub struct OwnCurve {
    /// `F/F_y`.
    pub force: f64,
    /// Its slope.
    pub force_slope: f64,
    /// `a^2/(R d_y)`.
    pub area: f64,
    /// Its slope.
    pub area_slope: f64,
}

/// The derivative of the logarithm of a quantity, over that of the larger of the depths `k`.
type Growth = f64;

/// A body at some mean pressure, under a rigid sphere of radius 1.
#[derive(Clone, Copy)]
struct Shape {
    /// Contact radius, and its growth.
    radius: (f64, Growth),
    /// Depth over contact radius, and its growth.
    relative_depth: (f64, Growth),
    /// Depth in yield depths; `None` for a body that stays elastic.
    k: Option<f64>,
    /// The curve of the body there and the growth of `k`, if it has yielded.
    yielded: Option<(OwnCurve, Growth)>,
}

/// A point of the construction.
#[derive(Clone, Copy)]
struct Point {
    /// Mean pressure \[Pa\], and its growth.
    pressure: (f64, Growth),
    /// Contact radius over `R`, and its growth.
    radius: (f64, Growth),
    /// Indentation over `R`, and its growth.
    indentation: (f64, Growth),
    /// The body that yields first, and the other one.
    shapes: [Shape; 2],
}

/// A point of the curve of two bodies with a gap of radius `R`.
#[derive(Clone, Copy)]
pub struct Together {
    /// Indentation over `R`.
    pub indentation: f64,
    /// Force over `R^2` \[Pa\].
    pub force: f64,
    /// The force over that of the construction.
    pub ratio: f64,
    /// Stiffness over `R` \[Pa\].
    pub stiffness: f64,
    /// Contact radius over `R`.
    pub radius: f64,
    /// Depths in yield depths of their own, of the body that yields first and of the other one; `None` for one that stays elastic.
    pub depths: [Option<f64>; 2],
    /// [Measures of the plastic strain](Correction::strain) of both.
    pub strains: [f64; 2],
    /// The part of the gap's curvature `1/R` that the body of the pair takes on: `R/R_i`.
    pub share: f64,
}

impl Together {
    /// The same point with another force over `R^2` \[Pa\]: see [`Construction::at_indentation`].
    pub fn with_force(self, force: f64) -> Together {
        let ratio = force / self.force;
        Together { force, ratio, radius: self.radius * sqrt(area_factor(ratio)), ..self }
    }
}

impl Yielding {
    /// This body, with its part of the gap's curvature.
    fn new(law: &Brinell, body: &OtherBody, curvature: f64) -> Yielding {
        let OtherBody { modulus, poissons_ratio, yield_strength, hardening_modulus } = *body;
        let strength = Strength::of(modulus, poissons_ratio, hardening_modulus);
        let standard = law.yield_pressure_factor * yield_strength;
        let pressure = strength.map_or(standard, |strength| strength.at_yield() * standard);
        let strain = 0.75 * PI * (pressure / modulus);
        let flexibility = pressure / (law.yield_pressure_factor * modulus);
        Yielding { modulus, strength, depth: strain * strain, pressure, flexibility, curvature }
    }

    /// The curve of the body at `k >= 1` yield depths, for small strain. With hardening, or another Poisson's ratio than 0.3:
    ///
    /// - force `phi = t^3 Phi(k/t^2)`, and `phi_nu` with the part of `t` that the Poisson's ratio has;
    /// - area `phi_nu (Phi(k)/A(k))^-b (phi/phi_nu)^-0.8509`, with `b = 1 - ln s0/ln p` and the mean pressure `p` of deep dents over
    ///   that at first yield, for a ratio of 0.3. So the mean pressure rises with the depth, to one that is the same for all Poisson's
    ///   ratios. A harder body has a smaller contact, but not a smaller one than Hertz's.
    #[inline(never)]
    pub fn curve(&self, law: &Brinell, k: f64) -> OwnCurve {
        let ((plain, plain_slope), (area, area_slope)) = (law.force_and_slope(k), law.area_and_slope(k));
        let Some(strength) = &self.strength else {
            return OwnCurve { force: plain, force_slope: plain_slope, area, area_slope };
        };
        let of = |(t, slope_of_t): (f64, f64)| {
            let (force, slope) = law.force_and_slope(k / (t * t));
            let slope = slope_of_t * (3.0 * t * t * force - 2.0 * k * slope) + t * slope;
            (t * t * t * force, slope / (t * t * t * force))
        };
        let (force, growth) = of(strength.at(k));
        // without an effect of the Poisson's ratio, the law itself
        let has_ratio = strength.at_yield() != 1.0;
        let (soft, soft_growth) =
            if has_ratio { of(strength.of_poissons_ratio(k)) } else { (plain, plain_slope / plain) };
        let exponent = if has_ratio { 1.0 - log(strength.at_yield()) / log(law.plastic_pressure()) } else { 1.0 };
        let whole = area / plain;
        let raised = if has_ratio { pow(whole, exponent) } else { whole };
        let area_growth =
            soft_growth - exponent * (plain_slope / plain - area_slope / area) - RADIUS_POWER * (growth - soft_growth);
        let area = soft * raised * area_factor(force / soft);
        let (area, area_slope) = if area < k { (k, 1.0) } else { (area, area * area_growth) };
        OwnCurve { force, force_slope: force * growth, area, area_slope }
    }

    /// Mean pressure \[Pa\] at `k >= 1` yield depths, and its growth.
    fn mean_pressure(&self, k: f64, curve: &OwnCurve) -> (f64, Growth) {
        let growth = k * (curve.force_slope / curve.force - curve.area_slope / curve.area);
        (self.pressure * (curve.force / curve.area), growth)
    }

    /// The shape at `k >= 1`, where the depth has this growth.
    fn shape(&self, k: f64, curve: &OwnCurve, growth: Growth) -> Shape {
        let (size, root) = (sqrt(self.depth), sqrt(curve.area));
        let spread = 0.5 * k * (curve.area_slope / curve.area);
        Shape {
            radius: (size * root, growth * spread),
            relative_depth: (size * (k / root), growth * (1.0 - spread)),
            k: Some(k),
            yielded: Some((*curve, growth)),
        }
    }

    /// What large strain changes at this `shape`, where the contact radius over `R` is `radius`.
    fn correction(&self, shape: &Shape, radius: (f64, Growth)) -> Correction {
        let (Some(k), Some((curve, growth))) = (shape.k, shape.yielded) else { return Correction::NONE };
        let own = |value: f64, growth: Growth| Dual { value, slope: value * growth };
        // the effective radius is R over the part that the body takes on
        let curvature = self.curvature * (radius.0 / shape.radius.0);
        let curvature = if curvature <= 0.0 {
            Dual::constant(0.0)
        } else if curvature >= 1.0 {
            Dual::constant(1.0)
        } else {
            own(curvature, radius.1 - shape.radius.1)
        };
        correction(&Pressed {
            k: own(k, growth),
            force: Dual { value: curve.force, slope: growth * k * curve.force_slope },
            area: curve.area / k,
            radius: own(shape.radius.0, shape.radius.1),
            curvature,
            flexibility: self.flexibility,
        })
    }

    /// The shape at this mean `pressure` \[Pa\] and its growth, probably at about the depth `like`; `None` for a pressure that the
    /// body never reaches.
    #[inline(never)]
    fn follow(&self, law: &Brinell, (pressure, growth): (f64, Growth), like: f64) -> Option<Shape> {
        if pressure <= self.pressure {
            let part = pressure / self.pressure;
            return Some(Shape { k: Some(part * part), ..elastic_shape(self.modulus, (pressure, growth)) });
        }
        let at = |k: f64| {
            let curve = self.curve(law, k);
            (self.mean_pressure(k, &curve), curve)
        };
        let ((there, own), curve) = at(like);
        // equal bodies have the same depth, to the last bit
        let (k, (own, curve)) = if there == pressure {
            (like, (own, curve))
        } else {
            let bounds = if there > pressure { (1.0, like) } else { (like, LAST) };
            if there < pressure && at(LAST).0.0 < pressure {
                return None;
            }
            // Hertz's depth for this pressure is below the right one, from where Newton's method does not overshoot
            let part = pressure / self.pressure;
            search(bounds, part * part, |k| {
                let ((found, growth), curve) = at(k);
                (log(found / pressure), growth, (growth, curve))
            })
        };
        Some(self.shape(k, &curve, quotient(growth, own, own > FLAT, 1.0)))
    }
}

/// The shape of a body that is elastic at this mean pressure \[Pa\]: `d = a^2`, `P = 4 E a/(3 pi)`. A rigid body has no depth.
fn elastic_shape(modulus: f64, (pressure, growth): (f64, Growth)) -> Shape {
    let radius = 0.75 * PI * (pressure / modulus);
    Shape { radius: (radius, growth), relative_depth: (radius, growth), k: None, yielded: None }
}

/// The depth `k` between two bounds at which `excess` is zero, and what else it gives there. It rises; its value and its growth are
/// asked for. Newton's method over `ln k` within a bracket, starting at `guess`.
fn search<T>((low, high): (f64, f64), guess: f64, excess: impl Fn(f64) -> (f64, Growth, T)) -> (f64, T) {
    let (mut low, mut high) = (log(low), log(high));
    let mut guess = largest(low, smallest(log(guess), high));
    let mut last = f64::INFINITY;
    let mut left = GUESSES;
    loop {
        let k = exp(guess);
        let (beyond, slope, found) = excess(k);
        left -= 1;
        if fabs(beyond) < EXACT || left == 0 {
            return (k, found);
        }
        *(if beyond < 0.0 { &mut low } else { &mut high }) = guess;
        // no division by a slope whose step would leave the bracket
        let leads = fabs(beyond) < slope * (high - low);
        let next = guess - quotient(beyond, slope, leads, f64::MAX);
        // Newton's method may go to and fro where the curve bends much
        let halves = fabs(beyond) < 0.5 * last;
        let next = if next > low && next < high && halves { next } else { 0.5 * (low + high) };
        last = fabs(beyond);
        if fabs(next - guess) < CLOSE {
            return (k, found);
        }
        guess = next;
    }
}

/// The sum of two terms, each with its growth.
fn sum((one, one_growth): (f64, Growth), (other, other_growth): (f64, Growth)) -> (f64, Growth) {
    let sum = one + other;
    (sum, (one * one_growth + other * other_growth) / sum)
}

impl Shape {
    /// The depth over the contact radius that a growing force adds: `d(depth)/d(ln F)` of this body alone.
    fn compliance(&self) -> f64 {
        let exponent = match (self.k, self.yielded) {
            (Some(k), Some((curve, _))) => k * (curve.force_slope / curve.force),
            _ => 1.5,
        };
        self.relative_depth.0 / exponent
    }
}

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lead {
    /// The one that yields first.
    Soft,
    /// The other one.
    Hard,
}

/// The construction for a pair.
pub struct Construction<'a> {
    /// The law of one body.
    pub law: &'a Brinell,
    /// The body that yields first.
    pub soft: Yielding,
    /// Plane-strain modulus of the other one \[Pa\].
    hard_modulus: f64,
    /// Effective modulus `E*` of the pair \[Pa\].
    modulus: f64,
    /// The other one, if it may yield.
    pub hard: Option<Yielding>,
    /// Whether the body that yields first is not the one that the pair describes: it is stronger, but has a lower Poisson's ratio.
    is_exchanged: bool,
}

impl<'a> Construction<'a> {
    /// The construction for the bodies of `pair`.
    #[inline(never)]
    pub fn of(law: &'a Brinell, pair: &Pair, bodies: &TwoBodies) -> Construction<'a> {
        let TwoBodies { hardening_modulus, curvature, other } = *bodies;
        let softer = OtherBody {
            modulus: pair.yielding_modulus(),
            poissons_ratio: pair.poissons_ratio,
            yield_strength: pair.yield_strength,
            hardening_modulus,
        };
        let soft = Yielding::new(law, &softer, curvature);
        let may_yield = other.yield_strength < f64::INFINITY && other.modulus < f64::INFINITY;
        let hard = may_yield.then(|| Yielding::new(law, &other, 1.0 - curvature));
        // by the pressure and not by the strength: the knots are those of the body that yields first, whatever is set
        match hard {
            Some(first) if first.pressure < soft.pressure => Construction {
                law,
                soft: first,
                hard_modulus: soft.modulus,
                hard: Some(soft),
                modulus: pair.modulus,
                is_exchanged: true,
            },
            _ => Construction {
                law,
                soft,
                hard_modulus: other.modulus,
                hard,
                modulus: pair.modulus,
                is_exchanged: false,
            },
        }
    }

    /// The parts of the two bodies in the elastic compliance of the pair, `E*/E_i`.
    pub fn compliances(&self) -> [f64; 2] {
        [self.soft.modulus, self.hard_modulus].map(|modulus| self.modulus / modulus)
    }

    /// The yield point of the pair, where the first of the two yields.
    pub fn yield_point(&self, pair: &Pair) -> YieldPoint {
        let pressure = self.soft.pressure;
        let standard = pair.yield_point(self.law.yield_pressure_factor);
        let ratio = pressure / (self.law.yield_pressure_factor * pair.yield_strength);
        let indentation = ratio * ratio * standard.indentation;
        YieldPoint { indentation, force: pair.hertz_stiffness() * (indentation * sqrt(indentation)) }
    }

    /// The point where the body with the larger depth is at `k >= 1` yield depths of its own: at the same `k`, the body with the lower
    /// mean pressure leads. So the point is a continuous function of `k` for any two bodies.
    fn at(&self, k: f64) -> Point {
        let mean = |body: &Yielding| body.mean_pressure(k, &body.curve(self.law, k)).0;
        let leads = |hard: &Yielding| {
            let soft = mean(&self.soft);
            // below its first yield a body does not lead
            hard.pressure < soft && mean(hard) < soft
        };
        let lead = if self.hard.as_ref().is_some_and(leads) { Lead::Hard } else { Lead::Soft };
        // the leader has the lower mean pressure, which the other one reaches
        self.construct(lead, k).unwrap_or(Point::NOWHERE)
    }

    /// The point where a body is at `k >= 1` yield depths of its own; `None` if the other one never reaches the mean pressure there, or
    /// if the body does not yield.
    pub fn led_by(&self, lead: Lead, k: f64) -> Option<Together> {
        self.construct(lead, k).map(|point| self.together(&point))
    }

    #[inline(never)]
    fn construct(&self, lead: Lead, k: f64) -> Option<Point> {
        let leader = match lead {
            Lead::Soft => &self.soft,
            Lead::Hard => self.hard.as_ref()?,
        };
        let curve = leader.curve(self.law, k);
        let pressure = leader.mean_pressure(k, &curve);
        let shape = leader.shape(k, &curve, 1.0);
        let (soft, hard) = match (lead, &self.hard) {
            (Lead::Soft, Some(hard)) => (shape, hard.follow(self.law, pressure, k)?),
            (Lead::Soft, None) => (shape, elastic_shape(self.hard_modulus, pressure)),
            (Lead::Hard, _) => (self.soft.follow(self.law, pressure, k)?, shape),
        };
        let radius = sum(soft.radius, hard.radius);
        let relative_depth = sum(soft.relative_depth, hard.relative_depth);
        let indentation = (radius.0 * relative_depth.0, radius.1 + relative_depth.1);
        Some(Point { pressure, radius, indentation, shapes: [soft, hard] })
    }

    /// The point with the force and the contact radius of large strain.
    #[inline(never)]
    fn together(&self, point: &Point) -> Together {
        let Point { pressure, radius, indentation, shapes: [soft, hard] } = *point;
        let of_soft = self.soft.correction(&soft, radius);
        let of_hard = self.hard.as_ref().map_or(Correction::NONE, |body| body.correction(&hard, radius));
        let (one, other) = (soft.compliance(), hard.compliance());
        let [part, rest] = [one, other].map(|own| own / (one + other));
        // the exponents of force over depth change slowly, and the parts as the depths
        let drift = part * rest * (soft.relative_depth.1 - hard.relative_depth.1);
        let both = |one: f64, other: f64| {
            // beside a rigid body nothing is raised to a power
            if other == 1.0 && rest == 0.0 { one } else { exp(part * log(one) + rest * log(other)) }
        };
        let [one, other] = [of_soft.force, of_hard.force];
        let mixing = if drift == 0.0 { 0.0 } else { drift * log(one.value / other.value) };
        let change_growth = part * (one.slope / one.value) + rest * (other.slope / other.value) + mixing;
        let force = PI * radius.0 * radius.0 * pressure.0 * both(one.value, other.value);
        let force_growth = pressure.1 + 2.0 * radius.1 + change_growth;
        let own = if self.is_exchanged { hard.radius.0 } else { soft.radius.0 };
        Together {
            indentation: indentation.0,
            force,
            ratio: 1.0,
            stiffness: force / indentation.0 * (force_growth / indentation.1),
            radius: radius.0 * sqrt(both(of_soft.area, of_hard.area)),
            depths: [soft.k, hard.k],
            strains: [of_soft.strain, of_hard.strain],
            share: own / radius.0,
        }
    }

    /// The point at `indentation` over `R`, at first yield or beyond, for a force of `force` over `R^2` \[Pa\] there. Between the knots
    /// this force may differ from that of the construction. It counts as that of harder or softer bodies: at a given indentation, the
    /// contact radius falls with the force, by the same power as with the hardening. The forces of the single bodies are to be taken
    /// times the same [ratio](Together::ratio).
    #[inline(never)]
    pub fn at_indentation(&self, indentation: f64, force: f64) -> Together {
        self.along(indentation).with_force(force)
    }

    /// The point of the construction at `indentation` over `R`, at first yield or beyond. Beyond the last knot, the larger depth is
    /// proportional to it.
    pub fn along(&self, indentation: f64) -> Together {
        self.together(&self.reach(indentation))
    }

    /// The same, without large strain.
    #[inline(never)]
    fn reach(&self, indentation: f64) -> Point {
        // a depth in yield depths of the pair, if it were that of a body
        let share = self.soft.modulus / self.hard_modulus;
        let first = self.soft.depth * (1.0 + share) * (1.0 + share);
        if share == 0.0 {
            // under a rigid body it is
            return self.at(largest(indentation / first, 1.0));
        }
        let (k, point) = search((1.0, LAST), largest(indentation / first, 1.0), |k| {
            let point = self.at(k);
            (log(point.indentation.0 / indentation), point.indentation.1, point)
        });
        let is_within = k < LAST * (1.0 - 1e-9);
        if is_within { point } else { self.at(LAST * (indentation / point.indentation.0)) }
    }

    /// The depths of both bodies in yield depths of their own at `indentation` over `R`, as in [`Together::depths`].
    pub fn depths(&self, indentation: f64) -> [Option<f64>; 2] {
        self.reach(indentation).shapes.map(|shape| shape.k)
    }
}

impl Point {
    /// The point that never comes.
    const NOWHERE: Point = Point {
        pressure: (0.0, 0.0),
        radius: (f64::MAX, 1.0),
        indentation: (f64::MAX, 1.0),
        shapes: [Shape { radius: (1.0, 0.0), relative_depth: (1.0, 0.0), k: None, yielded: None }; 2],
    };
}
