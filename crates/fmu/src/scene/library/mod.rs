//! The scene of a library: a [`Kind`] by types, and [data](block).
//!
//! The kind determines what costs in a step or in an instance, the data all else: contacts, parameters, variables, and the constants of
//! the laws. A compiled library has the laws of its scene as types, and its data as constants, so that the compiler leaves out what the
//! scene does not need. A prebuilt library has the laws as data, too, and the exporter fills all data in; its arrays lie behind the
//! instance, as long as the scene needs them.

pub mod block;
pub mod kinds;

use super::variable::{Integer, Parameter, Real, Settable, Source};
use super::{Acts, Coupling, Guard, Presence, Scene, Store};
use crate::c::words::{bytes_of, text_of};
use block::{Contents, Data, FIRST_INTEGER, Flag, List, NO_KIND, Places};
use brinell_contact::motion::Follow;
use brinell_contact::shared::{InverseMasses, Outcome, Refused, Work};
use brinell_contact::{Contact, Pair, Surface};
use core::borrow::Borrow;
use core::marker::PhantomData;

/// The laws of a library: what a contact is, and what it takes from the data.
pub trait Laws {
    /// The type of the bodies and their laws.
    type Model: Copy;
    /// The type of the state of a contact.
    type Contact: Contact<Self::Model>;

    /// The function that moves the bodies through a step, if it is not that of contacts that share them.
    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        None
    }

    /// The function that tells whether the passivity guard acts, if there can be one.
    fn guard() -> Option<Acts<Self::Contact, Self::Model>> {
        None
    }

    /// The bodies with the laws of the scene in `data`; `value` gives its parameters.
    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Self::Model;

    /// Moves all contacts that share bodies, see [`Scene::follow_together`].
    ///
    /// # Errors
    /// [`Refused`]; nothing has changed then.
    #[inline(always)]
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

/// The lengths of the arrays of an instance; see [`Scene`] for them.
pub trait Sizes {
    /// One value for each contact.
    type Contacts<T: Copy>: Store<T>;
    /// One value for each row.
    type Rows<T: Copy>: Store<T>;
    /// One value for each group.
    type Groups<T: Copy>: Store<T>;
    /// The values of parameters.
    type Values: Store<f64>;
    /// The inverse masses that are inputs.
    type InverseMasses: Store<f64>;
}

/// The contents of a library; see [`Scene`] for the types.
pub trait Kind {
    /// The laws.
    type Laws: Laws;
    /// The lengths of arrays.
    type Sizes: Sizes;
    /// Whether forces may be stored.
    type Forces: Presence;
    /// Whether outputs may need the momentum of a step.
    type Momentum: Presence;
    /// Whether the input may have derivatives.
    type InputDerivatives: Presence;
    /// Whether outputs may predict the force.
    type Prediction: Presence;
    /// The coupling with an importer.
    type Coupling: Coupling;
    /// Whether steps that are too long can be detected.
    type Watch: Presence;
    /// Whether contacts may share bodies.
    type Shared: Presence;
    /// Whether an instance keeps the models of its groups. A prebuilt library does so for every law: to make one of data takes longer than a
    /// change of branch.
    type Prepared: Presence;
}

/// What a model needs beside the parameters.
pub struct Given {
    /// The bodies.
    pub pair: Pair,
    /// The surface that a new contact meets.
    pub surface: Surface,
    /// Density of the target \[kg/m^3\]; NaN if unknown.
    pub density: f64,
    /// The numbers of a loading curve of one's own.
    pub curve: &'static [f64],
}

/// The source of the data.
pub trait Memory {
    /// The data. The compiler must not know them if they are filled in later.
    fn contents() -> Contents<'static>;

    /// The kind of variable that each code has, if the compiler knows the data: it finds the few variables of a scene among all, and
    /// leaves out the others.
    const PLACES: Option<&'static Places> = None;

    /// Whether the data can be used.
    ///
    /// # Errors
    /// A description of the defect.
    fn verify() -> Result<(), &'static str>;
}

/// The scene of a library of kind `K` with the data from `B`.
pub struct LibraryScene<K, B>(PhantomData<(K, B)>);

impl<K: Kind, B: Memory> LibraryScene<K, B> {
    /// Whether every scene of the library has a single contact.
    const HAS_ONE: bool = <<K::Sizes as Sizes>::Contacts<u8> as Store<u8>>::LENGTH == 1;

    #[inline(always)]
    fn data() -> Contents<'static> {
        B::contents()
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

    /// The code of a kind of variable.
    #[inline(always)]
    fn code(kind: u32) -> Option<u8> {
        Self::data().codes.get(kind as usize).copied()
    }

    /// The kind of the variable with this value reference, and its contact.
    #[inline(always)]
    fn kind_of(value_reference: u32) -> (u32, usize) {
        match Self::contacts() as u32 {
            0 | 1 => (value_reference, 0),
            contacts => (value_reference / contacts, (value_reference % contacts) as usize),
        }
    }
}

impl<K: Kind, B: Memory> Scene for LibraryScene<K, B> {
    type Model = <K::Laws as Laws>::Model;
    type Contact = <K::Laws as Laws>::Contact;

    type Contacts<T: Copy> = <K::Sizes as Sizes>::Contacts<T>;
    type Rows<T: Copy> = <K::Sizes as Sizes>::Rows<T>;
    type Groups<T: Copy> = <K::Sizes as Sizes>::Groups<T>;
    type Values = <K::Sizes as Sizes>::Values;

    type Forces = K::Forces;
    type Momentum = K::Momentum;
    type InputDerivatives = K::InputDerivatives;
    type Prediction = K::Prediction;
    type Coupling = K::Coupling;
    type Watch = K::Watch;
    type Shared = K::Shared;
    type InverseMasses = <K::Sizes as Sizes>::InverseMasses;
    type Prepared = K::Prepared;

    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        K::Laws::follow().filter(|_| Self::moves())
    }

    #[inline(always)]
    fn guard() -> Option<Guard<Self>> {
        let words = Self::data().list(List::Guard);
        if words.is_empty() { None } else { Some(Guard { words: text_of(words), acts: K::Laws::guard()? }) }
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
        Self::Contact::FOLLOWS_RATE && Self::data().has(Flag::FollowsRate)
    }

    fn derivatives() -> i32 {
        match Self::Contact::FOLLOWS_RATE && !Self::data().has(Flag::FollowsRate) {
            // the indentation on a plate is not the distance of the bodies
            true => 0,
            false => Self::Contact::DERIVATIVES,
        }
    }

    #[inline(always)]
    fn has_course() -> bool {
        <K::InputDerivatives as Presence>::IS_PRESENT && Self::data().has(Flag::InputDerivatives)
    }

    #[inline(always)]
    fn predicts() -> bool {
        <K::Prediction as Presence>::IS_PRESENT && Self::data().has(Flag::Predicts)
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
        let directions = if Self::is_shared() { Self::Contact::DIRECTIONS } else { 0 };
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

    fn watched() -> usize {
        let watches = <K::Watch as Presence>::IS_PRESENT && Self::data().impact_mass > 0.0;
        if watches { Self::contacts() } else { 0 }
    }

    fn verify() -> Result<(), &'static str> {
        B::verify()
    }

    fn guid() -> &'static [u8] {
        bytes_of(Self::data().list(List::Guid))
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

    #[inline(always)]
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

    #[inline(always)]
    fn set_start_values(values: &mut Self::Values) {
        let (data, values) = (Self::data(), values.as_mut());
        if data.has_single_values() {
            values.iter_mut().zip(data.runs()).for_each(|(value, run)| *value = run.start);
            return;
        }
        let mut slots = values.iter_mut();
        let mut begin = 0;
        for run in data.runs() {
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

    #[inline(always)]
    fn model(pair: Pair, group: usize, values: &Self::Values) -> Self::Model {
        let data = Self::data();
        let table = data.table(Self::table_of(group));
        let surface = if table.is_some_and(|table| table.is_fresh) { Surface::Fresh } else { Surface::Dented };
        let given =
            Given { pair, surface, density: table.map_or(f64::NAN, |table| table.density), curve: data.curve() };
        K::Laws::model(&data, &given, |parameter| Self::parameter(parameter, group, values))
    }

    fn density(group: usize) -> Option<f64> {
        Self::data().table(Self::table_of(group)).map(|table| table.density).filter(|density| !density.is_nan())
    }

    fn size(group: usize) -> f64 {
        Self::data().table(Self::table_of(group)).map_or(f64::INFINITY, |table| table.size)
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
        K::Laws::follow_together(contacts, model, masses, accelerations, rates, work, step)
    }

    #[inline]
    fn has_input(variable: Real) -> bool {
        let data = Self::data();
        match variable {
            Real::EffectiveMass => data.has(Flag::Mass),
            Real::InverseMass => data.has(Flag::InverseMassInputs),
            _ => match variable.external_acceleration() {
                Some(row) => data.has(Flag::Acceleration) && row * Self::contacts() < Self::rows(),
                None => variable.tangential_rate().is_some_and(|direction| direction < Self::Contact::DIRECTIONS),
            },
        }
    }

    #[inline]
    fn real(value_reference: u32) -> Option<(Real, usize)> {
        let (kind, contact) = Self::kind_of(value_reference);
        let data = Self::data();
        let known = match B::PLACES {
            Some(places) => Real::found(|number| is_at(places, number, kind)),
            None if u64::from(kind) < data.kinds => Real::of_number(Self::code(kind)?),
            None => None,
        };
        if let Some(real) = known {
            return Some((real, contact));
        }
        let index = (value_reference as usize).checked_sub(data.kinds as usize * Self::contacts())?;
        if index < Self::values() {
            return Some((Real::Parameter(index), 0));
        }
        let place = index - Self::values();
        (place < Self::inverse_mass_inputs()).then_some((Real::InverseMass, place))
    }

    fn integer(value_reference: u32) -> Option<(Integer, usize)> {
        let (kind, contact) = Self::kind_of(value_reference);
        let integer = match B::PLACES {
            Some(places) => Integer::found(|number| is_at(places, FIRST_INTEGER + number, kind)),
            None => Integer::of_number(Self::code(kind)?.checked_sub(FIRST_INTEGER)?),
        };
        Some((integer?, contact))
    }
}

/// Whether the variable with this `code` is of the `kind`.
#[inline(always)]
fn is_at(places: &Places, code: u8, kind: u32) -> bool {
    let place = places[usize::from(code)];
    place != NO_KIND && u32::from(place) == kind
}
