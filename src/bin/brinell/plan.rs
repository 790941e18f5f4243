//! Everything that the files of an FMU are made from, computed once for model description, constants, documentation and summary.

use crate::energy::{self, Energy};
use crate::guard::Guard;
use crate::interface::{Entry, entries};
use crate::nominal::{Experiment, experiment};
use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Kind};
use crate::validity;
use brinell::contact::impact::Prediction;

/// A unit that is going to be made.
pub struct Plan<'a> {
    pub scene: &'a Scene,
    /// Its variables, in order.
    pub variables: Vec<Entry<'a>>,
    /// The parameters that can't be set.
    pub constants: Vec<Constant>,
    /// Whether its laws can give back more than they took.
    pub makes_energy: bool,
    /// Step and stop time that suit the scene.
    pub experiment: Experiment,
    /// Where the passivity guard acts, if the scene has one.
    pub guard: Option<Guard>,
    /// Where the scene's impact leaves the validity of its law, on the first contact, in words.
    pub warnings: Vec<String>,
    /// What a unit of several contacts that moves their bodies doesn't know, in words.
    pub shared_bodies: Option<&'static str>,
    /// Up to where the law is valid on the first contact, in words.
    pub valid: String,
}

/// No scene says which bodies two contacts have in common.
const SHARED_BODIES: &str = "the FMU moves the bodies of each contact separately: a body that two contacts share, as in a chain or \
                             between two walls, would be moved twice. For such contacts use FMUs without [coupling], and short steps";

/// A parameter that can't be set.
pub struct Constant {
    pub name: String,
    pub value: f64,
    /// Empty for a pure number.
    pub unit: &'static str,
    /// It belongs to all contacts, not to one group.
    pub shared: bool,
}

impl Plan<'_> {
    /// The plan of the unit of `scene`.
    pub fn of(scene: &Scene) -> Plan<'_> {
        let (model, density) = (scene.any_model(), scene.contacts[0].density);
        let energy = energy::of(scene);
        Plan {
            scene,
            variables: entries(scene, &kinds(scene, energy)),
            constants: constants(scene),
            makes_energy: matches!(energy, Energy::MayBeMade { .. }),
            experiment: experiment(scene),
            guard: Guard::of(scene),
            warnings: validity::warnings(&model.pair(), density, &scene.predictions[0], scene.impact.speed),
            shared_bodies: (scene.coupling.is_some() && scene.contact_count() > 1).then_some(SHARED_BODIES),
            valid: validity::limits(&model.pair(), density, model.valid_depth()),
        }
    }

    /// What the scene's impact will do to its first contact.
    pub fn prediction(&self) -> &Prediction {
        &self.scene.predictions[0]
    }
}

/// The kinds of unit that the unit of `scene`, whose laws do this with `energy`, is one of.
fn kinds(scene: &Scene, energy: Energy) -> Vec<Kind> {
    let coupling = scene.coupling;
    let kinds = [
        (Kind::RateDependent, scene.damped.is_some()),
        (Kind::Parallel, coupling.is_some_and(|coupling| coupling.parallel)),
        (Kind::AccelerationInput, coupling.is_some_and(|coupling| coupling.acceleration_input)),
        (Kind::MassKnown, coupling.is_some()),
        (Kind::MakesEnergy, matches!(energy, Energy::MayBeMade { .. })),
        (Kind::LosesLess, energy == Energy::Guarded),
    ];
    kinds.into_iter().filter_map(|(kind, is)| is.then_some(kind)).collect()
}

/// The parameters of `scene` that can't be set: those of all contacts, then group by group.
fn constants(scene: &Scene) -> Vec<Constant> {
    let mut constants = Vec::new();
    let mass_is_input = scene.coupling.is_some_and(|coupling| coupling.mass_input);
    let mut add = |group: Option<&Group>, parameters: &[Parameter]| {
        for Parameter { name, value, .. } in parameters.iter().filter(|parameter| !parameter.settable) {
            // only where it starts
            if mass_is_input && *name == "effective_mass" {
                continue;
            }
            let unit = table::variable(name).unit.as_deref().unwrap_or("");
            let shared = group.is_none();
            let name = group.map_or((*name).into(), |group| group.variable(name));
            constants.push(Constant { name, value: *value, unit, shared });
        }
    };
    add(None, &scene.parameters);
    scene.contacts.iter().for_each(|group| add(Some(group), &group.own));
    constants
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::PREDICTIONS;
    use crate::summary::Summary;
    use crate::{constants, documentation, model_description};
    use std::path::Path;

    /// Sixty contacts of three kinds of bodies; two kinds differ by their gap alone.
    fn scene(law: &str) -> Scene {
        let mut text =
            format!("name = \"bed\"\nimpactor = {{ radius = 5e-3 }}\ntarget = {{ material = \"mild steel\" }}\n{law}");
        for index in 0..15 {
            text += &format!("[[contact]]\nname = \"plain_{index}\"\n");
            text += &format!("[[contact]]\nname = \"apart_{index}\"\ninitial_gap = 1e-{index}\n");
            text += &format!("[[contact]]\nname = \"small_{index}\"\nimpactor = {{ radius = 2e-3 }}\n");
            text += &format!("[[contact]]\nname = \"hard_{index}\"\ntarget = {{ yield_strength = 9e8 }}\n");
        }
        Scene::parse(text, Path::new("bed.toml")).expect("a good scene")
    }

    #[test]
    fn each_prediction_is_made_once_from_the_scene_to_the_last_file() {
        for (law, kinds) in [
            ("law = { unloading = \"thornton\", passivity_guard = true }\n", 3),
            ("law = { loading = \"tsuji\", restitution = 0.5 }\n", 2),
        ] {
            PREDICTIONS.set(0);
            let scene = scene(law);
            let plan = Plan::of(&scene);
            let texts = [
                model_description::write(&plan, "guid"),
                constants::write(&plan, "guid"),
                documentation::write(&plan),
                Summary::of(&plan).json(&Default::default()).to_string(),
            ];
            assert!(texts.iter().all(|text| text.contains("small_7")), "{law}");
            assert_eq!(PREDICTIONS.get(), kinds, "{law}");
        }
    }
}
