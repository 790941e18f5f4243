//! A prediction as text for people and as JSON for programs.

use super::spread::{self, Bands};
use super::{PredictError, beyond, check_width, energy_lost, methods, notes, one, onsets, quantities};
use crate::laws::Choice;
use crate::layout::{paragraph, table};
use crate::numbers::{Prefixed, cell, prefixed, quantity, with_band};
use crate::regime;
use crate::rods::Waves;
use crate::scene::{InImpact, Rate, Scene};
use crate::table::VARIABLES;
use crate::validity::{self, Beyond};
use brinell_contact::Regime;
use brinell_contact::impact::{Impact, Prediction};
use serde_json::{Map, Value, json};

/// Predictions of one impact with several laws.
pub struct Answer<'a> {
    scene: &'a Scene,
    choices: &'a [Choice],
    impact: Impact,
    /// Height of fall [m], if it determines the speed.
    fall: Option<f64>,
    predictions: Vec<Prediction>,
    /// The standard deviation of the softer body's strength that who asks gives \[-\].
    deviation: Option<f64>,
    /// What the uncertainty of a strength makes of each.
    bands: Vec<Option<Bands>>,
}

impl Answer<'_> {
    /// The predictions for `impact`. `fall` is the height \[m\] that it results from, if there is one.
    ///
    /// # Errors
    /// [`PredictError::Beyond`], [`PredictError::TooWide`]
    pub fn of<'a>(
        scene: &'a Scene,
        choices: &'a [Choice],
        impact: Impact,
        fall: Option<f64>,
    ) -> Result<Answer<'a>, PredictError> {
        let predictions: Vec<_> = choices.iter().map(|choice| one(choice, &impact)).collect::<Result<_, _>>()?;
        // a table of laws shows how far they are apart, also where one of them has no such contact
        if let ([choice], [prediction]) = (choices, &predictions[..]) {
            check_width(scene, 0, &choice.laws, &impact, prediction)?;
        }
        let bands = Vec::new();
        Ok(Answer { scene, choices, impact, fall, predictions, deviation: None, bands }.with_deviation(None))
    }

    /// The same where the strength of the softer body has this standard deviation \[-\], in place of the one that its reading has.
    pub fn with_deviation(mut self, deviation: Option<f64>) -> Self {
        let bands = |(choice, prediction)| Bands::of(self.scene, choice, &self.impact, prediction, deviation);
        self.bands = self.laws().map(bands).collect();
        self.deviation = deviation;
        self
    }

    fn laws(&self) -> impl Iterator<Item = (&Choice, &Prediction)> {
        self.choices.iter().zip(&self.predictions)
    }

    /// The limits of the law that its prediction exceeds.
    fn beyond(&self, choice: &Choice, prediction: &Prediction) -> Vec<Beyond> {
        beyond(self.scene, &choice.model.pair(), self.impact.speed, prediction)
    }

    /// The quantities outside the validity of the law, in words.
    fn warnings(&self, choice: &Choice, prediction: &Prediction) -> Vec<String> {
        self.beyond(choice, prediction).into_iter().map(validity::words).collect()
    }

    /// The warnings for people: one warning for several laws.
    fn all_warnings(&self) -> Vec<String> {
        if let ([choice], [prediction]) = (self.choices, self.predictions.as_slice()) {
            return self.warnings(choice, prediction);
        }
        let wide =
            self.laws().filter(|(choice, prediction)| self.beyond(choice, prediction).iter().any(Beyond::is_wide));
        let wide: Vec<_> = wide.map(|(choice, _)| choice.laws.as_str()).collect();
        let mut warnings = Vec::new();
        if !wide.is_empty() {
            warnings.push(validity::too_wide(self.scene, &wide));
        }
        // speed and waves are the same for every law, and the time is that of the first
        let limits = self.laws().flat_map(|(choice, prediction)| self.beyond(choice, prediction));
        let limits: Vec<_> = limits.filter(|limit| !limit.is_wide()).collect();
        let first = (0..Beyond::KINDS).filter_map(|kind| limits.iter().copied().find(|limit| limit.rank().0 == kind));
        warnings.extend(first.map(validity::words));
        warnings
    }

    /// What is to know of these predictions.
    fn notes(&self) -> Vec<String> {
        // several laws have a table without them
        let has_ranges = self.choices.len() == 1 && self.bands.iter().flatten().any(Bands::are_wide);
        let spread = has_ranges.then(|| spread::note(self.scene, self.deviation)).flatten();
        let notes = notes::of(self.scene, &self.impact, self.choices, &self.predictions);
        spread.into_iter().chain(notes).collect()
    }

    /// Strength of the target in this impact, if it depends on the impact.
    fn strength(&self) -> Option<InImpact> {
        self.scene.depends_on_impact().then(|| self.scene.in_impact(0, &self.impact)).flatten()
    }

    /// The parameters of the first contact with their values, of strengths those under a slow load.
    fn parameters(&self) -> Option<Map<String, Value>> {
        let slow = self.scene.clone().under_slow_load()?;
        let value = |name: &String| Some((name.clone(), slow.group_value(0, name)?.into()));
        Some(VARIABLES.iter().filter_map(|variable| value(&variable.name)).collect())
    }

    /// Height of the rebound [m].
    fn rebound_height(&self, prediction: &Prediction) -> Option<f64> {
        Some(self.fall? * prediction.restitution * prediction.restitution)
    }

    /// Text for people.
    pub fn text(&self) -> String {
        let Impact { mass, speed } = self.impact;
        let fall = self.fall.map_or(String::new(), |height| format!(" (a fall of {})", quantity(height, "m")));
        let (mass, speed) = (quantity(mass, "kg"), quantity(speed, "m/s"));
        let by = match self.choices {
            [choice] => format!("{}, ", choice.laws),
            _ => String::new(),
        };
        let assumption = format!("; the scene names no impact: {}", self.scene.assumption());
        let assumed = if self.scene.impact_is_assumed { assumption.as_str() } else { "" };
        let heading = format!("impact of {mass} at {speed}{fall}: {by}predicted {}{assumed}", methods(self.choices));
        let mut text = paragraph("", &heading);
        text.push('\n');
        text += &match (self.choices, self.predictions.as_slice()) {
            ([choice], [prediction]) => self.single(choice, prediction),
            _ => self.rows(),
        };
        for warning in self.all_warnings() {
            text.push('\n');
            text += &paragraph("warning: ", &warning);
        }
        for note in self.notes() {
            text.push('\n');
            text += &paragraph("note: ", &note);
        }
        text
    }

    /// All quantities of one law.
    fn single(&self, choice: &Choice, prediction: &Prediction) -> String {
        let times = format!(
            "{} (loading {}, unloading {})",
            quantity(prediction.contact_time(), "s"),
            quantity(prediction.loading_time, "s"),
            quantity(prediction.unloading_time, "s")
        );
        let ratio = prediction.max_contact_radius / choice.model.pair().radius;
        let radius = prediction.max_contact_radius;
        let (wide, radius) = match &self.scene.contacts[0].ellipse {
            Some(elliptic) => ("largest half-axes", elliptic.half_axes(radius)),
            None => (
                if self.scene.is_line() { "largest half-width" } else { "largest contact radius" },
                format!("{} (a/R = {})", quantity(radius, "m"), cell(ratio, 1.0)),
            ),
        };
        let bands = self.bands.first().and_then(Option::as_ref);
        let spread = |name: &str, value: f64, unit| with_band(value, bands.and_then(|bands| bands.get(name)), unit);
        let mut rows = vec![
            ("largest force", spread("largest force", prediction.max_force, "N")),
            ("largest indentation", spread("largest indentation", prediction.max_indentation, "m")),
            (wide, radius),
            ("depth of the dent", spread("dent", prediction.residual_indentation, "m")),
        ];
        // unloading hardly narrows a dent
        if prediction.residual_indentation > 0.0 && self.scene.contacts[0].ellipse.is_none() {
            let diameter =
                bands.and_then(|bands| bands.get("largest contact radius")).map(|ends| ends.map(|end| 2.0 * end));
            let what = if self.scene.is_line() { "width of the dent" } else { "diameter of the dent" };
            rows.push((what, with_band(2.0 * prediction.max_contact_radius, diameter, "m")));
        }
        rows.extend([
            ("restitution", spread("restitution", prediction.restitution, "")),
            ("rebound speed", quantity(prediction.restitution * self.impact.speed, "m/s")),
        ]);
        if let Some(height) = self.rebound_height(prediction) {
            rows.push(("rebound height", quantity(height, "m")));
        }
        rows.extend([
            ("kinetic energy", quantity(prediction.energy, "J")),
            ("energy lost", quantity(energy_lost(prediction), "J")),
            ("contact time", times),
            ("regime reached", regime::words(prediction.regime).into()),
        ]);
        for (regime, speed) in onsets(choice, self.impact.mass) {
            rows.push(("", format!("{} from {}", regime::words(regime), quantity(speed, "m/s"))));
        }
        let rows: Vec<_> = rows.into_iter().map(|(name, value)| vec![name.to_string(), value]).collect();
        table(&rows, 2, 2)
    }

    /// A row for each law.
    fn rows(&self) -> String {
        let contact_time = Prediction::contact_time;
        let height = |prediction: &Prediction| self.rebound_height(prediction).unwrap_or(f64::NAN);
        let last = if self.fall.is_some() { shown("rebound", "m", &height) } else { shown("time", "s", &contact_time) };
        let columns = [
            shown("restitution", "", &|prediction| prediction.restitution),
            shown("force", "N", &|prediction| prediction.max_force),
            shown("indentation", "m", &|prediction| prediction.max_indentation),
            shown("dent", "m", &|prediction| prediction.residual_indentation),
            last,
        ];
        let units = columns.each_ref().map(|column| {
            let sizes = self.predictions.iter().map(|prediction| (column.of)(prediction).abs());
            prefixed(sizes.fold(0.0, f64::max), column.unit)
        });
        let mut heading = vec!["law".to_string()];
        heading.extend(columns.iter().map(|column| column.name.to_string()));
        heading.push("regime".into());
        let mut below = vec![String::new()];
        below.extend(units.iter().map(Prefixed::heading));
        let mut rows = vec![heading, below];
        for (choice, prediction) in self.laws() {
            let mut row = vec![choice.laws.clone()];
            row.extend(columns.iter().zip(&units).map(|(column, unit)| cell((column.of)(prediction), unit.size)));
            row.push(regime::short(prediction.regime).into());
            rows.push(row);
        }
        table(&rows, 1, 0)
    }

    /// JSON for programs: all digits, SI units.
    pub fn json(&self) -> Value {
        let law = |((choice, prediction), bands): ((&Choice, &Prediction), &Option<Bands>)| {
            let half_axes =
                self.scene.contacts[0].ellipse.map(|elliptic| elliptic.along_axes(prediction.max_contact_radius));
            let mut law = json!({
                "law": choice.laws, "regime": prediction.regime as i32, "regime_name": regime::words(prediction.regime),
            });
            for (name, value, _) in quantities(prediction) {
                law[name.replace(' ', "_")] = json!(value);
            }
            if let Some(half_axes) = half_axes {
                law["largest_half_axes"] = json!(half_axes);
            }
            law["rebound_speed"] = json!(prediction.restitution * self.impact.speed);
            if let Some(height) = self.rebound_height(prediction) {
                law["rebound_height"] = json!(height);
            }
            let onset = |(regime, speed): (Regime, f64)| json!({ "regime": regime as i32, "regime_name": regime::words(regime), "speed": speed });
            law["onsets"] = onsets(choice, self.impact.mass).into_iter().map(onset).collect();
            law["warnings"] = json!(self.warnings(choice, prediction));
            law["spread"] = bands.as_ref().map_or(Value::Null, Bands::json);
            law
        };
        let rate = |rate: &Option<Rate>| match rate {
            Some(Rate::JohnsonCook { c, reference_rate }) => {
                json!({ "model": "johnson-cook", "c": c, "reference_rate": reference_rate })
            }
            Some(Rate::CowperSymonds { d, q }) => json!({ "model": "cowper-symonds", "d": d, "q": q }),
            None => Value::Null,
        };
        let rates = &self.scene.rates;
        let Impact { mass, speed } = self.impact;
        json!({
            "mass": mass, "speed": speed, "drop_height": self.fall, "laws": self.laws().zip(&self.bands).map(law).collect::<Vec<_>>(),
            "notes": self.notes(),
            "parameters": self.parameters(), "strength": self.strength(), "rates": { "target": rate(&rates.target), "impactor": rate(&rates.impactor) },
            "rods": Waves::of(self.scene, self.impact.speed),
        })
    }
}

/// A column of the table of several laws.
struct Shown<'a> {
    name: &'static str,
    unit: &'static str,
    of: &'a dyn Fn(&Prediction) -> f64,
}

fn shown<'a>(name: &'static str, unit: &'static str, of: &'a dyn Fn(&Prediction) -> f64) -> Shown<'a> {
    Shown { name, unit, of }
}
