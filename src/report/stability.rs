//! Stability: the energy gain of rebounds with large steps, and the largest step that keeps a pressed body at rest.
//! Steps are `h sqrt(K/m)`, with the largest stiffness `K` of the impact: that of the unloading at the largest indentation.

use super::runs::{Figure, Runs};
use crate::importer::ImportError;
use crate::master::Contact;
use brinell_contact::impact::Impact;
use brinell_exporter::master::{Body, Coupled, CouplingMethod, Requirements, gaps};
use brinell_exporter::numbers::quantity;
use brinell_exporter::plot::{Picture, Series, View};
use serde::Serialize;

/// Smallest and largest step.
const RANGE: (f64, f64) = (0.02, 8.0);

/// Number of steps between them.
const POINTS: u32 = 40;

/// Tolerance for the rounding of a lossless rebound.
const ROUNDING: f64 = 1e-9;

/// A relevant gain of rebound energy. The best ways gain a little at some phases, and lose it at others.
const MATTERS: f64 = 1.01;

/// Rebound energies over the incoming energy for one step: the lowest and the highest of the phases.
#[derive(Serialize)]
pub struct Energy {
    way: &'static str,
    #[serde(rename = "h_sqrt(K/m)")]
    relative: f64,
    step_s: f64,
    #[serde(rename = "lowest_rebound_over_incoming_energy")]
    lowest: f64,
    /// Infinite for an impact that never ends.
    #[serde(rename = "highest_rebound_over_incoming_energy")]
    highest: f64,
    verdict: &'static str,
}

/// The largest stable step of a way.
#[derive(Serialize)]
pub struct Limit {
    pub way: &'static str,
    stable: &'static str,
    /// `None` if no step is stable, and if every step is.
    #[serde(rename = "largest_stable_h_sqrt(K/m)")]
    limit: Option<f64>,
    /// `None` for every step.
    elastic_theory: Option<f64>,
    largest_stable_step_s: Option<f64>,
    #[serde(rename = "gains_energy_from_h_sqrt(K/m)")]
    gains_from: Option<f64>,
}

/// The results.
#[derive(Default, Serialize)]
pub struct Stability {
    pub limits: Vec<Limit>,
    #[serde(rename = "stability")]
    energies: Vec<Energy>,
}

/// Rebound energies of `way` for the step at this `point` of the range.
fn energy(runs: &Runs, contact: &mut Contact, way: &CouplingMethod, point: u32) -> Result<Energy, ImportError> {
    let Impact { speed, .. } = runs.impact;
    let relative = RANGE.0 * (RANGE.1 / RANGE.0).powf(f64::from(point) / f64::from(POINTS));
    let step = relative / runs.frequency();
    let (mut lowest, mut highest) = (f64::INFINITY, 0.0);
    for gap in gaps(speed, step, runs.phases) {
        contact.start(&[("initial_gap", gap)])?;
        let ratio = (runs.rebound(way, contact, step)?.speed / speed).powi(2);
        lowest = f64::min(lowest, ratio);
        highest = if ratio.is_nan() { f64::INFINITY } else { f64::max(highest, ratio) };
    }
    let verdict = if makes_energy(highest) { "gains energy" } else { "gains none" };
    Ok(Energy { way: way.name, relative, step_s: step, lowest, highest, verdict })
}

/// The stable range in words, and its end if it has one, by bisection.
fn limit(runs: &Runs, contact: &mut Contact, way: &CouplingMethod) -> Result<(&'static str, Option<f64>), ImportError> {
    let (mut low, mut high) = RANGE;
    if !stays(runs, contact, way, low)? {
        return Ok(("at no step that was tried", None));
    }
    if stays(runs, contact, way, high)? {
        return Ok((EVERY, None));
    }
    for _ in 0..20 {
        let middle = (low * high).sqrt();
        if stays(runs, contact, way, middle)? { low = middle } else { high = middle }
    }
    Ok(("up to a step", Some(low)))
}

/// Whether a body keeps to a small motion about the deepest indentation, into which a constant load presses it.
fn stays(runs: &Runs, contact: &mut Contact, way: &CouplingMethod, relative: f64) -> Result<bool, ImportError> {
    let (prediction, frequency) = (&runs.prediction, runs.frequency());
    let step = relative / frequency;
    let elastic = prediction.max_indentation - prediction.residual_indentation;
    // an FMU that moves the mass itself goes to that position before any force can change it
    let moment = if way.needs.knows_mass() { 1e-6 / frequency } else { step };
    contact.start(&[("initial_gap", 0.0)])?;
    contact.set_rate(prediction.max_indentation / moment)?;
    contact.step(moment)?;
    // a little back: the motion is then elastic and does not yield
    contact.set_rate(-0.01 * elastic / moment)?;
    contact.step(moment)?;
    contact.set_rate(0.0)?;
    let mut body = Body::pressed(runs.impact.mass, contact.force()?);
    if way.needs == Requirements::JacobiMass {
        body.owed = contact.mean_force()?;
    }
    let disturbance = 1e-6 * elastic * frequency;
    body.speed += disturbance;
    let steps = STEPS.max(2.0 * TIME / (relative * relative).ln_1p()) as u64;
    for _ in 0..steps {
        match way.advance(contact, &mut body, step) {
            Err(error) if error.is_refused_step() => return Ok(false),
            other => other?,
        }
        // with a delayed force, the speed of the body differs from that of the motion
        let speed = if way.needs == Requirements::JacobiMass { contact.output("closing_speed")? } else { body.speed };
        if speed.is_nan() || speed.abs() > GROWTH * disturbance {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The range of a way that is stable throughout.
const EVERY: &str = "at every step that was tried";

/// Growth of a disturbance by a delayed force, as a power of e, that the run must allow: more than `ln GROWTH`. Each
/// step adds `ln(1 + z)/2`.
const TIME: f64 = 8.0;

/// Minimum number of steps for a disturbance to grow: just above the limit it grows slowly.
const STEPS: f64 = 4000.0;

/// A bounded disturbance stays below this factor, except just below the limit.
const GROWTH: f64 = 100.0;

/// Whether a rebound has gained energy.
fn makes_energy(ratio: f64) -> bool {
    ratio > 1.0 + ROUNDING
}

impl Limit {
    /// The largest stable step, in words.
    pub fn words(&self) -> String {
        match self.largest_stable_step_s {
            Some(step) => quantity(step, "s"),
            None if self.stable == EVERY => "any".into(),
            None => "none".into(),
        }
    }
}

impl Stability {
    /// Measures a `way`.
    ///
    /// # Errors
    /// [`ImportError`] if the FMU rejects a call.
    pub fn measure(&mut self, runs: &Runs, contact: &mut Contact, way: &CouplingMethod) -> Result<(), ImportError> {
        runs.progress.say(&format!("stability: {}", way.name));
        let own = (0..=POINTS).map(|point| energy(runs, contact, way, point));
        let own = own.collect::<Result<Vec<Energy>, _>>()?;
        let (stable, limit) = limit(runs, contact, way)?;
        self.limits.push(Limit {
            way: way.name,
            stable,
            limit,
            elastic_theory: Some(way.stable).filter(|limit| limit.is_finite()),
            largest_stable_step_s: limit.map(|limit| limit / runs.frequency()),
            gains_from: own.iter().find(|energy| makes_energy(energy.highest)).map(|energy| energy.relative),
        });
        self.energies.extend(own);
        Ok(())
    }

    /// The steps from which rebounds gain a relevant energy.
    pub fn sentence(&self) -> Option<String> {
        let first = |limit: &Limit| {
            let gains = |energy: &&Energy| energy.way == limit.way && energy.highest > MATTERS;
            let first = self.energies.iter().find(gains)?;
            Some(format!("{} from {}", limit.way, quantity(first.step_s, "s")))
        };
        let gains: Vec<_> = self.limits.iter().filter_map(first).collect();
        let percent = 100.0 * (MATTERS - 1.0);
        (!gains.is_empty()).then(|| {
            format!("Rebounds can gain more than {percent:.0} % of energy at large steps: {}.", gains.join(", "))
        })
    }

    /// Rebound energies over steps: of each step the highest of the phases.
    pub fn figure(&self) -> Figure {
        let line = |limit: &Limit| {
            let own = self.energies.iter().filter(|energy| energy.way == limit.way);
            Series::line(limit.way, own.map(|energy| (energy.relative, energy.highest)))
        };
        let lines = self.limits.iter().map(line).collect();
        let picture = Picture::new(("h sqrt(K/m)", "rebound over incoming energy"), (true, true), lines);
        // a rebound above the mark has gained energy
        let view = View { mark: Some(1.0), ..View::default() };
        Figure::new("stability", "Rebound energy over the incoming energy, for each step", &picture, &view)
    }
}
