//! The command line.

use crate::{hardness, law_list, new, predict, units};
use clap::{Parser, Subcommand};
use std::path::PathBuf;

/// Export FMI 2.0 co-simulation FMUs of elastoplastic contact.
///
/// Without a command: export the default scene into the current folder and check the FMU.
#[derive(Parser)]
#[command(version, max_term_width = 100, after_help = STATUS)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Print results as JSON: SI units, all digits
    #[arg(long, global = true)]
    pub json: bool,
}

/// What the exit status of the program means.
const STATUS: &str = "\
Exit status: 0 success; 1 the job failed, or its result is bad (a wrong scene, no compiler, an FMU
that fails its check); 2 the command line is wrong (an unknown option or law, a value out of range).";

#[derive(Subcommand)]
pub enum Command {
    /// Write a commented scene file to begin with
    New(new::Arguments),
    /// Build the FMU of a scene
    #[command(next_line_help = true)]
    Export {
        /// The scene file (TOML)
        scene: PathBuf,
        /// Where to write the FMU [default: NAME.fmu in the current folder]
        #[arg(short, long)]
        output: Option<PathBuf>,
    },
    /// Build the FMU of a scene and pack it as a system (SSP 1.0) with its parameters
    Ssp(SspArguments),
    /// Load an FMU, run the impact of its scene and compare it with the prediction
    #[command(next_line_help = true)]
    Check {
        /// The FMU
        fmu: PathBuf,
    },
    /// Predict an impact: largest force and indentation, dent, restitution, contact time
    Predict(predict::command::Arguments),
    /// Predict a Brinell test: dent and hardness; or find the yield strength from HBW
    Hardness(hardness::command::Arguments),
    /// Draw or tabulate one cycle of loading, unloading and reloading
    Curve(CurveArguments),
    /// Measure the FMU of a scene: errors, run times, stability, laws; on one page
    #[command(next_line_help = true)]
    Report {
        /// The scene file
        scene: PathBuf,
        /// The folder for the page and its data [default: NAME_report in the current folder]
        #[arg(short, long, value_name = "DIR")]
        output: Option<PathBuf>,
        /// Another FMU with the same variables, for the same pictures; can be repeated
        #[arg(long, value_name = "FMU")]
        peer: Vec<PathBuf>,
        /// Use fewer steps and shorter runs
        #[arg(long)]
        quick: bool,
    },
    /// List the laws with their error against finite elements, or show one law
    Laws(law_list::Arguments),
    /// List the built-in materials
    Materials,
    /// Print the Rust constants of a scene, as they are compiled into its FMU
    #[command(hide = true)]
    Constants { scene: PathBuf },
}

#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct SspArguments {
    /// The scene file (TOML); its FMU is the component `contact` of the system
    pub scene: PathBuf,
    /// Where to write the system, a file .ssp [default: NAME.ssp in the current folder]
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Another FMU of the system, a component with the name of its file; can be repeated
    #[arg(long, value_name = "FMU")]
    pub with: Vec<PathBuf>,
    /// A connection such as contact.mean_force=mass.force; can be repeated
    #[arg(long, value_name = "FMU.OUTPUT=FMU.INPUT", requires = "with")]
    pub connect: Vec<String>,
}

#[derive(clap::Args)]
#[command(next_line_help = true)]
pub struct CurveArguments {
    /// The scene file
    pub scene: PathBuf,
    /// Write the curve with all digits: .csv or .svg [default: print a short table]
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Laws to compare: LOADING or LOADING/UNLOADING; "all", "damped" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// Largest indentation [m] [default: that of the scene's impact]
    #[arg(long, value_parser = units::lengths)]
    pub to: Option<f64>,
    /// Add the finite-element loading curve as dots to the picture
    #[arg(long)]
    pub truth: bool,
}
