//! `brinell`: exports FMI 2.0 co-simulation units of elastoplastic contact, and checks them.

mod check;
mod constants;
mod documentation;
mod importer;
mod interface;
mod model_description;
mod package;
mod scene;
mod symbols;
mod table;

use clap::{Parser, Subcommand};
use scene::Scene;
use serde_json::json;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Exports FMI 2.0 co-simulation units of elastoplastic contact.
///
/// Without a command: exports the default scene into the current folder and checks the result.
#[derive(Parser)]
#[command(version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Results as JSON
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Builds and packs the unit of a scene
    Export {
        /// The scene file (TOML)
        scene: PathBuf,
        /// Where to write the unit [default: NAME.fmu in the current folder]
        #[arg(short, long)]
        output: Option<PathBuf>,
    },
    /// Loads a unit as an importer would, runs the impact of its scene, compares it with the energy balance
    Check {
        /// The unit
        fmu: PathBuf,
    },
    /// Lists the built-in materials
    Materials,
    /// Prints the Rust constants of a scene, as they are compiled into its unit
    #[command(hide = true)]
    Constants { scene: PathBuf },
}

const DEFAULT_SCENE: &str = include_str!("../../../scenes/steel_ball.toml");

fn main() -> ExitCode {
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

/// Does what is asked for; false if the job is done and its result is bad.
fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let json = arguments.json;
    match &arguments.command {
        None => {
            let scene = Scene::parse(DEFAULT_SCENE.into(), Path::new("scenes/steel_ball.toml"))?;
            let path = export(&scene, None, json)?;
            check(&path, json)
        }
        Some(Command::Export { scene, output }) => {
            export(&Scene::read(scene)?, output.as_deref(), json)?;
            Ok(true)
        }
        Some(Command::Check { fmu }) => check(fmu, json),
        Some(Command::Materials) => {
            materials(json)?;
            Ok(true)
        }
        Some(Command::Constants { scene }) => {
            let scene = Scene::read(scene)?;
            print!("{}", constants::write(&scene, &interface::entries(&scene), "unpacked"));
            Ok(true)
        }
    }
}

fn export(scene: &Scene, output: Option<&Path>, as_json: bool) -> Result<PathBuf, Box<dyn Error>> {
    let path = output.map_or_else(|| format!("{}.fmu", scene.name).into(), Path::to_path_buf);
    eprintln!("building {} ...", path.display());
    let exported = package::export(scene, &path)?;
    let entries = interface::entries(scene);
    let names: Vec<_> = entries.iter().map(|entry| entry.variable.name.as_str()).collect();
    let left_out: Vec<_> =
        table::VARIABLES.iter().map(|v| v.name.as_str()).filter(|name| !names.contains(name)).collect();
    let constants: Vec<_> = scene.parameters.iter().filter(|parameter| !parameter.settable).collect();
    if as_json {
        let constants: Vec<_> = constants.iter().map(|constant| constant.name).collect();
        println!(
            "{}",
            json!({
                "fmu": exported.path, "guid": exported.guid, "size": exported.size, "library_size": exported.library_size,
                "imports": exported.imports, "variables": names, "left_out": left_out, "constants": constants,
            })
        );
        return Ok(exported.path);
    }
    println!("{}", exported.path.display());
    println!(
        "  {} bytes, library {} bytes; needs no library, takes {} from the process",
        exported.size,
        exported.library_size,
        exported.imports.join(", ")
    );
    println!("  law        {}", law(scene));
    println!("  variables  {}", names.join(", "));
    for constant in constants {
        println!("  constant   {} = {:?}", constant.name, constant.value);
    }
    println!("  left out   {}", left_out.join(", "));
    Ok(exported.path)
}

fn law(scene: &Scene) -> String {
    match scene.unloading {
        Some((unloading, _)) => format!("{}, unloading by {unloading}", scene.loading.0),
        None => format!("{} (elastic)", scene.loading.0),
    }
}

fn check(path: &Path, as_json: bool) -> Result<bool, Box<dyn Error>> {
    let outcome = check::check(path)?;
    if as_json {
        println!("{}", serde_json::to_string(&outcome)?);
    } else {
        print!("{outcome}");
    }
    Ok(outcome.passed)
}

fn materials(as_json: bool) -> Result<(), Box<dyn Error>> {
    if as_json {
        println!("{}", serde_json::to_string(&*table::MATERIALS)?);
        return Ok(());
    }
    println!("{:<22} {:>10} {:>8} {:>10}   source", "material", "E [GPa]", "nu", "S [MPa]");
    for material in table::MATERIALS.iter() {
        let (modulus, strength) = (1e-9 * material.youngs_modulus, 1e-6 * material.yield_strength);
        println!(
            "{:<22} {modulus:>10.1} {:>8} {strength:>10.0}   {}",
            material.name, material.poissons_ratio, material.source
        );
    }
    Ok(())
}
