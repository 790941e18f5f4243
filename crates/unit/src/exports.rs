//! The C functions of the scene that this library is built for.
//!
//! Each function is written out. cbindgen, which proves the signatures against the official headers, does not expand macros,
//! and plain functions are easier to read.

use brinell_fmu::fmi2::abi::*;
use brinell_fmu::fmi2::order::Function;
use brinell_fmu::fmi2::{lifecycle, states, status, stepping, variables};

#[cfg(feature = "prebuilt")]
use crate::block::Exported;
#[cfg(not(feature = "prebuilt"))]
use crate::known::Exported;

/// The platform types: those of `fmi2TypesPlatform.h`, "default".
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetTypesPlatform() -> *const fmi2Char {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::get_types_platform() }
}

/// The version of the standard, "2.0".
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetVersion() -> *const fmi2Char {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::get_version() }
}

/// Creates an instance. The name and the callbacks are copied; the resource location and `visible` are not used.
///
/// Returns null for a missing name, a GUID other than that of the model description, a type other than co-simulation, or
/// missing callbacks. If there is a logger, it gets a message.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instanceName: fmi2String,
    fmuType: fmi2Type,
    fmuGUID: fmi2String,
    fmuResourceLocation: fmi2String,
    functions: *const fmi2CallbackFunctions,
    visible: fmi2Boolean,
    loggingOn: fmi2Boolean,
) -> fmi2Component {
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::instantiate::<Exported>(
            instanceName,
            fmuType,
            fmuGUID,
            fmuResourceLocation,
            functions,
            visible,
            loggingOn,
        )
    }
}

/// Frees an instance; null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: fmi2Component) {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::free_instance::<Exported>(c) }
}

/// Enables or disables logging of the named categories, or of all if none is named. Errors are always logged, and warnings unless
/// their category is switched off by its name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: fmi2Component,
    loggingOn: fmi2Boolean,
    nCategories: usize,
    categories: *const fmi2String,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::set_debug_logging::<Exported>(c, loggingOn, nCategories, categories) }
}

/// Sets start and stop time. It may be called again before initialization. The tolerance is not used: steps are exact.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: fmi2Component,
    toleranceDefined: fmi2Boolean,
    tolerance: fmi2Real,
    startTime: fmi2Real,
    stopTimeDefined: fmi2Boolean,
    stopTime: fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::setup_experiment::<Exported>(c, toleranceDefined, tolerance, startTime, stopTimeDefined, stopTime)
    }
}

/// Begins initialization. fmi2SetupExperiment must have been called.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::enter_initialization_mode::<Exported>(c) }
}

/// Ends initialization. It is rejected if the parameters do not fit together.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::exit_initialization_mode::<Exported>(c) }
}

/// Ends the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(c: fmi2Component) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::terminate::<Exported>(c) }
}

/// Resets the instance to its state after fmi2Instantiate. Name, callbacks and log settings do not change; warnings are given
/// again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(c: fmi2Component) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::reset::<Exported>(c) }
}

/// Reads Real variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::get_real::<Exported>(c, vr, nvr, value) }
}

/// Reads Integer variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::get_integer::<Exported>(c, vr, nvr, value) }
}

/// Sets Real variables: the inputs, and parameters before initialization ends. If one is rejected, none is set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::set_real::<Exported>(c, vr, nvr, value) }
}

/// There are no Boolean variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::get_boolean::<Exported>(c, vr, nvr, value) }
}

/// There are no String variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2String,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::get_string::<Exported>(c, vr, nvr, value) }
}

/// No Integer variable can be set: all are outputs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Integer,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::set_integer::<Exported>(c, vr, nvr, value) }
}

/// There are no Boolean variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Boolean,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::set_boolean::<Exported>(c, vr, nvr, value) }
}

/// There are no String variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2String,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { variables::set_string::<Exported>(c, vr, nvr, value) }
}

/// Moves the contact through a step at constant indentation rate. The step is complete when the call returns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    c: fmi2Component,
    currentCommunicationPoint: fmi2Real,
    communicationStepSize: fmi2Real,
    noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        stepping::do_step::<Exported>(
            c,
            currentCommunicationPoint,
            communicationStepSize,
            noSetFMUStatePriorToCurrentPoint,
        )
    }
}

/// Rejected: no step is ever in progress.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: fmi2Component) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { stepping::cancel_step::<Exported>(c) }
}

/// Sets derivatives of inputs for the next step; call it after setting the inputs. If one is rejected, none is set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { stepping::set_real_input_derivatives::<Exported>(c, vr, nvr, order, value) }
}

/// Reads derivatives of outputs with respect to time, at the end of the last step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { stepping::get_real_output_derivatives::<Exported>(c, vr, nvr, order, value) }
}

/// Derivatives of outputs in the direction `dvKnown` of the inputs, at the present time.
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
    // SAFETY: guaranteed by the caller.
    unsafe {
        stepping::get_directional_derivative::<Exported>(
            c,
            vUnknown_ref,
            nUnknown,
            vKnown_ref,
            nKnown,
            dvKnown,
            dvUnknown,
        )
    }
}

/// For fmi2DoStepStatus: fmi2OK, because every step is complete when its call returns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Status) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { status::get_status::<Exported>(c, s, value) }
}

/// For fmi2LastSuccessfulTime: the end of the last step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Real) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { status::get_real_status::<Exported>(c, s, value) }
}

/// There is no status of this type.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { status::get_integer_status::<Exported>(c, s, value) }
}

/// For fmi2Terminated: false, because the FMU never ends the simulation itself.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { status::get_boolean_status::<Exported>(c, s, value) }
}

/// There is no status of this type: no step is ever pending.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2String,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { status::get_string_status::<Exported>(c, s, value) }
}

/// Copies the instance to a state. Memory is allocated only if `FMUstate` points to null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { states::get_fmu_state::<Exported>(c, FMUstate) }
}

/// Resets the instance to the saved state, including parameters and phase.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: fmi2Component, FMUstate: fmi2FMUstate) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { states::set_fmu_state::<Exported>(c, FMUstate) }
}

/// Frees a state and sets the pointer to null. Null and a pointer to null are ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { states::free_fmu_state::<Exported>(c, FMUstate) }
}

/// The length of a serialized state \[bytes\]. It is the same for every state of this FMU.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    size: *mut usize,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { states::serialized_fmu_state_size::<Exported>(c, FMUstate, size) }
}

/// Writes a state as bytes that another instance or another process can read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    serializedState: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { states::serialize_fmu_state::<Exported>(c, FMUstate, serializedState, size) }
}

/// Creates a new state from bytes. If they are rejected, `FMUstate` does not change.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: fmi2Component,
    serializedState: *const fmi2Byte,
    size: usize,
    FMUstate: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { states::deserialize_fmu_state::<Exported>(c, serializedState, size, FMUstate) }
}

// The functions of Model Exchange: some loaders ask for all symbols of the standard. Every call is rejected.

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::no_model_exchange::<Exported>(c, const { Function::of_model_exchange("fmi2EnterEventMode") }) }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(c: fmi2Component, fmi2eventInfo: *mut fmi2EventInfo) -> fmi2Status {
    let _ = fmi2eventInfo;
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::no_model_exchange::<Exported>(c, const { Function::of_model_exchange("fmi2NewDiscreteStates") })
    }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterContinuousTimeMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::no_model_exchange::<Exported>(
            c,
            const { Function::of_model_exchange("fmi2EnterContinuousTimeMode") },
        )
    }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    c: fmi2Component,
    noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
    enterEventMode: *mut fmi2Boolean,
    terminateSimulation: *mut fmi2Boolean,
) -> fmi2Status {
    let _ = (noSetFMUStatePriorToCurrentPoint, enterEventMode, terminateSimulation);
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::no_model_exchange::<Exported>(
            c,
            const { Function::of_model_exchange("fmi2CompletedIntegratorStep") },
        )
    }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(c: fmi2Component, time: fmi2Real) -> fmi2Status {
    let _ = time;
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::no_model_exchange::<Exported>(c, const { Function::of_model_exchange("fmi2SetTime") }) }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(c: fmi2Component, x: *const fmi2Real, nx: usize) -> fmi2Status {
    let _ = (x, nx);
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::no_model_exchange::<Exported>(c, const { Function::of_model_exchange("fmi2SetContinuousStates") })
    }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(c: fmi2Component, derivatives: *mut fmi2Real, nx: usize) -> fmi2Status {
    let _ = (derivatives, nx);
    // SAFETY: guaranteed by the caller.
    unsafe { lifecycle::no_model_exchange::<Exported>(c, const { Function::of_model_exchange("fmi2GetDerivatives") }) }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetEventIndicators(
    c: fmi2Component,
    eventIndicators: *mut fmi2Real,
    ni: usize,
) -> fmi2Status {
    let _ = (eventIndicators, ni);
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::no_model_exchange::<Exported>(c, const { Function::of_model_exchange("fmi2GetEventIndicators") })
    }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(c: fmi2Component, x: *mut fmi2Real, nx: usize) -> fmi2Status {
    let _ = (x, nx);
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::no_model_exchange::<Exported>(c, const { Function::of_model_exchange("fmi2GetContinuousStates") })
    }
}

/// Rejected: there is no Model Exchange.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    c: fmi2Component,
    x_nominal: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    let _ = (x_nominal, nx);
    // SAFETY: guaranteed by the caller.
    unsafe {
        lifecycle::no_model_exchange::<Exported>(
            c,
            const { Function::of_model_exchange("fmi2GetNominalsOfContinuousStates") },
        )
    }
}
