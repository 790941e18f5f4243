//! The features of this library, if it is a prebuilt one.
//!
//! `brinell prebuild` writes this file for every library that it builds. The file in the source tree is that of the kind
//! `force` with the laws of `scenes/steel_ball.toml`; a test compares it with the output of the program.

use crate::contact::{self, Pair, Surface, loading, unloading};
use crate::scene::prebuilt::Kind;
use crate::scene::{Absent, Integer, Parameter, Present, Real, identity_of};

/// A library that the exporter fills in with a scene.
pub struct Library;

/// Hash of the source files of the library.
const MADE_FROM: &str = "unpacked";

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

impl Kind for Library {
    type Model = contact::Model<loading::BigAlabo, unloading::ContactRadius>;
    type Contact = contact::History;

    type Momentum = Absent;
    type Course = Present;
    type Prediction = Absent;
    type Coupling = Absent;
    type Watch = Absent;

    const TWO_STRENGTHS: bool = false;
    const LIBRARY: u64 = identity_of(MADE_FROM);

    fn model(pair: Pair, surface: Surface, _value: impl Fn(Parameter) -> f64) -> Self::Model {
        contact::Model { pair, loading: LOADING, unloading: UNLOADING, surface }
    }

    fn real(place: u8) -> Option<Real> {
        Some(match place {
            0 => Real::IndentationRate,
            1 => Real::Force,
            2 => Real::Indentation,
            4 => Real::ResidualIndentation,
            10 => Real::DissipatedEnergy,
            _ => return None,
        })
    }

    fn integer(_place: u8) -> Option<Integer> {
        None
    }
}
