//! `brinell predict`: predicts an impact, and explains a measured one.

mod inverse;
mod oblique_text;
mod question;

use self::oblique_text::ObliqueAnswer;
pub use self::question::Arguments;
use self::question::{Question, failed, impact, implausible};
use crate::files::{self, deliver, ending};
use crate::messages::WrongCall;
use crate::parallel;
use crate::scene_file;
use brinell_contact::impact::Impact;
use brinell_exporter::laws;
use brinell_exporter::layout::{json_line, shown};
use brinell_exporter::predict::answer::Answer;
use brinell_exporter::predict::axis::Axis;
use brinell_exporter::predict::oblique::{self, Setting};
use brinell_exporter::predict::sweep::{Impacts, Sweep};
use brinell_exporter::predict::time_history;
use serde_json::json;
use std::error::Error;
use std::path::Path;

/// The quantities of a sweep's table in a terminal.
const SHOWN: [&str; 5] = ["restitution", "largest force", "largest indentation", "dent", "loading time"];

/// Runs the command.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let (output, time_history) = (arguments.output.as_deref(), arguments.time_history.as_deref());
    for path in [output, time_history].into_iter().flatten() {
        ending(Some(path), &["csv"]).map_err(WrongCall)?;
        files::check_goal(path)?;
    }
    let (axes, impacts) = arguments.varied()?;
    let scene = scene_file::read_aloud(&arguments.scene)?;
    let impact = impact(&scene, arguments).map_err(WrongCall::of)?;
    implausible(&scene, arguments, impact.mass, &axes).iter().for_each(|doubt| crate::messages::warn(doubt));
    let setting = arguments.setting(&scene, &axes)?;
    // the strength is that of the normal impact
    let normal = setting.map_or(impact.speed, |setting| impact.speed * setting.angle.to_radians().cos());
    let scene = scene
        .with_strengths_for(Some(&Impact { speed: normal, ..impact }))
        .ok_or("the impact is too hard for the law of the scene")?;
    let mut choices = laws::choose(&scene, &arguments.laws).map_err(WrongCall::of)?;
    if setting.is_some() {
        let takes_some = arguments.laws.iter().any(|name| name == "all");
        choices = oblique::with_friction(choices, takes_some).map_err(WrongCall::of)?;
    }
    let question = Question { scene: &scene, choices: &choices, impact, as_json };
    if !axes.is_empty() {
        return question.sweep(setting, (&axes, impacts), output);
    }
    if let Some(setting) = setting {
        let answer = ObliqueAnswer::of(&scene, &choices, (impact, setting)).map_err(|error| failed(error, impacts))?;
        match as_json {
            true => print!("{}", json_line(&answer.json())),
            false => print!("{}", answer.text()),
        }
        return Ok(());
    }
    if let Some(dent) = arguments.dent {
        return question.explain_dent(dent);
    }
    if let Some(measured) = arguments.restitution {
        return question.explain_rebound(measured);
    }
    let answer = Answer::of(&scene, &choices, impact, arguments.drop_height)?;
    if let Some(path) = time_history {
        deliver(&time_history::columns(&choices, &impact)?.csv(), Some(path))?;
    }
    let mut object = answer.json();
    object["time_history"] = json!(time_history.map(Path::to_string_lossy));
    match as_json {
        true => print!("{}", json_line(&object)),
        false => print!("{}", answer.text()),
    }
    if let Some(path) = time_history.filter(|_| !as_json) {
        println!("\ntime history: {}", shown(path));
    }
    Ok(())
}

impl Question<'_> {
    /// Impacts over ranges of quantities or one by one, oblique ones with a `setting`: as a table, CSV or JSON.
    fn sweep(
        &self,
        setting: Option<Setting>,
        axes: (&[Axis], Impacts),
        output: Option<&Path>,
    ) -> Result<(), Box<dyn Error>> {
        let Question { scene, impact, .. } = *self;
        let each = |values: &[_], work: &(dyn Fn(&_) -> _ + Sync)| parallel::each(values, work);
        let sweep = Sweep::of_impacts((scene, self.choices), (impact, setting), axes, &each);
        let sweep = sweep.map_err(|error| failed(error, axes.1))?;
        // a program has those of each listed impact
        if sweep.said.is_empty() || output.is_none() && !self.as_json {
            sweep.warnings().iter().for_each(|warning| crate::messages::warn(warning));
        }
        let Impact { mass, speed } = impact;
        let text = match output {
            Some(_) => sweep.csv(),
            None if self.as_json => {
                let mut object = sweep.json();
                (object["mass"], object["speed"]) = (json!(mass), json!(speed));
                json_line(&object)
            }
            None => sweep.text(setting.map_or(&SHOWN, |_| &oblique::SHOWN)),
        };
        Ok(deliver(&text, output)?)
    }
}
