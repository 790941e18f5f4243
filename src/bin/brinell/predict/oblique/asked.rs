//! The setting of an oblique impact from the arguments of the command line.

use super::{FRICTION, Setting};
use crate::predict::PredictError;
use crate::predict::axis::Axis;
use crate::predict::command::Arguments;
use crate::scene::Scene;
use crate::wrong_call::WrongCall;

impl Arguments {
    /// The setting of an oblique impact, if one is asked for.
    ///
    /// # Errors
    /// A number that no oblique impact can have, or an argument that belongs to one, where none is asked for.
    pub fn setting(&self, scene: &Scene, axes: &[Axis]) -> Result<Option<Setting>, WrongCall> {
        let varied = |name: &str| axes.iter().find(|axis| axis.name == name).map(|axis| axis.from);
        let is_oblique = [self.angle, self.spin].iter().any(Option::is_some);
        if !is_oblique && varied("angle").is_none() && varied("spin").is_none() {
            let idle = [("friction", self.friction.or(varied(FRICTION))), ("inertia", self.inertia)];
            return match idle.iter().find(|(_, value)| value.is_some()) {
                Some((name, _)) => Err(WrongCall::of(PredictError::NotOblique(name))),
                None => Ok(None),
            };
        }
        let coefficient = self.friction.or(varied(FRICTION)).or(scene.group_value(0, FRICTION));
        let missing = || WrongCall::of(PredictError::NoCoefficient);
        let setting = Setting {
            angle: self.angle.or(varied("angle")).unwrap_or(0.0),
            spin: self.spin.or(varied("spin")).unwrap_or(0.0),
            coefficient: coefficient.ok_or_else(missing)?,
            inertia: self.inertia,
        };
        setting.check().map_err(WrongCall::of)?;
        Ok(Some(setting))
    }
}
