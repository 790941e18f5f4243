//! `brinell predict` with two sweeps: an impact over two quantities.

use super::axis::{Axis, varied};
use super::sweep::{GRID_COLUMNS, SHOWN, grid};
use super::{PredictError, beyond, one, quantities};
use crate::columns::{Column, Columns, some};
use crate::laws::Choice;
use crate::numbers::{cell, prefixed};
use crate::plot::{HeatMap, Quantity, heat_maps};
use crate::scene::Scene;
use crate::validity;
use brinell::contact::impact::{Impact, Prediction};

/// Number of values of each quantity.
const VALUES: usize = 41;

/// Number of rows of a map in a terminal.
const ROWS: usize = 8;

/// Predictions over two quantities.
pub struct Map {
    /// The quantities of the columns and of the rows.
    pub axes: [Axis; 2],
    values: [Vec<f64>; 2],
    /// Each law with its impacts, as rows of columns.
    pub laws: Vec<(String, Vec<Vec<Prediction>>)>,
    pub limits: validity::SweepLimits,
}

impl Map {
    /// `impact` with each pair of values of `axes`, for the laws of `choices`.
    ///
    /// # Errors
    /// [`PredictError`] for the first pair that is impossible, or beyond the range of a law.
    pub fn of(scene: &Scene, choices: &[Choice], impact: Impact, axes: [Axis; 2]) -> Result<Map, PredictError> {
        if axes[0].name == axes[1].name {
            return Err(PredictError::Sweep(format!("{}: a map needs two different quantities", axes[0].name)));
        }
        let values = axes.each_ref().map(|axis| axis.values(VALUES));
        let names = axes.iter().map(|axis| (axis.name, axis.unit)).collect();
        let mut limits = validity::SweepLimits { names, impacts: Vec::new() };
        let mut point = |choice: &Choice, first: f64, second: f64| -> Result<Prediction, PredictError> {
            let (choice, impact) = varied(scene, choice, impact, &[(&axes[0], first), (&axes[1], second)])?;
            let prediction = one(&choice, &impact)?;
            limits.impacts.push((vec![first, second], beyond(scene, &choice, &impact, &prediction)));
            Ok(prediction)
        };
        let mut row =
            |choice: &Choice, second: f64| values[0].iter().map(|first| point(choice, *first, second)).collect();
        let law = |choice: &Choice| {
            let rows = values[1].iter().map(|second| row(choice, *second)).collect::<Result<_, PredictError>>()?;
            Ok((choice.laws.clone(), rows))
        };
        let laws = choices.iter().map(law).collect::<Result<_, PredictError>>()?;
        Ok(Map { axes, values, laws, limits })
    }

    /// Number of impacts for each law.
    pub fn count(&self) -> usize {
        self.values[0].len() * self.values[1].len()
    }

    /// A row for each pair of values.
    pub fn columns(&self) -> Columns {
        let names: Vec<_> = self.axes.iter().map(|axis| (axis.name, axis.unit)).collect();
        let is_new = |(name, ..): &(&'static str, f64, &'static str)| !names.iter().any(|(other, _)| other == name);
        let mut columns: Vec<_> = names.iter().map(|(name, unit)| Column::new(*name, unit)).collect();
        let mut laws = Vec::new();
        for (law, rows) in &self.laws {
            let mut lines = Vec::new();
            for (row, second) in rows.iter().zip(&self.values[1]) {
                for (prediction, first) in row.iter().zip(&self.values[0]) {
                    let numbers = quantities(prediction).into_iter().filter(is_new);
                    if columns.len() == 2 {
                        columns.extend(numbers.clone().map(|(name, _, unit)| Column::new(name, unit)));
                    }
                    let mut line = vec![*first, *second];
                    line.extend(numbers.map(|(_, number, _)| number));
                    line.push(f64::from(prediction.regime as i32));
                    lines.push(line);
                }
            }
            laws.push((law.clone(), lines));
        }
        columns.push(Column::new("regime", ""));
        Columns { columns, laws }.with_valid(self.limits.valid())
    }

    /// Short tables for a terminal.
    pub fn text(&self) -> String {
        let places = [some(self.values[0].len(), GRID_COLUMNS), some(self.values[1].len(), ROWS)];
        let heads: Vec<f64> = places[0].iter().map(|place| self.values[0][*place]).collect();
        let largest = self.values[1].iter().map(|value| value.abs()).fold(0.0, f64::max);
        let unit = prefixed(largest, self.axes[1].unit);
        let mut text = String::new();
        for (law, predictions) in &self.laws {
            if !text.is_empty() {
                text.push('\n');
            }
            text += &format!("{law}\n");
            for (name, quantity_unit, of) in SHOWN {
                let row = |second: &usize| {
                    let numbers = places[0].iter().map(|first| of(&predictions[*second][*first])).collect();
                    (cell(self.values[1][*second], unit.size), numbers)
                };
                let rows: Vec<_> = places[1].iter().map(row).collect();
                let corner = unit.after(self.axes[1].name);
                text.push('\n');
                text += &grid((name, quantity_unit), &corner, &self.axes[0], &heads, &rows);
            }
        }
        if places[0].len() * places[1].len() < self.count() {
            text += "\nsome of the values; -o FILE.csv writes all of them with all digits\n";
        }
        text
    }

    /// The maps of one law: restitution, largest force and dent.
    fn maps(&self, predictions: &[Vec<Prediction>]) -> [HeatMap<'_>; 3] {
        SHOWN.map(|(name, unit, of)| {
            let values: Vec<Vec<f64>> = predictions.iter().map(|row| row.iter().map(of).collect()).collect();
            let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
            let [columns, rows] = [0, 1].map(|index| Quantity {
                name: self.axes[index].name,
                title: self.axes[index].title(),
                values: &self.values[index],
            });
            HeatMap { title: format!("{name}{unit}"), columns, rows, values }
        })
    }

    /// The maps of all laws as one picture, three beside each other for each law.
    pub fn svg(&self) -> String {
        let rows: Vec<_> = self.laws.iter().map(|(law, predictions)| (law.as_str(), self.maps(predictions))).collect();
        heat_maps(&rows)
    }
}
