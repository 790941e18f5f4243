//! `brinell`: exports FMI 2.0 co-simulation units of elastoplastic contact, and checks them.
#![deny(unsafe_code)]

mod about;
mod arguments;
mod bodies;
mod check;
mod constants;
mod curve;
mod documentation;
mod energy;
mod export;
mod files;
mod guard;
mod html;
mod importer;
mod interface;
mod law_check;
mod law_list;
mod law_text;
mod laws;
mod materials;
mod model;
mod model_description;
mod nominal;
mod numbers;
mod package;
mod pairing;
mod parameters;
mod plan;
mod platform;
mod plot;
mod prebuilt;
mod prebuilt_folder;
mod predict;
mod report;
mod scene;
mod ssp;
mod summary;
mod symbols;
mod table;
mod toolchain;
mod truth;
mod validity;
mod xml;

use arguments::{Arguments, Command, PlatformArguments};
use clap::Parser;
use package::Way;
use plan::Plan;
use scene::Scene;
use std::error::Error;
use std::process::ExitCode;

fn main() -> ExitCode {
    leave_quietly_when_nobody_reads();
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("brinell: {error}");
            ExitCode::FAILURE
        }
    }
}

/// How the error of a pipe that its reader has closed ends: `EPIPE` on Unix, `ERROR_BROKEN_PIPE` and `ERROR_NO_DATA` on Windows.
const CLOSED_PIPE: &[&str] = if cfg!(windows) { &["(os error 109)", "(os error 232)"] } else { &["(os error 32)"] };

/// A reader like `head` may close the pipe before all is printed: that is the end of the job, and no fault of the program.
fn leave_quietly_when_nobody_reads() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let message = panic.payload().downcast_ref::<String>().map_or("", String::as_str);
        if message.starts_with("failed printing to stdout") && CLOSED_PIPE.iter().any(|code| message.ends_with(code)) {
            std::process::exit(0);
        }
        usual(panic);
    }));
}

/// Does what is asked for; false if the job is done and its result is bad.
fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let json = arguments.json;
    if arguments.version {
        about::version(json);
        return Ok(true);
    }
    match &arguments.command {
        None => {
            let platforms = PlatformArguments::default().chosen(Way::Any)?;
            let unit = export::run(&Scene::default_scene()?, (Way::Any, &platforms), None, json)?;
            return check::run(&unit, json);
        }
        Some(Command::Check { fmu }) => return check::run(fmu, json),
        Some(Command::Report { scene, output, peer, quick }) => {
            return Ok(report::run(&Scene::read(scene)?, peer, output.as_deref(), *quick, json)?);
        }
        Some(Command::Export { scene, output, platforms, way }) => {
            let way = way.chosen();
            export::run(&Scene::read(scene)?, (way, &platforms.chosen(way)?), output.as_deref(), json)?;
        }
        Some(Command::Prebuild(arguments)) => prebuilt::command::run(arguments, json)?,
        Some(Command::Ssp(arguments)) => ssp::run(arguments, json)?,
        Some(Command::Predict(arguments)) => predict::command::run(arguments, json)?,
        Some(Command::Curve(arguments)) => curve::run(arguments)?,
        Some(Command::Laws { output }) => law_list::run(output.as_deref(), json)?,
        Some(Command::Materials) => materials::run(json),
        Some(Command::Completions { shell }) => about::completions(*shell)?,
        Some(Command::Man { output }) => about::manual(output)?,
        Some(Command::Constants { scene }) => {
            print!("{}", constants::write(&Plan::of(&Scene::read(scene)?), "unpacked"));
        }
        Some(Command::Kind { scene }) => {
            let library = prebuilt::Library::of(&Scene::read(scene)?)?;
            print!("{}", constants::kind::write(&library.scene, "unpacked"));
        }
    }
    Ok(true)
}
