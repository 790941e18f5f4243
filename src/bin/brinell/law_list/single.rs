//! `brinell laws NAME`: one law with its formulas, constants, validity and curve.

use super::chart::Chart;
use super::text::{self, entry};
use super::{List, materials, those};
use crate::curve;
use crate::files::deliver;
use crate::laws::{self, Choice};
use crate::layout::{WIDTH, paragraph, table};
use crate::nearest::unknown;
use crate::parameters::Constant;
use crate::scene::Scene;
use crate::truth;
use crate::wrong_call::WrongCall;
use brinell::contact::Loading;
use brinell::contact::unloading::AnyUnloading;
use serde_json::{Value, json};
use std::error::Error;
use std::path::Path;

/// The largest depth of the curve [yield indentations].
const DEEPEST: f64 = 100.0;

/// Number of points of the curve.
const POINTS: u32 = 160;

/// Shows the law `name`: as text, as JSON, or as a picture in `output`.
pub fn run(scene: &Scene, name: &str, output: Option<&Path>, as_json: bool) -> Result<(), Box<dyn Error>> {
    let (first, _) = name.split_once('/').unwrap_or((name, ""));
    let list = those(scene, |known| known == first);
    let found = Found::of(&list, first);
    let choice = match found.loads() {
        true => Some(one(scene, name)?),
        false => None,
    };
    if found.is_empty() {
        let unloading = AnyUnloading::ALL.into_iter().map(|(name, _)| name);
        return Err(WrongCall(unknown("law", name, laws::loading_names().chain(unloading))).into());
    }
    match (&choice, output) {
        (Some(choice), Some(_)) => Ok(deliver(&picture(scene, choice)?, output)?),
        (None, Some(_)) => {
            Err(WrongCall(format!("{name} is an unloading law alone: name a pair, LOADING/{name}")).into())
        }
        (_, None) if as_json => {
            println!("{}", found.json(choice.as_ref())?);
            Ok(())
        }
        (_, None) => {
            print!("{}", found.text(choice.as_ref()));
            Ok(())
        }
    }
}

fn one(scene: &Scene, name: &str) -> Result<Choice, WrongCall> {
    let choices = laws::choose(scene, &[name.to_string()]).map_err(WrongCall::of)?;
    choices.into_iter().next().ok_or_else(|| WrongCall(format!("no law {name}")))
}

/// The laws with one name: a loading law and an unloading law may share it.
struct Found<'a> {
    list: &'a List,
    name: &'a str,
}

impl Found<'_> {
    fn of<'a>(list: &'a List, name: &'a str) -> Found<'a> {
        Found { list, name }
    }

    fn loading(&self) -> Option<&super::Measured> {
        self.list.loading.iter().find(|law| law.name == self.name)
    }

    fn unloading(&self) -> Option<&super::Told> {
        self.list.unloading.iter().find(|law| law.name == self.name)
    }

    fn damped(&self) -> impl Iterator<Item = &super::Rated> {
        self.list.damped.iter().filter(|law| law.name.split('/').next() == Some(self.name))
    }

    /// Whether it is a loading law.
    fn loads(&self) -> bool {
        self.loading().is_some() || self.damped().next().is_some()
    }

    fn is_empty(&self) -> bool {
        !self.loads() && self.unloading().is_none()
    }

    fn json(&self, choice: Option<&Choice>) -> serde_json::Result<Value> {
        let damped: Vec<_> = self.damped().collect();
        Ok(json!({
            "loading": serde_json::to_value(self.loading())?,
            "unloading": serde_json::to_value(self.unloading())?,
            "damped": serde_json::to_value(damped)?,
            "curve": choice.and_then(curve_json),
        }))
    }

    fn text(&self, choice: Option<&Choice>) -> String {
        let mut text = String::new();
        if let Some(law) = self.loading() {
            text += &format!("{}: {} (loading)\n", law.name, law.title);
            text += &formulas(&law.formulas);
            text += &constants(&law.parameters);
            text += &entry("unloading", law.unloading);
            text += &entry("validity", &law.validity);
            text += &entry("notes", &law.notes);
            text += &entry("reference", law.reference);
            text.push('\n');
            text += &text::measured(std::slice::from_ref(law));
            if !law.materials.is_empty() {
                text += &format!("\n{}", materials::text(&law.materials));
            }
        }
        if let Some(choice) = choice
            && let Some(chart) = chart(choice)
        {
            text += &format!("\n{chart}");
        }
        if let Some(law) = self.unloading() {
            let gap = if text.is_empty() { "" } else { "\n" };
            text += &format!("{gap}{}: {} (unloading)\n", law.name, law.title);
            text += &formulas(&law.formulas);
            text += &constants(&law.parameters);
            text += &entry("notes", &law.notes);
            text += &entry("reference", law.reference);
        }
        if let Some(law) = self.damped().next() {
            text += &format!("{}: {} (rate-dependent)\n", self.name, law.title);
            text += &formulas(&law.formulas);
            text += &constants(&law.parameters);
            text += &entry("validity", &law.validity);
            text += &entry("notes", &law.notes);
            text += &entry("reference", law.reference);
            let all: Vec<_> = self.damped().cloned().collect();
            text += &format!("\n{}", text::rated(&all));
        }
        text
    }
}

/// One formula on each line; long ones take several lines.
fn formulas(formulas: &[String]) -> String {
    let lines =
        formulas.iter().enumerate().map(|(index, formula)| entry(if index == 0 { "formulas" } else { "" }, formula));
    lines.collect()
}

/// One constant on each line, with its range and meaning.
fn constants(constants: &[Constant]) -> String {
    if constants.is_empty() {
        return entry("constants", "none that a scene can change");
    }
    let row = |constant: &Constant| {
        let Constant { name, value, unit, minimum, maximum, .. } = constant;
        vec![(*name).to_string(), format!("{value} {unit}").trim_end().into(), format!("{minimum} to {maximum}")]
    };
    let rows: Vec<_> = constants.iter().map(row).collect();
    let mut text = String::from("  constants\n");
    for (line, constant) in table(&rows, 1, 4).lines().zip(constants) {
        let described = format!("{line}  {}", constant.description);
        if described.chars().count() <= WIDTH {
            text += &format!("{described}\n");
        } else {
            text += &format!("{line}\n{}", paragraph("        ", constant.description));
        }
    }
    text
}

/// The loading curve and one unloading in units of the yield point, with finite elements.
fn curve_points(choice: &Choice) -> Option<[Vec<(f64, f64)>; 2]> {
    let model = choice.model.elastoplastic()?;
    let unit = model.pair.yield_point(truth::YIELD_PRESSURE_FACTOR);
    let at = |d: f64, force: f64| (d / unit.indentation, force / unit.force);
    let deepest = DEEPEST * unit.indentation;
    let part = |point: u32| f64::from(point) / f64::from(POINTS);
    let loading = |point| {
        let d = deepest * part(point);
        at(d, model.loading.segment(&model.pair, d).force(d))
    };
    let dent = model.unloading_path(deepest).lower;
    let unloading = |point| {
        let d = dent + (deepest - dent) * part(point);
        at(d, model.unloading_segment(deepest, d).force(d))
    };
    Some([(0..=POINTS).map(loading).collect(), (0..=POINTS).map(unloading).collect()])
}

fn chart(choice: &Choice) -> Option<String> {
    let [loading, unloading] = curve_points(choice)?;
    let dots = truth::loading().into_iter().filter(|point| point.x <= DEEPEST).step_by(8);
    let mut points: Vec<_> = dots.map(|point| (point.x, point.f, '.')).collect();
    let letter = |letter| move |(x, f): (f64, f64)| (x, f, letter);
    points.extend(unloading.into_iter().map(letter('-')));
    points.extend(loading.into_iter().map(letter('*')));
    let chart = Chart {
        x_title: "indentation / yield indentation".into(),
        y_title: "force / yield force: * loading, - unloading, . finite elements (loading)".into(),
        points,
    };
    Some(chart.text())
}

fn curve_json(choice: &Choice) -> Option<Value> {
    let [loading, unloading] = curve_points(choice)?;
    let columns = |points: Vec<(f64, f64)>| {
        let (x, f): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        json!({ "x": x, "f": f })
    };
    Some(json!({
        "law": choice.laws, "x": "indentation / yield indentation", "f": "force / yield force",
        "loading": columns(loading), "unloading": columns(unloading),
    }))
}

/// The curve of the law on the bodies of `scene`, as SVG.
fn picture(scene: &Scene, choice: &Choice) -> Result<String, Box<dyn Error>> {
    let unit = scene.model().pair.yield_point(truth::YIELD_PRESSURE_FACTOR);
    let depth = DEEPEST * unit.indentation;
    let drawn = curve::picture(std::slice::from_ref(choice), depth, &scene.impact_of(0), true);
    let drawn = drawn.map_err(|error| format!("{} can't be evaluated at {:e} m", choice.laws, error.indentation))?;
    Ok(drawn.svg(860, 480))
}
