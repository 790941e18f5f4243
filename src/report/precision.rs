//! Error against run time: every way to couple, for different numbers of steps per contact.

use super::contact::Contact;
use super::ways::{Way, gaps};
use super::{Figure, Progress};
use crate::importer::ImportError;
use brinell_contact::impact::{Impact, Prediction};
use brinell_exporter::plot::{Picture, Series, View};
use serde::Serialize;
use std::time::Instant;

/// The range of steps per contact for the fit of the order: large steps and rounding do not affect it.
const FITTED: std::ops::RangeInclusive<u32> = 16..=512;

/// Largest ratio of the errors with a halved and a full step for an error that follows a power of the step. The error
/// of another FMU may converge to the difference of its law instead.
const LEAST_FALL: f64 = 0.75;

/// Errors below this are rounding.
const ROUNDING: f64 = 1e-11;

/// One way with one number of steps per contact. Errors are relative to the energy balance, and root mean squares
/// over the phases.
#[derive(Clone, Serialize)]
pub struct Point {
    unit: String,
    way: &'static str,
    #[serde(rename = "steps_per_contact")]
    pub steps: u32,
    #[serde(rename = "step_s")]
    pub step: f64,
    #[serde(rename = "error_of_restitution")]
    pub restitution: f64,
    #[serde(rename = "error_of_largest_force")]
    max_force: f64,
    /// NaN for an elastic contact, and for an FMU without this output.
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

/// One way for increasing numbers of steps per contact.
pub struct Line {
    /// `None` for the FMU alone.
    pub way: Option<&'static Way>,
    pub is_peer: bool,
    pub points: Vec<Point>,
}

/// The order of the error of restitution in the step.
#[derive(Serialize)]
pub struct Order {
    unit: String,
    way: &'static str,
    /// `None` if the error is rounding, or doesn't fall.
    order: Option<f64>,
}

/// The common settings of all lines of a report.
#[derive(Clone, Copy)]
pub struct Plan<'a> {
    /// Name of the scene.
    pub name: &'a str,
    pub impact: &'a Impact,
    pub prediction: &'a Prediction,
    /// Largest number of steps per contact.
    pub most: u32,
    /// Number of phases: places within a step where the bodies touch.
    pub phases: u32,
    /// Whether the force follows the rate.
    pub follows_rate: bool,
    pub progress: &'a Progress,
}

/// 2, 4, 8 and so on, from `fewest` up to `most`.
pub fn doubled(fewest: u32, most: u32) -> impl Iterator<Item = u32> {
    std::iter::successors(Some(fewest), |steps| Some(2 * steps)).take_while(move |steps| *steps <= most)
}

impl Plan<'_> {
    /// Runs `way` with 2 steps per contact and more; `peer` is the name of another FMU.
    ///
    /// # Errors
    /// [`ImportError`] if the FMU rejects a call.
    pub fn measure(self, contact: &mut Contact, way: &'static Way, peer: Option<&str>) -> Result<Line, ImportError> {
        self.progress.say(&format!("error against run time: {}", way.name));
        let unit = peer.unwrap_or(self.name);
        let points = doubled(2, self.most).map(|steps| self.point(contact, unit, way, steps));
        Ok(Line { way: Some(way), is_peer: peer.is_some(), points: points.collect::<Result<_, _>>()? })
    }

    fn point(self, contact: &mut Contact, unit: &str, way: &Way, steps: u32) -> Result<Point, ImportError> {
        let Plan { impact, prediction, .. } = self;
        let step = prediction.contact_time() / f64::from(steps);
        let mut sums = Sums::default();
        for gap in gaps(impact.speed, step, self.phases) {
            contact.start_apart(gap, step)?;
            let began = Instant::now();
            let rebound = way.impact(contact, impact.mass, impact.speed, step)?;
            sums.run_times.push(began.elapsed().as_secs_f64());
            let dent = contact.output("residual_indentation").unwrap_or(f64::NAN);
            // the bodies have separated within the last step and fly on
            let past = dent - contact.output("indentation").unwrap_or(f64::NAN);
            let contact_time = contact.elapsed() - past / rebound.speed - gap / impact.speed;
            sums.add([
                rebound.speed / impact.speed / prediction.restitution - 1.0,
                rebound.max_force / prediction.max_force - 1.0,
                dent / prediction.residual_indentation - 1.0,
                // the end of a force that follows the rate is independent of the surface
                if self.follows_rate { f64::NAN } else { contact_time / prediction.contact_time() - 1.0 },
            ]);
            sums.calls += contact.calls;
        }
        Ok(sums.point((unit, way.name), steps, step))
    }

    /// The contribution of the FMU itself to any error: loading and unloading, each divided into steps of unequal
    /// length, compared with one step each.
    ///
    /// # Errors
    /// [`ImportError`] if the FMU rejects a call.
    pub fn alone(self, contact: &mut Contact) -> Result<Line, ImportError> {
        self.progress.say("error against run time: the unit alone");
        let whole = self.there_and_back(contact, 2, 0.0)?;
        let mut points = Vec::new();
        for steps in doubled(4, self.most) {
            let mut sums = Sums::default();
            for phase in 0..self.phases {
                let uneven = f64::from(phase) / f64::from(self.phases);
                let began = Instant::now();
                let split = self.there_and_back(contact, steps, uneven)?;
                sums.run_times.push(began.elapsed().as_secs_f64());
                let [restitution, force, dent] = [0, 1, 2].map(|index| split[index] / whole[index] - 1.0);
                sums.add([restitution, force, dent, f64::NAN]);
                sums.calls += contact.calls;
            }
            let step = self.prediction.contact_time() / f64::from(steps);
            points.push(sums.point((self.name, "unit alone"), steps, step));
        }
        Ok(Line { way: None, is_peer: false, points })
    }

    /// Restitution, largest force [N] and dent [m] of a contact with a prescribed motion to the largest indentation
    /// and back, each in half of the `steps`. The steps are alternately longer and shorter by the fraction `uneven`.
    fn there_and_back(self, contact: &mut Contact, steps: u32, uneven: f64) -> Result<[f64; 3], ImportError> {
        let (depth, half) = (self.prediction.max_indentation, steps / 2);
        // about as fast as the impact
        let step = self.prediction.contact_time() / f64::from(steps);
        let long = half.div_ceil(2);
        // a sum of so many numbers would add the rounding of the importer
        let rate = depth / step / (f64::from(half) + uneven * f64::from(2 * long - half));
        let length = |index| step * if index % 2 == 0 { 1.0 + uneven } else { 1.0 - uneven };
        contact.start(&[("initial_gap", 0.0)])?;
        let mut max_force = 0.0;
        for sign in [1.0, -1.0] {
            for index in 0..half {
                contact.set_rate(sign * rate)?;
                contact.step(length(index))?;
                max_force = f64::max(max_force, contact.force()?);
            }
        }
        let (lost, dent) = (contact.output("dissipated_energy")?, contact.output("residual_indentation")?);
        Ok([(1.0 - lost / self.prediction.energy).sqrt(), max_force, dent])
    }
}

/// Errors and costs of all phases.
#[derive(Default)]
struct Sums {
    /// Sums of squared errors of restitution, force, dent and contact time.
    squares: [f64; 4],
    calls: u64,
    /// \[s\]
    run_times: Vec<f64>,
}

impl Sums {
    fn add(&mut self, errors: [f64; 4]) {
        self.squares.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * error);
    }

    fn point(self, (unit, way): (&str, &'static str), steps: u32, step: f64) -> Point {
        let count = self.run_times.len() as f64;
        let [restitution, max_force, dent, contact_time] = self.squares.map(|sum| (sum / count).sqrt());
        let (unit, calls) = (unit.into(), self.calls as f64 / count);
        let run_time = self.run_times.into_iter().fold(f64::INFINITY, f64::min);
        Point { unit, way, steps, step, restitution, max_force, dent, contact_time, calls, run_time }
    }
}

impl Line {
    /// The slope of log(error) over log(step), by least squares; `None` for the unit alone.
    pub fn order(&self) -> Option<Order> {
        let first = self.points.first().filter(|_| self.way.is_some())?;
        Some(Order { unit: first.unit.clone(), way: first.way, order: slope(&self.points) })
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
        ("error-against-time", ("time per impact [us]", |point| 1e6 * point.run_time), error),
        ("error-against-calls", ("calls per impact", |point| point.calls), error),
        ("force-against-steps", steps, ("error of largest force", |point| point.max_force)),
        ("dent-against-steps", steps, ("error of dent", |point| point.dent)),
        ("contact-time-against-steps", steps, ("error of contact time", |point| point.contact_time)),
    ];
    let drawn = all.into_iter().enumerate().filter_map(|(index, (name, (x_title, x), (y_title, y)))| {
        // an error of zero is below all decades too
        let drawn = |y: f64| if y == 0.0 { f64::MIN_POSITIVE } else { y };
        let series = lines.iter().filter(|line| line.way.is_some()).map(|line| Series {
            label: match line.points.first() {
                Some(point) if line.is_peer => format!("{}: {}", point.unit, point.way),
                first => first.map_or("", |point| point.way).into(),
            },
            points: line.points.iter().map(|point| (x(point), drawn(y(point)))).collect(),
            dots: false,
        });
        let picture = Picture {
            x_title: x_title.into(),
            y_title: y_title.into(),
            logarithmic: (true, true),
            series: series.collect(),
        };
        let known = picture.series.iter().flat_map(|series| &series.points).any(|point| point.1 > 0.0);
        // the decades that matter, and the error that most users accept
        let view = View { values: Some(1e-6..2.0), mark: Some(0.01), ..View::default() };
        known.then(|| Figure::new(name, &format!("{y_title} over {x_title}"), &picture, &view, index > 1))
    });
    drawn.collect()
}
