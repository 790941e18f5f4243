//! Error against run time: every way to couple, for different numbers of steps per contact.

mod page;

use super::contact::Contact;
use super::progress::{Progress, Work};
use super::ways::{Way, gaps};
use crate::importer::ImportError;
use brinell_contact::impact::{Impact, Prediction};
use std::time::Instant;

pub use page::part;

/// The range of steps per contact for the fit of the order: large steps and rounding do not affect it.
const FITTED: std::ops::RangeInclusive<u32> = 16..=512;

/// Largest ratio of the errors with a halved and a full step for an error that follows a power of the step. The error
/// of another FMU may converge to the difference of its law instead.
const LEAST_FALL: f64 = 0.75;

/// Errors below this are rounding.
const ROUNDING: f64 = 1e-11;

/// One way with one number of steps per contact. Errors are relative to the energy balance, and root mean squares
/// over the phases.
pub struct Point {
    pub steps: u32,
    /// [s]
    pub step: f64,
    pub restitution: f64,
    pub max_force: f64,
    /// NaN for an elastic contact, and for an FMU without this output.
    pub dent: f64,
    /// NaN if there is no value.
    pub contact_time: f64,
    /// For one impact.
    pub calls: f64,
    /// The shortest of the phases [s].
    pub run_time: f64,
}

/// One way for increasing numbers of steps per contact.
pub struct Line {
    /// `None` for the FMU alone.
    pub way: Option<&'static Way>,
    /// The other FMU; `None` for that of the scene.
    pub peer: Option<String>,
    pub points: Vec<Point>,
    /// Order of the error of restitution in the step; `None` if the error is rounding.
    pub order: Option<f64>,
}

/// The common settings of all lines of a report.
#[derive(Clone, Copy)]
pub struct Plan<'a> {
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

impl Plan<'_> {
    /// The numbers of steps per contact, starting with `fewest`.
    fn steps(self, fewest: u32) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(fewest), |steps| Some(2 * steps)).take_while(move |steps| *steps <= self.most)
    }

    /// The work for a line.
    pub fn work(self) -> impl Iterator<Item = Work> {
        self.steps(2).map(move |steps| self.work_of(steps))
    }

    /// The work for a point.
    fn work_of(self, steps: u32) -> Work {
        Work::Steps(u64::from(self.phases * steps))
    }

    /// Runs `way` with 2 steps per contact and more.
    ///
    /// # Errors
    /// [`ImportError`] if the FMU rejects a call.
    pub fn measure(self, contact: &mut Contact, way: &'static Way) -> Result<Line, ImportError> {
        self.progress.say(&format!("error against run time: {}", way.name));
        let points = self.steps(2).map(|steps| self.point(contact, way, steps));
        let points = points.collect::<Result<Vec<_>, _>>()?;
        let order = order(&points);
        Ok(Line { way: Some(way), peer: None, points, order })
    }

    fn point(self, contact: &mut Contact, way: &Way, steps: u32) -> Result<Point, ImportError> {
        let Plan { impact, prediction, .. } = self;
        let step = prediction.contact_time() / f64::from(steps);
        let mut sums = Sums::default();
        for gap in gaps(impact.speed, step, self.phases) {
            contact.start_apart(gap, step)?;
            let began = Instant::now();
            let rebound = way.impact(contact, impact.mass, impact.speed, step)?;
            sums.run_time(began);
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
        self.progress.done(self.work_of(steps));
        Ok(sums.point(steps, step))
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
        for steps in self.steps(4) {
            let mut sums = Sums::default();
            for phase in 0..self.phases {
                let uneven = f64::from(phase) / f64::from(self.phases);
                let began = Instant::now();
                let split = self.there_and_back(contact, steps, uneven)?;
                sums.run_time(began);
                let error = |index: usize| split[index] / whole[index] - 1.0;
                sums.add([error(0), error(1), error(2), f64::NAN]);
                sums.calls += contact.calls;
            }
            self.progress.done(self.work_of(steps));
            points.push(sums.point(steps, self.prediction.contact_time() / f64::from(steps)));
        }
        Ok(Line { way: None, peer: None, points, order: None })
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
struct Sums {
    /// Sums of squared errors of restitution, force, dent and contact time.
    squares: [f64; 4],
    calls: u64,
    shortest: f64,
    count: u32,
}

impl Default for Sums {
    fn default() -> Sums {
        Sums { squares: [0.0; 4], calls: 0, shortest: f64::INFINITY, count: 0 }
    }
}

impl Sums {
    fn add(&mut self, errors: [f64; 4]) {
        self.count += 1;
        self.squares.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * error);
    }

    fn run_time(&mut self, began: Instant) {
        self.shortest = self.shortest.min(began.elapsed().as_secs_f64());
    }

    fn point(self, steps: u32, step: f64) -> Point {
        let [restitution, max_force, dent, contact_time] = self.squares.map(|sum| (sum / f64::from(self.count)).sqrt());
        let calls = self.calls as f64 / f64::from(self.count);
        Point { steps, step, restitution, max_force, dent, contact_time, calls, run_time: self.shortest }
    }
}

/// The slope of log(error) over log(step), by least squares; `None` if the error does not fall with the step.
fn order(points: &[Point]) -> Option<f64> {
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

impl Line {
    /// The name of the way.
    pub fn name(&self) -> &'static str {
        self.way.map_or("unit alone", |way| way.name)
    }

    /// The largest step from which on the error of restitution stays below `error`.
    pub fn step_for(&self, error: f64) -> Option<&Point> {
        let good = |point: &&Point| point.restitution < error;
        self.points.iter().rev().take_while(good).last()
    }
}
