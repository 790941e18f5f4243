//! Rate-dependent laws, one file each, as multibody tools use them: an elastic force and a damping that grows with the rate.
//! They leave no dent.
//!
//! All have the form `F = F_s(d) + C psi(d) d'`: an [elastic](Elastic) contact with a [loss](Damper), which moves, is predicted and
//! shares bodies as any other does. The force is never negative: where the sum is, the bodies separate faster than the surface
//! follows. It depends on the rate at the same instant, and the `ModelStructure` of the FMU declares this.

pub mod adams;
pub mod hunt_crossley;
pub mod kelvin_voigt;
pub mod kuwabara_kono;
pub mod tsuji;

use super::Surface;
use super::laws::{Constant, LawNumbers, Numbered, laws};
use super::loading::Elastic;
use super::losses::{Damper, Model};
use super::material::Pair;
use super::unloading::ContactRadius;

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

/// A rate-dependent law: its constants, without the bodies.
pub trait Damped {
    /// The law on the bodies `pair`: a spring, and the damping for this coefficient of `restitution` in (0, 1] and this effective
    /// `mass` \[kg\] > 0. A law that [needs](Damped::needs_restitution) none of the two ignores it.
    fn parts(&self, pair: &Pair, restitution: f64, mass: f64) -> (Elastic, Damper);

    /// Whether the damping depends on a coefficient of restitution.
    fn needs_restitution(&self) -> bool {
        false
    }

    /// Whether the damping depends on a mass.
    fn needs_mass(&self) -> bool {
        false
    }

    /// The law on the bodies `pair` as an elastic contact with a loss: [`Damped::parts`].
    fn model(&self, pair: Pair, restitution: f64, mass: f64) -> Model<Elastic, ContactRadius, Damper> {
        let (loading, loss) = self.parts(&pair, restitution, mass);
        Model { plastic: crate::Model { pair, loading, unloading: ContactRadius, surface: Surface::Dented }, loss }
    }
}

impl Damped for AnyDamped {
    fn parts(&self, pair: &Pair, restitution: f64, mass: f64) -> (Elastic, Damper) {
        self.law().parts(pair, restitution, mass)
    }

    fn needs_restitution(&self) -> bool {
        self.law().needs_restitution()
    }

    fn needs_mass(&self) -> bool {
        self.law().needs_mass()
    }
}
