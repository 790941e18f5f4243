//! `brinell translate`: numbers for the contact models of other tools.

use crate::messages::WrongCall;
use crate::scene_file;
use brinell_exporter::translate::{Request, TranslateError, json, speeds, text, translate};
use brinell_exporter::units;
use std::error::Error;
use std::path::PathBuf;

/// The arguments of `brinell translate`.
#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct Arguments {
    /// The scene file
    pub scene: PathBuf,
    /// The tool, such as mujoco, drake, adams or lammps; an unknown one lists all
    #[arg(long = "for", value_name = "TOOL")]
    pub tool: String,
    /// Closing speeds [m/s] for which the error is told [default: a tenth to three times the scene's]
    #[arg(long, value_name = "FROM:TO", allow_hyphen_values = true)]
    pub speed: Option<String>,
    /// Step of the tool [s] [default: a hundredth of the contact time, or less]
    #[arg(long, allow_hyphen_values = true, value_parser = units::numbers_in("s"))]
    pub step: Option<f64>,
    /// System of units of the block: si, or mm-t-s where the tool has a choice
    #[arg(long, value_name = "UNITS", value_parser = ["si", "mm-t-s"], default_value = "si")]
    pub units: String,
}

/// Runs the command.
pub fn run(arguments: &Arguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let speeds =
        arguments.speed.as_deref().map(speeds).transpose().map_err(|why| WrongCall(format!("--speed {why}")))?;
    let millimetres = arguments.units == "mm-t-s";
    let request = Request { tool: &arguments.tool, speeds, step: arguments.step, millimetres };
    let scene = scene_file::read_aloud(&arguments.scene)?;
    let translation = translate(&scene, &request).map_err(|error| -> Box<dyn Error> {
        match error {
            TranslateError::Tool(_) | TranslateError::Step(_) | TranslateError::Units(..) => {
                Box::new(WrongCall::of(error))
            }
            error => Box::new(error),
        }
    })?;
    print!("{}", if as_json { json(&translation) } else { text::of(&translation) });
    Ok(())
}
