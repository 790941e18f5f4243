//! `brinell curve`: force, radius, pressure and energies along a path of loading, unloading and reloading.

use crate::files::{self, deliver, ending};
use crate::messages::WrongCall;
use crate::scene_file;
use crate::tangential_curve::{Loops, Wanted};
use crate::truth;
use brinell_contact::damped::{self, AnyDamped, Damped};
use brinell_contact::impact::Impact;
use brinell_contact::{History, Loading, TooDeep};
use brinell_exporter::columns::{Column, Columns};
use brinell_exporter::laws::{self, Choice};
use brinell_exporter::layout::json_line;
use brinell_exporter::model::AnyModel;
use brinell_exporter::numbers::in_message;
use brinell_exporter::plot::{Picture, Series};
use brinell_exporter::predict::{PredictError, oblique};
use brinell_exporter::scene::{Scene, plausible};
use brinell_exporter::{predict, units, validity};
use std::error::Error;
use std::f64::consts::PI;
use std::path::PathBuf;

/// Number of points on each branch of the path.
const POINTS: u32 = 200;

/// Number of rows of the table in a terminal: four for each branch, and the end.
const TABLE_ROWS: usize = 17;

/// The arguments of `brinell curve`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// The scene file
    pub scene: PathBuf,
    /// Write the curve: .csv with all digits or, without --tangential, .svg [default: print a short table]
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Laws to compare: LOADING or LOADING/UNLOADING; "all", "damped" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// Largest indentation [m] [default: that of the scene's impact]
    #[arg(long, allow_hyphen_values = true, value_parser = units::lengths)]
    pub to: Option<f64>,
    /// Add the finite-element loading curve as dots to the picture
    #[arg(long)]
    pub truth: bool,
    /// Loops of the tangential force instead, with the indentation --to held
    #[arg(long, conflicts_with = "truth")]
    pub tangential: bool,
    /// Coefficient of friction of the loops [default: the scene's]
    #[arg(long, allow_hyphen_values = true, requires = "tangential")]
    pub friction: Option<f64>,
    /// Amplitudes of the loops [m] [default: 0.3, 0.6, 0.9 and 1.2 of that at which the contact slides]
    #[arg(long, allow_hyphen_values = true, value_delimiter = ',', value_parser = units::lengths, requires = "tangential")]
    pub amplitude: Vec<f64>,
}

/// The finite elements of `--truth` are those of another pair of bodies.
const OTHER_BODIES: &str = "the dots are finite elements of a rigid sphere on a body that does not harden, with a Poisson's ratio of \
                            0.3, at small strain. They are drawn for the effective modulus and the softer strength of this scene, whose \
                            bodies are others or whose contact is wide";

/// The command: draws or tabulates the curve for these arguments.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let output = arguments.output.as_deref();
    let formats: &[_] = if arguments.tangential { &["csv"] } else { &["csv", "svg"] };
    let format = ending(output, formats).map_err(WrongCall)?;
    if let Some(path) = output {
        files::check_goal(path)?;
    }
    let scene = scene_file::read_aloud(&arguments.scene)?;
    let choices = laws::choose(&scene, &arguments.laws).map_err(WrongCall::of)?;
    let largest = arguments.to.unwrap_or(scene.predictions[0].max_indentation);
    let largest = predict::positive("to", largest).map_err(WrongCall::of)?;
    let impact = &scene.impact_of(0);
    let radius = scene.group_value(0, "impactor.radius").unwrap_or(f64::INFINITY);
    let doubt = arguments.to.and_then(|to| plausible::of_depth("to", to, radius));
    doubt.into_iter().chain(too_wide(&choices, largest)).for_each(|warning| crate::messages::warn(&warning));
    if arguments.truth && !truth::is_of(&scene, largest) {
        crate::messages::warn(OTHER_BODIES);
    }
    if arguments.tangential {
        return tangential(&scene, &choices, largest, arguments, as_json);
    }
    let too_deep = |_: TooDeep| WrongCall(format!("to = {} m is too deep for the law", in_message(largest)));
    let text = match (output, format) {
        (Some(_), "svg") => picture(&choices, largest, impact, arguments.truth).map_err(too_deep)?.svg(860, 480),
        (Some(_), _) => columns(&choices, largest, impact).map_err(too_deep)?.csv(),
        (None, _) => {
            let columns = columns(&choices, largest, impact).map_err(too_deep)?;
            match as_json {
                true => json_line(&columns.json()),
                false => table(&columns),
            }
        }
    };
    Ok(deliver(&text, output)?)
}

/// A warning, if laws are not valid up to the indentation `largest` [m].
fn too_wide(choices: &[Choice], largest: f64) -> Option<String> {
    let is_wide = |choice: &&Choice| {
        choice.model.elastoplastic().is_some_and(|model| {
            let radius = model.loading.contact_radius(&model.pair, largest);
            !validity::beyond(&model.pair, None, radius, 0.0).is_empty()
        })
    };
    let wide: Vec<_> = choices.iter().filter(is_wide).map(|choice| choice.laws.as_str()).collect();
    (!wide.is_empty()).then(|| validity::too_wide(&wide))
}

/// Loops of the tangential force at the indentation `held` [m].
fn tangential(
    scene: &Scene,
    choices: &[Choice],
    held: f64,
    arguments: &Arguments,
    as_json: bool,
) -> Result<(), Box<dyn Error>> {
    let takes_some = arguments.laws.iter().any(|name| name == "all");
    let choices = oblique::with_friction(choices.to_vec(), takes_some).map_err(WrongCall::of)?;
    let coefficient = arguments.friction.or(scene.group_value(0, oblique::FRICTION));
    let coefficient = coefficient.ok_or_else(|| WrongCall::of(PredictError::NoCoefficient))?;
    let wanted = Wanted { coefficient, indentation: held, amplitudes: &arguments.amplitude };
    let loops = Loops::of(scene, &choices, wanted).map_err(WrongCall::of)?;
    let text = match &arguments.output {
        Some(_) => loops.columns().csv(),
        None if as_json => json_line(&loops.columns().json()),
        None => loops.text(),
    };
    Ok(deliver(&text, arguments.output.as_deref())?)
}

/// A short table for a terminal.
fn table(columns: &Columns) -> String {
    let names = ["indentation", "force", "contact radius", "mean pressure", "stiffness", "dissipated energy"];
    let count = columns.laws.iter().map(|(_, rows)| rows.len()).max().unwrap_or(0);
    let text = columns.text(&names, TABLE_ROWS);
    format!("{text}\n{TABLE_ROWS} of {count} points; -o FILE.csv writes all of them with all digits\n")
}

/// A point of the curve, in SI units.
struct CurveRow {
    indentation: f64,
    force: f64,
    contact_radius: f64,
    mean_pressure: f64,
    stiffness: f64,
    elastic_energy: f64,
    dissipated_energy: f64,
    regime: i32,
}

/// The curve of `choice` up to `largest` [m]: loading to two thirds of it, unloading to the dent, loading to `largest`,
/// unloading.
fn rows(choice: &Choice, largest: f64, impact: &Impact) -> Result<Vec<CurveRow>, TooDeep> {
    let model = match choice.model {
        // the curve of a slow motion: losses begin with the speed
        AnyModel::Elastoplastic(model) => model,
        AnyModel::Lossy(model) => model.plastic,
        AnyModel::Damped(model) => return Ok(damped_rows(&model, impact)),
    };
    let mut history = History::start(&model, 0.0)?;
    let mut rows = Vec::new();
    let first = 2.0 / 3.0 * largest;
    let dent = |depth: f64| model.unloading_path(depth).lower;
    for goal in [first, dent(first), largest, dent(largest)] {
        let from = history.indentation();
        for point in 1..=POINTS {
            let to = from + (goal - from) * f64::from(point) / f64::from(POINTS);
            history.advance(&model, to - history.indentation())?;
            rows.push(CurveRow {
                indentation: history.indentation(),
                force: history.force(),
                contact_radius: history.contact_radius(&model),
                mean_pressure: history.mean_pressure(&model),
                stiffness: history.stiffness(),
                elastic_energy: history.elastic_energy(&model),
                dissipated_energy: history.dissipated_energy(&model),
                regime: history.regime() as i32,
            });
        }
    }
    Ok(rows)
}

/// The motion during `impact` with a rate-dependent law, which has no curve without a motion.
fn damped_rows(model: &damped::Model<AnyDamped>, impact: &Impact) -> Vec<CurveRow> {
    let mut rows = Vec::new();
    let factors = model.law.factors(&model.pair, model.restitution, model.mass);
    let energy = 0.5 * impact.mass * impact.speed * impact.speed;
    damped::impact::follow(model, impact, |state, force| {
        let indentation = state.indentation.max(0.0);
        let shape = model.law.elastic(indentation);
        let by_touch = if model.law.scaled_by_touch() { impact.speed } else { 1.0 };
        let damping = factors.damping / by_touch * model.law.damping(indentation).slope * state.speed;
        let elastic_energy = factors.elastic * shape.integral;
        let contact_radius = (model.pair.radius * indentation).sqrt();
        let area = PI * contact_radius * contact_radius;
        rows.push(CurveRow {
            indentation,
            force,
            contact_radius,
            mean_pressure: if area > 0.0 { force / area } else { 0.0 },
            stiffness: if force > 0.0 { factors.elastic * shape.slope + damping } else { 0.0 },
            elastic_energy,
            dissipated_energy: energy - 0.5 * impact.mass * state.speed * state.speed - elastic_energy,
            regime: i32::from(force > 0.0),
        });
    });
    // the method takes a few thousand steps; this leaves as many points as the other laws have
    let every = rows.len().div_ceil(4 * POINTS as usize).max(1);
    rows.into_iter().step_by(every).collect()
}

/// The curves as columns.
///
/// # Errors
/// [`TooDeep`] if the laws cannot be evaluated up to `largest` [m].
fn columns(choices: &[Choice], largest: f64, impact: &Impact) -> Result<Columns, TooDeep> {
    let names = [
        ("indentation", "m"),
        ("force", "N"),
        ("contact radius", "m"),
        ("mean pressure", "Pa"),
        ("stiffness", "N/m"),
        ("work", "J"),
        ("elastic energy", "J"),
        ("dissipated energy", "J"),
        ("regime", ""),
    ];
    let numbers = |row: &CurveRow| {
        let work = row.elastic_energy + row.dissipated_energy;
        let CurveRow {
            indentation,
            force,
            contact_radius,
            mean_pressure,
            stiffness,
            elastic_energy,
            dissipated_energy,
            regime,
        } = *row;
        vec![
            indentation,
            force,
            contact_radius,
            mean_pressure,
            stiffness,
            work,
            elastic_energy,
            dissipated_energy,
            f64::from(regime),
        ]
    };
    let law = |choice: &Choice| Ok((choice.laws.clone(), rows(choice, largest, impact)?.iter().map(numbers).collect()));
    Ok(Columns {
        columns: names.into_iter().map(|(name, unit)| Column::new(name, unit)).collect(),
        laws: choices.iter().map(law).collect::<Result<_, TooDeep>>()?,
    })
}

/// The curves as a picture; with `dots`, the finite-element loading curve of the same bodies is added.
///
/// # Errors
/// As for the columns.
pub fn picture(choices: &[Choice], largest: f64, impact: &Impact, dots: bool) -> Result<Picture, TooDeep> {
    let mut series = Vec::new();
    for choice in choices {
        let points = rows(choice, largest, impact)?.iter().map(|row| (1e6 * row.indentation, row.force)).collect();
        series.push(Series { label: choice.name.clone(), points, dots: false });
    }
    let elastoplastic = choices.iter().find_map(|choice| choice.model.elastoplastic());
    if let (true, Some(model)) = (dots, elastoplastic) {
        let unit = model.pair.yield_point(truth::YIELD_PRESSURE_FACTOR);
        let all = truth::loading().into_iter().map(|point| (point.x * unit.indentation, point.f * unit.force));
        let inside: Vec<_> = all.filter(|(d, _)| *d <= largest).map(|(d, f)| (1e6 * d, f)).collect();
        // about thirty dots; more would look like a line
        let every = (inside.len() / 30).max(1);
        let points = inside.into_iter().step_by(every).collect();
        series.push(Series { label: "finite elements".into(), points, dots: true });
    }
    let titles = ("indentation [um]", "force [N]");
    Ok(Picture { x_title: titles.0.into(), y_title: titles.1.into(), logarithmic: (false, false), series })
}
