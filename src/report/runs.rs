//! What every section of a report starts from: the impact of its runs, a figure, the progress, and what may go wrong.

use crate::files::FileError;
use crate::importer::ImportError;
use crate::master::Contact;
use crate::messages::tell;
use crate::package::ExportError;
use brinell_contact::impact::{Impact, Prediction};
use brinell_exporter::master::{CouplingMethod, Rebound};
use brinell_exporter::plot::{Picture, View};
use serde::Serialize;
use std::time::Instant;

/// An error of making a report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("the unit of the report: {0}")]
    Export(#[from] ExportError),
    #[error("the unit of the report: {0}")]
    Import(#[from] ImportError),
    #[error("{0}")]
    File(#[from] FileError),
}

/// The impact of the runs, and how it is run.
pub struct Runs<'a> {
    pub impact: Impact,
    pub prediction: Prediction,
    /// The largest stiffness of the impact: that of the unloading at the largest indentation [N/m].
    pub stiffness: f64,
    /// Largest number of steps per contact.
    pub most: u32,
    /// Number of phases: places within a step where the bodies touch.
    pub phases: u32,
    /// Whether the force follows the rate.
    pub follows_rate: bool,
    pub progress: &'a Progress,
}

impl Runs<'_> {
    /// `sqrt(K/m)` for the largest stiffness `K` [1/s].
    pub fn frequency(&self) -> f64 {
        (self.stiffness / self.impact.mass).sqrt()
    }

    /// The rebound with steps of `step` \[s\]. Steps that are much too long may throw a body so deep that the FMU refuses to go on: it
    /// then has no speed, as if the impact did not end.
    pub fn rebound(&self, way: &CouplingMethod, contact: &mut Contact, step: f64) -> Result<Rebound, ImportError> {
        let refused = |error: ImportError| {
            let none = Rebound { speed: f64::NAN, max_force: f64::NAN };
            if error.is_refused_step() { Ok(none) } else { Err(error) }
        };
        way.impact(contact, self.impact.mass, self.impact.speed, step).or_else(refused)
    }
}

/// A picture of the page; each section has some.
#[derive(Serialize)]
pub struct Figure {
    /// Name of its file.
    pub name: &'static str,
    pub caption: String,
    pub svg: String,
    /// Whether it is initially hidden.
    pub folded: bool,
}

impl Figure {
    pub fn new(name: &'static str, caption: &str, picture: &Picture, view: &View) -> Figure {
        Figure { name, caption: caption.into(), svg: picture.seen(560, 350, view), folded: false }
    }
}

/// What the report does, line by line, with the time since it began.
pub struct Progress {
    began: Instant,
}

impl Progress {
    pub fn new() -> Progress {
        Progress { began: Instant::now() }
    }

    /// Shows the current activity.
    pub fn say(&self, what: &str) {
        tell(&format!("{:5.1} s  {what} ...", self.began.elapsed().as_secs_f64()));
    }
}
