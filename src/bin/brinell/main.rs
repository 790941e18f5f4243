//! `brinell`: exports FMI 2.0 co-simulation units of elastoplastic contact, and checks them.

mod arguments;
mod check;
mod constants;
mod curve;
mod documentation;
mod energy;
mod guard;
mod importer;
mod interface;
mod law_check;
mod law_list;
mod law_text;
mod laws;
mod model;
mod model_description;
mod numbers;
mod package;
mod pairing;
mod parameters;
mod plot;
mod predict;
mod report;
mod scene;
mod summary;
mod symbols;
mod table;
mod truth;
mod validity;

use arguments::{Arguments, Command, CurveArguments, PredictArguments};
use clap::Parser;
use scene::Scene;
use serde_json::json;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use summary::Summary;

const DEFAULT_SCENE: &str = include_str!("../../../scenes/steel_ball.toml");

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
            let scene = Scene::parse(DEFAULT_SCENE.into(), Path::new("scenes/steel_ball.toml"))?;
            let path = export(&scene, None, json)?;
            check(&path, json)
        }
        Some(Command::Export { scene, output }) => {
            export(&Scene::read(scene)?, output.as_deref(), json)?;
            Ok(true)
        }
        Some(Command::Check { fmu }) => check(fmu, json),
        Some(Command::Predict(arguments)) => {
            predict(arguments, json)?;
            Ok(true)
        }
        Some(Command::Curve(arguments)) => {
            curve(arguments)?;
            Ok(true)
        }
        Some(Command::Report { scene, output, peer, quick }) => {
            let scene = Scene::read(scene)?;
            let folder = output.clone().unwrap_or_else(|| format!("{}_report", scene.name).into());
            report(&scene, peer, &folder, *quick, json)
        }
        Some(Command::Laws { output }) => {
            list_laws(output.as_deref(), json)?;
            Ok(true)
        }
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
    let summary = Summary::of(scene);
    if as_json {
        println!("{}", summary.json(&exported));
    } else {
        summary.print(&exported);
    }
    Ok(exported.path)
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

fn report(scene: &Scene, peers: &[PathBuf], folder: &Path, quick: bool, as_json: bool) -> Result<bool, Box<dyn Error>> {
    let report = report::Report::of(scene, peers, quick)?;
    let page = report.write_into(folder)?;
    if as_json {
        println!("{}", report.json());
    } else {
        println!("{}\n{}", report.summary.join("\n"), page.display());
    }
    Ok(report.passed())
}

fn materials(as_json: bool) -> Result<(), Box<dyn Error>> {
    if as_json {
        println!("{}", serde_json::to_string(&*table::MATERIALS)?);
        return Ok(());
    }
    println!("{:<22} {:>10} {:>8} {:>10} {:>13}   source", "material", "E [GPa]", "nu", "S [MPa]", "rho [kg/m^3]");
    for material in table::MATERIALS.iter() {
        let (modulus, strength) = (1e-9 * material.youngs_modulus, 1e-6 * material.yield_strength);
        println!(
            "{:<22} {modulus:>10.1} {:>8} {strength:>10.0} {:>13}   {}",
            material.name, material.poissons_ratio, material.density, material.source
        );
    }
    Ok(())
}

/// Prints `text`, or writes it where the user wants it.
fn deliver(text: &str, output: Option<&Path>) -> Result<(), Box<dyn Error>> {
    match output {
        None => print!("{text}"),
        Some(path) => package::write_whole(path, text.as_bytes())?,
    }
    Ok(())
}

/// The ending of the file that `output` names, one of `allowed`; without a file the first of them.
fn ending(output: Option<&Path>, allowed: &[&'static str]) -> Result<&'static str, String> {
    let Some(path) = output else { return Ok(allowed[0]) };
    let given = path.extension().and_then(|extension| extension.to_str());
    allowed.iter().copied().find(|&ending| given == Some(ending)).ok_or_else(|| {
        let (last, others) = allowed.split_last().expect("something is allowed");
        let others = others.iter().map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ");
        format!("{}: the name must end in {others} or .{last}", path.display())
    })
}

fn predict(arguments: &PredictArguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let scene = Scene::read(&arguments.scene)?;
    let choices = laws::choose(&scene, &arguments.laws)?;
    let mass = predict::positive("mass", arguments.mass.unwrap_or(scene.impact.mass))?;
    let speed = match (arguments.speed, arguments.energy, arguments.drop_height) {
        (Some(speed), ..) => predict::positive("speed", speed)?,
        (_, Some(energy), _) => predict::speed_of_energy(mass, predict::positive("energy", energy)?),
        (.., Some(height)) => predict::speed_of_height(predict::positive("drop-height", height)?),
        _ => scene.impact.speed,
    };
    let impact = brinell::contact::impact::Impact { mass, speed };
    if let Some(sweep) = &arguments.sweep {
        let range = predict::sweep::parse(sweep)?;
        let output = arguments.output.as_deref();
        let ending = ending(output, &["csv", "svg", "html"])?;
        let sweep = predict::sweep::Sweep::of(&choices, mass, range)?;
        let text = match ending {
            "html" => predict::page::write(&scene, &sweep),
            "svg" => sweep.svg(),
            _ => sweep.csv(),
        };
        return deliver(&text, output);
    }
    if let Some(dent) = arguments.dent {
        return invert(&choices, &impact, predict::positive("dent", dent)?, as_json);
    }
    if let Some(measured) = arguments.restitution {
        let goal = predict::rebound::measured(measured)?;
        let rebounds = predict::rebound::explain(&choices, &impact, goal)?;
        if as_json {
            println!("{}", predict::rebound::as_json(&rebounds, &impact, goal));
        } else {
            print!("{}", predict::rebound::text(&rebounds, &impact, goal));
        }
        return Ok(());
    }
    let density = scene.contacts[0].density;
    if as_json {
        println!("{}", predict::as_json(&choices, &impact, density)?);
    } else {
        print!("{}", predict::text(&choices, &impact, density)?);
    }
    Ok(())
}

/// Which speed makes `dent` [m], and which yield strength explains it after `impact`.
fn invert(
    choices: &[laws::Choice],
    impact: &brinell::contact::impact::Impact,
    dent: f64,
    as_json: bool,
) -> Result<(), Box<dyn Error>> {
    let mut answers = Vec::new();
    for choice in choices {
        let speed = predict::inverse::speed_of_dent(choice, impact.mass, dent)?;
        let strength = predict::inverse::strength_of_dent(choice, impact, dent)?;
        if as_json {
            answers.push(json!({ "law": choice.name, "speed": speed, "yield_strength": strength }));
        } else {
            println!("{}: a dent of {dent:e} m is made", choice.name);
            println!("  at a speed of {speed:.6e} m/s, or");
            println!("  at {} m/s in a target with a yield strength of {strength:.6e} Pa", impact.speed);
        }
    }
    if as_json {
        println!("{}", json!({ "dent": dent, "mass": impact.mass, "impact_speed": impact.speed, "laws": answers }));
    }
    Ok(())
}

fn curve(arguments: &CurveArguments) -> Result<(), Box<dyn Error>> {
    let scene = Scene::read(&arguments.scene)?;
    let choices = laws::choose(&scene, &arguments.laws)?;
    let predicted = || interface::prediction(&scene).max_indentation;
    let largest = predict::positive("to", arguments.to.unwrap_or_else(predicted))?;
    let output = arguments.output.as_deref();
    let picture = ending(output, &["csv", "svg"])? == "svg";
    let impact = &scene.impact;
    let drawn = match picture {
        true => curve::svg(&choices, largest, impact, arguments.truth),
        false => curve::csv(&choices, largest, impact),
    };
    let too_deep = |_: brinell::contact::TooDeep| format!("to = {largest:e} m is too deep for the law");
    deliver(&drawn.map_err(too_deep)?, output)
}

fn list_laws(output: Option<&Path>, as_json: bool) -> Result<(), Box<dyn Error>> {
    let scene = Scene::parse(DEFAULT_SCENE.into(), Path::new("scenes/steel_ball.toml"))?;
    if output.is_some() {
        if ending(output, &["csv", "svg"])? == "csv" {
            return Err("the loading curves are a picture: the name must end in .svg".into());
        }
        let choices = laws::choose(&scene, &["all".to_string()])?;
        return deliver(&curve::over_hertz(&choices), output);
    }
    let list = law_list::all(&scene);
    if as_json {
        println!("{}", serde_json::to_string(&list)?);
    } else {
        law_list::print(&list);
    }
    Ok(())
}
