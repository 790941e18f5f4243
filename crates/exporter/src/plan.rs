//! The common basis of all files of an FMU, computed once for the model description, constants, documentation and summary.

use crate::energy::{self, Energy};
use crate::guard::Guard;
use crate::interface::{Entry, entries};
use crate::nominal::{Experiment, experiment};
use crate::predict;
use crate::rods::Waves;
use crate::scene::{Group, Parameter, Scene};
use crate::table::{self, Feature};
use crate::validity;
use brinell_contact::impact::Prediction;

/// The plan of an FMU.
pub struct Plan<'a> {
    pub scene: &'a Scene,
    /// Its variables, in order.
    pub variables: Vec<Entry<'a>>,
    /// The parameters that cannot be set.
    pub constants: Vec<FixedParameter>,
    /// Whether its laws can return more energy than they took.
    pub makes_energy: bool,
    /// Step size and stop time that suit the scene.
    pub experiment: Experiment,
    /// The ranges in which the passivity guard acts, if the scene has one.
    pub guard: Option<Guard>,
    /// Warnings about the validity of the law in the scene's impact on the first contact.
    pub warnings: Vec<String>,
    /// The waves in the rods of the first contact in the scene's impact, if it has rods.
    pub waves: Option<Waves>,
    /// A note about shared bodies, for an FMU that moves the bodies of several contacts.
    pub shared_bodies: Option<&'static str>,
    /// The limits of validity of the law on the first contact, in words.
    pub valid: String,
}

/// A scene without tables `[[body]]` doesn't say which bodies two contacts share.
const SHARED_BODIES: &str = "the FMU moves the bodies of each contact separately: a body that two contacts share, as in a chain or \
                             between two walls, would be moved twice. For such contacts give tables [[body]], and `between` in each \
                             [[contact]]: one FMU then moves all of them";

/// A parameter that cannot be set.
pub struct FixedParameter {
    pub name: String,
    pub value: f64,
    /// Unit; empty for a dimensionless number.
    pub unit: &'static str,
    /// Whether it belongs to all contacts and not to one group.
    pub shared: bool,
}

impl Plan<'_> {
    /// The plan of the FMU of `scene`.
    pub fn of(scene: &Scene) -> Plan<'_> {
        let model = scene.any_model();
        let (prediction, speed) = (&scene.predictions[0], scene.impact.speed);
        let warnings = predict::beyond(scene, &model.pair(), speed, prediction).into_iter().map(validity::words);
        let energy = energy::of(scene);
        Plan {
            scene,
            variables: entries(scene, &kinds(scene, energy)),
            constants: constants(scene),
            makes_energy: matches!(energy, Energy::MayBeMade { .. }),
            experiment: experiment(scene),
            guard: Guard::of(scene),
            warnings: warnings.collect(),
            waves: Waves::of(scene, speed),
            shared_bodies: moves_separately(scene).then_some(SHARED_BODIES),
            valid: validity::limits(scene),
        }
    }

    /// A line about the rods of the first contact, if their waves allow the force of the scene's impact.
    pub fn waves_note(&self) -> Option<String> {
        self.waves?.note(&self.scene.predictions[..1])
    }

    /// The prediction of the scene's impact on its first contact.
    pub fn prediction(&self) -> &Prediction {
        &self.scene.predictions[0]
    }
}

/// Whether the FMU moves the bodies of several contacts, each by itself.
fn moves_separately(scene: &Scene) -> bool {
    scene.coupling.is_some() && scene.inverse_masses().is_none() && scene.contact_count() > 1
}

/// The kinds of the FMU of `scene`, whose laws have this `energy` balance.
fn kinds(scene: &Scene, energy: Energy) -> Vec<Feature> {
    // a loss adds heat to that of yielding
    let heats = scene.laws.loss().is_some() && scene.coupling.is_none() && energy == Energy::Passive;
    let kinds = [
        // before those that describe the same variable for the normal alone
        (Feature::SharedFriction, scene.inverse_masses().is_some() && scene.has_friction()),
        (Feature::RateDependent, scene.is_damped() || heats),
        (Feature::HeldInputs, !scene.input_derivatives),
        (Feature::Parallel, scene.is_parallel()),
        (Feature::AccelerationInput, scene.has_input("external_acceleration")),
        (Feature::MassKnown, scene.coupling.is_some()),
        (Feature::DentsAboveSurface, energy::dents_above_surface(scene, energy)),
        (Feature::MakesEnergy, matches!(energy, Energy::MayBeMade { .. })),
        (Feature::LosesLess, energy == Energy::Guarded),
        (Feature::FindsStrength, scene.finds_strength()),
    ];
    kinds.into_iter().filter_map(|(kind, is)| is.then_some(kind)).collect()
}

/// The parameters of `scene` that cannot be set: first those of all contacts, then those of each group.
fn constants(scene: &Scene) -> Vec<FixedParameter> {
    let mut constants = Vec::new();
    let mass_is_input = scene.mass_is_input();
    let mut add = |group: Option<&Group>, parameters: &[Parameter]| {
        for Parameter { name, value, .. } in parameters.iter().filter(|parameter| !parameter.settable) {
            // it is only a start value
            if mass_is_input && *name == "effective_mass" {
                continue;
            }
            let unit = table::variable(name).unit.as_deref().unwrap_or("");
            let shared = group.is_none();
            let name = group.map_or((*name).into(), |group| group.variable(name));
            constants.push(FixedParameter { name, value: *value, unit, shared });
        }
    };
    add(None, &scene.parameters);
    scene.contacts.iter().for_each(|group| add(Some(group), &group.own));
    constants
}
