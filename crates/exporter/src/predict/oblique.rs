//! The rebound of a ball that hits a surface obliquely, with friction.

use super::axis::{Case, OF_OBLIQUE_IMPACT, Value, varied};
use super::{PredictError, Quantity, positive};
use crate::laws::Choice;
use crate::scene::{GROUND, InverseMasses, Meeting, Scene, place};
use crate::table;
use crate::validity::Beyond;
use brinell_contact::History;
use brinell_contact::impact::Impact;
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{self, AnyLoss};
use brinell_contact::tangential::impact::{Ball, Rebound, meet, predict};
use brinell_contact::tangential::{self, Friction, FrictionalModel};
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

/// The method for bodies that the scene has in tables, and for a loss below yield.
pub const TOGETHER: &str = "moved as the FMU moves bodies";

/// An oblique impact with its rebound.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub setting: Setting,
    /// Coefficient, and ratio of the stiffnesses.
    pub friction: Friction,
    /// The ball, or the first body of the scene's first contact that is free, before the impact.
    pub before: Ball,
    pub rebound: Rebound,
    /// The impact along the normal, of the effective mass.
    pub normal: Impact,
    /// Closing rate along the normal, and rate along the tangent, of the contact points before and after \[m/s\].
    pub rates: [[f64; 2]; 2],
    /// Kinetic energy lost in all \[J\].
    pub energy_lost: f64,
    /// Whether the bodies were [moved as in the FMU](TOGETHER).
    pub together: bool,
    /// The names of the bodies in tables: of the moving one, and of the one at rest before.
    pub names: Option<[String; 2]>,
    /// The body that was at rest, if it is free.
    pub struck: Option<Struck>,
    /// Limits of validity that the normal impact exceeds.
    pub beyond: Vec<Beyond>,
}

/// A free body that was at rest, after the impact, in the directions of the other one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Struck {
    /// Speed along the normal, and along the tangent \[m/s\].
    pub speeds: [f64; 2],
    /// \[rad/s\]
    pub spin: f64,
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
    if choice.model.rate_law().is_some() {
        return Some("rate-dependent laws have none".into());
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
    values: &[Value],
) -> Result<Outcome, PredictError> {
    let setting = values.iter().fold(setting, |setting, (name, value)| setting.with(name, *value));
    setting.check()?;
    let others: Vec<_> = values.iter().copied().filter(|(name, _)| !is_quantity(name)).collect();
    let along = setting.angle.to_radians().cos();
    let Case { scene, choice, impact } = varied(scene, choice, impact, &others, along)?;
    let model = frictional(&scene, &choice, setting.coefficient)?;
    let moving = Moving::of(&scene, impact, &setting)?;
    let Impact { mass, speed } = impact;
    let normal = Impact { mass, speed: moving.rates[0] };
    let beyond = || PredictError::Beyond { law: choice.laws.clone(), mass, speed };
    let prediction = choice.model.predict(&normal);
    // a sweep shows where it leaves the range of the law
    if let Some(prediction) = prediction.as_ref().filter(|_| values.is_empty()) {
        super::check_width(&scene, 0, &choice.laws, &normal, prediction)?;
    }
    let limits = |prediction| super::beyond(&scene, &choice.model.pair(), normal.speed, &prediction);
    let limits = prediction.map_or(Vec::new(), limits);
    let friction = model.friction;
    let Moving { before, masses, rates, bodies } = moving;
    let together = bodies.is_some() || choice.model.lossy().is_some();
    let plain = Outcome {
        setting,
        friction,
        before,
        rebound: Rebound {
            ball: before,
            friction_work: 0.0,
            max_tangential_force: 0.0,
            sliding_part: 0.0,
            contact_time: 0.0,
        },
        normal,
        rates: [rates; 2],
        energy_lost: 0.0,
        together,
        names: bodies.as_ref().map(|bodies| bodies.each_ref().map(|body| body.name.clone())),
        struck: None,
        beyond: limits,
    };
    if !together {
        let rebound = predict(&model, &before).ok_or_else(beyond)?;
        let normal = |ball: &Ball| 0.5 * ball.mass * ball.normal * ball.normal;
        let energy_lost = normal(&before) - normal(&rebound.ball) + rebound.friction_work;
        let rates = [rates, [rebound.ball.normal, rebound.ball.slip()]];
        return Ok(Outcome { rebound, rates, energy_lost, ..plain });
    }
    let time = prediction.ok_or_else(beyond)?.contact_time();
    let met = match choice.model.lossy() {
        Some(lossy) => {
            let model = FrictionalModel { normal: lossy.plastic, friction, loss: lossy.loss };
            meet::<_, _, losses::History<AnyLoss>>(&model, &masses, rates, time)
        }
        None => meet::<_, _, History>(&model, &masses, rates, time),
    };
    Ok(plain.after(&met.ok_or_else(beyond)?, bodies.as_ref()))
}

/// The bodies of an oblique impact before it.
struct Moving {
    /// The ball or body that moves.
    before: Ball,
    /// Inverse masses of the normal, of both together and of the tangent \[1/kg\].
    masses: [f64; 3],
    /// Rates of the contact points along the normal and the tangent \[m/s\].
    rates: [f64; 2],
    /// The moving body and the one at rest, if the scene has them in tables.
    bodies: Option<[Meeting; 2]>,
}

impl Moving {
    /// The bodies of the first contact of `scene` in this `impact`, whose speed is along the path, with this `setting`.
    fn of(scene: &Scene, impact: Impact, setting: &Setting) -> Result<Moving, PredictError> {
        let Impact { mass, speed } = impact;
        let angle = setting.angle.to_radians();
        let [along, across] = [speed * angle.cos(), speed * angle.sin()];
        let Some(InverseMasses::Constant { entries, meeting: Some(meeting) }) = scene.inverse_masses() else {
            let [impactor, _] = scene.bodies(0);
            let radius = impactor.radius;
            let inertia = setting.inertia.unwrap_or(SOLID_SPHERE * mass * radius * radius);
            let before = Ball { mass, inertia, radius, normal: along, tangential: across, spin: setting.spin };
            let masses = [1.0 / mass, 0.0, 1.0 / before.tangential_mass()];
            return Ok(Moving { before, masses, rates: [along, before.slip()], bodies: None });
        };
        if mass != scene.impact_of(0).mass {
            return Err(PredictError::OfBodies { name: "mass", value: mass, unit: "kg" });
        }
        if let Some(value) = setting.inertia {
            return Err(PredictError::OfBodies { name: "inertia", value, unit: "kg.m^2" });
        }
        // the ground doesn't move: the other one does, and sees both directions turned round
        let [first, second] = meeting.clone();
        let turned = |body: Meeting| Meeting {
            turns: body.turns.map(std::ops::Neg::neg),
            arms: body.arms.map(std::ops::Neg::neg),
            ..body
        };
        let bodies = if first.name == GROUND { [turned(second), turned(first)] } else { [first, second] };
        let [body, _] = &bodies;
        let spin = setting.spin;
        let before = Ball {
            mass: body.mass,
            inertia: if body.turns[1] == 0.0 { f64::INFINITY } else { body.arms[1] / body.turns[1] },
            radius: body.arms[1],
            normal: along,
            tangential: across,
            spin,
        };
        let [normal, tangent, rows] = [0, scene.contact_count(), scene.rows()];
        let entry = |one, other| entries[place(rows, one, other)];
        let masses = [entry(normal, normal), entry(normal, tangent), entry(tangent, tangent)];
        let rates = [along + spin * body.arms[0], across + spin * body.arms[1]];
        Ok(Moving { before, masses, rates, bodies: Some(bodies) })
    }
}

/// The law of `choice` with friction.
///
/// # Errors
/// [`PredictError::NoFriction`]
pub fn frictional(
    scene: &Scene,
    choice: &Choice,
    coefficient: f64,
) -> Result<FrictionalModel<AnyLoading, AnyUnloading>, PredictError> {
    let none = || PredictError::NoFriction { law: choice.laws.clone(), why: refusal(choice).unwrap_or_default() };
    let normal = choice.model.elastoplastic().filter(|_| refusal(choice).is_none()).ok_or_else(none)?;
    let [impactor, target] = scene.bodies(0);
    let friction = Friction::between(&impactor, &target, normal.pair.modulus, coefficient);
    Ok(FrictionalModel { normal: *normal, friction, loss: () })
}

impl Outcome {
    /// The outcome after bodies have `met`, which are those of tables or a ball on a target that doesn't move.
    fn after(self, met: &tangential::impact::Meeting, bodies: Option<&[Meeting; 2]>) -> Outcome {
        let [normal, tangential] = met.impulses;
        let spun = |body: &Meeting| normal * body.turns[0] + tangential * body.turns[1];
        let before = self.before;
        let slowed = bodies.map_or(tangential * before.radius / before.inertia, |[body, _]| spun(body));
        let ball = Ball {
            normal: before.normal - normal / before.mass,
            tangential: before.tangential - tangential / before.mass,
            spin: before.spin - slowed,
            ..before
        };
        let struck = bodies
            .filter(|[_, other]| other.mass < f64::INFINITY)
            .map(|[_, other]| Struck { speeds: met.impulses.map(|impulse| impulse / other.mass), spin: spun(other) });
        let rates = [self.rates[0], met.rates];
        let lost = |row: usize| 0.5 * met.impulses[row] * (rates[0][row] + rates[1][row]);
        let rebound = Rebound {
            ball,
            friction_work: met.friction_work,
            max_tangential_force: met.max_tangential_force,
            sliding_part: met.sliding_part,
            contact_time: met.contact_time,
        };
        Outcome { rebound, rates, energy_lost: lost(0) + lost(1), struck, ..self }
    }

    /// Restitution along the normal.
    pub fn normal_restitution(&self) -> f64 {
        let [before, after] = self.rates;
        -after[0] / before[0]
    }

    /// Tangential speed of the centre after the impact over that before; NaN for a normal impact.
    pub fn tangential_restitution(&self) -> f64 {
        ratio(self.rebound.ball.tangential, self.before.tangential)
    }

    /// Tangential speed of the contact point before the impact over that after, with the sign changed; NaN if there was
    /// none before.
    pub fn contact_point_restitution(&self) -> f64 {
        let [before, after] = self.rates;
        -ratio(after[1], before[1])
    }

    /// Angle of the rebound from the normal \[degrees\]; negative if the ball flies back.
    pub fn angle(&self) -> f64 {
        self.rebound.ball.tangential.atan2(-self.rebound.ball.normal).to_degrees()
    }

    /// Speed of the centre after the impact \[m/s\].
    pub fn speed(&self) -> f64 {
        self.rebound.ball.tangential.hypot(self.rebound.ball.normal)
    }

    /// The slip in words: "slides throughout", "sticks", or for which part of the contact time it slides.
    pub fn words(&self) -> String {
        match self.rebound.sliding_part {
            _ if self.rates[0][1] == 0.0 && self.rebound.friction_work == 0.0 => "no slip".into(),
            part if part > 0.999 => "slides throughout".into(),
            part if part < 5e-4 => "sticks, or slips partly, throughout".into(),
            part => format!("slides for {:.1} % of the contact time, else sticks or slips partly", 100.0 * part),
        }
    }

    /// The quantities of the rebound: name, value, unit.
    pub fn quantities(&self) -> Vec<Quantity> {
        let ball = &self.rebound.ball;
        let own = [
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
            ("energy lost", self.energy_lost, "J"),
            ("sliding part", self.rebound.sliding_part, ""),
        ];
        let struck = self.struck.map(|Struck { speeds: [normal, tangential], spin }| {
            [
                ("struck angle", tangential.atan2(normal).to_degrees(), "deg"),
                ("struck speed", normal.hypot(tangential), "m/s"),
                ("struck normal speed", normal, "m/s"),
                ("struck tangential speed", tangential, "m/s"),
                ("struck spin", spin, "rad/s"),
            ]
        });
        own.into_iter().chain(struck.into_iter().flatten()).collect()
    }
}

/// A ratio; NaN if the denominator is zero.
fn ratio(numerator: f64, denominator: f64) -> f64 {
    if denominator == 0.0 { f64::NAN } else { numerator / denominator }
}
