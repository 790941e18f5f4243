//! Quasi-static hardness: the dent of a Brinell test in the target of a scene, and the inverse problem.
//!
//! Reference: ISO 6506-1, *Metallic materials - Brinell hardness test - Part 1: Test method*; E. Meyer, *Zeitschrift des
//! Vereines deutscher Ingenieure* 52 (1908); D. Tabor, *The Hardness of Metals*, Oxford 1951.

use crate::bisection::border;
use crate::laws::Choice;
use crate::measured::MeasuredStrength;
use crate::model::AnyModel;
use crate::numbers::in_message;
use crate::scene::Body;
use brinell_contact::LARGEST_INDENTATION;
use brinell_contact::loading::AnyLoading;
use brinell_contact::material::hardening::Hardening;
use brinell_contact::rate::TABOR;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::validity::LARGEST_RADIUS_RATIO;
use brinell_contact::{Loading, Model, Regime, TwoBodies};
use std::f64::consts::PI;

/// The factor of the Brinell number and of the load ratio for forces in newtons: 1/9.80665, rounded to three digits as in ISO
/// 6506-1.
const PER_KILOGRAM: f64 = 0.102;

/// The dent diameters that ISO 6506-1 allows, in ball diameters.
pub const ADMITTED: (f64, f64) = (0.24, 0.6);

/// Range of the search for a yield strength, in effective moduli.
const STRENGTHS: (f64, f64) = (1e-7, 1.0);

/// Number of steps over this range.
const STEPS: u32 = 120;

/// The result of a test.
#[derive(Clone, Copy, Debug)]
pub struct Dent {
    /// Indentation under the load \[m\].
    pub max_indentation: f64,
    /// Diameter of the contact under load \[m\]. It is taken as the diameter of the dent, because unloading makes the dent
    /// shallower but hardly narrower.
    pub diameter: f64,
    /// Depth of the dent after unloading \[m\].
    pub depth: f64,
    /// Load over the contact area under load \[Pa\].
    pub mean_pressure: f64,
    pub regime: Regime,
    /// Contact radius over effective radius \[-\].
    pub radius_ratio: f64,
    /// Brinell number HBW; `None` without a dent, or if the dent is wider than the ball.
    pub brinell: Option<f64>,
    /// Meyer hardness \[Pa\]; `None` without a dent.
    pub meyer: Option<f64>,
}

impl Dent {
    /// Whether the dent is too wide for the law to be valid.
    pub fn is_beyond_law(&self) -> bool {
        self.radius_ratio > LARGEST_RADIUS_RATIO
    }
}

/// The Brinell number of a dent of this `diameter` \[m\] from a ball of diameter `ball` \[m\] under `load` \[N\]:
/// `HBW = 0.102 * 2 F / (pi D (D - sqrt(D^2 - d^2)))`, with lengths in millimetres. `None` if the dent is wider than the ball.
///
/// Reference: ISO 6506-1, section 4.
pub fn brinell_number(load: f64, ball: f64, diameter: f64) -> Option<f64> {
    let (ball, diameter) = (1e3 * ball, 1e3 * diameter);
    if diameter > ball {
        return None;
    }
    // D - sqrt(D^2 - d^2) without cancellation for a small dent
    let depth = diameter * diameter / (ball + (ball * ball - diameter * diameter).sqrt());
    Some(PER_KILOGRAM * 2.0 * load / (PI * ball * depth))
}

/// The load ratio `0.102 F/D^2` of ISO 6506-1 [N/mm^2], for a ball diameter in m.
pub fn load_ratio(load: f64, ball: f64) -> f64 {
    PER_KILOGRAM * load / (1e6 * ball * ball)
}

/// The test with `load` \[N\] and a ball of diameter `ball` \[m\]; `None` if the law cannot be evaluated.
fn test(model: &Model<AnyLoading, AnyUnloading>, load: f64, ball: f64) -> Option<Dent> {
    let depth = depth_of_force(model, load)?;
    let peak = model.peak(depth);
    let (radius, is_elastic) = (peak.contact_radius, model.is_elastic_at(depth));
    let residual = model.unloading_path(depth).lower;
    let area = PI * radius * radius;
    let is_number = radius > 0.0 && radius.is_finite() && residual.is_finite();
    is_number.then(|| Dent {
        max_indentation: depth,
        diameter: 2.0 * radius,
        depth: residual,
        mean_pressure: load / area,
        regime: model.loading.regime(&model.pair, depth),
        radius_ratio: radius / model.pair.radius,
        brinell: if is_elastic { None } else { brinell_number(load, ball, 2.0 * radius) },
        meyer: (!is_elastic).then_some(load / area),
    })
}

/// The smallest indentation \[m\] at which the force reaches `force` \[N\].
fn depth_of_force(model: &Model<AnyLoading, AnyUnloading>, force: f64) -> Option<f64> {
    let at = |depth: f64| model.loading.segment(&model.pair, depth).force(depth);
    let reaches = |depth: f64| at(depth) >= force;
    // a fitted law may not be finite at the largest indentation
    let high = [LARGEST_INDENTATION, model.pair.radius * 1e3].into_iter().find(|depth| reaches(*depth))?;
    Some(border((0.0, high), reaches))
}

/// The test with the laws of `choice`. A target of these bodies whose strength was `measured` has that of the strain of this test.
///
/// # Errors
/// A sentence with the reason why there is no result.
pub fn run_test(
    choice: &Choice,
    load: f64,
    ball: f64,
    measured: Option<(&MeasuredStrength, TwoBodies)>,
) -> Result<Dent, String> {
    let mut model = elastoplastic(choice)?;
    let none = || format!("the law {} can't be evaluated for load = {} N", choice.laws, in_message(load));
    let mut dent = test(&model, load, ball).ok_or_else(none)?;
    let Some((measured, bodies)) = measured else { return Ok(dent) };
    // the strength hardly depends on the strain: each round wins a digit
    for _ in 0..30 {
        let strain = TABOR * dent.radius_ratio;
        let Hardening { yield_strength, hardening_modulus } = measured.hardening(strain);
        let hardening =
            AnyModel::Elastoplastic(model).with_bodies(TwoBodies { hardening_modulus, ..bodies }, Body::Target);
        let (other, strength) = match hardening {
            Some(hardening) => (hardening, yield_strength),
            None => (AnyModel::Elastoplastic(model), measured.at(strain)),
        };
        let other = other.with_yield_strength(strength).ok_or_else(none)?;
        model = *other.elastoplastic().ok_or_else(none)?;
        dent = test(&model, load, ball).ok_or_else(none)?;
    }
    Ok(dent)
}

fn elastoplastic(choice: &Choice) -> Result<Model<AnyLoading, AnyUnloading>, String> {
    let model = choice.model.elastoplastic().filter(|_| choice.laws != "hertz");
    if model.is_some_and(|model| model.loading.is_line()) {
        return Err("a hardness test has a ball, and the scene a cylinder".into());
    }
    model
        .copied()
        .ok_or_else(|| format!("the law {} leaves no dent: a hardness test needs a law that yields", choice.laws))
}

/// The yield strength \[Pa\] of a target for which the test gives the Brinell number `hardness`, and the dent.
///
/// # Errors
/// A sentence with the reason why there is no result.
pub fn strength_of(choice: &Choice, load: f64, ball: f64, hardness: f64) -> Result<(f64, Dent), String> {
    let model = elastoplastic(choice)?;
    let with = |yield_strength: f64| {
        let softer = AnyModel::Elastoplastic(model).with_yield_strength(yield_strength)?;
        test(softer.elastoplastic()?, load, ball)
    };
    // a target without a dent counts as hardest, one with a dent wider than the ball as softest
    let is_harder = |strength: f64| match with(strength) {
        Some(Dent { brinell: Some(number), .. }) => number >= hardness,
        Some(Dent { meyer: None, .. }) => true,
        _ => false,
    };
    let modulus = model.pair.modulus;
    let none = || {
        let [hardness, load] = [hardness, load].map(in_message);
        format!("by the law {} no yield strength of the target explains HBW {hardness} at load = {load} N", choice.laws)
    };
    // a fitted law may not be finite for targets nearly as strong as stiff: the first increase counts
    let ratio = STRENGTHS.1 / STRENGTHS.0;
    let strength = |step: u32| modulus * STRENGTHS.0 * libm::pow(ratio, f64::from(step) / f64::from(STEPS));
    let harder: Vec<bool> = (0..=STEPS).map(|step| is_harder(strength(step))).collect();
    let up = harder.windows(2).position(|pair| pair == [false, true]).ok_or_else(none)? as u32;
    let hard = border((strength(up), strength(up + 1)), is_harder);
    let dent = with(hard).ok_or_else(none)?;
    // at the end of the dent, the hardness has no value
    match dent.brinell {
        Some(found) if (found / hardness - 1.0).abs() < 1e-6 => Ok((hard, dent)),
        _ => Err(none()),
    }
}
