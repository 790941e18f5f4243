//! `brinell report`: what step and what coupling a scene needs, measured by stepping its exported unit through the C interface.

mod data;
mod extremes;
mod page;
mod peer;
mod precision;
mod spread;
mod stability;
mod summary;
mod unit;
mod ways;

use crate::importer::{Archive, ImportError};
use crate::package::{self, ExportError, write_whole};
use crate::plot::Picture;
use crate::scene::Scene;
use data::Table;
use peer::Peer;
use precision::{Line, Plan};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;
use unit::Contact;
use ways::WAYS;

/// A report that couldn't be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("the unit of the report: {0}")]
    Export(#[from] ExportError),
    #[error("the unit of the report: {0}")]
    Import(#[from] ImportError),
    #[error("the other unit {}: {reason}", path.display())]
    Peer { path: PathBuf, reason: String },
    #[error("{}: {source}", path.display())]
    Folder { path: PathBuf, source: std::io::Error },
}

/// All that was measured.
pub struct Report {
    /// The name of the scene.
    pub name: String,
    /// What to do, and what to expect, in sentences.
    pub summary: Vec<String>,
    recommendations: Value,
    parts: Vec<Part>,
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
        let began = Instant::now();
        let say = |what: &str| eprintln!("{:5.1} s  {what} ...", began.elapsed().as_secs_f64());
        let folder = tempfile::Builder::new().prefix("brinell-report-").tempdir();
        let folder = folder.map_err(|source| ReportError::Folder { path: std::env::temp_dir(), source })?;
        let open = |scene: &Scene, file: &str| -> Result<Archive, ReportError> {
            let path = folder.path().join(file);
            package::export(scene, &path)?;
            Ok(Archive::open(&path)?)
        };
        let plain_scene = unit::first_contact(scene, None);
        let model = plain_scene.any_model();
        let impact = plain_scene.impact;
        let prediction = model.predict(&impact).expect("a checked scene has a prediction");
        say("building the unit");
        let plain = open(&plain_scene, "plain.fmu")?;
        let plain_unit = plain.load()?;
        // a rate-dependent law can't know the mass
        let follows_rate = scene.damped.is_some();
        let knowing = match follows_rate {
            true => None,
            false => {
                say("building the unit that knows the mass");
                Some(open(&unit::first_contact(scene, Some(impact.mass)), "knowing.fmu")?)
            }
        };
        let knowing_unit = knowing.as_ref().map(Archive::load).transpose()?;
        let mut contact = Contact::new(&plain, &plain_unit, &[])?;
        let mut knowing_contact = match (&knowing, &knowing_unit) {
            (Some(archive), Some(unit)) => Some(Contact::new(archive, unit, &[])?),
            _ => None,
        };
        let (most, phases) = if quick { (256, 8) } else { (4096, 16) };
        let plan = Plan { impact: &impact, prediction: &prediction, most, phases, follows_rate };
        let mut lines = Vec::new();
        for way in WAYS.iter().filter(|way| way.by_rate || !follows_rate) {
            let contact = if way.knows_mass { knowing_contact.as_mut() } else { Some(&mut contact) };
            let Some(contact) = contact else { continue };
            say(&format!("error against run time: {}", way.name));
            lines.push(plan.measure(contact, way)?);
        }
        if !follows_rate {
            say("error against run time: the unit alone");
            lines.push(plan.alone(&mut contact)?);
        }
        for peer in &peers {
            let mut contact = peer.contact(&plain_scene)?;
            for way in peer.ways() {
                say(&format!("error against run time: {}, {}", peer.name, way.name));
                let line = plan.measure(&mut contact, way).map_err(|error| peer.fault(&error))?;
                lines.push(Line { peer: Some(peer.name.clone()), ..line });
            }
        }
        say("stability");
        let stiffness = model.stiffness(prediction.max_indentation);
        let knowing = knowing_contact.as_mut();
        let stability =
            stability::measure(&mut contact, knowing, (&impact, &prediction), stiffness, phases, follows_rate)?;
        say("stiff and extreme cases");
        let cases = extremes::measure(&mut contact, &plain_scene, quick);
        say("laws side by side");
        let (laws, spread) = spread::part(&plain_scene);
        say("done");
        let failed = cases.iter().filter(|case| case.failure.is_some()).count();
        let (mut summary, recommendations) = summary::summarize(&lines, &stability, &prediction, (cases.len(), failed));
        summary.extend(spread);
        if scene.contact_count() > 1 {
            summary.push("The scene has several contacts: all this is of its first contact.".into());
        }
        let parts = vec![precision::part(&scene.name, &lines), stability.part(), extremes::part(&cases), laws];
        Ok(Report { name: scene.name.clone(), summary, recommendations, parts, all_right: failed == 0 })
    }

    /// Whether no case has failed.
    pub fn passed(&self) -> bool {
        self.all_right
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
        std::fs::create_dir_all(folder).map_err(|source| ReportError::Folder { path: folder.into(), source })?;
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

/// The pictures, drawn, by the names of their files.
fn drawn<const COUNT: usize>(names: [&'static str; COUNT], pictures: [Picture; COUNT]) -> Vec<(&'static str, String)> {
    names.into_iter().zip(pictures.map(|picture| picture.svg(520, 360))).collect()
}
