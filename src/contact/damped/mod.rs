//! Rate-dependent laws, one file each: an elastic force and a damping that grows with the rate, as multibody tools use
//! them. They leave no dent.
//!
//! All have the form `F = K phi(d) + C psi(d) d'`, never below zero: where the sum is negative, the bodies separate faster
//! than the surface follows. The force depends on the rate at the same instant, and the `ModelStructure` of the FMU says so.

pub mod history;
pub mod impact;

pub use history::History;

// `pub mod tsuji; pub use tsuji::Tsuji;` and so on, of every law in modelDescription/laws.toml; see build/laws.rs
include!(concat!(env!("OUT_DIR"), "/damped_laws.rs"));

use super::material::Pair;
use super::validity::LARGEST_RADIUS_RATIO;
use libm::sqrt;

/// What is in contact, by which rate-dependent law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<D> {
    /// The two bodies.
    pub pair: Pair,
    /// The law with its own constants.
    pub law: D,
    /// The coefficient of restitution that the damping is made for, in (0, 1]; laws with a damping of their own ignore it.
    pub restitution: f64,
    /// Effective mass that the damping is made for \[kg\] > 0; laws that need none ignore it.
    pub mass: f64,
}

impl<D> Model<D> {
    /// The indentation up to which the law is valid \[m\]: the contact radius is Hertz's, `a^2 = R d`.
    pub fn valid_depth(&self) -> f64 {
        LARGEST_RADIUS_RATIO * LARGEST_RADIUS_RATIO * self.pair.radius
    }
}

/// A function of the indentation, with its derivative and its integral from zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Value.
    pub value: f64,
    /// Derivative by the indentation \[1/m\].
    pub slope: f64,
    /// Integral from zero indentation \[m\].
    pub integral: f64,
}

/// The factors of the two shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// `K`: times `phi` a force \[N\].
    pub elastic: f64,
    /// `C`: times `psi` a damping coefficient \[N.s/m\]; of a law that [scales by the touch speed](Damped::scaled_by_touch)
    /// the coefficient times that speed \[N\].
    pub damping: f64,
}

/// A rate-dependent law: the law's own constants, without the bodies. All indentations are in m and not negative.
pub trait Damped {
    /// `K` and `C` for these bodies.
    fn factors(&self, pair: &Pair, restitution: f64, mass: f64) -> Factors;

    /// `phi`, the shape of the elastic force: Hertz's, `d^1.5`.
    fn elastic(&self, indentation: f64) -> Shape {
        power_three_halves(indentation)
    }

    /// `psi`, the shape of the damping.
    fn damping(&self, indentation: f64) -> Shape;

    /// Whether the damping is made for a coefficient of restitution.
    fn needs_restitution(&self) -> bool {
        false
    }

    /// Whether the damping is made for a mass.
    fn needs_mass(&self) -> bool {
        false
    }

    /// Whether the damping is divided by the closing speed at first touch.
    fn scaled_by_touch(&self) -> bool {
        false
    }

    /// Indentations between which `phi/psi` is monotone \[m\], in order: where the force can change its sign more than once.
    fn borders(&self) -> [f64; 2] {
        [0.0; 2]
    }
}

/// `d^1.5`.
fn power_three_halves(d: f64) -> Shape {
    let root = sqrt(d);
    Shape { value: d * root, slope: 1.5 * root, integral: 0.4 * d * d * root }
}
