//! Two bodies: sphere, half-space, effective radius and modulus, yield point.
//!
//! The files beside have what laws ask of the bodies: hardening, strength, large strain, and contacts that are ellipses or lines.

pub mod ellipse;
pub mod hardening;
pub mod large_strain;
pub mod line;
pub mod strength;

use libm::sqrt;

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Radius of curvature \[m\]; infinite for a flat, negative for a socket.
    pub radius: f64,
    /// Young's modulus \[Pa\] > 0; infinite for a rigid body.
    pub youngs_modulus: f64,
    /// Poisson's ratio \[-\], above -1 and at most 0.5.
    pub poissons_ratio: f64,
}

impl Body {
    /// A rigid sphere of this `radius` \[m\].
    pub fn rigid(radius: f64) -> Body {
        Body { radius, youngs_modulus: f64::INFINITY, poissons_ratio: 0.0 }
    }

    /// A flat body.
    pub fn flat(youngs_modulus: f64, poissons_ratio: f64) -> Body {
        Body { radius: f64::INFINITY, youngs_modulus, poissons_ratio }
    }

    /// Plane-strain modulus `E / (1 - nu^2)` \[Pa\].
    pub fn plane_strain_modulus(&self) -> f64 {
        self.youngs_modulus / (1.0 - self.poissons_ratio * self.poissons_ratio)
    }

    /// The part of the gap's curvature `1/R` that is its own, beside the `other` body: `R` over its radius. The parts of both add up to
    /// 1 \[-\].
    pub fn curvature(&self, other: &Body) -> f64 {
        1.0 / (1.0 + self.radius / other.radius)
    }
}

/// The two bodies in the form that the contact laws use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Effective radius `R` \[m\]: `1/R = 1/R1 + 1/R2`.
    pub radius: f64,
    /// Effective modulus `E*` \[Pa\]: `1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2`.
    pub modulus: f64,
    /// Yield strength `S` of the softer body, which yields \[Pa\]; infinite for an elastic contact.
    pub yield_strength: f64,
    /// Young's modulus of that body \[Pa\], which some laws need in addition to `E*`.
    pub youngs_modulus: f64,
    /// Poisson's ratio of that body \[-\].
    pub poissons_ratio: f64,
}

/// The point where the contact begins to yield.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct YieldPoint {
    /// Indentation `d_y` \[m\].
    pub indentation: f64,
    /// Force `F_y` \[N\].
    pub force: f64,
}

/// The smallest radius of curvature of a body \[m\]. Contact mechanics does not apply below the size of an atom.
pub const SMALLEST_RADIUS: f64 = 1e-12;

impl Pair {
    /// The pair of `impactor` and `target`. The target yields at `yield_strength` \[Pa\]; [`Pair::yielding_in`] lets the
    /// impactor yield.
    ///
    /// With a rigid body or a flat target, `E/(1-nu^2)` or `R` of the other body is used without rounding. `None` if both
    /// bodies are rigid or if they cannot touch at one point: a socket must be wider than the impactor (`R2 < -R1`), the
    /// impactor must not be flat, and no radius may be smaller than [`SMALLEST_RADIUS`].
    ///
    /// Reference: K. L. Johnson, *Contact Mechanics*, Cambridge 1985, section 4.2.
    pub fn new(impactor: &Body, target: &Body, yield_strength: f64) -> Option<Pair> {
        let curvature_ratio = 1.0 + impactor.radius / target.radius;
        let (one, other) = (impactor.plane_strain_modulus(), target.plane_strain_modulus());
        let (soft, hard) = if other <= one { (other, one) } else { (one, other) };
        let modulus = soft / (1.0 + soft / hard);
        // written positively to reject NaN
        let touch = curvature_ratio > 0.0
            && impactor.radius >= SMALLEST_RADIUS
            && impactor.radius < f64::INFINITY
            && target.radius.abs() >= SMALLEST_RADIUS;
        let deform = modulus > 0.0 && modulus < f64::INFINITY;
        (touch && deform).then_some(Pair {
            radius: impactor.radius / curvature_ratio,
            modulus,
            yield_strength,
            youngs_modulus: target.youngs_modulus,
            poissons_ratio: target.poissons_ratio,
        })
    }

    /// The same pair where `body`, one of the two, is the softer one and yields at `yield_strength` \[Pa\].
    ///
    /// Radius and modulus stay the same. The other body is that of [`TwoBodies`](crate::TwoBodies), for a law that looks at it.
    ///
    /// Reference: Johnson 1985, sections 4.2 and 6.2.
    pub fn yielding_in(self, body: &Body, yield_strength: f64) -> Pair {
        Pair { yield_strength, youngs_modulus: body.youngs_modulus, poissons_ratio: body.poissons_ratio, ..self }
    }

    /// Plane-strain modulus of the body that yields \[Pa\].
    pub fn yielding_modulus(&self) -> f64 {
        self.youngs_modulus / (1.0 - self.poissons_ratio * self.poissons_ratio)
    }

    /// The part of the gap's curvature `1/R` that the body which yields takes on by Hertz's law: `E*/E_y`, with the
    /// [modulus](Pair::yielding_modulus) `E_y` of this body. It sees a rigid sphere of the radius `R` over this part.
    ///
    /// It is 1 if the other body is rigid, and 1/2 for two equal bodies: by symmetry the plane between them stays flat. The depths of
    /// elastic bodies, and so the curvatures that they take on, are as `1/E`.
    ///
    /// Reference: Johnson 1985, section 4.2.
    pub fn share(&self) -> f64 {
        self.modulus / self.yielding_modulus()
    }

    /// `K_h = (4/3) E* sqrt(R)` \[N/m^1.5\], the constant of Hertz's law `F = K_h d^1.5`.
    ///
    /// Reference: Johnson 1985, eq. 4.23.
    pub fn hertz_stiffness(&self) -> f64 {
        4.0 / 3.0 * self.modulus * sqrt(self.radius)
    }

    /// The point of Hertz's curve where the mean pressure is `pressure_factor` times the yield strength.
    ///
    /// `d_y = R (3 pi p / (4 E*))^2` and `F_y = K_h d_y^1.5`, with `p = pressure_factor S`. The force is computed from `K_h`,
    /// not from its own closed form, so that it continues Hertz's law to the last bit.
    pub fn yield_point(&self, pressure_factor: f64) -> YieldPoint {
        let strain = 0.75 * core::f64::consts::PI * pressure_factor * self.yield_strength / self.modulus;
        let indentation = self.radius * strain * strain;
        YieldPoint { indentation, force: self.hertz_stiffness() * (indentation * sqrt(indentation)) }
    }
}
