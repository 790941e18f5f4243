//! Predictions, curves and numbers for other tools: the answers of the commands.

use crate::Refused;
use crate::text::scene;
use brinell_contact::impact::{Impact, Prediction};
use brinell_exporter::accuracy;
use brinell_exporter::columns::Columns;
use brinell_exporter::laws::{self, Choice};
use brinell_exporter::model::check_energy;
use brinell_exporter::predict::answer::Answer;
use brinell_exporter::predict::axis::Axis;
use brinell_exporter::predict::spread::{self, Bands};
use brinell_exporter::predict::sweep::{Impacts, Sweep};
use brinell_exporter::predict::{positive, time_history};
use brinell_exporter::scene::{Body, Scene};
use brinell_exporter::translate::{Request, speeds, text, translate};
use brinell_exporter::{curve, translate, units};
use serde::Deserialize;
use serde_json::{Value, json};

/// An impact on a scene.
#[derive(Deserialize)]
pub struct Asked {
    text: String,
    mass: Option<f64>,
    speed: Option<f64>,
    #[serde(default)]
    laws: Vec<String>,
    /// The varied quantities of a sweep.
    #[serde(default)]
    sweep: Vec<String>,
    /// `curve` or `history`, for files; `sweep`, too, for bands.
    #[serde(default)]
    of: String,
    /// The standard deviation of the softer body's strength \[-\], in place of the one that its reading has.
    deviation: Option<f64>,
}

/// The scene with the strengths of an impact, its laws, and the impact.
struct Question {
    scene: Scene,
    choices: Vec<Choice>,
    impact: Impact,
}

impl Question {
    fn of(asked: &Asked) -> Result<Question, Refused> {
        let (scene, _) = scene(&asked.text)?;
        let own = scene.impact_of(0);
        let impact = Impact {
            mass: positive("mass", asked.mass.unwrap_or(own.mass))?,
            speed: positive("speed", asked.speed.unwrap_or(own.speed))?,
        };
        check_energy(&impact)?;
        let scene = scene.with_strengths_for(Some(&impact)).ok_or("the impact is too hard for the law of the scene")?;
        let choices = laws::choose(&scene, &asked.laws)?;
        Ok(Question { scene, choices, impact })
    }
}

/// What `brinell predict --json` says, and its words.
pub fn predict(asked: &Asked) -> Result<Value, Refused> {
    let Question { scene, choices, impact } = Question::of(asked)?;
    let given = deviation(asked)?;
    let answer = Answer::of(&scene, &choices, impact, None)?.with_deviation(given);
    let mut said = answer.json();
    said["text"] = json!(answer.text());
    said["contacts"] = json!(scene.contact_count());
    said["deviation"] = json!(given.or_else(|| Some(scene.measured(0, scene.softer(0))?.uncertainty)));
    said["shape"] =
        shape(&scene, &choices[0].model.predict(&impact).ok_or("the impact is too hard for the law of the scene")?);
    Ok(said)
}

/// The deviation that is given.
fn deviation(asked: &Asked) -> Result<Option<f64>, Refused> {
    let range = 0.0..=LARGEST_DEVIATION;
    match asked.deviation.filter(|given| !range.contains(given)) {
        Some(_) => {
            Err(format!("the uncertainty of the strength must be from 0 to {} %", 100.0 * LARGEST_DEVIATION).into())
        }
        None => Ok(asked.deviation),
    }
}

/// At twice this deviation a strength would be nothing.
const LARGEST_DEVIATION: f64 = 0.4;

/// What a drawing of the first contact needs beside its numbers, by impactor and target: the radii \[m\], 0 for a flat and below 0 for a
/// socket, the parts of the elastic compliance, and those of the dent.
fn shape(scene: &Scene, prediction: &Prediction) -> Value {
    let radius = |body: Body| {
        let across = scene.contacts[0].ellipse.map(|elliptic| elliptic.across(body));
        across.or_else(|| scene.group_value(0, body.radius())).filter(|radius| radius.is_finite()).unwrap_or(0.0)
    };
    let (pair, other) = (scene.model().pair, scene.two_bodies(0).other);
    let [of_softer, of_other] = [pair.yielding_modulus(), other.modulus].map(|modulus| pair.modulus / modulus);
    let elastic = if scene.softer(0) == Body::Impactor { [of_softer, of_other] } else { [of_other, of_softer] };
    let (dent, is_known) = accuracy::dented(scene, prediction);
    json!({ "radii": Body::ALL.map(radius), "elastic": elastic, "dent": dent, "dent_is_known": is_known })
}

/// A method that uncertain strengths spread: its answers with each of them throughout its band.
pub fn bands(asked: &Asked) -> Result<Value, Refused> {
    let deviation = deviation(asked)?;
    let Question { scene, choices, impact } = Question::of(asked)?;
    let of_each = |of: &dyn Fn(&[Choice]) -> Result<Columns, Refused>| {
        let families = spread::families(&scene, &choices[0], &impact, deviation).unwrap_or_default();
        Ok(
            json!({ "families": families.iter().map(|family| Ok(of(family)?.json())).collect::<Result<Vec<_>, Refused>>()? }),
        )
    };
    let largest = scene.predictions[0].max_indentation;
    match asked.of.as_str() {
        "curve" => of_each(&|family| {
            curve::columns(family, largest, &impact).map_err(|_| "the impact is too deep for a law".into())
        }),
        "history" => of_each(&|family| Ok(time_history::columns(family, &impact)?)),
        "sweep" => {
            let axis = asked.sweep.first().ok_or("a sweep needs its speeds")?;
            let speeds = Axis::parse(axis)?.values(0);
            let at = |speed: &f64| spread::of_impact(&scene, &Impact { speed: *speed, ..impact }, deviation);
            let bands = |bands: Option<(Prediction, Bands)>| bands.map(|(_, bands)| bands.json());
            Ok(json!({ "speed": speeds, "bands": speeds.iter().map(at).map(bands).collect::<Vec<_>>() }))
        }
        other => Err(format!("there are no bands of `{other}`").into()),
    }
}

/// The columns of `brinell curve`.
fn curves(asked: &Asked) -> Result<Columns, Refused> {
    let (scene, _) = scene(&asked.text)?;
    let choices = laws::choose(&scene, &asked.laws)?;
    let largest = scene.predictions[0].max_indentation;
    curve::columns(&choices, largest, &scene.impact_of(0)).map_err(|_| "the impact is too deep for a law".into())
}

/// What `brinell curve --json` says.
pub fn curve(asked: &Asked) -> Result<Value, Refused> {
    Ok(curves(asked)?.json())
}

/// The time history of the impact.
fn moments(asked: &Asked) -> Result<Columns, Refused> {
    let Question { choices, impact, .. } = Question::of(asked)?;
    Ok(time_history::columns(&choices, &impact)?)
}

/// The same as JSON.
pub fn history(asked: &Asked) -> Result<Value, Refused> {
    Ok(moments(asked)?.json())
}

/// What `brinell predict --sweep --json` says.
pub fn sweep(asked: &Asked) -> Result<Value, Refused> {
    let Question { scene, choices, impact } = Question::of(asked)?;
    let axes = asked.sweep.iter().map(|words| Axis::parse(words)).collect::<Result<Vec<_>, _>>()?;
    let each = |values: &[Vec<f64>], work: &(dyn Fn(&Vec<f64>) -> _ + Sync)| values.iter().map(work).collect();
    let sweep = Sweep::of_impacts((&scene, &choices), (impact, None), (&axes, Impacts::Combined), &each)?;
    let mut said = sweep.json();
    (said["mass"], said["speed"]) = (json!(impact.mass), json!(impact.speed));
    Ok(said)
}

/// A curve or a time history as CSV.
pub fn csv(asked: &Asked) -> Result<Value, Refused> {
    let columns = if asked.of == "history" { moments(asked)? } else { curves(asked)? };
    Ok(json!({ "csv": columns.csv() }))
}

/// The curve as SVG.
pub fn picture(asked: &Asked) -> Result<Value, Refused> {
    let (scene, _) = scene(&asked.text)?;
    let choices = laws::choose(&scene, &asked.laws)?;
    let largest = scene.predictions[0].max_indentation;
    let picture = curve::picture(&choices, largest, &scene.impact_of(0));
    let picture = picture.map_err(|_| "the impact is too deep for a law")?;
    Ok(json!({ "svg": picture.svg(860, 480) }))
}

/// A question for the numbers of another tool.
#[derive(Deserialize)]
pub struct Translating {
    text: String,
    tool: String,
    /// A time, in seconds or with its unit.
    step: Option<String>,
    speeds: Option<String>,
    #[serde(default)]
    units: String,
}

/// What `brinell translate` says, as JSON and in words.
pub fn translation(asked: &Translating) -> Result<Value, Refused> {
    let (scene, _) = scene(&asked.text)?;
    let speeds = asked.speeds.as_deref().map(speeds).transpose()?;
    let step = asked.step.as_deref().map(units::numbers_in("s")).transpose()?;
    let request = Request { tool: &asked.tool, speeds, step, millimetres: asked.units == "mm-t-s" };
    let translation = translate(&scene, &request)?;
    let data: Value = serde_json::from_str(&translate::json(&translation))?;
    Ok(json!({ "translation": data, "text": text::of(&translation) }))
}
