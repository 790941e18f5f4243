//! Oblique impacts: the error of the rebound over the steps of a master, and that of a contact with a single tangential spring.

mod page;
mod single_spring;

use super::ReportError;
use super::contact::Contact;
use super::ways::gaps;
use crate::importer::ImportError;
use crate::laws::{Choice, choose};
use crate::predict::oblique::{self, FRICTION, Outcome, Setting};
use crate::scene::Scene;
use brinell_contact::tangential::impact::Ball;
use single_spring::SingleSpring;

/// Angles of incidence as the ratio of the tangential speed to the normal one and the coefficient of friction: from sticking
/// to almost sliding.
const RATIOS: [f64; 3] = [0.5, 2.0, 4.0];

/// Places within a step where the bodies touch.
const PLACES: u32 = 4;

/// Steps per contact of the fine comparison over angles.
const FINE: u32 = 2000;

/// Angles of the comparison [degrees].
const ANGLES: u32 = 40;

/// A contact with a tangential force, in the hands of a master.
trait Rough {
    /// Starts with the bodies `gap` [m] apart; `step` [s] is that of the impact.
    fn start(&mut self, gap: f64, step: f64) -> Result<(), ImportError>;

    /// Steps with the two rates [m/s]; the two forces at the end [N].
    fn step(&mut self, rates: (f64, f64), step: f64) -> Result<(f64, f64), ImportError>;
}

impl Rough for Contact<'_> {
    fn start(&mut self, gap: f64, step: f64) -> Result<(), ImportError> {
        self.start_apart(gap, step)
    }

    fn step(&mut self, rates: (f64, f64), step: f64) -> Result<(f64, f64), ImportError> {
        self.set_rate(rates.0)?;
        self.set_tangential_rate(rates.1)?;
        Contact::step(self, step)?;
        Ok((self.force()?, self.output("tangential_force")?))
    }
}

/// A method with its errors.
struct Line {
    name: &'static str,
    /// Steps per contact and root-mean-square error of the tangential restitution over angles and places.
    errors: Vec<(u32, f64)>,
    /// Angle [degrees] and tangential restitution with fine steps.
    restitutions: Vec<(f64, f64)>,
}

/// The measurements.
pub struct Oblique {
    coefficient: f64,
    /// Frequency of the tangential motion of a sticking ball over that of its normal motion.
    frequency_ratio: f64,
    /// Angles of the errors [degrees].
    angles: [f64; 3],
    speed: f64,
    /// Tangential restitution over the angle [degrees] by the prediction.
    predicted: Vec<(f64, f64)>,
    lines: Vec<Line>,
}

/// The names of the methods.
const NAMES: [&str; 3] = ["the FMU, leap-frog", "single spring", "single spring, rescaled"];

/// The oblique impacts of `scene`, which has one contact with friction, with up to `most` steps per contact; `None` for a
/// scene without friction.
///
/// # Errors
/// [`ReportError`] if the FMU rejects a step.
pub fn measure(scene: &Scene, contact: Option<&mut Contact>, most: u32) -> Result<Option<Oblique>, ReportError> {
    let (Some(contact), Some(coefficient)) = (contact, scene.group_value(0, FRICTION)) else { return Ok(None) };
    let choices = choose(scene, &[]).unwrap_or_default();
    let Some(choice) = choices.first().filter(|_| coefficient > 0.0) else { return Ok(None) };
    let Ok(model) = oblique::rough(scene, choice, coefficient, &[]) else { return Ok(None) };
    let angles = RATIOS.map(|ratio| (ratio * coefficient).atan().to_degrees());
    let predict = |angle| predicted(scene, choice, coefficient, angle);
    let Some(exact) = angles.iter().map(|angle| predict(*angle)).collect::<Option<Vec<Outcome>>>() else {
        return Ok(None);
    };
    let grid: Vec<f64> = (1..=ANGLES).map(|index| 88.0 * f64::from(index) / f64::from(ANGLES)).collect();
    let all: Vec<Outcome> = grid.iter().filter_map(|angle| predict(*angle)).collect();
    let [plain, rescaled] = [false, true].map(|rescales| SingleSpring::new(model, rescales));
    let (mut plain, mut rescaled) = (plain, rescaled);
    let mut methods: [(&str, &mut dyn Rough); 3] =
        [(NAMES[0], contact), (NAMES[1], &mut plain), (NAMES[2], &mut rescaled)];
    let mut lines = Vec::new();
    for (name, rough) in &mut methods {
        let mut errors = Vec::new();
        for steps in std::iter::successors(Some(4), |steps| Some(2 * steps)).take_while(|steps| *steps <= most) {
            errors.push((steps, error(*rough, &exact, steps)?));
        }
        let fine = |outcome: &Outcome| Ok((outcome.setting.angle, rebound(*rough, outcome, FINE, 1)?));
        let restitutions = all.iter().map(fine).collect::<Result<_, ImportError>>()?;
        lines.push(Line { name, errors, restitutions });
    }
    let predicted = all.iter().map(|outcome| (outcome.setting.angle, outcome.tangential_restitution())).collect();
    let frequency_ratio = exact.first().map_or(f64::NAN, frequency_ratio);
    Ok(Some(Oblique { coefficient, frequency_ratio, angles, speed: scene.impact.speed, predicted, lines }))
}

/// Frequency of the tangential motion of a sticking ball over that of its normal motion: `sqrt(4 G*/E* m/m_t)`, with
/// `1/m_t = 1/m + R^2/I` at the contact point.
fn frequency_ratio(outcome: &Outcome) -> f64 {
    let Ball { mass, inertia, radius, .. } = outcome.before;
    (outcome.friction.stiffness_ratio * (1.0 + mass * radius * radius / inertia)).sqrt()
}

/// The prediction of the scene's impact at this angle [degrees].
fn predicted(scene: &Scene, choice: &Choice, coefficient: f64, angle: f64) -> Option<Outcome> {
    let setting = Setting { angle, spin: 0.0, coefficient, inertia: None };
    oblique::one(scene, choice, (scene.impact, setting), &[]).ok()
}

/// Root-mean-square error of the tangential restitution of all impacts, with this number of steps per contact.
fn error(rough: &mut dyn Rough, exact: &[Outcome], steps: u32) -> Result<f64, ImportError> {
    let mut squares = 0.0;
    for outcome in exact {
        let found = rebound(rough, outcome, steps, PLACES)?;
        squares += (found - outcome.tangential_restitution()).powi(2);
    }
    Ok((squares / exact.len() as f64).sqrt())
}

/// Tangential restitution of an impact with this number of steps per contact, as the mean over some places within a step
/// where the bodies touch.
fn rebound(rough: &mut dyn Rough, outcome: &Outcome, steps: u32, places: u32) -> Result<f64, ImportError> {
    let step = outcome.rebound.contact_time / f64::from(steps);
    let before = outcome.before;
    let mut sum = 0.0;
    for gap in gaps(before.normal, step, places) {
        rough.start(gap, step)?;
        sum += after(rough, before, (step, 20 * steps))?.tangential / before.tangential;
    }
    Ok(sum / f64::from(places))
}

/// The ball after its impact: the contact steps first, then the ball with its new forces. It gives up after some steps.
fn after(rough: &mut dyn Rough, mut ball: Ball, (step, most): (f64, u32)) -> Result<Ball, ImportError> {
    for _ in 0..most {
        let (force, pull) = rough.step((ball.normal, ball.slip()), step)?;
        ball.normal -= step * force / ball.mass;
        ball.tangential -= step * pull / ball.mass;
        ball.spin -= step * pull * ball.radius / ball.inertia;
        if force <= 0.0 && ball.normal <= 0.0 {
            break;
        }
    }
    Ok(ball)
}
