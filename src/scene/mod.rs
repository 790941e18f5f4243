//! The scene: its contacts, their laws, what can be set, and which outputs it requests.
//!
//! A scene is a type. An [`Instance`](crate::instance::Instance) is compiled for one, so that features that the scene does not
//! request take neither memory nor time. The exporter writes [`exported::Exported`] for the scene of each FMU; a program may
//! write its own. The scene of a
//! prebuilt library, [`prebuilt::Prebuilt`], is read from memory.

pub mod coupling;
#[cfg(not(feature = "prebuilt"))]
pub mod exported;
#[cfg(feature = "prebuilt")]
pub mod kind;
pub mod prebuilt;
pub mod storage;
pub mod variable;

pub use coupling::{Coupled, Coupling};
pub use storage::{Absent, Presence, Present, Store};
pub use variable::{Integer, Parameter, Real, Settable};

use crate::contact::motion::Follow;
use crate::contact::{Contact, Pair};

/// A scene: `CONTACTS` contacts in groups of equal ones, with their parameters and variables.
///
/// Contacts are counted from 0, and so are groups. The contacts of a group follow each other. Everything that depends on
/// parameters is asked for with their present values, in the order of [`Scene::Values`].
pub trait Scene: Sized {
    /// What is in contact, and by which laws.
    type Model: Copy;
    /// What a contact remembers.
    type Contact: Contact<Self::Model>;

    /// Something of each contact: an array as long as there are contacts.
    type Contacts<T: Copy>: Store<T>;
    /// Something of each group of contacts.
    type Groups<T: Copy>: Store<T>;
    /// The values of the parameters that can be set, and maybe of others.
    type Values: Store<f64> + Copy;

    /// Whether forces are kept in memory. One contact computes its force when it is asked for, and so do those whose force
    /// follows the rate; of many the step has it at hand.
    type Forces: Presence;
    /// Whether an output shows the momentum of a step.
    type Momentum: Presence;
    /// Whether the course of the input inside of a step can be given. Contacts whose force follows the rate have none.
    type Course: Presence;
    /// Whether an output predicts the force at the end of the next step.
    type Prediction: Presence;

    /// How a scene that knows the mass works together with its master; [`Absent`] in all others.
    type Coupling: Coupling;

    /// Whether it is noticed that steps are too long for a mass like that of the scene's impact.
    type Watch: Presence;

    /// How the bodies move through a step, if the scene knows their mass.
    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = None;
    /// The passivity guard, if there is one.
    const GUARD: Option<Guard<Self>> = None;

    /// How many contacts there are.
    const CONTACTS: usize = <Self::Contacts<u8> as Store<u8>>::LENGTH;
    /// How many groups they form.
    const GROUPS: usize = <Self::Groups<u8> as Store<u8>>::LENGTH;

    /// The GUID of the model description that belongs to the scene.
    fn guid() -> &'static str;

    /// A number that no other scene has, to know saved states by.
    fn identity() -> u64;

    /// The group of a contact.
    fn group(contact: usize) -> usize;

    /// The contact behind the last one of a group.
    fn end(group: usize) -> usize;

    /// The name of a contact, and its number from 1 on if contacts of that name are counted, or else 0.
    fn contact_name(contact: usize) -> (&'static str, usize);

    /// The parameter whose value has this `index` among [`Scene::Values`], if it can be set, with its limits; and its contact, if
    /// each contact has a value of its own.
    fn settable(index: usize) -> Option<(Settable, Option<usize>)>;

    /// Whether the value with this `index` may be set between steps, too.
    fn is_tunable(_index: usize) -> bool {
        false
    }

    /// The values of the parameters before anyone sets them.
    fn start_values() -> Self::Values;

    /// The value of any parameter for the contacts of a group: set, or constant in this scene. A parameter that the scene
    /// hasn't got has the value at which it does nothing.
    fn parameter(parameter: Parameter, group: usize, values: &Self::Values) -> f64;

    /// The bodies of a group with the laws of the scene.
    fn model(pair: Pair, group: usize, values: &Self::Values) -> Self::Model;

    /// Density of the target of a group \[kg/m^3\], if it is known.
    fn density(group: usize) -> Option<f64>;

    /// Effective mass of the scene's impact \[kg\]; NaN if it names none.
    #[inline(always)]
    fn impact_mass() -> f64 {
        f64::NAN
    }

    /// Whether `variable` is an input of the scene beside the rate.
    #[inline(always)]
    fn has_input(variable: Real) -> bool {
        match variable {
            Real::ExternalAcceleration => <Self::Coupling as Coupling>::Acceleration::IS_PRESENT,
            Real::EffectiveMass => <Self::Coupling as Coupling>::Mass::IS_PRESENT,
            _ => false,
        }
    }

    /// Whether the scene can be used.
    ///
    /// # Errors
    /// Why it can't. Only a scene that is read from memory can be unusable.
    #[inline(always)]
    fn verify() -> Result<(), &'static str> {
        Ok(())
    }

    /// The Real variable with this value reference, and its contact.
    fn real(value_reference: u32) -> Option<(Real, usize)>;

    /// The Integer variable with this value reference, and its contact.
    fn integer(value_reference: u32) -> Option<(Integer, usize)>;
}

/// The passivity guard of a scene.
#[derive(Clone, Copy)]
pub struct Guard<S: Scene> {
    /// Where it acts, for the log.
    pub words: &'static str,
    /// Whether it shortens the path on which the load of a contact comes off.
    pub acts: fn(&S::Contact, &S::Model) -> bool,
}

/// The identity of a scene with this GUID: its FNV-1a hash of 64 bits.
///
/// Reference: G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, "The FNV Non-Cryptographic Hash Algorithm".
pub const fn identity_of(guid: &str) -> u64 {
    let bytes = guid.as_bytes();
    let mut hash = 0xcbf2_9ce4_8422_2325;
    let mut index = 0;
    while index < bytes.len() {
        hash = (hash ^ bytes[index] as u64).wrapping_mul(0x100_0000_01b3);
        index += 1;
    }
    hash
}
