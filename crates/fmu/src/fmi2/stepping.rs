//! The step, and derivatives of inputs and outputs.

use super::abi::*;
use super::component::{Component, call};
use super::order;
use super::variables::{any_real, get_any_real, real};
use crate::c::complaint::Complaint;
use crate::c::handle::{Handle, array, array_mut};
use crate::instance::{Fault, Plain};
use crate::scene::{Real, Scene};
use brinell_contact::Contact;

/// Reference of the input of the first contact.
const INPUT: fmi2ValueReference = 0;

/// Moves the contact through a step at constant indentation rate. The step is complete when the call returns.
///
/// # Safety
/// See [the module](super#safety).
#[inline(always)]
pub unsafe fn do_step<S: Scene>(
    c: fmi2Component,
    currentCommunicationPoint: fmi2Real,
    communicationStepSize: fmi2Real,
    noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
) -> fmi2Status {
    let _ = noSetFMUStatePriorToCurrentPoint;
    // SAFETY: the caller's component.
    unsafe {
        let Some(component) = Component::<S>::behind(c) else {
            return do_any_step::<S>(c, currentCommunicationPoint, communicationStepSize);
        };
        match component.instance.do_plain_step(currentCommunicationPoint, communicationStepSize) {
            Plain::Done => {
                // a single contact leaves its branch when it becomes too deep
                if S::contacts() > 1 {
                    if component.instance.is_guard_seen() {
                        component.warn_of_guard(order::DO_STEP);
                    }
                    if component.instance.is_deep() {
                        component.warn_of_limits(order::DO_STEP);
                    }
                }
                return fmi2OK;
            }
            Plain::OffBranch => {
                return do_branch_step(component, currentCommunicationPoint, communicationStepSize);
            }
            Plain::Other => {}
        }
        do_any_step::<S>(c, currentCommunicationPoint, communicationStepSize)
    }
}

/// A step of a single contact that leaves its branch and is otherwise plain.
#[inline(never)]
fn do_branch_step<S: Scene>(component: &mut Component<S>, time: f64, step: f64) -> fmi2Status {
    if component.instance.do_branch_step(time, step) && !component.instance.is_deep() {
        return fmi2OK;
    }
    let c = core::ptr::from_mut(component).cast();
    // SAFETY: a component.
    unsafe { do_any_step::<S>(c, time, step) }
}

/// All other steps, with all checks; for a step that is already done, the warnings.
///
/// # Safety
/// The caller's component.
#[cold]
#[inline(never)]
unsafe fn do_any_step<S: Scene>(c: fmi2Component, time: f64, step: f64) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, order::DO_STEP, |component| {
            if component.instance.is_deep() {
                component.warn_of_limits(order::DO_STEP);
                return Ok(());
            }
            component.instance.do_step(time, step)?;
            component.warn_of_guard(order::DO_STEP);
            component.warn_of_wiring(order::DO_STEP);
            component.warn_of_limits(order::DO_STEP);
            Ok(())
        })
    }
}

/// Rejected: no step is ever in progress.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn cancel_step<S: Scene>(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's component.
    unsafe { call::<S>(c, order::CANCEL_STEP, |_| Err(Complaint::Unsupported)) }
}

/// Sets derivatives of inputs for the next step; call it after setting the inputs. If one is rejected, none is set.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn set_real_input_derivatives<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays of the given length.
    unsafe {
        if S::contacts() == 1
            && S::has_course()
            && let Some(component) = Component::<S>::behind(c)
            && !vr.is_null()
            && !order.is_null()
            && !value.is_null()
            && component.instance.set_plain_derivatives((0..nvr).map(|index| {
                let (reference, order) = (*vr.add(index), *order.add(index));
                // other variables get order 0, which no derivative has
                (if reference == INPUT { order } else { 0 }, *value.add(index))
            }))
        {
            return fmi2OK;
        }
        set_any_input_derivatives::<S>(c, vr, nvr, order, value)
    }
}

/// Sets derivatives in all other cases, with all checks.
///
/// # Safety
/// The caller's component, and arrays of the given length.
#[cold]
#[inline(never)]
unsafe fn set_any_input_derivatives<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        call::<S>(c, order::SET_REAL_INPUT_DERIVATIVES, |component| {
            let references = array(vr, nvr, "vr")?;
            let orders = array(order, nvr, "order")?;
            let values = array(value, nvr, "value")?;
            let all = || references.iter().zip(orders).zip(values);
            for ((&reference, &order), &value) in all() {
                component.instance.check_input_derivative(any_real::<S>(reference)?, order, value)?;
            }
            // those of a single contact have already been set if they were valid, except for the tangential rate
            for ((&reference, &order), &value) in all().filter(|_| S::contacts() > 1 || S::Contact::HAS_FRICTION) {
                component.instance.set_input_derivative(any_real::<S>(reference)?, order, value);
            }
            Ok(())
        })
    }
}

/// Reads derivatives of outputs with respect to time, at the end of the last step.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_real_output_derivatives<S: Scene>(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays of the given length.
    unsafe {
        call::<S>(c, order::GET_REAL_OUTPUT_DERIVATIVES, |component| {
            let references = array(vr, nvr, "vr")?;
            let orders = array(order, nvr, "order")?;
            let values = array_mut(value, nvr, "value")?;
            for ((value, &reference), &order) in values.iter_mut().zip(references).zip(orders) {
                *value = component.instance.output_derivative(real::<S>(reference)?, order)?;
            }
            Ok(())
        })
    }
}

/// The derivative of the output `unknown` of `contact` with respect to the parameter with this `index`, in Initialization Mode: that
/// of a parabola through three values that the FMU shows.
fn by_parameter<S: Scene>(
    component: &mut Component<S>,
    unknown: fmi2ValueReference,
    contact: usize,
    index: usize,
) -> Result<f64, Fault> {
    let places = component.instance.neighbours(contact, index).ok_or(Fault::NotAnInput)?;
    let [here, first, second] = places;
    // the present value comes last, and remains
    let [second_value, first_value, value] = [second, first, here].map(|place| {
        let mut value = f64::NAN;
        if component.instance.try_parameter(contact, index, place) {
            let c = core::ptr::from_mut(component).cast();
            // SAFETY: a component, one reference and one value.
            unsafe { get_any_real::<S>(c, &raw const unknown, 1, &raw mut value) };
        }
        value
    });
    let (to_first, to_second) = (first - here, second - here);
    let (slope, other) = ((first_value - value) / to_first, (second_value - value) / to_second);
    let derivative = (slope * to_second - other * to_first) / (to_second - to_first);
    if derivative.is_finite() { Ok(derivative) } else { Err(Fault::DerivativeNotFinite) }
}

/// Derivatives of outputs in the direction `dvKnown` of the inputs, at the present time, and in Initialization Mode also of
/// parameters.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_directional_derivative<S: Scene>(
    c: fmi2Component,
    vUnknown_ref: *const fmi2ValueReference,
    nUnknown: usize,
    vKnown_ref: *const fmi2ValueReference,
    nKnown: usize,
    dvKnown: *const fmi2Real,
    dvUnknown: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's component, and arrays of the given length.
    unsafe {
        call::<S>(c, order::GET_DIRECTIONAL_DERIVATIVE, |component| {
            let unknowns = array(vUnknown_ref, nUnknown, "vUnknown_ref")?;
            let knowns = array(vKnown_ref, nKnown, "vKnown_ref")?;
            let directions = array(dvKnown, nKnown, "dvKnown")?;
            let derivatives = array_mut(dvUnknown, nUnknown, "dvUnknown")?;
            for (derivative, &unknown) in derivatives.iter_mut().zip(unknowns) {
                // the regime is also an output; a small change of the inputs does not change it
                let output = if S::integer(unknown).is_some() { None } else { Some(real::<S>(unknown)?) };
                let mut sum = 0.0;
                for (&known, &direction) in knowns.iter().zip(directions) {
                    let input = any_real::<S>(known)?;
                    component.instance.check_known(input.0)?;
                    sum += direction
                        * match (output, input.0) {
                            (Some((variable, contact)), Real::Parameter(index))
                                if variable.is_output() && !variable.is_number() =>
                            {
                                by_parameter(component, unknown, contact, index)?
                            }
                            (Some(output), _) => component.instance.derivative_by_input(output, input)?,
                            (None, _) => 0.0,
                        };
                }
                *derivative = sum;
            }
            Ok(())
        })
    }
}
