//! Curves: force, radius, pressure and energies along a path of loading, unloading and reloading.

use crate::columns::{Column, Columns};
use crate::laws::Choice;
use crate::model::AnyModel;
use crate::plot::{Picture, Series};
use brinell_contact::impact::Impact;
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{self, AnyLoss};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{History, TooDeep};
use std::f64::consts::PI;

/// Number of points on each branch of the path.
const POINTS: u32 = 200;

/// A point of the curve, in SI units.
struct CurveRow {
    indentation: f64,
    force: f64,
    contact_radius: f64,
    mean_pressure: f64,
    stiffness: f64,
    elastic_energy: f64,
    dissipated_energy: f64,
    regime: i32,
}

/// The curve of `choice` up to `largest` [m]: loading to two thirds of it, unloading to the dent, loading to `largest`,
/// unloading.
fn rows(choice: &Choice, largest: f64, impact: &Impact) -> Result<Vec<CurveRow>, TooDeep> {
    let model = match choice.model {
        // the curve of a slow motion: losses begin with the speed
        AnyModel::Elastoplastic(model) => model,
        AnyModel::Lossy(model, None) => model.plastic,
        AnyModel::Lossy(model, Some(_)) => return Ok(damped_rows(&model, impact)),
    };
    let mut history = History::start(&model, 0.0)?;
    let mut rows = Vec::new();
    let first = 2.0 / 3.0 * largest;
    let dent = |depth: f64| model.unloading_path(depth).lower;
    for goal in [first, dent(first), largest, dent(largest)] {
        let from = history.indentation();
        for point in 1..=POINTS {
            let to = from + (goal - from) * f64::from(point) / f64::from(POINTS);
            history.advance(&model, to - history.indentation())?;
            rows.push(CurveRow {
                indentation: history.indentation(),
                force: history.force(),
                contact_radius: history.contact_radius(&model),
                mean_pressure: history.mean_pressure(&model),
                stiffness: history.stiffness(),
                elastic_energy: history.elastic_energy(&model),
                dissipated_energy: history.dissipated_energy(&model),
                regime: history.regime() as i32,
            });
        }
    }
    Ok(rows)
}

/// The motion during `impact` with a rate-dependent law, which has no curve without a motion.
fn damped_rows(model: &losses::Model<AnyLoading, AnyUnloading, AnyLoss>, impact: &Impact) -> Vec<CurveRow> {
    let mut rows = Vec::new();
    losses::impact::follow(model, impact, |state, force| {
        let (contact, speed) = (&state.contact, state.speed);
        let (indentation, plastic) = (state.indentation.max(0.0), contact.plastic());
        let (elastic_energy, contact_radius) =
            (plastic.elastic_energy(&model.plastic), (model.plastic.pair.radius * indentation).sqrt());
        let area = PI * contact_radius * contact_radius;
        rows.push(CurveRow {
            indentation,
            force,
            contact_radius,
            mean_pressure: if area > 0.0 { force / area } else { 0.0 },
            stiffness: if force > 0.0 { contact.stiffness(speed) } else { 0.0 },
            elastic_energy,
            dissipated_energy: impact.energy() - 0.5 * impact.mass * speed * speed - elastic_energy,
            regime: i32::from(force > 0.0),
        });
    });
    // this leaves as many points as the other laws have
    let every = rows.len().div_ceil(4 * POINTS as usize).max(1);
    rows.into_iter().step_by(every).collect()
}

/// The curves as columns.
///
/// # Errors
/// [`TooDeep`] if the laws cannot be evaluated up to `largest` \[m\].
pub fn columns(choices: &[Choice], largest: f64, impact: &Impact) -> Result<Columns, TooDeep> {
    let names = [
        ("indentation", "m"),
        ("force", "N"),
        ("contact radius", "m"),
        ("mean pressure", "Pa"),
        ("stiffness", "N/m"),
        ("work", "J"),
        ("elastic energy", "J"),
        ("dissipated energy", "J"),
        ("regime", ""),
    ];
    let numbers = |row: &CurveRow| {
        let work = row.elastic_energy + row.dissipated_energy;
        let CurveRow {
            indentation,
            force,
            contact_radius,
            mean_pressure,
            stiffness,
            elastic_energy,
            dissipated_energy,
            regime,
        } = *row;
        vec![
            indentation,
            force,
            contact_radius,
            mean_pressure,
            stiffness,
            work,
            elastic_energy,
            dissipated_energy,
            f64::from(regime),
        ]
    };
    let law = |choice: &Choice| Ok((choice.laws.clone(), rows(choice, largest, impact)?.iter().map(numbers).collect()));
    Ok(Columns {
        columns: names.into_iter().map(|(name, unit)| Column::new(name, unit)).collect(),
        laws: choices.iter().map(law).collect::<Result<_, TooDeep>>()?,
    })
}

/// The curves as a picture: the force \[N\] over the indentation in micrometres.
///
/// # Errors
/// As for the columns.
pub fn picture(choices: &[Choice], largest: f64, impact: &Impact) -> Result<Picture, TooDeep> {
    let mut series = Vec::new();
    for choice in choices {
        let points = rows(choice, largest, impact)?.iter().map(|row| (1e6 * row.indentation, row.force)).collect();
        series.push(Series { label: choice.name.clone(), points, dots: false });
    }
    let titles = ("indentation [\u{b5}m]", "force [N]");
    Ok(Picture { x_title: titles.0.into(), y_title: titles.1.into(), logarithmic: (false, false), series })
}
