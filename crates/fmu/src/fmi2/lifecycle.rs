//! Versions, instantiation, logging, initialization, termination, reset.

use super::abi::*;
use super::category::{ALL_CATEGORIES, Category, DISCARD, WARNING, WARNINGS};
use super::component::{Component, Logger, call};
use super::order::{self, Function};
use crate::c::complaint::Complaint;
use crate::c::handle::{Handle, array};
use crate::c::memory::Memory;
use crate::c::span::Free;
use crate::c::text::{extent, is_same};
use crate::instance::Instance;
use crate::scene::Scene;
use core::ffi::c_char;

/// The platform types: those of `fmi2TypesPlatform.h`, "default".
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_types_platform() -> *const fmi2Char {
    c"default".as_ptr()
}

/// The version of the standard, "2.0".
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn get_version() -> *const fmi2Char {
    c"2.0".as_ptr()
}

/// Creates an instance. The name and the callbacks are copied; the resource location and `visible` are not used.
///
/// Returns null for a missing name, a GUID other than that of the model description, a type other than co-simulation, or
/// missing callbacks. If there is a logger, it gets a message.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn instantiate<S: Scene>(
    instanceName: fmi2String,
    fmuType: fmi2Type,
    fmuGUID: fmi2String,
    fmuResourceLocation: fmi2String,
    functions: *const fmi2CallbackFunctions,
    visible: fmi2Boolean,
    loggingOn: fmi2Boolean,
) -> fmi2Component {
    let _ = (fmuResourceLocation, visible);
    // SAFETY: the callbacks are null or valid during this call.
    let Some(callbacks) = (unsafe { functions.as_ref() }) else { return core::ptr::null_mut() };
    let logger = Logger::of(callbacks);
    // SAFETY: the caller's strings are null or null-terminated.
    let made = Memory::of(callbacks.allocateMemory, callbacks.freeMemory).and_then(|memory| unsafe {
        make::<S>(instanceName, fmuType, fmuGUID, logger, memory, loggingOn != fmi2False)
    });
    match made {
        Ok(component) => component,
        Err(complaint) => {
            let name = if instanceName.is_null() { c"".as_ptr() } else { instanceName };
            // SAFETY: the name is null-terminated.
            unsafe { logger.log::<S>(name, "Instantiate", &complaint) };
            core::ptr::null_mut()
        }
    }
}

/// # Safety
/// `name` and `guid` are null or null-terminated.
unsafe fn make<S: Scene>(
    name: fmi2String,
    kind: fmi2Type,
    guid: fmi2String,
    logger: Logger,
    memory: Memory,
    logging_on: bool,
) -> Result<fmi2Component, Complaint> {
    S::verify().map_err(|reason| Complaint::BadInstance { reason })?;
    if name.is_null() || guid.is_null() {
        return Err(Complaint::NullPointer { argument: if name.is_null() { "instanceName" } else { "fmuGUID" } });
    }
    // SAFETY: neither is null, and both are null-terminated.
    let ((length, says_something), fits) = unsafe { (extent(name), is_same(guid, S::guid())) };
    if !says_something {
        return Err(Complaint::BadInstance { reason: "instanceName is empty" });
    }
    if kind != fmi2CoSimulation {
        return Err(Complaint::BadInstance {
            reason: "fmuType must be fmi2CoSimulation: this FMU has no model exchange",
        });
    }
    if !fits {
        return Err(Complaint::BadInstance {
            reason: "fmuGUID is not the one of this library: modelDescription.xml and binary are from different exports",
        });
    }
    let outside = Instance::<S>::outside_with_models();
    let made = memory.allocate(size_of::<Component<S>>() + outside + length);
    if made.is_null() {
        return Err(Complaint::NoMemory);
    }
    let _ = Component::<S>::ZEROS;
    // SAFETY: the memory is large enough for the component, its arrays and the name after it, and aligned for any object. It is zeroed, and
    // zeros are a valid component, as `ZEROS` proves.
    unsafe {
        let component = Component::<S>::pointer(made);
        let copy = component.add(1).cast::<c_char>().add(outside);
        let mut place = 0;
        // the terminating 0 is already there
        while *name.add(place) != 0 {
            *copy.add(place) = *name.add(place);
            place += 1;
        }
        let component = &mut *component;
        if outside > 0 {
            made.expose_provenance();
            let free = Free::behind(component, outside);
            component.instance.place(free);
        }
        component.logger = logger;
        component.memory = memory;
        component.categories = if logging_on { ALL_CATEGORIES } else { WARNINGS };
        if let Err(fault) = component.instance.reset() {
            memory.release(made);
            return Err(fault.into());
        }
    }
    Ok(made)
}

/// Frees an instance; null is ignored.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn free_instance<S: Scene>(c: fmi2Component) {
    // SAFETY: it comes from fmi2Instantiate, and the caller does not use it again.
    unsafe {
        if let Some(component) = Component::<S>::behind(c) {
            let memory = component.memory;
            memory.release(c);
        }
    }
}

/// Enables or disables logging of the named categories, or of all if none is named. Errors are always logged; warnings, unless
/// their category is named and not all are: importers switch all of them off by themselves. An unknown category is a warning.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn set_debug_logging<S: Scene>(
    c: fmi2Component,
    loggingOn: fmi2Boolean,
    nCategories: usize,
    categories: *const fmi2String,
) -> fmi2Status {
    // SAFETY: the caller's component, and as many categories as announced.
    unsafe {
        call::<S>(c, order::SET_DEBUG_LOGGING, |component| {
            let mut bits = if nCategories == 0 { ALL_CATEGORIES } else { 0 };
            let mut unknown = false;
            for &name in array(categories, nCategories, "categories")? {
                if name.is_null() {
                    return Err(Complaint::NullPointer { argument: "categories" });
                }
                let known = Category::bits(name);
                unknown |= known.is_none();
                bits |= known.unwrap_or(0);
            }
            if loggingOn != fmi2False {
                component.categories |= bits;
                // warnings that apply already are given again
                component.instance.look();
            } else {
                component.categories &= !(if bits == ALL_CATEGORIES { DISCARD } else { bits });
            }
            if unknown { Err(Complaint::UnknownCategory) } else { Ok(()) }
        })
    }
}

/// Sets start and stop time. It may be called again before initialization. The tolerance is not used: steps are exact.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn setup_experiment<S: Scene>(
    c: fmi2Component,
    toleranceDefined: fmi2Boolean,
    tolerance: fmi2Real,
    startTime: fmi2Real,
    stopTimeDefined: fmi2Boolean,
    stopTime: fmi2Real,
) -> fmi2Status {
    let _ = (toleranceDefined, tolerance);
    let stop = (stopTimeDefined != fmi2False).then_some(stopTime);
    // SAFETY: the caller's component.
    unsafe {
        call::<S>(c, order::SETUP_EXPERIMENT, |component| Ok(component.instance.set_experiment(startTime, stop)?))
    }
}

/// Begins initialization. fmi2SetupExperiment must have been called.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn enter_initialization_mode<S: Scene>(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's component.
    unsafe {
        call::<S>(c, order::ENTER_INITIALIZATION_MODE, |component| Ok(component.instance.enter_initialization()?))
    }
}

/// Ends initialization. It is rejected if the parameters do not fit together.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn exit_initialization_mode<S: Scene>(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's component.
    unsafe { call::<S>(c, order::EXIT_INITIALIZATION_MODE, |component| Ok(component.instance.exit_initialization()?)) }
}

/// Ends the simulation.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn terminate<S: Scene>(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's component.
    unsafe {
        call::<S>(c, order::TERMINATE, |component| {
            component.instance.terminate();
            Ok(())
        })
    }
}

/// A function of Model Exchange, which this FMU does not have.
///
/// # Safety
/// See [the module](super#safety).
#[inline(never)]
pub unsafe fn no_model_exchange<S: Scene>(c: fmi2Component, function: Function) -> fmi2Status {
    // SAFETY: the caller's component.
    unsafe { call::<S>(c, function, |_| Err(Complaint::Unsupported)) }
}

/// Resets the instance to its state after fmi2Instantiate. Name, callbacks and log settings do not change; warnings are given
/// again.
///
/// # Safety
/// See [the module](super#safety).
pub unsafe fn reset<S: Scene>(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's component.
    unsafe {
        call::<S>(c, order::RESET, |component| {
            if component.categories & WARNING != 0 {
                component.categories |= WARNINGS;
            }
            Ok(component.instance.reset()?)
        })
    }
}
