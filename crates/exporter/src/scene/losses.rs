//! Losses below yield: `law.elastic_restitution` and `target.plate_thickness`.

use super::file::SceneFile;
use super::quantities::quantity_of;
use crate::mistake::Mistake;
use crate::mistake::Spanned;
use crate::numbers::{out_of_range, quantity};
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
