//! Stability: what a rebound gains by big steps, and the largest step that keeps a pressed body at rest.

use super::data::{Table, number, text};
use super::unit::Contact;
use super::ways::{Body, LATE, LEAP_FROG, Way};
use super::{Part, drawn};
use crate::documentation::digits;
use crate::importer::ImportError;
use crate::plot::{Picture, Series};
use brinell::contact::impact::{Impact, Prediction};

/// What was found; steps are told as `h sqrt(K/m)`.
pub struct Stability {
    /// Largest stiffness of the impact: that of the way back from the largest indentation [N/m].
    pub stiffness: f64,
    /// `sqrt(K/m)` [1/s].
    pub frequency: f64,
    /// Each way with its rebound energies over the incoming one, the worst over the phases.
    pub lines: Vec<(&'static str, Vec<(f64, f64)>)>,
    /// Largest stable step of the leap-frog.
    pub leap_frog: Option<f64>,
    /// Largest stable step of the late force; none if even the smallest that was tried isn't.
    pub late: Option<f64>,
}

/// Smallest and largest step that is tried.
const RANGE: (f64, f64) = (0.02, 8.0);

/// Steps over which a disturbance has time to grow, at the smallest step too: a late force multiplies it by
/// `sqrt(1 + h^2 K/m)` each time.
const STEPS: u32 = 40_000;

/// What a bounded disturbance doesn't grow to, but just below the limit.
const GROWTH: f64 = 100.0;

/// Steps of the picture.
const POINTS: u32 = 40;

/// Measures the contact with the impact of the scene; `stiffness` as in [`Stability`].
pub fn measure(
    contact: &mut Contact,
    impact: &Impact,
    prediction: &Prediction,
    stiffness: f64,
    phases: u32,
) -> Result<Stability, ImportError> {
    let frequency = (stiffness / impact.mass).sqrt();
    let mut lines = Vec::new();
    for way in [LEAP_FROG, LATE] {
        let mut points = Vec::new();
        for point in 0..=POINTS {
            let relative = RANGE.0 * (RANGE.1 / RANGE.0).powf(f64::from(point) / f64::from(POINTS));
            let mut worst = 0.0;
            for phase in 0..phases {
                let step = relative / frequency;
                let gap = (1.0 + (f64::from(phase) + 0.5) / f64::from(phases)) * impact.speed * step;
                contact.start(&[("initial_gap", gap)])?;
                let rebound = way.impact(contact, impact.mass, impact.speed, step)?;
                worst = f64::max(worst, (rebound.speed / impact.speed).powi(2));
            }
            points.push((relative, worst));
        }
        lines.push((way.name, points));
    }
    let mut limit = |way: &Way| limit(|relative| stays(contact, way, impact, prediction, frequency, relative));
    let (leap_frog, late) = (limit(&LEAP_FROG)?, limit(&LATE)?);
    Ok(Stability { stiffness, frequency, lines, leap_frog, late })
}

/// The largest step that is stable, by bisection; none if not even the smallest is.
fn limit(mut stable: impl FnMut(f64) -> Result<bool, ImportError>) -> Result<Option<f64>, ImportError> {
    let (mut low, mut high) = RANGE;
    if !stable(low)? {
        return Ok(None);
    }
    if stable(high)? {
        return Ok(Some(high));
    }
    for _ in 0..20 {
        let middle = (low * high).sqrt();
        if stable(middle)? { low = middle } else { high = middle }
    }
    Ok(Some(low))
}

/// Whether a body that a constant load presses into the deepest indentation keeps to a small motion about it.
fn stays(
    contact: &mut Contact,
    way: &Way,
    impact: &Impact,
    prediction: &Prediction,
    frequency: f64,
    relative: f64,
) -> Result<bool, ImportError> {
    let step = relative / frequency;
    let elastic = prediction.max_indentation - prediction.residual_indentation;
    contact.start(&[("initial_gap", 0.0)])?;
    contact.set_rate(prediction.max_indentation / step)?;
    contact.step(step)?;
    // a bit back, so that the motion is on the elastic way and yields nothing
    contact.set_rate(-0.01 * elastic / step)?;
    contact.step(step)?;
    contact.set_rate(0.0)?;
    let mut body = Body::pressed(impact.mass, contact.force()?);
    let disturbance = 1e-6 * elastic * frequency;
    body.speed = disturbance;
    for _ in 0..STEPS {
        (way.advance)(contact, &mut body, step)?;
        if body.speed.is_nan() || body.speed.abs() > GROWTH * disturbance {
            return Ok(false);
        }
    }
    Ok(true)
}

impl Stability {
    /// Rebound energies.
    fn table(&self) -> Table {
        let columns =
            [("way", ""), ("h sqrt(K/m)", ""), ("step", "s"), ("rebound over incoming energy", ""), ("verdict", "")];
        let mut table = Table::new("stability", columns);
        for (way, points) in &self.lines {
            table.rows.extend(points.iter().map(|(relative, energy)| {
                let verdict = if *energy > 1.0 { "makes energy" } else { "loses energy" };
                vec![text(*way), number(*relative), number(relative / self.frequency), number(*energy), text(verdict)]
            }));
        }
        table
    }

    /// The largest stable steps.
    fn limits(&self) -> Table {
        let columns =
            [("way", ""), ("largest stable h sqrt(K/m)", ""), ("elastic theory", ""), ("largest stable step", "s")];
        let mut table = Table::new("limits", columns);
        for (way, limit, theory) in [(LEAP_FROG.name, self.leap_frog, 2.0), (LATE.name, self.late, 0.0)] {
            let limit = limit.unwrap_or(f64::NAN);
            table.rows.push(vec![text(way), number(limit), number(theory), number(limit / self.frequency)]);
        }
        table
    }

    /// Rebound energy over incoming energy.
    fn picture(&self) -> Picture {
        let line = |(way, points): &(&str, Vec<(f64, f64)>)| Series {
            label: (*way).into(),
            points: points.clone(),
            dots: false,
        };
        let mut series: Vec<_> = self.lines.iter().map(line).collect();
        series.push(Series {
            label: "makes energy above".into(),
            points: vec![(RANGE.0, 1.0), (RANGE.1, 1.0)],
            dots: false,
        });
        Picture {
            x_title: "h sqrt(K/m)".into(),
            y_title: "rebound over incoming energy".into(),
            logarithmic: (true, true),
            series,
        }
    }

    /// Stability.
    pub fn part(&self) -> Part {
        Part {
            title: "Stability",
            words: format!(
                "h is the step, m the mass, and K = {} N/m the largest stiffness of the impact, on the way back from the largest \
                 indentation. The largest stable step is that at which a small motion about the deepest indentation, under a \
                 constant load, doesn't grow. The rebound energy is the largest over the places within a step where the bodies \
                 meet: above 1 it is made by the coupling.",
                digits(self.stiffness)
            ),
            pictures: drawn(["stability"], [self.picture()]),
            tables: vec![self.limits(), self.table()],
        }
    }
}
