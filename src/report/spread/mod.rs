//! The comparison of the laws for one impact: the spread is what a user can't know without a measurement.

mod page;

use super::data::{Cell, Table, number, text};
use crate::laws::{Choice, UnknownLaw, choose};
use crate::model::AnyModel;
use crate::predict;
use crate::scene::Scene;
use crate::truth;
use brinell_contact::impact::Prediction;
use brinell_contact::loading::AnyLoading;
use brinell_contact::material::{Pair, YieldPoint};

/// The compared quantities.
struct Quantity {
    name: &'static str,
    unit: &'static str,
    of: fn(&Prediction) -> f64,
    /// Its value from finite elements, for this yield point.
    truth: fn(&truth::Impact, &YieldPoint) -> Option<f64>,
}

const QUANTITIES: [Quantity; 4] = [
    Quantity {
        name: "restitution",
        unit: "",
        of: |prediction| prediction.restitution,
        truth: |impact, _| Some(impact.rebound.as_ref()?.restitution),
    },
    Quantity {
        name: "largest force",
        unit: "N",
        of: |prediction| prediction.max_force,
        truth: |impact, unit| Some(impact.largest.f * unit.force),
    },
    Quantity {
        name: "dent",
        unit: "m",
        of: |prediction| prediction.residual_indentation,
        truth: |impact, unit| Some(impact.rebound.as_ref()?.dent * unit.indentation),
    },
    Quantity { name: "contact time", unit: "s", of: Prediction::contact_time, truth: |_, _| None },
];

/// A law with its prediction.
struct Law {
    choice: Choice,
    prediction: Prediction,
}

/// All laws, and the finite-element results.
pub struct Laws<'a> {
    scene: &'a Scene,
    /// The scene's first.
    laws: Vec<Law>,
    /// Reasons for missing laws.
    left_out: Vec<String>,
    /// The scene's impact from finite elements, for this yield point.
    truth: Option<(truth::Impact, YieldPoint)>,
}

/// The yield point of `scene` as the finite-element results define it, if a body yields.
fn yield_point(scene: &Scene) -> Option<YieldPoint> {
    let pair = Pair { yield_strength: scene.yield_strength?, ..scene.any_model().pair() };
    Some(pair.yield_point(truth::YIELD_PRESSURE_FACTOR))
}

impl Laws<'_> {
    /// The impact of `scene` with every law that its bodies support.
    pub fn of(scene: &Scene) -> Laws<'_> {
        let mut choices: Vec<Choice> = choose(scene, &[]).unwrap_or_default();
        let (mut left_out, mut without_strength) = (Vec::new(), 0);
        let own = choices.first().map(|choice| choice.name.clone()).unwrap_or_default();
        for (name, _) in AnyLoading::ALL.iter().filter(|(name, _)| *name != own) {
            match choose(scene, &[(*name).to_string()]) {
                Ok(more) => choices.extend(more),
                Err(UnknownLaw::NoYieldStrength(_)) => without_strength += 1,
                Err(error) => left_out.push(error.to_string()),
            }
        }
        if without_strength > 0 {
            left_out.push(format!("{without_strength} laws need target.yield_strength (or a material)"));
        }
        let mut laws = Vec::new();
        for choice in choices {
            match predict::one(&choice, &scene.impact) {
                Ok(prediction) => laws.push(Law { choice, prediction }),
                Err(error) => left_out.push(error.to_string()),
            }
        }
        let energy = 0.5 * scene.impact.mass * scene.impact.speed * scene.impact.speed;
        let truth = yield_point(scene).and_then(|unit| {
            let impact = truth::impact(energy / (unit.force * unit.indentation))?;
            Some((impact, unit))
        });
        Laws { scene, laws, left_out, truth }
    }

    fn truth_of(&self, quantity: &Quantity) -> Option<f64> {
        self.truth.as_ref().and_then(|(impact, unit)| (quantity.truth)(impact, unit))
    }

    /// The laws that determine a quantity.
    fn with_opinion(&self, quantity: &Quantity) -> impl Iterator<Item = (&str, f64)> {
        let no_dent = quantity.name == "dent";
        self.laws.iter().enumerate().filter_map(move |(place, law)| {
            let name = law.choice.name.as_str();
            // The scene's law always does. Hertz's law loses no energy, so it does not describe a target that yields.
            // Rate-dependent laws do not describe dents.
            let none = name == "hertz" || no_dent && matches!(law.choice.model, AnyModel::Damped(_));
            (place == 0 || !none).then(|| (name, (quantity.of)(&law.prediction)))
        })
    }

    /// The laws with the lowest and the highest value of a quantity.
    fn spread(&self, quantity: &Quantity) -> Option<[(&str, f64); 2]> {
        let by_value = |one: &(&str, f64), other: &(&str, f64)| one.1.total_cmp(&other.1);
        Some([self.with_opinion(quantity).min_by(by_value)?, self.with_opinion(quantity).max_by(by_value)?])
    }

    /// The predictions of all laws and of finite elements.
    fn table(&self) -> Table {
        let [restitution, force, dent, time] = QUANTITIES.map(|quantity| (quantity.name, quantity.unit));
        let mut table = Table::new("laws", [("law", ""), restitution, force, dent, time]);
        let row = |name: &str, value: &dyn Fn(&Quantity) -> Option<f64>| {
            let values = QUANTITIES.iter().map(|quantity| value(quantity).map_or(Cell::Empty, number));
            [text(name)].into_iter().chain(values).collect()
        };
        table.rows = self
            .laws
            .iter()
            .map(|law| row(&law.choice.name, &|quantity| Some((quantity.of)(&law.prediction))))
            .collect();
        if self.truth.is_some() {
            table.rows.push(row("finite elements", &|quantity| self.truth_of(quantity)));
        }
        table
    }

    /// The differences between the laws.
    fn spread_table(&self) -> Table {
        let columns = [
            ("quantity", ""),
            ("unit", ""),
            ("scene", ""),
            ("lowest", ""),
            ("lowest by", ""),
            ("highest", ""),
            ("highest by", ""),
            ("finite elements", ""),
        ];
        let mut table = Table::new("spread", columns);
        table.rows = QUANTITIES
            .iter()
            .filter_map(|quantity| {
                let [(lowest_by, lowest), (highest_by, highest)] = self.spread(quantity)?;
                Some(vec![
                    text(quantity.name),
                    text(quantity.unit),
                    number((quantity.of)(&self.laws.first()?.prediction)),
                    number(lowest),
                    text(lowest_by),
                    number(highest),
                    text(highest_by),
                    self.truth_of(quantity).map_or(Cell::Empty, number),
                ])
            })
            .collect();
        table
    }
}
