//! `brinell predict --sweep`: impacts over ranges of one or several quantities, as a table.

use crate::parallel;
use brinell_exporter::columns::{Column, Columns};
use brinell_exporter::laws::Choice;
use brinell_exporter::layout;
use brinell_exporter::predict::axis::Axis;
use brinell_exporter::predict::{PredictError, Quantity};
use brinell_exporter::validity::{Beyond, SweepLimits};

/// Number of values of a quantity without a number of its own: alone (with normal impacts), with another one, with several.
pub const VALUES: usize = 201;
const VALUES_OF_TWO: usize = 41;
const VALUES_OF_MORE: usize = 11;

/// Largest number of impacts for each law.
const MOST: usize = 100_000;

/// Number of rows of the table in a terminal.
const ROWS: usize = 9;

/// Largest width of a number there.
const NUMBER: usize = 9;

/// Quantities that determine each other.
const SAME: [&[&str]; 2] = [&["speed", "energy", "drop_height"], &["mass", "effective_mass"]];

/// Impacts for each combination of values; the last quantity varies fastest.
pub struct Sweep {
    pub columns: Columns,
    /// The limits of validity that each impact exceeds.
    pub limits: SweepLimits,
}

impl Sweep {
    /// What `predict` says of the laws of `choices` for all values of `axes`: the quantities of each impact, and the limits of
    /// validity that it exceeds. A quantity that varies alone has `usual` values, if the user gives no number.
    ///
    /// # Errors
    /// Axes that determine each other, too many impacts, or [`PredictError`] for the first values that are impossible or beyond
    /// the range of a law.
    pub fn of(
        axes: &[Axis],
        choices: &[Choice],
        usual: usize,
        predict: impl Fn(&Choice, &[(&Axis, f64)]) -> Result<(Vec<Quantity>, Vec<Beyond>), PredictError> + Sync,
    ) -> Result<Sweep, PredictError> {
        check(axes)?;
        let usual = [usual, VALUES_OF_TWO].get(axes.len() - 1).copied().unwrap_or(VALUES_OF_MORE);
        let values: Vec<Vec<f64>> = axes.iter().map(|axis| axis.values(usual)).collect();
        let count = values.iter().try_fold(1, |count: usize, values| count.checked_mul(values.len()));
        let count = count.filter(|count| *count <= MOST).ok_or_else(|| {
            let counts: Vec<_> = values.iter().map(|values| values.len().to_string()).collect();
            PredictError::Sweep(format!("{} values: at most {MOST} impacts are allowed", counts.join(" x ")))
        })?;
        let points: Vec<Vec<f64>> = (0..count).map(|index| values_at(&values, index)).collect();
        let mut columns: Vec<_> = axes.iter().map(|axis| Column::new(axis.name, axis.unit)).collect();
        let names = axes.iter().map(|axis| (axis.name, axis.unit)).collect();
        let mut limits = SweepLimits { names, impacts: Vec::new() };
        let mut laws = Vec::new();
        for choice in choices {
            let impacts = parallel::each(&points, |at| {
                let varied: Vec<_> = axes.iter().zip(at.iter().copied()).collect();
                predict(choice, &varied)
            })?;
            let mut rows = Vec::new();
            for (at, (mut quantities, beyond)) in points.iter().zip(impacts) {
                quantities.retain(|(name, ..)| axes.iter().all(|axis| axis.name != *name));
                if columns.len() == axes.len() {
                    columns.extend(quantities.iter().map(|(name, _, unit)| Column::new(*name, unit)));
                }
                rows.push(at.iter().copied().chain(quantities.iter().map(|(_, number, _)| *number)).collect());
                limits.impacts.push((at.clone(), beyond));
            }
            laws.push((choice.laws.clone(), rows));
        }
        Ok(Sweep { columns: Columns { columns, laws }.with_valid(limits.valid()), limits })
    }

    /// A short table of each law for a terminal, with the varied quantities and as many of these others as fit.
    pub fn text(&self, others: &[&str]) -> String {
        let mut names: Vec<_> = self.limits.names.iter().map(|(name, _)| *name).collect();
        // each column is indented, and a number may be wider than its heading
        let width = |names: &[&str]| names.iter().map(|name| 2 + name.len().max(NUMBER)).sum::<usize>();
        for other in others {
            let fits = width(&names) + width(&[other]) <= layout::WIDTH;
            names.extend(fits.then_some(*other));
        }
        let text = self.columns.text(&names, ROWS);
        match self.columns.laws.iter().map(|(_, rows)| rows.len()).max() {
            Some(count) if count > ROWS => {
                format!("{text}\n{ROWS} of {count} values; -o FILE.csv writes all of them with all digits\n")
            }
            _ => text,
        }
    }
}

/// The combination of `values` with this index.
fn values_at(values: &[Vec<f64>], index: usize) -> Vec<f64> {
    let mut rest = index;
    let mut at = |values: &Vec<f64>| {
        let value = values[rest % values.len()];
        rest /= values.len();
        value
    };
    let mut reversed: Vec<_> = values.iter().rev().map(&mut at).collect();
    reversed.reverse();
    reversed
}

/// Rejects quantities that determine each other.
fn check(axes: &[Axis]) -> Result<(), PredictError> {
    for (index, one) in axes.iter().enumerate() {
        for other in &axes[..index] {
            if one.name == other.name {
                return Err(PredictError::Sweep(format!("{} is given twice", one.name)));
            }
            if SAME.iter().any(|same| same.contains(&one.name) && same.contains(&other.name)) {
                let why = format!("{} and {} determine each other: give one of them", other.name, one.name);
                return Err(PredictError::Sweep(why));
            }
        }
    }
    Ok(())
}
