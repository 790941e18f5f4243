//! Error against run time: every way to couple, over the steps per contact.

use super::data::{Table, number, text};
use super::unit::Contact;
use super::ways::Way;
use super::{Part, drawn};
use crate::importer::ImportError;
use crate::plot::{Picture, Series};
use brinell::contact::impact::{Impact, Prediction};
use std::time::Instant;

/// The steps per contact that the order is fitted to: neither big steps nor rounding speak there.
const FITTED: std::ops::RangeInclusive<u32> = 16..=512;

/// Errors below this are rounding.
const ROUNDING: f64 = 1e-11;

/// One way at one number of steps per contact. Errors are relative to the energy balance, root mean squares over the phases.
pub struct Point {
    pub steps: u32,
    /// [s]
    pub step: f64,
    pub restitution: f64,
    pub max_force: f64,
    pub contact_time: f64,
    /// Of one impact.
    pub calls: f64,
    /// The shortest of the phases [s].
    pub run_time: f64,
}

/// One way over the steps per contact, from few to many.
pub struct Line {
    pub way: &'static str,
    pub points: Vec<Point>,
    /// Power of the step that the error of restitution follows; none if that is rounding.
    pub order: Option<f64>,
}

/// Runs `way` with 2 to `most` steps per contact; the bodies meet at so many `phases` within a step.
pub fn measure(
    contact: &mut Contact,
    way: &Way,
    (impact, prediction): (&Impact, &Prediction),
    most: u32,
    phases: u32,
    follows_rate: bool,
) -> Result<Line, ImportError> {
    let mut points = Vec::new();
    let mut steps = 2;
    while steps <= most {
        points.push(point(contact, way, (impact, prediction), steps, phases, follows_rate)?);
        steps *= 2;
    }
    let order = order(&points);
    Ok(Line { way: way.name, points, order })
}

fn point(
    contact: &mut Contact,
    way: &Way,
    (impact, prediction): (&Impact, &Prediction),
    steps: u32,
    phases: u32,
    follows_rate: bool,
) -> Result<Point, ImportError> {
    let step = prediction.contact_time() / f64::from(steps);
    let mut squares = [0.0; 3];
    let (mut calls, mut run_time) = (0, f64::INFINITY);
    for phase in 0..phases {
        // in the second step: a prediction needs a step before
        let gap = (1.0 + (f64::from(phase) + 0.5) / f64::from(phases)) * impact.speed * step;
        contact.start(&[("initial_gap", gap)])?;
        let began = Instant::now();
        let rebound = way.impact(contact, impact.mass, impact.speed, step)?;
        run_time = run_time.min(began.elapsed().as_secs_f64());
        calls += contact.calls;
        // the bodies have parted within the last step, and fly on
        let past = contact.output("residual_indentation")? - contact.output("indentation")?;
        let contact_time = contact.time - past / rebound.speed - gap / impact.speed;
        let errors = [
            rebound.speed / impact.speed / prediction.restitution - 1.0,
            rebound.max_force / prediction.max_force - 1.0,
            contact_time / prediction.contact_time() - 1.0,
        ];
        squares.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * error);
    }
    let [restitution, max_force, contact_time] = squares.map(|sum| (sum / f64::from(phases)).sqrt());
    // where a force that follows the rate ends says nothing of the surface
    let contact_time = if follows_rate { f64::NAN } else { contact_time };
    Ok(Point { steps, step, restitution, max_force, contact_time, calls: calls as f64 / f64::from(phases), run_time })
}

/// The slope of the error over the step, both as logarithms, by least squares.
fn order(points: &[Point]) -> Option<f64> {
    let fitted = points.iter().filter(|point| FITTED.contains(&point.steps) && point.restitution > ROUNDING);
    let logs: Vec<_> = fitted.map(|point| (point.step.ln(), point.restitution.ln())).collect();
    let count = logs.len() as f64;
    let (mean_x, mean_y) = logs.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let covariance: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = logs.iter().map(|(x, _)| (x - mean_x) * (x - mean_x)).sum();
    (logs.len() >= 3).then_some(covariance / variance)
}

impl Line {
    /// The biggest step from which on the error of restitution stays below `error`.
    pub fn step_for(&self, error: f64) -> Option<&Point> {
        let good = |point: &&Point| point.restitution < error;
        self.points.iter().rev().take_while(good).last()
    }
}

/// All that was measured.
fn table(lines: &[Line]) -> Table {
    let mut table = Table::new(
        "precision",
        [
            ("way", ""),
            ("steps per contact", ""),
            ("step", "s"),
            ("error of restitution", ""),
            ("error of largest force", ""),
            ("error of contact time", ""),
            ("calls per impact", ""),
            ("time per impact", "s"),
        ],
    );
    for line in lines {
        table.rows.extend(line.points.iter().map(|point| {
            vec![
                text(line.way),
                number(f64::from(point.steps)),
                number(point.step),
                number(point.restitution),
                number(point.max_force),
                number(point.contact_time),
                number(point.calls),
                number(point.run_time),
            ]
        }));
    }
    table
}

/// The fitted orders.
fn orders(lines: &[Line]) -> Table {
    let mut table = Table::new("orders", [("way", ""), ("order", "")]);
    table.rows = lines.iter().map(|line| vec![text(line.way), number(line.order.unwrap_or(f64::NAN))]).collect();
    table
}

/// Error of restitution against run time and against the number of calls, and error of force against steps.
fn pictures(lines: &[Line]) -> [Picture; 3] {
    let picture = |x: &str, y: &str, at: &dyn Fn(&Point) -> (f64, f64)| Picture {
        x_title: x.into(),
        y_title: y.into(),
        logarithmic: (true, true),
        series: lines
            .iter()
            .map(|line| Series { label: line.way.into(), points: line.points.iter().map(at).collect(), dots: false })
            .collect(),
    };
    [
        picture("time per impact [us]", "error of restitution", &|p| (1e6 * p.run_time, p.restitution)),
        picture("calls per impact", "error of restitution", &|p| (p.calls, p.restitution)),
        picture("steps per contact", "error of largest force", &|p| (f64::from(p.steps), p.max_force)),
    ]
}

/// Error against run time.
pub fn part(lines: &[Line]) -> Part {
    Part {
        title: "Error against run time",
        words: "Errors are relative to the energy balance, root mean squares over the places within a step where the bodies \
                meet. The largest force is that at the ends of steps, and the time per impact that of this machine. Late \
                force: all units step at once; leap-frog: the contact first; input derivatives: with mean_force."
            .into(),
        pictures: drawn(["error-against-time", "error-against-calls", "force-against-steps"], pictures(lines)),
        tables: vec![orders(lines), table(lines)],
    }
}
