//! The elastoplastic laws of LAMMPS and LIGGGHTS.

use crate::bisection::border;
use libm::{acos, exp, hypot, pow, sqrt};
use std::f64::consts::PI;

/// Poisson's ratio of the materials that are no material's.
pub const POISSON: f64 = 0.3;

/// An elastoplastic sphere on a rigid flat: Hertz's contact until its mean pressure is that of the yielding sphere,
/// `Y (1 + 1.75 exp(-4.4 x/R))` at the largest overlap; then this pressure on an area that grows as the sphere is cut. The
/// elastic part is the contact of an elliptical indenter, which the method of dimensionality reduction makes of it.
///
/// Reference: W. Zunker, K. Kamrin, *J. Mechanics and Physics of Solids* 183 (2024) 105492.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    /// Plane-strain modulus `E/(1 - nu^2)` \[Pa\] of the sphere.
    pub modulus: f64,
    /// Yield strength \[Pa\].
    pub strength: f64,
    /// \[m\]
    pub radius: f64,
    /// The overlap \[m\] where it yields.
    yields: f64,
    /// The overlap \[m\] where a tool in steps finds that it has yielded.
    noticed: Option<f64>,
}

impl Plastic {
    pub fn new(modulus: f64, strength: f64, radius: f64) -> Plastic {
        let mut plastic = Plastic { modulus, strength, radius, yields: f64::INFINITY, noticed: None };
        // at a depth of zero the pressure of the yielding sphere is largest
        let most = 0.75 * PI * plastic.pressure(0.0) / modulus;
        let high = radius * most * most;
        if high.is_finite() {
            let yielded = |x: f64| 4.0 * modulus * sqrt(x / radius) / (3.0 * PI) > plastic.pressure(x);
            plastic.yields = border((0.0, high), yielded);
        }
        plastic
    }

    /// Yield begins at the first step beyond it.
    pub fn noticing(self, x: f64) -> Plastic {
        let now = self.noticed.is_none() && x > self.yields;
        if now { Plastic { noticed: Some(x), ..self } } else { self }
    }

    /// The mean pressure \[Pa\] of the yielding sphere at the largest overlap `deepest` \[m\].
    fn pressure(&self, deepest: f64) -> f64 {
        self.strength * (1.0 + 1.75 * exp(-4.4 * deepest / self.radius))
    }

    /// The force \[N\] at the overlap `x` and the largest one so far \[m\].
    pub fn force(&self, x: f64, deepest: f64) -> f64 {
        let Plastic { modulus, radius, .. } = *self;
        if deepest <= self.yields {
            return self.indented(x, 4.0 * radius, 2.0 * radius);
        }
        let start = self.noticed.unwrap_or(self.yields);
        let area = 2.0 * deepest * radius - deepest * deepest + start * start - start * radius;
        let (pressure, contact) = (self.pressure(deepest), sqrt(area.max(0.0)));
        let half = 2.0 * pressure / modulus * contact;
        // how far the surface beside the contact goes with it
        let centre = radius - deepest + half;
        let (far, shear) = (hypot(contact, centre), 0.5 * modulus * (1.0 - POISSON));
        let moved = pressure / (2.0 * shear * far)
            * ((1.0 - 2.0 * POISSON) * centre * (far - centre) - 2.0 * (1.0 - POISSON) * area);
        let elastic = (x - deepest + half + moved) / (1.0 + moved / half);
        self.indented(elastic, 2.0 * half, 2.0 * contact)
    }

    /// The force \[N\] of an elliptical indenter of this `height` and `width` \[m\] at the depth `x` \[m\].
    fn indented(&self, x: f64, height: f64, width: f64) -> f64 {
        let part = (x / height).clamp(0.0, 1.0);
        let bent = acos(1.0 - 2.0 * part) - (1.0 - 2.0 * part) * sqrt(4.0 * part * (1.0 - part));
        0.25 * self.modulus * height * width * bent
    }
}

/// Hertz's contact up to the overlap of yield, then the slope of that overlap; unloading with Hertz's slope, from the force that
/// was reached. A dent is left.
///
/// Reference: C. Thornton, Z. Ning, *Powder Technology* 99 (1998) 154-162, without adhesion. There the radius of the contact grows
/// as the sphere yields; LIGGGHTS leaves it as it is without adhesion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thornton {
    /// Hertz's `4/3 E* sqrt(R)` \[N/m^1.5\].
    pub stiffness: f64,
    /// The overlap \[m\] where yield begins.
    pub limit: f64,
    /// Where a tool in steps was last, its force there \[N\], and whether it has yielded.
    last: (f64, f64, bool),
}

impl Thornton {
    pub fn new(stiffness: f64, limit: f64) -> Thornton {
        Thornton { stiffness, limit, last: (0.0, 0.0, false) }
    }

    /// The force \[N\] at the overlap `x` and the largest one so far \[m\].
    pub fn force(&self, x: f64, deepest: f64) -> f64 {
        let Thornton { stiffness, limit, last } = *self;
        if x > 0.0 && last.0 == x {
            return last.1;
        }
        let hertz = |x: f64| stiffness * pow(x, 1.5);
        let slope = 1.5 * stiffness * sqrt(limit.min(deepest));
        let reached = hertz(limit.min(deepest)) + slope * (deepest - limit).max(0.0);
        (reached - (hertz(deepest) - hertz(x))).max(0.0)
    }

    /// The force is summed up: the slope at a step's end times the way of the step.
    pub fn noticing(self, x: f64, deepest: f64) -> Thornton {
        let Thornton { stiffness, limit, last: (before, force, had_yielded) } = self;
        if x <= 0.0 {
            return self;
        }
        let loads = x >= deepest;
        let yielded = had_yielded || loads && x >= limit;
        let slope = 1.5 * stiffness * sqrt(if loads && yielded { limit } else { x });
        Thornton { last: (x, (force + slope * (x - before)).max(0.0), yielded), ..self }
    }
}
