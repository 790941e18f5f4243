//! A scene whose data are read from memory: the scene of a prebuilt library, which the exporter fills in.
//!
//! The [`Kind`] of the library says by types what there is of it in the binary: the laws, and what can be shown. The
//! [`block`] says the rest. A scene of one contact fits into it that asks for no more than the kind has.

pub mod block;

use super::variable::{Integer, Parameter, Real, Settable};
use super::{Coupling, Presence, Scene};
use crate::contact::motion::Follow;
use crate::contact::{Contact, Pair, Surface};
use block::{Block, FIRST_PARAMETER, Flag};
use core::marker::PhantomData;

/// What a prebuilt library has in it; see [`Scene`] for the types.
pub trait Kind {
    /// What is in contact, and by which laws.
    type Model: Copy;
    /// What a contact remembers.
    type Contact: Contact<Self::Model>;
    /// Whether outputs can show the momentum of a step.
    type Momentum: Presence;
    /// Whether the course of the input inside of a step can be given.
    type Course: Presence;
    /// Whether an output can predict the force at the end of the next step.
    type Prediction: Presence;
    /// How the library works together with a master; inputs beside the rate are there if a scene asks for them.
    type Coupling: Coupling;
    /// Whether it can be noticed that steps are too long.
    type Watch: Presence;

    /// How the bodies move through a step, if the library moves them.
    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = None;
    /// A number that no other library has.
    const LIBRARY: u64;

    /// The bodies with the laws of the library, and with what else a `value` of a scene decides.
    fn model(pair: Pair, surface: Surface, value: impl Fn(Parameter) -> f64) -> Self::Model;

    /// The Real variable with this place in the table of variables, if the library has it.
    fn real(place: u8) -> Option<Real>;

    /// The Integer variable with this place, if the library has it.
    fn integer(place: u8) -> Option<Integer>;
}

/// Where the data are.
pub trait Source {
    /// The block. Of what is in it the compiler knows nothing.
    fn block() -> &'static Block;

    /// The same as words.
    fn words() -> &'static [u64; Block::WORDS];
}

/// The scene of a library of the kind `K` with the data from `B`.
pub struct Prebuilt<K, B>(PhantomData<(K, B)>);

impl<K: Kind, B: Source> Prebuilt<K, B> {
    /// What this value reference means: a place in the table of variables, or a parameter.
    #[inline]
    fn place(value_reference: u32) -> Option<u8> {
        B::block().data.variables.get(value_reference as usize).copied()
    }
}

impl<K: Kind, B: Source> Scene for Prebuilt<K, B> {
    type Model = K::Model;
    type Contact = K::Contact;

    type Contacts<T: Copy> = [T; 1];
    type Groups<T: Copy> = [T; 1];
    type Values = [f64; Parameter::COUNT];

    type Forces = super::Absent;
    type Momentum = K::Momentum;
    type Course = K::Course;
    type Prediction = K::Prediction;
    type Coupling = K::Coupling;
    type Watch = K::Watch;

    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = K::FOLLOW;

    fn verify() -> Result<(), &'static str> {
        B::block().check(B::words(), K::LIBRARY)
    }

    fn guid() -> &'static str {
        B::block().data.guid()
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
        values.get(parameter as usize).copied().unwrap_or(f64::NAN)
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
            Some(parameter) if usize::from(parameter) < Parameter::COUNT => Real::Parameter(parameter.into()),
            Some(_) => return None,
        };
        Some((variable, 0))
    }

    fn integer(value_reference: u32) -> Option<(Integer, usize)> {
        K::integer(Self::place(value_reference)?).map(|variable| (variable, 0))
    }
}
