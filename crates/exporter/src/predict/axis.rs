//! The varied quantity of a sweep: a quantity of the impact, or a parameter of the scene.

use super::constants;
use super::{PredictError, check_energy, positive, speed_of_energy, speed_of_height};
use crate::laws::Choice;
use crate::measurement::{Separator, Wrong, decimal_of, lines_of, number, text_of};
use crate::model::RateLaw;
use crate::nearest::{nearest, one_of};
use crate::numbers::{in_message, out_of_range};
use crate::scene::{Body, Scene};
use crate::table::{self, Causality, VARIABLES};
use crate::units;
use brinell_contact::impact::Impact;
use std::borrow::Cow;

/// A quantity with its range.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Its name for the user: `speed`, `target.yield_strength`, `law.loading_parameters.exponent`.
    pub name: &'static str,
    /// Its unit in SI.
    pub unit: &'static str,
    pub from: f64,
    pub to: f64,
    /// Number of values, if the user gives it.
    count: Option<usize>,
    /// Whether they are spaced logarithmically, if the user says so.
    logarithmic: Option<bool>,
    /// The values themselves, if the user lists them.
    listed: Option<Vec<f64>>,
}

/// The quantities of an impact, with their units.
const OF_IMPACT: [(&str, &str); 4] = [("speed", "m/s"), ("mass", "kg"), ("energy", "J"), ("drop_height", "m")];

/// Those that only oblique impacts have.
pub const OF_OBLIQUE_IMPACT: [(&str, &str); 2] = [("angle", "deg"), ("spin", "rad/s")];

/// Constants of rate models, with their units, for a body that has the model.
const OF_RATE: [(&str, &str); 4] =
    [("target.rate.c", ""), ("target.rate.d", "1/s"), ("impactor.rate.c", ""), ("impactor.rate.d", "1/s")];

/// A parameter that only some laws have, whether or not a scene contains it.
const HARDENING: &str = Body::Target.hardening_modulus();

/// Parameters that do not affect an impact.
const WITHOUT_EFFECT: [&str; 1] = ["initial_gap"];

/// Largest number of values of a sweep.
const MOST: usize = 10_000;

/// Largest number of impacts in a table.
const MOST_IMPACTS: usize = 1_000_000;

impl Axis {
    /// The axis described by `words`: NAME=FROM:TO, NAME=FROM:TO:COUNT, or NAME=VALUE,VALUE,...; behind the number of values, or in
    /// its place, `log` or `lin`.
    ///
    /// # Errors
    /// [`PredictError::Varied`] with the mistake and the expected form.
    pub fn parse(words: &str) -> Result<Axis, PredictError> {
        let wrong = |why: &str| {
            PredictError::Varied(format!(
                "{words}: {why}; expected NAME=FROM:TO, NAME=FROM:TO:COUNT or NAME=VALUE,VALUE,..., such as speed=0.01:10, \
                 speed=1:20:8log or \"target.yield_strength=200 MPa:900 MPa:8\""
            ))
        };
        let (name, range) = words.split_once('=').ok_or_else(|| wrong("no `=`"))?;
        let (name, unit) = find(name).map_err(|why| PredictError::Varied(format!("{words}: {why}")))?;
        let number = |text: &str| {
            let number = units::number(text, unit).map_err(|why| wrong(&format!("`{text}`: {why}")))?;
            if number.is_finite() { Ok(number) } else { Err(wrong(&format!("`{text}` is no finite number"))) }
        };
        let parts: Vec<&str> = range.split(':').collect();
        if let [list] = parts.as_slice()
            && list.contains(',')
        {
            if let Some(comma) = units::decimal_comma(list) {
                return Err(wrong(&comma));
            }
            // a list of one number ends in a comma
            let list = list.strip_suffix(',').unwrap_or(list);
            let listed = list.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
            if listed.len() > MOST {
                return Err(wrong(&format!("{} values: at most {MOST} are allowed", listed.len())));
            }
            return Ok(Axis::listing((name, unit), listed));
        }
        let (from, to, count) = match parts.as_slice() {
            [from, to] => (from, to, None),
            [from, to, count] => (from, to, Some(*count)),
            _ => return Err(wrong("no range")),
        };
        let (from, to) = (number(from)?, number(to)?);
        if from >= to {
            return Err(wrong("FROM must be below TO"));
        }
        let (count, logarithmic) =
            count.map_or((None, None), |text| match (text.strip_suffix("log"), text.strip_suffix("lin")) {
                (Some(count), _) => (Some(count), Some(true)),
                (_, Some(count)) => (Some(count), Some(false)),
                _ => (Some(text), None),
            });
        if logarithmic == Some(true) && from <= 0.0 {
            return Err(wrong("a logarithmic range must be above zero"));
        }
        let count = count.filter(|text| logarithmic.is_none() || !text.is_empty()).map(|text| match text.parse() {
            Ok(count) if (2..=MOST).contains(&count) => Ok(count),
            _ => Err(wrong(&format!("COUNT = {text} must be a whole number from 2 to {MOST}"))),
        });
        Ok(Axis { name, unit, from, to, count: count.transpose()?, logarithmic, listed: None })
    }

    /// The axis of these values.
    fn listing((name, unit): (&'static str, &'static str), listed: Vec<f64>) -> Axis {
        let from = listed.iter().copied().fold(f64::INFINITY, f64::min);
        let to = listed.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Axis { name, unit, from, to, count: None, logarithmic: None, listed: Some(listed) }
    }

    /// The columns of a table of impacts, as spreadsheets write it: a heading with the names of quantities and perhaps units in brackets,
    /// and a line of numbers for each impact, in these units, in SI units or with a unit of their own.
    ///
    /// # Errors
    /// The line and the mistake.
    pub fn columns(table: &[u8]) -> Result<Vec<Axis>, String> {
        let wrong = |wrong: Wrong| format!("{}: {}", wrong.line.unwrap_or(1), wrong.why);
        let (said, lines) = text_of(table).and_then(|text| lines_of(&text)).map_err(wrong)?;
        let mut lines = lines.iter().filter(|line| !line.is_comment);
        let heading =
            lines.next().ok_or("1: there is no heading; expected the names of quantities, such as speed,mass")?;
        let separator = said.unwrap_or_else(|| separator_of(&heading.text));
        let names: Vec<(String, Option<String>)> =
            separator.cells(&heading.text).iter().map(|it| with_unit(it)).collect();
        let known = names.iter().map(|(name, _)| find(name)).collect::<Result<Vec<_>, _>>();
        let known = known.map_err(|why| format!("{}: {why}", heading.number))?;
        let rows: Vec<(usize, Vec<String>)> = lines.map(|line| (line.number, separator.cells(&line.text))).collect();
        if let Some((line, row)) = rows.iter().find(|(_, row)| row.len() != names.len()) {
            return Err(format!("{line}: {} cells below a heading of {}", row.len(), names.len()));
        }
        if !(1..=MOST_IMPACTS).contains(&rows.len()) {
            let count = rows.len();
            return Err(format!("1: {count} impacts below the heading; allowed is 1 to {MOST_IMPACTS}"));
        }
        let cells = |place: usize| rows.iter().map(|(_, row)| row[place].as_str()).collect::<Vec<_>>();
        // a comma between cells is none within them
        let decimal = match separator {
            Separator::Sign(',') => '.',
            _ => decimal_of(&(0..names.len()).map(cells).collect::<Vec<_>>(), separator)
                .map_err(|why| format!("1: {why}"))?,
        };
        let mut columns = Vec::new();
        for (place, ((name, unit), (_, written))) in known.into_iter().zip(&names).enumerate() {
            let number = |(line, row): &(usize, Vec<String>)| {
                let cell = if decimal == ',' { row[place].replace(',', ".") } else { row[place].clone() };
                let plain = written.as_ref().filter(|_| number(&cell, '.').is_some());
                let text = plain.map_or(cell.clone(), |unit| format!("{cell} {unit}"));
                units::number(&text, unit).map_err(|why| format!("{line}: {name} = `{text}`: {why}"))
            };
            columns.push(Axis::listing((name, unit), rows.iter().map(number).collect::<Result<_, _>>()?));
        }
        Ok(columns)
    }

    /// Whether the values are spaced logarithmically: as the user says, else if the range has a decade or more, and is not one of angles.
    /// `python/brinell/studies/plan.py` has the same rule.
    pub fn is_logarithmic(&self) -> bool {
        self.logarithmic.unwrap_or(self.name != "angle" && self.from > 0.0 && self.to >= 10.0 * self.from)
    }

    /// The values: those that the user lists, or the user's number of them, otherwise `usual`. They include both ends unchanged.
    pub fn values(&self, usual: usize) -> Vec<f64> {
        if let Some(listed) = &self.listed {
            return listed.clone();
        }
        let count = self.count.unwrap_or(usual);
        let part = |index: usize| index as f64 / (count - 1) as f64;
        let value = |index: usize| match index {
            0 => self.from,
            index if index == count - 1 => self.to,
            index if self.is_logarithmic() => self.from * libm::pow(self.to / self.from, part(index)),
            index => self.from + (self.to - self.from) * part(index),
        };
        (0..count).map(value).collect()
    }
}

/// What stands between the names of a heading: the sign that gives the most that are known.
fn separator_of(heading: &str) -> Separator {
    let known =
        |separator: &Separator| separator.cells(heading).iter().filter(|cell| find(&with_unit(cell).0).is_ok()).count();
    let signs = [Separator::Sign(','), Separator::Sign(';'), Separator::Sign('\t')];
    // the first of equals
    signs.into_iter().rev().max_by_key(known).unwrap_or(Separator::Sign(','))
}

/// The name in a heading, and the unit that follows in brackets.
fn with_unit(heading: &str) -> (String, Option<String>) {
    let parts = heading.strip_suffix([']', ')']).and_then(|rest| rest.split_once(['[', '(']));
    parts.map_or((heading.into(), None), |(name, unit)| (name.trim().into(), Some(unit.trim().into())))
}

/// The quantity `name` with its unit.
fn find(name: &str) -> Result<(&'static str, &'static str), String> {
    let parameters = VARIABLES.iter().filter(|variable| variable.causality == Causality::Parameter);
    let parameters = parameters.map(|variable| (variable.name.as_str(), variable.unit.as_deref().unwrap_or("")));
    let known: Vec<_> = OF_IMPACT.into_iter().chain(OF_OBLIQUE_IMPACT).chain(parameters).chain(OF_RATE).collect();
    let constants: Vec<_> = constants::names().collect();
    let found = known.iter().chain(&constants).find(|(known, _)| *known == name);
    let names: Vec<_> = known.iter().map(|(name, _)| *name).filter(|name| !WITHOUT_EFFECT.contains(name)).collect();
    match found {
        Some((name, _)) if WITHOUT_EFFECT.contains(name) => Err(format!("an impact doesn't depend on {name}")),
        Some(found) => Ok(*found),
        None => {
            let all = names.iter().copied().chain(constants.iter().map(|(name, _)| *name));
            // of equally near names the first is taken, and most targets yield
            let (targets, others): (Vec<_>, Vec<_>) = all.partition(|name| name.starts_with("target."));
            let all = targets.into_iter().chain(others);
            let guess = nearest(name, all).map(|guess| format!("; did you mean `{guess}`? Expected"));
            let guess = guess.unwrap_or_else(|| ", expected".into());
            Err(format!(
                "no quantity is called `{name}`{guess} {}, or a constant that `brinell laws NAME` shows, as in {}NAME",
                one_of(&names),
                constants::LOADING
            ))
        }
    }
}

/// The number in SI units that `words`, NAME=NUMBER, say of a quantity or a parameter of an FMU. In front of the parameter there may
/// be its contact: `bead[3].initial_gap`. An SI unit stands for any quantity that has it: `m/N=5 nm/N`.
///
/// # Errors
/// What is wrong, and what is allowed.
pub fn in_si(words: &str) -> Result<f64, String> {
    let (name, text) = words.split_once('=').ok_or_else(|| format!("{words}: no `=`; expected NAME=NUMBER"))?;
    let parts = name.match_indices('.').map(|(dot, _)| &name[dot + 1..]);
    let variable = |own: &str| VARIABLES.iter().find(|variable| variable.name == own);
    let unit = match std::iter::once(name).chain(parts).find_map(variable) {
        Some(variable) => variable.unit.as_deref().unwrap_or(""),
        None if units::is_unit(name) => name,
        None => find(name)?.1,
    };
    units::number(text, unit).map_err(|why| format!("{name} = {text}: {why}"))
}

/// A quantity with its value.
pub type Value = (&'static str, f64);

/// The first contact of a scene in an impact of its own: bodies, laws, and the strengths that the bodies have in it.
pub struct Case<'a> {
    pub scene: Cow<'a, Scene>,
    pub choice: Choice,
    pub impact: Impact,
}

/// The first contact of `scene`, under a slow load, with the law of `choice` in an `impact` with these values of some quantities, as a scene
/// has it that says so. The part `along` of the speed is along the normal.
///
/// # Errors
/// The impossible value, with the allowed ones.
pub fn varied<'a>(
    scene: &'a Scene,
    choice: &Choice,
    mut impact: Impact,
    values: &[Value],
    along: f64,
) -> Result<Case<'a>, PredictError> {
    let mut bodies = Vec::new();
    for &(name, value) in values {
        match name {
            "speed" => impact.speed = positive("speed", value)?,
            "mass" => impact.mass = positive("mass", value)?,
            "energy" => impact.speed = speed_of_energy(impact.mass, positive("energy", value)?),
            "drop_height" => impact.speed = speed_of_height(positive("drop_height", value)?),
            name if constants::is_one(name) => {}
            name if OF_RATE.iter().any(|(known, _)| *known == name) => {
                // no dependence is a rate, too, and an infinitely slow one is none
                let least = if name.ends_with('c') { 0.0 } else { f64::MIN_POSITIVE };
                if !(least..=f64::MAX).contains(&value) {
                    let allowed = out_of_range(value, &(least..=f64::MAX), "");
                    return Err(PredictError::Varied(format!("{name} {allowed}")));
                }
                bodies.push((name, value));
            }
            name => {
                check_limits(name, value)?;
                match name {
                    "effective_mass" => impact.mass = value,
                    "restitution" if choice.model.rate_law().is_none() => {
                        let why = format!("restitution is a parameter of rate-dependent laws, not of {}", choice.laws);
                        return Err(PredictError::Varied(why));
                    }
                    "restitution" => {}
                    name => bodies.push((name, value)),
                }
            }
        }
    }
    // an energy refers to the mass, whichever comes first
    if let Some((_, energy)) = values.iter().find(|(name, _)| *name == "energy") {
        impact.speed = speed_of_energy(impact.mass, *energy);
    }
    check_energy(&impact)?;
    let (mut scene, mut choice) = (Cow::Borrowed(scene), choice.clone());
    if !bodies.is_empty() || scene.depends_on_impact() {
        let hard = || PredictError::Beyond { law: choice.laws.clone(), mass: impact.mass, speed: impact.speed };
        let own = with_bodies(&scene, &choice, &bodies)?;
        let own = own.with_strengths_for(Some(&Impact { speed: along * impact.speed, ..impact })).ok_or_else(hard)?;
        choice = match choice.model.rate_law() {
            Some(law) => Choice { model: law.on(own.model().pair), ..choice },
            None => choice.on(&own).ok_or_else(hard)?,
        };
        scene = Cow::Owned(own);
    }
    for &(name, value) in values {
        match (name, choice.model.rate_law()) {
            ("effective_mass", Some(law)) => choice.model = RateLaw { mass: value, ..law }.on(choice.model.pair()),
            ("restitution", Some(law)) => choice.model = RateLaw { restitution: value, ..law }.on(choice.model.pair()),
            (name, _) if constants::is_one(name) => constants::set(&scene, &mut choice, name, value)?,
            _ => {}
        }
    }
    Ok(Case { scene, choice, impact })
}

/// The scene with bodies of these parameters, of which the law of `choice` must have each.
fn with_bodies(scene: &Scene, choice: &Choice, bodies: &[Value]) -> Result<Scene, PredictError> {
    for (name, _) in bodies {
        let follows =
            |what: &str| Err(PredictError::Varied(format!("{name}: {what} follows from it, and would not change")));
        if scene.is_line() && (name.ends_with("radius") || name.ends_with("poissons_ratio")) {
            return follows("the constant C of a line contact");
        }
        if scene.contacts[0].ellipse.is_some() && (name.ends_with("radius") || name.ends_with("poissons_ratio")) {
            return follows("the ball that has the force of an ellipse");
        }
        // a rigid impactor has no modulus, a flat target no radius, and an elastic law neither strength nor hardening
        let is_there = match *name {
            "target.yield_strength" => choice.yields(),
            "target.radius" => true,
            name if Body::ALL.iter().any(|body| body.hardening_modulus() == name) => {
                let hardens = choice.model.elastoplastic().is_some_and(|model| model.loading.takes_both_bodies());
                hardens && (name == HARDENING || scene.group_value(0, name).is_some())
            }
            name if OF_RATE.iter().any(|(known, _)| *known == name) => scene.rate_constant(name).is_some(),
            name => scene.group_value(0, name).is_some(),
        };
        if !is_there {
            return Err(PredictError::Varied(format!("{name}: {}", why_absent(name))));
        }
    }
    scene.clone().with_values(bodies).ok_or_else(|| {
        let radius = scene.group_value(0, "impactor.radius").unwrap_or(f64::NAN);
        let words = bodies.iter().map(|(name, value)| format!("{name} = {}", in_message(*value))).collect::<Vec<_>>().join(", ");
        PredictError::Varied(format!(
            "{words}: these bodies don't touch in one point (impactor.radius = {}); a socket must be wider than the impactor",
            in_message(radius)
        ))
    })
}

fn why_absent(name: &str) -> &'static str {
    match name {
        "target.yield_strength" => "the law has no yield strength",
        "impactor.yield_strength" => "the scene doesn't give it, so that the impactor never yields",
        "elastic_restitution" | "target.plate_thickness" => "the scene has no such loss below yield",
        name if name.contains(".rate.") => "the scene gives the body no rate with this constant",
        HARDENING | "impactor.hardening_modulus" => "the law has no hardening, or the scene gives none; brinell has",
        _ => "the impactor of the scene is rigid; give youngs_modulus and poissons_ratio, or a material",
    }
}

fn check_limits(name: &'static str, value: f64) -> Result<(), PredictError> {
    let variable = table::variable(name);
    let (minimum, maximum) = (variable.minimum.unwrap_or(f64::MIN), variable.maximum.unwrap_or(f64::MAX));
    if (minimum..=maximum).contains(&value) {
        return Ok(());
    }
    let unit = variable.unit.as_deref().unwrap_or("");
    Err(PredictError::Varied(format!("{name} {}", out_of_range(value, &(minimum..=maximum), unit))))
}
