//! The scene file: the contacts, their laws, and the variables that the FMU has.

mod beside;
pub mod bodies;
mod checks;
mod contacts;
mod cylinders;
pub mod ellipses;
mod file;
mod fmu;
mod friction;
mod inverse_masses;
mod laws;
mod losses;
pub mod names;
mod parser_words;
pub mod plausible;
mod quantities;
pub mod rules;
mod shared_bodies;
pub mod strength;
mod tabulated;

use crate::mistake::Spanned;
use crate::mistake::{Mistake, SceneError};
use crate::model::{AnyModel, RateLaw, paired};
use brinell_contact::Model;
use brinell_contact::damped::AnyDamped;
use brinell_contact::hardening::Hardening;
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::AnyLoading;
use brinell_contact::rate::Factors;
use brinell_contact::unloading::AnyUnloading;
use std::path::Path;

pub use beside::{Beside, MaterialTable, OwnMaterial};
pub use bodies::{Body, Both};
pub use contacts::taken_names;
pub use contacts::{Group, Parameter};
pub use cylinders::LINE;
pub use file::{FLAT, SceneFile, TABLE};
pub use fmu::INPUTS;
pub use inverse_masses::{InverseMasses, place};
pub use losses::{Loss, WAVES};
pub use names::{IDENTIFIER, any_case, is_no_name};
pub use quantities::{PRODUCT, quantity_of};
pub use rules::OF_ALL_CONTACTS;
pub use shared_bodies::{GROUND, Meeting};
pub use strength::{Flow, InImpact, MODELS as RATE_MODELS, PowerLaw, Rate};

/// Whether an FMU can have this `name`: a C identifier that every operating system accepts as a file name.
///
/// # Errors
/// The reason in words.
pub fn check_name(name: &str) -> Result<(), String> {
    names::check_name(&Spanned::new(0..0, name.into())).map(drop).map_err(|Mistake(_, message)| message)
}

/// A commented scene to start from, with this `name`.
pub fn new_scene(name: &str) -> String {
    include_str!("new_scene.toml").replace("NAME", name)
}

/// The names of the files in the `text` of a scene, relative to it: [`Beside`] takes their bytes. None, if it is no TOML.
pub fn files_named(text: &str) -> Vec<String> {
    file::files_named(text)
}

/// The `text` of the scene file at `path` with all numbers in SI units, for readers of TOML that know no other, and with what it uses
/// of the files `beside` it.
///
/// # Errors
/// As for [`Scene::parse`], of text that is not TOML, and of wrong units.
pub fn in_si(text: &str, path: &Path, beside: &Beside) -> Result<String, SceneError> {
    let alone = file::SceneFile::read(text, beside).map(|file| file.alone);
    // what is no scene may have numbers, too
    let alone = alone.unwrap_or_else(|_| text.into());
    file::in_si(&alone, &beside.files).map_err(|mistake| mistake.in_file(text, path))
}

/// A checked scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name of the FMU: a C identifier.
    pub name: String,
    pub description: String,
    /// Who answers for the FMU; empty if nobody is named.
    pub author: String,
    /// The parameters of all contacts, in the order of the table.
    pub parameters: Vec<Parameter>,
    /// The groups of contacts: at least one.
    pub contacts: Vec<Group>,
    /// The requested outputs in addition to the force.
    pub outputs: Vec<String>,
    pub loading: (&'static str, AnyLoading),
    /// `None` for an elastic contact.
    pub unloading: Option<(&'static str, AnyUnloading)>,
    /// The law of a contact whose force depends on the rate. Such a contact has no other law.
    pub damped: Option<(&'static str, AnyDamped)>,
    /// The loss below yield.
    pub loss: Option<Loss>,
    /// Whether unloading is limited to return no more than the loading took.
    pub passivity_guard: bool,
    /// Yield strength of the softer body of the first contact \[Pa\], if it has one, whether or not the scene's law needs it.
    pub yield_strength: Option<f64>,
    /// How the strengths grow with the strain rate.
    pub rates: Both<Option<Rate>>,
    /// The hardening that the scene gives for the bodies of each group; a power law or a rate puts another in its place.
    pub quasi_static: Vec<Both<Hardening>>,
    /// Factors on the strengths of the bodies of each group in the scene's impact, if the unit
    /// [finds them](Scene::finds_strength); then they aren't part of the parameters.
    pub factors: Vec<Factors>,
    /// How the unit moves the bodies through a step by their mass, if it does.
    pub coupling: Option<Coupling>,
    /// How the force of each contact accelerates the others, if they share bodies. The unit then moves these bodies: there is a
    /// `coupling`, and no effective mass of a contact by itself.
    pub inverse_masses: Option<InverseMasses>,
    /// The two bodies of the first contact, if it has friction and its bodies are in tables.
    pub meeting: Option<[Meeting; 2]>,
    /// Where the constant `C` of a line contact is from, in words; `None` for contacts of balls.
    pub line: Option<String>,
    /// How near the law is to a curve of one's own, in words; `None` for other laws.
    pub own_curve: Option<String>,
    /// Number of tangential directions, zero without friction.
    pub directions: usize,
    pub impact: Impact,
    /// The prediction of the impact for the contacts of each group.
    pub predictions: Vec<Prediction>,
    /// Whether the scene names no impact; a solid impactor at 1 m/s is then assumed, of steel if its density is
    /// unknown.
    pub impact_is_assumed: bool,
    /// Whether the FMU warns of steps that are unstable with the mass of the impact.
    pub watches: bool,
    /// Whether the inputs may have derivatives, as far as the law allows.
    pub input_derivatives: bool,
    /// Whether the names of variables are declared as structured instead of flat.
    pub structured_names: bool,
    /// Step size and stop time that the FMU suggests \[s\], if the scene gives them.
    pub step_size: Option<f64>,
    pub stop_time: Option<f64>,
    /// Whether the library needs nothing from its process, and takes memory from its importer.
    pub standalone: bool,
    /// Where the materials that aren't built in are from, a sentence for each.
    pub materials: Vec<String>,
    /// The text of the file, with what it uses of the files beside it.
    pub text: String,
}

/// The coupling of an FMU that knows the mass with its importer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coupling {
    /// Whether the importer steps all FMUs at once.
    pub parallel: bool,
    /// Whether `external_acceleration` is an input.
    pub acceleration_input: bool,
    /// Whether `effective_mass` is an input.
    pub mass_input: bool,
}

impl Scene {
    /// Checks the scene `text`. `path` is used in messages.
    ///
    /// # Errors
    /// [`SceneError`] with line and column of the first error, and what is allowed there.
    pub fn parse(text: String, path: &Path) -> Result<Scene, SceneError> {
        Ok(Scene::parse_beside(&text, path, &Beside::default())?.0)
    }

    /// The scene with this `text`, with what lies `beside` it, and the numbers in it that are implausible.
    ///
    /// # Errors
    /// As for [`Scene::parse`].
    pub fn parse_beside(text: &str, path: &Path, beside: &Beside) -> Result<(Scene, Vec<SceneError>), SceneError> {
        let checked = file::SceneFile::read(text, beside).and_then(|mut file| {
            let doubts = plausible::doubts(&file);
            let alone = std::mem::take(&mut file.alone);
            Ok((Scene { text: alone, ..checks::check(file, &doubts)? }, doubts))
        });
        let placed = |mistake: Mistake| mistake.in_file(text, path);
        let (scene, doubts) = checked.map_err(placed)?;
        Ok((scene, doubts.into_iter().map(placed).collect()))
    }

    /// The value of a parameter of all contacts; `None` if the scene does not have it.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.parameters.iter().find(|parameter| parameter.name == name).map(|parameter| parameter.value)
    }

    /// The value of a parameter for the contacts of `group`: their own, or that of all contacts.
    pub fn group_value(&self, group: usize, name: &str) -> Option<f64> {
        let own = self.contacts[group].own.iter().find(|parameter| parameter.name == name);
        own.map(|parameter| parameter.value).or_else(|| self.value(name))
    }

    /// The impact on the contacts of `group`. If the FMU knows their mass, that mass is used, also where it follows from bodies.
    pub fn impact_of(&self, group: usize) -> Impact {
        // contacts of bodies are groups of one
        let shared = self.inverse_masses.as_ref().and_then(|masses| masses.effective_mass(group, self.rows()));
        let mass = self.group_value(group, "effective_mass").or(shared);
        Impact { mass: mass.unwrap_or(self.impact.mass), ..self.impact }
    }

    /// The number of groups of equal contacts. If contacts of a table may differ, each is a group of its own.
    pub fn group_count(&self) -> usize {
        let differ = self.contacts.iter().any(|group| group.size() > 1 && group.own.iter().any(|own| own.per_contact));
        if differ { self.contact_count() } else { self.contacts.len() }
    }

    /// Whether the FMU has the input `name`, which is not the rate.
    pub fn has_input(&self, name: &str) -> bool {
        if let Some(direction) = ["tangential_rate", "tangential_rate[2]"].iter().position(|rate| *rate == name) {
            return direction < self.directions;
        }
        let tangential = ["external_tangential_acceleration", "external_tangential_acceleration[2]"];
        if let Some(direction) = tangential.iter().position(|acceleration| *acceleration == name) {
            return self.has_input("external_acceleration") && direction < self.directions;
        }
        self.coupling.is_some_and(|coupling| match name {
            "external_acceleration" => coupling.acceleration_input,
            "effective_mass" => coupling.mass_input,
            _ => false,
        })
    }

    /// The parameters of all contacts that can be set.
    pub fn settable(&self) -> impl Iterator<Item = &Parameter> {
        self.parameters.iter().filter(|parameter| parameter.settable)
    }

    /// The number of contacts of the FMU.
    pub fn contact_count(&self) -> usize {
        self.contacts.iter().map(Group::size).sum()
    }

    /// The number of rows of contacts that share bodies: a normal for each, and its tangents.
    pub fn rows(&self) -> usize {
        self.contact_count() * (1 + self.directions)
    }

    /// The physical model of the first contact.
    pub fn any_model(&self) -> AnyModel {
        self.any_model_of(0)
    }

    /// The physical model of the contacts of `group`.
    pub fn any_model_of(&self, group: usize) -> AnyModel {
        let Some((_, law)) = self.damped else { return self.with_loss(group, self.model_of(group)) };
        let law = RateLaw {
            law,
            restitution: self.group_value(group, "restitution").unwrap_or(1.0),
            mass: self.group_value(group, "effective_mass").unwrap_or(f64::INFINITY),
        };
        law.on(self.pair_of(group).expect("a checked scene has bodies that fit"))
    }

    /// What is assumed of the impact if the scene names none.
    pub fn assumption(&self) -> &'static str {
        let knows_mass = self.coupling.is_some() && self.inverse_masses != Some(InverseMasses::Inputs);
        if knows_mass { "1 m/s is assumed" } else { "a solid impactor is assumed" }
    }

    /// The name of the loading law, or of the law whose force depends on the rate.
    pub fn law_name(&self) -> &'static str {
        self.damped.map_or(self.loading.0, |(name, _)| name)
    }

    /// The elastoplastic model of the first contact.
    pub fn model(&self) -> Model<AnyLoading, AnyUnloading> {
        self.model_of(0)
    }

    /// The elastoplastic model of the contacts of `group`.
    pub fn model_of(&self, group: usize) -> Model<AnyLoading, AnyUnloading> {
        paired(&self.unpaired_model_of(group), self.two_bodies(group), self.softer(group)).prepared()
    }

    /// The same without what its laws need to know of two bodies. An elastic contact never uses its unloading law.
    fn unpaired_model_of(&self, group: usize) -> Model<AnyLoading, AnyUnloading> {
        let pair = self.pair_of(group).expect("a checked scene has bodies that fit");
        let unloading = self.plain_unloading();
        Model { pair, loading: self.loading.1, unloading, surface: self.contacts[group].surface }
    }

    /// The unloading law as it is for a target that doesn't harden.
    pub fn plain_unloading(&self) -> AnyUnloading {
        let unloading = self.unloading.map_or(AnyUnloading::ALL[0].1, |(_, law)| law);
        let guarded = if self.passivity_guard { unloading.guarded() } else { None };
        guarded.unwrap_or(unloading)
    }

    /// Whether the FMU has the form of its laws for two bodies. A law that has one is exact only in this form.
    pub fn is_paired(&self) -> bool {
        self.damped.is_none() && self.loading.1.takes_both_bodies()
    }

    /// Whether the impactor of a contact may yield.
    pub fn has_two_strengths(&self) -> bool {
        let mut all = self.contacts.iter().flat_map(|group| &group.own).chain(&self.parameters);
        all.any(|parameter| parameter.name == Body::Impactor.yield_strength())
    }
}
