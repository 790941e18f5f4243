//! A scene whose data are read from memory: the scene of a prebuilt library, which the exporter fills in.
//!
//! The [`Kind`] of the library determines by types what costs in a step or in an instance. The [`block`] contains the rest: the
//! laws, the contacts, the parameters, the variables. Arrays lie behind the instance, as long as the scene needs them.

pub mod block;
pub mod kinds;

use super::variable::{Integer, Parameter, Real, Settable, Source};
use super::{Acts, Coupling, Guard, MOST_PREPARED, Presence, Present, Scene, Store};
use crate::c::span::Span;
use crate::c::words::text_of;
use block::{Block, Data, FIRST_INTEGER, Flag, List};
use brinell_contact::motion::Follow;
use brinell_contact::shared::{InverseMasses, Outcome, Refused, Work};
use brinell_contact::{Contact, Pair, Surface};
use core::borrow::Borrow;
use core::marker::PhantomData;

/// The contents of a prebuilt library; see [`Scene`] for the types.
pub trait Kind {
    /// The type of the bodies and their laws.
    type Model: Copy;
    /// The type of the state of a contact.
    type Contact: Contact<Self::Model>;
    /// One value for each contact: an array of one, or one that is as long as a scene needs.
    type Contacts<T: Copy>: Store<T>;
    /// Whether forces may be stored.
    type Forces: Presence;
    /// Whether outputs may need the momentum of a step.
    type Momentum: Presence;
    /// The coupling with an importer.
    type Coupling: Coupling;
    /// Whether steps that are too long can be detected.
    type Watch: Presence;
    /// Whether contacts may share bodies.
    type Shared: Presence;

    /// The function that moves the bodies through a step, if the library can move them.
    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        None
    }

    /// The function that tells whether the passivity guard acts, if the library can have one.
    fn guard() -> Option<Acts<Self::Contact, Self::Model>> {
        None
    }

    /// The bodies with the laws of the scene in `data`; `value` gives its parameters.
    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Self::Model;

    /// Moves all contacts that share bodies, see [`Scene::follow_together`].
    ///
    /// # Errors
    /// [`Refused`]; nothing has changed then.
    fn follow_together<T: Borrow<Self::Model>>(
        _contacts: &mut [Self::Contact],
        _model: impl Fn(usize) -> T,
        _masses: &InverseMasses,
        _accelerations: &[f64],
        _rates: &mut [f64],
        _work: &mut [Work<Self::Contact>],
        _step: f64,
    ) -> Result<Outcome, Refused> {
        Err(Refused::Sizes)
    }
}

/// What a model needs beside the parameters.
pub struct Given {
    /// The bodies.
    pub pair: Pair,
    /// The surface that a new contact meets.
    pub surface: Surface,
    /// Density of the target \[kg/m^3\]; NaN if unknown.
    pub density: f64,
}

/// The source of the data.
pub trait Memory {
    /// The block. The compiler must not know its contents.
    fn block() -> &'static Block;

    /// The same block as words.
    fn words() -> &'static [u64; Block::WORDS];

    /// A number that identifies the library; no other library has it.
    const LIBRARY: u64;
}

/// The scene of a library of kind `K` with the data from `B`.
pub struct Prebuilt<K, B>(PhantomData<(K, B)>);

impl<K: Kind, B: Memory> Prebuilt<K, B> {
    /// Whether every scene of the library has a single contact.
    const HAS_ONE: bool = <K::Contacts<u8> as Store<u8>>::LENGTH == 1;

    #[inline(always)]
    fn data() -> &'static Data {
        &B::block().data
    }

    /// The table of a group.
    fn table_of(group: usize) -> usize {
        if Self::HAS_ONE {
            return 0;
        }
        let data = Self::data();
        // contacts that may differ are groups of one
        match data.groups == data.contacts && data.tables() < data.contacts as usize {
            true => data.table_of_contact(group),
            false => group,
        }
    }

    /// The kind of the variable with this value reference, as a code, and its contact.
    #[inline(always)]
    fn kind_of(value_reference: u32) -> (Option<u8>, usize, u32) {
        let data = Self::data();
        let (kind, contact) = match Self::contacts() as u32 {
            0 | 1 => (value_reference, 0),
            contacts => (value_reference / contacts, (value_reference % contacts) as usize),
        };
        (data.codes.get(kind as usize).copied(), contact, kind)
    }
}

impl<K: Kind, B: Memory> Scene for Prebuilt<K, B> {
    type Model = K::Model;
    type Contact = K::Contact;

    type Contacts<T: Copy> = K::Contacts<T>;
    type Rows<T: Copy> = K::Contacts<T>;
    type Groups<T: Copy> = K::Contacts<T>;
    type Values = Span<f64>;

    type Forces = K::Forces;
    type Momentum = K::Momentum;
    type Course = Present;
    type Prediction = Present;
    type Coupling = K::Coupling;
    type Watch = K::Watch;
    type Shared = K::Shared;
    type InverseMasses = Span<f64>;
    type Prepared = Present;

    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        K::follow().filter(|_| Self::moves())
    }

    #[inline(always)]
    fn guard() -> Option<Guard<Self>> {
        let words = Self::data().list(List::Guard);
        if words.is_empty() { None } else { Some(Guard { words: text_of(words), acts: K::guard()? }) }
    }

    #[inline(always)]
    fn moves() -> bool {
        <K::Coupling as Coupling>::Ending::IS_PRESENT && Self::data().has(Flag::Moves)
    }

    #[inline(always)]
    fn is_parallel() -> bool {
        <K::Coupling as Coupling>::Account::IS_PRESENT && Self::data().has(Flag::Parallel)
    }

    fn follows_rate() -> bool {
        K::Contact::FOLLOWS_RATE && Self::data().has(Flag::FollowsRate)
    }

    fn derivatives() -> i32 {
        match K::Contact::FOLLOWS_RATE && !Self::data().has(Flag::FollowsRate) {
            // the indentation on a plate is not the distance of the bodies
            true => 0,
            false => K::Contact::DERIVATIVES,
        }
    }

    #[inline(always)]
    fn has_course() -> bool {
        Self::data().has(Flag::Course)
    }

    #[inline(always)]
    fn has_momentum() -> bool {
        <K::Momentum as Presence>::IS_PRESENT && Self::data().has(Flag::Momentum)
    }

    #[inline(always)]
    fn is_shared() -> bool {
        <K::Shared as Presence>::IS_PRESENT && Self::data().has(Flag::Shared)
    }

    #[inline(always)]
    fn contacts() -> usize {
        if Self::HAS_ONE { 1 } else { Self::data().contacts as usize }
    }

    #[inline(always)]
    fn rows() -> usize {
        let directions = if Self::is_shared() { K::Contact::DIRECTIONS } else { 0 };
        Self::contacts() * (1 + directions)
    }

    #[inline(always)]
    fn groups() -> usize {
        if Self::HAS_ONE { 1 } else { Self::data().groups as usize }
    }

    fn values() -> usize {
        Self::data().values as usize
    }

    fn inverse_mass_inputs() -> usize {
        match Self::data().has(Flag::InverseMassInputs) {
            true => Self::rows() * (Self::rows() + 1) / 2,
            false => 0,
        }
    }

    fn stored_forces() -> usize {
        if Self::data().has(Flag::Forces) { Self::contacts() } else { 0 }
    }

    /// Those of every law: to make one of data takes longer than a change of branch.
    fn prepared() -> usize {
        let groups = Self::groups();
        if groups <= MOST_PREPARED { groups } else { 0 }
    }

    fn watched() -> usize {
        let watches = <K::Watch as Presence>::IS_PRESENT && Self::data().impact_mass > 0.0;
        if watches { Self::contacts() } else { 0 }
    }

    fn verify() -> Result<(), &'static str> {
        B::block().check(B::words(), B::LIBRARY)
    }

    fn guid() -> &'static [u8] {
        &Self::data().guid
    }

    #[inline]
    fn identity() -> u64 {
        Self::data().identity
    }

    #[inline(always)]
    fn group(contact: usize) -> usize {
        let data = Self::data();
        match data.groups {
            _ if Self::HAS_ONE => 0,
            0 | 1 => 0,
            groups if groups == data.contacts => contact,
            _ => data.table_of_contact(contact),
        }
    }

    fn end(group: usize) -> usize {
        let data = Self::data();
        match data.groups {
            0 | 1 => data.contacts as usize,
            groups if groups == data.contacts => group + 1,
            _ => data.table(group).map_or(data.contacts, |table| table.end) as usize,
        }
    }

    fn contact_name(contact: usize) -> (&'static [u8], usize) {
        let data = Self::data();
        let index = data.table_of_contact(contact);
        let first = index.checked_sub(1).and_then(|before| data.table(before)).map_or(0, |table| table.end);
        let Some(table) = data.table(index) else { return (&[], 0) };
        (data.text(table.name), if table.is_counted { contact + 1 - first as usize } else { 0 })
    }

    fn settable(index: usize) -> Option<(Settable, Option<usize>)> {
        let data = Self::data();
        let (run, begin) = data.run(index)?;
        let (name, unit) = (data.text(run.name), data.text(run.unit));
        let settable = Settable { name, unit, minimum: run.minimum, maximum: run.maximum };
        let contact = (run.first_contact != u64::MAX).then(|| run.first_contact as usize + (index - begin));
        Some((settable, contact))
    }

    fn is_tunable(index: usize) -> bool {
        Self::data().run(index).is_some_and(|(run, _)| run.is_tunable)
    }

    fn set_start_values(values: &mut Self::Values) {
        let mut slots = values.as_mut().iter_mut();
        let mut begin = 0;
        for run in Self::data().runs() {
            let count = run.end.wrapping_sub(begin) as usize;
            slots.by_ref().take(count).for_each(|value| *value = run.start);
            begin = run.end;
        }
    }

    #[inline(always)]
    fn parameter(parameter: Parameter, group: usize, values: &Self::Values) -> f64 {
        let source = Self::data().source(parameter, || Self::table_of(group));
        Source::value(source.as_ref(), group, values.as_ref())
    }

    fn model(pair: Pair, group: usize, values: &Self::Values) -> Self::Model {
        let data = Self::data();
        let table = data.table(Self::table_of(group));
        let surface = if table.is_some_and(|table| table.is_fresh) { Surface::Fresh } else { Surface::Dented };
        let given = Given { pair, surface, density: table.map_or(f64::NAN, |table| table.density) };
        K::model(data, &given, |parameter| Self::parameter(parameter, group, values))
    }

    fn density(group: usize) -> Option<f64> {
        Self::data().table(Self::table_of(group)).map(|table| table.density).filter(|density| !density.is_nan())
    }

    fn impact_mass() -> f64 {
        Self::data().impact_mass
    }

    fn inverse_masses() -> &'static [f64] {
        Self::data().inverse_masses()
    }

    #[inline(always)]
    fn follow_together<T: Borrow<Self::Model>>(
        contacts: &mut [Self::Contact],
        model: impl Fn(usize) -> T,
        masses: &InverseMasses,
        accelerations: &[f64],
        rates: &mut [f64],
        work: &mut [Work<Self::Contact>],
        step: f64,
    ) -> Result<Outcome, Refused> {
        K::follow_together(contacts, model, masses, accelerations, rates, work, step)
    }

    #[inline]
    fn has_input(variable: Real) -> bool {
        let data = Self::data();
        match variable {
            Real::EffectiveMass => data.has(Flag::Mass),
            Real::InverseMass => data.has(Flag::InverseMassInputs),
            _ => match variable.external_acceleration() {
                Some(row) => data.has(Flag::Acceleration) && row * Self::contacts() < Self::rows(),
                None => variable.tangential_rate().is_some_and(|direction| direction < K::Contact::DIRECTIONS),
            },
        }
    }

    #[inline]
    fn real(value_reference: u32) -> Option<(Real, usize)> {
        let (code, contact, kind) = Self::kind_of(value_reference);
        let data = Self::data();
        if u64::from(kind) < data.kinds {
            return Some((Real::of_number(code?)?, contact));
        }
        let index = (value_reference as usize).checked_sub(data.kinds as usize * Self::contacts())?;
        if index < Self::values() {
            return Some((Real::Parameter(index), 0));
        }
        let place = index - Self::values();
        (place < Self::inverse_mass_inputs()).then_some((Real::InverseMass, place))
    }

    fn integer(value_reference: u32) -> Option<(Integer, usize)> {
        let (code, contact, _) = Self::kind_of(value_reference);
        Some((Integer::of_number(code?.checked_sub(FIRST_INTEGER)?)?, contact))
    }
}
