//! `brinell report`: what step and what coupling a scene needs, measured by stepping its exported unit through the C interface.

mod data;
mod extremes;
mod page;
mod peer;
mod precision;
mod progress;
mod spread;
mod stability;
mod summary;
mod unit;
mod units;
mod ways;

use crate::files::{FileError, write_whole};
use crate::importer::ImportError;
use crate::package::ExportError;
use crate::plot::Picture;
use crate::scene::Scene;
use crate::validity;
use data::Table;
use peer::Peer;
use precision::Plan;
use progress::{Progress, Work};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use units::Units;
use ways::Needs;

/// A report that couldn't be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("the unit of the report: {0}")]
    Export(#[from] ExportError),
    #[error("the unit of the report: {0}")]
    Import(#[from] ImportError),
    #[error("the other unit {}: {reason}", path.display())]
    Peer { path: PathBuf, reason: String },
    #[error("{0}")]
    File(#[from] FileError),
}

/// The command: measures the unit of `scene` beside those at `peers` and writes the page into `folder`; whether no case has failed.
pub fn run(
    scene: &Scene,
    peers: &[PathBuf],
    folder: Option<&Path>,
    quick: bool,
    as_json: bool,
) -> Result<bool, ReportError> {
    let folder = folder.map_or_else(|| format!("{}_report", scene.name).into(), Path::to_path_buf);
    let report = Report::of(scene, peers, quick)?;
    let page = report.write_into(&folder)?;
    if as_json {
        println!("{}", report.json());
    } else {
        println!("{}\n{}", report.summary.join("\n"), page.display());
    }
    Ok(report.all_right)
}

/// All that was measured.
pub struct Report {
    /// The name of the scene.
    pub name: String,
    /// What to do, and what to expect, in sentences.
    pub summary: Vec<String>,
    recommendations: Value,
    parts: Vec<Part>,
    /// No case has failed.
    all_right: bool,
}

/// A heading with what stands below it.
pub struct Part {
    pub title: &'static str,
    pub words: String,
    /// Pictures by the names of their files.
    pub pictures: Vec<(&'static str, String)>,
    pub tables: Vec<Table>,
}

impl Report {
    /// Measures the first contact of `scene`, with the other units at `peers` beside it.
    ///
    /// # Errors
    /// [`ReportError`] if a unit can't be built or loaded, or refuses an ordinary impact.
    pub fn of(scene: &Scene, peers: &[PathBuf], quick: bool) -> Result<Report, ReportError> {
        let peers = peers.iter().map(|path| Peer::open(path)).collect::<Result<Vec<_>, _>>()?;
        let alone = unit::first_contact(scene, Needs::Force);
        let (model, impact) = (alone.any_model(), alone.impact);
        let prediction = alone.predictions[0];
        let (most, phases) = if quick { (256, 8) } else { (4096, 16) };
        let progress = &Progress::new();
        let follows_rate = scene.damped.is_some();
        let plan = Plan { impact: &impact, prediction: &prediction, most, phases, follows_rate, progress };
        progress.expect(work(&alone, &plan, &peers, quick));
        let units = Units::build(scene, progress)?;
        let mut contacts = units.contacts()?;
        let mut lines = Vec::new();
        for way in contacts.ways() {
            lines.push(plan.measure(contacts.of(way), way)?);
        }
        if !follows_rate {
            lines.push(plan.alone(contacts.plain())?);
        }
        for peer in &peers {
            lines.extend(peer.measure(&alone, &plan)?);
        }
        let stiffness = model.stiffness(prediction.max_indentation);
        let stability = stability::measure(&mut contacts, (&impact, &prediction), stiffness, phases, progress)?;
        progress.say("stiff and extreme cases");
        let cases = extremes::measure(contacts.plain(), &alone, quick, progress);
        progress.say("laws side by side");
        let (laws, spread) = spread::part(&alone);
        let failed = cases.iter().filter(|case| case.has_failed()).count();
        let judged = cases.iter().filter(|case| case.is_judged()).count();
        let (mut summary, recommendations) = summary::summarize(&lines, &stability, &prediction, (judged, failed));
        summary.extend(spread);
        let warnings = validity::warnings(&model.pair(), alone.contacts[0].density, &prediction, impact.speed);
        summary.extend(warnings.into_iter().map(|warning| format!("Beware: {warning}.")));
        if scene.contact_count() > 1 {
            summary.push("The scene has several contacts: all this is of its first contact.".into());
        }
        let parts = vec![precision::part(&scene.name, &lines), stability.part(), extremes::part(&cases), laws];
        Ok(Report { name: scene.name.clone(), summary, recommendations, parts, all_right: failed == 0 })
    }

    /// All tables as one document.
    pub fn json(&self) -> Value {
        let mut document = json!({ "scene": self.name, "summary": self.summary, "use": self.recommendations });
        for table in self.parts.iter().flat_map(|part| &part.tables) {
            document[table.name] = table.json();
        }
        document
    }

    /// Writes the page and its data into `folder`; gives the path of the page.
    ///
    /// # Errors
    /// [`ReportError`] if the folder can't be written to.
    pub fn write_into(&self, folder: &Path) -> Result<PathBuf, ReportError> {
        std::fs::create_dir_all(folder).map_err(FileError::at(folder))?;
        for table in self.parts.iter().flat_map(|part| &part.tables) {
            write_whole(&folder.join(table.name).with_extension("csv"), table.csv().as_bytes())?;
        }
        for (name, svg) in self.parts.iter().flat_map(|part| &part.pictures) {
            write_whole(&folder.join(name).with_extension("svg"), svg.as_bytes())?;
        }
        write_whole(&folder.join("report.json"), format!("{:#}\n", self.json()).as_bytes())?;
        let page = folder.join("index.html");
        write_whole(&page, page::write(self).as_bytes())?;
        Ok(page)
    }
}

/// All that a report has to do.
fn work(scene: &Scene, plan: &Plan, peers: &[Peer], quick: bool) -> Vec<Work> {
    let (building, ways) = Units::work(scene);
    let lines = ways + usize::from(!plan.follows_rate) + peers.iter().map(|peer| peer.ways().len()).sum::<usize>();
    let mut all: Vec<Work> = building.collect();
    all.extend((0..lines).flat_map(|_| plan.work()));
    all.extend((0..ways).map(|_| Work::Way));
    all.extend((0..extremes::count(scene, quick)).map(|_| Work::Case));
    all
}

/// The pictures, drawn, by the names of their files.
fn drawn<const COUNT: usize>(names: [&'static str; COUNT], pictures: [Picture; COUNT]) -> Vec<(&'static str, String)> {
    names.into_iter().zip(pictures.map(|picture| picture.svg(520, 360))).collect()
}
