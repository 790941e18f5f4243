//! How far an impact spreads because a strength is uncertain: that of a hardness, a tensile strength or a tensile test.

use super::Quantity;
use crate::laws::{self, Choice};
use crate::numbers::{cell, quantity, with_band};
use crate::scene::{Body, Scene};
use brinell_contact::impact::{Impact, Prediction};
use serde_json::{Value, json};

/// The standard deviations between which 95 % of a normal distribution are.
const NORMAL: f64 = 1.959_963_985;

/// The deviations at which each strength is tried \[bands]: both ends, and between, since some restitutions aren't monotone.
const TRIED: [f64; 6] = [-1.0, -2.0 / 3.0, -1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];

/// The quantities of a prediction that have a band, as `quantities` names them.
const SPREAD: [&str; 5] = ["largest force", "largest indentation", "largest contact radius", "dent", "restitution"];

/// The bands of an impact: 95 % are within.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands {
    bands: [[f64; 2]; SPREAD.len()],
}

/// An uncertain strength of the first contact.
struct Uncertain {
    body: Body,
    /// The reading from which it is: `180 HBW`.
    given: String,
    /// Relative standard deviation \[-\].
    deviation: f64,
}

/// The strengths of the first contact of `scene` that are uncertain: those that a reading says.
fn uncertain(scene: &Scene) -> Vec<Uncertain> {
    let of = |body| {
        let measured = scene.measured(0, body)?;
        let deviation = measured.uncertainty;
        (deviation > 0.0).then(|| Uncertain { body, given: measured.given.clone(), deviation })
    };
    Body::ALL.into_iter().filter_map(of).collect()
}

impl Bands {
    /// The bands of `impact` by the laws of `choice` around its `prediction`. Each strength is independent of the other, and their parts
    /// add up as squares. `None` if no strength is uncertain, or where one within the band is beyond the law.
    pub fn of(scene: &Scene, choice: &Choice, impact: &Impact, prediction: &Prediction) -> Option<Bands> {
        let strengths = uncertain(scene);
        let centre = numbers(prediction);
        // squares of the ways down and up
        let mut squares = [[0.0; 2]; SPREAD.len()];
        for Uncertain { body, deviation, .. } in &strengths {
            let mut ends = centre.map(|number| [number; 2]);
            for part in TRIED {
                let found = with_strength(scene, choice, impact, (*body, 1.0 + part * NORMAL * deviation))?;
                for ([low, high], number) in ends.iter_mut().zip(numbers(&found)) {
                    (*low, *high) = (low.min(number), high.max(number));
                }
            }
            for (([down, up], [low, high]), middle) in squares.iter_mut().zip(ends).zip(centre) {
                (*down, *up) = (*down + (middle - low).powi(2), *up + (high - middle).powi(2));
            }
        }
        let band = |index: usize| {
            let (middle, [down, up]) = (centre[index], squares[index].map(f64::sqrt));
            // two ways that add up may pass an end that no impact passes
            let most = if SPREAD[index] == "restitution" { 1.0_f64.max(middle) } else { f64::INFINITY };
            [(middle - down).max(0.0), (middle + up).min(most)]
        };
        (!strengths.is_empty()).then(|| Bands { bands: std::array::from_fn(band) })
    }

    /// The band of the quantity `name`, if it has one.
    pub fn get(&self, name: &str) -> Option<[f64; 2]> {
        let place = SPREAD.iter().position(|known| *known == name)?;
        self.bands.get(place).copied()
    }

    /// For programs: the ends of each band.
    pub fn json(&self) -> Value {
        let bands = SPREAD.iter().zip(self.bands);
        bands.map(|(name, ends)| (name.replace(' ', "_"), json!(ends))).collect::<serde_json::Map<_, _>>().into()
    }
}

/// The numbers of a prediction that have a band.
fn numbers(prediction: &Prediction) -> [f64; SPREAD.len()] {
    let all: [Quantity; 9] = super::quantities(prediction);
    SPREAD.map(|name| all.iter().find(|(known, ..)| *known == name).map_or(f64::NAN, |(_, number, _)| *number))
}

/// The impact with a strength that is so many times as high.
fn with_strength(scene: &Scene, choice: &Choice, impact: &Impact, (body, factor): (Body, f64)) -> Option<Prediction> {
    let scaled = scene.clone().with_strength_of(body, factor)?.with_strengths_for(Some(impact))?;
    choice.on(&scaled)?.model.predict(impact)
}

/// The bands of `impact` on the first contact of `scene` by its own law, with its prediction.
pub fn of_impact(scene: &Scene, impact: &Impact) -> Option<(Prediction, Bands)> {
    let own = scene.clone().with_strengths_for(Some(impact))?;
    let choice = laws::choose(&own, &[]).ok()?.pop()?;
    let prediction = choice.model.predict(impact)?;
    let bands = Bands::of(&own, &choice, impact, &prediction)?;
    Some((prediction, bands))
}

/// The strengths that are uncertain, with their standard deviations: `the target's (180 HBW) 8 %`.
fn deviations(scene: &Scene) -> Option<String> {
    let of = |Uncertain { body, given, deviation }: Uncertain| {
        format!("the {}'s ({}) {} %", body.name(), given.trim_end_matches(','), cell(100.0 * deviation, 1.0))
    };
    let all: Vec<_> = uncertain(scene).into_iter().map(of).collect();
    (!all.is_empty()).then(|| all.join(", "))
}

/// What the ranges behind the numbers of a prediction are; `None` if no strength is uncertain.
pub fn note(scene: &Scene) -> Option<String> {
    let deviations = deviations(scene)?;
    Some(format!(
        "The ranges are what the uncertainty of the strength makes: 95 % of such impacts are within. Standard deviation of the strength: \
         {deviations}."
    ))
}

/// The bands of `impact` by the scene's own law, in a sentence; `None` if no strength is uncertain.
pub fn sentence(scene: &Scene, impact: &Impact) -> Option<String> {
    let (prediction, bands) = of_impact(scene, impact)?;
    let said = |name: &str, value: f64, unit| with_band(value, bands.get(name), unit);
    Some(format!(
        "The uncertainty of the strength spreads the impact at {}: restitution {}, largest force {}, dent {}, with a probability of 95 %. \
         Standard deviation of the strength: {}.",
        quantity(impact.speed, "m/s"),
        said("restitution", prediction.restitution, ""),
        said("largest force", prediction.max_force, "N"),
        said("dent", prediction.residual_indentation, "m"),
        deviations(scene)?
    ))
}
