//! `brinell predict --sweep`: predictions over a range of speeds, as a table and as a picture.

use super::{PredictError, check_energy, one, quantities};
use crate::laws::Choice;
use crate::plot::{Picture, Series, side_by_side};
use brinell::contact::impact::{Impact, Prediction};
use std::fmt::Write;

/// Steps from the first speed to the last one.
pub const STEPS: u32 = 200;

/// Decades of dents that the picture shows: just beyond yield a dent is as small as one likes.
const DENT_DECADES: i32 = 6;

/// Predictions over a range of speeds.
pub struct Sweep {
    /// Effective mass [kg].
    pub mass: f64,
    /// First and last speed [m/s].
    pub range: (f64, f64),
    /// Each law with its impacts, from the first speed to the last.
    pub laws: Vec<(String, Vec<Point>)>,
}

/// A speed [m/s] and its impact.
pub type Point = (f64, Prediction);

/// A range of speeds, as `--sweep speed FROM:TO` says it.
pub fn parse(words: &[String]) -> Result<(f64, f64), PredictError> {
    let wrong = || PredictError::Sweep(words.join(" "));
    let [quantity, range] = words else { return Err(wrong()) };
    let (from, to) = range.split_once(':').ok_or_else(wrong)?;
    let (from, to): (f64, f64) = (from.parse().map_err(|_| wrong())?, to.parse().map_err(|_| wrong())?);
    if quantity == "speed" && from > 0.0 && to > from && to.is_finite() { Ok((from, to)) } else { Err(wrong()) }
}

/// Speeds evenly spread over their decades; both ends are among them as they are.
fn speeds((from, to): (f64, f64)) -> impl Iterator<Item = f64> {
    let within = (1..STEPS).map(move |index| from * libm::pow(to / from, f64::from(index) / f64::from(STEPS)));
    std::iter::once(from).chain(within).chain([to])
}

/// The impacts of one law.
fn points(choice: &Choice, mass: f64, range: (f64, f64)) -> impl Iterator<Item = Result<Point, PredictError>> {
    speeds(range).map(move |speed| Ok((speed, one(choice, &Impact { mass, speed })?)))
}

impl Sweep {
    /// The impacts of `mass` [kg] at the speeds of `range` [m/s].
    ///
    /// # Errors
    /// [`PredictError::Beyond`] for a speed that a law can't be evaluated for, [`PredictError::Energy`] for one that no law can.
    pub fn of(choices: &[Choice], mass: f64, range: (f64, f64)) -> Result<Sweep, PredictError> {
        for speed in [range.0, range.1] {
            check_energy(&Impact { mass, speed })?;
        }
        let law = |choice: &Choice| Ok((choice.name.clone(), points(choice, mass, range).collect::<Result<_, _>>()?));
        Ok(Sweep { mass, range, laws: choices.iter().map(law).collect::<Result<_, PredictError>>()? })
    }

    /// The same without the impacts that a law can't be evaluated for.
    pub fn where_possible(choices: &[Choice], mass: f64, range: (f64, f64)) -> Sweep {
        let law = |choice: &Choice| (choice.name.clone(), points(choice, mass, range).flatten().collect());
        Sweep { mass, range, laws: choices.iter().map(law).collect() }
    }

    /// The sweep as a table, one line for each law and speed.
    pub fn csv(&self) -> String {
        let mut text = String::from(
            "law,speed_m_per_s,largest_force_N,largest_indentation_m,largest_contact_radius_m,dent_m,restitution,\
             kinetic_energy_J,energy_lost_J,loading_time_s,unloading_time_s,regime\n",
        );
        for (law, points) in &self.laws {
            for (speed, prediction) in points {
                write!(text, "{law},{speed:e}").expect("a String takes everything");
                for (_, value, _) in quantities(prediction) {
                    write!(text, ",{value:e}").expect("a String takes everything");
                }
                writeln!(text, ",{}", prediction.regime as i32).expect("a String takes everything");
            }
        }
        text
    }

    /// Restitution, largest force and dent against speed.
    pub fn panels(&self) -> [Picture; 3] {
        let panel = |title: &str, logarithmic, value: &dyn Fn(&Prediction) -> f64| Picture {
            x_title: "speed [m/s]".into(),
            y_title: title.into(),
            logarithmic: (true, logarithmic),
            series: self.series(value),
        };
        let predictions = || self.laws.iter().flat_map(|(_, points)| points).map(|(_, prediction)| prediction);
        let deepest = predictions().map(|prediction| prediction.residual_indentation).fold(0.0, f64::max);
        let shallowest = deepest * 10f64.powi(-DENT_DECADES);
        let dent = |prediction: &Prediction| {
            let dent = prediction.residual_indentation;
            // NaN is left out of a picture
            if dent >= shallowest { dent } else { f64::NAN }
        };
        [
            panel("coefficient of restitution", false, &|prediction| prediction.restitution),
            panel("largest force [N]", true, &|prediction| prediction.max_force),
            // without any dent the zeros are what there is to show
            panel("depth of the dent [m]", deepest > 0.0, &dent),
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
