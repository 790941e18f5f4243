//! Error against run time: every way to couple, for different numbers of steps per contact.

use super::runs::{Figure, Runs};
use crate::importer::ImportError;
use crate::master::Contact;
use brinell_exporter::master::{CouplingMethod, gaps};
use brinell_exporter::plot::{Picture, Series, View};
use serde::Serialize;
use std::time::Instant;

/// The range of steps per contact for the fit of the order: large steps and rounding do not affect it.
const FITTED: std::ops::RangeInclusive<u32> = 16..=512;

/// Largest ratio of the errors with a halved and a full step for an error that follows a power of the step.
const LEAST_FALL: f64 = 0.75;

/// Errors below this are rounding.
const ROUNDING: f64 = 1e-11;

/// One way with one number of steps per contact. Errors are relative to the energy balance, and root mean squares
/// over the phases.
#[derive(Clone, Serialize)]
pub struct Point {
    way: &'static str,
    #[serde(rename = "steps_per_contact")]
    pub steps: u32,
    #[serde(rename = "step_s")]
    pub step: f64,
    #[serde(rename = "error_of_restitution")]
    pub restitution: f64,
    #[serde(rename = "error_of_largest_force")]
    max_force: f64,
    /// NaN for an elastic contact.
    #[serde(rename = "error_of_dent")]
    dent: f64,
    /// NaN if there is no value.
    #[serde(rename = "error_of_contact_time")]
    contact_time: f64,
    #[serde(rename = "calls_per_impact")]
    pub calls: f64,
    /// The shortest of the phases.
    #[serde(rename = "time_per_impact_s")]
    pub run_time: f64,
}

/// One way to couple an FMU for increasing numbers of steps per contact.
pub struct Line {
    pub way: &'static CouplingMethod,
    pub points: Vec<Point>,
}

/// The order of the error of restitution in the step.
#[derive(Serialize)]
pub struct Order {
    way: &'static str,
    /// `None` if the error is rounding, or doesn't fall.
    order: Option<f64>,
}

/// 2, 4, 8 and so on, from `fewest` up to `most`.
pub fn doubled(fewest: u32, most: u32) -> impl Iterator<Item = u32> {
    std::iter::successors(Some(fewest), |steps| Some(2 * steps)).take_while(move |steps| *steps <= most)
}

/// Runs `way` with 2 steps per contact and more.
///
/// # Errors
/// [`ImportError`] if the FMU rejects a call.
pub fn measure(runs: &Runs, contact: &mut Contact, way: &'static CouplingMethod) -> Result<Line, ImportError> {
    runs.progress.say(&format!("error against run time: {}", way.name));
    let points = doubled(2, runs.most).map(|steps| point(runs, contact, way, steps)).collect::<Result<_, _>>()?;
    Ok(Line { way, points })
}

fn point(runs: &Runs, contact: &mut Contact, way: &CouplingMethod, steps: u32) -> Result<Point, ImportError> {
    let Runs { impact, prediction, .. } = runs;
    let step = prediction.contact_time() / f64::from(steps);
    // sums of squared errors of restitution, force, dent and contact time
    let (mut squares, mut calls, mut run_time) = ([0.0; 4], 0, f64::INFINITY);
    for gap in gaps(impact.speed, step, runs.phases) {
        contact.start_apart(gap, step)?;
        let began = Instant::now();
        let rebound = runs.rebound(way, contact, step)?;
        run_time = f64::min(run_time, began.elapsed().as_secs_f64());
        let dent = contact.output("residual_indentation").unwrap_or(f64::NAN);
        // the bodies have separated within the last step and fly on
        let past = dent - contact.output("indentation").unwrap_or(f64::NAN);
        let contact_time = contact.elapsed() - past / rebound.speed - gap / impact.speed;
        let errors = [
            rebound.speed / impact.speed / prediction.restitution - 1.0,
            rebound.max_force / prediction.max_force - 1.0,
            dent / prediction.residual_indentation - 1.0,
            // the end of a force that follows the rate is independent of the surface
            if runs.follows_rate { f64::NAN } else { contact_time / prediction.contact_time() - 1.0 },
        ];
        squares.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * error);
        calls += contact.calls;
    }
    let count = f64::from(runs.phases);
    let [restitution, max_force, dent, contact_time] = squares.map(|sum: f64| (sum / count).sqrt());
    let (way, calls) = (way.name, calls as f64 / count);
    Ok(Point { way, steps, step, restitution, max_force, dent, contact_time, calls, run_time })
}

impl Line {
    /// The slope of log(error) over log(step), by least squares.
    pub fn order(&self) -> Order {
        Order { way: self.way.name, order: slope(&self.points) }
    }

    /// The largest step from which on the error of restitution stays below `error`.
    pub fn step_for(&self, error: f64) -> Option<&Point> {
        self.points.iter().rev().take_while(|point| point.restitution < error).last()
    }
}

/// The slope of log(error) over log(step); `None` if the error does not fall with the step.
fn slope(points: &[Point]) -> Option<f64> {
    let fitted = points.iter().filter(|point| FITTED.contains(&point.steps) && point.restitution > ROUNDING);
    let logs: Vec<_> = fitted.map(|point| (point.step.ln(), point.restitution.ln())).collect();
    if logs.len() < 3 || logs.windows(2).any(|pair| pair[1].1 > pair[0].1 + LEAST_FALL.ln()) {
        return None;
    }
    let count = logs.len() as f64;
    let (mean_x, mean_y) = logs.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let covariance: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = logs.iter().map(|(x, _)| (x - mean_x) * (x - mean_x)).sum();
    Some(covariance / variance)
}

/// An axis of a figure: its title, and the value of a point.
type Axis = (&'static str, fn(&Point) -> f64);

/// Error of restitution against steps, run time and calls; errors of the other quantities against steps. The first two
/// are shown initially, and those without a line are left out.
pub fn figures(lines: &[Line]) -> Vec<Figure> {
    let steps: Axis = ("steps per contact", |point| f64::from(point.steps));
    let error: Axis = ("error of restitution", |point| point.restitution);
    let all: [(&str, Axis, Axis); 6] = [
        ("error-against-steps", steps, error),
        ("error-against-time", ("time per impact [\u{b5}s]", |point| 1e6 * point.run_time), error),
        ("error-against-calls", ("calls per impact", |point| point.calls), error),
        ("force-against-steps", steps, ("error of largest force", |point| point.max_force)),
        ("dent-against-steps", steps, ("error of dent", |point| point.dent)),
        ("contact-time-against-steps", steps, ("error of contact time", |point| point.contact_time)),
    ];
    let drawn = all.into_iter().enumerate().filter_map(|(index, (name, (x_title, x), (y_title, y)))| {
        // an error of zero is below all decades too
        let drawn = |y: f64| if y == 0.0 { f64::MIN_POSITIVE } else { y };
        let series = lines.iter().map(|line| {
            let Line { way, points } = line;
            Series::line(way.name, points.iter().map(|point| (x(point), drawn(y(point)))))
        });
        let picture = Picture::new((x_title, y_title), (true, true), series.collect());
        let known = picture.series.iter().flat_map(|series| &series.points).any(|point| point.1 > 0.0);
        // the decades that matter, and the error that most users accept
        let view = View { values: Some(1e-6..2.0), mark: Some(0.01) };
        known.then(|| Figure {
            folded: index > 1,
            ..Figure::new(name, &format!("{y_title} over {x_title}"), &picture, &view)
        })
    });
    drawn.collect()
}
