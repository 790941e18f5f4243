//! The scene: its contacts, their laws, its settable values and the outputs that it requests.
//!
//! A scene is a type. An [`Instance`](crate::instance::Instance) is compiled for one, so that features that the scene does not
//! request take neither memory nor time. That of a library, [`library::LibraryScene`], has its types and its data from the exporter; a
//! program may write its own.

pub mod coupling;
pub mod library;
pub mod storage;
pub mod variable;

pub use coupling::{Coupled, Coupling};
pub use storage::{Absent, Presence, Present, Store};
pub use variable::{Integer, Parameter, Real, Settable};

use brinell_contact::motion::Follow;
use brinell_contact::shared::{InverseMasses, Outcome, Refused, Work};
use brinell_contact::tangential::{Friction, FrictionalModel};
use brinell_contact::{Body, Contact, Model, OtherBody, Pair, TwoBodies};
use core::borrow::Borrow;

/// The largest number of groups whose models an instance keeps. They take a megabyte. Beyond it, contacts with parameters of their own
/// ask the construction of their pair at each change of branch.
pub const MOST_PREPARED: usize = 256;

/// A scene: contacts in groups of equal contacts, with their parameters and variables.
///
/// Contacts and groups are counted from 0. The contacts of a group are consecutive. Functions that depend on parameters get
/// their present values, in the order of [`Scene::Values`].
pub trait Scene: Sized {
    /// The type of the bodies and their laws.
    type Model: Copy;
    /// The type of the state of a contact.
    type Contact: Contact<Self::Model>;

    /// One value for each contact: an array whose length is the number of contacts.
    type Contacts<T: Copy>: Store<T>;
    /// One value for each row of contacts that share bodies: all normals, then all tangents in each direction. As many as contacts
    /// without friction.
    type Rows<T: Copy>: Store<T>;
    /// One value for each group of contacts.
    type Groups<T: Copy>: Store<T>;
    /// The values of the parameters that can be set, and possibly of others.
    type Values: Store<f64>;

    /// Whether forces are stored. With many contacts, the step stores the forces because it has them at hand. A single contact,
    /// or one whose force depends on the rate, computes its force on request.
    type Forces: Presence;
    /// Whether an output needs the momentum of a step.
    type Momentum: Presence;
    /// Whether the input may have derivatives. Contacts whose force depends on the rate have none; others may do without.
    type InputDerivatives: Presence;
    /// Whether an output predicts the force at the end of the next step.
    type Prediction: Presence;

    /// The coupling of a scene that knows the mass with its importer; [`Absent`] in all others.
    type Coupling: Coupling;

    /// Whether the scene detects steps that are too long for a mass like that of its impact.
    type Watch: Presence;

    /// Whether contacts share bodies, so that all of them move together.
    type Shared: Presence;
    /// The inverse masses of contacts that share bodies, if they are inputs: the upper triangle of the matrix, row by row.
    type InverseMasses: Store<f64>;

    /// Whether an instance keeps the models of its groups, since making one is slow.
    type Prepared: Presence;

    /// The function that moves the bodies through a step, if the scene knows their mass.
    #[inline(always)]
    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        None
    }

    /// The passivity guard, if there is one.
    #[inline(always)]
    fn guard() -> Option<Guard<Self>> {
        None
    }

    /// Whether the FMU moves the bodies.
    #[inline(always)]
    fn moves() -> bool {
        <Self::Coupling as Coupling>::Ending::IS_PRESENT
    }

    /// Whether the scene is for an importer that steps all FMUs at once.
    #[inline(always)]
    fn is_parallel() -> bool {
        <Self::Coupling as Coupling>::Account::IS_PRESENT
    }

    /// Whether the force depends on the rate at the same instant.
    #[inline(always)]
    fn follows_rate() -> bool {
        Self::Contact::FOLLOWS_RATE
    }

    /// The highest order of the time derivative of the force.
    #[inline(always)]
    fn derivatives() -> i32 {
        Self::Contact::DERIVATIVES
    }

    /// Whether the input may have derivatives.
    #[inline(always)]
    fn has_course() -> bool {
        Self::InputDerivatives::IS_PRESENT
    }

    /// Whether an output predicts the force at the end of the next step.
    #[inline(always)]
    fn predicts() -> bool {
        Self::Prediction::IS_PRESENT
    }

    /// Whether an output needs the momentum of a step.
    #[inline(always)]
    fn has_momentum() -> bool {
        Self::Momentum::IS_PRESENT
    }

    /// Whether contacts share bodies.
    #[inline(always)]
    fn is_shared() -> bool {
        Self::Shared::IS_PRESENT
    }

    /// The number of contacts.
    #[inline(always)]
    fn contacts() -> usize {
        <Self::Contacts<u8> as Store<u8>>::LENGTH
    }

    /// The number of rows.
    #[inline(always)]
    fn rows() -> usize {
        <Self::Rows<u8> as Store<u8>>::LENGTH
    }

    /// The number of groups.
    #[inline(always)]
    fn groups() -> usize {
        <Self::Groups<u8> as Store<u8>>::LENGTH
    }

    /// The number of [values](Self::Values).
    #[inline(always)]
    fn values() -> usize {
        <Self::Values as Store<f64>>::LENGTH
    }

    /// The number of inverse masses that are inputs.
    #[inline(always)]
    fn inverse_mass_inputs() -> usize {
        Self::InverseMasses::LENGTH
    }

    /// The number of forces that are stored.
    #[inline(always)]
    fn stored_forces() -> usize {
        if Self::Forces::IS_PRESENT { Self::contacts() } else { 0 }
    }

    /// The number of contacts whose momentum is computed.
    #[inline(always)]
    fn momenta() -> usize {
        if Self::has_momentum() { Self::contacts() } else { 0 }
    }

    /// The number of contacts with a course of the input.
    #[inline(always)]
    fn curves() -> usize {
        if Self::has_course() { Self::contacts() } else { 0 }
    }

    /// The number of contacts that the FMU moves.
    #[inline(always)]
    fn moved_contacts() -> usize {
        if Self::moves() { Self::contacts() } else { 0 }
    }

    /// The number of rows that the FMU moves.
    #[inline(always)]
    fn moved_rows() -> usize {
        if Self::moves() { Self::rows() } else { 0 }
    }

    /// The number of rows with an account of momentum.
    #[inline(always)]
    fn accounts() -> usize {
        if Self::is_parallel() { Self::rows() } else { 0 }
    }

    /// The number of accelerations that are inputs.
    #[inline(always)]
    fn accelerations() -> usize {
        if Self::has_input(Real::ExternalAcceleration) { Self::rows() } else { 0 }
    }

    /// The number of effective masses that are inputs.
    #[inline(always)]
    fn masses() -> usize {
        if Self::has_input(Real::EffectiveMass) { Self::contacts() } else { 0 }
    }

    /// The number of contacts whose steps are examined.
    #[inline(always)]
    fn watched() -> usize {
        if Self::Watch::IS_PRESENT { Self::contacts() } else { 0 }
    }

    /// The number of contacts that share bodies.
    #[inline(always)]
    fn shared_contacts() -> usize {
        if Self::is_shared() { Self::contacts() } else { 0 }
    }

    /// The number of rows of contacts that share bodies.
    #[inline(always)]
    fn shared_rows() -> usize {
        if Self::is_shared() { Self::rows() } else { 0 }
    }

    /// The number of groups whose models are kept: all of them, or none if they are too many.
    #[inline(always)]
    fn prepared() -> usize {
        let prepares = Self::Prepared::IS_PRESENT && Self::groups() <= MOST_PREPARED;
        if prepares { Self::groups() } else { 0 }
    }

    /// The GUID of the model description of the scene, in UTF-8.
    fn guid() -> &'static [u8];

    /// A number that identifies the scene in saved states; no other scene has it.
    fn identity() -> u64;

    /// The group of a contact.
    fn group(contact: usize) -> usize;

    /// The contact after the last one of a group.
    fn end(group: usize) -> usize;

    /// The name of a contact, with its number counted from 1 if contacts of that name are counted, otherwise 0.
    fn contact_name(contact: usize) -> (&'static [u8], usize);

    /// The parameter with this `index` among [`Scene::Values`] and its limits, if it can be set; also the contact, if each
    /// contact has its own value.
    fn settable(index: usize) -> Option<(Settable, Option<usize>)>;

    /// Whether the value with this `index` may also be set between steps.
    fn is_tunable(_index: usize) -> bool {
        false
    }

    /// Sets `values` to the initial values of the parameters.
    fn set_start_values(values: &mut Self::Values);

    /// The value of any parameter for the contacts of a group: a set value, or a constant of the scene. For a parameter that
    /// the scene does not have, it is the value without effect.
    fn parameter(parameter: Parameter, group: usize, values: &Self::Values) -> f64;

    /// Whether the [impactor yields](impactor_yields) in a group.
    #[inline(always)]
    fn impactor_yields(group: usize, values: &Self::Values) -> bool {
        impactor_yields(|parameter| Self::parameter(parameter, group, values))
    }

    /// The bodies of a group with the laws of the scene.
    fn model(pair: Pair, group: usize, values: &Self::Values) -> Self::Model;

    /// Density of the target of a group \[kg/m^3\], if it is known.
    fn density(group: usize) -> Option<f64>;

    /// The contact radius of a group \[m\] that counts as the size of the bodies, if their radii are not those of the parameters.
    #[inline(always)]
    fn size(_group: usize) -> f64 {
        f64::INFINITY
    }

    /// Effective mass of the scene's impact \[kg\]; 0 if it names none.
    #[inline(always)]
    fn impact_mass() -> f64 {
        0.0
    }

    /// The inverse effective masses of contacts that share bodies, or their start values if they are inputs: the upper triangle of the
    /// matrix, row by row \[1/kg\].
    #[inline(always)]
    fn inverse_masses() -> &'static [f64] {
        &[]
    }

    /// Moves all contacts through a step, if they share bodies: [`shared::follow`](brinell_contact::shared::follow).
    ///
    /// # Errors
    /// [`Refused`]; nothing has changed then.
    #[inline(always)]
    fn follow_together<B: Borrow<Self::Model>>(
        _contacts: &mut [Self::Contact],
        _model: impl Fn(usize) -> B,
        _masses: &InverseMasses,
        _accelerations: &[f64],
        _rates: &mut [f64],
        _work: &mut [Work<Self::Contact>],
        _step: f64,
    ) -> Result<Outcome, Refused> {
        Err(Refused::Sizes)
    }

    /// Whether `variable`, which is not the rate, is an input of the scene.
    #[inline(always)]
    fn has_input(variable: Real) -> bool {
        match variable {
            Real::EffectiveMass => <Self::Coupling as Coupling>::Mass::IS_PRESENT,
            Real::InverseMass => Self::inverse_mass_inputs() > 0,
            _ => match variable.external_acceleration() {
                Some(row) => {
                    <Self::Coupling as Coupling>::Acceleration::IS_PRESENT && row * Self::contacts() < Self::rows()
                }
                None => variable.tangential_rate().is_some_and(|direction| direction < Self::Contact::DIRECTIONS),
            },
        }
    }

    /// Whether the scene can be used.
    ///
    /// # Errors
    /// The reason why it cannot be used. Only a scene that is read from memory can be unusable.
    #[inline(always)]
    fn verify() -> Result<(), &'static str> {
        Ok(())
    }

    /// The Real variable with this value reference, and its contact.
    fn real(value_reference: u32) -> Option<(Real, usize)>;

    /// The Integer variable with this value reference, and its contact.
    fn integer(value_reference: u32) -> Option<(Integer, usize)>;
}

/// The model `normal` with friction between its bodies, and a `loss` or `()`; `value` gives the parameters of the scene.
pub fn with_friction<L, U, X>(
    normal: Model<L, U>,
    loss: X,
    value: impl Fn(Parameter) -> f64,
) -> FrictionalModel<L, U, X> {
    let body = |youngs_modulus, poissons_ratio| Body {
        radius: f64::INFINITY,
        youngs_modulus: value(youngs_modulus),
        poissons_ratio: value(poissons_ratio),
    };
    let impactor = body(Parameter::ImpactorYoungsModulus, Parameter::ImpactorPoissonsRatio);
    let target = body(Parameter::TargetYoungsModulus, Parameter::TargetPoissonsRatio);
    let coefficient = value(Parameter::FrictionCoefficient);
    let friction = Friction::between(&impactor, &target, normal.pair.modulus, coefficient);
    FrictionalModel { normal, friction, loss }
}

/// Whether the impactor is the softer body, which a [`Pair`] describes; `value` gives the parameters of the scene. Of equally strong
/// bodies it is the target.
#[inline(always)]
pub fn impactor_yields(value: impl Fn(Parameter) -> f64) -> bool {
    value(Parameter::ImpactorYieldStrength) < value(Parameter::TargetYieldStrength)
}

/// What the law `brinell` needs to know of the bodies beside their [`Pair`]; `value` gives the parameters of the scene.
#[inline(never)]
pub fn two_bodies(value: impl Fn(Parameter) -> f64 + Copy) -> TwoBodies {
    // body, yield strength and hardening modulus
    let target = (
        Body {
            radius: value(Parameter::TargetRadius),
            youngs_modulus: value(Parameter::TargetYoungsModulus),
            poissons_ratio: value(Parameter::TargetPoissonsRatio),
        },
        value(Parameter::TargetYieldStrength),
        value(Parameter::TargetHardeningModulus),
    );
    let impactor = (
        Body {
            radius: value(Parameter::ImpactorRadius),
            youngs_modulus: value(Parameter::ImpactorYoungsModulus),
            poissons_ratio: value(Parameter::ImpactorPoissonsRatio),
        },
        value(Parameter::ImpactorYieldStrength),
        value(Parameter::ImpactorHardeningModulus),
    );
    let ((soft, _, hardening_modulus), (hard, yield_strength, hardening_of_other)) =
        if impactor_yields(value) { (impactor, target) } else { (target, impactor) };
    TwoBodies {
        hardening_modulus,
        curvature: soft.curvature(&hard),
        other: OtherBody {
            modulus: hard.plane_strain_modulus(),
            poissons_ratio: hard.poissons_ratio,
            yield_strength,
            hardening_modulus: hardening_of_other,
        },
    }
}

/// A function that tells whether the passivity guard shortens the unloading path of a contact.
pub type Acts<C, M> = fn(&C, &M) -> bool;

/// The passivity guard of a scene.
#[derive(Clone, Copy)]
pub struct Guard<S: Scene> {
    /// Description of where it acts, for the log, in UTF-8.
    pub words: &'static [u8],
    /// Whether it shortens the unloading path of a contact.
    pub acts: Acts<S::Contact, S::Model>,
}

/// The identity of a scene with this GUID: its 64-bit FNV-1a hash.
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
