//! `brinell report`: what step and what coupling a scene needs, measured by stepping its exported unit through the C interface.

mod data;
mod extremes;
mod page;
mod precision;
mod spread;
mod stability;
mod unit;
mod ways;

use crate::documentation::digits;
use crate::importer::{Archive, ImportError};
use crate::package::{self, ExportError, write_whole};
use crate::plot::Picture;
use crate::scene::Scene;
use brinell::contact::impact::Prediction;
use data::Table;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;
use unit::Contact;
use ways::WAYS;

/// The error of restitution that a step is recommended for.
const GOAL: f64 = 0.01;

/// A report that couldn't be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error("the unit of the report: {0}")]
    Export(#[from] ExportError),
    #[error("the unit of the report: {0}")]
    Import(#[from] ImportError),
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
    /// Measures the first contact of `scene`.
    ///
    /// # Errors
    /// [`ReportError`] if the unit can't be built or loaded, or refuses an ordinary impact.
    pub fn of(scene: &Scene, quick: bool) -> Result<Report, ReportError> {
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
        let mut contact = Contact::new(&plain, &plain_unit)?;
        let mut knowing_contact = match (&knowing, &knowing_unit) {
            (Some(archive), Some(unit)) => Some(Contact::new(archive, unit)?),
            _ => None,
        };
        let (most, phases) = if quick { (256, 8) } else { (4096, 16) };
        let mut lines = Vec::new();
        for way in WAYS.iter().filter(|way| way.by_rate || !follows_rate) {
            let contact = if way.knows_mass { knowing_contact.as_mut() } else { Some(&mut contact) };
            let Some(contact) = contact else { continue };
            say(&format!("error against run time: {}", way.name));
            lines.push(precision::measure(contact, way, (&impact, &prediction), most, phases, follows_rate)?);
        }
        say("stability");
        let stiffness = model.stiffness(prediction.max_indentation);
        let stability = stability::measure(&mut contact, &impact, &prediction, stiffness, phases)?;
        say("stiff and extreme cases");
        let cases = extremes::measure(&mut contact, &plain_scene, quick);
        say("laws side by side");
        let laws = spread::part(&plain_scene);
        say("done");
        let failed = cases.iter().filter(|case| case.failure.is_some()).count();
        let (mut summary, recommendations) = summarize(&lines, &stability, &prediction, (cases.len(), failed));
        if scene.contact_count() > 1 {
            summary.push("The scene has several contacts: all this is of its first contact.".into());
        }
        let parts = vec![precision_part(&lines), stability_part(&stability), extremes_part(&cases), laws];
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

/// What to do: for every way the step that keeps the error below the goal, the fewest calls first.
fn summarize(
    lines: &[precision::Line],
    stability: &stability::Stability,
    prediction: &Prediction,
    (cases, failed): (usize, usize),
) -> (Vec<String>, Value) {
    let mut good: Vec<_> = lines.iter().filter_map(|line| Some((line.way, line.step_for(GOAL)?))).collect();
    good.sort_by(|one, other| one.1.calls.total_cmp(&other.1.calls));
    let mut summary: Vec<String> = good
        .iter()
        .enumerate()
        .map(|(place, (way, point))| {
            let verb = if place == 0 { "Use" } else { "Or" };
            format!(
                "{verb} {way} with steps of {} s ({} per contact): expect an error of restitution of {} % with {:.0} calls \
                 per impact.",
                digits(point.step),
                point.steps,
                two_digits(100.0 * point.restitution),
                point.calls
            )
        })
        .collect();
    for line in lines.iter().filter(|line| line.step_for(GOAL).is_none()) {
        summary.push(format!("With {}, no step that was tried keeps the error of restitution below 1 %.", line.way));
    }
    let step = |limit: f64| digits(limit / stability.frequency);
    summary.push(match stability.leap_frog {
        Some(limit) => format!(
            "Leap-frog is stable up to a step of {} s (h sqrt(K/m) = {limit:.3}; elastic theory: 2); for bigger steps choose a \
             larger mass or a softer contact{}.",
            step(limit),
            // which a rate-dependent law can't have
            if lines.iter().any(|line| line.way == ways::MASS_KNOWN.name) { ", or a unit that knows the mass" } else { "" }
        ),
        None => "Leap-frog is stable at no step that was tried: a pressed body never comes to rest.".into(),
    });
    summary.push(match stability.late {
        Some(limit) => format!("A force one step late is stable up to a step of {} s.", step(limit)),
        None => "A force one step late makes energy at every step that was tried: a pressed body never comes to rest."
            .into(),
    });
    summary.push(format!("{} of {cases} stiff and extreme cases are right.", cases - failed));
    let ways: Vec<_> = good
        .iter()
        .map(|(way, point)| {
            json!({ "way": way, "step_s": point.step, "steps_per_contact": point.steps,
                    "error_of_restitution": point.restitution, "calls_per_impact": point.calls })
        })
        .collect();
    let used = json!({
        "goal": GOAL,
        "ways": ways,
        "restitution": prediction.restitution,
        "contact_time_s": prediction.contact_time(),
        "largest_stiffness_N_per_m": stability.stiffness,
        "stable_leap_frog": stability.leap_frog,
        "stable_late": stability.late,
    });
    (summary, used)
}

/// Two significant digits.
fn two_digits(value: f64) -> String {
    digits(format!("{value:.1e}").parse().expect("a number"))
}

/// The pictures, drawn, by the names of their files.
fn drawn<const COUNT: usize>(names: [&'static str; COUNT], pictures: [Picture; COUNT]) -> Vec<(&'static str, String)> {
    names.into_iter().zip(pictures.map(|picture| picture.svg(520, 360))).collect()
}

fn precision_part(lines: &[precision::Line]) -> Part {
    Part {
        title: "Error against run time",
        words: "Errors are relative to the energy balance, root mean squares over the places within a step where the bodies \
                meet. The largest force is that at the ends of steps, and the time per impact that of this machine. Late \
                force: all units step at once; leap-frog: the contact first; input derivatives: with mean_force."
            .into(),
        pictures: drawn(["error-against-time", "error-against-calls", "force-against-steps"], precision::pictures(lines)),
        tables: vec![precision::orders(lines), precision::table(lines)],
    }
}

fn stability_part(stability: &stability::Stability) -> Part {
    Part {
        title: "Stability",
        words: format!(
            "h is the step, m the mass, and K = {} N/m the largest stiffness of the impact, on the way back from the largest \
             indentation. The largest stable step is that at which a small motion about the deepest indentation, under a \
             constant load, doesn't grow. The rebound energy is the largest over the places within a step where the bodies \
             meet: above 1 it is made by the coupling.",
            digits(stability.stiffness)
        ),
        pictures: drawn(["stability"], [stability.picture()]),
        tables: vec![stability.limits(), stability.table()],
    }
}

fn extremes_part(cases: &[extremes::Case]) -> Part {
    Part {
        title: "Stiff and extreme cases",
        words: format!(
            "Each is stepped through the unit. Impacts by leap-frog must agree with the energy balance to {}; their mass grows \
             as the volume of the sphere, and with E the yield strength. Prescribed motions, in and out again, must dissipate \
             what the law says to {:e} of the work, and leave no force.",
            extremes::TOLERANCE,
            extremes::EXACT
        ),
        pictures: Vec::new(),
        tables: vec![extremes::table(cases)],
    }
}
