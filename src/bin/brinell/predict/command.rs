//! The command `predict`: what is asked, and in which form the answer goes out.

use super::sweep::{self, Sweep};
use super::{PredictError, inverse, page, rebound};
use crate::arguments::PredictArguments;
use crate::files::{deliver, ending};
use crate::laws::{self, Choice};
use crate::scene::Scene;
use brinell::contact::impact::Impact;
use serde_json::json;
use std::error::Error;

/// Answers what the arguments ask.
pub fn run(arguments: &PredictArguments, as_json: bool) -> Result<(), Box<dyn Error>> {
    let scene = Scene::read(&arguments.scene)?;
    let choices = laws::choose(&scene, &arguments.laws)?;
    let impact = impact(&scene, arguments)?;
    if let Some(range) = &arguments.sweep {
        return sweep(&scene, &choices, impact.mass, range, arguments);
    }
    if let Some(dent) = arguments.dent {
        return Ok(invert(&choices, &impact, super::positive("dent", dent)?, as_json)?);
    }
    if let Some(measured) = arguments.restitution {
        let goal = rebound::measured(measured)?;
        let rebounds = rebound::explain(&choices, &impact, goal)?;
        if as_json {
            println!("{}", rebound::as_json(&rebounds, &impact, goal));
        } else {
            print!("{}", rebound::text(&rebounds, &impact, goal));
        }
        return Ok(());
    }
    let density = scene.contacts[0].density;
    if as_json {
        println!("{}", super::as_json(&choices, &impact, density)?);
    } else {
        print!("{}", super::text(&choices, &impact, density)?);
    }
    Ok(())
}

/// The scene's impact, with what the arguments say instead.
fn impact(scene: &Scene, arguments: &PredictArguments) -> Result<Impact, PredictError> {
    let mass = super::positive("mass", arguments.mass.unwrap_or(scene.impact_of(0).mass))?;
    let speed = match (arguments.speed, arguments.energy, arguments.drop_height) {
        (Some(speed), ..) => super::positive("speed", speed)?,
        (_, Some(energy), _) => super::speed_of_energy(mass, super::positive("energy", energy)?),
        (.., Some(height)) => super::speed_of_height(super::positive("drop-height", height)?),
        _ => scene.impact.speed,
    };
    let impact = Impact { mass, speed };
    super::check_energy(&impact)?;
    Ok(impact)
}

/// Impacts over a range of speeds, as a table, a picture or a page.
fn sweep(
    scene: &Scene,
    choices: &[Choice],
    mass: f64,
    range: &[String],
    arguments: &PredictArguments,
) -> Result<(), Box<dyn Error>> {
    let range = sweep::parse(range)?;
    let output = arguments.output.as_deref();
    let ending = ending(output, &["csv", "svg", "html"])?;
    let sweep = Sweep::of(choices, mass, range)?;
    let text = match ending {
        "html" => page::write(scene, choices, &sweep),
        "svg" => sweep.svg(),
        _ => sweep.csv(),
    };
    Ok(deliver(&text, output)?)
}

/// Which speed makes `dent` [m], and which yield strength explains it after `impact`.
fn invert(choices: &[Choice], impact: &Impact, dent: f64, as_json: bool) -> Result<(), PredictError> {
    let mut answers = Vec::new();
    for choice in choices {
        let speed = inverse::speed_of_dent(choice, impact.mass, dent)?;
        let strength = inverse::strength_of_dent(choice, impact, dent)?;
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
