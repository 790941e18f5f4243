//! The rebound of a ball that hits a surface obliquely, with friction.

use super::axis::{Axis, OF_OBLIQUE_IMPACT, varied};
use super::{PredictError, Quantity, positive};
use crate::laws::Choice;
use crate::model::AnyModel;
use crate::scene::Scene;
use crate::table;
use crate::validity::Beyond;
use brinell_contact::impact::Impact;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::impact::{Ball, Rebound, predict};
use brinell_contact::tangential::{Friction, RoughModel};
use brinell_contact::unloading::AnyUnloading;

/// The coefficient of friction, a parameter of the scene.
pub const FRICTION: &str = "friction.coefficient";

/// The method of the computation, in words.
pub const METHOD: &str = "computed with the springs of the contact in a thousand steps";

/// The quantities of a sweep's table in a terminal.
pub const SHOWN: [&str; 5] =
    ["normal restitution", "tangential restitution", "rebound angle", "rebound spin", "sliding part"];

/// Number of values in a sweep over one quantity: an oblique impact takes milliseconds.
pub const VALUES: usize = 101;

/// Moment of inertia of a solid sphere over `m R^2`.
const SOLID_SPHERE: f64 = 0.4;

/// What makes an impact oblique.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Angle of incidence from the normal \[degrees\].
    pub angle: f64,
    /// Spin before the impact \[rad/s\].
    pub spin: f64,
    /// Coefficient of friction.
    pub coefficient: f64,
    /// Moment of inertia \[kg.m^2\]; that of a solid sphere if it is not given.
    pub inertia: Option<f64>,
}

/// An oblique impact with its rebound.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub setting: Setting,
    /// Coefficient, and ratio of the stiffnesses.
    pub friction: Friction,
    pub before: Ball,
    pub rebound: Rebound,
    /// Limits of validity that the normal impact exceeds.
    pub beyond: Vec<Beyond>,
}

impl Setting {
    /// Rejects numbers that no oblique impact can have.
    ///
    /// # Errors
    /// [`PredictError`] with the name, the value and what is allowed.
    pub fn check(&self) -> Result<(), PredictError> {
        let Setting { angle, spin, coefficient, inertia } = *self;
        if angle.is_nan() || angle.abs() >= 90.0 {
            return Err(PredictError::Angle(angle));
        }
        if !spin.is_finite() {
            return Err(PredictError::Spin(spin));
        }
        check_coefficient(coefficient)?;
        inertia.map_or(Ok(()), |inertia| positive("inertia", inertia).map(|_| ()))
    }

    /// The setting with this value of a quantity of oblique impacts.
    fn with(self, name: &str, value: f64) -> Setting {
        match name {
            "angle" => Setting { angle: value, ..self },
            "spin" => Setting { spin: value, ..self },
            FRICTION => Setting { coefficient: value, ..self },
            _ => self,
        }
    }
}

/// Whether the quantity `name` belongs to oblique impacts only.
pub fn is_quantity(name: &str) -> bool {
    name == FRICTION || OF_OBLIQUE_IMPACT.iter().any(|(known, _)| *known == name)
}

/// Rejects a coefficient of friction that no scene can have.
///
/// # Errors
/// [`PredictError::Coefficient`]
pub fn check_coefficient(value: f64) -> Result<(), PredictError> {
    let variable = table::variable(FRICTION);
    let allowed = variable.minimum.unwrap_or(0.0)..=variable.maximum.unwrap_or(f64::MAX);
    if allowed.contains(&value) { Ok(()) } else { Err(PredictError::Coefficient { value, allowed }) }
}

/// The reason why the laws of `choice` have no friction.
pub fn refusal(choice: &Choice) -> Option<String> {
    match choice.model {
        AnyModel::Damped(_) => return Some("rate-dependent laws have none".into()),
        AnyModel::Lossy(_) => return Some("a loss below yield and friction can't be combined".into()),
        AnyModel::Elastoplastic(_) => {}
    }
    if choice.is_guarded() {
        return Some("with the passivity guard, its accuracy was not measured".into());
    }
    let law = table::unloading_law(choice.names().1?);
    law.no_friction.as_ref().map(|why| format!("with the unloading law {}, {why}", law.name))
}

/// The laws of `choices` that have friction: all of them, or those of a list that includes every law.
///
/// # Errors
/// [`PredictError::NoFriction`] for a law that was asked for by its name, or if no law is left.
pub fn with_friction(choices: Vec<Choice>, takes_some: bool) -> Result<Vec<Choice>, PredictError> {
    let refused =
        |choice: &Choice| refusal(choice).map(|why| PredictError::NoFriction { law: choice.laws.clone(), why });
    let first = choices.iter().find_map(refused);
    let left: Vec<Choice> = choices.into_iter().filter(|choice| refusal(choice).is_none()).collect();
    match first {
        Some(error) if !takes_some || left.is_empty() => Err(error),
        _ => Ok(left),
    }
}

/// The rebound of `impact` on the first contact of `scene`, with these values of some quantities. The speed is that along
/// the path of the ball.
///
/// # Errors
/// [`PredictError`] for an impossible value, or beyond the range of the law.
pub fn one(
    scene: &Scene,
    choice: &Choice,
    (impact, setting): (Impact, Setting),
    values: &[(&Axis, f64)],
) -> Result<Outcome, PredictError> {
    let setting = values.iter().fold(setting, |setting, (axis, value)| setting.with(axis.name, *value));
    setting.check()?;
    let others: Vec<_> = values.iter().copied().filter(|(axis, _)| !is_quantity(axis.name)).collect();
    let (choice, impact) = varied(scene, choice, impact, &others)?;
    let named: Vec<_> = others.iter().map(|(axis, value)| (axis.name, *value)).collect();
    let model = rough(scene, &choice, setting.coefficient, &named)?;
    let [impactor, _] = scene.bodies_with(0, &named);
    let Impact { mass, speed } = impact;
    let angle = setting.angle.to_radians();
    let before = Ball {
        mass,
        inertia: setting.inertia.unwrap_or(SOLID_SPHERE * mass * impactor.radius * impactor.radius),
        radius: impactor.radius,
        normal: speed * angle.cos(),
        tangential: speed * angle.sin(),
        spin: setting.spin,
    };
    let beyond = || PredictError::Beyond { law: choice.laws.clone(), mass, speed };
    let rebound = predict(&model, &before).ok_or_else(beyond)?;
    let normal = Impact { mass, speed: before.normal };
    let prediction = choice.model.predict(&normal);
    let limits = |prediction| super::beyond(scene, &choice.model.pair(), normal.speed, &prediction, &named);
    let beyond = prediction.map_or(Vec::new(), limits);
    Ok(Outcome { setting, friction: model.friction, before, rebound, beyond })
}

/// The law of `choice` with friction, for these values of parameters of the scene's bodies.
///
/// # Errors
/// [`PredictError::NoFriction`]
pub fn rough(
    scene: &Scene,
    choice: &Choice,
    coefficient: f64,
    values: &[(&str, f64)],
) -> Result<RoughModel<AnyLoading, AnyUnloading>, PredictError> {
    let none = || PredictError::NoFriction { law: choice.laws.clone(), why: refusal(choice).unwrap_or_default() };
    let normal = choice.model.elastoplastic().filter(|_| refusal(choice).is_none()).ok_or_else(none)?;
    let [impactor, target] = scene.bodies_with(0, values);
    let friction = Friction::between(&impactor, &target, normal.pair.modulus, coefficient);
    Ok(RoughModel { normal: *normal, friction, loss: () })
}

impl Outcome {
    /// Restitution along the normal.
    pub fn normal_restitution(&self) -> f64 {
        -self.rebound.ball.normal / self.before.normal
    }

    /// Tangential speed of the centre after the impact over that before; NaN for a normal impact.
    pub fn tangential_restitution(&self) -> f64 {
        ratio(self.rebound.ball.tangential, self.before.tangential)
    }

    /// Tangential speed of the contact point before the impact over that after, with the sign changed; NaN if there was
    /// none before.
    pub fn contact_point_restitution(&self) -> f64 {
        -ratio(self.rebound.ball.slip(), self.before.slip())
    }

    /// Angle of the rebound from the normal \[degrees\]; negative if the ball flies back.
    pub fn angle(&self) -> f64 {
        self.rebound.ball.tangential.atan2(-self.rebound.ball.normal).to_degrees()
    }

    /// Speed of the centre after the impact \[m/s\].
    pub fn speed(&self) -> f64 {
        self.rebound.ball.tangential.hypot(self.rebound.ball.normal)
    }

    /// Kinetic energy lost in all \[J\].
    pub fn energy_lost(&self) -> f64 {
        let normal = |ball: &Ball| 0.5 * ball.mass * ball.normal * ball.normal;
        normal(&self.before) - normal(&self.rebound.ball) + self.rebound.friction_work
    }

    /// The slip in words: "slides throughout", "sticks", or for which part of the contact time it slides.
    pub fn words(&self) -> String {
        match self.rebound.sliding_part {
            _ if self.before.slip() == 0.0 && self.rebound.friction_work == 0.0 => "no slip".into(),
            part if part > 0.999 => "slides throughout".into(),
            part if part < 5e-4 => "sticks, or slips partly, throughout".into(),
            part => format!("slides for {:.1} % of the contact time, else sticks or slips partly", 100.0 * part),
        }
    }

    /// The quantities of the rebound: name, value, unit.
    pub fn quantities(&self) -> [Quantity; 12] {
        let ball = &self.rebound.ball;
        [
            ("rebound angle", self.angle(), "deg"),
            ("rebound speed", self.speed(), "m/s"),
            ("normal rebound speed", -ball.normal, "m/s"),
            ("tangential rebound speed", ball.tangential, "m/s"),
            ("rebound spin", ball.spin, "rad/s"),
            ("normal restitution", self.normal_restitution(), ""),
            ("tangential restitution", self.tangential_restitution(), ""),
            ("contact point restitution", self.contact_point_restitution(), ""),
            ("largest tangential force", self.rebound.max_tangential_force, "N"),
            ("friction work", self.rebound.friction_work, "J"),
            ("energy lost", self.energy_lost(), "J"),
            ("sliding part", self.rebound.sliding_part, ""),
        ]
    }
}

/// A ratio; NaN if the denominator is zero.
fn ratio(numerator: f64, denominator: f64) -> f64 {
    if denominator == 0.0 { f64::NAN } else { numerator / denominator }
}
