//! Oblique impacts: the error of the rebound over the steps of a master.

use super::precision::doubled;
use super::{Figure, Progress, ReportError};
use crate::importer::ImportError;
use crate::master::Contact;
use brinell_exporter::laws::choose;
use brinell_exporter::master::{bounce, gaps};
use brinell_exporter::numbers::{quantity, significant};
use brinell_exporter::plot::{Picture, Series, View};
use brinell_exporter::predict::oblique::{self, FRICTION, Outcome, Setting};
use brinell_exporter::scene::Scene;
use serde::Serialize;

/// Angles of incidence as the ratio of the tangential speed to the normal one and the coefficient of friction: from sticking
/// to almost sliding.
const RATIOS: [f64; 3] = [0.5, 2.0, 4.0];

/// Places within a step where the bodies touch.
const PLACES: u32 = 4;

/// Root-mean-square error over angles and places.
#[derive(Serialize)]
pub struct ObliqueError {
    steps_per_contact: u32,
    error_of_tangential_restitution: f64,
}

/// The measurements.
#[derive(Serialize)]
pub struct Oblique {
    #[serde(rename = "oblique-error")]
    errors: Vec<ObliqueError>,
    #[serde(rename = "oblique")]
    words: String,
    /// The impacts, in words.
    #[serde(rename = "oblique-impacts")]
    impacts: String,
    /// The effect of friction on stable steps.
    #[serde(skip)]
    pub advice: Option<String>,
}

/// The oblique impacts of `scene`, which has one contact with friction, with up to `most` steps per contact; `None` for a
/// scene without friction.
///
/// # Errors
/// [`ReportError`] if the FMU rejects a step.
pub fn measure(
    scene: &Scene,
    contact: Option<&mut Contact>,
    most: u32,
    progress: &Progress,
) -> Result<Option<Oblique>, ReportError> {
    let (Some(contact), Some(coefficient)) = (contact, scene.group_value(0, FRICTION)) else { return Ok(None) };
    progress.say("oblique impacts");
    let choices = choose(scene, &[]).unwrap_or_default();
    let Some(choice) = choices.first().filter(|_| coefficient > 0.0) else { return Ok(None) };
    let predict = |angle| {
        let setting = Setting { angle, spin: 0.0, coefficient, inertia: None };
        oblique::one(scene, choice, (scene.impact, setting), &[]).ok()
    };
    let angles = RATIOS.map(|ratio| (ratio * coefficient).atan().to_degrees());
    let Some(exact) = angles.iter().map(|angle| predict(*angle)).collect::<Option<Vec<Outcome>>>() else {
        return Ok(None);
    };
    let mut errors = Vec::new();
    for steps_per_contact in doubled(4, most) {
        let mut squares = 0.0;
        for outcome in &exact {
            squares += (rebound(contact, outcome, steps_per_contact)? - outcome.tangential_restitution()).powi(2);
        }
        let error_of_tangential_restitution = (squares / exact.len() as f64).sqrt();
        errors.push(ObliqueError { steps_per_contact, error_of_tangential_restitution });
    }
    // frequency of the tangential motion of a sticking ball over that of its normal motion: `sqrt(4 G*/E* m/m_t)`
    let Outcome { friction, before: ball, .. } = &exact[0];
    let ratio = (friction.stiffness_ratio * ball.mass / ball.tangential_mass()).sqrt();
    let advice = (ratio > 1.0).then(|| {
        format!(
            "These steps are for the normal motion. With friction the largest stable steps of a solid ball that sticks are {} \
             times shorter.",
            significant(ratio, 2)
        )
    });
    let impacts = format!(
        "at {}, at {} degrees from the normal",
        quantity(scene.impact.speed, "m/s"),
        angles.map(|angle| significant(angle, 3)).join(", ")
    );
    let last = errors.last().map_or(f64::NAN, |error| error.error_of_tangential_restitution);
    let words = format!(
        "Coefficient of friction {coefficient}. With the smallest steps the FMU is within {} of the predicted tangential \
         restitution.",
        significant(last, 2)
    );
    Ok(Some(Oblique { errors, words, impacts, advice }))
}

/// Tangential restitution of an impact with this number of steps per contact, as the mean over some places within a step
/// where the bodies touch; NaN if it doesn't end. The contact steps first, then the ball with its new forces.
fn rebound(contact: &mut Contact, outcome: &Outcome, steps: u32) -> Result<f64, ImportError> {
    let step = outcome.rebound.contact_time / f64::from(steps);
    let mut sum = 0.0;
    for gap in gaps(outcome.before.normal, step, PLACES) {
        contact.start_apart(gap, step)?;
        let ball = bounce(outcome.before, step, 20 * steps, |rates| contact.step_obliquely(rates, step))?;
        sum += ball.map_or(f64::NAN, |ball| ball.tangential / outcome.before.tangential);
    }
    Ok(sum / f64::from(PLACES))
}

impl Oblique {
    /// The error over the steps.
    pub fn figure(&self) -> Figure {
        let points =
            self.errors.iter().map(|own| (f64::from(own.steps_per_contact), own.error_of_tangential_restitution));
        let titles = ("steps per contact", "error of tangential restitution");
        let picture = Picture::new(titles, (true, true), vec![Series::line("the FMU, leap-frog", points)]);
        Figure::new("oblique-error", &format!("{} over {}", titles.1, titles.0), &picture, &View::default())
    }
}
