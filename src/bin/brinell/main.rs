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
mod predict;
mod report;
mod scene;
mod ssp;
mod summary;
mod symbols;
mod table;
mod truth;
mod validity;
mod xml;

use arguments::{Arguments, Command};
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
        None => return check::run(&export::run(&Scene::default_scene()?, Way::Any, None, json)?, json),
        Some(Command::Check { fmu }) => return check::run(fmu, json),
        Some(Command::Report { scene, output, peer, quick }) => {
            return Ok(report::run(&Scene::read(scene)?, peer, output.as_deref(), *quick, json)?);
        }
        Some(Command::Export { scene, output, way }) => {
            export::run(&Scene::read(scene)?, way.chosen(), output.as_deref(), json)?;
        }
        Some(Command::Prebuild(arguments)) => prebuilt::command::run(arguments, json)?,
        Some(Command::Ssp(arguments)) => ssp::run(arguments, json)?,
        Some(Command::Predict(arguments)) => predict::command::run(arguments, json)?,
        Some(Command::Curve(arguments)) => curve::run(arguments)?,
        Some(Command::Laws { output }) => law_list::run(output.as_deref(), json)?,
        Some(Command::Materials) => materials::run(json),
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
