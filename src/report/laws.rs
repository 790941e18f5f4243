//! The comparison of the laws for one impact: the spread is what a user can't know without a measurement.

use super::Figure;
use crate::curve;
use crate::parallel;
use crate::truth;
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::AnyLoading;
use brinell_contact::material::{Pair, YieldPoint};
use brinell_exporter::laws::{Choice, UnknownLaw, choose};
use brinell_exporter::model::AnyModel;
use brinell_exporter::numbers::{percent, quantity};
use brinell_exporter::plot::{Picture, Series, View};
use brinell_exporter::predict;
use brinell_exporter::scene::Scene;
use serde::Serialize;
use std::convert::Infallible;

/// The range of speeds for restitution, relative to the scene's, and their number.
const SPEEDS: (f64, f64) = (0.01, 10.0);
const COUNT: u32 = 41;

/// The law fitted to finite elements.
const FITTED: &str = "brinell";

/// Name of the data of finite elements.
const TRUTH: &str = "finite elements";

/// The compared quantities, with their units.
const QUANTITIES: [(&str, &str); 4] =
    [("restitution", ""), ("largest force", "N"), ("dent", "m"), ("contact time", "s")];

/// The quantities of one law, or of finite elements where they are known.
#[derive(Serialize)]
pub struct Row {
    law: String,
    restitution: Option<f64>,
    #[serde(rename = "largest_force_N")]
    force: Option<f64>,
    #[serde(rename = "dent_m")]
    dent: Option<f64>,
    #[serde(rename = "contact_time_s")]
    time: Option<f64>,
}

impl Row {
    /// The quantity at this place of [`QUANTITIES`].
    fn get(&self, place: usize) -> Option<f64> {
        [self.restitution, self.force, self.dent, self.time][place]
    }
}

/// The range of a quantity over the laws.
#[derive(Serialize)]
pub struct Spread {
    quantity: &'static str,
    unit: &'static str,
    scene: f64,
    lowest: f64,
    lowest_by: String,
    highest: f64,
    highest_by: String,
    finite_elements: Option<f64>,
}

/// Restitution at a speed.
#[derive(Serialize)]
pub struct Restitution {
    law: String,
    speed_m_per_s: f64,
    restitution: f64,
}

/// All laws, and the finite-element results.
pub struct Laws<'a> {
    scene: &'a Scene,
    /// The scene's first, as many as there are choices; then finite elements, where they reach.
    pub rows: Vec<Row>,
    choices: Vec<Choice>,
    pub spread: Vec<Spread>,
    pub restitutions: Vec<Restitution>,
    /// Reasons for missing laws.
    pub left_out: Vec<String>,
    /// The scene's impact from finite elements, for this yield point.
    truth: Option<(truth::Impact, YieldPoint)>,
}

impl Laws<'_> {
    /// The impact of `scene` with every law that its bodies support.
    pub fn of(scene: &Scene) -> Laws<'_> {
        let mut wanted: Vec<Choice> = choose(scene, &[]).unwrap_or_default();
        let (mut left_out, mut without_strength) = (Vec::new(), 0);
        let own = wanted.first().map(|choice| choice.name.clone()).unwrap_or_default();
        for (name, _) in AnyLoading::ALL.iter().filter(|(name, _)| *name != own) {
            match choose(scene, &[(*name).to_string()]) {
                Ok(more) => wanted.extend(more),
                Err(UnknownLaw::NoYieldStrength(_)) => without_strength += 1,
                Err(error) => left_out.push(error.to_string()),
            }
        }
        if without_strength > 0 {
            left_out.push(format!("{without_strength} laws need target.yield_strength (or a material)"));
        }
        let (mut choices, mut rows) = (Vec::new(), Vec::new());
        for choice in wanted {
            match predict::one(&choice, &scene.impact) {
                Ok(prediction) => {
                    rows.push(row(&choice.name, &prediction));
                    choices.push(choice);
                }
                Err(error) => left_out.push(error.to_string()),
            }
        }
        // the yield point as the finite-element results define it, if a body yields
        let pair = scene.yield_strength.map(|yield_strength| Pair { yield_strength, ..scene.any_model().pair() });
        let unit = pair.map(|pair| pair.yield_point(truth::YIELD_PRESSURE_FACTOR));
        let energy = scene.impact.energy();
        let truth = unit.and_then(|unit| Some((truth::impact(energy / (unit.force * unit.indentation))?, unit)));
        rows.extend(truth.as_ref().map(|(impact, unit)| Row {
            law: TRUTH.into(),
            restitution: impact.rebound.as_ref().map(|rebound| rebound.restitution),
            force: Some(impact.largest.f * unit.force),
            dent: impact.rebound.as_ref().map(|rebound| rebound.dent * unit.indentation),
            time: None,
        }));
        let restitutions = restitutions(scene, &choices, unit.as_ref());
        let mut laws = Laws { scene, rows, choices, spread: Vec::new(), restitutions, left_out, truth };
        laws.spread = (0..QUANTITIES.len()).filter_map(|place| laws.spread_of(place)).collect();
        laws
    }

    /// The row of finite elements.
    fn truth_row(&self) -> Option<&Row> {
        self.rows.get(self.choices.len())
    }

    /// The laws with the lowest and the highest value of a quantity.
    fn spread_of(&self, place: usize) -> Option<Spread> {
        let (quantity, unit) = QUANTITIES[place];
        // The scene's law always counts. Hertz's law loses no energy, so it does not describe a target that yields.
        // Rate-dependent laws do not describe dents.
        let counts = |index: usize, choice: &Choice| {
            let no_dent = quantity == "dent" && matches!(choice.model, AnyModel::Damped(_));
            index == 0 || choice.name != "hertz" && !no_dent
        };
        let counted = self.choices.iter().enumerate().filter(|(index, choice)| counts(*index, choice));
        let mut values: Vec<_> =
            counted.filter_map(|(index, choice)| Some((self.rows[index].get(place)?, &choice.name))).collect();
        values.sort_by(|one, other| one.0.total_cmp(&other.0));
        let ((lowest, lowest_by), (highest, highest_by)) = (*values.first()?, *values.last()?);
        Some(Spread {
            quantity,
            unit,
            scene: self.rows.first()?.get(place)?,
            lowest,
            lowest_by: lowest_by.clone(),
            highest,
            highest_by: highest_by.clone(),
            finite_elements: self.truth_row().and_then(|row| row.get(place)),
        })
    }

    /// The place of the law fitted to finite elements.
    fn fitted(&self) -> Option<usize> {
        self.choices.iter().position(|choice| choice.name.split('/').next() == Some(FITTED))
    }

    /// The laws that stand out in pictures, each with its role: the scene's, the one fitted to finite elements, and those
    /// with the lowest and the highest restitution.
    fn strong(&self) -> Vec<(String, &'static str)> {
        let name = |place: usize| self.choices.get(place).map(|choice| choice.name.clone());
        let mut strong: Vec<_> = name(0).map(|name| (name, "the scene's")).into_iter().collect();
        strong.extend(self.fitted().and_then(name).map(|name| (name, "fitted to finite elements")));
        for Spread { lowest_by, highest_by, .. } in self.spread.iter().take(1) {
            strong.extend([lowest_by, highest_by].map(|name| (name.clone(), "an extreme of restitution")));
        }
        strong.extend(self.truth.as_ref().map(|_| (TRUTH.to_string(), "black dots")));
        let mut unique: Vec<(String, &str)> = Vec::new();
        for (name, role) in strong {
            if unique.iter().all(|(other, _)| *other != name) {
                unique.push((name, role));
            }
        }
        unique
    }

    /// The reliability of the scene's law, in sentences.
    pub fn verdict(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        let known = self.spread.iter().filter_map(|spread| {
            Some(format!("{} {}", spread.quantity, percent(spread.scene / spread.finite_elements? - 1.0)))
        });
        let known: Vec<_> = known.collect();
        if !known.is_empty() {
            sentences.push(format!("Difference from {TRUTH}: {}.", known.join(", ")));
        }
        let restitution = |place: usize| self.rows[place].restitution.unwrap_or(f64::NAN);
        if let Some(fitted) = self.fitted().filter(|fitted| *fitted > 0) {
            sentences.push(format!(
                "Restitution by {FITTED}, the law fitted to {TRUTH}: {:.3}. The scene's law differs from it by {}.",
                restitution(fitted),
                percent(restitution(0) / restitution(fitted) - 1.0)
            ));
        }
        if let (Some(spread), 2..) = (self.spread.first(), self.choices.len()) {
            let Spread { lowest, lowest_by, highest, highest_by, .. } = spread;
            sentences.push(format!(
                "Restitution by all {} laws: {lowest:.3} ({lowest_by}) to {highest:.3} ({highest_by}). No step size compensates \
                 for the choice of law.",
                self.choices.len()
            ));
        }
        sentences
    }

    /// The laws that stand out, in words.
    pub fn words(&self) -> String {
        let roles: Vec<_> = self.strong().iter().map(|(name, role)| format!("{name} ({role})")).collect();
        format!("The laws that stand out: {}.", roles.join(", "))
    }

    /// How far finite elements reach, in words.
    pub fn reach(&self) -> Option<String> {
        let (impact, unit) = self.truth.as_ref()?;
        let end = |impact: &truth::Impact| {
            let restitution = impact.rebound.as_ref().map_or(f64::NAN, |rebound| rebound.restitution);
            format!("{} (restitution {restitution:.3})", impact.largest.x)
        };
        let impacts = truth::impacts();
        let ends: Vec<_> = [impacts.first(), impacts.last()].into_iter().flatten().map(end).collect();
        Some(format!(
            "By them this impact reaches {:.3} yield indentations of {}; they know the rebound from {}.",
            impact.largest.x,
            quantity(unit.indentation, "m"),
            ends.join(" to ")
        ))
    }

    /// Force over indentation, unless a law can't be evaluated as deep; restitution over speed.
    pub fn figures(&self) -> Vec<Figure> {
        let strong: Vec<String> = self.strong().into_iter().map(|(name, _)| name).collect();
        let view = |values| View { strong: Some(&strong), values: Some(values), ..View::default() };
        let deepest = self.scene.predictions[0].max_indentation;
        let mut figures = Vec::new();
        if let Ok(picture) = curve::picture(&self.choices, deepest, &self.scene.impact, true) {
            // scaled to the strong lines: an elastic law would flatten all others
            let shown = picture.series.iter().filter(|series| strong.contains(&series.label));
            let highest = shown.flat_map(|series| &series.points).map(|point| point.1).fold(0.0, f64::max);
            let caption = "Force over indentation, in, out, in and out";
            figures.push(Figure::new("laws", caption, &picture, &view(0.0..1.1 * highest), false));
        }
        let series = self.restitutions.chunk_by(|one, other| one.law == other.law).map(|own| Series {
            label: own[0].law.clone(),
            points: own.iter().map(|row| (row.speed_m_per_s, row.restitution)).collect(),
            dots: own[0].law == TRUTH,
        });
        let picture = Picture {
            x_title: "speed [m/s]".into(),
            y_title: "coefficient of restitution".into(),
            logarithmic: (true, false),
            series: series.collect(),
        };
        let caption = "Coefficient of restitution over speed";
        figures.push(Figure::new("restitution", caption, &picture, &view(0.0..1.05), false));
        figures
    }
}

fn row(law: &str, prediction: &Prediction) -> Row {
    let finite = |value: f64| Some(value).filter(|value| value.is_finite());
    Row {
        law: law.into(),
        restitution: finite(prediction.restitution),
        force: finite(prediction.max_force),
        dent: finite(prediction.residual_indentation),
        time: finite(prediction.contact_time()),
    }
}

/// Restitution over speed by every law where it can be evaluated, then by finite elements.
fn restitutions(scene: &Scene, choices: &[Choice], unit: Option<&YieldPoint>) -> Vec<Restitution> {
    let Impact { mass, speed } = scene.impact;
    let [low, high] = [SPEEDS.0 * speed, SPEEDS.1 * speed];
    let speeds = (0..COUNT).map(|point| low * (high / low).powf(f64::from(point) / f64::from(COUNT - 1)));
    let speeds: Vec<f64> = speeds.collect();
    let of = |choice: &Choice| {
        let row = |speed: &f64| {
            let restitution = choice.model.restitution(&Impact { mass, speed: *speed })?;
            Some(Restitution { law: choice.name.clone(), speed_m_per_s: *speed, restitution })
        };
        Ok::<Vec<Restitution>, Infallible>(speeds.iter().filter_map(row).collect())
    };
    let Ok(by_laws) = parallel::each(choices, of);
    let truth = unit.into_iter().flat_map(|unit| {
        truth::impacts().into_iter().filter_map(move |impact| {
            let speed = predict::speed_of_energy(mass, impact.energy * unit.force * unit.indentation);
            Some(Restitution { law: TRUTH.into(), speed_m_per_s: speed, restitution: impact.rebound?.restitution })
        })
    });
    let truth = truth.filter(|row| (low..=high).contains(&row.speed_m_per_s));
    by_laws.into_iter().flatten().chain(truth).collect()
}
