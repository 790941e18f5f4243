//! Numbers for the contact models of other tools, with their error over a range of speeds.
//!
//! A tool's own force law is solved for the impact of the scene: restitution and contact time are met at one speed, the largest
//! force too where the law has an exponent to choose. What the tool then does at every speed, in steps of its own kind, stands
//! beside what the scene's law says.
//!
//! | module | what it has |
//! |---|---|
//! | [`law`], `plastic` | the force laws of tools |
//! | [`motion`] | an impact by them, exactly and in steps |
//! | [`fit`] | the numbers that meet an impact |
//! | [`tools`], `numbers` | the tools as data, and how they want their numbers |
//! | [`text`] | the answer in words |

pub mod fit;
pub mod law;
pub mod motion;
pub mod numbers;
mod plastic;
pub mod runge_kutta;
mod sentences;
pub mod text;
pub mod tools;

use crate::layout;
use crate::numbers::{in_message, significant};
use crate::predict::{PredictError, beyond, check_width, spread};
use crate::scene::Scene;
use crate::units;
use crate::validity;
use brinell_contact::impact::Impact;
use fit::{Fitted, Question, largest_passive_step};
use law::Scales;
use motion::{Outcome, Promise, Stepping};
use numbers::Radii;
use serde::Serialize;
use tools::{Tool, ToolNumbers};

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The tool, in any spelling.
    pub tool: &'a str,
    /// The range of closing speeds \[m/s\] [a tenth to three times the scene's].
    pub speeds: Option<(f64, f64)>,
    /// The step of the tool \[s\] [such that a contact has a hundred].
    pub step: Option<f64>,
    /// Whether lengths are in millimetres and masses in tonnes, where the tool lets the user choose.
    pub millimetres: bool,
}

#[derive(Debug, thiserror::Error)]
pub enum TranslateError {
    /// An unknown tool, with those that exist.
    #[error("{0}")]
    Tool(String),
    #[error("--speed {0}")]
    Speeds(String),
    #[error("step = {} s must be positive and finite, and at most {LONGEST_STEP} s", in_message(*.0))]
    Step(f64),
    #[error("{0} computes in SI units: --units mm-t-s is for {1}")]
    Units(String, String),
    #[error("{0}")]
    Predict(#[from] PredictError),
    #[error("no numbers of {tool} give this impact: {why}")]
    NoNumbers { tool: String, why: String },
}

/// The longest step of any use \[s\].
const LONGEST_STEP: f64 = 1.0;
/// The largest speed \[m/s\] and the smallest.
const SPEEDS: (f64, f64) = (1e-6, 1e4);
/// Number of speeds in the table, without the one of the fit.
const ROWS: u32 = 5;

/// The range of speeds \[m/s\] that `text` names: `0.1:3`, `10 cm/s:3 m/s` or a single speed.
///
/// # Errors
/// The mistake and what is allowed, in words.
pub fn speeds(text: &str) -> Result<(f64, f64), String> {
    let wrong = |why: String| format!("{text}: {why}; expected FROM:TO, such as 0.1:3, or one speed");
    let number = |text: &str| units::number(text, "m/s").map_err(|why| wrong(format!("`{}`: {why}", text.trim())));
    let (from, to) = match text.split_once(':') {
        Some((from, to)) => (number(from)?, number(to)?),
        None => (number(text)?, number(text)?),
    };
    for speed in [from, to] {
        if !(SPEEDS.0..=SPEEDS.1).contains(&speed) {
            let (least, most) = SPEEDS;
            return Err(wrong(format!("{} m/s is out of range: allowed is {least} to {most} m/s", in_message(speed))));
        }
    }
    if from > to { Err(wrong("FROM is above TO".into())) } else { Ok((from, to)) }
}

/// The numbers of a scene for a tool.
#[derive(Clone, Debug, Serialize)]
pub struct Translation {
    pub tool: &'static str,
    pub title: &'static str,
    pub versions: &'static str,
    pub reference: &'static str,
    /// `si` or `mm-t-s`.
    pub units: &'static str,
    /// The scene's laws.
    pub law: String,
    /// Effective mass \[kg\].
    pub mass: f64,
    /// The speed \[m/s\] at which the numbers are found.
    pub speed: f64,
    /// The speeds \[m/s\] of the range, with the one above.
    pub speeds: Vec<f64>,
    /// What the scene's law says at these speeds.
    pub wanted: Vec<Outcome>,
    pub ways: Vec<Translated>,
    /// Ways that can't give this impact, with the reason.
    pub left_out: Vec<String>,
    /// What is to know of the scene.
    pub notes: Vec<String>,
    /// What the uncertainty of a strength makes of the impact at the speed above.
    pub spread: Option<serde_json::Value>,
}

/// One set of numbers.
#[derive(Clone, Debug, Serialize)]
pub struct Translated {
    pub name: &'static str,
    pub title: &'static str,
    /// The force law in words.
    pub law: &'static str,
    /// What is pasted.
    pub block: String,
    pub numbers: Vec<Typed>,
    pub stepping: Stepping,
    /// The step \[s\] for which the numbers are; `None` if the tool chooses its steps, or if they don't matter.
    pub step: Option<f64>,
    /// How many times longer than the scene's the contact lasts, because of the step.
    pub softening: f64,
    /// The largest step \[s\] at which no phase of the touch gains energy; `None` if none ever does, or some always.
    pub largest_step: Option<f64>,
    /// What the tool does at each speed: means over the phases of the touch.
    pub promised: Vec<Promise>,
    pub notes: Vec<String>,
}

/// A number as it is typed.
#[derive(Clone, Debug, Serialize)]
pub struct Typed {
    pub key: &'static str,
    /// In the system of units of the block, rounded as printed there.
    pub value: f64,
    pub unit: &'static str,
    pub means: &'static str,
}

/// The numbers of the first contact of `scene` for a tool.
///
/// # Errors
/// [`TranslateError`]
pub fn translate(scene: &Scene, request: &Request) -> Result<Translation, TranslateError> {
    let tool = tools::named(request.tool).map_err(TranslateError::Tool)?;
    if request.millimetres && tool.units.is_none() {
        let others = tools::TOOLS.iter().filter(|tool| tool.units.is_some()).map(|tool| tool.name.as_str());
        return Err(TranslateError::Units(tool.title.clone(), others.collect::<Vec<_>>().join(", ")));
    }
    if let Some(step) = request.step.filter(|step| !(*step > 0.0 && *step <= LONGEST_STEP)) {
        return Err(TranslateError::Step(step));
    }
    if scene.is_line() {
        let why = "its contacts are translated from those of balls, and the scene has a cylinder".into();
        return Err(TranslateError::NoNumbers { tool: tool.title.clone(), why });
    }
    if scene.contacts.iter().any(|group| group.ellipse.is_some()) {
        let why = "its contacts are translated from those of balls, and a body of the scene has two radii".into();
        return Err(TranslateError::NoNumbers { tool: tool.title.clone(), why });
    }
    let case = Case::of(scene, request)?;
    let (mut ways, mut left_out) = (Vec::new(), Vec::new());
    for way in &tool.ways {
        match case.by(way, request) {
            Ok(translated) => ways.push(translated),
            Err(why) => left_out.push(format!("{}: {why}", way.title)),
        }
    }
    if ways.is_empty() {
        return Err(TranslateError::NoNumbers { tool: tool.title.clone(), why: left_out.join("; ") });
    }
    let Case { mass, speed, speeds, wanted, radii, law, .. } = case;
    let mut notes = sentences::of_scene(scene, (mass, &radii), (&speeds, &wanted), request, tool);
    notes.extend(spread::sentence(scene, &Impact { mass, speed }));
    let Tool { name, title, versions, reference, .. } = tool;
    let units = if request.millimetres { "mm-t-s" } else { "si" };
    Ok(Translation {
        tool: name,
        title,
        versions,
        reference,
        units,
        law,
        mass,
        speed,
        speeds,
        wanted,
        ways,
        left_out,
        notes,
        spread: spread::of_impact(scene, &Impact { mass, speed }, None).map(|(_, bands)| bands.json()),
    })
}

/// The impacts of the scene.
struct Case {
    mass: f64,
    speed: f64,
    speeds: Vec<f64>,
    wanted: Vec<Outcome>,
    radii: Radii,
    law: String,
    /// Parts of the effective mass, with the law's restitution at the speed of the fit.
    at_other_masses: Vec<(f64, f64)>,
}

/// Other effective masses: of two such balls that meet, if one is on a flat, and of one on a flat, if two meet.
const OTHER_MASSES: [f64; 2] = [0.5, 2.0];

impl Case {
    fn of(scene: &Scene, request: &Request) -> Result<Case, TranslateError> {
        let Impact { mass, speed } = scene.impact_of(0);
        let (from, to) = request.speeds.unwrap_or((0.1 * speed, 3.0 * speed));
        // the scene's own speed if it is in the range
        let speed = if (from..=to).contains(&speed) { speed } else { (from * to).sqrt() };
        let mut speeds: Vec<f64> = (0..ROWS)
            .map(|row| from * (to / from).powf(f64::from(row) / f64::from(ROWS - 1)))
            // one or two digits are enough between the ends
            .map(|speed| significant(speed, 2).parse().expect("a number"))
            .filter(|speed| (from..=to).contains(speed))
            .chain([from, speed, to])
            .collect();
        speeds.sort_by(f64::total_cmp);
        speeds.dedup_by(|one, other| (*one / *other - 1.0).abs() < 1e-9);
        // beyond the scene's own speed the contact may be too wide, unless the user asks for it
        let asks = |at: f64| request.speeds.is_some() || at == speed;
        let of = |at: &f64| of_law(scene, Impact { mass, speed: *at }, asks(*at));
        let wanted = speeds.iter().map(of).collect::<Result<_, _>>();
        let choices = crate::laws::choose(scene, &[]).expect("a scene has laws");
        let law = choices[0].laws.clone();
        let radius = |name: &str| scene.group_value(0, name);
        let radii = Radii::new(radius("impactor.radius").unwrap_or(f64::NAN), radius("target.radius"));
        let with_part =
            |part: &f64| Some((*part, of_law(scene, Impact { mass: part * mass, speed }, false).ok()?.restitution));
        let at_other_masses = OTHER_MASSES.iter().filter_map(with_part).collect();
        Ok(Case { mass, speed, speeds, wanted: wanted?, radii, law, at_other_masses })
    }

    /// The place of the speed of the fit in the range.
    fn at(&self) -> usize {
        let place = self.speeds.iter().position(|speed| (speed / self.speed - 1.0).abs() < 1e-9);
        place.expect("the speed of the fit is one of the speeds")
    }

    /// What the law says at the speed of the fit.
    fn goal(&self) -> &Outcome {
        &self.wanted[self.at()]
    }

    /// The numbers of one way.
    fn by(&self, way: &'static ToolNumbers, request: &Request) -> Result<Translated, String> {
        if way.flat_only && self.radii.other.is_some() {
            return Err("its numbers are for a ball on a flat, and here two spheres meet".into());
        }
        let goal = self.goal();
        let fastest = *self.speeds.last().expect("a range has speeds");
        let question = way.form.map(|form| Question {
            form,
            stepping: way.stepping,
            at_touch: way.at_touch,
            scales: Scales { mass: self.mass, speed: self.speed, fastest, radius: self.radii.effective },
            goal,
            speeds: &self.speeds,
            wanted: &self.wanted,
        });
        let fitted = question.as_ref().map(|question| question.answer(request.step)).transpose()?;
        let promise = |speed: &f64| match question.as_ref().zip(fitted.as_ref()) {
            Some((question, fitted)) => {
                let stepping = if fitted.is_fine { Stepping::Own } else { way.stepping };
                let law = question.at(&fitted.law, *speed);
                Promise::at(&law, stepping, self.mass, *speed, fitted.step.unwrap_or(f64::NAN))
            }
            None => Some(Promise::of(Outcome {
                restitution: goal.restitution,
                largest_force: f64::NAN,
                contact_time: f64::NAN,
                depth: f64::NAN,
            })),
        };
        let promised: Option<Vec<Promise>> = self.speeds.iter().map(promise).collect();
        let promised = promised.ok_or("its contact does not end at every speed of the range")?;
        let typed = self.typed(way, fitted.as_ref(), &promised, request)?;
        let is_explicit = way.stepping == Stepping::Explicit;
        let largest_step =
            question.as_ref().zip(fitted.as_ref()).filter(|_| is_explicit).and_then(|(question, fitted)| {
                let at =
                    |speed: f64| largest_passive_step(&question.at(&fitted.law, speed), way.stepping, self.mass, speed);
                // a stiffening law has its shortest contact at the largest speed
                Some(at(self.speed)?.min(at(fastest)?))
            });
        let (numbers, block) = typed;
        let mut translated = Translated {
            name: &way.name,
            title: &way.title,
            law: &way.law,
            block,
            numbers,
            stepping: way.stepping,
            step: fitted.as_ref().and_then(|fitted| fitted.step),
            softening: fitted.as_ref().map_or(1.0, |fitted| fitted.softening),
            largest_step,
            promised,
            notes: Vec::new(),
        };
        translated.notes = sentences::of_way(self, way, fitted.as_ref(), &translated);
        Ok(translated)
    }

    /// The numbers as they are typed, and the block with them.
    fn typed(
        &self,
        way: &'static ToolNumbers,
        fitted: Option<&Fitted>,
        promised: &[Promise],
        request: &Request,
    ) -> Result<(Vec<Typed>, String), String> {
        let goal = self.goal();
        let context = numbers::Context {
            law: fitted.map(|fitted| &fitted.law),
            radii: &self.radii,
            mass: self.mass,
            restitution: goal.restitution,
            contact_time: goal.contact_time,
            depth: promised[self.at()].mean.depth,
            speed: self.speed,
            step: fitted.and_then(|fitted| fitted.step),
        };
        let exponent = context.value("exponent").unwrap_or(1.0);
        let mut block = way.block_for(self.radii.other.is_some());
        let mut typed = Vec::new();
        for number in &way.numbers {
            let none = || format!("no {} leads to a restitution of {:.3}", number.means, goal.restitution);
            let value = context.value(&number.key).ok_or_else(none)?;
            let (factor, unit) = match request.millimetres {
                true => numbers::in_millimetres(&number.unit, exponent).expect("units of the table"),
                false => (1.0, number.unit.as_str()),
            };
            let text = printed(value * factor);
            block = block.replace(&format!("{{{}}}", number.key), &text);
            let value = text.parse().unwrap_or(f64::INFINITY);
            typed.push(Typed { key: &number.key, value, unit, means: &number.means });
        }
        for key in ["step", "own_step", "radius", "ball_radius", "other_radius", "density", "pair_damping"] {
            if let Some(value) = context.value(key) {
                block = block.replace(&format!("{{{key}}}"), &printed(value));
            }
        }
        let modulus = ["youngs_modulus", "hooke_modulus"].iter().find_map(|key| context.value(key));
        block = block.replace("{particles}", if modulus > Some(HARD) { "hard" } else { "soft" });
        Ok((typed, block + "\n"))
    }
}

/// Significant digits of a typed number.
const DIGITS: usize = 7;

/// The modulus \[Pa\] above which LIGGGHTS wants to be told that particles are hard; below a smaller one, that they are soft.
const HARD: f64 = 1e9;

/// A number in a block: never an integer, which Drake and C++ take for another type.
pub fn printed(value: f64) -> String {
    let text = if value.is_finite() { significant(value, DIGITS) } else { "none".into() };
    if text.contains(['.', 'e', 'n']) { text } else { text + ".0" }
}

/// The outcome of an impact by the scene's law. `is_asked` rejects one that makes the contact as wide as the smaller body.
fn of_law(scene: &Scene, impact: Impact, is_asked: bool) -> Result<Outcome, TranslateError> {
    let beyond = || PredictError::Beyond { law: scene.name.clone(), mass: impact.mass, speed: impact.speed };
    crate::model::check_energy(&impact).map_err(PredictError::from)?;
    let own = scene.clone().with_strengths_for(Some(&impact)).ok_or_else(beyond)?;
    let prediction = own.any_model().predict(&impact).ok_or_else(beyond)?;
    if is_asked {
        check_width(&own, 0, own.laws.name(), &impact, &prediction)?;
    }
    Ok(Outcome {
        restitution: prediction.restitution,
        largest_force: prediction.max_force,
        contact_time: prediction.contact_time(),
        depth: prediction.max_indentation,
    })
}

/// What is beyond the validity of the scene's law at the largest of these speeds.
fn beyond_validity(scene: &Scene, impact: Impact) -> Vec<String> {
    let own = scene.clone().with_strengths_for(Some(&impact));
    let found = own.and_then(|own| {
        let model = own.any_model();
        let prediction = model.predict(&impact)?;
        Some(beyond(&own, &model.pair(), impact.speed, &prediction))
    });
    let words = |one| format!("At {}, {}.", crate::numbers::quantity(impact.speed, "m/s"), validity::words(one));
    found.unwrap_or_default().into_iter().map(words).collect()
}

/// The answer as JSON: SI units but for the numbers of a block, all digits.
pub fn json(translation: &Translation) -> String {
    layout::json_line(translation)
}
