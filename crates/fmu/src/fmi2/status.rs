//! The status of a step: every step is complete when its call returns.

use super::abi::*;
use super::component::{Component, call};
use super::order::{self, Function};
use crate::c::complaint::Complaint;
use crate::c::handle::Handle;
use crate::scene::Scene;
use core::ffi::c_void;

/// Checks a question for a status: fmi2OK if there is an answer, which the caller then writes to `value`.
///
/// # Safety
/// The caller's component.
#[inline(never)]
unsafe fn check<S: Scene>(c: fmi2Component, function: Function, value: *mut c_void, is_known: bool) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, function, |_| match is_known {
            _ if value.is_null() => Err(Complaint::NullPointer { argument: "value" }),
            true => Ok(()),
            false => Err(Complaint::Unavailable),
        })
    }
}

/// For fmi2DoStepStatus: fmi2OK, because every step is complete when its call returns.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Status) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe {
        let status = check::<S>(c, order::GET_STATUS, value.cast(), s == fmi2DoStepStatus);
        if status == fmi2OK {
            *value = fmi2OK;
        }
        status
    }
}

/// For fmi2LastSuccessfulTime: the end of the last step.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_real_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Real) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe {
        let status = check::<S>(c, order::GET_REAL_STATUS, value.cast(), s == fmi2LastSuccessfulTime);
        if status == fmi2OK
            && let Some(component) = Component::<S>::behind(c)
        {
            *value = component.instance.time();
        }
        status
    }
}

/// There is no status of this type.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_integer_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Integer) -> fmi2Status {
    let _ = s;
    // SAFETY: the caller's component and pointer.
    unsafe { check::<S>(c, order::GET_INTEGER_STATUS, value.cast(), false) }
}

/// For fmi2Terminated: false, because the FMU never ends the simulation itself.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_boolean_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Boolean) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe {
        let status = check::<S>(c, order::GET_BOOLEAN_STATUS, value.cast(), s == fmi2Terminated);
        if status == fmi2OK {
            *value = fmi2False;
        }
        status
    }
}

/// There is no status of this type: no step is ever pending.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_string_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2String) -> fmi2Status {
    let _ = s;
    // SAFETY: the caller's component and pointer.
    unsafe { check::<S>(c, order::GET_STRING_STATUS, value.cast(), false) }
}
