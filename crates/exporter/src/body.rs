//! The two bodies of a contact: their names in scenes, and what each of them has.

use std::f64::consts::PI;

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    Impactor,
    Target,
}

/// The properties that a contact may override.
const IMPACTOR: [&str; 8] = [
    "impactor.radius",
    "impactor.youngs_modulus",
    "impactor.poissons_ratio",
    "impactor.yield_strength",
    "impactor.hardening_modulus",
    "impactor.density",
    "impactor.length",
    "impactor.area",
];
const TARGET: [&str; 8] = [
    "target.radius",
    "target.youngs_modulus",
    "target.poissons_ratio",
    "target.yield_strength",
    "target.hardening_modulus",
    "target.density",
    "target.length",
    "target.area",
];

impl Body {
    pub const ALL: [Body; 2] = [Body::Impactor, Body::Target];

    /// The name of its table in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Body::Impactor => "impactor",
            Body::Target => "target",
        }
    }

    /// The names of its properties. Density, length and area, the last ones, are not variables of the FMU.
    pub const fn properties(self) -> [&'static str; 8] {
        match self {
            Body::Impactor => IMPACTOR,
            Body::Target => TARGET,
        }
    }

    pub const fn radius(self) -> &'static str {
        self.properties()[0]
    }

    pub const fn youngs_modulus(self) -> &'static str {
        self.properties()[1]
    }

    pub const fn poissons_ratio(self) -> &'static str {
        self.properties()[2]
    }

    pub const fn yield_strength(self) -> &'static str {
        self.properties()[3]
    }

    pub const fn hardening_modulus(self) -> &'static str {
        self.properties()[4]
    }

    pub const fn density(self) -> &'static str {
        self.properties()[5]
    }

    pub const fn length(self) -> &'static str {
        self.properties()[6]
    }

    pub const fn area(self) -> &'static str {
        self.properties()[7]
    }

    pub fn other(self) -> Body {
        match self {
            Body::Impactor => Body::Target,
            Body::Target => Body::Impactor,
        }
    }
}

/// A value for each of the two bodies.
#[derive(Clone, Copy, Debug, Default)]
pub struct Both<T> {
    pub impactor: T,
    pub target: T,
}

impl<T> Both<T> {
    /// What `value` gives for each body.
    pub fn each(mut value: impl FnMut(Body) -> T) -> Both<T> {
        Both { impactor: value(Body::Impactor), target: value(Body::Target) }
    }

    /// The same where `value` may fail: the impactor's failure first.
    pub fn try_each<E>(mut value: impl FnMut(Body) -> Result<T, E>) -> Result<Both<T>, E> {
        Ok(Both { impactor: value(Body::Impactor)?, target: value(Body::Target)? })
    }

    pub fn of(&self, body: Body) -> &T {
        match body {
            Body::Impactor => &self.impactor,
            Body::Target => &self.target,
        }
    }

    pub fn of_mut(&mut self, body: Body) -> &mut T {
        match body {
            Body::Impactor => &mut self.impactor,
            Body::Target => &mut self.target,
        }
    }
}

/// A long body of constant cross-section, such as the piston of a hammer, a chisel or a pin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rod {
    /// Density \[kg/m^3\].
    pub density: f64,
    /// Length \[m\].
    pub length: f64,
    /// Area of the cross-section \[m^2\].
    pub area: f64,
}

impl Rod {
    /// Radius of a round cross-section of this area \[m\].
    pub fn radius(&self) -> f64 {
        (self.area / PI).sqrt()
    }
}
