//! `brinell report`: the step and the coupling for a scene, measured by stepping its FMU through the C interface. All
//! findings are one [`Report`], which is written as JSON and fills one template, `report.html`.

pub mod card;
mod choice;
mod extremes;
mod precision;
mod runs;
mod stability;
mod units;

use crate::files::{self, FileError, write_whole};
use crate::master::Contact;
use crate::scene_file;
use brinell_contact::validity::LARGEST_RADIUS_RATIO;
use brinell_exporter::accuracy::accuracy;
use brinell_exporter::html::prose;
use brinell_exporter::layout::{json_line, paragraph, shown};
use brinell_exporter::master::{COUPLING_METHODS, Requirements};
use brinell_exporter::model::AnyModel;
use brinell_exporter::numbers::{quantity, significant};
use brinell_exporter::predict::{beyond, spread};
use brinell_exporter::scene::Scene;
use brinell_exporter::validity;
use card::Fact;
use minijinja::value::{Serde, Value};
use minijinja::{Environment, context};
use runs::{Figure, Progress, ReportError, Runs};
use serde::Serialize;
use serde_json::json;
use stability::Stability;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};

/// The arguments of `brinell report`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// The scene file
    pub scene: PathBuf,
    /// The folder for the page and its data [default: NAME_report in the current folder]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Use fewer steps and shorter runs
    #[arg(long)]
    pub quick: bool,
}

/// The command: measures the FMU of the scene, and writes the page. Returns whether all cases passed.
///
/// # Errors
/// [`ReportError`], or an error of the scene or of the arguments.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<bool, Box<dyn Error>> {
    let Arguments { scene, output, quick } = arguments;
    let scene = scene_file::read_aloud(scene)?;
    let folder = output.clone().unwrap_or_else(|| format!("{}_report", scene.name).into());
    files::check_folder(&folder)?;
    let (report, figures) = Report::of(&scene, *quick)?;
    let page = report.write_into(&folder, &figures)?;
    if as_json {
        print!("{}", json_line(&report));
    } else {
        report.lines().iter().for_each(|line| print!("{}", paragraph("", line)));
        println!("{}", shown(&page));
    }
    Ok(!report.extremes.iter().any(|case| case.outcome == extremes::Outcome::Failed))
}

/// All findings. Numbers have SI units; one that doesn't exist is null.
#[derive(Serialize)]
struct Report {
    scene: String,
    version: &'static str,
    summary: Summary,
    /// What a program needs to choose a coupling: the ways, and numbers of the impact.
    r#use: serde_json::Value,
    precision: Vec<precision::Point>,
    orders: Vec<precision::Order>,
    #[serde(rename = "largest_stiffness_N_per_m")]
    stiffness: f64,
    #[serde(flatten)]
    stability: Stability,
    extremes: Vec<extremes::Case>,
}

/// The findings in words.
#[derive(Serialize)]
struct Summary {
    bodies: Vec<Fact>,
    outcome: Vec<Fact>,
    /// The reliability of the law, and the exceeded limits of its validity.
    law: Vec<String>,
    warnings: Vec<String>,
    /// The recommended coupling.
    coupling: Vec<String>,
    extremes: String,
}

/// The figures of the page by its sections.
type Figures = BTreeMap<&'static str, Vec<Figure>>;

impl Report {
    /// Measures the first contact of `scene`.
    ///
    /// # Errors
    /// [`ReportError`] if an FMU can't be built or loaded, or rejects an ordinary impact.
    fn of(scene: &Scene, quick: bool) -> Result<(Report, Figures), ReportError> {
        let alone = units::first_contact(scene, Requirements::Force);
        let (model, impact, prediction) = (alone.any_model(), alone.impact, alone.predictions[0]);
        let (most, phases) = if quick { (256, 8) } else { (4096, 16) };
        let progress = &Progress::new();
        let follows_rate = scene.is_rate_dependent();
        let stiffness = model.stiffness(prediction.max_indentation);
        let runs = Runs { impact, prediction, stiffness, most, phases, follows_rate, progress };
        let units = units::build(scene, progress)?;
        let mut contacts = BTreeMap::new();
        for (needs, (unit, archive)) in &units {
            contacts.insert(*needs, Contact::new(archive, unit, "", &[])?);
        }
        let (mut lines, mut stability) = (Vec::new(), Stability::default());
        for way in &COUPLING_METHODS {
            if let Some(contact) = contacts.get_mut(&way.needs) {
                lines.push(precision::measure(&runs, contact, way)?);
                stability.measure(&runs, contact, way)?;
            }
        }
        let plain = contacts.get_mut(&Requirements::Force).expect("every report has the FMU with its force alone");
        let extremes = extremes::measure(plain, &alone, quick, progress);
        let figures = BTreeMap::from([
            ("card", card::figures(&alone)),
            ("precision", precision::figures(&lines)),
            ("stability", vec![stability.figure()]),
        ]);
        let ways = choice::of(&lines, &stability.limits);
        let ratio = prediction.max_contact_radius / model.pair().radius;
        let mut law = Vec::new();
        if matches!(model, AnyModel::Elastoplastic(_)) {
            let relation = if ratio > LARGEST_RADIUS_RATIO { "above" } else { "within" };
            law.push(format!(
                "Contact radius over effective radius: {}, {relation} the limit of {LARGEST_RADIUS_RATIO}.",
                significant(ratio, 2)
            ));
        }
        law.extend(accuracy(&alone, &prediction));
        law.extend(card::readings(&alone));
        law.extend(spread::note(&alone, None));
        let warnings = beyond(&alone, &model.pair(), impact.speed, &prediction).into_iter().map(validity::words);
        let mut coupling = choice::sentences(&ways);
        coupling.extend(stability.sentence());
        coupling.extend((scene.contact_count() > 1).then(|| NOT_FOR_SEVERAL.to_string()));
        let impact = json!({
            "largest_force_N": prediction.max_force,
            "largest_indentation_m": prediction.max_indentation,
            "dent_m": prediction.residual_indentation,
            "restitution": prediction.restitution,
            "contact_time_s": prediction.contact_time(),
            "contact_radius_over_effective_radius": ratio,
        });
        let report = Report {
            scene: scene.name.clone(),
            version: env!("CARGO_PKG_VERSION"),
            summary: Summary {
                bodies: card::facts(&alone),
                outcome: card::outcome(&alone, &prediction),
                law,
                warnings: warnings.map(|words| format!("Outside the law's validity: {words}.")).collect(),
                coupling,
                extremes: extremes::words(&extremes),
            },
            r#use: json!({ "ways": ways, "impact": impact }),
            orders: lines.iter().map(precision::Line::order).collect(),
            precision: lines.into_iter().flat_map(|line| line.points).collect(),
            stiffness,
            stability,
            extremes,
        };
        Ok((report, figures))
    }

    /// The outcome and the recommendation, for a terminal.
    fn lines(&self) -> Vec<String> {
        let Summary { outcome, law, warnings, coupling, extremes, .. } = &self.summary;
        let outcome = outcome.iter().map(|(name, value)| format!("{name:<26} {value}"));
        let sentences = law.iter().chain(coupling).chain(warnings).chain([extremes]).cloned();
        outcome.chain([String::new()]).chain(sentences).collect()
    }

    /// Writes the page, its data and its figures to `folder`; returns the path of the page.
    ///
    /// # Errors
    /// [`ReportError`] if the folder can't be written to.
    fn write_into(&self, folder: &Path, figures: &Figures) -> Result<PathBuf, ReportError> {
        std::fs::create_dir_all(folder).map_err(FileError::at(folder))?;
        for Figure { name, svg, .. } in figures.values().flatten() {
            write_whole(&folder.join(name).with_extension("svg"), svg.as_bytes())?;
        }
        let data = serde_json::to_string_pretty(self).expect("its keys are strings");
        write_whole(&folder.join("report.json"), format!("{data}\n").as_bytes())?;
        let path = folder.join("index.html");
        write_whole(&path, self.html(figures).as_bytes())?;
        Ok(path)
    }

    /// The page.
    fn html(&self, figures: &Figures) -> String {
        let mut environment = Environment::new();
        let print = |text: &str| Value::from_safe_string(prose(text));
        environment.add_filter("cell", cell);
        environment.add_filter("print", print);
        environment.add_filter("seconds", move |value: f64| print(&quantity(value, "s")));
        environment.add_filter("stiffness", move |value: f64| print(&quantity(value, "N/m")));
        environment.add_filter("whole", |value: f64| format!("{value:.0}"));
        let template = environment.template_from_named_str("report.html", include_str!("report.html"));
        let context = context! { report => Serde(self), figures => Serde(figures) };
        let filled = template.and_then(|template| template.render(context));
        let filled = filled.expect("the template is part of the program, and every test of a report fills it");
        // the template engine leaves out the last newline
        format!("{filled}\n")
    }
}

/// A cell of a table: four digits, with a prefix where there is a unit, and a dash for what doesn't exist.
fn cell(value: &Value, unit: Option<&str>) -> Value {
    let cell = match (value.as_str(), f64::try_from(value.clone())) {
        (Some(words), _) => format!("<td class=\"words\">{}</td>", prose(words)),
        (None, Ok(number)) if number.is_finite() => {
            let unit = UNITS.into_iter().find(|known| Some(*known) == unit).unwrap_or("");
            format!("<td>{}</td>", prose(&quantity(number, unit)))
        }
        _ => "<td>-</td>".into(),
    };
    Value::from_safe_string(cell)
}

/// The units of tables.
const UNITS: [&str; 3] = ["m", "s", "N"];

/// Limitations for a scene with several contacts.
const NOT_FOR_SEVERAL: &str = "The scene has several contacts: this page measures the first contact, by itself. If contacts share a \
     body, an FMU that knows one mass of each is wrong while two of them are closed; one of a scene with tables [[body]] moves all of \
     them.";
