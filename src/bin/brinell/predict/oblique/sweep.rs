//! Oblique impacts over a range of one quantity.

use super::{Outcome, Setting, one};
use crate::columns::{Column, Columns};
use crate::laws::Choice;
use crate::predict::PredictError;
use crate::predict::axis::Axis;
use crate::scene::Scene;
use crate::validity;
use brinell::contact::impact::Impact;

/// Number of values in a sweep without a number of its own.
const VALUES: usize = 101;

/// Number of rows of the table in a terminal.
const ROWS: usize = 9;

/// Rebounds over a range of a quantity.
pub struct Sweep {
    /// The varied quantity.
    pub axis: Axis,
    /// Each law with its impacts, in the order of the values.
    pub laws: Vec<(String, Vec<(f64, Outcome)>)>,
}

impl Sweep {
    /// `impact` with each value of `axis`, for the laws of `choices`.
    ///
    /// # Errors
    /// [`PredictError`] for the first value that is impossible, or beyond the range of a law.
    pub fn of(scene: &Scene, choices: &[Choice], asked: (Impact, Setting), axis: Axis) -> Result<Sweep, PredictError> {
        let values = axis.values(VALUES);
        let point = |choice: &Choice, value: f64| -> Result<_, PredictError> {
            Ok((value, one(scene, choice, asked, &[(&axis, value)])?))
        };
        let points = |choice: &Choice| {
            values.iter().map(|value| point(choice, *value)).collect::<Result<Vec<_>, PredictError>>()
        };
        let law = |choice: &Choice| Ok((choice.laws.clone(), points(choice)?));
        let laws = choices.iter().map(law).collect::<Result<_, PredictError>>()?;
        Ok(Sweep { axis, laws })
    }

    /// The sweep as columns.
    pub fn columns(&self) -> Columns {
        let mut columns = vec![Column::new(self.axis.name, self.axis.unit)];
        let first = self.laws.iter().flat_map(|(_, points)| points).next();
        columns.extend(
            first.iter().flat_map(|(_, outcome)| outcome.quantities()).map(|(name, _, unit)| Column::new(name, unit)),
        );
        let row = |(value, outcome): &(f64, Outcome)| {
            [*value].into_iter().chain(outcome.quantities().into_iter().map(|(_, number, _)| number)).collect()
        };
        let laws = self.laws.iter().map(|(law, points)| (law.clone(), points.iter().map(row).collect()));
        Columns { columns, laws: laws.collect() }.with_valid(self.limits().valid())
    }

    /// The limits of validity that the impacts exceed.
    pub fn limits(&self) -> validity::SweepLimits {
        let impacts = self.laws.iter().flat_map(|(_, points)| points);
        let impacts = impacts.map(|(value, outcome)| (vec![*value], outcome.beyond.clone())).collect();
        validity::SweepLimits { names: vec![(self.axis.name, self.axis.unit)], impacts }
    }

    /// A short table for a terminal.
    pub fn text(&self) -> String {
        let names = [
            self.axis.name,
            "normal restitution",
            "tangential restitution",
            "rebound angle",
            "rebound spin",
            "sliding part",
        ];
        let mut text = self.columns().text(&names, ROWS);
        let count = self.laws.iter().map(|(_, points)| points.len()).max().unwrap_or(0);
        if count > ROWS {
            text += &format!("\n{ROWS} of {count} values; -o FILE.csv writes all of them with all digits\n");
        }
        text
    }
}
