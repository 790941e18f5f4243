//! The command `predict`: its arguments and the format of its output.

use super::axis::Axis;
use super::map::Map;
use super::oblique::{self, Setting};
use super::sweep::Sweep;
use super::text::Answer;
use super::time_history::TimeHistory;
use super::{PredictError, inverse, page, rebound};
use crate::columns::Columns;
use crate::files::{self, deliver, ending};
use crate::laws::{self, Choice};
use crate::layout::{self, paragraph, shown};
use crate::numbers::quantity;
use crate::scene::{Scene, plausible};
use crate::units;
use crate::validity;
use crate::wrong_call::WrongCall;
use brinell::contact::impact::Impact;
use serde_json::json;
use std::error::Error;
use std::path::{Path, PathBuf};

/// The arguments of `brinell predict`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// The scene file
    pub scene: PathBuf,
    /// Effective mass [kg], instead of the scene's
    #[arg(long, value_parser = units::masses)]
    pub mass: Option<f64>,
    /// Closing speed [m/s], instead of the scene's
    #[arg(long, value_parser = units::speeds, conflicts_with_all = ["energy", "drop_height"])]
    pub speed: Option<f64>,
    /// Kinetic energy [J], instead of a speed
    #[arg(long, value_parser = units::energies, conflicts_with = "drop_height")]
    pub energy: Option<f64>,
    /// Drop height [m], instead of a speed
    #[arg(long, value_parser = units::lengths)]
    pub drop_height: Option<f64>,
    /// Laws to compare: LOADING or LOADING/UNLOADING; "all", "damped" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// Vary a quantity, such as speed=0.01:10 or impactor.radius=1e-3:5e-3:8; twice: a map
    #[arg(long, value_name = "NAME=FROM:TO[:COUNT]")]
    pub sweep: Vec<String>,
    /// Write the sweep with all digits: .csv, .svg or .html [default: print a short table]
    #[arg(short, long, value_name = "FILE", requires = "sweep")]
    pub output: Option<PathBuf>,
    /// Write force, indentation and speed over time: .csv, .svg or .html
    #[arg(long, value_name = "FILE", conflicts_with_all = ["sweep", "dent", "restitution"])]
    pub time_history: Option<PathBuf>,
    /// Angle of incidence from the normal [degrees], for an oblique impact; the speed is then that along the path
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, conflicts_with_all = ["time_history", "dent", "restitution"])]
    pub angle: Option<f64>,
    /// Spin of the ball before an oblique impact [rad/s]; positive like that of its contact point
    #[arg(long, value_name = "RAD/S", allow_negative_numbers = true, conflicts_with_all = ["time_history", "dent", "restitution"])]
    pub spin: Option<f64>,
    /// Coefficient of friction of an oblique impact [default: the scene's]
    #[arg(long)]
    pub friction: Option<f64>,
    /// Moment of inertia of the ball in an oblique impact [kg.m^2] [default: that of a solid sphere]
    #[arg(long)]
    pub inertia: Option<f64>,
    /// A measured dent [m]: print the speed and the yield strength that explain it
    #[arg(long, value_parser = units::lengths, conflicts_with = "sweep")]
    pub dent: Option<f64>,
    /// A measured restitution: print the speeds and yield strengths that explain it
    #[arg(long, conflicts_with_all = ["sweep", "dent"])]
    pub restitution: Option<f64>,
}

/// Runs the command.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let formats = ["csv", "svg", "html"];
    let output = arguments.output.as_deref();
    let format = ending(output, &formats).map_err(WrongCall)?;
    let history_format = ending(arguments.time_history.as_deref(), &formats).map_err(WrongCall)?;
    for path in [output, arguments.time_history.as_deref()].into_iter().flatten() {
        files::check_goal(path)?;
    }
    let axes = arguments.sweep.iter().map(|words| Axis::parse(words)).collect::<Result<Vec<_>, _>>();
    let axes = axes.map_err(WrongCall::of)?;
    let scene = Scene::read_aloud(&arguments.scene)?;
    implausible(&scene, arguments, &axes).iter().for_each(|doubt| layout::warn(doubt));
    let impact = impact(&scene, arguments).map_err(WrongCall::of)?;
    let setting = arguments.setting(&scene, &axes)?;
    // the strength is that of the normal impact
    let normal = setting.map_or(impact.speed, |setting| impact.speed * setting.angle.to_radians().cos());
    let scene = scene
        .with_strengths_for(Some(&Impact { speed: normal, ..impact }))
        .ok_or("the impact is too hard for the law of the scene")?;
    let choices = laws::choose(&scene, &arguments.laws).map_err(WrongCall::of)?;
    let question = Question { scene: &scene, choices: &choices, impact, as_json };
    if let Some(setting) = setting {
        return question.oblique((setting, arguments.laws.iter().any(|name| name == "all")), axes, output, format);
    }
    if !axes.is_empty() {
        return question.sweep(axes, output, format);
    }
    if let Some(dent) = arguments.dent {
        return Ok(question.invert(super::positive("dent", dent).map_err(WrongCall::of)?)?);
    }
    if let Some(measured) = arguments.restitution {
        let goal = rebound::measured(measured).map_err(WrongCall::of)?;
        let rebounds = rebound::explain(&choices, &impact, goal)?;
        for (choice, rebound) in choices.iter().zip(&rebounds) {
            let [speeds, strengths] = rebound.numbers();
            question.doubt(choice, &speeds, &strengths);
        }
        match as_json {
            true => println!("{}", rebound::as_json(&rebounds, &impact, goal)),
            false => print!("{}", rebound::text(&rebounds, &impact, goal)),
        }
        return Ok(());
    }
    let answer = Answer::of(&scene, &choices, impact, arguments.drop_height)?;
    if let Some(path) = &arguments.time_history {
        question.write_history(path, history_format)?;
    }
    let mut object = answer.json();
    object["time_history"] = json!(arguments.time_history.as_ref().map(|path| path.to_string_lossy()));
    match as_json {
        true => println!("{object}"),
        false => print!("{}", answer.text()),
    }
    if let Some(path) = arguments.time_history.as_deref().filter(|_| !as_json) {
        println!("\ntime history: {}", shown(path));
    }
    Ok(())
}

/// The scene's impact, with the changes from the arguments.
fn impact(scene: &Scene, arguments: &Arguments) -> Result<Impact, PredictError> {
    let mass = super::positive("mass", arguments.mass.unwrap_or(scene.impact_of(0).mass))?;
    let speed = match (arguments.speed, arguments.energy, arguments.drop_height) {
        (Some(speed), ..) => super::positive("speed", speed)?,
        (_, Some(energy), _) => super::speed_of_energy(mass, super::positive("energy", energy)?),
        (.., Some(height)) => super::speed_of_height(super::positive("drop-height", height)?),
        _ => scene.impact.speed,
    };
    let impact = Impact { mass, speed };
    super::check_energy(&impact)?;
    Ok(impact)
}

/// The doubts about numbers of the command line: a speed, a dent, and the ends of ranges.
fn implausible(scene: &Scene, arguments: &Arguments, axes: &[Axis]) -> Vec<String> {
    let speed = arguments.speed.and_then(|speed| plausible::of_quantity("speed", speed));
    let radius = scene.group_value(0, "impactor.radius").unwrap_or(f64::INFINITY);
    let dent = arguments.dent.and_then(|dent| plausible::of_depth("dent", dent, radius));
    let range = |axis: &Axis| [axis.from, axis.to].iter().find_map(|end| plausible::of_quantity(axis.name, *end));
    speed.into_iter().chain(dent).chain(axes.iter().filter_map(range)).collect()
}

/// An impossible quantity or range is a wrong call. A law that can't be evaluated is not.
fn failed(error: PredictError) -> Box<dyn Error> {
    match error {
        PredictError::Beyond { .. } => error.into(),
        error => WrongCall::of(error).into(),
    }
}

/// An impact on a scene with several laws, and the format of the output.
struct Question<'a> {
    scene: &'a Scene,
    choices: &'a [Choice],
    impact: Impact,
    as_json: bool,
}

impl Question<'_> {
    /// Impacts over one or two quantities, as a table, a picture or a page.
    fn sweep(&self, axes: Vec<Axis>, output: Option<&Path>, format: &str) -> Result<(), Box<dyn Error>> {
        let Question { scene, choices, impact, .. } = *self;
        // with several laws, those without a yield strength don't depend on it
        let strength = axes.iter().any(|axis| axis.name == "target.yield_strength") && choices.len() > 1;
        let yields = |choice: &&Choice| choice.model.elastoplastic().is_some() && choice.laws != "hertz";
        let mut choices: Vec<Choice> = choices.iter().filter(|choice| !strength || yields(choice)).cloned().collect();
        // with several laws, those without the constant don't depend on it
        let constant = |axis: &&Axis| super::constants::is_one(axis.name);
        let has_all =
            |choice: &Choice| axes.iter().filter(constant).all(|axis| super::constants::has(choice, axis.name));
        if choices.iter().any(has_all) {
            choices.retain(has_all);
        }
        let choices = choices.as_slice();
        let text = match <[Axis; 2]>::try_from(axes) {
            Ok(axes) => {
                let map = Map::of(scene, choices, impact, axes).map_err(failed)?;
                let page = || page::of_map(scene, choices, impact, &map);
                map.limits.tell();
                self.written((output, format), &|| map.columns(), &|| map.svg(), &page, &|| map.text())
            }
            Err(axes) if axes.len() == 1 => {
                let axis = axes.into_iter().next().expect("one");
                let sweep = Sweep::of(scene, choices, impact, axis).map_err(failed)?;
                let page = || page::of_sweep(scene, choices, &sweep);
                sweep.limits.tell();
                self.written((output, format), &|| sweep.columns(), &|| sweep.svg(), &page, &|| sweep.text())
            }
            Err(axes) => return Err(WrongCall(format!("--sweep is given {} times: at most two", axes.len())).into()),
        };
        Ok(deliver(&text, output)?)
    }

    /// Oblique impacts: one, or several over a quantity.
    fn oblique(
        &self,
        (setting, takes_some): (Setting, bool),
        axes: Vec<Axis>,
        output: Option<&Path>,
        format: &str,
    ) -> Result<(), Box<dyn Error>> {
        let choices = oblique::with_friction(self.choices.to_vec(), takes_some).map_err(WrongCall::of)?;
        let (scene, asked) = (self.scene, (self.impact, setting));
        let axis = match <[Axis; 1]>::try_from(axes) {
            Ok([axis]) => axis,
            Err(none) if none.is_empty() => {
                let answer = oblique::Answer::of(scene, &choices, asked).map_err(failed)?;
                match self.as_json {
                    true => println!("{}", answer.json()),
                    false => print!("{}", answer.text()),
                }
                return Ok(());
            }
            Err(axes) => {
                let count = axes.len();
                return Err(
                    WrongCall(format!("--sweep is given {count} times: at most once for oblique impacts")).into()
                );
            }
        };
        let sweep = oblique::Sweep::of(scene, &choices, asked, axis).map_err(failed)?;
        let page = || page::of_oblique(scene, asked, &sweep);
        sweep.limits().tell();
        let text = self.written((output, format), &|| sweep.columns(), &|| sweep.svg(), &page, &|| sweep.text());
        Ok(deliver(&text, output)?)
    }

    /// A result in the requested format.
    fn written(
        &self,
        (output, format): (Option<&Path>, &str),
        columns: &dyn Fn() -> Columns,
        svg: &dyn Fn() -> String,
        page: &dyn Fn() -> String,
        text: &dyn Fn() -> String,
    ) -> String {
        match (output, format) {
            (None, _) if self.as_json => {
                let Impact { mass, speed } = self.impact;
                format!("{}\n", json!({ "mass": mass, "speed": speed, "laws": columns().json() }))
            }
            (None, _) => text(),
            (_, "html") => page(),
            (_, "svg") => svg(),
            _ => columns().csv(),
        }
    }

    /// Warns about answers of an inverse prediction that are outside the validity of the law.
    fn doubt(&self, choice: &Choice, speeds: &[f64], strengths: &[f64]) {
        let Question { scene, impact, .. } = *self;
        let at = |speed: &f64| Some((choice.clone(), Impact { speed: *speed, ..impact }, quantity(*speed, "m/s")));
        let with = |strength: &f64| {
            let model = choice.model.with_yield_strength(*strength)?;
            Some((Choice { model, ..choice.clone() }, impact, quantity(*strength, "Pa")))
        };
        for (choice, impact, answer) in speeds.iter().filter_map(at).chain(strengths.iter().filter_map(with)) {
            let Ok(prediction) = super::one(&choice, &impact) else { continue };
            for limit in super::beyond(scene, &choice, &impact, &prediction) {
                layout::warn(&format!("{}, {answer}: {}", choice.laws, validity::words(limit)));
            }
        }
    }

    /// Writes force, indentation and speed over time.
    fn write_history(&self, path: &Path, format: &str) -> Result<(), Box<dyn Error>> {
        let history = TimeHistory::of(self.choices, &self.impact)?;
        let text = match format {
            "html" => page::of_time_history(self.scene, self.choices, self.impact, &history),
            "svg" => history.svg(),
            _ => history.columns().csv(),
        };
        Ok(deliver(&text, Some(path))?)
    }

    /// The speed that causes `dent` [m], and the yield strength that explains it after the impact.
    fn invert(&self, dent: f64) -> Result<(), PredictError> {
        let Question { choices, impact, as_json, .. } = *self;
        let mut answers = Vec::new();
        for choice in choices {
            let speed = inverse::speed_of_dent(choice, impact.mass, dent)?;
            let strength = inverse::strength_of_dent(choice, &impact, dent)?;
            self.doubt(choice, &[speed], &[strength]);
            if as_json {
                answers.push(json!({ "law": choice.laws, "speed": speed, "yield_strength": strength }));
                continue;
            }
            let words = format!(
                "by {}, {} leaves a dent of {} at {} on the target of the scene, or at {} on a target with a yield strength of {}",
                choice.laws,
                quantity(impact.mass, "kg"),
                quantity(dent, "m"),
                quantity(speed, "m/s"),
                quantity(impact.speed, "m/s"),
                quantity(strength, "Pa")
            );
            print!("{}", paragraph("", &words));
        }
        if as_json {
            println!("{}", json!({ "dent": dent, "mass": impact.mass, "impact_speed": impact.speed, "laws": answers }));
        }
        Ok(())
    }
}
