//! A checked scene: its type can't hold what the rules forbid.

use super::ellipses::Elliptic;
use super::inverse_masses::InverseMasses;
use super::losses::{self, Loss};
use super::strength::Flow;
use crate::body::{Body, Both, Rod};
use crate::model::{AnyModel, RateLaw, paired};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::impact::{Impact, Prediction};
use brinell_contact::loading::{AnyLoading, Hertz};
use brinell_contact::losses::{AnyLoss, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_contact::material::hardening::Hardening;
use brinell_contact::rate::{Factors, Rate};
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Model, Surface};
use std::sync::Arc;

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
    pub laws: SceneLaws,
    /// Where the constant `C` of a line contact is from, or how near the law is to a curve of one's own, in words; `None` for other laws.
    pub law_words: Option<String>,
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
#[derive(Clone, Debug)]
pub struct Coupling {
    /// Whether the importer steps all FMUs at once.
    pub parallel: bool,
    /// Whether `external_acceleration` is an input.
    pub acceleration_input: bool,
    pub masses: Masses,
}

/// The masses that the FMU knows.
#[derive(Clone, Debug)]
pub enum Masses {
    /// Each contact has an effective mass by itself: a parameter, or an input.
    Effective { is_input: bool },
    /// The contacts share bodies: how the force of each accelerates the others.
    Shared(InverseMasses),
}

/// A parameter of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    pub name: &'static str,
    pub value: f64,
    /// Whether it can be set; otherwise it is a constant of the FMU.
    pub settable: bool,
    /// Whether each contact of a group has its own value.
    pub per_contact: bool,
}

impl Parameter {
    /// A parameter that contacts share.
    pub fn shared(name: &'static str, value: f64, settable: bool) -> Parameter {
        Parameter { name, value, settable, per_contact: false }
    }
}

/// One contact or several equal ones: a table `[[contact]]`, or the contact of a scene without such tables.
#[derive(Clone, Debug)]
pub struct Group {
    /// `None` for the single contact of a scene without `[[contact]]`, whose variables have plain names.
    pub name: Option<String>,
    /// The number of contacts in the group, if their names are counted.
    pub count: Option<usize>,
    /// The parameters of this group that override those of all contacts, in the order of the table.
    pub own: Vec<Parameter>,
    pub surface: Surface,
    /// Density of the target \[kg/m^3\], if known. It is not a variable; it limits the speeds for which the law is valid.
    pub density: Option<f64>,
    /// Density of the impactor \[kg/m^3\], if known. It is not a variable; the mass follows from it.
    pub impactor_density: Option<f64>,
    /// Length of a line contact \[m\].
    pub line_length: Option<f64>,
    /// The contact as an ellipse, if a body has two radii. Then the density of the target is that of the ball in its place.
    pub ellipse: Option<Elliptic>,
    /// The bodies that are rods. Nothing about them is a variable; they limit the force for which the law is valid.
    pub rods: Both<Option<Rod>>,
    /// Yield strength of the impactor \[Pa\], if known. It is a variable only where the impactor may yield.
    pub impactor_strength: Option<f64>,
    /// Hardening that depends on the strain of the impact, for which yield strength and hardening modulus stand.
    pub flows: Flows,
}

/// The hardening of two bodies that depends on the strain of the impact. Many contacts share one.
pub type Flows = Both<Option<Arc<Flow>>>;

impl Group {
    /// The number of contacts in the group.
    pub fn size(&self) -> usize {
        self.count.unwrap_or(1)
    }

    /// The prefix of the variables of a contact, counted from 0: "", "left." or "contact\[7].".
    pub fn prefix(&self, index: usize) -> String {
        match (&self.name, self.count) {
            (None, _) => String::new(),
            (Some(name), None) => format!("{name}."),
            (Some(name), Some(_)) => format!("{name}[{}].", index + 1),
        }
    }

    /// One name for all contacts of the group: "left", or "bead\[1..1000]".
    pub fn label(&self) -> String {
        match (&self.name, self.count) {
            (Some(name), Some(count @ 2..)) => format!("{name}[1..{count}]"),
            _ => self.prefix(0).trim_end_matches('.').into(),
        }
    }

    /// The name in the FMU of the parameter `name` that all contacts of the group share.
    pub fn variable(&self, name: &str) -> String {
        self.name.as_ref().map_or(name.into(), |own| format!("{own}.{name}"))
    }

    /// The name in the FMU of the group's own `parameter`, for the contact with this `index`.
    pub fn own_variable(&self, parameter: &Parameter, index: usize) -> String {
        match parameter.per_contact {
            true => self.prefix(index) + parameter.name,
            false => self.variable(parameter.name),
        }
    }

    /// Radius of the thinnest of its rods \[m\], as if it were round.
    pub fn rod_radius(&self) -> Option<f64> {
        let rods = [self.rods.impactor, self.rods.target].into_iter().flatten();
        rods.map(|rod| rod.radius()).reduce(f64::min)
    }

    /// The number of variables for the group's own `parameter`.
    pub fn variables_of(&self, parameter: &Parameter) -> usize {
        if parameter.per_contact { self.size() } else { 1 }
    }
}

/// The laws of the contacts, by what a contact can do.
#[allow(clippy::large_enum_variant, reason = "a scene has one")]
#[derive(Clone, Copy, Debug)]
pub enum SceneLaws {
    /// The force depends on the rate, and no dent is left.
    Damped(&'static str, AnyDamped),
    /// Nothing yields: `hertz`.
    Elastic { loss: Option<Loss> },
    /// A body yields.
    Plastic {
        loading: (&'static str, AnyLoading),
        unloading: (&'static str, AnyUnloading),
        /// Whether unloading is limited to return no more than the loading took.
        passivity_guard: bool,
        /// The loss below yield.
        loss: Option<Loss>,
    },
}

impl SceneLaws {
    /// The name of the loading law, or of the law whose force depends on the rate.
    pub fn name(&self) -> &'static str {
        if let SceneLaws::Damped(name, _) = self { name } else { self.loading().0 }
    }

    /// The law of a force that doesn't depend on the rate: `hertz`, if nothing yields.
    pub fn loading(&self) -> (&'static str, AnyLoading) {
        if let SceneLaws::Plastic { loading, .. } = self { *loading } else { HERTZ }
    }

    /// The unloading law as the scene names it, if a body yields.
    pub fn unloading(&self) -> Option<(&'static str, AnyUnloading)> {
        if let SceneLaws::Plastic { unloading, .. } = self { Some(*unloading) } else { None }
    }

    /// The unloading law as it is for a target that doesn't harden. An elastic contact never uses its own.
    pub fn plain_unloading(&self) -> AnyUnloading {
        let unloading = self.unloading().map_or(AnyUnloading::ALL[0].1, |(_, law)| law);
        let guarded = if self.is_guarded() { unloading.guarded() } else { None };
        guarded.unwrap_or(unloading)
    }

    /// Whether there is a passivity guard.
    pub fn is_guarded(&self) -> bool {
        matches!(self, SceneLaws::Plastic { passivity_guard: true, .. })
    }

    /// The loss below yield.
    pub fn loss(&self) -> Option<Loss> {
        match self {
            SceneLaws::Damped(..) => None,
            SceneLaws::Elastic { loss } | SceneLaws::Plastic { loss, .. } => *loss,
        }
    }

    /// Whether the force depends on the speed of the motion.
    pub fn depends_on_rate(&self) -> bool {
        matches!(self, SceneLaws::Damped(..)) || self.loss().is_some()
    }

    /// Whether nothing yields, or the force depends on the rate, or the curve says where it yields.
    pub fn has_no_strength(&self) -> bool {
        matches!(self.loading().1, AnyLoading::Hertz(_) | AnyLoading::Tabulated(_))
    }
}

pub(super) const HERTZ: (&str, AnyLoading) = ("hertz", AnyLoading::Hertz(Hertz));

impl Coupling {
    /// Whether `effective_mass` is an input.
    pub(super) fn mass_is_input(coupling: Option<&Coupling>) -> bool {
        matches!(coupling, Some(Coupling { masses: Masses::Effective { is_input: true }, .. }))
    }
}

impl Scene {
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
        let shared = self.inverse_masses().and_then(|masses| masses.effective_mass(group, self.rows()));
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
        match name {
            "external_acceleration" => self.coupling.as_ref().is_some_and(|coupling| coupling.acceleration_input),
            "effective_mass" => self.mass_is_input(),
            _ => false,
        }
    }

    /// Whether the input may have derivatives. In a scene that moves its bodies, its derivative is their acceleration.
    pub fn has_course(&self) -> bool {
        self.input_derivatives && !self.is_rate_dependent() || self.coupling.is_some()
    }

    /// Whether `effective_mass` is an input.
    pub fn mass_is_input(&self) -> bool {
        Coupling::mass_is_input(self.coupling.as_ref())
    }

    /// How the force of each contact accelerates the others, if they share bodies.
    pub fn inverse_masses(&self) -> Option<&InverseMasses> {
        match &self.coupling.as_ref()?.masses {
            Masses::Shared(masses) => Some(masses),
            Masses::Effective { .. } => None,
        }
    }

    /// Whether the importer steps all FMUs at once.
    pub fn is_parallel(&self) -> bool {
        self.coupling.as_ref().is_some_and(|coupling| coupling.parallel)
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
        let SceneLaws::Damped(_, law) = self.laws else { return self.with_loss(group, self.model_of(group)) };
        let law = RateLaw {
            law,
            restitution: self.group_value(group, "restitution").unwrap_or(1.0),
            mass: self.group_value(group, "effective_mass").unwrap_or(f64::INFINITY),
        };
        law.on(self.pair_of(group).expect("a checked scene has bodies that fit"))
    }

    /// What is assumed of the impact if the scene names none.
    pub fn assumption(&self) -> &'static str {
        let knows_mass = self.coupling.is_some() && self.inverse_masses() != Some(&InverseMasses::Inputs);
        if knows_mass { "1 m/s is assumed" } else { "a solid impactor is assumed" }
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
    pub(super) fn unpaired_model_of(&self, group: usize) -> Model<AnyLoading, AnyUnloading> {
        let pair = self.pair_of(group).expect("a checked scene has bodies that fit");
        Model {
            pair,
            loading: self.laws.loading().1,
            unloading: self.laws.plain_unloading(),
            surface: self.contacts[group].surface,
        }
    }

    /// Whether its contacts are lines, of cylinders.
    pub fn is_line(&self) -> bool {
        self.laws.loading().1.is_line()
    }

    /// Whether the FMU has the form of its laws for two bodies. A law that has one is exact only in this form.
    pub fn is_paired(&self) -> bool {
        self.laws.loading().1.takes_both_bodies()
    }

    /// Whether the impactor of a contact may yield.
    pub fn has_two_strengths(&self) -> bool {
        let mut all = self.contacts.iter().flat_map(|group| &group.own).chain(&self.parameters);
        all.any(|parameter| parameter.name == Body::Impactor.yield_strength())
    }

    /// Whether its contacts have friction.
    pub fn has_friction(&self) -> bool {
        self.directions > 0
    }

    /// Whether the force depends on the rate at the same instant.
    pub fn follows_rate(&self) -> bool {
        self.is_damped() || self.laws.loss().is_some_and(Loss::follows_rate)
    }

    /// Whether the force depends on the speed of the motion at all.
    pub fn is_rate_dependent(&self) -> bool {
        self.laws.depends_on_rate()
    }

    /// Whether the damping of its law follows from the mass.
    pub fn damps_by_mass(&self) -> bool {
        if let SceneLaws::Damped(_, law) = self.laws { law.needs_mass() } else { false }
    }

    /// Whether its law is one whose force depends on the rate.
    pub fn is_damped(&self) -> bool {
        matches!(self.laws, SceneLaws::Damped(..))
    }

    /// The contact of `group` by an elastoplastic `model`, with the loss of the scene.
    pub fn with_loss(&self, group: usize, model: Model<AnyLoading, AnyUnloading>) -> AnyModel {
        match self.loss_of(group) {
            None => AnyModel::Elastoplastic(model),
            Some(loss) => AnyModel::Lossy(brinell_contact::losses::Model { plastic: model, loss }, None),
        }
    }

    /// The loss of the contacts of `group`.
    pub fn loss_of(&self, group: usize) -> Option<AnyLoss> {
        let value = |name| self.group_value(group, name).unwrap_or(f64::NAN);
        let [_, target] = self.bodies(group);
        let density = self.contacts[group].density.unwrap_or(f64::NAN);
        let target = Solid { density, youngs_modulus: target.youngs_modulus, poissons_ratio: target.poissons_ratio };
        Some(match self.laws.loss()? {
            Loss::Fitted(_) => {
                AnyLoss::RestitutionFitted(RestitutionFitted { restitution: value(losses::RESTITUTION) })
            }
            Loss::Waves => AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation { target }),
            Loss::Plate(_) => AnyLoss::Plate(Plate { target, thickness: value(losses::THICKNESS) }),
        })
    }
}
