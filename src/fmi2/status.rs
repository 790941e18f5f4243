//! The status of a step: every step is complete when its call returns.

use super::abi::*;
use super::complaint::Complaint;
use super::component::{call, object};
use super::order::{self, Function};
use crate::instance::Instance;
use crate::scene::Scene;

/// Writes the `answer` if there is one.
///
/// # Safety
/// The caller's component and pointer.
unsafe fn status<S: Scene, T: Copy>(
    c: fmi2Component,
    function: Function,
    value: *mut T,
    answer: impl FnOnce(&Instance<S>) -> Option<T>,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, function, |component| {
            let value = object(value, "value")?;
            *value = answer(&component.instance).ok_or(Complaint::Unavailable)?;
            Ok(())
        })
    }
}

/// For fmi2DoStepStatus: fmi2OK, because every step is complete when its call returns.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Status) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe { status::<S, _>(c, order::GET_STATUS, value, |_| (s == fmi2DoStepStatus).then_some(fmi2OK)) }
}

/// For fmi2LastSuccessfulTime: the end of the last step.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_real_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Real) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe {
        status::<S, _>(c, order::GET_REAL_STATUS, value, |instance| {
            (s == fmi2LastSuccessfulTime).then_some(instance.time())
        })
    }
}

/// There is no status of this type.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_integer_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Integer) -> fmi2Status {
    let _ = s;
    // SAFETY: the caller's component and pointer.
    unsafe { status::<S, _>(c, order::GET_INTEGER_STATUS, value, |_| None) }
}

/// For fmi2Terminated: false, because the FMU never ends the simulation itself.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_boolean_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Boolean) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe { status::<S, _>(c, order::GET_BOOLEAN_STATUS, value, |_| (s == fmi2Terminated).then_some(fmi2False)) }
}

/// There is no status of this type: no step is ever pending.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_string_status<S: Scene>(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2String) -> fmi2Status {
    let _ = s;
    // SAFETY: the caller's component and pointer.
    unsafe { status::<S, _>(c, order::GET_STRING_STATUS, value, |_| None) }
}
