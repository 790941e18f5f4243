//! The comparison of the laws for one impact: the spread is what a user can't know without a measurement.

use crate::truth;
use brinell_contact::impact::Prediction;
use brinell_contact::loading::AnyLoading;
use brinell_contact::material::{Pair, YieldPoint};
use brinell_exporter::laws::{Choice, UnknownLaw, choose};
use brinell_exporter::numbers::percent;
use brinell_exporter::predict;
use brinell_exporter::scene::Scene;
use serde::Serialize;

/// The law fitted to finite elements.
const FITTED: &str = "brinell";

/// Name of the data of finite elements.
const TRUTH: &str = "finite elements";

/// A quantity: its name, its unit, and its value.
type Quantity = (&'static str, &'static str, fn(&Prediction) -> f64);

/// The compared quantities.
const QUANTITIES: [Quantity; 4] = [
    ("restitution", "", |prediction| prediction.restitution),
    ("largest force", "N", |prediction| prediction.max_force),
    ("dent", "m", |prediction| prediction.residual_indentation),
    ("contact time", "s", Prediction::contact_time),
];

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

/// All laws, and the finite-element results.
#[derive(Serialize)]
pub struct Laws {
    /// The scene's first.
    #[serde(skip)]
    choices: Vec<Choice>,
    #[serde(skip)]
    predictions: Vec<Prediction>,
    spread: Vec<Spread>,
    /// Reasons for missing laws.
    left_out: Vec<String>,
}

impl Laws {
    /// The impact of `scene` with every law that its bodies support.
    pub fn of(scene: &Scene) -> Laws {
        let mut wanted: Vec<Choice> = choose(scene, &[]).unwrap_or_default();
        let (mut left_out, mut without_strength) = (Vec::new(), 0);
        let own = wanted.first().map(|choice| choice.name.clone()).unwrap_or_default();
        for (name, _) in AnyLoading::of_balls().filter(|(name, _)| *name != own && scene.line.is_none()) {
            match choose(scene, &[name.to_string()]) {
                Ok(more) => wanted.extend(more),
                Err(UnknownLaw::NoYieldStrength(_)) => without_strength += 1,
                Err(error) => left_out.push(error.to_string()),
            }
        }
        if without_strength > 0 {
            left_out.push(format!("{without_strength} laws need target.yield_strength (or a material)"));
        }
        let (mut choices, mut predictions) = (Vec::new(), Vec::new());
        for choice in wanted {
            match predict::one(&choice, &scene.impact) {
                Ok(prediction) => {
                    predictions.push(prediction);
                    choices.push(choice);
                }
                Err(error) => left_out.push(error.to_string()),
            }
        }
        // the yield point as the finite-element results define it, if a body yields
        let pair = scene.yield_strength.map(|yield_strength| Pair { yield_strength, ..scene.any_model().pair() });
        let unit = pair.map(|pair| pair.yield_point(truth::YIELD_PRESSURE_FACTOR));
        let mut laws = Laws { choices, predictions, spread: Vec::new(), left_out };
        let truth = unit.map_or([None; QUANTITIES.len()], |unit| by_finite_elements(scene, &unit));
        laws.spread = (0..QUANTITIES.len()).filter_map(|place| laws.spread_of(place, truth[place])).collect();
        laws
    }

    /// The laws with the lowest and the highest value of a quantity, which is `finite_elements` by these.
    fn spread_of(&self, place: usize, finite_elements: Option<f64>) -> Option<Spread> {
        let (quantity, unit, value) = QUANTITIES[place];
        // The scene's law always counts. Hertz's law loses no energy, so it does not describe a target that yields.
        // Rate-dependent laws do not describe dents.
        let counts = |index: usize, choice: &Choice| {
            let no_dent = quantity == "dent" && choice.model.rate_law().is_some();
            index == 0 || choice.name != "hertz" && !no_dent
        };
        let all = self.choices.iter().zip(&self.predictions).enumerate();
        let counted = all.filter(|(index, (choice, _))| counts(*index, choice));
        let mut values: Vec<_> = counted.map(|(_, (choice, prediction))| (value(prediction), &choice.name)).collect();
        values.retain(|(value, _)| value.is_finite());
        values.sort_by(|one, other| one.0.total_cmp(&other.0));
        let ((lowest, lowest_by), (highest, highest_by)) = (*values.first()?, *values.last()?);
        Some(Spread {
            quantity,
            unit,
            scene: value(self.predictions.first()?),
            lowest,
            lowest_by: lowest_by.clone(),
            highest,
            highest_by: highest_by.clone(),
            finite_elements,
        })
    }

    /// The place of the law fitted to finite elements.
    fn fitted(&self) -> Option<usize> {
        self.choices.iter().position(|choice| choice.name.split('/').next() == Some(FITTED))
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
        let restitution = |place: usize| self.predictions[place].restitution;
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
}

/// The quantities of the impact of `scene` by finite elements, where they reach.
fn by_finite_elements(scene: &Scene, unit: &YieldPoint) -> [Option<f64>; QUANTITIES.len()] {
    let impact = truth::impact(scene.impact.energy() / (unit.force * unit.indentation));
    let Some(impact) = impact.filter(|impact| truth::is_of(scene, impact.largest.x * unit.indentation)) else {
        return [None; QUANTITIES.len()];
    };
    let rebound = impact.rebound.as_ref();
    let restitution = rebound.map(|rebound| rebound.restitution);
    [restitution, Some(impact.largest.f * unit.force), rebound.map(|rebound| rebound.dent * unit.indentation), None]
}
