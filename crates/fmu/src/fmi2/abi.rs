//! The types of `fmi2TypesPlatform.h` and `fmi2FunctionTypes.h`.
//!
//! Enumerations are plain integers here, because C may pass any value.

use core::ffi::{c_char, c_int, c_uint, c_void};

/// Pointer to a [`Component`](super::component::Component).
pub type fmi2Component = *mut c_void;
/// The importer's own pointer, passed back to its callbacks.
pub type fmi2ComponentEnvironment = *mut c_void;
/// Pointer to a saved state.
pub type fmi2FMUstate = *mut c_void;
/// Reference of a variable.
pub type fmi2ValueReference = c_uint;
/// `double`.
pub type fmi2Real = f64;
/// `int`.
pub type fmi2Integer = c_int;
/// `int`: 0 false, anything else true.
pub type fmi2Boolean = c_int;
/// `char`.
pub type fmi2Char = c_char;
/// A null-terminated string.
pub type fmi2String = *const fmi2Char;
/// A byte of a serialized state.
pub type fmi2Byte = c_char;
/// Outcome of a call.
pub type fmi2Status = c_int;
/// Model exchange or co-simulation.
pub type fmi2Type = c_int;
/// The kind of status that a call of fmi2GetStatus requests.
pub type fmi2StatusKind = c_int;

/// Success.
pub const fmi2OK: fmi2Status = 0;
/// The status of a message that warns; no call returns it.
pub const fmi2Warning: fmi2Status = 1;
/// Not available; the instance has not changed.
pub const fmi2Discard: fmi2Status = 2;
/// Rejected; the instance can only be read, reset, restored and freed.
pub const fmi2Error: fmi2Status = 3;

/// False.
pub const fmi2False: fmi2Boolean = 0;

/// A value of fmi2Type: co-simulation.
pub const fmi2CoSimulation: fmi2Type = 1;

/// A value of fmi2StatusKind: the status of an asynchronous step.
pub const fmi2DoStepStatus: fmi2StatusKind = 0;
/// A value of fmi2StatusKind: the end of the last successful step.
pub const fmi2LastSuccessfulTime: fmi2StatusKind = 2;
/// A value of fmi2StatusKind: whether the FMU wants to end the simulation.
pub const fmi2Terminated: fmi2StatusKind = 3;

/// What a unit for Model Exchange answers about events. No function here looks at it.
pub enum fmi2EventInfo {}

/// The importer's log function; `message` is a printf format.
pub type fmi2CallbackLogger =
    unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);

/// The importer's function to allocate memory: the number of objects, and the size of each \[bytes\]. The memory is zeroed.
pub type fmi2CallbackAllocateMemory = unsafe extern "C" fn(usize, usize) -> *mut c_void;

/// The importer's function to free memory.
pub type fmi2CallbackFreeMemory = unsafe extern "C" fn(*mut c_void);

/// The importer's callbacks. An FMU uses the logger; a standalone FMU also uses the memory functions.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fmi2CallbackFunctions {
    /// May be null.
    pub logger: Option<fmi2CallbackLogger>,
    /// Used only by standalone FMUs: see `canNotUseMemoryManagementFunctions`.
    pub allocateMemory: Option<fmi2CallbackAllocateMemory>,
    /// The same.
    pub freeMemory: Option<fmi2CallbackFreeMemory>,
    /// Not used: no step is asynchronous.
    pub stepFinished: Option<unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2Status)>,
    /// Passed to the logger.
    pub componentEnvironment: fmi2ComponentEnvironment,
}
