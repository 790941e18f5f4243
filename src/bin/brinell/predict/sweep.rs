//! `brinell predict --sweep`: predictions over a range of one quantity, as a table and as a picture.

use super::axis::{Axis, varied};
use super::{PredictError, beyond, one, quantities};
use crate::columns::{Column, Columns, some};
use crate::laws::Choice;
use crate::layout;
use crate::numbers::{cell, prefixed};
use crate::plot::{Picture, Series, side_by_side};
use crate::scene::Scene;
use crate::validity;
use brinell::contact::impact::{Impact, Prediction};

/// Number of values in a sweep that goes to a file.
pub const VALUES: usize = 201;

/// Number of rows of the table in a terminal.
const ROWS: usize = 9;

/// Number of values in a table with a row for each law.
pub const GRID_COLUMNS: usize = 6;

/// The name of a quantity, its unit and its value.
pub type Shown = (&'static str, &'static str, fn(&Prediction) -> f64);

/// The columns of such tables and of the maps.
pub const SHOWN: [Shown; 3] = [
    ("restitution", "", |prediction| prediction.restitution),
    ("largest force", "N", |prediction| prediction.max_force),
    ("dent", "m", |prediction| prediction.residual_indentation),
];

/// Decades of dents in the picture: just beyond yield, dents are arbitrarily small.
const DENT_DECADES: i32 = 6;

/// Predictions over a range of a quantity.
pub struct Sweep {
    /// The varied quantity.
    pub axis: Axis,
    /// The fixed quantities.
    pub impact: Impact,
    /// Each law with its impacts, in the order of the values.
    pub laws: Vec<(String, Vec<Point>)>,
    pub limits: validity::SweepLimits,
}

/// A value of the quantity and its impact.
pub type Point = (f64, Prediction);

impl Sweep {
    /// `impact` with each value of `axis`, for the laws of `choices`.
    ///
    /// # Errors
    /// [`PredictError`] for the first value that is impossible, or beyond the range of a law.
    pub fn of(scene: &Scene, choices: &[Choice], impact: Impact, axis: Axis) -> Result<Sweep, PredictError> {
        let values = axis.values(VALUES);
        let mut limits = validity::SweepLimits { names: vec![(axis.name, axis.unit)], impacts: Vec::new() };
        let mut point = |choice: &Choice, value: f64| -> Result<Point, PredictError> {
            let (choice, impact) = varied(scene, choice, impact, &[(&axis, value)])?;
            let prediction = one(&choice, &impact)?;
            limits.impacts.push((vec![value], beyond(scene, &choice, &impact, &prediction)));
            Ok((value, prediction))
        };
        let mut points = |choice: &Choice| {
            values.iter().map(|value| point(choice, *value)).collect::<Result<Vec<_>, PredictError>>()
        };
        let law = |choice: &Choice| Ok((choice.laws.clone(), points(choice)?));
        let laws = choices.iter().map(law).collect::<Result<_, PredictError>>()?;
        Ok(Sweep { axis, impact, laws, limits })
    }

    /// The sweep as columns.
    pub fn columns(&self) -> Columns {
        let mut columns = vec![Column::new(self.axis.name, self.axis.unit)];
        let prediction = self.laws.iter().flat_map(|(_, points)| points).next().map(|(_, prediction)| prediction);
        let quantities_of = |prediction: &Prediction| quantities(prediction).into_iter();
        let names = prediction.into_iter().flat_map(quantities_of).filter(|(name, ..)| *name != self.axis.name);
        columns.extend(names.map(|(name, _, unit)| Column::new(name, unit)));
        columns.push(Column::new("regime", ""));
        let row = |(value, prediction): &Point| {
            let numbers = quantities_of(prediction).filter(|(name, ..)| *name != self.axis.name);
            let numbers = numbers.map(|(_, number, _)| number);
            [*value].into_iter().chain(numbers).chain([f64::from(prediction.regime as i32)]).collect()
        };
        let laws = self.laws.iter().map(|(law, points)| (law.clone(), points.iter().map(row).collect()));
        Columns { columns, laws: laws.collect() }.with_valid(self.limits.valid())
    }

    /// A short table for a terminal. One law: a row for each value. Several laws: a row for each law.
    pub fn text(&self) -> String {
        let [(_, points)] = self.laws.as_slice() else { return self.grids() };
        let names = [self.axis.name, "restitution", "largest force", "largest indentation", "dent", "loading time"];
        let mut text = self.columns().text(&names, ROWS);
        if points.len() > ROWS {
            text += &format!("\n{ROWS} of {} values; -o FILE.csv writes all of them with all digits\n", points.len());
        }
        text
    }

    /// A row for each law, with some values of the quantity.
    fn grids(&self) -> String {
        let values: Vec<f64> =
            self.laws.first().into_iter().flat_map(|(_, points)| points).map(|point| point.0).collect();
        let shown = some(values.len(), GRID_COLUMNS);
        let heads: Vec<f64> = shown.iter().map(|place| values[*place]).collect();
        let grids = SHOWN.map(|(name, unit, of)| {
            let row = |(law, points): &(String, Vec<Point>)| {
                (law.clone(), shown.iter().map(|place| of(&points[*place].1)).collect())
            };
            let rows: Vec<_> = self.laws.iter().map(row).collect();
            grid((name, unit), "law", &self.axis, &heads, &rows)
        });
        grids.join("\n")
    }

    /// Restitution, largest force and dent over the quantity.
    pub fn panels(&self) -> [Picture; 3] {
        let panel = |title: &str, logarithmic, value: &dyn Fn(&Prediction) -> f64| Picture {
            x_title: self.axis.title(),
            y_title: title.into(),
            logarithmic: (self.axis.is_logarithmic(), logarithmic),
            series: self.series(value),
        };
        let predictions = || self.laws.iter().flat_map(|(_, points)| points).map(|(_, prediction)| prediction);
        let deepest = predictions().map(|prediction| prediction.residual_indentation).fold(0.0, f64::max);
        let shallowest = deepest * 10f64.powi(-DENT_DECADES);
        let dent = |prediction: &Prediction| {
            let dent = prediction.residual_indentation;
            // pictures omit NaN
            if dent >= shallowest { dent } else { f64::NAN }
        };
        [
            panel("coefficient of restitution", false, &|prediction| prediction.restitution),
            panel("largest force [N]", self.axis.is_logarithmic(), &|prediction| prediction.max_force),
            // if there is no dent at all, show the zeros
            panel("depth of the dent [m]", deepest > 0.0 && self.axis.is_logarithmic(), &dent),
        ]
    }

    fn series(&self, value: &dyn Fn(&Prediction) -> f64) -> Vec<Series> {
        let line = |(law, points): &(String, Vec<Point>)| Series {
            label: law.clone(),
            points: points.iter().map(|(speed, prediction)| (*speed, value(prediction))).collect(),
            dots: false,
        };
        self.laws.iter().map(line).collect()
    }

    /// The three panels as one picture.
    pub fn svg(&self) -> String {
        side_by_side(&self.panels(), 1200, 380)
    }
}

/// One quantity over the values `heads` of `axis`, in rows with names; `corner` describes the rows.
pub fn grid(
    (name, unit): (&str, &'static str),
    corner: &str,
    axis: &Axis,
    heads: &[f64],
    rows: &[(String, Vec<f64>)],
) -> String {
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let unit = prefixed(largest(&mut rows.iter().flat_map(|(_, values)| values).copied()), unit);
    let head_unit = prefixed(largest(&mut heads.iter().copied()), axis.unit);
    let cells = |first: &str, values: &[f64], size: f64| {
        [first.to_string()].into_iter().chain(values.iter().map(|value| cell(*value, size))).collect::<Vec<_>>()
    };
    let mut lines = vec![cells(corner, heads, head_unit.size)];
    lines.extend(rows.iter().map(|(name, values)| cells(name, values, unit.size)));
    format!("{} by {}\n{}", unit.after(name), head_unit.after(axis.name), layout::table(&lines, 1, 2))
}
