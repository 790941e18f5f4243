//! Getting and setting variables.

use super::abi::*;
use super::component::{Component, call};
use super::order::{self, Function};
use crate::c::complaint::Complaint;
use crate::c::handle::{Handle, are_given, array, array_mut};
use crate::instance::Fault;
use crate::scene::{Real, Scene};

/// [`real`], not inlined, where speed does not matter.
#[inline(never)]
pub(super) fn any_real<S: Scene>(reference: fmi2ValueReference) -> Result<(Real, usize), Complaint> {
    real::<S>(reference)
}

/// The Real variable with this reference. It is inlined so that the compiler removes the code for variables that the scene
/// lacks.
#[inline(always)]
pub(super) fn real<S: Scene>(reference: fmi2ValueReference) -> Result<(Real, usize), Complaint> {
    S::real(reference).ok_or(Complaint::UnknownReference { kind: "Real", reference })
}

/// The positions of the inputs and of the forces among the kinds of variables of a contact.
const RATE: u32 = 0;
const FORCE: u32 = 1;

/// The contact whose variable of this `kind` has this reference.
#[inline(always)]
fn contact_of<S: Scene>(kind: u32, reference: fmi2ValueReference) -> Option<usize> {
    // for a smaller reference, the difference is a very large number
    let contact = reference.wrapping_sub(kind * S::contacts() as u32) as usize;
    (contact < S::contacts()).then_some(contact)
}

/// The contact of a call for a single variable of this `kind`, if surely no pointer is null.
///
/// # Safety
/// A pointer that is not null points to `nvr` elements, or to a component.
#[inline(always)]
unsafe fn only_one<S: Scene>(
    c: fmi2Component,
    kind: u32,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Real,
) -> Option<usize> {
    if nvr != 1 || !are_given(c.addr() & vr.addr() & value.addr()) {
        return None;
    }
    // SAFETY: it is not null, and points to one reference.
    contact_of::<S>(kind, unsafe { *vr })
}

/// The first contact of consecutive contacts whose variables of this `kind` have these references.
fn run_of<S: Scene>(kind: u32, references: &[fmi2ValueReference]) -> Option<usize> {
    let &first = references.first().filter(|_| S::contacts() > 1)?;
    let mut other = false;
    for (index, &reference) in references.iter().enumerate() {
        other |= reference.wrapping_sub(first) != index as u32;
    }
    if other { None } else { contact_of::<S>(kind, first) }
}

/// Reads Real variables.
///
/// # Safety
/// See [the module](super#safety).
#[inline(always)]
pub unsafe fn get_real<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays of the given length.
    unsafe {
        if let Some(contact) = only_one::<S>(c, FORCE, vr, nvr, value)
            && let Some(force) = (*Component::<S>::pointer(c)).instance.plain_force(contact)
        {
            *value = force;
            return fmi2OK;
        }
        get_any_real::<S>(c, vr, nvr, value)
    }
}

/// Reads Real variables in all other cases, with all checks.
///
/// # Safety
/// The caller's component, and arrays of the given length.
#[inline(never)]
pub(super) unsafe fn get_any_real<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, order::GET_REAL, |component| {
            let references = array(vr, nvr, "vr")?;
            let values = array_mut(value, nvr, "value")?;
            if let Some(first) = run_of::<S>(FORCE, references)
                && component.instance.copy_plain_forces(first, values)
            {
                return Ok(());
            }
            for (value, &reference) in values.iter_mut().zip(references) {
                *value = component.instance.real(real::<S>(reference)?);
            }
            Ok(())
        })
    }
}

/// Reads Integer variables.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_integer<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays of the given length.
    unsafe {
        call::<S>(c, order::GET_INTEGER, |component| {
            let references = array(vr, nvr, "vr")?;
            let values = array_mut(value, nvr, "value")?;
            for (value, &reference) in values.iter_mut().zip(references) {
                let fault = Complaint::UnknownReference { kind: "Integer", reference };
                *value = component.instance.integer(S::integer(reference).ok_or(fault)?);
            }
            Ok(())
        })
    }
}

/// Sets Real variables: the inputs, and parameters before initialization ends. If one is rejected, none is set.
///
/// # Safety
/// See [the module](super#safety).
#[inline(always)]
pub unsafe fn set_real<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays of the given length.
    unsafe {
        if let Some(contact) = only_one::<S>(c, RATE, vr, nvr, value)
            // read as the word that it is compared as
            && (*Component::<S>::pointer(c)).instance.set_plain_rate(contact, f64::from_bits(*value.cast()))
        {
            return fmi2OK;
        }
        set_any_real::<S>(c, vr, nvr, value)
    }
}

/// Sets Real variables in all other cases, with all checks.
///
/// # Safety
/// The caller's component, and arrays of the given length.
#[inline(never)]
unsafe fn set_any_real<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, order::SET_REAL, |component| {
            let references = array(vr, nvr, "vr")?;
            let values = array(value, nvr, "value")?;
            if let Some(first) = run_of::<S>(RATE, references)
                && component.instance.set_plain_rates(first, values)
            {
                return Ok(());
            }
            for (&value, &reference) in values.iter().zip(references) {
                component.instance.check_real(real::<S>(reference)?, value)?;
            }
            let mut parameters = false;
            for (&value, &reference) in values.iter().zip(references) {
                parameters |= component.instance.set_real(any_real::<S>(reference)?, value);
            }
            if parameters {
                component.instance.parameters_are_set();
            }
            // with many contacts, checking each of them takes long
            if S::contacts() == 1 || values.iter().any(|&value| component.instance.may_be_fast(value)) {
                component.warn_of_limits(order::SET_REAL);
            }
            Ok(())
        })
    }
}

/// The result of a function for a type without variables, or with outputs only: success for an empty array, otherwise an error.
///
/// # Safety
/// The caller's component, and an array of `length` references.
unsafe fn none_of_type<S: Scene>(
    c: fmi2Component,
    function: Function,
    kind: &'static str,
    references: *const fmi2ValueReference,
    length: usize,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, function, |_| match array(references, length, "vr")?.first() {
            Some(&reference) => Err(match S::integer(reference) {
                Some(_) if kind == "Integer" => Fault::NotSettable.into(),
                _ => Complaint::UnknownReference { kind, reference },
            }),
            None => Ok(()),
        })
    }
}

/// Functions for a type without variables, or with outputs only.
macro_rules! functions_of_no_variable {
    ($($(#[$says:meta])* $function:ident = $kind:literal, $name:ident, $value:ty;)+) => {$(
        $(#[$says])*
        ///
        /// # Safety
        /// See [the module](super#safety).
        pub unsafe fn $function<S: Scene>(
            c: fmi2Component,
            vr: *const fmi2ValueReference,
            nvr: usize,
            _value: $value,
        ) -> fmi2Status {
            // SAFETY: the caller's component, and an array of the given length.
            unsafe { none_of_type::<S>(c, order::$name, $kind, vr, nvr) }
        }
    )+};
}

functions_of_no_variable! {
    /// There are no Boolean variables.
    get_boolean = "Boolean", GET_BOOLEAN, *mut fmi2Boolean;
    /// There are no String variables.
    get_string = "String", GET_STRING, *mut fmi2String;
    /// No Integer variable can be set: they are outputs.
    set_integer = "Integer", SET_INTEGER, *const fmi2Integer;
    /// There are no Boolean variables.
    set_boolean = "Boolean", SET_BOOLEAN, *const fmi2Boolean;
    /// There are no String variables.
    set_string = "String", SET_STRING, *const fmi2String;
}
