//! The comparison of the laws as text and pictures.

use super::{Laws, QUANTITIES, Quantity, yield_point};
use crate::curve;
use crate::html::escape;
use crate::laws::Choice;
use crate::numbers::{percent, quantity};
use crate::parallel;
use crate::plot::{NameAt, Picture, Series, View, css_lines};
use crate::predict;
use crate::predict::axis::Axis;
use crate::predict::sweep::VALUES;
use crate::report::data::{Table, number, text};
use crate::report::{Figure, Part};
use crate::truth;
use brinell_contact::TooDeep;
use brinell_contact::impact::Impact;
use std::convert::Infallible;
use std::ops::Range;

/// The range of speeds for restitution, relative to the scene's.
const SPEEDS: (f64, f64) = (0.01, 10.0);

/// The table shows one of this many speeds of the picture.
const EVERY: usize = 5;

/// The law fitted to finite elements.
const FITTED: &str = "brinell";

/// Name of the data series.
const TRUTH: &str = "finite elements";

/// Range of restitution.
const RESTITUTIONS: Range<f64> = 0.0..1.05;

impl Laws<'_> {
    fn choices(&self) -> Vec<Choice> {
        self.laws.iter().map(|law| law.choice.clone()).collect()
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        self.laws.iter().map(|law| law.choice.name.as_str())
    }

    /// The laws that stand out in pictures: the scene's, the one fitted to finite elements, and those with the lowest
    /// and the highest restitution.
    fn strong(&self) -> Vec<String> {
        let mut strong: Vec<&str> = self.names().take(1).collect();
        strong.extend(self.fitted().map(|law| law.choice.name.as_str()));
        strong.extend(self.spread(&QUANTITIES[0]).into_iter().flatten().map(|(name, _)| name));
        strong.push(TRUTH);
        let mut unique: Vec<String> = Vec::new();
        for name in strong {
            if !unique.iter().any(|other| other == name) {
                unique.push(name.into());
            }
        }
        unique
    }

    /// The law fitted to finite elements.
    fn fitted(&self) -> Option<&super::Law> {
        self.laws.iter().find(|law| law.choice.name.split('/').next() == Some(FITTED))
    }

    /// The reliability of the scene's law, in sentences.
    pub fn verdict(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        let Some(own) = self.laws.first() else { return sentences };
        let known = |quantity: &Quantity| {
            let (value, truth) = ((quantity.of)(&own.prediction), self.truth_of(quantity)?);
            Some(format!("{} {}", quantity.name, percent(value / truth - 1.0)))
        };
        let known: Vec<_> = QUANTITIES.iter().filter_map(known).collect();
        if !known.is_empty() {
            sentences.push(format!("Difference from {TRUTH}: {}.", known.join(", ")));
        }
        let [quantity, ..] = &QUANTITIES;
        let restitution = |law: &super::Law| (quantity.of)(&law.prediction);
        if let Some(fitted) = self.fitted().filter(|fitted| fitted.choice.name != own.choice.name) {
            sentences.push(format!(
                "Restitution by {FITTED}, the law fitted to {TRUTH}: {:.3}. The scene's law differs from it by {}.",
                restitution(fitted),
                percent(restitution(own) / restitution(fitted) - 1.0)
            ));
        }
        if let (Some([(lowest_by, lowest), (highest_by, highest)]), 2..) = (self.spread(quantity), self.laws.len()) {
            sentences.push(format!(
                "Restitution by all {} laws: {lowest:.3} ({lowest_by}) to {highest:.3} ({highest_by}). No step size compensates \
                 for the choice of law.",
                self.laws.len()
            ));
        }
        sentences
    }

    /// Force over indentation; `None` beyond the range of a law.
    fn forces(&self) -> Result<Figure, TooDeep> {
        let deepest = self.laws.first().map_or(0.0, |law| law.prediction.max_indentation);
        let picture = curve::picture(&self.choices(), deepest, &self.scene.impact, true)?;
        let strong = self.strong();
        // scaled to the strong lines: an elastic law would flatten all others
        let highest =
            picture.series.iter().filter(|series| strong.contains(&series.label)).flat_map(|series| &series.points);
        let highest = highest.map(|point| point.1).fold(0.0, f64::max);
        let view =
            View { strong: Some(strong), name_at: NameAt::Top, values: Some(0.0..1.1 * highest), ..View::default() };
        let svg = picture.labelled(480, 350, &view);
        Ok(Figure { name: "laws", caption: "Force over indentation".into(), svg, folded: false })
    }

    /// Restitution over speed, as picture and as table.
    fn restitution(&self) -> (Figure, Table) {
        let speed = self.scene.impact.speed;
        let range = (SPEEDS.0 * speed, SPEEDS.1 * speed);
        let axis = Axis::speeds(range);
        let speeds = axis.values(VALUES);
        let line = |choice: &Choice| {
            // nothing where the law can't be evaluated
            let point = |speed: &f64| {
                let impact = Impact { mass: self.scene.impact.mass, speed: *speed };
                Some((*speed, choice.model.restitution(&impact)?))
            };
            Ok::<_, Infallible>((choice.name.clone(), speeds.iter().filter_map(point).collect()))
        };
        let Ok(lines) = parallel::each::<_, (String, Vec<(f64, f64)>), _>(&self.choices(), line);
        let mut table = Table::new("restitution", [("law", ""), ("speed", "m/s"), ("restitution", "")]);
        // hundreds of rows; the picture shows them
        table.on_page = false;
        let row = |law: &str, speed: f64, restitution: f64| vec![text(law), number(speed), number(restitution)];
        for (law, points) in &lines {
            table.rows.extend(points.iter().step_by(EVERY).map(|(speed, restitution)| row(law, *speed, *restitution)));
        }
        let dots = self.dots(range);
        table.rows.extend(dots.iter().map(|(speed, restitution)| row(TRUTH, *speed, *restitution)));
        let line = |(label, points)| Series { label, points, dots: false };
        let mut picture = Picture {
            x_title: "speed [m/s]".into(),
            y_title: "coefficient of restitution".into(),
            logarithmic: (axis.is_logarithmic(), false),
            series: lines.into_iter().map(line).collect(),
        };
        if !dots.is_empty() {
            picture.series.push(Series { label: TRUTH.into(), points: dots, dots: true });
        }
        let view = View { strong: Some(self.strong()), values: Some(RESTITUTIONS), ..View::default() };
        let svg = picture.labelled(480, 350, &view);
        (
            Figure { name: "restitution", caption: "Coefficient of restitution over speed".into(), svg, folded: false },
            table,
        )
    }

    /// Speeds in `range` [m/s] with a known restitution from finite elements.
    fn dots(&self, range: (f64, f64)) -> Vec<(f64, f64)> {
        let Some(unit) = yield_point(self.scene) else { return Vec::new() };
        let dot = |impact: truth::Impact| {
            let energy = impact.energy * unit.force * unit.indentation;
            Some((predict::speed_of_energy(self.scene.impact.mass, energy), impact.rebound?.restitution))
        };
        truth::impacts().into_iter().filter_map(dot).filter(|dot| (range.0..=range.1).contains(&dot.0)).collect()
    }

    /// The method of the comparison.
    fn method(&self) -> String {
        let mut words = String::from(
            "Each loading law takes the unloading law that it was published with, or else the scene's. The curves of force go to \
             the largest indentation of the scene's law, those of restitution from a hundredth of the scene's speed to ten times \
             the speed. Hertz's law for a target that yields isn't counted in the spread.",
        );
        if let Some((impact, unit)) = &self.truth {
            words.push_str(&format!(
                " Dots and the last row are finite elements of a rigid sphere on a perfectly plastic half-space of Poisson's ratio \
                 0.3, in small strain. By them this impact reaches {:.3} yield indentations of {}",
                impact.largest.x,
                quantity(unit.indentation, "m")
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

    /// The comparison of the laws.
    pub fn part(&self) -> Part {
        let mut words = String::from("The laws that stand out: ");
        let strong = self.strong();
        let roles = strong.iter().map(|name| match name.as_str() {
            TRUTH => format!("{TRUTH} (black dots)"),
            name if Some(name) == self.names().next() => format!("{name} (the scene's)"),
            name if name.split('/').next() == Some(FITTED) => format!("{name} (fitted to {TRUTH})"),
            name => format!("{name} (an extreme of restitution)"),
        });
        let known = |role: &String| !role.starts_with(TRUTH) || self.truth.is_some();
        words.push_str(&format!("{}.", roles.filter(known).collect::<Vec<_>>().join(", ")));
        let mut figures = Vec::new();
        match self.forces() {
            Ok(figure) => figures.push(figure),
            Err(TooDeep { .. }) => {
                words.push_str(
                    " There is no picture of the forces, because one of the laws can't be evaluated as deep as this.",
                );
            }
        }
        let (figure, restitution) = self.restitution();
        figures.push(figure);
        let lines = self.names().map(String::from).zip(css_lines(self.names()));
        Part {
            title: "Laws side by side",
            words,
            figures,
            switches: lines.filter(|(name, _)| !strong.contains(name)).collect(),
            method: self.method(),
            tables: vec![self.spread_table(), self.table(), restitution],
        }
    }
}

/// The range in which finite elements determine the rebound.
fn known() -> String {
    let end = |impact: &truth::Impact| {
        let restitution = impact.rebound.as_ref().map_or(f64::NAN, |rebound| rebound.restitution);
        format!("{} (restitution {restitution:.3})", impact.largest.x)
    };
    let impacts = truth::impacts();
    let ends: Vec<_> = [impacts.first(), impacts.last()].into_iter().flatten().map(end).collect();
    format!("from {}", ends.join(" to "))
}
