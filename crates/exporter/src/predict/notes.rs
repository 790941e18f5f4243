//! Notes that accompany the numbers of a prediction.

use crate::accuracy;
use crate::laws::Choice;
use crate::numbers::{cell, quantity};
use crate::rods::Waves;
use crate::scene::{Body, Scene, bodies};
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::{AnyLoading, Hertz};
use brinell_contact::losses::{AnyLoss, Loss, Plate};
use brinell_contact::{Model, Surface};

/// On a surface that keeps its dents, a second impact at the same place is elastic.
const ENDLESS: &str = "The surface keeps its dent (surface = \"dented\", the default). A ball that falls into its own dent again \
                       meets it elastically, and bounces to the same height for ever. With surface = \"fresh\" under [target] \
                       every impact meets an untouched spot, and bounces grow lower as long as they yield. Only a loss below \
                       yield, such as elastic_restitution under [law], brings the ball to rest.";

/// Steel whose strength was measured slowly, in a scene that says nothing of the rate.
const ASSUMED_RATE: &str = " The scene gives no rate; that of AISI 4340 is assumed, c = 0.014 from the 1e-3 1/s of the test. \
                            rate = { model = \"johnson-cook\", c = ... } of the body gives another, c = 0 none.";

/// Notes on these predictions of `impact` on the first contact of `scene`.
pub fn of(scene: &Scene, impact: &Impact, choices: &[Choice], predictions: &[Prediction]) -> Vec<String> {
    let dents = choices
        .iter()
        .zip(predictions)
        .any(|(choice, prediction)| choice.model.elastoplastic().is_some() && prediction.residual_indentation > 0.0);
    let keeps = scene.contacts[0].surface == Surface::Dented;
    let what = if scene.is_line() { "cylinder" } else { "ball" };
    let endless = (dents && keeps && scene.laws.loss().is_none()).then(|| ENDLESS.replace("ball", what));
    let softer = predictions.first().map(|prediction| accuracy::notes(scene, prediction)).unwrap_or_default();
    let rods = Waves::of(scene, impact.speed).and_then(|waves| waves.note(predictions));
    let notes = scene.materials.iter().cloned().chain(endless).chain(loss(scene, impact, predictions));
    let notes = notes.chain(softer).chain(strength(scene, impact));
    notes.chain(rods).chain(bodies::held(scene, impact.mass)).collect()
}

/// Radius of the disc that has moved with the force, over `sqrt(a t)`: `2 sqrt(x)` with the first root x of `Si(x) = pi/2`.
const FRONT: f64 = 2.775_930_59;

/// How far bending waves spread in a `plate` during `time` \[s\]: radius \[m\] of the disc that has then moved with the force.
///
/// A blow I gives the plate the deflection `I/(4 pi sqrt(D rho h)) (pi/2 - Si(r^2/(4 a t)))`, with the bending stiffness D and
/// `a = sqrt(D/(rho h))`. In its middle that is `alpha I`, with the mobility `alpha = 1/(8 sqrt(D rho h))` of the loss. An edge
/// at this radius changes the motion of the middle during the contact by 5 %, one at half of it by 30 %.
///
/// Reference: C. Zener, *Physical Review* 59 (1941) 669-673; K. F. Graff, *Wave Motion in Elastic Solids*, 1975, chapter 4.
fn bending_front(plate: &Plate, time: f64) -> f64 {
    let spread = 1.0 / (8.0 * plate.factor() * plate.target.density * plate.thickness);
    FRONT * libm::sqrt(spread * time)
}

/// What the loss of the scene takes from an impact with these `predictions`.
fn loss(scene: &Scene, impact: &Impact, predictions: &[Prediction]) -> Option<String> {
    let loss = scene.laws.loss()?;
    let elastic = scene.with_loss(0, Model { loading: AnyLoading::Hertz(Hertz), ..scene.model() });
    let restitution = elastic.restitution(impact).map_or("unknown".into(), |restitution| cell(restitution, 1.0));
    let more = match scene.loss_of(0) {
        Some(AnyLoss::Plate(plate)) => format!(
            " The plate gives way at {} m/s per newton. Until the bodies part, its bending waves spread to a radius of {}: the \
             plate must be larger, or they return from its edge during the contact.",
            cell(plate.factor(), 1.0),
            quantity(bending_front(&plate, predictions.iter().map(Prediction::contact_time).fold(0.0, f64::max)), "m")
        ),
        _ => String::new(),
    };
    Some(format!(
        "The scene has a loss below yield: {}. It alone would leave an elastic impact of this speed a restitution of \
         {restitution}.{more}",
        loss.name()
    ))
}

/// The strength of the softer body in an impact, if it depends on the impact, and its reliability.
fn strength(scene: &Scene, impact: &Impact) -> Vec<String> {
    let depends = scene.depends_on_impact();
    let Some(found) = depends.then(|| scene.in_impact(0, impact)).flatten() else { return Vec::new() };
    let mut notes = Vec::new();
    if let (Some(law), Some(line)) = (scene.power_law(0), found.line) {
        let restitution = |part: f64| {
            let prediction = scene.predict_with_strain(impact, &found, part);
            prediction.map_or("unknown".into(), |prediction| cell(prediction.restitution, 1.0))
        };
        notes.push(format!(
            "The power law {} eps^{} is taken as linear hardening up to a plastic strain of {}, Tabor's 0.2 a/R of this impact, with the \
             largest contact radius a and R = {}, the radius of the rigid sphere that would press the {} in the same way: S = {}, H = {}. At that strain the flow stress is {} % off; with half or twice the strain the restitution would be {} or {} by \
             the scene's law.",
            quantity(law.coefficient, "Pa"),
            law.exponent,
            cell(line.strain, 1.0),
            quantity(found.indenter_radius, "m"),
            scene.softer(0).name(),
            quantity(line.yield_strength, "Pa"),
            quantity(line.hardening_modulus, "Pa"),
            cell(100.0 * line.error, 1.0),
            restitution(0.5),
            restitution(2.0),
        ));
    }
    notes.extend(Body::ALL.into_iter().filter_map(|body| scene.measured_words(0, body, &found)));
    if scene.rate(0).is_some() {
        notes.push(format!(
            "At the mean strain rate of this impact, {} 1/s, the {} is {} times as strong as at rest: S = {}.{}",
            cell(found.strain_rate, 1.0),
            scene.softer(0).name(),
            cell(found.factor, 1.0),
            quantity(found.yield_strength, "Pa"),
            if scene.assumes_rate(0) { ASSUMED_RATE } else { "" },
        ));
    }
    notes
}
