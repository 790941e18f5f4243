//! Losses below yield: `law.elastic_restitution` and `target.plate_thickness`.

use super::Scene;
use super::file::SceneFile;
use super::quantities::quantity_of;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::model::AnyModel;
use crate::numbers::{out_of_range, quantity};
use brinell_contact::damped::Damped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{self, AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Body, Model};
use toml::Value;

/// A loss of a scene, with the start value of its parameter. Density and bodies are those of each contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// A damping for this restitution.
    Fitted(f64),
    /// Elastic waves in a half-space.
    Waves,
    /// A plate of this thickness \[m\].
    Plate(f64),
}

/// The loss that a scene names instead of a restitution.
pub const WAVES: &str = "waves";

/// The names of the parameters.
pub const RESTITUTION: &str = "elastic_restitution";
pub const THICKNESS: &str = "target.plate_thickness";

fn of_restitution(given: &Spanned<Value>) -> Result<Loss, Mistake> {
    let number = match given.get_ref() {
        Value::Float(number) => *number,
        Value::Integer(number) => *number as f64,
        Value::String(text) if text == WAVES => return Ok(Loss::Waves),
        other => {
            let message =
                format!("law.elastic_restitution = {other} is neither a number from 0.001 to 1 nor \"waves\"");
            return Err(Mistake(given.span(), message));
        }
    };
    let allowed = quantity_of("law", RESTITUTION).allowed;
    if allowed.contains(&number) {
        return Ok(Loss::Fitted(number));
    }
    let message = format!("law.elastic_restitution {}, or \"waves\"", out_of_range(number, &allowed, ""));
    Err(Mistake(given.span(), message))
}

impl Loss {
    /// The loss of the scene `file`.
    pub fn of(file: &SceneFile) -> Result<Option<Loss>, Mistake> {
        let thickness = file.target.as_ref().and_then(|target| target.get_ref().plate_thickness.as_ref());
        let plate = thickness.map(|thickness| Loss::Plate(*thickness.get_ref()));
        Ok(file.law.elastic_restitution.as_ref().map(of_restitution).transpose()?.or(plate))
    }

    /// Its parameter in the FMU with the start value, if it has one.
    pub fn parameter(self) -> Option<(&'static str, f64)> {
        match self {
            Loss::Fitted(restitution) => Some((RESTITUTION, restitution)),
            Loss::Waves => None,
            Loss::Plate(thickness) => Some((THICKNESS, thickness)),
        }
    }

    /// Its name.
    pub fn name(self) -> String {
        match self {
            Loss::Fitted(restitution) => format!("a damping for a restitution of {restitution} below yield"),
            Loss::Waves => "elastic waves in the target".into(),
            Loss::Plate(thickness) => format!("a plate of {} that gives way", quantity(thickness, "m")),
        }
    }

    /// Its description.
    pub fn words(self) -> String {
        match self {
            Loss::Fitted(restitution) => format!(
                "The force is F = F_s (1 + chi v/v0), with F_s from the laws above and the largest speed v0 since the contact \
                 began. An impact that does not yield has the restitution {restitution}, at any speed and in any dent."
            ),
            Loss::Waves => "The target is a half-space that carries away elastic waves: F = F_s + kappa K_s^2 v, with F_s and its \
                            stiffness K_s from the laws above, and kappa from the density and the moduli of the target (Hunter \
                            1957, Reed 1985). No number is fitted."
                .into(),
            Loss::Plate(thickness) => format!(
                "The target is a wide plate of {} that gives way at the speed alpha F (Zener 1941), with alpha from its density, \
                 moduli and thickness: the rate of indentation is indentation_rate, the closing speed of the bodies, minus \
                 alpha F. The power alpha F^2 counts as dissipated.",
                quantity(thickness, "m")
            ),
        }
    }

    /// Whether the force depends on the rate at the same instant.
    pub fn follows_rate(self) -> bool {
        !matches!(self, Loss::Plate(_))
    }
}

impl Scene {
    /// Whether the force depends on the rate at the same instant.
    pub fn follows_rate(&self) -> bool {
        self.damped.is_some() || self.loss.is_some_and(Loss::follows_rate)
    }

    /// Whether the force depends on the speed of the motion at all.
    pub fn is_rate_dependent(&self) -> bool {
        self.damped.is_some() || self.loss.is_some()
    }

    /// Whether the damping of its law follows from the mass.
    pub fn damps_by_mass(&self) -> bool {
        self.damped.is_some_and(|(_, law)| law.needs_mass())
    }

    /// The contact of `group` by an elastoplastic `model`, with the loss of the scene.
    pub fn with_loss(&self, group: usize, model: Model<AnyLoading, AnyUnloading>) -> AnyModel {
        match self.loss_with(group, &[]) {
            None => AnyModel::Elastoplastic(model),
            Some(loss) => AnyModel::Lossy(losses::Model { plastic: model, loss }, None),
        }
    }

    /// The loss of the contacts of `group`, with other values for some of the parameters.
    pub fn loss_with(&self, group: usize, values: &[(&str, f64)]) -> Option<AnyLoss> {
        let value = |name| self.value_with(group, name, values).unwrap_or(f64::NAN);
        let [_, Body { youngs_modulus, poissons_ratio, .. }] = self.bodies_with(group, values);
        let density = self.contacts[group].density.unwrap_or(f64::NAN);
        let target = Solid { density, youngs_modulus, poissons_ratio };
        Some(match self.loss? {
            Loss::Fitted(_) => AnyLoss::RestitutionFitted(RestitutionFitted { restitution: value(RESTITUTION) }),
            Loss::Waves => AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target }),
            Loss::Plate(_) => AnyLoss::Plate(Plate { target, thickness: value(THICKNESS) }),
        })
    }
}
