//! `brinell`: exports FMI 2.0 co-simulation FMUs of elastoplastic contact, and checks them.
//!
//! | module | what it has |
//! |---|---|
//! | `messages`, `files`, `temporary`, `parallel`, `scene_file` | standard error, the user's files, processors |
//! | `sources`, `prebuilt`, `package` | the library of an FMU: compiled, or filled in |
//! | `importer`, `master` | an FMU behind its C interface, and who moves the bodies |
//! | `export`, `check`, `predict`, `report`, and others | the commands, one module each |
//! | `arguments` | the command line |
//!
//! What needs neither files nor processes is in the crate `brinell-exporter`.
#![cfg(feature = "exporter")]
#![deny(unsafe_code)]

mod about;
mod app;
mod arguments;
mod check;
mod curve;
mod export;
mod files;
mod hardness;
mod importer;
mod law_list;
mod master;
mod materials;
mod messages;
mod new;
mod package;
mod parallel;
mod prebuild;
mod prebuilt;
mod predict;
mod report;
mod scene_file;
mod schema;
mod sources;
mod ssp;
mod summary;
mod temporary;
mod translate;
mod unpack;

use arguments::{Arguments, Command, PlatformArguments, TableArguments};
use brinell_exporter::layout::json_line;
use brinell_exporter::measurement::{self, Choices};
use brinell_exporter::package::GUID_TO_COME;
use brinell_exporter::plan::Plan;
use brinell_exporter::prebuilt::Library;
use brinell_exporter::predict::axis;
use brinell_exporter::{library, numbers};
use clap::Parser;
use messages::WrongCall;
use package::LibraryWay;
use std::collections::BTreeMap;
use std::error::Error;
use std::process::ExitCode;

/// What tests of parts look at.
pub mod parts {
    pub use crate::files::{installed_with, write_whole};
    pub use crate::importer::{BoundedArchive, Description};
    pub use crate::messages::{held, wrapped};
    pub use crate::package::error::how_to_install;
    pub use crate::package::folder::cache_folder;
    pub use crate::package::parts::LIBM;
    pub use crate::parallel::each;
    pub use crate::prebuilt::folder::PrebuiltFolder;
    pub use crate::report::card::{facts, readings};
    pub use crate::temporary::{ABANDONED, DRAFT, LOCKED, PrivateFolder, draft_in};
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    leave_when_nothing_can_be_printed();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return not_understood(&error),
    };
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            messages::tell(&format!("brinell: {error}"));
            if error.is::<WrongCall>() { ExitCode::from(WRONG_CALL) } else { ExitCode::FAILURE }
        }
    }
}

/// The exit status for a wrong command line.
const WRONG_CALL: u8 = 2;

/// Prints help, the version, or the error in the arguments, in the style of all other errors.
fn not_understood(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // it is not an error if the reader has closed the pipe
        return match error.print() {
            Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
                messages::tell(&format!("brinell: {UNWRITABLE}: {error}"));
                ExitCode::FAILURE
            }
            _ => ExitCode::SUCCESS,
        };
    }
    let text = numbers::in_words(&error.render().to_string());
    messages::tell(&format!("brinell: {}", text.strip_prefix("error: ").unwrap_or(&text).trim_end()));
    ExitCode::from(WRONG_CALL)
}

/// The end of the error text for a pipe that its reader has closed: `EPIPE` on Unix, `ERROR_BROKEN_PIPE` and `ERROR_NO_DATA` on
/// Windows.
const CLOSED_PIPE: &[&str] = if cfg!(windows) { &["(os error 109)", "(os error 232)"] } else { &["(os error 32)"] };

/// The beginning of the message about a full disk, or the like.
const UNWRITABLE: &str = "standard output can't be written to";

/// A reader such as `head` may close the pipe before everything is printed. This ends the program and is not an error. That the
/// output can't be written, because a disk is full, is one.
fn leave_when_nothing_can_be_printed() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let message = panic.payload().downcast_ref::<String>().map_or("", String::as_str);
        let Some(reason) = message.strip_prefix("failed printing to stdout: ") else { return usual(panic) };
        if !CLOSED_PIPE.iter().any(|code| reason.ends_with(code)) {
            messages::tell(&format!("brinell: {UNWRITABLE}: {reason}"));
            std::process::exit(1);
        }
        std::process::exit(0);
    }));
}

/// Runs a command. Returns false if it has finished with a negative result.
fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let json = arguments.json;
    if arguments.version {
        about::version(json);
        return Ok(true);
    }
    match &arguments.command {
        None => {
            let platforms = PlatformArguments::default().chosen(LibraryWay::Any)?;
            let scene = scene_file::default_scene()?;
            let unit = export::run((&scene, None), (LibraryWay::Any, &platforms), None, json)?;
            let agrees = check::exported(&unit, json)?;
            if !json {
                print!("\n{}", brinell_exporter::predict::by_the_default_law(&scene)?);
            }
            return Ok(agrees);
        }
        Some(Command::Check(arguments)) => return Ok(check::run(arguments, json)?),
        Some(Command::Report(arguments)) => return report::run(arguments, json),
        Some(Command::Export { scene, output, platforms, way }) => {
            let way = way.chosen();
            let scene = (&scene_file::read_aloud(scene)?, Some(scene.as_path()));
            export::run(scene, (way, &platforms.chosen(way)?), output.as_deref(), json)?;
        }
        Some(Command::Prebuild(arguments)) => prebuild::run(arguments, json)?,
        Some(Command::App(arguments)) => app::run(arguments, json)?,
        Some(Command::New(arguments)) => new::run(arguments, json)?,
        Some(Command::Ssp(arguments)) => ssp::run(arguments, json)?,
        Some(Command::Predict(arguments)) => predict::run(arguments, json)?,
        Some(Command::Translate(arguments)) => translate::run(arguments, json)?,
        Some(Command::Hardness(arguments)) => hardness::run(arguments, json)?,
        Some(Command::Curve(arguments)) => curve::run(arguments, json)?,
        Some(Command::Laws(arguments)) => law_list::run(arguments, json)?,
        Some(Command::Schema(arguments)) => schema::run(arguments)?,
        Some(Command::Materials) => materials::run(json)?,
        Some(Command::Completions { shell }) => about::completions(*shell),
        Some(Command::Man { output }) => about::manual(output)?,
        Some(Command::Constants { scene, guid }) => {
            let scene = scene_file::read(scene)?;
            print!("{}", library::write(&Plan::of(&scene), guid.as_deref().unwrap_or(GUID_TO_COME)));
        }
        Some(Command::Si { scene }) => print!("{}", scene_file::in_si(scene)?),
        Some(Command::Numbers { numbers }) => {
            let numbers = numbers.iter().map(|words| axis::in_si(words)).collect::<Result<Vec<_>, _>>();
            print!("{}", json_line(&serde_json::json!(numbers.map_err(WrongCall)?)));
        }
        Some(Command::Table(arguments)) => {
            let renamed: BTreeMap<String, String> = serde_json::from_str(&arguments.columns).map_err(WrongCall::of)?;
            let TableArguments { decimal, separator, .. } = *arguments;
            let choices = Choices { decimal, separator, renamed: renamed.into_iter().collect() };
            let bytes = scene_file::bytes_or_standard_input(arguments.file.as_deref())?;
            let table = measurement::read(&bytes, &choices).and_then(|table| table.json());
            print!("{}", json_line(&table.unwrap_or_else(|wrong| serde_json::json!({ "wrong": wrong }))));
        }
        Some(Command::Unpack { fmu, to }) => unpack::run(fmu, to)?,
        Some(Command::Kind { scene }) => {
            let library = Library::of(&scene_file::read(scene)?);
            print!("{}", library.source_with("unpacked"));
        }
    }
    Ok(true)
}
