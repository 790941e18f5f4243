//! The command line.

use crate::package::LibraryWay;
use crate::prebuilt;
use crate::{app, check, curve, hardness, law_list, new, predict, report, schema, translate};
use brinell_exporter::platform::{self, Platform};
use clap::{Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;

/// Export FMI 2.0 co-simulation FMUs of elastoplastic contact.
///
/// Without a command: export the default scene into the current folder and check the FMU.
#[derive(Parser)]
#[command(version, disable_version_flag = true, max_term_width = 100, after_help = STATUS)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Print results as JSON: SI units, all digits
    #[arg(long, global = true)]
    pub json: bool,
    /// Show the versions of program and library, the platform, and the prebuilt libraries
    #[arg(short = 'V', long)]
    pub version: bool,
}

/// What is not in the list of commands, and the meaning of the exit status of the program.
const STATUS: &str = "\
For packagers and editors: prebuild, schema, completions, man; each has its own --help.

Exit status: 0 success; 1 the job failed, or its result is bad (a wrong scene, no compiler, an FMU
that fails its check); 2 the command line is wrong (an unknown option or law, a value out of range).";

#[derive(Subcommand)]
pub enum Command {
    /// Open Brinell in the browser: scene, predictions and FMU on one page, without the network
    App(app::Arguments),
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
        #[command(flatten)]
        platforms: PlatformArguments,
        #[command(flatten)]
        way: WayArguments,
    },
    /// Build the FMU of a scene and pack it as a system (SSP 1.0) with its parameters
    Ssp(SspArguments),
    /// Load an FMU, run the impact of its scene and compare it with the prediction
    #[command(next_line_help = true)]
    Check(check::Arguments),
    /// Predict an impact: largest force and indentation, dent, restitution, contact time
    Predict(predict::Arguments),
    /// Numbers for the contact model of another tool, with their error over a range of speeds
    Translate(translate::Arguments),
    /// Predict a Brinell test: dent and hardness; or find the yield strength from HBW
    Hardness(hardness::Arguments),
    /// Draw or tabulate one cycle of loading, unloading and reloading
    Curve(curve::Arguments),
    /// Measure the FMU of a scene: errors, run times, stability; on one page
    Report(report::Arguments),
    /// List the laws with their error against finite elements, or show one law
    Laws(law_list::Arguments),
    /// Compile the libraries from which FMUs are made where there is no compiler
    #[command(hide = true)]
    Prebuild(PrebuildArguments),
    /// List the built-in materials
    Materials,
    /// Print the JSON Schema of scenes, by which editors complete and check them
    #[command(hide = true)]
    Schema(schema::Arguments),
    /// Print the script that completes the arguments of this program in a shell
    #[command(hide = true)]
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Write the manual pages of this program and its commands
    #[command(hide = true)]
    Man {
        /// The folder for the pages
        #[arg(short, long, value_name = "DIR")]
        output: PathBuf,
    },
    /// Print kind and data of a scene in Rust, as they are compiled into its FMU
    #[command(hide = true)]
    Constants { scene: PathBuf, guid: Option<String> },
    /// Print a scene with all numbers in SI units, for programs that read TOML and know no units
    #[command(hide = true)]
    Si { scene: PathBuf },
    /// Print numbers that have units in SI units, as JSON: "target.yield_strength=400 MPa"
    #[command(hide = true)]
    Numbers { numbers: Vec<String> },
    /// Print a table of measurements with the quantities of its columns, as JSON, or what is wrong with it
    #[command(hide = true)]
    Table(TableArguments),
    /// Unpack an FMU that keeps the rules of this program, for programs that load it
    #[command(hide = true)]
    Unpack { fmu: PathBuf, to: PathBuf },
    /// Prints the Rust source of the prebuilt library that a scene fits into
    #[command(hide = true)]
    Kind { scene: PathBuf },
}

#[derive(clap::Args)]
pub struct TableArguments {
    /// The file; standard input without one
    pub file: Option<PathBuf>,
    /// The decimal sign, where the file leaves it open
    #[arg(long)]
    pub decimal: Option<char>,
    /// The sign between cells, where it is known
    #[arg(long)]
    pub separator: Option<char>,
    /// Other headings for columns, as a JSON object
    #[arg(long, default_value = "{}")]
    pub columns: String,
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
    #[command(flatten)]
    pub platforms: PlatformArguments,
    #[command(flatten)]
    pub way: WayArguments,
}

#[derive(clap::Args, Default)]
pub struct PlatformArguments {
    /// Platforms: linux64, aarch64-linux, win64, darwin64, aarch64-darwin, or "all"; c-code for C source [default: this machine's; if
    /// nothing is compiled, all prebuilt ones except aarch64-darwin, whose library is part of that of darwin64, and c-code]
    #[arg(long, value_delimiter = ',', value_name = "PLATFORM")]
    platforms: Vec<String>,
    /// Put the arm64 library into linux64, for importers on ARM Linux that look only there
    #[arg(long)]
    arm64_in_linux64: bool,
}

impl PlatformArguments {
    /// The platforms for a library that is made in this `way`, each once, in the order of [`Platform::ALL`].
    ///
    /// # Errors
    /// A sentence about a platform that doesn't exist.
    pub fn chosen(&self, way: LibraryWay) -> Result<Vec<Platform>, String> {
        let mut chosen = Vec::new();
        for name in &self.platforms {
            match name.as_str() {
                "all" => chosen.extend(Platform::ALL),
                _ => chosen.push(platform::named(name)?),
            }
        }
        if chosen.is_empty() && !way.compiles() {
            let all = prebuilt::platforms();
            let is_alone = |platform: &&Platform| !all.iter().any(|other| other.has(platform));
            chosen = all.iter().filter(is_alone).filter(|platform| !platform.is_source()).copied().collect();
        }
        if chosen.is_empty() {
            chosen.push(platform::here().map_err(|error| error.to_string())?);
        }
        let all = Platform::ALL.into_iter().chain([Platform::C_CODE]);
        let mut platforms: Vec<_> = all.filter(|platform| chosen.contains(platform)).collect();
        if self.arm64_in_linux64 {
            platforms.retain(|platform| platform.folder != Platform::ARM64_IN_LINUX64.folder);
            platforms.insert(0, Platform::ARM64_IN_LINUX64);
        }
        Ok(platforms)
    }
}

#[derive(clap::Args)]
pub struct WayArguments {
    /// Compile the library, which needs a Rust toolchain [default: if there is one]
    #[arg(long, conflicts_with = "prebuilt")]
    compile: bool,
    /// Fill in a prebuilt library, which needs no toolchain
    #[arg(long)]
    prebuilt: bool,
}

impl WayArguments {
    pub fn chosen(&self) -> LibraryWay {
        match (self.compile, self.prebuilt) {
            (true, _) => LibraryWay::Compiled,
            (_, true) => LibraryWay::Prebuilt,
            _ => LibraryWay::Any,
        }
    }
}

#[derive(clap::Args)]
pub struct PrebuildArguments {
    /// Folder for the libraries
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Kinds, such as state, momentum, moved [default: all]
    #[arg(long, value_delimiter = ',')]
    pub kinds: Vec<String>,
    #[command(flatten)]
    pub platforms: PlatformArguments,
}
