//! `brinell predict`: what an impact will do, by energy balance, and the same turned round.

use crate::laws::Choice;
use crate::plot::{Picture, Series};
use brinell::contact::impact::{Impact, Prediction, predict};
use brinell::contact::{Loading, Pair};
use serde_json::{Value, json};
use std::fmt::Write;

/// Standard gravity [m/s^2].
const GRAVITY: f64 = 9.80665;

/// An impact that nothing can be said of.
#[derive(Debug, thiserror::Error)]
pub enum PredictError {
    #[error("{name} = {value} must be positive and finite")]
    NotPositive { name: &'static str, value: f64 },
    #[error("the impact of {mass} kg at {speed} m/s is beyond what the law {law} can be evaluated for")]
    Beyond { law: String, mass: f64, speed: f64 },
    #[error("no {what} between {low:e} and {high:e} explains {name} = {value}")]
    NoSolution { what: &'static str, low: f64, high: f64, name: &'static str, value: f64 },
    #[error("--sweep {0}: expected `speed FROM:TO`, in m/s, with 0 < FROM < TO")]
    Sweep(String),
}

/// Refuses what isn't positive and finite.
pub fn positive(name: &'static str, value: f64) -> Result<f64, PredictError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(PredictError::NotPositive { name, value }) }
}

/// The speed [m/s] of `mass` [kg] with a kinetic energy [J].
pub fn speed_of_energy(mass: f64, energy: f64) -> f64 {
    (2.0 * energy / mass).sqrt()
}

/// The speed [m/s] after a fall from `height` [m].
pub fn speed_of_height(height: f64) -> f64 {
    (2.0 * GRAVITY * height).sqrt()
}

/// The prediction for `choice`.
pub fn one(choice: &Choice, impact: &Impact) -> Result<Prediction, PredictError> {
    let beyond = || PredictError::Beyond { law: choice.name.clone(), mass: impact.mass, speed: impact.speed };
    predict(&choice.model, impact).ok_or_else(beyond)
}

/// The quantities of a prediction: name, value, unit.
fn quantities(prediction: &Prediction) -> [(&'static str, f64, &'static str); 9] {
    [
        ("largest force", prediction.max_force, "N"),
        ("largest indentation", prediction.max_indentation, "m"),
        ("largest contact radius", prediction.max_contact_radius, "m"),
        ("dent", prediction.residual_indentation, "m"),
        ("restitution", prediction.restitution, ""),
        ("kinetic energy", prediction.energy, "J"),
        ("energy lost", prediction.energy - prediction.rebound_energy, "J"),
        ("loading time", prediction.loading_time, "s"),
        ("unloading time", prediction.unloading_time, "s"),
    ]
}

/// The speeds [m/s] at which the contact first yields and becomes fully plastic on `choice`, where it does.
fn onsets(choice: &Choice, mass: f64) -> Vec<(i32, f64)> {
    let law = choice.model.loading;
    let pair = choice.model.pair;
    let mut onsets = Vec::new();
    let mut regime = law.regime(&pair, 0.0) as i32;
    let mut corner = law.next_corner(&pair, 0.0);
    while corner < brinell::contact::history::LARGEST_INDENTATION {
        let above = law.regime(&pair, corner) as i32;
        if above != regime {
            onsets.push((above, (2.0 * law.work(&pair, corner) / mass).sqrt()));
            regime = above;
        }
        corner = law.next_corner(&pair, corner);
    }
    onsets
}

/// The predictions as a table for people.
pub fn text(choices: &[Choice], impact: &Impact) -> Result<String, PredictError> {
    let mut text = format!("impact of {} kg at {} m/s, by energy balance\n\n", impact.mass, impact.speed);
    let predictions = choices.iter().map(|choice| one(choice, impact)).collect::<Result<Vec<_>, _>>()?;
    let add = |text: &mut String, line: std::fmt::Arguments| text.write_fmt(line).expect("a String takes everything");
    add(&mut text, format_args!("{:<24}", ""));
    for choice in choices {
        add(&mut text, format_args!("{:>22}", choice.name));
    }
    for quantity in 0..quantities(&predictions[0]).len() {
        let (name, _, unit) = quantities(&predictions[0])[quantity];
        add(&mut text, format_args!("\n{name:<24}"));
        for prediction in &predictions {
            add(&mut text, format_args!("{:>22.6e}", quantities(prediction)[quantity].1));
        }
        add(&mut text, format_args!(" {unit}"));
    }
    add(&mut text, format_args!("\n{:<24}", "regime reached"));
    for prediction in &predictions {
        add(&mut text, format_args!("{:>22}", prediction.regime as i32));
    }
    for choice in choices {
        for (regime, speed) in onsets(choice, impact.mass) {
            add(&mut text, format_args!("\n{}: regime {regime} begins at {speed:.6e} m/s", choice.name));
        }
    }
    text.push_str("\n\nregimes: 1 elastic, 2 and 3 elastoplastic, 4 fully plastic\n");
    Ok(text)
}

/// The predictions for a program.
pub fn as_json(choices: &[Choice], impact: &Impact) -> Result<Value, PredictError> {
    let mut laws = Vec::new();
    for choice in choices {
        let prediction = one(choice, impact)?;
        let mut law = json!({ "law": choice.name, "regime": prediction.regime as i32 });
        for (name, value, _) in quantities(&prediction) {
            law[name.replace(' ', "_")] = json!(value);
        }
        law["onsets"] = onsets(choice, impact.mass)
            .into_iter()
            .map(|(regime, speed)| json!({ "regime": regime, "speed": speed }))
            .collect();
        laws.push(law);
    }
    Ok(json!({ "mass": impact.mass, "speed": impact.speed, "laws": laws }))
}

/// A range of speeds, as `--sweep speed FROM:TO` says it.
pub fn parse_sweep(words: &[String]) -> Result<(f64, f64), PredictError> {
    let wrong = || PredictError::Sweep(words.join(" "));
    let [quantity, range] = words else { return Err(wrong()) };
    let (from, to) = range.split_once(':').ok_or_else(wrong)?;
    let (from, to): (f64, f64) = (from.parse().map_err(|_| wrong())?, to.parse().map_err(|_| wrong())?);
    if quantity == "speed" && from > 0.0 && to > from && to.is_finite() { Ok((from, to)) } else { Err(wrong()) }
}

/// Speeds of a sweep, evenly spread over its decades.
fn speeds((from, to): (f64, f64)) -> Vec<f64> {
    const SPEEDS: u32 = 200;
    (0..=SPEEDS).map(|index| from * (to / from).powf(f64::from(index) / f64::from(SPEEDS))).collect()
}

/// A sweep as a table.
pub fn sweep_csv(choices: &[Choice], mass: f64, range: (f64, f64)) -> Result<String, PredictError> {
    let mut text = String::from(
        "law,speed_m_per_s,largest_force_N,largest_indentation_m,largest_contact_radius_m,dent_m,restitution,\
         kinetic_energy_J,energy_lost_J,loading_time_s,unloading_time_s,regime\n",
    );
    for choice in choices {
        for speed in speeds(range) {
            let prediction = one(choice, &Impact { mass, speed })?;
            write!(text, "{},{speed:e}", choice.name).expect("a String takes everything");
            for (_, value, _) in quantities(&prediction) {
                write!(text, ",{value:e}").expect("a String takes everything");
            }
            writeln!(text, ",{}", prediction.regime as i32).expect("a String takes everything");
        }
    }
    Ok(text)
}

/// A sweep as a picture of restitution against speed.
pub fn sweep_svg(choices: &[Choice], mass: f64, range: (f64, f64)) -> Result<String, PredictError> {
    let mut series = Vec::new();
    for choice in choices {
        let point = |speed: f64| Ok((speed, one(choice, &Impact { mass, speed })?.restitution));
        let points = speeds(range).into_iter().map(point).collect::<Result<Vec<_>, PredictError>>()?;
        series.push(Series { label: choice.name.clone(), points, dots: false });
    }
    let picture = Picture {
        x_title: "speed [m/s]".into(),
        y_title: "coefficient of restitution".into(),
        logarithmic: (true, false),
        series,
    };
    Ok(picture.svg(860, 480))
}

/// The speed [m/s] at which `mass` [kg] leaves a dent of `dent` [m].
pub fn speed_of_dent(choice: &Choice, mass: f64, dent: f64) -> Result<f64, PredictError> {
    // a speed too high for the law makes a dent deeper than any
    let depth = |speed: f64| one(choice, &Impact { mass, speed }).map_or(f64::INFINITY, |p| p.residual_indentation);
    root("speed [m/s]", (1e-9, 1e6), ("dent", dent), depth)
}

/// The yield strength [Pa] for which the impact leaves a dent of `dent` [m]: the Brinell test turned round.
pub fn strength_of_dent(choice: &Choice, impact: &Impact, dent: f64) -> Result<f64, PredictError> {
    let depth = |yield_strength: f64| {
        let pair = Pair { yield_strength, ..choice.model.pair };
        let softer = Choice { name: choice.name.clone(), model: brinell::contact::Model { pair, ..choice.model } };
        // the dent falls with the strength; a target too soft for the law has the deepest
        one(&softer, impact).map_or(f64::NEG_INFINITY, |prediction| -prediction.residual_indentation)
    };
    let modulus = choice.model.pair.modulus;
    root("yield strength [Pa]", (1e-7 * modulus, modulus), ("dent", -dent), depth)
}

/// Where the rising function `of` has the value `goal`, by halving the logarithm of the argument to rounding.
fn root(
    what: &'static str,
    (low, high): (f64, f64),
    (name, goal): (&'static str, f64),
    of: impl Fn(f64) -> f64,
) -> Result<f64, PredictError> {
    let none = PredictError::NoSolution { what, low, high, name, value: goal.abs() };
    let (mut below, mut above) = (low, high);
    let exceeds = |argument: f64| of(argument) >= goal;
    if exceeds(below) || !exceeds(above) {
        return Err(none);
    }
    while above > below.next_up() {
        let middle = (below * above).sqrt().clamp(below.next_up(), above.next_down());
        *(if exceeds(middle) { &mut above } else { &mut below }) = middle;
    }
    Ok(above)
}
