//! The oblique impact of a ball on a contact with friction: the FMU compared with the springs of the library.

use super::master::STEPS_PER_CONTACT;
use super::row::Row;
use crate::importer::{Description, ImportError, Instance};
use brinell_contact::Contact;
use brinell_contact::impact::Impact;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::{RoughContact, RoughModel};
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::constants::{MEMORY, parameters, start_value};
use brinell_exporter::scene::Scene;
use brinell_fmu::scene::with_friction;

/// The tangential variables of FMUs with one and with two directions: what is behind their names, and the component of the
/// motion, which is along one line.
const DIRECTIONS: [&[(&str, f64)]; 2] = [&[("", 1.0)], &[("[1]", 0.8), ("[2]", -0.6)]];

/// The angle of incidence, from the normal [degrees].
const ANGLE: f64 = 30.0;

/// Number of steps after which an impact counts as endless.
const MOST_STEPS: u32 = 16 * STEPS_PER_CONTACT;

/// A solid ball that does not spin before the impact.
#[derive(Clone, Copy)]
struct Ball {
    mass: f64,
    /// Closing speed and tangential speed of the centre [m/s].
    normal: f64,
    tangential: f64,
    /// Spin times radius [m/s]; positive if it moves the contact point as a positive tangential speed does.
    spin: f64,
}

/// What an impact is known by.
struct Rebound {
    ball: Ball,
    /// Energy lost by friction [J].
    friction_work: f64,
}

impl Ball {
    /// Speed of the contact point [m/s].
    fn slip(&self) -> f64 {
        self.tangential + self.spin
    }

    /// The ball after a `step` [s] with these forces along the normal and against the tangential rate [N].
    fn pushed(self, (force, pull): (f64, f64), step: f64) -> Ball {
        let change = step * pull / self.mass;
        Ball {
            normal: self.normal - step * force / self.mass,
            tangential: self.tangential - change,
            // a solid ball has the moment of inertia 2/5 m R^2
            spin: self.spin - 2.5 * change,
            ..self
        }
    }

    /// Moves the ball until it leaves. `contact` makes a step at the two rates [m/s] and gives both forces [N].
    fn impact<E>(
        mut self,
        step: f64,
        mut contact: impl FnMut(f64, f64) -> Result<(f64, f64), E>,
    ) -> Result<Option<Ball>, E> {
        for _ in 0..MOST_STEPS {
            let forces = contact(self.normal, self.slip())?;
            if forces.0 <= 0.0 && self.normal < 0.0 {
                return Ok(Some(self));
            }
            self = self.pushed(forces, step);
        }
        Ok(None)
    }
}

/// Runs the impact of the scene, tilted, on the first contact of `group`, in steps of `step` [s]. The FMU is at a `gap` [m].
pub fn compare(
    instance: &mut Instance,
    description: &Description,
    scene: &Scene,
    group: usize,
    (gap, step): (f64, f64),
) -> Result<Vec<Row>, ImportError> {
    let Impact { mass, speed } = scene.impact_of(group);
    let (sine, cosine) = ANGLE.to_radians().sin_cos();
    let radius = scene.group_value(group, "impactor.radius").unwrap_or(f64::NAN);
    let ball = Ball { mass, normal: speed * cosine, tangential: speed * sine, spin: 0.0 };
    let Some(expected) = by_library(scene, group, ball, step) else { return Ok(Vec::new()) };
    let directions = &DIRECTIONS[scene.directions.min(2) - 1];
    let simulated = by_unit(instance, description, &scene.contacts[group].prefix(0), directions, ball, (gap, step))?;
    let energy = 0.5 * mass * speed * speed;
    let (one, other) = (&expected, &simulated);
    let restitution = |rebound: &Rebound| rebound.ball.tangential / ball.tangential;
    let spin = |rebound: &Rebound| rebound.ball.spin / radius;
    let mut rows = vec![
        Row::new("tangential restitution", "", restitution(one), restitution(other), 1.0),
        Row::new("spin", "rad/s", spin(one), spin(other), speed / radius),
    ];
    if other.friction_work.is_finite() {
        rows.push(Row::new("friction work", "J", one.friction_work, other.friction_work, energy));
    }
    Ok(rows)
}

/// The impact in the FMU.
fn by_unit(
    instance: &mut Instance,
    description: &Description,
    prefix: &str,
    directions: &[(&str, f64)],
    ball: Ball,
    (gap, step): (f64, f64),
) -> Result<Rebound, ImportError> {
    let real = |name: &str| description.real(&format!("{prefix}{name}"));
    let (rate, force) = (real("indentation_rate")?, real("force")?);
    let tangential = directions.iter().map(|(index, component)| {
        Ok((real(&format!("tangential_rate{index}"))?, real(&format!("tangential_force{index}"))?, *component))
    });
    let tangential = tangential.collect::<Result<Vec<_>, ImportError>>()?;
    let work = real("friction_work").ok();
    let mut time = 0.0;
    if gap > 0.0 {
        instance.set_real(rate, ball.normal)?;
        instance.do_step(time, gap / ball.normal)?;
        time += gap / ball.normal;
    }
    let rebound = ball.impact(step, |normal, slip| {
        instance.set_real(rate, normal)?;
        for &(rate, _, component) in &tangential {
            instance.set_real(rate, component * slip)?;
        }
        instance.do_step(time, step)?;
        time += step;
        let mut pull = 0.0;
        for &(_, force, component) in &tangential {
            pull += component * instance.real(force)?;
        }
        Ok::<_, ImportError>((instance.real(force)?, pull))
    })?;
    let friction_work = work.map_or(Ok(f64::NAN), |work| instance.real(work))?;
    let ball = rebound.ok_or(ImportError::Endless { steps: MOST_STEPS })?;
    Ok(Rebound { ball, friction_work })
}

/// The same with the springs of the library; `None` where the law cannot be evaluated.
fn by_library(scene: &Scene, group: usize, ball: Ball, step: f64) -> Option<Rebound> {
    let model = model_of(scene, group);
    let mut contact = RoughContact::<MEMORY>::start(&model, 0.0).ok()?;
    let rebound = ball.impact(step, |normal, slip| {
        contact.set_tangential_rate(slip);
        contact.step_held(normal, step, &model.normal.yield_point(), || model).map_err(|_| ())?;
        Ok::<_, ()>((contact.normal().force(), contact.tangential_force(&model)))
    });
    Some(Rebound { ball: rebound.ok()??, friction_work: contact.friction_work(&model) })
}

/// The contact of `group` with friction.
fn model_of(scene: &Scene, group: usize) -> RoughModel<AnyLoading, AnyUnloading> {
    with_friction(scene.model_of(group), |which| {
        let variable = parameters().nth(which as usize);
        variable.map_or(f64::NAN, |variable| start_value(scene, group, &variable.name))
    })
}
