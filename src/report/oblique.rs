//! Oblique impacts: the error of the rebound over the steps of a master, and that of a contact with a single tangential spring.

use super::contact::Contact;
use super::precision::doubled;
use super::ways::gaps;
use super::{Figure, Progress, ReportError};
use crate::importer::ImportError;
use brinell_contact::History;
use brinell_contact::loading::AnyLoading;
use brinell_contact::tangential::RoughModel;
use brinell_contact::tangential::impact::Ball;
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::laws::choose;
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

/// Steps per contact of the fine comparison over angles.
const FINE: u32 = 2000;

/// Number of angles of the comparison.
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

/// The usual contact of discrete-element codes, for comparison only: the tangential force grows by Mindlin's stiffness
/// `8 G* a` times the slip and is cut at Coulomb's limit. If it `rescales`, the force falls in unloading with the contact
/// radius `a`.
///
/// Reference: O. R. Walton, R. L. Braun, *J. Rheology* 30 (1986) 949-980, in the form of C. Thornton, S. J. Cummins,
/// P. W. Cleary, *Powder Technology* 233 (2013) 30-46.
struct SingleSpring {
    model: RoughModel<AnyLoading, AnyUnloading>,
    rescales: bool,
    normal: Option<History>,
    /// \[N\]
    pull: f64,
}

impl Rough for SingleSpring {
    fn start(&mut self, gap: f64, _step: f64) -> Result<(), ImportError> {
        (self.normal, self.pull) = (History::start(&self.model.normal, -gap).ok(), 0.0);
        Ok(())
    }

    /// A law that can't be evaluated as deep as this has no force.
    fn step(&mut self, (rate, slip): (f64, f64), step: f64) -> Result<(f64, f64), ImportError> {
        let RoughModel { normal: model, friction } = &self.model;
        let Some(normal) = &mut self.normal else { return Ok((0.0, 0.0)) };
        let before = normal.contact_radius(model);
        if normal.advance(model, rate * step).is_err() {
            return Ok((0.0, 0.0));
        }
        let after = normal.contact_radius(model);
        if self.rescales && rate < 0.0 && before > 0.0 {
            self.pull *= after / before;
        }
        // 4 G* = stiffness_ratio E*
        let stiffness = 2.0 * friction.stiffness_ratio * model.pair.modulus * 0.5 * (before + after);
        let limit = friction.coefficient * normal.force();
        self.pull = (self.pull + stiffness * slip * step).clamp(-limit, limit);
        Ok((normal.force(), self.pull))
    }
}

/// Root-mean-square error over angles and places, by a method.
#[derive(Serialize)]
pub struct Error {
    method: &'static str,
    steps_per_contact: u32,
    error_of_tangential_restitution: f64,
}

/// The rebound at an angle, by a method with fine steps or by the prediction.
#[derive(Serialize)]
pub struct Rebound {
    method: &'static str,
    angle_deg: f64,
    tangential_restitution: f64,
}

/// The measurements.
#[derive(Serialize)]
pub struct Oblique {
    #[serde(rename = "oblique-error")]
    errors: Vec<Error>,
    #[serde(rename = "oblique-angle")]
    rebounds: Vec<Rebound>,
    #[serde(skip)]
    pub words: String,
    /// The impacts, in words.
    #[serde(skip)]
    pub impacts: String,
    /// The effect of friction on stable steps.
    #[serde(skip)]
    pub advice: Option<String>,
}

/// The names of the prediction and of the methods.
const PREDICTED: &str = "predicted";
const NAMES: [&str; 3] = ["the FMU, leap-frog", "single spring", "single spring, rescaled"];

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
    let Ok(model) = oblique::rough(scene, choice, coefficient, &[]) else { return Ok(None) };
    let angles = RATIOS.map(|ratio| (ratio * coefficient).atan().to_degrees());
    let predict = |angle| {
        let setting = Setting { angle, spin: 0.0, coefficient, inertia: None };
        oblique::one(scene, choice, (scene.impact, setting), &[]).ok()
    };
    let Some(exact) = angles.iter().map(|angle| predict(*angle)).collect::<Option<Vec<Outcome>>>() else {
        return Ok(None);
    };
    let grid = (1..=ANGLES).map(|index| 88.0 * f64::from(index) / f64::from(ANGLES));
    let all: Vec<Outcome> = grid.filter_map(predict).collect();
    let rebound_of = |method, outcome: &Outcome, tangential_restitution| Rebound {
        method,
        angle_deg: outcome.setting.angle,
        tangential_restitution,
    };
    let mut rebounds: Vec<_> =
        all.iter().map(|outcome| rebound_of(PREDICTED, outcome, outcome.tangential_restitution())).collect();
    let spring = |rescales| SingleSpring { model, rescales, normal: None, pull: 0.0 };
    let methods: [&mut dyn Rough; 3] = [contact, &mut spring(false), &mut spring(true)];
    let mut errors = Vec::new();
    for (method, rough) in NAMES.into_iter().zip(methods) {
        for steps_per_contact in doubled(4, most) {
            let error_of_tangential_restitution = error(rough, &exact, steps_per_contact)?;
            errors.push(Error { method, steps_per_contact, error_of_tangential_restitution });
        }
        for outcome in &all {
            rebounds.push(rebound_of(method, outcome, rebound(rough, outcome, FINE, 1)?));
        }
    }
    let ratio = exact.first().map_or(f64::NAN, frequency_ratio);
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
    let words = words(coefficient, &errors, &rebounds);
    Ok(Some(Oblique { errors, rebounds, words, impacts, advice }))
}

/// Frequency of the tangential motion of a sticking ball over that of its normal motion: `sqrt(4 G*/E* m/m_t)`, with
/// `1/m_t = 1/m + R^2/I` at the contact point.
fn frequency_ratio(outcome: &Outcome) -> f64 {
    let Ball { mass, inertia, radius, .. } = outcome.before;
    (outcome.friction.stiffness_ratio * (1.0 + mass * radius * radius / inertia)).sqrt()
}

/// Root-mean-square error of the tangential restitution of all impacts, with this number of steps per contact.
fn error(rough: &mut dyn Rough, exact: &[Outcome], steps: u32) -> Result<f64, ImportError> {
    let mut squares = 0.0;
    for outcome in exact {
        squares += (rebound(rough, outcome, steps, PLACES)? - outcome.tangential_restitution()).powi(2);
    }
    Ok((squares / exact.len() as f64).sqrt())
}

/// Tangential restitution of an impact with this number of steps per contact, as the mean over some places within a step
/// where the bodies touch. The contact steps first, then the ball with its new forces. It gives up after some steps.
fn rebound(rough: &mut dyn Rough, outcome: &Outcome, steps: u32, places: u32) -> Result<f64, ImportError> {
    let step = outcome.rebound.contact_time / f64::from(steps);
    let mut sum = 0.0;
    for gap in gaps(outcome.before.normal, step, places) {
        rough.start(gap, step)?;
        let mut ball = outcome.before;
        for _ in 0..20 * steps {
            let (force, pull) = rough.step((ball.normal, ball.slip()), step)?;
            ball.normal -= step * force / ball.mass;
            ball.tangential -= step * pull / ball.mass;
            ball.spin -= step * pull * ball.radius / ball.inertia;
            if force <= 0.0 && ball.normal <= 0.0 {
                break;
            }
        }
        sum += ball.tangential / outcome.before.tangential;
    }
    Ok(sum / f64::from(places))
}

/// The finding: how far the methods are off.
fn words(coefficient: f64, errors: &[Error], rebounds: &[Rebound]) -> String {
    let last = |name| {
        let own = errors.iter().rfind(|error| error.method == name);
        significant(own.map_or(f64::NAN, |error| error.error_of_tangential_restitution), 2)
    };
    let of = |name| rebounds.iter().filter(move |own| own.method == name).map(|own| own.tangential_restitution);
    let off =
        |name| significant(of(name).zip(of(PREDICTED)).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max), 2);
    let [unit, plain, rescaled] = NAMES;
    format!(
        "Coefficient of friction {coefficient}. With the smallest steps the FMU is within {} of the predicted tangential \
         restitution. A single spring stays {} away, and {} if it is rescaled, whatever the step; at the worst angle {} and {}.",
        last(unit),
        last(plain),
        last(rescaled),
        off(plain),
        off(rescaled)
    )
}

impl Oblique {
    /// The error over the steps, and the rebound over the angle.
    pub fn figures(&self) -> [Figure; 2] {
        let errors = self
            .errors
            .iter()
            .map(|own| (own.method, (f64::from(own.steps_per_contact), own.error_of_tangential_restitution)));
        // the FMU would cover the prediction
        let rebounds = self.rebounds.iter().filter(|own| own.method != NAMES[0]);
        let rebounds = rebounds.map(|own| (own.method, (own.angle_deg, own.tangential_restitution)));
        [
            figure("oblique-error", "steps per contact", "error of tangential restitution", true, errors.collect()),
            figure(
                "oblique-angle",
                "angle of incidence [degrees]",
                "tangential restitution",
                false,
                rebounds.collect(),
            ),
        ]
    }
}

/// A figure of points that stand in the order of their methods.
fn figure(name: &'static str, x: &str, y: &str, logarithmic: bool, points: Vec<(&'static str, (f64, f64))>) -> Figure {
    let series = points.chunk_by(|one, other| one.0 == other.0).map(|own| Series {
        label: own[0].0.into(),
        points: own.iter().map(|(_, point)| *point).collect(),
        dots: false,
    });
    let series = series.collect();
    let picture = Picture { x_title: x.into(), y_title: y.into(), logarithmic: (logarithmic, logarithmic), series };
    Figure::new(name, &format!("{y} over {x}"), &picture, &View::default(), false)
}
