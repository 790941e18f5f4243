//! The step, its derivatives and its status.

use super::abi::*;
use super::component::{array, array_mut, call, component, object};
use super::order::{self, Function};
use super::variables::any_real;
use crate::fault::Fault;
use crate::scene;

/// Moves the contact over a step with the indentation rate held; complete when it returns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    c: fmi2Component,
    currentCommunicationPoint: fmi2Real,
    communicationStepSize: fmi2Real,
    noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
) -> fmi2Status {
    let _ = noSetFMUStatePriorToCurrentPoint;
    // SAFETY: the caller's component.
    unsafe {
        if let Some(component) = component(c)
            && component.instance.do_plain_step(currentCommunicationPoint, communicationStepSize)
        {
            // one contact that goes too deep leaves its branch
            if scene::CONTACTS > 1 && component.instance.is_deep() {
                component.warn_of_limits(order::DO_STEP);
            }
            return fmi2OK;
        }
        do_any_step(c, currentCommunicationPoint, communicationStepSize)
    }
}

/// Every step that isn't plain, with all checks.
///
/// # Safety
/// The caller's component.
#[cold]
#[inline(never)]
unsafe fn do_any_step(c: fmi2Component, time: f64, step: f64) -> fmi2Status {
    // SAFETY: as the caller promises.
    unsafe {
        call(c, order::DO_STEP, |component| {
            component.instance.do_step(time, step)?;
            component.warn_of_guard(order::DO_STEP);
            component.warn_of_limits(order::DO_STEP);
            Ok(())
        })
    }
}

/// The answer of a function that this unit doesn't support.
///
/// # Safety
/// The caller's component.
unsafe fn unsupported(c: fmi2Component, function: Function) -> fmi2Status {
    // SAFETY: as the caller promises.
    unsafe { call(c, function, |_| Err(Fault::Unsupported)) }
}

/// Refused: no step is ever in progress.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's component.
    unsafe { unsupported(c, order::CANCEL_STEP) }
}

/// Sets derivatives of inputs for the next step, after the inputs themselves. If one is refused none is set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays as long as announced.
    unsafe {
        call(c, order::SET_REAL_INPUT_DERIVATIVES, |component| {
            let references = array(vr, nvr, "vr")?;
            let orders = array(order, nvr, "order")?;
            let values = array(value, nvr, "value")?;
            let all = || references.iter().zip(orders).zip(values);
            for ((&reference, &order), &value) in all() {
                component.instance.check_input_derivative(any_real(reference)?, order, value)?;
            }
            for ((&reference, &order), &value) in all() {
                component.instance.set_input_derivative(any_real(reference)?.1, order, value);
            }
            Ok(())
        })
    }
}

/// Reads derivatives of forces by time, at the end of the last step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays as long as announced.
    unsafe {
        call(c, order::GET_REAL_OUTPUT_DERIVATIVES, |component| {
            let references = array(vr, nvr, "vr")?;
            let orders = array(order, nvr, "order")?;
            let values = array_mut(value, nvr, "value")?;
            for ((value, &reference), &order) in values.iter_mut().zip(references).zip(orders) {
                *value = component.instance.output_derivative(any_real(reference)?, order)?;
            }
            Ok(())
        })
    }
}

/// Refused: see `providesDirectionalDerivative`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: fmi2Component,
    vUnknown_ref: *const fmi2ValueReference,
    nUnknown: usize,
    vKnown_ref: *const fmi2ValueReference,
    nKnown: usize,
    dvKnown: *const fmi2Real,
    dvUnknown: *mut fmi2Real,
) -> fmi2Status {
    let _ = (vUnknown_ref, nUnknown, vKnown_ref, nKnown, dvKnown, dvUnknown);
    // SAFETY: the caller's component.
    unsafe { unsupported(c, order::GET_DIRECTIONAL_DERIVATIVE) }
}

/// Writes `answer` for the status `kind`, if `kind` is the one that there is an answer to.
///
/// # Safety
/// The caller's component and pointer.
unsafe fn status<T: Copy>(
    c: fmi2Component,
    function: Function,
    value: *mut T,
    answer: impl FnOnce(&crate::instance::Instance) -> Option<T>,
) -> fmi2Status {
    // SAFETY: as the caller promises.
    unsafe {
        call(c, function, |component| {
            let value = object(value, "value")?;
            *value = answer(&component.instance).ok_or(Fault::Unavailable)?;
            Ok(())
        })
    }
}

/// For fmi2DoStepStatus: fmi2OK, since no step runs on after its call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Status) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe { status(c, order::GET_STATUS, value, |_| (s == fmi2DoStepStatus).then_some(fmi2OK)) }
}

/// For fmi2LastSuccessfulTime: the end of the last step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Real) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe {
        status(c, order::GET_REAL_STATUS, value, |instance| (s == fmi2LastSuccessfulTime).then_some(instance.time()))
    }
}

/// There is no status of this type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Integer,
) -> fmi2Status {
    let _ = s;
    // SAFETY: the caller's component and pointer.
    unsafe { status(c, order::GET_INTEGER_STATUS, value, |_| None) }
}

/// For fmi2Terminated: false, since the unit never wants to end by itself.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: the caller's component and pointer.
    unsafe { status(c, order::GET_BOOLEAN_STATUS, value, |_| (s == fmi2Terminated).then_some(fmi2False)) }
}

/// There is no status of this type: no step is ever pending.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2String,
) -> fmi2Status {
    let _ = s;
    // SAFETY: the caller's component and pointer.
    unsafe { status(c, order::GET_STRING_STATUS, value, |_| None) }
}
