//! What `brinell predict` is asked: its arguments, and the impact on a scene that they mean.

use crate::messages::WrongCall;
use crate::scene_file;
use brinell_contact::impact::Impact;
use brinell_exporter::laws::Choice;
use brinell_exporter::model::check_energy;
use brinell_exporter::predict::axis::Axis;
use brinell_exporter::predict::sweep::Impacts;
use brinell_exporter::predict::{PredictError, positive, speed_of_energy, speed_of_height};
use brinell_exporter::scene::{Scene, plausible};
use brinell_exporter::units;
use std::error::Error;
use std::path::PathBuf;

/// The arguments of `brinell predict`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// The scene file
    pub scene: PathBuf,
    /// Effective mass [kg], instead of the scene's
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("kg"))]
    pub mass: Option<f64>,
    /// Closing speed [m/s], instead of the scene's
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("m/s"), conflicts_with_all = ["energy", "drop_height"])]
    pub speed: Option<f64>,
    /// Kinetic energy [J], instead of a speed
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("J"), conflicts_with = "drop_height")]
    pub energy: Option<f64>,
    /// Drop height [m], instead of a speed
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("m"))]
    pub drop_height: Option<f64>,
    /// Laws to compare: LOADING or LOADING/UNLOADING; "all", "damped" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// Vary a quantity, such as speed=0.01:10 or "impactor.radius=1 mm:5 mm:8"; again: every combination. Ranges of a decade or more
    /// are spaced logarithmically, shorter ones linearly; speed=1:20:8log and 0.1:10:8lin say which
    #[arg(long, value_name = "NAME=FROM:TO[:COUNT]")]
    pub sweep: Vec<String>,
    /// Predict the impacts of a table, each on its own: a CSV file with the names of quantities above its columns, such as speed,mass;
    /// `-` is standard input. An impact that can't be has its error, and the others are predicted
    #[arg(long, value_name = "FILE.csv", conflicts_with = "sweep")]
    pub impacts: Option<PathBuf>,
    /// Write the sweep or the impacts with all digits [default: print a short table]
    #[arg(short, long, value_name = "FILE.csv")]
    pub output: Option<PathBuf>,
    /// Write force, indentation and speed over time
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["sweep", "impacts", "dent", "restitution"])]
    pub time_history: Option<PathBuf>,
    /// Angle of incidence from the normal [degrees], for an oblique impact; the speed is then that along the path
    #[arg(long, value_name = "DEGREES", value_parser = units::numbers_in("deg"), allow_hyphen_values = true, conflicts_with_all = ["time_history", "dent", "restitution"])]
    pub angle: Option<f64>,
    /// Spin of the ball before an oblique impact [rad/s]; positive like that of its contact point
    #[arg(long, value_name = "RAD/S", value_parser = units::numbers_in("rad/s"), allow_hyphen_values = true, conflicts_with_all = ["time_history", "dent", "restitution"])]
    pub spin: Option<f64>,
    /// Coefficient of friction of an oblique impact [default: the scene's]
    #[arg(long, allow_hyphen_values = true)]
    pub friction: Option<f64>,
    /// Moment of inertia of the ball in an oblique impact [kg.m^2] [default: that of a solid sphere]
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("kg.m^2"))]
    pub inertia: Option<f64>,
    /// A measured dent [m]: print the speed and the yield strength that explain it
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("m"), conflicts_with_all = ["sweep", "impacts"])]
    pub dent: Option<f64>,
    /// A measured restitution: print the speeds and yield strengths that explain it
    #[arg(long, allow_hyphen_values = true, conflicts_with_all = ["sweep", "impacts", "dent"])]
    pub restitution: Option<f64>,
}

impl Arguments {
    /// The quantities that vary, and how.
    ///
    /// # Errors
    /// A wrong range or table, or a file for the numbers where nothing varies.
    pub fn varied(&self) -> Result<(Vec<Axis>, Impacts), Box<dyn Error>> {
        let Some(path) = &self.impacts else {
            if self.output.is_some() && self.sweep.is_empty() {
                return Err(WrongCall("-o FILE.csv needs --sweep or --impacts".into()).into());
            }
            let axes = self.sweep.iter().map(|words| Axis::parse(words)).collect::<Result<Vec<_>, _>>();
            return Ok((axes.map_err(|error| failed(error, Impacts::Combined))?, Impacts::Combined));
        };
        let is_file = path.as_os_str() != "-";
        let bytes = scene_file::bytes_or_standard_input(is_file.then_some(path.as_path()))?;
        let name = if is_file { path.display().to_string() } else { "standard input".into() };
        let columns = Axis::columns(&bytes);
        Ok((columns.map_err(|why| WrongCall(format!("{name}:{why}")))?, Impacts::Listed))
    }
}

/// The scene's impact, with the changes from the arguments.
pub fn impact(scene: &Scene, arguments: &Arguments) -> Result<Impact, PredictError> {
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

/// The warnings about numbers of the command line: an impact of this `mass` [kg], a dent, and the ends of ranges.
pub fn implausible(scene: &Scene, arguments: &Arguments, mass: f64, axes: &[Axis]) -> Vec<String> {
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
pub fn failed(error: PredictError, impacts: Impacts) -> Box<dyn Error> {
    match error {
        PredictError::Beyond { .. } => error.into(),
        PredictError::Varied(why) => WrongCall(format!("{} {why}", impacts.option())).into(),
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
