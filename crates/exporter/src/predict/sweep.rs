//! `brinell predict --sweep`: impacts over ranges of one or several quantities, as a table.

use super::axis::{Axis, varied};
use super::oblique::{self, Setting};
use super::{PredictError, Quantity, beyond, constants, one, quantities};
use crate::columns::{Column, Columns};
use crate::laws::Choice;
use crate::layout;
use crate::scene::Scene;
use crate::validity::{Beyond, SweepLimits};
use brinell_contact::impact::Impact;

/// Number of values of a quantity without a number of its own: alone (with normal impacts), with another one, with several.
const VALUES: usize = 201;
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

/// What an impact says, and the limits of validity that it exceeds.
pub type Said = Result<(Vec<Quantity>, Vec<Beyond>), PredictError>;

/// Predicts for all values of a list, in any order, on as many processors as the caller has.
pub type Each<'a> = &'a dyn Fn(&[Vec<f64>], &(dyn Fn(&Vec<f64>) -> Said + Sync)) -> Result<Vec<Answered>, PredictError>;

/// What one impact says.
pub type Answered = (Vec<Quantity>, Vec<Beyond>);

impl Sweep {
    /// What the laws of `choices` say of `impact` on `scene` for all values of `axes`; of an oblique one with a `setting`. Of several
    /// laws, those that depend on what varies.
    ///
    /// # Errors
    /// Axes that determine each other, too many impacts, or [`PredictError`] for the first values that are impossible or beyond
    /// the range of a law.
    pub fn of_impacts(
        (scene, choices): (&Scene, &[Choice]),
        (impact, setting): (Impact, Option<Setting>),
        axes: &[Axis],
        each: Each,
    ) -> Result<Sweep, PredictError> {
        let normal = |choice: &Choice, values: &[(&Axis, f64)]| {
            let (choice, impact) = varied(scene, choice, impact, values)?;
            let prediction = one(&choice, &impact)?;
            let regime = ("regime", f64::from(prediction.regime as i32), "");
            let quantities = quantities(&prediction).into_iter().chain([regime]).collect();
            let named: Vec<_> = values.iter().map(|(axis, value)| (axis.name, *value)).collect();
            Ok((quantities, beyond(scene, &choice.model.pair(), impact.speed, &prediction, &named)))
        };
        let oblique = |setting| {
            move |choice: &Choice, values: &[(&Axis, f64)]| {
                let outcome = oblique::one(scene, choice, (impact, setting), values)?;
                Ok((outcome.quantities(), outcome.beyond))
            }
        };
        let choices = depending_on(choices, axes);
        match setting {
            None => Sweep::of(axes, &choices, (VALUES, each), normal),
            Some(setting) => Sweep::of(axes, &choices, (oblique::VALUES, each), oblique(setting)),
        }
    }

    /// What `predict` says of the laws of `choices` for all values of `axes`. A quantity that varies alone has `usual` values, if the
    /// user gives no number.
    fn of(
        axes: &[Axis],
        choices: &[Choice],
        (usual, each): (usize, Each),
        predict: impl Fn(&Choice, &[(&Axis, f64)]) -> Said + Sync,
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
            let impacts = each(&points, &|at| {
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

/// Of several laws, those that depend on the strength and on the constants that vary.
fn depending_on(choices: &[Choice], axes: &[Axis]) -> Vec<Choice> {
    let mut choices = choices.to_vec();
    // where none depends on it, that is refused
    let varies = axes.iter().any(|axis| axis.name == "target.yield_strength");
    if varies && choices.iter().any(Choice::yields) {
        choices.retain(Choice::yields);
    }
    let constants = || axes.iter().filter(|axis| constants::is_one(axis.name));
    let has_all = |choice: &Choice| constants().all(|axis| constants::has(choice, axis.name));
    if choices.iter().any(has_all) {
        choices.retain(has_all);
    }
    choices
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
