//! The oblique impact of a ball on a contact with friction: the FMU compared with the springs of the library.

use super::impact::{MOST_STEPS, Row};
use crate::importer::ImportError;
use crate::master;
use brinell_contact::Contact;
use brinell_contact::impact::Impact;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::impact::Ball;
use brinell_contact::tangential::{Friction, FrictionalContact, FrictionalModel};
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::library::{MEMORY, parameters, start_value};
use brinell_exporter::master::{Coupled, bounce};
use brinell_exporter::scene::Scene;
use brinell_fmu::scene::with_friction;

/// The angle of incidence, from the normal [degrees].
const ANGLE: f64 = 30.0;

/// What an impact is known by: the ball, and the energy lost by friction [J].
type Rebound = (Ball, f64);

/// Runs the impact of the scene, tilted, on the first contact of `group`, in steps of `step` [s]. The FMU is at a `gap` [m].
pub fn compare(
    contact: &mut master::Contact,
    scene: &Scene,
    group: usize,
    (gap, step): (f64, f64),
) -> Result<Vec<Row>, ImportError> {
    let Impact { mass, speed } = scene.impact_of(group);
    let (sine, cosine) = ANGLE.to_radians().sin_cos();
    let radius = scene.group_value(group, "impactor.radius").unwrap_or(f64::NAN);
    // a solid ball that does not spin before the impact
    let inertia = 0.4 * mass * radius * radius;
    let ball = Ball { mass, inertia, radius, normal: speed * cosine, tangential: speed * sine, spin: 0.0 };
    let Some((expected, expected_work)) = by_library(scene, group, ball, step) else { return Ok(Vec::new()) };
    let (simulated, simulated_work) = by_unit(contact, ball, (gap, step))?;
    let restitution = |rebound: &Ball| rebound.tangential / ball.tangential;
    let mut rows = vec![
        Row::new("tangential restitution", "", restitution(&expected), restitution(&simulated), 1.0),
        Row::new("spin", "rad/s", expected.spin, simulated.spin, speed / radius),
    ];
    if simulated_work.is_finite() {
        rows.push(Row::new("friction work", "J", expected_work, simulated_work, 0.5 * mass * speed * speed));
    }
    Ok(rows)
}

/// The impact in the FMU. The work of friction is NaN if it has no such output.
fn by_unit(contact: &mut master::Contact, ball: Ball, (gap, step): (f64, f64)) -> Result<Rebound, ImportError> {
    if gap > 0.0 {
        contact.set_rate(ball.normal)?;
        contact.step(gap / ball.normal)?;
    }
    let rebound = bounce(ball, step, MOST_STEPS, |rates| contact.step_obliquely(rates, step))?;
    let ball = rebound.ok_or(ImportError::Endless { steps: MOST_STEPS })?;
    Ok((ball, contact.output("friction_work").unwrap_or(f64::NAN)))
}

/// The same with the springs of the library; `None` where the law cannot be evaluated.
fn by_library(scene: &Scene, group: usize, ball: Ball, step: f64) -> Option<Rebound> {
    let model = model_of(scene, group);
    let mut contact = FrictionalContact::<MEMORY>::start(&model, 0.0).ok()?;
    let rebound = bounce(ball, step, MOST_STEPS, |(closing, slip)| {
        contact.set_tangential_rate(slip);
        contact.step_held(closing, step, &model.normal.yield_point(), || model).map_err(|_| ())?;
        Ok::<_, ()>((contact.normal().force(), contact.tangential_force(&model)))
    });
    Some((rebound.ok()??, contact.friction_work(&model)))
}

/// The friction of the contacts of `group`.
pub fn friction_of(scene: &Scene, group: usize) -> Friction {
    model_of(scene, group).friction
}

/// The contact of `group` with friction.
fn model_of(scene: &Scene, group: usize) -> FrictionalModel<AnyLoading, AnyUnloading> {
    with_friction(scene.model_of(group), (), |which| {
        let variable = parameters().nth(which as usize);
        variable.map_or(f64::NAN, |variable| start_value(scene, group, &variable.name))
    })
}
