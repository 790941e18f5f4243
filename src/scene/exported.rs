//! The scene of this library.
//!
//! `brinell export` writes this file for every scene that it builds. The file in the source tree is that
//! of `scenes/steel_ball.toml`, without identification; a test compares it with the output of the exporter.

use crate::contact::{self, Pair, Surface, loading, unloading};
use crate::scene::variable::kind_and_contact;
use crate::scene::{Absent, Integer, Parameter, Present, Real, Scene, Settable, identity_of};

/// The scene of the FMU.
pub struct Exported;

/// Identification that the model description and the binary share.
const GUID: &str = "unpacked";

/// Number of contacts.
const CONTACTS: usize = 1;
/// Number of groups of equal contacts.
const GROUPS: usize = 1;

/// The parameters that can be set.
static SETTABLE: [Settable; 5] = [
    Settable { name: "impactor.radius".as_bytes(), unit: "m".as_bytes(), minimum: 1e-12, maximum: 1e9 },
    Settable { name: "target.youngs_modulus".as_bytes(), unit: "Pa".as_bytes(), minimum: 1.0, maximum: 1e18 },
    Settable { name: "target.poissons_ratio".as_bytes(), unit: "".as_bytes(), minimum: -0.99, maximum: 0.5 },
    Settable { name: "target.yield_strength".as_bytes(), unit: "Pa".as_bytes(), minimum: 1e-9, maximum: 1e18 },
    Settable { name: "initial_gap".as_bytes(), unit: "m".as_bytes(), minimum: -1e6, maximum: 1e6 },
];

/// The loading law with its constants.
const LOADING: loading::BigAlabo = loading::BigAlabo {
    yield_pressure_factor: 1.1,
    plastic_pressure_factor: 2.8,
    second_region: 13.93,
    fully_plastic: 82.5,
    plastic_slope: 5.09090909090909,
};

/// The unloading law with its constants.
const UNLOADING: unloading::ContactRadius = unloading::ContactRadius;

/// Number of variables of a contact, without parameters.
const KINDS: u32 = 5;

impl Scene for Exported {
    type Model = contact::Model<loading::BigAlabo, unloading::ContactRadius>;
    type Contact = contact::History;

    type Contacts<T: Copy> = [T; CONTACTS];
    type Groups<T: Copy> = [T; GROUPS];
    type Values = [f64; SETTABLE.len()];

    type Forces = Absent;
    type Momentum = Absent;
    type Course = Present;
    type Prediction = Absent;
    type Coupling = Absent;
    type Watch = Absent;

    fn guid() -> &'static [u8] {
        GUID.as_bytes()
    }

    fn identity() -> u64 {
        const { identity_of(GUID) }
    }

    fn group(_contact: usize) -> usize {
        0
    }

    fn end(_group: usize) -> usize {
        CONTACTS
    }

    fn contact_name(_contact: usize) -> (&'static str, usize) {
        ("", 0)
    }

    fn settable(index: usize) -> Option<(Settable, Option<usize>)> {
        SETTABLE.get(index).map(|settable| (*settable, None))
    }

    fn start_values() -> Self::Values {
        [0.005, 2.06e11, 0.3, 3e8, 0.0]
    }

    fn parameter(parameter: Parameter, _group: usize, values: &Self::Values) -> f64 {
        match parameter {
            Parameter::ImpactorRadius => values[0],
            Parameter::ImpactorYoungsModulus => f64::INFINITY,
            Parameter::ImpactorPoissonsRatio => 0.0,
            Parameter::ImpactorYieldStrength => f64::INFINITY,
            Parameter::ImpactorHardeningModulus => 0.0,
            Parameter::TargetRadius => f64::INFINITY,
            Parameter::TargetYoungsModulus => values[1],
            Parameter::TargetPoissonsRatio => values[2],
            Parameter::TargetYieldStrength => values[3],
            Parameter::TargetHardeningModulus => 0.0,
            Parameter::Restitution => 1.0,
            Parameter::EffectiveMass => f64::INFINITY,
            Parameter::InitialGap => values[4],
            Parameter::ElasticRestitution => 1.0,
            Parameter::TargetPlateThickness => f64::INFINITY,
            Parameter::FrictionCoefficient => 0.0,
        }
    }

    fn model(pair: Pair, _group: usize, _values: &Self::Values) -> Self::Model {
        contact::Model { pair, loading: LOADING, unloading: UNLOADING, surface: Surface::Dented }
    }

    fn density(_group: usize) -> Option<f64> {
        Some(7850.0)
    }

    #[inline]
    fn real(value_reference: u32) -> Option<(Real, usize)> {
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
        };
        Some((variable, contact))
    }

    fn integer(_value_reference: u32) -> Option<(Integer, usize)> {
        None
    }
}
