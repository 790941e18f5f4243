//! Notes that accompany the numbers of a prediction.

use crate::laws::Choice;
use crate::numbers::{cell, quantity};
use crate::scene::Scene;
use brinell::contact::Surface;
use brinell::contact::impact::{Impact, Prediction};

/// On a surface that keeps its dents, a second impact at the same place is elastic.
const ENDLESS: &str = "The surface keeps its dent (surface = \"dented\", the default). A ball that falls into its own dent again \
                       meets it elastically, and bounces to the same height for ever. With surface = \"fresh\" under [target] \
                       every impact meets an untouched spot.";

/// Notes on these predictions of `impact` on the first contact of `scene`.
pub fn of(scene: &Scene, impact: &Impact, choices: &[Choice], predictions: &[Prediction]) -> Vec<String> {
    let dents = choices
        .iter()
        .zip(predictions)
        .any(|(choice, prediction)| choice.model.elastoplastic().is_some() && prediction.residual_indentation > 0.0);
    let keeps = scene.contacts[0].surface == Surface::Dented;
    let endless = (dents && keeps).then(|| ENDLESS.to_string());
    endless.into_iter().chain(strength(scene, impact)).collect()
}

/// The strength of the target in an impact, if it depends on the impact, and its reliability.
fn strength(scene: &Scene, impact: &Impact) -> Vec<String> {
    let depends = scene.depends_on_impact();
    let Some(found) = depends.then(|| scene.in_impact(0, impact)).flatten() else { return Vec::new() };
    let mut notes = Vec::new();
    if let (Some(law), Some(line)) = (scene.power_law, found.line) {
        let restitution = |part: f64| {
            let prediction = scene.predict_with_strain(impact, part * line.strain, found.factor);
            prediction.map_or("unknown".into(), |prediction| cell(prediction.restitution, 1.0))
        };
        notes.push(format!(
            "The power law {} eps^{} is taken as linear hardening up to a plastic strain of {}, Tabor's 0.2 a/R of this impact: S = {}, \
             H = {}. At that strain the flow stress is {} % off; with half or twice the strain the restitution would be {} or {} by \
             the scene's law.",
            quantity(law.coefficient, "Pa"),
            law.exponent,
            cell(line.strain, 1.0),
            quantity(line.yield_strength, "Pa"),
            quantity(line.hardening_modulus, "Pa"),
            cell(100.0 * line.error, 1.0),
            restitution(0.5),
            restitution(2.0),
        ));
    }
    if scene.rate.is_some() {
        notes.push(format!(
            "At the mean strain rate of this impact, {} 1/s, the target is {} times as strong as at rest: S = {}.",
            cell(found.strain_rate, 1.0),
            cell(found.factor, 1.0),
            quantity(found.yield_strength, "Pa"),
        ));
    }
    notes
}
