//! Losses of a contact that does not yield, on top of any elastoplastic law. With them a ball comes to rest in its dent.
//!
//! | loss | force | parameter |
//! |---|---|---|
//! | [`RestitutionFitted`] | `F = F_s (1 + chi v/v0)` | a coefficient of restitution |
//! | [`HalfSpaceRadiation`] | `F = F_s + kappa K_s^2 v` | density and moduli of the target: a half-space |
//! | [`Plate`] | `F = F_s`, but the target yields at the speed `alpha F` | density, moduli and thickness of the target |
//! | [`Damper`] | that of a [rate-dependent law](super::damped), on an elastic contact | those of the law |
//!
//! `F_s` and `K_s` are force and stiffness of the elastoplastic law, `v` is the rate of indentation. The contact never
//! pulls.
//!
//! [`bodies`] move as those that [share](super::shared) contacts, also where they press on a plate at a given rate.

pub mod bodies;
mod held;
pub mod history;
pub mod impact;

pub use bodies::follow;
pub use history::History;

use super::damped::hunt_crossley::DampingFactor;
use crate::numerics::{largest, quotient, root};
use core::hint::black_box;
use libm::{fabs, sqrt};

/// The bodies in contact, their elastoplastic law, and its loss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<L, U, K> {
    /// The bodies and the elastoplastic law.
    pub plastic: super::Model<L, U>,
    /// The loss.
    pub loss: K,
}

/// The form of a loss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// A damping in proportion to the force.
    Proportional,
    /// A damping that does not depend on the largest speed.
    Viscous(Growth),
    /// A target that gives way at a speed in proportion to the force.
    Mobility,
}

/// What a viscous damping is proportional to, where a contact is `d` \[m\] deep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growth {
    /// The square of the stiffness.
    Square,
    /// The stiffness.
    Stiffness,
    /// The root of the stiffness.
    Root,
    /// One: a dashpot, whose force jumps at first touch.
    Constant,
    /// `u^2 (3 - 2u)` with `u = d/depth`, and one beyond the depth.
    Step {
        /// \[m\] > 0
        depth: f64,
        /// The depth at which the elastic force over this function is smallest \[m\]; zero if it only grows.
        lowest: f64,
    },
}

impl Growth {
    /// `factor` times the function at `d` \[m\], where the contact has this `stiffness` \[N/m\]. It goes on smoothly with a stiffness
    /// below zero.
    #[inline(always)]
    pub(crate) fn times(&self, factor: f64, d: f64, stiffness: impl FnOnce() -> f64) -> f64 {
        match *self {
            Growth::Square => {
                let stiffness = stiffness();
                factor * stiffness * stiffness
            }
            Growth::Stiffness => factor * stiffness(),
            Growth::Root => {
                let stiffness = stiffness();
                factor * root(fabs(stiffness)).copysign(stiffness)
            }
            Growth::Constant => factor,
            Growth::Step { depth, .. } => {
                let u = depths(d, depth);
                factor * if u < 1.0 { u * u * (3.0 - 2.0 * u) } else { 1.0 }
            }
        }
    }

    /// The slope of the function \[1/m\], of a contact with this `stiffness` \[N/m\] whose slope is `bend` \[N/m^2\].
    pub(crate) fn slope(&self, d: f64, stiffness: f64, bend: f64) -> f64 {
        match *self {
            Growth::Square => 2.0 * stiffness * bend,
            Growth::Stiffness => bend,
            Growth::Root => quotient(0.5 * bend, root(stiffness), stiffness > 1e-100 * fabs(bend), 0.0),
            Growth::Constant => 0.0,
            Growth::Step { depth, .. } => {
                let u = depths(d, depth);
                if u < 1.0 { 6.0 * u * (1.0 - u) / depth } else { 0.0 }
            }
        }
    }

    /// The indentations between which the elastic force over the function only grows, or only falls \[m\], from the deepest on.
    pub(crate) fn borders(&self) -> [f64; 2] {
        match *self {
            Growth::Step { depth, lowest } => [depth, lowest],
            _ => [0.0; 2],
        }
    }

    /// Whether the elastic force over the function grows without bound towards the surface: whatever the speed of a separation, a
    /// surface that lagged behind grips again there.
    pub(crate) fn grips_again(&self) -> bool {
        matches!(self, Growth::Step { lowest, .. } if *lowest > 0.0)
    }

    /// Whether the function follows the stiffness.
    pub(crate) fn needs_stiffness(&self) -> bool {
        matches!(self, Growth::Square | Growth::Stiffness | Growth::Root)
    }
}

/// `d/depth`; a compiler that computes it in advance for every form would divide by whatever is there.
#[inline(always)]
fn depths(d: f64, depth: f64) -> f64 {
    d / black_box(depth)
}

/// A loss.
pub trait Loss: Copy {
    /// Whether the force depends on the rate at the same instant.
    const FOLLOWS_RATE: bool;

    /// The form of the loss.
    fn form(&self) -> Form;

    /// Whether the scale of a proportional damping is the closing speed at first touch, however fast a prescribed motion becomes.
    fn is_scaled_by_touch(&self) -> bool {
        false
    }

    /// The factor of the form: `chi` \[-\], the damping coefficient over its [growth](Growth) (`kappa` \[m.s/N\] of waves), or `alpha`
    /// \[m/(N.s)\].
    fn factor(&self) -> f64;
}

/// The material of a target that carries energy away. It is not always the body that yields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Density \[kg/m^3\] > 0.
    pub density: f64,
    /// Young's modulus \[Pa\] > 0.
    pub youngs_modulus: f64,
    /// Poisson's ratio \[-\], above -1 and at most 0.5.
    pub poissons_ratio: f64,
}

/// A damping for a given restitution: `F = F_s (1 + chi v/v0)`.
///
/// `v0` is the largest speed of indentation, in either direction, since the contact began. In a free impact this is the
/// closing speed at first touch. Without yield the restitution is then the given one, at any speed and in any dent. Because
/// `v0` is never exceeded, the damping is at most `chi` times the elastic force.
///
/// `chi` is the [exact](DampingFactor::Exact) factor of Hunt and Crossley: their law holds for any elastic force, because
/// speed and work determine each other.
///
/// Reference: K. H. Hunt, F. R. E. Crossley, *J. Appl. Mech.* 42 (1975) 440-445.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestitutionFitted {
    /// Coefficient of restitution without yield, from 0.001 to 1.
    pub restitution: f64,
}

impl Loss for RestitutionFitted {
    const FOLLOWS_RATE: bool = true;

    #[inline(always)]
    fn form(&self) -> Form {
        Form::Proportional
    }

    fn factor(&self) -> f64 {
        DampingFactor::Exact.chi(self.restitution)
    }
}

/// The elastic waves that a half-space carries away: `F = F_s + kappa K_s^2 v`. No number is fitted.
///
/// A force `F(t)` on a small area of an elastic half-space radiates the power `kappa (dF/dt)^2`, with
/// `kappa = Q(nu)/(rho c_s^3)` and the speed of shear waves `c_s`. To first order in `kappa`, the surface then moves as with
/// a damping of `kappa K_s^2`. `Q` is the imaginary part of the surface displacement in Lamb's problem. Here it is a
/// polynomial with an error of up to 0.25 % (`data/fit/fit_waves.py`).
///
/// Assumptions: the target is a half-space, so that no wave comes back; the contact is small compared with the waves, as in
/// the theory of Hertz; the other body radiates nothing, as a compact ball does; and a yielding material radiates like an
/// elastic one.
///
/// Reference: G. F. Miller, H. Pursey, *Proc. R. Soc. A* 223 (1954) 521-541, for the radiation; S. C. Hunter, *J. Mech.
/// Phys. Solids* 5 (1957) 162-171, and J. Reed, *J. Phys. D* 18 (1985) 2329-2337, for the impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpaceRadiation {
    /// The half-space.
    pub target: Solid,
}

/// The coefficients of `Q(nu)`, from `data/fit/fit_waves.py`.
const RADIATION: [f64; 6] = [0.213974, -0.297563, 0.120823, 0.045239, 0.040769, 0.017964];

impl Loss for HalfSpaceRadiation {
    const FOLLOWS_RATE: bool = true;

    #[inline(always)]
    fn form(&self) -> Form {
        Form::Viscous(Growth::Square)
    }

    fn factor(&self) -> f64 {
        let Solid { density, youngs_modulus, poissons_ratio: nu } = self.target;
        let number = RADIATION.iter().rev().fold(0.0, |sum, coefficient| sum * nu + coefficient);
        let shear_speed = sqrt(youngs_modulus / (2.0 * density * (1.0 + nu)));
        number / (density * shear_speed * shear_speed * shear_speed)
    }
}

/// A thin plate that the force sets in motion: the rate of indentation is the closing speed minus `alpha F`.
///
/// `alpha = sqrt(3 (1 - nu^2))/(4 h^2 sqrt(E rho))` is the mobility of an infinite plate at the point of the force. The plate
/// carries away the power `alpha F^2`.
///
/// Assumptions: bending waves do not return during the impact, so the plate is wide; it is thin, so that the contact lasts
/// longer than a wave needs to cross the thickness.
///
/// Reference: C. Zener, *Phys. Rev.* 59 (1941) 669-673.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// The material of the plate.
    pub target: Solid,
    /// Its thickness \[m\] > 0.
    pub thickness: f64,
}

impl Loss for Plate {
    const FOLLOWS_RATE: bool = false;

    #[inline(always)]
    fn form(&self) -> Form {
        Form::Mobility
    }

    fn factor(&self) -> f64 {
        let Solid { density, youngs_modulus, poissons_ratio: nu } = self.target;
        let inertia = sqrt(youngs_modulus * density);
        sqrt(3.0 * (1.0 - nu * nu)) / (4.0 * self.thickness * self.thickness * inertia)
    }
}

/// The damping of a [rate-dependent law](super::damped) for given bodies: `F = F_s (1 + chi v/v0)` or `F = F_s + C psi v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damper {
    /// Its form.
    pub form: Form,
    /// The factor of the form.
    pub factor: f64,
}

impl Loss for Damper {
    const FOLLOWS_RATE: bool = true;

    #[inline(always)]
    fn form(&self) -> Form {
        self.form
    }

    fn is_scaled_by_touch(&self) -> bool {
        true
    }

    fn factor(&self) -> f64 {
        self.factor
    }
}

/// Any of the losses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyLoss {
    /// [`Damper`].
    Damper(Damper),
    /// [`RestitutionFitted`].
    RestitutionFitted(RestitutionFitted),
    /// [`HalfSpaceRadiation`].
    HalfSpaceRadiation(HalfSpaceRadiation),
    /// [`Plate`].
    Plate(Plate),
}

impl Loss for AnyLoss {
    const FOLLOWS_RATE: bool = true;

    fn form(&self) -> Form {
        match self {
            AnyLoss::Damper(loss) => loss.form(),
            AnyLoss::RestitutionFitted(loss) => loss.form(),
            AnyLoss::HalfSpaceRadiation(loss) => loss.form(),
            AnyLoss::Plate(loss) => loss.form(),
        }
    }

    fn is_scaled_by_touch(&self) -> bool {
        match self {
            AnyLoss::Damper(loss) => loss.is_scaled_by_touch(),
            AnyLoss::RestitutionFitted(loss) => loss.is_scaled_by_touch(),
            AnyLoss::HalfSpaceRadiation(loss) => loss.is_scaled_by_touch(),
            AnyLoss::Plate(loss) => loss.is_scaled_by_touch(),
        }
    }

    fn factor(&self) -> f64 {
        match self {
            AnyLoss::Damper(loss) => loss.factor(),
            AnyLoss::RestitutionFitted(loss) => loss.factor(),
            AnyLoss::HalfSpaceRadiation(loss) => loss.factor(),
            AnyLoss::Plate(loss) => loss.factor(),
        }
    }
}

/// A loss on given bodies, during a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping {
    /// Its form.
    pub form: Form,
    /// [`Loss::factor`].
    pub factor: f64,
    /// The largest speed since the contact began \[m/s\]; of a rate-dependent law in a prescribed motion, the closing speed at first touch.
    pub swiftest: f64,
}

impl Damping {
    /// `1 + chi v/v0` at `rate` \[m/s\]; it is negative where the surface would have to pull.
    fn factor_at(&self, rate: f64) -> f64 {
        // a ratio beyond all numbers has no force that is one
        let fastest = largest(1e-300 * fabs(rate), self.swiftest);
        1.0 + self.factor * quotient(rate, fastest, fastest > 0.0, 0.0)
    }

    /// The same, never negative.
    pub(crate) fn gain(&self, rate: f64) -> f64 {
        largest(self.factor_at(rate), 0.0)
    }

    /// The force \[N\] for the elastoplastic `force` \[N\] and `stiffness` \[N/m\] at the indentation `d` \[m\] and `rate` \[m/s\]; it is
    /// negative where the surface would have to pull.
    pub(crate) fn pull(&self, d: f64, force: f64, stiffness: impl FnOnce() -> f64, rate: f64) -> f64 {
        match self.form {
            Form::Proportional => force * self.factor_at(rate),
            Form::Viscous(growth) => force + growth.times(self.factor, d, stiffness) * rate,
            Form::Mobility => force,
        }
    }

    /// The same, never negative.
    pub(crate) fn force(&self, d: f64, force: f64, stiffness: f64, rate: f64) -> f64 {
        largest(self.pull(d, force, || stiffness, rate), 0.0)
    }

    /// The speed at which the target gives way to `force` \[N\], in m/s.
    pub(crate) fn retreat(&self, force: f64) -> f64 {
        if self.form == Form::Mobility { self.factor * force } else { 0.0 }
    }
}
