//! A scene whose data are read from memory: the scene of a prebuilt library, which the exporter fills in.
//!
//! The [`Kind`] of the library determines by types what the binary contains: the laws, and the available outputs. The [`block`]
//! contains the rest. A library serves any scene of one contact that requests no more than its kind has.

pub mod block;

use super::variable::{Integer, Parameter, Real, Settable};
use super::{Coupling, Presence, Scene};
use block::{Block, FIRST_PARAMETER, Flag};
use brinell_contact::motion::Follow;
use brinell_contact::{Contact, Pair, Surface};
use core::marker::PhantomData;

/// The contents of a prebuilt library; see [`Scene`] for the types.
pub trait Kind {
    /// The type of the bodies and their laws.
    type Model: Copy;
    /// The type of the state of a contact.
    type Contact: Contact<Self::Model>;
    /// Whether outputs may need the momentum of a step.
    type Momentum: Presence;
    /// Whether the input may have derivatives.
    type Course: Presence;
    /// Whether an output may predict the force at the end of the next step.
    type Prediction: Presence;
    /// The coupling with an importer. Inputs other than the rate exist only if a scene requests them.
    type Coupling: Coupling;
    /// Whether steps that are too long can be detected.
    type Watch: Presence;

    /// Whether the impactor may be the softer body, which yields.
    const TWO_STRENGTHS: bool;
    /// The function that moves the bodies through a step, if the library moves them.
    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = None;
    /// A number that identifies the library; no other library has it.
    const LIBRARY: u64;

    /// The bodies with the laws of the library; `value` gives the parameters of the scene.
    fn model(pair: Pair, surface: Surface, value: impl Fn(Parameter) -> f64) -> Self::Model;

    /// The Real variable with this index in the table of variables, if the library has it.
    fn real(place: u8) -> Option<Real>;

    /// The Integer variable with this index, if the library has it.
    fn integer(place: u8) -> Option<Integer>;
}

/// The source of the data.
pub trait Source {
    /// The block. The compiler must not know its contents.
    fn block() -> &'static Block;

    /// The same block as words.
    fn words() -> &'static [u64; Block::WORDS];
}

/// The scene of a library of kind `K` with the data from `B`.
pub struct Prebuilt<K, B>(PhantomData<(K, B)>);

impl<K: Kind, B: Source> Prebuilt<K, B> {
    /// The meaning of this value reference: an index in the table of variables, or a parameter.
    #[inline]
    fn place(value_reference: u32) -> Option<u8> {
        B::block().data.variables.get(value_reference as usize).copied()
    }
}

impl<K: Kind, B: Source> Scene for Prebuilt<K, B> {
    type Model = K::Model;
    type Contact = K::Contact;

    type Contacts<T: Copy> = [T; 1];
    type Rows<T: Copy> = [T; 1];
    type Groups<T: Copy> = [T; 1];
    type Values = [f64; Parameter::PREBUILT];

    type Forces = super::Absent;
    type Momentum = K::Momentum;
    type Course = K::Course;
    type Prediction = K::Prediction;
    type Coupling = K::Coupling;
    type Watch = K::Watch;
    type Shared = super::Absent;
    type InverseMasses = [f64; 0];

    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = K::FOLLOW;

    fn verify() -> Result<(), &'static str> {
        B::block().check(B::words(), K::LIBRARY)
    }

    fn guid() -> &'static [u8] {
        &B::block().data.guid
    }

    #[inline]
    fn identity() -> u64 {
        B::block().data.identity
    }

    fn group(_contact: usize) -> usize {
        0
    }

    fn end(_group: usize) -> usize {
        1
    }

    fn contact_name(_contact: usize) -> (&'static str, usize) {
        ("", 0)
    }

    fn settable(index: usize) -> Option<(Settable, Option<usize>)> {
        let data = &B::block().data;
        let [&minimum, &maximum] = [data.minima.get(index)?, data.maxima.get(index)?];
        let settable = Settable { name: data.text(2 * index), unit: data.text(2 * index + 1), minimum, maximum };
        data.is_settable(index).then_some((settable, None))
    }

    fn is_tunable(index: usize) -> bool {
        <K::Coupling as Coupling>::Ending::IS_PRESENT && index == Parameter::EffectiveMass as usize
    }

    fn start_values() -> Self::Values {
        B::block().data.starts
    }

    #[inline(always)]
    fn parameter(parameter: Parameter, _group: usize, values: &Self::Values) -> f64 {
        match parameter {
            // known to the compiler, which then leaves out the choice
            Parameter::ImpactorYieldStrength if !K::TWO_STRENGTHS => f64::INFINITY,
            _ => values.get(parameter as usize).copied().unwrap_or(f64::NAN),
        }
    }

    fn model(pair: Pair, group: usize, values: &Self::Values) -> Self::Model {
        let surface = if B::block().data.has(Flag::Fresh) { Surface::Fresh } else { Surface::Dented };
        K::model(pair, surface, |parameter| Self::parameter(parameter, group, values))
    }

    fn density(_group: usize) -> Option<f64> {
        let density = B::block().data.density;
        (!density.is_nan()).then_some(density)
    }

    fn impact_mass() -> f64 {
        B::block().data.impact_mass
    }

    #[inline]
    fn has_input(variable: Real) -> bool {
        let data = &B::block().data;
        match variable {
            Real::ExternalAcceleration => {
                <K::Coupling as Coupling>::Acceleration::IS_PRESENT && data.has(Flag::Acceleration)
            }
            Real::EffectiveMass => <K::Coupling as Coupling>::Mass::IS_PRESENT && data.has(Flag::Mass),
            _ => false,
        }
    }

    #[inline]
    fn real(value_reference: u32) -> Option<(Real, usize)> {
        let place = Self::place(value_reference)?;
        let variable = match place.checked_sub(FIRST_PARAMETER) {
            None => K::real(place)?,
            Some(parameter) if usize::from(parameter) < Parameter::PREBUILT => Real::Parameter(parameter.into()),
            Some(_) => return None,
        };
        Some((variable, 0))
    }

    fn integer(value_reference: u32) -> Option<(Integer, usize)> {
        K::integer(Self::place(value_reference)?).map(|variable| (variable, 0))
    }
}
