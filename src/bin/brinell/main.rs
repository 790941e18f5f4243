//! `brinell`: exports FMI 2.0 co-simulation units of elastoplastic contact, and checks them.
#![deny(unsafe_code)]

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
mod merge;
mod model;
mod model_description;
mod nominal;
mod numbers;
mod package;
mod pairing;
mod parallel;
mod parameters;
mod plan;
mod platform;
mod plot;
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

/// A reader like `head` may close the pipe before all is printed: that is the end of the job, and no fault of the program.
fn leave_quietly_when_nobody_reads() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let message = panic.payload().downcast_ref::<String>().map_or("", String::as_str);
        if message.starts_with("failed printing to stdout") && message.contains("Broken pipe") {
            std::process::exit(0);
        }
        usual(panic);
    }));
}

/// Does what is asked for; false if the job is done and its result is bad.
fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let json = arguments.json;
    match &arguments.command {
        None => {
            let platforms = PlatformArguments::default().chosen()?;
            return check::run(&export::run(&Scene::default_scene()?, &platforms, None, json)?, json);
        }
        Some(Command::Check { fmu }) => return check::run(fmu, json),
        Some(Command::Report { scene, output, peer, quick }) => {
            return Ok(report::run(&Scene::read(scene)?, peer, output.as_deref(), *quick, json)?);
        }
        Some(Command::Export { scene, output, platforms }) => {
            export::run(&Scene::read(scene)?, &platforms.chosen()?, output.as_deref(), json)?;
        }
        Some(Command::Ssp(arguments)) => ssp::run(arguments, json)?,
        Some(Command::Predict(arguments)) => predict::command::run(arguments, json)?,
        Some(Command::Curve(arguments)) => curve::run(arguments)?,
        Some(Command::Laws { output }) => law_list::run(output.as_deref(), json)?,
        Some(Command::Merge { fmus, output }) => merge::run(fmus, output, json)?,
        Some(Command::Toolchain { folder, std, mirror }) => {
            toolchain::run(&toolchain::Wanted { folder: folder.as_deref(), std: *std, mirror }, json)?;
        }
        Some(Command::Materials) => materials::run(json),
        Some(Command::Constants { scene }) => {
            print!("{}", constants::write(&Plan::of(&Scene::read(scene)?), "unpacked"));
        }
    }
    Ok(true)
}
