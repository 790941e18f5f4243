//! `brinell report`: the step and the coupling for a scene, measured by stepping its FMU through the C interface.

mod card;
mod choice;
mod contact;
mod data;
mod extremes;
mod oblique;
mod page;
mod peer;
mod precision;
mod progress;
mod spread;
mod stability;
mod unit;
mod units;
mod ways;

use crate::files::{self, FileError, write_whole};
use crate::importer::ImportError;
use crate::layout::{json_line, paragraph, shown};
use crate::package::ExportError;
use crate::scene::Scene;
use card::Card;
use choice::Choice;
use data::Table;
use oblique::Oblique;
use peer::Peer;
use precision::Plan;
use progress::{Progress, Work};
use serde_json::{Value, json};
use spread::Laws;
use std::error::Error;
use std::path::{Path, PathBuf};
use units::Units;
use ways::Needs;

/// An error of making a report.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("the unit of the report: {0}")]
    Export(#[from] ExportError),
    #[error("the unit of the report: {0}")]
    Import(#[from] ImportError),
    #[error("the other unit {}: {reason}", shown(path))]
    Peer { path: PathBuf, reason: String },
    #[error("{0}")]
    File(#[from] FileError),
}

/// The arguments of `brinell report`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// The scene file
    pub scene: PathBuf,
    /// The folder for the page and its data [default: NAME_report in the current folder]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Another FMU with the same variables, for the same pictures; can be repeated
    #[arg(long, value_name = "FMU")]
    pub peer: Vec<PathBuf>,
    /// Use fewer steps and shorter runs
    #[arg(long)]
    pub quick: bool,
}

/// The command: measures the FMU of the scene and the other ones, and writes the page. Returns whether all cases passed.
///
/// # Errors
/// [`ReportError`], or an error of the scene or of the arguments.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<bool, Box<dyn Error>> {
    let Arguments { scene, output, peer, quick } = arguments;
    let scene = Scene::read_aloud(scene)?;
    let folder = output.clone().unwrap_or_else(|| format!("{}_report", scene.name).into());
    files::check_folder(&folder)?;
    let report = Report::of(&scene, peer, *quick)?;
    let page = report.write_into(&folder)?;
    if as_json {
        print!("{}", json_line(&report.json()));
    } else {
        report.lines().iter().for_each(|line| print!("{}", paragraph("", line)));
        println!("{}", shown(&page));
    }
    Ok(report.all_right)
}

/// All measurements.
pub struct Report {
    /// The name of the scene.
    pub name: String,
    pub card: Card,
    /// The recommended coupling, in sentences.
    pub advice: Vec<String>,
    /// The recommended coupling, as a table.
    pub choice: String,
    recommendations: Value,
    parts: Vec<Part>,
    /// Whether all cases passed.
    all_right: bool,
}

/// A section with a heading.
pub struct Part {
    pub title: &'static str,
    /// Its findings.
    pub words: String,
    pub figures: Vec<Figure>,
    /// Series of the figures that can be switched on, with their strokes for CSS.
    pub switches: Vec<(String, String)>,
    /// The method of measurement.
    pub method: String,
    pub tables: Vec<Table>,
}

/// A picture.
pub struct Figure {
    /// Name of its file.
    pub name: &'static str,
    pub caption: String,
    pub svg: String,
    /// Whether it is initially hidden.
    pub folded: bool,
}

impl Figure {
    /// The figure as HTML.
    fn html(&self) -> String {
        let Figure { name, caption, svg, .. } = self;
        format!(
            "<figure>\n{svg}<figcaption>{caption} <a class=\"csv\" href=\"{name}.svg\">{name}.svg</a></figcaption></figure>\n"
        )
    }
}

impl Report {
    /// Measures the first contact of `scene`, and the other FMUs at `peers`.
    ///
    /// # Errors
    /// [`ReportError`] if an FMU can't be built or loaded, or rejects an ordinary impact.
    fn of(scene: &Scene, peers: &[PathBuf], quick: bool) -> Result<Report, ReportError> {
        let peers = peers.iter().map(|path| Peer::open(path)).collect::<Result<Vec<_>, _>>()?;
        let alone = unit::first_contact(scene, Needs::Force);
        let (model, impact) = (alone.any_model(), alone.impact);
        let prediction = alone.predictions[0];
        let (most, phases) = if quick { (256, 8) } else { (4096, 16) };
        let progress = &Progress::new();
        let follows_rate = scene.is_rate_dependent();
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
        progress.say("oblique impacts");
        // the FMU with friction has no other mass or law
        let oblique = oblique::measure(scene, contacts.rough(), most)?;
        progress.say("laws side by side");
        let laws = Laws::of(&alone);
        let card = card::of(&alone, contacts.plain(), &laws)?;
        let choice = Choice::of(&lines, &stability);
        let mut advice = choice.sentences();
        advice.extend(stability.sentence());
        advice.extend(oblique.as_ref().and_then(Oblique::sentence));
        advice.extend(not_for_several(scene));
        let mut recommendations = json!({ "ways": choice.json(), "impact": card.json });
        if let (Value::Object(all), Value::Object(stable)) = (&mut recommendations, stability.json()) {
            all.extend(stable);
        }
        let mut parts =
            vec![precision::part(&scene.name, &lines), stability.part(), laws.part(), extremes::part(&cases)];
        parts.extend(oblique.map(|oblique| oblique.part()));
        Ok(Report {
            name: scene.name.clone(),
            card,
            advice,
            choice: choice.html(),
            recommendations,
            parts,
            all_right: !cases.iter().any(extremes::Case::has_failed),
        })
    }

    /// The outcome and the recommendation, for a terminal.
    fn lines(&self) -> Vec<String> {
        let outcome = self.card.outcome.iter().map(|(name, value)| format!("{name:<26} {value}"));
        let warnings = self.card.warnings.iter().map(|warning| format!("Outside the law's validity: {warning}."));
        let sentences = self.card.trust.iter().chain(&self.advice).cloned();
        let cases = self.parts.iter().find(|part| part.title == extremes::TITLE).map(|part| part.words.clone());
        outcome.chain([String::new()]).chain(sentences).chain(warnings).chain(cases).collect()
    }

    /// All tables as one document.
    pub fn json(&self) -> Value {
        let sentences: Vec<_> = self.card.trust.iter().chain(&self.card.warnings).chain(&self.advice).collect();
        let mut document = json!({ "scene": self.name, "summary": sentences, "use": self.recommendations });
        for table in self.parts.iter().flat_map(|part| &part.tables) {
            document[table.name] = table.json();
        }
        document
    }

    /// Writes the page and its data to `folder`; returns the path of the page.
    ///
    /// # Errors
    /// [`ReportError`] if the folder can't be written to.
    pub fn write_into(&self, folder: &Path) -> Result<PathBuf, ReportError> {
        std::fs::create_dir_all(folder).map_err(FileError::at(folder))?;
        for table in self.parts.iter().flat_map(|part| &part.tables) {
            write_whole(&folder.join(table.name).with_extension("csv"), table.csv().as_bytes())?;
        }
        for Figure { name, svg, .. } in self.card.figures.iter().chain(self.parts.iter().flat_map(|part| &part.figures))
        {
            write_whole(&folder.join(name).with_extension("svg"), svg.as_bytes())?;
        }
        write_whole(&folder.join("report.json"), format!("{:#}\n", self.json()).as_bytes())?;
        let page = folder.join("index.html");
        write_whole(&page, page::write(self).as_bytes())?;
        Ok(page)
    }
}

/// Limitations for a scene with several contacts.
fn not_for_several(scene: &Scene) -> Option<String> {
    (scene.contact_count() > 1).then(|| {
        "The scene has several contacts: this page measures the first contact. If contacts share a body, an FMU that knows the \
         mass moves each contact's bodies alone, and is exact only while one of them is closed."
            .into()
    })
}

/// The total work of a report.
fn work(scene: &Scene, plan: &Plan, peers: &[Peer], quick: bool) -> Vec<Work> {
    let (building, ways) = Units::work(scene);
    let lines = ways + usize::from(!plan.follows_rate) + peers.iter().map(|peer| peer.ways().len()).sum::<usize>();
    let mut all: Vec<Work> = building.collect();
    all.extend((0..lines).flat_map(|_| plan.work()));
    all.extend((0..ways).map(|_| Work::Way));
    all.extend((0..extremes::count(scene, quick)).map(|_| Work::Case));
    all
}
