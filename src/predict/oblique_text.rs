//! An oblique impact: its arguments, and its rebound as text for people and as JSON for programs.

use super::question::Arguments;
use crate::messages::WrongCall;
use brinell_contact::impact::Impact;
use brinell_exporter::laws::Choice;
use brinell_exporter::layout::{self, paragraph};
use brinell_exporter::numbers::{cell, quantity, significant};
use brinell_exporter::predict::PredictError;
use brinell_exporter::predict::axis::Axis;
use brinell_exporter::predict::oblique::{FRICTION, METHOD, Outcome, Setting, Struck, TOGETHER, one};
use brinell_exporter::scene::Scene;
use brinell_exporter::table;
use brinell_exporter::validity;
use serde_json::{Map, Value, json};

/// The meaning of the signs.
const SIGNS: &str = "A positive spin moves the contact point of the ball as a positive tangential speed does; a ball that rolls \
                     has the spin -v/R.";
const HELD: &str = "The target is at rest and does not move.";

impl Arguments {
    /// The setting of an oblique impact, if one is asked for.
    ///
    /// # Errors
    /// A number that no oblique impact can have, or an argument that belongs to one, where none is asked for.
    pub fn setting(&self, scene: &Scene, axes: &[Axis]) -> Result<Option<Setting>, WrongCall> {
        let varied = |name: &str| axes.iter().find(|axis| axis.name == name).map(|axis| axis.from);
        let is_oblique = [self.angle, self.spin].iter().any(Option::is_some);
        if !is_oblique && varied("angle").is_none() && varied("spin").is_none() {
            let idle = [("friction", self.friction.or(varied(FRICTION))), ("inertia", self.inertia)];
            return match idle.iter().find(|(_, value)| value.is_some()) {
                Some((name, _)) => Err(WrongCall::of(PredictError::NotOblique(name))),
                None => Ok(None),
            };
        }
        let coefficient = self.friction.or(scene.group_value(0, FRICTION)).or(varied(FRICTION).map(|_| 0.0));
        let missing = || WrongCall::of(PredictError::NoCoefficient);
        let setting = Setting {
            angle: self.angle.unwrap_or(0.0),
            spin: self.spin.unwrap_or(0.0),
            coefficient: coefficient.ok_or_else(missing)?,
            inertia: self.inertia,
        };
        setting.check().map_err(WrongCall::of)?;
        Ok(Some(setting))
    }
}

/// One oblique impact with several laws.
pub struct ObliqueAnswer<'a> {
    choices: &'a [Choice],
    impact: Impact,
    outcomes: Vec<Outcome>,
}

impl ObliqueAnswer<'_> {
    /// The rebounds of `impact` with this `setting`.
    ///
    /// # Errors
    /// [`PredictError`]
    pub fn of<'a>(
        scene: &Scene,
        choices: &'a [Choice],
        (impact, setting): (Impact, Setting),
    ) -> Result<ObliqueAnswer<'a>, PredictError> {
        let outcome = |choice| one(scene, choice, (impact, setting), &[]);
        let outcomes = choices.iter().map(outcome).collect::<Result<_, _>>()?;
        Ok(ObliqueAnswer { choices, impact, outcomes })
    }

    /// Text for people.
    pub fn text(&self) -> String {
        let Some(first) = self.outcomes.first() else { return String::new() };
        let by = match self.choices {
            [choice] => format!("{}, ", choice.laws),
            _ => String::new(),
        };
        let method = if first.together { TOGETHER } else { METHOD };
        let mut text = paragraph("", &format!("oblique impact of {}: {by}{method}", self.with(first)));
        text.push('\n');
        text += &match (self.outcomes.as_slice(), self.choices) {
            ([outcome], _) => single(outcome),
            _ => self.rows(),
        };
        for (heading, words) in self.remarks() {
            text.push('\n');
            text += &paragraph(heading, &words);
        }
        text
    }

    /// The impact in words.
    fn with(&self, outcome: &Outcome) -> String {
        let Setting { angle, spin, coefficient, .. } = outcome.setting;
        let spin = if spin == 0.0 { String::new() } else { format!(", with a spin of {}", quantity(spin, "rad/s")) };
        format!(
            "{} at {} and {angle} degrees from the normal{spin}, friction {coefficient}",
            match &outcome.names {
                Some([moving, _]) => format!("{moving} of {}", quantity(outcome.before.mass, "kg")),
                None => quantity(self.impact.mass, "kg"),
            },
            quantity(self.impact.speed, "m/s")
        )
    }

    /// What the signs mean, and what the other body does.
    fn signs(&self) -> String {
        let names = self.outcomes.first().and_then(|outcome| Some((outcome.names.as_ref()?, outcome.struck.is_some())));
        match names {
            Some(([_, other], true)) => format!("{SIGNS} {other} is at rest before, and free to move."),
            Some(([_, other], false)) => format!("{SIGNS} {other} is at rest and does not move."),
            None => format!("{SIGNS} {HELD}"),
        }
    }

    /// A row for each law.
    fn rows(&self) -> String {
        let head = ["law", "e_n", "e_t", "angle [deg]", "spin [rad/s]", "sliding"].map(String::from).to_vec();
        let row = |(choice, outcome): (&Choice, &Outcome)| {
            vec![
                choice.laws.clone(),
                cell(outcome.normal_restitution(), 1.0),
                cell(outcome.tangential_restitution(), 1.0),
                cell(outcome.angle(), 1.0),
                cell(outcome.rebound.ball.spin, 1.0),
                format!("{:.1} %", 100.0 * outcome.rebound.sliding_part),
            ]
        };
        let rows: Vec<_> = [head].into_iter().chain(self.choices.iter().zip(&self.outcomes).map(row)).collect();
        layout::table(&rows, 1, 2)
    }

    /// Warnings and notes, each with its heading.
    fn remarks(&self) -> Vec<(&'static str, String)> {
        let mut remarks: Vec<_> = self.warnings().into_iter().map(|words| ("warning: ", words)).collect();
        remarks.push(("note: ", self.signs()));
        let yielding = self.choices.iter().zip(&self.outcomes).filter_map(|(choice, outcome)| {
            let model = choice.model.elastoplastic()?;
            let prediction = choice.model.predict(&outcome.normal)?;
            (!model.is_elastic_at(prediction.max_indentation)).then_some(choice)
        });
        let errors = yielding.filter_map(|choice| Some((error_of(choice)?, choice)));
        if let Some((error, choice)) = errors.max_by(|one, other| one.0.total_cmp(&other.0)) {
            remarks.push((
                "note: ",
                format!(
                    "The target yields. This project knows no measurement of friction with yield; the springs are those of the dent. A \
                     step that grows the dent has an error of the tangential force of at most {} of Coulomb's limit, with {}.",
                    significant(error, 2),
                    choice.laws
                ),
            ));
        }
        remarks
    }

    /// The limits of the laws that the normal impacts exceed.
    fn warnings(&self) -> Vec<String> {
        let mut all: Vec<String> = Vec::new();
        for (choice, outcome) in self.choices.iter().zip(&self.outcomes) {
            for warning in outcome.beyond.iter().copied().map(validity::words) {
                let warning = if self.choices.len() > 1 { format!("{}: {warning}", choice.laws) } else { warning };
                if !all.contains(&warning) {
                    all.push(warning);
                }
            }
        }
        all
    }

    /// JSON for programs.
    pub fn json(&self) -> Value {
        let law = |(choice, outcome): (&Choice, &Outcome)| {
            let mut object = Map::new();
            object.insert("law".into(), json!(choice.laws));
            for (name, value, _) in outcome.quantities() {
                object.insert(name.replace(' ', "_"), json!(value));
            }
            object.insert("slides_throughout".into(), json!(outcome.rebound.sliding_part > 0.999));
            object.insert("contact_time".into(), json!(outcome.rebound.contact_time));
            object.insert("stiffness_ratio".into(), json!(outcome.friction.stiffness_ratio));
            Value::Object(object)
        };
        let laws: Value = self.choices.iter().zip(&self.outcomes).map(law).collect();
        let first = self.outcomes.first();
        json!({
            "mass": self.impact.mass,
            "speed": self.impact.speed,
            "angle": first.map(|outcome| outcome.setting.angle),
            "spin": first.map(|outcome| outcome.setting.spin),
            "friction": first.map(|outcome| outcome.setting.coefficient),
            "inertia": first.map(|outcome| outcome.before.inertia),
            "bodies": first.and_then(|outcome| outcome.names.as_ref()),
            "warnings": self.warnings(),
            "laws": laws,
        })
    }
}

/// All quantities of one law.
fn single(outcome: &Outcome) -> String {
    let ball = &outcome.rebound.ball;
    let both = |speed: f64, restitution: f64, what: &str| {
        format!("{} ({what} {})", quantity(speed, "m/s"), cell(restitution, 1.0))
    };
    let rows = [
        ("rebound angle", format!("{} degrees from the normal", significant(outcome.angle(), 4))),
        ("rebound speed", quantity(outcome.speed(), "m/s")),
        ("along the normal", both(-ball.normal, outcome.normal_restitution(), "restitution")),
        ("tangential, centre", both(ball.tangential, outcome.tangential_restitution(), "restitution e_t")),
        ("tangential, contact point", both(outcome.rates[1][1], outcome.contact_point_restitution(), "restitution")),
        ("spin", quantity(ball.spin, "rad/s")),
        ("slip", outcome.words()),
        ("largest tangential force", quantity(outcome.rebound.max_tangential_force, "N")),
        ("friction work", quantity(outcome.rebound.friction_work, "J")),
        ("energy lost in all", quantity(outcome.energy_lost, "J")),
        ("contact time", quantity(outcome.rebound.contact_time, "s")),
    ];
    let mut rows: Vec<_> = rows.into_iter().map(|(name, value)| vec![name.to_string(), value]).collect();
    if let (Some(Struck { speeds: [normal, tangential], spin }), Some([_, other])) = (outcome.struck, &outcome.names) {
        let angle = significant(tangential.atan2(normal).to_degrees(), 4);
        let speed = quantity(normal.hypot(tangential), "m/s");
        let words = format!("{speed} at {angle} degrees from the normal, spin {}", quantity(spin, "rad/s"));
        rows.push(vec![other.clone(), words]);
    }
    layout::table(&rows, 2, 2)
}

/// The error of friction with the laws of `choice`, as the table of laws gives it.
fn error_of(choice: &Choice) -> Option<f64> {
    let (loading, unloading) = choice.names();
    table::unloading_law(unloading?).friction_error_after(loading)
}
