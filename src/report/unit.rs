//! The FMU that a report steps: the scene's first contact, with the outputs for one kind of coupling.

use super::ways::Needs;
use crate::scene::{Body, Both, Coupling, Group, Parameter, Scene};
use crate::table::VARIABLES;

/// Outputs that a report reads, whatever the scene and the coupling.
const OUTPUTS: [&str; 3] = ["indentation", "residual_indentation", "dissipated_energy"];

/// The first contact of `scene` alone, for a kind of coupling; all its parameters can be set.
pub fn first_contact(scene: &Scene, needs: Needs) -> Scene {
    let mass = matches!(needs, Needs::Mass | Needs::LateMass).then_some(scene.impact_of(0).mass);
    let more: &[&str] = match needs {
        Needs::Force | Needs::Friction => &[],
        Needs::PredictedForce => &["predicted_force"],
        Needs::MeanForce | Needs::Mass => &["mean_force"],
        Needs::LateMass => &["mean_force", "closing_speed"],
    };
    let mut parameters: Vec<Parameter> = Vec::new();
    // in the order of the table, like the parameters of every scene
    // the other ways move bodies along the normal only
    let friction = needs == Needs::Friction;
    for name in
        VARIABLES.iter().filter(|variable| friction || !variable.friction).map(|variable| variable.name.as_str())
    {
        let shared = scene.parameters.iter().find(|parameter| parameter.name == name);
        let Some(found) = scene.contacts[0].own.iter().find(|own| own.name == name).or(shared) else { continue };
        parameters.push(Parameter::shared(found.name, found.value, true));
    }
    if let (Some(value), None) = (mass, scene.group_value(0, "effective_mass")) {
        // it precedes the gap, which every contact has
        let gap = parameters.iter().position(|parameter| parameter.name == "initial_gap").unwrap_or(parameters.len());
        parameters.insert(gap, Parameter::shared("effective_mass", value, true));
    }
    // a body with its own strength has no power law
    let own = |body: Body| scene.contacts[0].own.iter().any(|own| own.name == body.yield_strength());
    let power_laws = Both::each(|body| scene.power_laws.of(body).filter(|_| !own(body)));
    let unit = Scene {
        name: scene.name.clone(),
        description: scene.description.clone(),
        parameters,
        contacts: vec![Group { name: None, count: None, own: Vec::new(), ..scene.contacts[0].clone() }],
        outputs: OUTPUTS
            .iter()
            .chain(more)
            .chain(friction.then_some(&"tangential_force"))
            .map(|name| (*name).to_string())
            .collect(),
        loading: scene.loading,
        unloading: scene.unloading,
        damped: scene.damped,
        loss: scene.loss,
        passivity_guard: scene.passivity_guard,
        yield_strength: scene.yield_strength,
        power_laws,
        rates: scene.rates,
        quasi_static: vec![scene.quasi_static[0]],
        factors: vec![1.0],
        coupling: mass.map(|_| Coupling { parallel: needs == Needs::LateMass, ..Coupling::default() }),
        directions: usize::from(friction),
        impact: scene.impact_of(0),
        predictions: vec![scene.predictions[0]],
        input_derivatives: true,
        watches: false,
        structured_names: false,
        standalone: false,
        impact_is_assumed: scene.impact_is_assumed,
        text: scene.text.clone(),
    };
    // a unit with a mass finds the strength by itself, the others have it as a parameter
    unit.with_strengths_for(None).expect("the scene has been predicted")
}
