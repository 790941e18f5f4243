//! The laws as the table describes them, and what they do on the bodies of a scene.

use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::impact::Impact;
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses;
use brinell_contact::unloading::AnyUnloading;
use brinell_exporter::energy;
use brinell_exporter::law_text::{self, LawText};
use brinell_exporter::model::Dampings;
use brinell_exporter::pairing::unloading_of;
use brinell_exporter::parameters::{self, LawConstant};
use brinell_exporter::scene::Scene;
use serde::Serialize;

/// Laws of each kind.
#[derive(Debug, Serialize)]
pub struct LawList {
    pub loading: Vec<Loads>,
    pub unloading: Vec<Unloads>,
    pub damped: Vec<Rated>,
}

/// The texts about a law.
#[derive(Clone, Debug, Serialize)]
pub struct Told {
    pub title: &'static str,
    pub formulas: Vec<String>,
    pub parameters: Vec<LawConstant>,
    pub validity: String,
    pub notes: String,
    pub reference: &'static str,
}

/// A loading law.
#[derive(Debug, Serialize)]
pub struct Loads {
    pub name: &'static str,
    /// The unloading law of scenes that name none.
    pub unloading: &'static str,
    /// Largest and root mean square error of the force against finite elements, in words.
    pub accuracy: &'static str,
    /// Whether the force jumps.
    pub jumps: bool,
    /// Whether the law is passive with that unloading law, for all bodies.
    pub passive: bool,
    /// The Poisson's ratio of the target from which it is passive, if it is not below.
    pub passive_from_poissons_ratio: Option<f64>,
    /// If it makes energy: the largest restitution for targets with a Poisson's ratio of at least 0, and for others.
    pub largest_restitution: Option<f64>,
    pub largest_auxetic_restitution: Option<f64>,
    #[serde(flatten)]
    pub told: Told,
}

/// An unloading law.
#[derive(Debug, Serialize)]
pub struct Unloads {
    pub name: &'static str,
    #[serde(flatten)]
    pub told: Told,
}

/// A rate-dependent law with one of its damping variants.
#[derive(Debug, Serialize)]
pub struct Rated {
    pub name: String,
    /// Force just after the first touch over the largest force; above 0, the force jumps.
    pub force_at_touch: f64,
    /// Restitution of an impact at 1 m/s if 0.5 is required. Laws that specify their damping directly have their own
    /// restitution.
    pub restitution: f64,
    #[serde(flatten)]
    pub told: Told,
}

/// The required restitution of the rate-dependent laws.
pub const ASKED: f64 = 0.5;

impl Told {
    fn of(text: LawText, parameters: Vec<LawConstant>) -> Told {
        let LawText { law, formulas, notes, validity, .. } = text;
        Told { title: &law.title, formulas, parameters, validity, notes, reference: &law.reference }
    }
}

/// The laws whose names are `wanted`. The rate-dependent ones are tried on the bodies of `scene`.
pub fn those(scene: &Scene, wanted: impl Fn(&str) -> bool) -> LawList {
    let loading = AnyLoading::ALL.into_iter().filter(|(name, _)| wanted(name));
    let unloading = AnyUnloading::ALL.into_iter().filter(|(name, _)| wanted(name));
    let unloading = unloading.map(|(name, law)| {
        let text = law_text::unloading(name, &law);
        let parameters = parameters::constants(&law, text.law);
        Unloads { name, told: Told::of(text, parameters) }
    });
    let damped = AnyDamped::ALL.into_iter().filter(|(name, _)| wanted(name)).flat_map(|(name, law)| {
        let dampings = law.dampings();
        let named = |damping: &&str| (format!("{name}/{damping}"), law.with_damping(damping).expect("one of its own"));
        let variants: Vec<_> = dampings.iter().map(named).collect();
        let variants = if variants.is_empty() { vec![(name.to_string(), law)] } else { variants };
        variants.into_iter().map(move |(variant, law)| rate(scene, name, variant, law))
    });
    LawList {
        loading: loading.map(|(name, law)| load(name, &law)).collect(),
        unloading: unloading.collect(),
        damped: damped.collect(),
    }
}

fn load(name: &'static str, law: &AnyLoading) -> Loads {
    let text = law_text::loading(name, law);
    let (table, unloading) = (text.law, unloading_of(name).0);
    let (passive, passive_from_poissons_ratio) = energy::is_passive(name, unloading);
    let energy = table.energy.as_ref();
    Loads {
        name,
        unloading,
        accuracy: &table.accuracy,
        jumps: table.jumps,
        passive,
        passive_from_poissons_ratio,
        largest_restitution: energy.map(|energy| energy.restitution),
        largest_auxetic_restitution: energy.map(|energy| energy.auxetic_restitution),
        told: Told::of(text, parameters::constants(law, table)),
    }
}

/// The law with the scene's bodies and mass.
fn rate(scene: &Scene, name: &str, variant: String, law: AnyDamped) -> Rated {
    let impact = Impact { mass: scene.impact.mass, speed: 1.0 };
    let model = law.model(scene.model().pair, ASKED, impact.mass);
    let prediction = losses::impact::predict(&model, &impact).expect("an impact within range");
    let mut touched = losses::History::start(&model, 0.0).expect("zero is within range");
    let hardly = 1e-12 * prediction.max_indentation;
    touched.advance(&model, impact.speed, hardly / impact.speed).expect("within range");
    let text = law_text::damped(name, &law);
    let parameters = parameters::constants(&law, text.law);
    Rated {
        name: variant,
        force_at_touch: touched.force(impact.speed) / prediction.max_force,
        restitution: prediction.restitution,
        told: Told::of(text, parameters),
    }
}
