//! `brinell predict --sweep` and `--impacts`: impacts over ranges of quantities, or one by one, as a table.

use super::axis::{Axis, Case, Value, varied};
use super::oblique::{self, Setting};
use super::{PredictError, Quantity, beyond, constants, one, quantities};
use crate::columns::{Column, Columns};
use crate::laws::Choice;
use crate::layout;
use crate::scene::Scene;
use crate::validity::{self, Beyond, SweepLimits};
use brinell_contact::impact::Impact;
use serde_json::Value as Json;

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

/// Which impacts have the values of several quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Impacts {
    /// Each combination; the last quantity varies fastest. The first impact without a prediction ends the sweep.
    Combined,
    /// Each row of the columns. An impact without a prediction has its error.
    Listed,
}

impl Impacts {
    /// The option of the program that asks for them.
    pub fn option(self) -> &'static str {
        match self {
            Impacts::Combined => "--sweep",
            Impacts::Listed => "--impacts",
        }
    }
}

/// Impacts with what is said of them.
pub struct Sweep {
    pub columns: Columns,
    /// The limits of validity that each impact exceeds.
    pub limits: SweepLimits,
    /// Error and warnings of each listed impact, in the order of `limits`.
    pub said: Vec<[String; 2]>,
}

/// What an impact says, and the limits of validity that it exceeds.
pub type Said = Result<(Vec<Quantity>, Vec<Beyond>), PredictError>;

/// Predicts for all values of a list, in any order, on as many processors as the caller has, until one has an error.
pub type Each<'a> = &'a dyn Fn(
    &[Vec<f64>],
    &(dyn Fn(&Vec<f64>) -> Result<Said, PredictError> + Sync),
) -> Result<Vec<Said>, PredictError>;

impl Sweep {
    /// What the laws of `choices` say of `impact` on `scene` for values of `axes`; of an oblique one with a `setting`. Of several
    /// laws, those that depend on what varies. Each impact is what is predicted of a scene with its numbers: the strengths are at its own
    /// strain and rate.
    ///
    /// # Errors
    /// Axes that determine each other, too many impacts, or [`PredictError`] for the first combination that is impossible or beyond
    /// the range of a law.
    pub fn of_impacts(
        (scene, choices): (&Scene, &[Choice]),
        (impact, setting): (Impact, Option<Setting>),
        (axes, impacts): (&[Axis], Impacts),
        each: Each,
    ) -> Result<Sweep, PredictError> {
        let choices = depending_on(choices, axes);
        let hard = || PredictError::Beyond { law: choices[0].laws.clone(), mass: impact.mass, speed: impact.speed };
        let mut slow = scene.clone().under_slow_load().ok_or_else(hard)?;
        if setting.is_none() {
            // each impact has a scene of its own, and other contacts don't change one along the normal
            slow.contacts.truncate(1);
        }
        let normal = |choice: &Choice, values: &[Value]| {
            let Case { scene, choice, impact } = varied(&slow, choice, impact, values, 1.0)?;
            let prediction = one(&choice, &impact)?;
            let regime = ("regime", f64::from(prediction.regime as i32), "");
            let quantities = quantities(&prediction).into_iter().chain([regime]).collect();
            Ok((quantities, beyond(&scene, &choice.model.pair(), impact.speed, &prediction)))
        };
        let oblique = |setting| {
            let slow = &slow;
            move |choice: &Choice, values: &[Value]| {
                let outcome = oblique::one(slow, choice, (impact, setting), values)?;
                Ok((outcome.quantities(), outcome.beyond))
            }
        };
        match setting {
            None => Sweep::of((axes, impacts), &choices, (VALUES, each), normal),
            Some(setting) => Sweep::of((axes, impacts), &choices, (oblique::VALUES, each), oblique(setting)),
        }
    }

    /// What `predict` says of the laws of `choices` for the values of `axes`. A quantity that varies alone has `usual` values, if the
    /// user gives no number.
    fn of(
        (axes, impacts): (&[Axis], Impacts),
        choices: &[Choice],
        (usual, each): (usize, Each),
        predict: impl Fn(&Choice, &[Value]) -> Said + Sync,
    ) -> Result<Sweep, PredictError> {
        check(axes)?;
        let usual = [usual, VALUES_OF_TWO].get(axes.len() - 1).copied().unwrap_or(VALUES_OF_MORE);
        let values: Vec<Vec<f64>> = axes.iter().map(|axis| axis.values(usual)).collect();
        let points: Vec<Vec<f64>> = match impacts {
            Impacts::Listed => {
                (0..values[0].len()).map(|row| values.iter().map(|values| values[row]).collect()).collect()
            }
            Impacts::Combined => (0..combinations(&values)?).map(|index| values_at(&values, index)).collect(),
        };
        let mut columns: Vec<_> = axes.iter().map(|axis| Column::new(axis.name, axis.unit)).collect();
        let names = axes.iter().map(|axis| (axis.name, axis.unit)).collect();
        let mut limits = SweepLimits { names, impacts: Vec::new() };
        let (mut laws, mut valid, mut all_said) = (Vec::new(), Vec::new(), Vec::new());
        for choice in choices {
            let answers = each(&points, &|at| {
                let varied: Vec<_> = axes.iter().map(|axis| axis.name).zip(at.iter().copied()).collect();
                let said = predict(choice, &varied);
                if impacts == Impacts::Combined { said.map(Ok) } else { Ok(said) }
            })?;
            let mut rows = Vec::new();
            for (at, said) in points.iter().zip(answers) {
                valid.push(said.as_ref().map_or(f64::NAN, |(_, beyond)| f64::from(u8::from(beyond.is_empty()))));
                let error = said.as_ref().err().map(ToString::to_string).unwrap_or_default();
                let (mut quantities, beyond) = said.unwrap_or_default();
                quantities.retain(|(name, ..)| axes.iter().all(|axis| axis.name != *name));
                if columns.len() == axes.len() {
                    columns.extend(quantities.iter().map(|(name, _, unit)| Column::new(*name, unit)));
                }
                rows.push(
                    at.iter().copied().chain(quantities.iter().map(|(_, number, _)| *number)).collect::<Vec<_>>(),
                );
                if impacts == Impacts::Listed {
                    let warnings: Vec<_> = beyond.iter().copied().map(validity::words).collect();
                    all_said.push([error, warnings.join("; ")]);
                }
                limits.impacts.push((at.clone(), beyond));
            }
            laws.push((choice.laws.clone(), rows));
        }
        // an impact without a prediction has no other numbers
        laws.iter_mut().flat_map(|(_, rows)| rows).for_each(|row| row.resize(columns.len(), f64::NAN));
        Ok(Sweep { columns: Columns { columns, laws }.with_valid(valid.into_iter()), limits, said: all_said })
    }

    /// For programs: the columns, with the lists `error` and `warning` of listed impacts.
    pub fn json(&self) -> Json {
        let mut object = self.columns.json();
        let mut said = self.said.iter();
        for (index, (_, rows)) in self.columns.laws.iter().enumerate().filter(|_| !self.said.is_empty()) {
            let own: Vec<_> = said.by_ref().take(rows.len()).collect();
            for (place, name) in ["error", "warning"].into_iter().enumerate() {
                object["laws"][index][name] = own.iter().map(|said| said[place].as_str()).collect();
            }
        }
        object
    }

    /// CSV with all digits, with the columns `error` and `warning` of listed impacts.
    pub fn csv(&self) -> String {
        let quoted = |text: &String| format!("\"{}\"", text.replace('"', "\"\""));
        let ends = self.said.iter().map(|said| said.each_ref().map(quoted).join(","));
        let mut ends = std::iter::once("error,warning".to_string()).chain(ends);
        match self.said.is_empty() {
            true => self.columns.csv(),
            false => {
                self.columns.csv().lines().map(|line| format!("{line},{}\n", ends.next().unwrap_or_default())).collect()
            }
        }
    }

    /// What people are to know beside the numbers.
    pub fn warnings(&self) -> Vec<String> {
        let failed: Vec<_> = self.said.iter().filter(|[error, _]| !error.is_empty()).collect();
        let first = |[error, _]: &&[String; 2]| {
            format!("{} of {} impacts have no prediction; the first: {error}", failed.len(), self.said.len())
        };
        failed.first().map(first).into_iter().chain(self.limits.warnings()).collect()
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

/// The number of combinations of `values`.
fn combinations(values: &[Vec<f64>]) -> Result<usize, PredictError> {
    let count = values.iter().try_fold(1, |count: usize, values| count.checked_mul(values.len()));
    count.filter(|count| *count <= MOST).ok_or_else(|| {
        let counts: Vec<_> = values.iter().map(|values| values.len().to_string()).collect();
        PredictError::Varied(format!("{} values: at most {MOST} impacts are allowed", counts.join(" x ")))
    })
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
                return Err(PredictError::Varied(format!("{} is given twice", one.name)));
            }
            if SAME.iter().any(|same| same.contains(&one.name) && same.contains(&other.name)) {
                let why = format!("{} and {} determine each other: give one of them", other.name, one.name);
                return Err(PredictError::Varied(why));
            }
        }
    }
    Ok(())
}
