//! `brinell curve`: force, radius, pressure and energies along a path of loading, unloading and reloading.

use crate::files::{self, deliver, ending};
use crate::messages::WrongCall;
use crate::scene_file;
use brinell_contact::{Loading, TooDeep};
use brinell_exporter::columns::Columns;
use brinell_exporter::curve::{self, columns};
use brinell_exporter::laws::{self, Choice};
use brinell_exporter::layout::json_line;
use brinell_exporter::numbers::in_message;
use brinell_exporter::scene::{Scene, plausible};
use brinell_exporter::{predict, units, validity};
use std::error::Error;
use std::path::PathBuf;

/// Number of rows of the table in a terminal: four for each branch, and the end.
const TABLE_ROWS: usize = 17;

/// The arguments of `brinell curve`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// The scene file
    pub scene: PathBuf,
    /// Write the curve: .csv with all digits, or .svg [default: print a short table]
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Laws to compare: LOADING or LOADING/UNLOADING; "all", "damped" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// Largest indentation [m] [default: that of the scene's impact]
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("m"))]
    pub to: Option<f64>,
}

/// The command: draws or tabulates the curve for these arguments.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let output = arguments.output.as_deref();
    let format = ending(output, &["csv", "svg"]).map_err(WrongCall)?;
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
    doubt.into_iter().chain(too_wide(&scene, &choices, largest)).for_each(|warning| crate::messages::warn(&warning));
    let too_deep = |_: TooDeep| WrongCall(format!("to = {} m is too deep for the law", in_message(largest)));
    let text = match (output, format) {
        (Some(_), "svg") => curve::picture(&choices, largest, impact).map_err(too_deep)?.svg(860, 480),
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
fn too_wide(scene: &Scene, choices: &[Choice], largest: f64) -> Option<String> {
    let size = scene.size(0);
    let is_wide = |choice: &&Choice| {
        choice.model.elastoplastic().is_some_and(|model| {
            let radius = model.loading.contact_radius(&model.pair, largest);
            !validity::beyond((&model.pair, size), scene.line_size(0), None, radius, 0.0).is_empty()
        })
    };
    let wide: Vec<_> = choices.iter().filter(is_wide).map(|choice| choice.laws.as_str()).collect();
    (!wide.is_empty()).then(|| validity::too_wide(scene, &wide))
}

/// A short table for a terminal.
fn table(columns: &Columns) -> String {
    let names = ["indentation", "force", "contact radius", "mean pressure", "stiffness", "dissipated energy"];
    let count = columns.laws.iter().map(|(_, rows)| rows.len()).max().unwrap_or(0);
    let text = columns.text(&names, TABLE_ROWS);
    format!("{text}\n{TABLE_ROWS} of {count} points; -o FILE.csv writes all of them with all digits\n")
}
