//! How far an impact spreads because a strength is uncertain: that of a hardness, a tensile strength or a tensile test.

use super::Quantity;
use crate::laws::{self, Choice};
use crate::numbers::{cell, quantity, with_band};
use crate::scene::{Body, Scene};
use brinell_contact::Regime;
use brinell_contact::impact::{Impact, Prediction};
use serde_json::{Value, json};

/// The standard deviations between which 95 % of a normal distribution are.
const NORMAL: f64 = 1.959_963_985;

/// A relative difference that is rounding.
const ROUNDING: f64 = 1e-12;

/// The deviations at which each strength is tried \[bands]: both ends, and between, since some restitutions aren't monotone.
const TRIED: [f64; 6] = [-1.0, -2.0 / 3.0, -1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];

/// The quantities of a prediction that have a band: as `quantities` names them, and the contact time.
const SPREAD: [&str; 7] = [
    "largest force",
    "largest indentation",
    "largest contact radius",
    "dent",
    "restitution",
    "energy lost",
    CONTACT_TIME,
];
const CONTACT_TIME: &str = "contact time";

/// The bands of an impact: 95 % are within.
#[derive(Clone, Debug, PartialEq)]
pub struct Bands {
    bands: [[f64; 2]; SPREAD.len()],
    /// The regimes that are reached at least and at most.
    regimes: [Regime; 2],
}

/// An uncertain strength of the first contact.
struct Uncertain {
    body: Body,
    /// What it is from: `180 HBW`.
    given: String,
    /// Relative standard deviation \[-\].
    deviation: f64,
}

/// The strengths of the first contact of `scene` that are uncertain: those that a reading says, and that of the softer body if its
/// deviation is `given` by who asks.
fn uncertain(scene: &Scene, given: Option<f64>) -> Vec<Uncertain> {
    let of = |body: Body| {
        let measured = scene.measured(0, body);
        let known = measured.map(|measured| (measured.given.clone(), measured.uncertainty));
        let own = given.filter(|_| body == scene.softer(0) && scene.yield_strength.is_some());
        let (given, deviation) = match own {
            Some(deviation) => (known.map_or("a number".into(), |(given, _)| given), deviation),
            None => known?,
        };
        (deviation > 0.0).then_some(Uncertain { body, given, deviation })
    };
    Body::ALL.into_iter().filter_map(of).collect()
}

/// The laws of `choice` with each strength that is uncertain throughout its band: for each strength, on both sides of the scene's own.
/// `None` where one of them is beyond the law.
pub fn families(scene: &Scene, choice: &Choice, impact: &Impact, given: Option<f64>) -> Option<Vec<Vec<Choice>>> {
    let of = |Uncertain { body, deviation, .. }: Uncertain| {
        let at = |part: f64| with_strength(scene, choice, impact, (body, 1.0 + part * NORMAL * deviation));
        TRIED.into_iter().map(at).collect()
    };
    uncertain(scene, given).into_iter().map(of).collect()
}

impl Bands {
    /// The bands of `impact` by the laws of `choice` around its `prediction`; the strength of the softer body may have a deviation that is
    /// `given`. Each strength is independent of the other, and their parts add up as squares. `None` if no strength is uncertain, or where
    /// one within the band is beyond the law.
    pub fn of(
        scene: &Scene,
        choice: &Choice,
        impact: &Impact,
        prediction: &Prediction,
        given: Option<f64>,
    ) -> Option<Bands> {
        let families = families(scene, choice, impact, given)?;
        let centre = numbers(prediction);
        // squares of the ways down and up
        let mut squares = [[0.0; 2]; SPREAD.len()];
        let mut regimes = [prediction.regime; 2];
        for family in &families {
            let mut ends = centre.map(|number| [number; 2]);
            for one in family {
                let found = one.model.predict(impact)?;
                for ([low, high], number) in ends.iter_mut().zip(numbers(&found)) {
                    (*low, *high) = (low.min(number), high.max(number));
                }
                let [least, most] = &mut regimes;
                if (found.regime as i32) < *least as i32 {
                    *least = found.regime;
                } else if found.regime as i32 > *most as i32 {
                    *most = found.regime;
                }
            }
            for (([down, up], [low, high]), middle) in squares.iter_mut().zip(ends).zip(centre) {
                (*down, *up) = (*down + (middle - low).powi(2), *up + (high - middle).powi(2));
            }
        }
        let band = |index: usize| {
            let (middle, [down, up]) = (centre[index], squares[index].map(f64::sqrt));
            // two ways that add up may pass an end that no impact passes
            let most = match SPREAD[index] {
                "restitution" => 1.0_f64.max(middle),
                "energy lost" => prediction.energy.max(middle),
                _ => f64::INFINITY,
            };
            [(middle - down).max(0.0), (middle + up).min(most)]
        };
        (!families.is_empty()).then(|| Bands { bands: std::array::from_fn(band), regimes })
    }

    /// Whether any is wider than rounding: an uncertain strength may not matter, as that of a body that stays elastic.
    pub fn are_wide(&self) -> bool {
        self.bands.iter().any(|[low, high]| high - low > ROUNDING * high)
    }

    /// The band of the quantity `name`, if it has one.
    pub fn get(&self, name: &str) -> Option<[f64; 2]> {
        let place = SPREAD.iter().position(|known| *known == name)?;
        self.bands.get(place).copied()
    }

    /// For programs: the ends of each band.
    pub fn json(&self) -> Value {
        let bands = SPREAD.iter().zip(self.bands);
        let mut said: serde_json::Map<_, _> = bands.map(|(name, ends)| (name.replace(' ', "_"), json!(ends))).collect();
        said.insert("regime".into(), json!(self.regimes.map(|regime| regime as i32)));
        said.into()
    }
}

/// The numbers of a prediction that have a band.
fn numbers(prediction: &Prediction) -> [f64; SPREAD.len()] {
    let all: [Quantity; 9] = super::quantities(prediction);
    let of = |name| all.iter().find(|(known, ..)| *known == name).map_or(f64::NAN, |(_, number, _)| *number);
    SPREAD.map(|name| if name == CONTACT_TIME { prediction.contact_time() } else { of(name) })
}

/// The laws with a strength that is so many times as high, as it is in the `impact`.
fn with_strength(scene: &Scene, choice: &Choice, impact: &Impact, (body, factor): (Body, f64)) -> Option<Choice> {
    let scaled = scene.clone().with_strength_of(body, factor)?.with_strengths_for(Some(impact))?;
    choice.on(&scaled)
}

/// The bands of `impact` on the first contact of `scene` by its own law, with its prediction.
pub fn of_impact(scene: &Scene, impact: &Impact, given: Option<f64>) -> Option<(Prediction, Bands)> {
    let own = scene.clone().with_strengths_for(Some(impact))?;
    let choice = laws::choose(&own, &[]).ok()?.pop()?;
    let prediction = choice.model.predict(impact)?;
    let bands = Bands::of(&own, &choice, impact, &prediction, given)?;
    Some((prediction, bands))
}

/// The strengths that are uncertain, with their standard deviations: `the target's (180 HBW) 8 %`.
fn deviations(scene: &Scene, given: Option<f64>) -> Option<String> {
    let of = |Uncertain { body, given, deviation }: Uncertain| {
        format!("the {}'s ({}) {} %", body.name(), given.trim_end_matches(','), cell(100.0 * deviation, 1.0))
    };
    let all: Vec<_> = uncertain(scene, given).into_iter().map(of).collect();
    (!all.is_empty()).then(|| all.join(", "))
}

/// What the ranges behind the numbers of a prediction are; `None` if no strength is uncertain.
pub fn note(scene: &Scene, given: Option<f64>) -> Option<String> {
    let deviations = deviations(scene, given)?;
    Some(format!(
        "The ranges are what the uncertainty of the strength makes: 95 % of such impacts are within. Standard deviation of the strength: \
         {deviations}."
    ))
}

/// The bands of `impact` by the scene's own law, in a sentence; `None` if no strength is uncertain.
pub fn sentence(scene: &Scene, impact: &Impact) -> Option<String> {
    let (prediction, bands) = of_impact(scene, impact, None).filter(|(_, bands)| bands.are_wide())?;
    let said = |name: &str, value: f64, unit| with_band(value, bands.get(name), unit);
    Some(format!(
        "The uncertainty of the strength spreads the impact at {}: restitution {}, largest force {}, dent {}, with a probability of 95 %. \
         Standard deviation of the strength: {}.",
        quantity(impact.speed, "m/s"),
        said("restitution", prediction.restitution, ""),
        said("largest force", prediction.max_force, "N"),
        said("dent", prediction.residual_indentation, "m"),
        deviations(scene, None)?
    ))
}
