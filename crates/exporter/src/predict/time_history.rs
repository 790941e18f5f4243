//! `brinell predict --time-history`: force, indentation and speed over the time of an impact.

use super::PredictError;
use crate::columns::{Column, Columns};
use crate::laws::Choice;
use crate::model::AnyModel;
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::motion::{ExternalLoad, follow};
use brinell_contact::{History, Model, losses};

/// Number of moments during the loading; there are as many during the unloading.
const MOMENTS: u32 = 200;

/// A moment of an impact.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Time since first contact \[s\].
    pub time: f64,
    /// \[m\]
    pub indentation: f64,
    /// \[N\]
    pub force: f64,
    /// Closing speed \[m/s\].
    pub speed: f64,
}

/// The time history of `impact` from first contact to the end of the force; `None` beyond the range of the law.
pub fn moments(model: &AnyModel, impact: &Impact) -> Option<Vec<Moment>> {
    let prediction = model.predict(impact)?;
    match model {
        AnyModel::Elastoplastic(model) => followed(model, impact, &prediction),
        AnyModel::Lossy(model, _) => {
            let mut all = Vec::new();
            losses::impact::follow(model, impact, |state, force| {
                let losses::impact::State { time, indentation, speed, .. } = *state;
                // the event that ends it is found to rounding, on either side
                all.push(Moment { time, indentation, force: force.max(0.0), speed });
            })?;
            // after its end a surface may lag behind the bodies
            all.retain(|moment| moment.time <= prediction.contact_time());
            Some(thinned(&all))
        }
    }
}

/// Some of the moments: an integration takes about a thousand steps.
fn thinned(all: &[Moment]) -> Vec<Moment> {
    let (last, count) = (all.len() - 1, 2 * MOMENTS as usize);
    (0..=count).map(|moment| all[last * moment / count]).collect()
}

/// The motion with the law, in equal steps of the loading and of the unloading. Each step is exact, whatever its length.
fn followed<L: brinell_contact::Loading, U: brinell_contact::Unloading>(
    model: &Model<L, U>,
    impact: &Impact,
    prediction: &Prediction,
) -> Option<Vec<Moment>> {
    let load = ExternalLoad { mass: impact.mass, acceleration: 0.0 };
    let mut history = History::start(model, 0.0).ok()?;
    let mut speed = impact.speed;
    let mut all = vec![Moment { time: 0.0, indentation: 0.0, force: 0.0, speed }];
    let (loading, unloading) = (prediction.loading_time, prediction.unloading_time);
    for moment in 1..=2 * MOMENTS {
        let step = if moment <= MOMENTS { loading } else { unloading } / f64::from(MOMENTS);
        speed = follow(&mut history, model, &load, speed, step).ok()?.speed;
        let time = match moment {
            moment if moment <= MOMENTS => loading * f64::from(moment) / f64::from(MOMENTS),
            moment => loading + unloading * f64::from(moment - MOMENTS) / f64::from(MOMENTS),
        };
        all.push(Moment { time, indentation: history.indentation(), force: history.force(), speed });
    }
    Some(all)
}

/// `impact` over time with the laws of `choices`, as columns.
///
/// # Errors
/// [`PredictError::Beyond`]
pub fn columns(choices: &[Choice], impact: &Impact) -> Result<Columns, PredictError> {
    let names = [("time", "s"), ("indentation", "m"), ("force", "N"), ("speed", "m/s")];
    let row = |moment: &Moment| vec![moment.time, moment.indentation, moment.force, moment.speed];
    let law = |choice: &Choice| {
        let beyond = || PredictError::Beyond { law: choice.laws.clone(), mass: impact.mass, speed: impact.speed };
        let moments = moments(&choice.model, impact).ok_or_else(beyond)?;
        Ok((choice.laws.clone(), moments.iter().map(row).collect()))
    };
    Ok(Columns {
        columns: names.into_iter().map(|(name, unit)| Column::new(name, unit)).collect(),
        laws: choices.iter().map(law).collect::<Result<_, PredictError>>()?,
    })
}
