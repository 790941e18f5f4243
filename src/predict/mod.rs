//! `brinell predict`: predicts an impact, and explains a measured one.

mod inverse;
mod oblique_text;

use self::oblique_text::ObliqueAnswer;
use crate::files::{self, deliver, ending};
use crate::messages::WrongCall;
use crate::parallel;
use crate::scene_file;
use brinell_contact::impact::Impact;
use brinell_exporter::laws::{self, Choice};
use brinell_exporter::layout::{json_line, shown};
use brinell_exporter::model::check_energy;
use brinell_exporter::predict::answer::Answer;
use brinell_exporter::predict::axis::Axis;
use brinell_exporter::predict::oblique::{self, Setting};
use brinell_exporter::predict::sweep::Sweep;
use brinell_exporter::predict::{PredictError, positive, speed_of_energy, speed_of_height, time_history};
use brinell_exporter::scene::{Scene, plausible};
use brinell_exporter::units;
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
    #[arg(long, allow_hyphen_values = true, value_parser = units::masses)]
    pub mass: Option<f64>,
    /// Closing speed [m/s], instead of the scene's
    #[arg(long, allow_hyphen_values = true, value_parser = units::speeds, conflicts_with_all = ["energy", "drop_height"])]
    pub speed: Option<f64>,
    /// Kinetic energy [J], instead of a speed
    #[arg(long, allow_hyphen_values = true, value_parser = units::energies, conflicts_with = "drop_height")]
    pub energy: Option<f64>,
    /// Drop height [m], instead of a speed
    #[arg(long, allow_hyphen_values = true, value_parser = units::lengths)]
    pub drop_height: Option<f64>,
    /// Laws to compare: LOADING or LOADING/UNLOADING; "all", "damped" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// Vary a quantity, such as speed=0.01:10 or "impactor.radius=1 mm:5 mm:8"; again: every combination. Ranges of a decade or more
    /// are spaced logarithmically, shorter ones linearly; speed=1:20:8log and 0.1:10:8lin say which
    #[arg(long, value_name = "NAME=FROM:TO[:COUNT]")]
    pub sweep: Vec<String>,
    /// Write the sweep with all digits [default: print a short table]
    #[arg(short, long, value_name = "FILE.csv", requires = "sweep")]
    pub output: Option<PathBuf>,
    /// Write force, indentation and speed over time
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["sweep", "dent", "restitution"])]
    pub time_history: Option<PathBuf>,
    /// Angle of incidence from the normal [degrees], for an oblique impact; the speed is then that along the path
    #[arg(long, value_name = "DEGREES", value_parser = units::angles, allow_hyphen_values = true, conflicts_with_all = ["time_history", "dent", "restitution"])]
    pub angle: Option<f64>,
    /// Spin of the ball before an oblique impact [rad/s]; positive like that of its contact point
    #[arg(long, value_name = "RAD/S", value_parser = units::spins, allow_hyphen_values = true, conflicts_with_all = ["time_history", "dent", "restitution"])]
    pub spin: Option<f64>,
    /// Coefficient of friction of an oblique impact [default: the scene's]
    #[arg(long, allow_hyphen_values = true)]
    pub friction: Option<f64>,
    /// Moment of inertia of the ball in an oblique impact [kg.m^2] [default: that of a solid sphere]
    #[arg(long, allow_hyphen_values = true, value_parser = units::inertias)]
    pub inertia: Option<f64>,
    /// A measured dent [m]: print the speed and the yield strength that explain it
    #[arg(long, allow_hyphen_values = true, value_parser = units::lengths, conflicts_with = "sweep")]
    pub dent: Option<f64>,
    /// A measured restitution: print the speeds and yield strengths that explain it
    #[arg(long, allow_hyphen_values = true, conflicts_with_all = ["sweep", "dent"])]
    pub restitution: Option<f64>,
}

/// The quantities of a sweep's table in a terminal.
const SHOWN: [&str; 5] = ["restitution", "largest force", "largest indentation", "dent", "loading time"];

/// Runs the command.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let (output, time_history) = (arguments.output.as_deref(), arguments.time_history.as_deref());
    for path in [output, time_history].into_iter().flatten() {
        ending(Some(path), &["csv"]).map_err(WrongCall)?;
        files::check_goal(path)?;
    }
    let axes = arguments.sweep.iter().map(|words| Axis::parse(words)).collect::<Result<Vec<_>, _>>();
    let axes = axes.map_err(WrongCall::of)?;
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
        return question.sweep(setting, &axes, output);
    }
    if let Some(setting) = setting {
        let answer = ObliqueAnswer::of(&scene, &choices, (impact, setting)).map_err(failed)?;
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

/// The scene's impact, with the changes from the arguments.
fn impact(scene: &Scene, arguments: &Arguments) -> Result<Impact, PredictError> {
    let mass = positive("mass", arguments.mass.unwrap_or(scene.impact_of(0).mass))?;
    let speed = match (arguments.speed, arguments.energy, arguments.drop_height) {
        (Some(speed), ..) => positive("speed", speed)?,
        (_, Some(energy), _) => speed_of_energy(mass, positive("energy", energy)?),
        (.., Some(height)) => speed_of_height(positive("drop-height", height)?),
        _ => scene.impact.speed,
    };
    let impact = Impact { mass, speed };
    check_energy(&impact)?;
    Ok(impact)
}

/// The doubts about numbers of the command line: an impact of this `mass` [kg], a dent, and the ends of ranges.
fn implausible(scene: &Scene, arguments: &Arguments, mass: f64, axes: &[Axis]) -> Vec<String> {
    let given = [("speed", arguments.speed), ("mass", arguments.mass), ("drop-height", arguments.drop_height)];
    let given = given.into_iter().filter_map(|(name, value)| plausible::of_quantity(name, value?));
    let energy = arguments.energy.and_then(|energy| plausible::of_energy("energy", energy, mass));
    let radius = scene.group_value(0, "impactor.radius").unwrap_or(f64::INFINITY);
    let dent = arguments.dent.and_then(|dent| plausible::of_depth("dent", dent, radius));
    let end = |axis: &Axis, end: f64| match axis.name {
        "energy" => plausible::of_energy(axis.name, end, mass),
        name => plausible::of_quantity(name, end),
    };
    let range = |axis: &Axis| [axis.from, axis.to].into_iter().find_map(|value| end(axis, value));
    let rod = scene.contacts[0].rods.impactor.is_some();
    let ball =
        |mass: f64| plausible::of_ball("mass", mass, radius, scene.contacts[0].impactor_density).filter(|_| !rod);
    let of_ball = arguments.mass.and_then(ball);
    let end_of_ball = |axis: &Axis| [axis.from, axis.to].into_iter().filter(|_| axis.name == "mass").find_map(ball);
    given
        .chain(energy)
        .chain(of_ball)
        .chain(axes.iter().filter_map(end_of_ball))
        .chain(dent)
        .chain(axes.iter().filter_map(range))
        .collect()
}

/// An impossible quantity or range is a wrong call. A law that can't be evaluated is not.
fn failed(error: PredictError) -> Box<dyn Error> {
    match error {
        PredictError::Beyond { .. } => error.into(),
        error => WrongCall::of(error).into(),
    }
}

/// An impact on a scene with several laws, and the format of the output.
pub struct Question<'a> {
    pub scene: &'a Scene,
    pub choices: &'a [Choice],
    pub impact: Impact,
    pub as_json: bool,
}

impl Question<'_> {
    /// Impacts over ranges of quantities, oblique ones with a `setting`: as a table, CSV or JSON.
    fn sweep(&self, setting: Option<Setting>, axes: &[Axis], output: Option<&Path>) -> Result<(), Box<dyn Error>> {
        let Question { scene, impact, .. } = *self;
        let each = |values: &[_], work: &(dyn Fn(&_) -> _ + Sync)| parallel::each(values, work);
        let sweep = Sweep::of_impacts((scene, self.choices), (impact, setting), axes, &each);
        let sweep = sweep.map_err(failed)?;
        sweep.limits.warnings().iter().for_each(|warning| crate::messages::warn(warning));
        let Impact { mass, speed } = impact;
        let text = match output {
            Some(_) => sweep.columns.csv(),
            None if self.as_json => {
                let mut object = sweep.columns.json();
                (object["mass"], object["speed"]) = (json!(mass), json!(speed));
                json_line(&object)
            }
            None => sweep.text(setting.map_or(&SHOWN, |_| &oblique::SHOWN)),
        };
        Ok(deliver(&text, output)?)
    }
}
