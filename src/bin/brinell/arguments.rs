//! The command line.

use crate::platform::{self, Platform};
use clap::{Parser, Subcommand};
use std::path::PathBuf;

/// Exports FMI 2.0 co-simulation units of elastoplastic contact.
///
/// Without a command: exports the default scene into the current folder and checks the result.
#[derive(Parser)]
#[command(version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Results as JSON
    #[arg(long, global = true)]
    pub json: bool,
}

#[derive(Subcommand)]
pub enum Command {
    /// Builds and packs the unit of a scene
    Export {
        /// The scene file (TOML)
        scene: PathBuf,
        /// Where to write the FMU [default: NAME.fmu in the current folder]
        #[arg(short, long)]
        output: Option<PathBuf>,
        #[command(flatten)]
        platforms: PlatformArguments,
    },
    /// Builds the unit of a scene and packs it as a system (SSP 1.0) with its parameters
    Ssp(SspArguments),
    /// Loads a unit as an importer would, runs the impact of its scene, compares it with the energy balance
    Check {
        /// The unit
        fmu: PathBuf,
    },
    /// Says what an impact will do: largest force and indentation, dent, restitution, times
    Predict(PredictArguments),
    /// Draws or tabulates one cycle of loading, unloading and reloading
    Curve(CurveArguments),
    /// Measures the unit of a scene: error against run time, stability, extreme cases, laws; on one page
    Report {
        /// The scene file
        scene: PathBuf,
        /// The folder that the page and its data go to [default: NAME_report in the current folder]
        #[arg(short, long, value_name = "DIR")]
        output: Option<PathBuf>,
        /// Another unit with the same variables, to be run in the same picture; may be given several times
        #[arg(long, value_name = "FMU")]
        peer: Vec<PathBuf>,
        /// Fewer steps, and shorter runs
        #[arg(long)]
        quick: bool,
    },
    /// Lists the laws, and measures each: error against finite elements, jumps, energy
    Laws {
        /// Draws the loading curves of all laws over Hertz's force, with finite elements as dots
        #[arg(short, long, value_name = "FILE.svg")]
        output: Option<PathBuf>,
    },
    /// Joins FMUs of one scene that were made for different platforms
    Merge {
        /// The FMUs
        #[arg(num_args = 2.., required = true)]
        fmus: Vec<PathBuf>,
        /// Where to write the FMU with the libraries of all
        #[arg(short, long)]
        output: PathBuf,
    },
    /// Fetches a compiler for all platforms, about 100 MB, into a folder of its own; goes on where an earlier call stopped
    Toolchain {
        /// The folder [default: that of BRINELL_TOOLCHAIN, or `toolchain` in the cache]
        #[arg(long, value_name = "DIR")]
        folder: Option<PathBuf>,
        /// Also what builds whole Rust programs: the source of the standard library, and the library for this machine
        #[arg(long)]
        std: bool,
        /// Where Debian's security updates come from
        #[arg(long, value_name = "URL", default_value = "https://deb.debian.org/debian-security")]
        mirror: String,
    },
    /// Lists the built-in materials
    Materials,
    /// Prints the Rust constants of a scene, as they are compiled into its unit
    #[command(hide = true)]
    Constants { scene: PathBuf },
}

#[derive(clap::Args)]
pub struct SspArguments {
    /// The scene file (TOML); its unit is called `contact` in the system
    pub scene: PathBuf,
    /// Where to write the system, a name in .ssp [default: NAME.ssp in the current folder]
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Another unit that stands beside the contact, called as its file; may be given several times
    #[arg(long, value_name = "FMU")]
    pub with: Vec<PathBuf>,
    /// A connection such as contact.mean_force=mass.force; may be given several times
    #[arg(long, value_name = "UNIT.OUTPUT=UNIT.INPUT", requires = "with")]
    pub connect: Vec<String>,
    #[command(flatten)]
    pub platforms: PlatformArguments,
}

#[derive(clap::Args, Default)]
pub struct PlatformArguments {
    /// Platforms of the FMU: linux64, aarch64-linux, win64, darwin64, aarch64-darwin, or "all" [default: this machine's]
    #[arg(long, value_delimiter = ',', value_name = "PLATFORM")]
    platforms: Vec<String>,
    /// Puts the arm64 library into linux64, for importers on ARM Linux that look only there
    #[arg(long)]
    arm64_in_linux64: bool,
}

impl PlatformArguments {
    /// The platforms, each once, in the order of [`Platform::ALL`].
    ///
    /// # Errors
    /// A sentence about a platform that doesn't exist.
    pub fn chosen(&self) -> Result<Vec<Platform>, String> {
        let mut chosen = Vec::new();
        for name in &self.platforms {
            match name.as_str() {
                "all" => chosen.extend(Platform::ALL),
                _ => chosen.push(platform::named(name)?),
            }
        }
        if chosen.is_empty() {
            chosen.push(platform::here().map_err(|error| error.to_string())?);
        }
        let mut platforms: Vec<_> = Platform::ALL.into_iter().filter(|platform| chosen.contains(platform)).collect();
        if self.arm64_in_linux64 {
            platforms.retain(|platform| platform.folder != Platform::ARM64_IN_LINUX64.folder);
            platforms.insert(0, Platform::ARM64_IN_LINUX64);
        }
        Ok(platforms)
    }
}

#[derive(clap::Args)]
pub struct PredictArguments {
    /// The scene file
    pub scene: PathBuf,
    /// Effective mass [kg] instead of the scene's
    #[arg(long)]
    pub mass: Option<f64>,
    /// Closing speed [m/s] instead of the scene's
    #[arg(long, conflicts_with_all = ["energy", "drop_height"])]
    pub speed: Option<f64>,
    /// Kinetic energy [J] instead of a speed
    #[arg(long, conflicts_with = "drop_height")]
    pub energy: Option<f64>,
    /// Height of fall [m] instead of a speed
    #[arg(long)]
    pub drop_height: Option<f64>,
    /// Laws to compare: LOADING or LOADING/UNLOADING, or "all" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// A table, picture or page over a range of speeds [m/s]
    #[arg(long, num_args = 2, value_names = ["speed", "FROM:TO"])]
    pub sweep: Option<Vec<String>>,
    /// Where the sweep goes: .csv, .svg or .html [default: a table on standard output]
    #[arg(short, long, requires = "sweep")]
    pub output: Option<PathBuf>,
    /// A dent [m] that was measured: which speed makes it, which yield strength explains it
    #[arg(long, conflicts_with = "sweep")]
    pub dent: Option<f64>,
    /// A restitution that was measured: which speeds have it, which yield strengths explain it
    #[arg(long, conflicts_with_all = ["sweep", "dent"])]
    pub restitution: Option<f64>,
}

#[derive(clap::Args)]
pub struct CurveArguments {
    /// The scene file
    pub scene: PathBuf,
    /// Where the curve goes: .csv or .svg [default: a table on standard output]
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Laws to compare: LOADING or LOADING/UNLOADING, or "all" [default: the scene's]
    #[arg(long, value_delimiter = ',')]
    pub laws: Vec<String>,
    /// Largest indentation [m] [default: that of the scene's impact]
    #[arg(long)]
    pub to: Option<f64>,
    /// Adds the finite-element loading curve as dots
    #[arg(long)]
    pub truth: bool,
}
