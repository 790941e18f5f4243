//! What a user should know beside the numbers of a prediction.

use crate::laws::Choice;
use crate::scene::Scene;
use brinell::contact::Surface;
use brinell::contact::impact::Prediction;

/// On a surface that keeps its dents a second impact at the same place is elastic.
const ENDLESS: &str = "The surface keeps its dent (surface = \"dented\", the default). A ball that falls into its own dent again \
                       meets it elastically, and bounces to the same height for ever. With surface = \"fresh\" under [target] \
                       every impact meets an untouched spot.";

/// Notes on these predictions for the first contact of `scene`.
pub fn of(scene: &Scene, choices: &[Choice], predictions: &[Prediction]) -> Vec<&'static str> {
    let dents = choices
        .iter()
        .zip(predictions)
        .any(|(choice, prediction)| choice.model.elastoplastic().is_some() && prediction.residual_indentation > 0.0);
    let keeps = scene.contacts[0].surface == Surface::Dented;
    if dents && keeps { vec![ENDLESS] } else { Vec::new() }
}
