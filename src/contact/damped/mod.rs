//! Rate-dependent laws, one file each: an elastic force and a damping that grows with the rate, as multibody tools use
//! them. They leave no dent.
//!
//! All have the form `F = K phi(d) + C psi(d) d'`, never below zero: where the sum is negative the bodies have come apart
//! faster than the surface follows. The force depends on the rate at the same instant, and so does its unit's
//! `ModelStructure`.

pub mod adams;
pub mod history;
pub mod hunt_crossley;
pub mod impact;
pub mod kelvin_voigt;
pub mod kuwabara_kono;
pub mod tsuji;

pub use adams::Adams;
pub use history::History;
pub use hunt_crossley::HuntCrossley;
pub use kelvin_voigt::KelvinVoigt;
pub use kuwabara_kono::KuwabaraKono;
pub use tsuji::Tsuji;

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
    /// Effective mass that the damping is made for [kg] > 0; laws that need none ignore it.
    pub mass: f64,
}

impl<D> Model<D> {
    /// The indentation up to which the law is valid [m]: the contact radius is Hertz's, `a^2 = R d`.
    pub fn valid_depth(&self) -> f64 {
        LARGEST_RADIUS_RATIO * LARGEST_RADIUS_RATIO * self.pair.radius
    }
}

/// A function of the indentation, with its derivative and its integral from zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Value.
    pub value: f64,
    /// Derivative by the indentation [1/m].
    pub slope: f64,
    /// Integral from zero indentation [m].
    pub integral: f64,
}

/// The factors of the two shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// `K`: times `phi` a force [N].
    pub elastic: f64,
    /// `C`: times `psi` a damping coefficient [N.s/m]; of a law that [scales by the touch speed](Damped::scaled_by_touch)
    /// the coefficient times that speed [N].
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

    /// Whether the damping is divided by the closing speed at first touch.
    fn scaled_by_touch(&self) -> bool {
        false
    }

    /// Indentations between which `phi/psi` is monotone [m], in order: where the force can change its sign more than once.
    fn borders(&self) -> [f64; 2] {
        [0.0; 2]
    }
}

/// `d^1.5`.
fn power_three_halves(d: f64) -> Shape {
    let root = sqrt(d);
    Shape { value: d * root, slope: 1.5 * root, integral: 0.4 * d * d * root }
}

/// A rate-dependent law chosen while the program runs. The FMU doesn't need it: a scene names its law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "exporter", derive(serde::Serialize, serde::Deserialize))]
pub enum AnyDamped {
    /// See [`HuntCrossley`].
    HuntCrossley(HuntCrossley),
    /// See [`KelvinVoigt`].
    KelvinVoigt(KelvinVoigt),
    /// See [`Tsuji`].
    Tsuji(Tsuji),
    /// See [`KuwabaraKono`].
    KuwabaraKono(KuwabaraKono),
    /// See [`Adams`].
    Adams(Adams),
}

impl AnyDamped {
    /// Every law under the name it has in a scene, with its reference constants.
    pub const ALL: [(&'static str, AnyDamped); 5] = [
        ("hunt-crossley", AnyDamped::HuntCrossley(HuntCrossley::REFERENCE)),
        ("kelvin-voigt", AnyDamped::KelvinVoigt(KelvinVoigt::REFERENCE)),
        ("tsuji", AnyDamped::Tsuji(Tsuji::REFERENCE)),
        ("kuwabara-kono", AnyDamped::KuwabaraKono(KuwabaraKono::REFERENCE)),
        ("adams-impact", AnyDamped::Adams(Adams::REFERENCE)),
    ];

    /// Whether the damping is made for a coefficient of restitution.
    pub fn needs_restitution(&self) -> bool {
        matches!(self, AnyDamped::HuntCrossley(_) | AnyDamped::KelvinVoigt(_) | AnyDamped::Tsuji(_))
    }

    /// Whether the damping is made for a mass.
    pub fn needs_mass(&self) -> bool {
        matches!(self, AnyDamped::KelvinVoigt(_) | AnyDamped::Tsuji(_))
    }

    /// The law itself.
    pub fn law(&self) -> &dyn Damped {
        match self {
            AnyDamped::HuntCrossley(law) => law,
            AnyDamped::KelvinVoigt(law) => law,
            AnyDamped::Tsuji(law) => law,
            AnyDamped::KuwabaraKono(law) => law,
            AnyDamped::Adams(law) => law,
        }
    }
}

impl Damped for AnyDamped {
    fn factors(&self, pair: &Pair, restitution: f64, mass: f64) -> Factors {
        self.law().factors(pair, restitution, mass)
    }

    fn elastic(&self, indentation: f64) -> Shape {
        self.law().elastic(indentation)
    }

    fn damping(&self, indentation: f64) -> Shape {
        self.law().damping(indentation)
    }

    fn scaled_by_touch(&self) -> bool {
        self.law().scaled_by_touch()
    }

    fn borders(&self) -> [f64; 2] {
        self.law().borders()
    }
}
