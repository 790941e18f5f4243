//! Stability: the energy gain of rebounds with large steps, and the largest step that keeps a pressed body at rest.

mod limit;
mod map;
mod words;

use super::contact::Contact;
use super::data::{Table, number, text};
use super::progress::{Progress, Work};
use super::units::Contacts;
use super::ways::{Way, gaps};
use super::{Figure, Part};
use crate::importer::ImportError;
use crate::numbers::quantity;
use crate::plot::{Picture, Series, View};
use brinell_contact::impact::{Impact, Prediction};
use limit::Limit;

/// The results; steps are `h sqrt(K/m)`.
pub struct Stability {
    /// Largest stiffness of the impact: that of the unloading at the largest indentation [N/m].
    stiffness: f64,
    /// `sqrt(K/m)` [1/s].
    frequency: f64,
    /// Predicted rebound energy over the incoming energy.
    predicted: f64,
    lines: Vec<Line>,
}

/// One way for all steps.
struct Line {
    way: &'static Way,
    energies: Vec<Energy>,
    limit: Limit,
}

/// Rebound energies over the incoming energy for one step: the lowest and the highest of the phases.
struct Energy {
    relative: f64,
    lowest: f64,
    highest: f64,
}

/// The impact of the runs.
struct Setting<'a> {
    impact: &'a Impact,
    prediction: &'a Prediction,
    /// As in [`Stability`] [1/s].
    frequency: f64,
    /// Number of phases: places within a step where the bodies touch.
    phases: u32,
}

/// Smallest and largest step.
const RANGE: (f64, f64) = (0.02, 8.0);

/// Number of steps in the map.
const POINTS: u32 = 40;

/// Tolerance for the rounding of a lossless rebound.
const ROUNDING: f64 = 1e-9;

/// A relevant gain of rebound energy. The best ways gain a little at some phases, and lose it at others.
const MATTERS: f64 = 1.01;

/// Measures all ways with the impact of the scene; `stiffness` as for [`Stability`].
pub fn measure(
    contacts: &mut Contacts,
    (impact, prediction): (&Impact, &Prediction),
    stiffness: f64,
    phases: u32,
    progress: &Progress,
) -> Result<Stability, ImportError> {
    let frequency = (stiffness / impact.mass).sqrt();
    let setting = Setting { impact, prediction, frequency, phases };
    let mut lines = Vec::new();
    for way in contacts.ways() {
        progress.say(&format!("stability: {}", way.name));
        let contact = contacts.of(way);
        let energies = energies(contact, way, &setting)?;
        lines.push(Line { way, energies, limit: limit::find(contact, way, &setting)? });
        progress.done(Work::Way);
    }
    Ok(Stability { stiffness, frequency, predicted: prediction.rebound_energy / prediction.energy, lines })
}

/// Rebound energies of `way` for all steps.
fn energies(contact: &mut Contact, way: &Way, setting: &Setting) -> Result<Vec<Energy>, ImportError> {
    let Setting { impact, frequency, phases, .. } = *setting;
    let energy = |point| {
        let relative = RANGE.0 * (RANGE.1 / RANGE.0).powf(f64::from(point) / f64::from(POINTS));
        let step = relative / frequency;
        let mut energy = Energy { relative, lowest: f64::INFINITY, highest: 0.0 };
        for gap in gaps(impact.speed, step, phases) {
            contact.start(&[("initial_gap", gap)])?;
            let rebound = way.impact(contact, impact.mass, impact.speed, step)?;
            let ratio = (rebound.speed / impact.speed).powi(2);
            energy.lowest = f64::min(energy.lowest, ratio);
            // an impact that never ends counts as infinite energy
            energy.highest = if ratio.is_nan() { f64::INFINITY } else { f64::max(energy.highest, ratio) };
        }
        Ok(energy)
    };
    (0..=POINTS).map(energy).collect()
}

/// Whether a rebound has gained energy.
fn makes_energy(ratio: f64) -> bool {
    ratio > 1.0 + ROUNDING
}

impl Energy {
    /// The one that gains energy, otherwise the one farther from `predicted`.
    fn worst(&self, predicted: f64) -> f64 {
        let below = predicted - self.lowest > self.highest - predicted;
        if below && !makes_energy(self.highest) { self.lowest } else { self.highest }
    }

    fn verdict(&self) -> &'static str {
        if makes_energy(self.highest) { "gains energy" } else { "gains none" }
    }
}

impl Line {
    /// The smallest step with an energy gain.
    fn makes_energy_from(&self) -> Option<f64> {
        self.energies.iter().find(|energy| makes_energy(energy.highest)).map(|energy| energy.relative)
    }
}

impl Stability {
    /// Rebound energies.
    fn table(&self) -> Table {
        let columns = [
            ("way", ""),
            ("h sqrt(K/m)", ""),
            ("step", "s"),
            ("lowest rebound over incoming energy", ""),
            ("highest rebound over incoming energy", ""),
            ("verdict", ""),
        ];
        let mut table = Table::new("stability", columns);
        for line in &self.lines {
            table.rows.extend(line.energies.iter().map(|energy| {
                let step = number(energy.relative / self.frequency);
                let (lowest, highest) = (number(energy.lowest), number(energy.highest));
                vec![text(line.way.name), number(energy.relative), step, lowest, highest, text(energy.verdict())]
            }));
        }
        table
    }

    /// The largest stable steps.
    fn limits(&self) -> Table {
        let columns = [
            ("way", ""),
            ("stable", ""),
            ("largest stable h sqrt(K/m)", ""),
            ("elastic theory", ""),
            ("largest stable step", "s"),
            ("gains energy from h sqrt(K/m)", ""),
        ];
        let mut table = Table::new("limits", columns);
        for line in &self.lines {
            let limit = if let Limit::Upto(limit) = line.limit { limit } else { f64::NAN };
            table.rows.push(vec![
                text(line.way.name),
                text(line.limit.words()),
                number(limit),
                if line.way.stable < f64::INFINITY { number(line.way.stable) } else { text("every step") },
                number(limit / self.frequency),
                number(line.makes_energy_from().unwrap_or(f64::NAN)),
            ]);
        }
        table
    }

    /// Rebound energies over steps.
    fn curves(&self) -> Picture {
        let line = |line: &Line| Series {
            label: line.way.name.into(),
            points: line.energies.iter().map(|energy| (energy.relative, energy.worst(self.predicted))).collect(),
            dots: false,
        };
        let series = self.lines.iter().map(line).collect();
        let y_title = "rebound over incoming energy".into();
        Picture { x_title: "h sqrt(K/m)".into(), y_title, logarithmic: (true, true), series }
    }

    /// The section on stability.
    pub fn part(&self) -> Part {
        let map = Figure {
            name: "stability",
            caption: "Rebound energy over the incoming energy, for each step".into(),
            svg: map::of(self).svg(),
            folded: false,
        };
        let curves = Figure {
            name: "stability-curves",
            caption: "The same as curves".into(),
            svg: self.curves().labelled(
                480,
                350,
                &View { marks: vec![(1.0, "above: gains energy")], ..View::default() },
            ),
            folded: false,
        };
        Part {
            title: "Stability",
            words: format!(
                "h is the step, m the mass, and K = {} the largest stiffness of the impact. Red cells with a cross: the rebound \
                 has more energy than the impact. Bars: the largest step at which a body at rest in the contact stays at rest.",
                quantity(self.stiffness, "N/m")
            ),
            figures: vec![map, curves],
            switches: Vec::new(),
            method: "K is the stiffness at the beginning of unloading from the largest indentation. Of the places within a step \
                     where the bodies meet, the map shows the worst: the one that gains energy, or else the one that is farthest \
                     from the prediction. The largest stable step is the one at which a small motion about the deepest \
                     indentation under a constant load doesn't grow. Elastic theory is that of a linear spring without damping."
                .into(),
            tables: vec![self.limits(), self.table()],
        }
    }
}
