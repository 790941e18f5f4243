//! The scene: which laws, which variables, which start values.
//!
//! `brinell export` writes this file for every scene that it builds. The one in the source tree is that of
//! `scenes/steel_ball.toml`, without identification; a test compares it with what the exporter writes.

use crate::contact::{self, Pair, Surface, loading, unloading};
use crate::instance::Values;
use crate::variable::{Integer, Parameter, Real, Settable, kind_and_contact};

/// What the model description and the binary recognise each other by.
pub const GUID: &str = "unpacked";

/// How many contacts there are.
pub const CONTACTS: usize = 1;
/// How many groups of equal contacts they form.
pub const GROUPS: usize = 1;
/// The name of each group, and whether its contacts are counted.
pub static GROUP_NAMES: [(&str, bool); GROUPS] = [("", false)];

/// The group of a contact.
pub fn group(_contact: usize) -> usize {
    0
}

/// The contact behind the last one of a group.
pub fn end(_group: usize) -> usize {
    CONTACTS
}

/// The loading law.
pub type Loading = loading::BigAlabo;
/// The loading law with its constants.
pub const LOADING: Loading = loading::BigAlabo {
    yield_pressure_factor: 1.1,
    plastic_pressure_factor: 2.8,
    second_region: 13.93,
    fully_plastic: 82.5,
    plastic_slope: 5.09090909090909,
};

/// The unloading law.
pub type Unloading = unloading::ContactRadius;
/// The unloading law with its constants.
pub const UNLOADING: Unloading = unloading::ContactRadius;

/// Where the passivity guard acts, if there is one.
pub const GUARD: Option<&str> = None;

/// What a new contact of a group meets.
pub fn surface(_group: usize) -> Surface {
    Surface::Dented
}

/// What a contact remembers.
pub type History = contact::History;
/// What is in contact, and by which laws.
pub type Model = contact::Model<Loading, Unloading>;

/// What moves a contact through a step by its mass.
pub type Follow = contact::motion::Follow<History, Model>;

/// These bodies with the laws of the scene.
pub fn model(pair: Pair, group: usize, _settable: &Values) -> Model {
    Model { pair, loading: LOADING, unloading: UNLOADING, surface: surface(group) }
}

/// Density of the target of a group [kg/m^3], if it is known.
pub fn density(_group: usize) -> Option<f64> {
    Some(7850.0)
}

/// Whether an output tells the momentum of a step.
pub const MOMENTUM: bool = false;
/// Whether an output predicts the force of the next step.
pub const PREDICTS: bool = false;
/// How the bodies move through a step, if the unit knows their mass.
pub const FOLLOW: Option<Follow> = None;

/// The parameters that can be set.
pub const SETTABLE: [Settable; 5] = [
    Settable { name: "impactor.radius", unit: "m", start: 0.005, minimum: 1e-12, maximum: 1e9 },
    Settable { name: "target.youngs_modulus", unit: "Pa", start: 2.06e11, minimum: 1.0, maximum: 1e18 },
    Settable { name: "target.poissons_ratio", unit: "", start: 0.3, minimum: -0.99, maximum: 0.5 },
    Settable { name: "target.yield_strength", unit: "Pa", start: 3e8, minimum: 1e-9, maximum: 1e18 },
    Settable { name: "initial_gap", unit: "m", start: 0.0, minimum: -1e6, maximum: 1e6 },
];

/// The value of any parameter for the contacts of a group: set, or constant in this scene.
pub fn parameter(parameter: Parameter, _group: usize, settable: &Values) -> f64 {
    match parameter {
        Parameter::ImpactorRadius => settable[0],
        Parameter::ImpactorYoungsModulus => f64::INFINITY,
        Parameter::ImpactorPoissonsRatio => 0.0,
        Parameter::TargetRadius => f64::INFINITY,
        Parameter::TargetYoungsModulus => settable[1],
        Parameter::TargetPoissonsRatio => settable[2],
        Parameter::TargetYieldStrength => settable[3],
        Parameter::Restitution => 1.0,
        Parameter::EffectiveMass => f64::INFINITY,
        Parameter::InitialGap => settable[4],
    }
}

/// How many variables a contact has, beside the parameters.
const KINDS: u32 = 6;

/// The Real variable with this value reference, and its contact.
#[inline]
pub fn real(value_reference: u32) -> Option<(Real, usize)> {
    let (kind, contact) = kind_and_contact(value_reference, CONTACTS);
    let variable = match kind {
        0 => Real::IndentationRate,
        1 => Real::Force,
        2 => Real::Indentation,
        3 => Real::ResidualIndentation,
        4 => Real::DissipatedEnergy,
        KINDS.. => {
            let index = (kind - KINDS) as usize * CONTACTS + contact;
            return (index < SETTABLE.len()).then_some((Real::Parameter(index), 0));
        }
        _ => return None,
    };
    Some((variable, contact))
}

/// The Integer variable with this value reference, and its contact.
pub fn integer(value_reference: u32) -> Option<(Integer, usize)> {
    let (kind, contact) = kind_and_contact(value_reference, CONTACTS);
    let variable = match kind {
        5 => Integer::Regime,
        _ => return None,
    };
    Some((variable, contact))
}
