//! The laws side by side for one impact: the spread is what a user can't know without a measurement.

use super::Part;
use super::data::{Cell, Table, number, text};
use crate::curve;
use crate::html::escape;
use crate::laws::{Choice, UnknownLaw, choose};
use crate::model::AnyModel;
use crate::numbers::digits;
use crate::plot::Series;
use crate::predict;
use crate::predict::sweep::Sweep;
use crate::scene::Scene;
use crate::truth;
use brinell::contact::impact::Prediction;
use brinell::contact::loading::AnyLoading;
use brinell::contact::material::{Pair, YieldPoint};

/// What laws are compared by.
struct Quantity {
    name: &'static str,
    unit: &'static str,
    of: fn(&Prediction) -> f64,
    /// What finite elements say of it, where the yield point is this.
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

/// The speeds at which restitution is shown, over the scene's.
const SPEEDS: (f64, f64) = (0.01, 10.0);

/// Every how manyth speed of the picture the table has.
const EVERY: usize = 5;

/// A law with its prediction.
struct Law {
    choice: Choice,
    prediction: Prediction,
}

/// All laws, and the truth.
struct Laws<'a> {
    scene: &'a Scene,
    /// The scene's first.
    laws: Vec<Law>,
    /// Why others aren't there.
    left_out: Vec<String>,
    /// The scene's impact by finite elements, where the yield point is this.
    truth: Option<(truth::Impact, YieldPoint)>,
}

/// The yield point of `scene` as the truth has it, if its target yields.
fn yield_point(scene: &Scene) -> Option<YieldPoint> {
    let pair = Pair { yield_strength: scene.yield_strength?, ..scene.any_model().pair() };
    Some(pair.yield_point(truth::YIELD_PRESSURE_FACTOR))
}

impl Laws<'_> {
    /// The impact of `scene` by every law that its bodies can have.
    fn of(scene: &Scene) -> Laws<'_> {
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

    /// The laws that have an opinion on a quantity.
    fn with_opinion(&self, quantity: &Quantity) -> impl Iterator<Item = (&str, f64)> {
        let no_dent = quantity.name == "dent";
        self.laws.iter().enumerate().filter_map(move |(place, law)| {
            let name = law.choice.name.as_str();
            // the scene's has always one; Hertz's law loses nothing, which says nothing of a target that yields, and no
            // rate-dependent law says anything of a dent
            let none = name == "hertz" || no_dent && matches!(law.choice.model, AnyModel::Damped(_));
            (place == 0 || !none).then(|| (name, (quantity.of)(&law.prediction)))
        })
    }

    /// The law with the lowest value of a quantity, and that with the highest.
    fn spread(&self, quantity: &Quantity) -> Option<[(&str, f64); 2]> {
        let by_value = |one: &(&str, f64), other: &(&str, f64)| one.1.total_cmp(&other.1);
        Some([self.with_opinion(quantity).min_by(by_value)?, self.with_opinion(quantity).max_by(by_value)?])
    }

    /// Every law's prediction, and that of finite elements.
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

    /// How far the laws differ.
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

    /// Restitution over speed, as picture and as table.
    fn restitution(&self) -> (String, Table) {
        let speed = self.scene.impact.speed;
        let range = (SPEEDS.0 * speed, SPEEDS.1 * speed);
        let choices: Vec<_> = self.laws.iter().map(|law| law.choice.clone()).collect();
        let sweep = Sweep::where_possible(&choices, self.scene.impact.mass, range);
        let mut table = Table::new("restitution", [("law", ""), ("speed", "m/s"), ("restitution", "")]);
        // hundreds of rows, which the picture shows
        table.on_page = false;
        let row = |law: &str, speed: f64, restitution: f64| vec![text(law), number(speed), number(restitution)];
        for (law, points) in &sweep.laws {
            let some = points.iter().step_by(EVERY);
            table.rows.extend(some.map(|(speed, prediction)| row(law, *speed, prediction.restitution)));
        }
        let dots = self.dots(range);
        table.rows.extend(dots.iter().map(|(speed, restitution)| row("finite elements", *speed, *restitution)));
        let [mut picture, ..] = sweep.panels();
        if !dots.is_empty() {
            picture.series.push(Series { label: "finite elements".into(), points: dots, dots: true });
        }
        (picture.svg(700, 440), table)
    }

    /// Speeds in `range` [m/s] whose restitution is known from finite elements.
    fn dots(&self, range: (f64, f64)) -> Vec<(f64, f64)> {
        let Some(unit) = yield_point(self.scene) else { return Vec::new() };
        let dot = |impact: truth::Impact| {
            let energy = impact.energy * unit.force * unit.indentation;
            Some((predict::speed_of_energy(self.scene.impact.mass, energy), impact.rebound?.restitution))
        };
        truth::impacts().into_iter().filter_map(dot).filter(|dot| (range.0..=range.1).contains(&dot.0)).collect()
    }

    /// How far restitution differs.
    fn sentence(&self) -> Option<String> {
        let [quantity, ..] = &QUANTITIES;
        let [(lowest_by, lowest), (highest_by, highest)] = self.spread(quantity)?;
        let truth = self.truth_of(quantity).map(|value| format!("; finite elements say {value:.3}"));
        (self.laws.len() > 1).then(|| {
            format!(
                "No step makes up for the choice of the law: by {} laws this impact has a {} from {lowest:.3} ({lowest_by}) to \
                 {highest:.3} ({highest_by}){}.",
                self.laws.len(),
                quantity.name,
                truth.unwrap_or_default()
            )
        })
    }

    /// What there is to say.
    fn words(&self) -> String {
        let spreads = QUANTITIES.iter().filter_map(|quantity| {
            let [(lowest_by, lowest), (highest_by, highest)] = self.spread(quantity)?;
            let (name, unit) = (quantity.name, quantity.unit);
            let words = format!("{name} from {} ({lowest_by}) to {} {unit}", digits(lowest), digits(highest));
            (lowest_by != highest_by).then(|| format!("{} ({highest_by})", words.trim_end()))
        });
        let mut words = match (self.laws.as_slice(), spreads.collect::<Vec<_>>().join("; ")) {
            ([law], _) => format!("The impact by the law {}.", law.choice.name),
            (laws, spreads) => format!(
                "The same impact by {} laws, the scene's first: {spreads}. Hertz's law for a target that yields isn't counted.",
                laws.len()
            ),
        };
        words.push_str(
            " The curves of force go to the largest indentation of the scene's law, those of restitution from a hundredth of \
             the scene's speed to ten times it.",
        );
        if let Some((impact, unit)) = &self.truth {
            words.push_str(&format!(
                " Dots and the last row are finite elements of a rigid sphere on a perfectly plastic half-space of \
                 Poisson's ratio 0.3, in small strain. By them this impact goes to {} yield indentations of {} m",
                digits(impact.largest.x),
                digits(unit.indentation)
            ));
            words.push_str(&match impact.rebound {
                Some(_) => ".".into(),
                None => format!("; the rebound is known {}.", known()),
            });
        }
        for reason in &self.left_out {
            words.push_str(&format!(" Left out: {}.", escape(reason)));
        }
        words
    }
}

/// From where to where finite elements know the rebound.
fn known() -> String {
    let end = |impact: &truth::Impact| {
        let restitution = impact.rebound.as_ref().map_or(f64::NAN, |rebound| rebound.restitution);
        format!("{} (restitution {restitution:.3})", impact.largest.x)
    };
    let impacts = truth::impacts();
    let ends: Vec<_> = [impacts.first(), impacts.last()].into_iter().flatten().map(end).collect();
    format!("from {}", ends.join(" to "))
}

/// The laws side by side, and in a sentence how far they differ, if there are several.
pub fn part(scene: &Scene) -> (Part, Option<String>) {
    let laws = Laws::of(scene);
    let mut words = laws.words();
    let choices: Vec<_> = laws.laws.iter().map(|law| law.choice.clone()).collect();
    let deepest = laws.laws.first().map_or(0.0, |law| law.prediction.max_indentation);
    let mut pictures = Vec::new();
    match curve::svg(&choices, deepest, &scene.impact, true) {
        Ok(svg) => pictures.push(("laws", svg)),
        Err(brinell::contact::TooDeep { .. }) => {
            words.push_str(" There is no picture of the forces: a law can't be evaluated as deep as that.");
        }
    }
    let (picture, restitution) = laws.restitution();
    pictures.push(("restitution", picture));
    let tables = vec![laws.spread_table(), laws.table(), restitution];
    (Part { title: "Laws side by side", words, pictures, tables }, laws.sentence())
}
