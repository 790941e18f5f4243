//! Rate-dependent laws, one file each, as multibody tools use them: an elastic force and a damping that grows with the rate.
//! They leave no dent.
//!
//! All have the form `F = K phi(d) + C psi(d) d'`, and never give a negative force: where the sum is negative, the bodies
//! separate faster than the surface follows. The force depends on the rate at the same instant, and the `ModelStructure` of the
//! FMU declares this.

pub mod adams;
mod any;
pub mod history;
pub mod hunt_crossley;
pub mod impact;
pub mod kelvin_voigt;
pub mod kuwabara_kono;
pub mod tsuji;

pub use history::{History, follow};

use super::laws::{Constant, LawNumbers, Numbered, laws};
use super::material::Pair;
use super::validity;
use libm::sqrt;

laws! {
    /// A rate-dependent law chosen while a program runs. In an FMU the scene names the law.
    pub enum AnyDamped: dyn Damped {
        hunt_crossley::HuntCrossley [damping_factor] { "hunt-crossley" = HuntCrossley::REFERENCE }
        kelvin_voigt::KelvinVoigt [characteristic_speed] { "kelvin-voigt" = KelvinVoigt::REFERENCE }
        tsuji::Tsuji [damping_factor] { "tsuji" = Tsuji::REFERENCE }
        kuwabara_kono::KuwabaraKono [relaxation_time] { "kuwabara-kono" = KuwabaraKono::REFERENCE }
        adams::Adams [stiffness, stiffness_factor, exponent, full_damping, damping_depth] { "adams-impact" = Adams::REFERENCE }
    }
}

/// The bodies in contact and their rate-dependent law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<D> {
    /// The two bodies.
    pub pair: Pair,
    /// The law with its constants.
    pub law: D,
    /// Coefficient of restitution for which the damping is computed, in (0, 1]; ignored by laws that specify their damping
    /// directly.
    pub restitution: f64,
    /// Effective mass for which the damping is computed \[kg\] > 0; ignored by laws that need none.
    pub mass: f64,
}

impl<D> Model<D> {
    /// The indentation up to which the law is valid \[m\] for bodies of which the smaller one has this `size` \[m\], with Hertz's contact
    /// radius `a^2 = R d`.
    pub fn valid_depth(&self, size: f64) -> f64 {
        self.depth_of(validity::largest_radius(self.pair.radius, size))
    }

    /// The indentation at which the contact radius is `contact_radius` \[m\].
    pub fn depth_of(&self, contact_radius: f64) -> f64 {
        contact_radius / self.pair.radius * contact_radius
    }
}

/// Value of a function of the indentation, with its derivative and its integral from zero.
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
    /// `K`: a force \[N\] when multiplied by `phi`.
    pub elastic: f64,
    /// `C`: a damping coefficient \[N.s/m\] when multiplied by `psi`. For a law that [scales by the touch
    /// speed](Damped::scaled_by_touch), it is the coefficient times that speed \[N\].
    pub damping: f64,
}

/// A rate-dependent law: its constants, without the bodies. All indentations are in m and not negative.
pub trait Damped {
    /// `K` and `C` for these bodies.
    fn factors(&self, pair: &Pair, restitution: f64, mass: f64) -> Factors;

    /// `phi`, the shape of the elastic force: Hertz's, `d^1.5`.
    fn elastic(&self, indentation: f64) -> Shape {
        power_three_halves(indentation)
    }

    /// `psi`, the shape of the damping.
    fn damping(&self, indentation: f64) -> Shape;

    /// Whether the damping depends on a coefficient of restitution.
    fn needs_restitution(&self) -> bool {
        false
    }

    /// Whether the damping depends on a mass.
    fn needs_mass(&self) -> bool {
        false
    }

    /// Whether the damping is divided by the closing speed at first touch.
    fn scaled_by_touch(&self) -> bool {
        false
    }

    /// The indentations that separate the monotone parts of `phi/psi` \[m\], in order. Where the ratio is monotone, the force
    /// changes its sign at most once. Below the first one the ratio grows without bound towards zero: whatever the speed of a
    /// separation, the surface that lagged behind grips again there.
    fn borders(&self) -> [f64; 2] {
        [0.0; 2]
    }

    /// Whether a surface that lags behind grips again before the bodies are apart.
    fn grips_again(&self) -> bool {
        let [first, _] = self.borders();
        first > 0.0
    }
}

/// `d^1.5`.
fn power_three_halves(d: f64) -> Shape {
    let root = sqrt(d);
    Shape { value: d * root, slope: 1.5 * root, integral: 0.4 * d * d * root }
}
