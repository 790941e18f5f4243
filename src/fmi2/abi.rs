//! The types of `fmi2TypesPlatform.h` and `fmi2FunctionTypes.h`.
//!
//! Enumerations are plain integers here, since C may pass any value.

use core::ffi::{c_char, c_int, c_uint, c_void};

/// Pointer to a [`Component`](super::component::Component).
pub type fmi2Component = *mut c_void;
/// The importer's own pointer, handed back to its callbacks.
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
/// A string that ends with 0.
pub type fmi2String = *const fmi2Char;
/// A byte of a serialized state.
pub type fmi2Byte = c_char;
/// Outcome of a call.
pub type fmi2Status = c_int;
/// Model exchange or co-simulation.
pub type fmi2Type = c_int;
/// What fmi2GetStatus asks for.
pub type fmi2StatusKind = c_int;

/// Done.
pub const fmi2OK: fmi2Status = 0;
/// Not available; the instance is as it was.
pub const fmi2Discard: fmi2Status = 2;
/// Refused; the instance can be read, reset, restored and freed.
pub const fmi2Error: fmi2Status = 3;

/// False.
pub const fmi2False: fmi2Boolean = 0;

/// Of fmi2Type: co-simulation.
pub const fmi2CoSimulation: fmi2Type = 1;

/// Of fmi2StatusKind: the status of a step that runs on.
pub const fmi2DoStepStatus: fmi2StatusKind = 0;
/// Of fmi2StatusKind: the time up to which the last step came.
pub const fmi2LastSuccessfulTime: fmi2StatusKind = 2;
/// Of fmi2StatusKind: whether the unit wants to end.
pub const fmi2Terminated: fmi2StatusKind = 3;

/// The importer's log function; `message` is a format of printf.
pub type fmi2CallbackLogger =
    unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);

/// The importer's function for memory: as many objects as the first argument says, of the size of the second \[bytes\], all
/// zeros.
pub type fmi2CallbackAllocateMemory = unsafe extern "C" fn(usize, usize) -> *mut c_void;

/// The importer's function that takes memory back.
pub type fmi2CallbackFreeMemory = unsafe extern "C" fn(*mut c_void);

/// The importer's functions. A unit uses the logger, and its memory if it is standalone.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fmi2CallbackFunctions {
    /// May be null.
    pub logger: Option<fmi2CallbackLogger>,
    /// Used by standalone units only: see `canNotUseMemoryManagementFunctions`.
    pub allocateMemory: Option<fmi2CallbackAllocateMemory>,
    /// The same.
    pub freeMemory: Option<fmi2CallbackFreeMemory>,
    /// Not used: no step runs on after its call.
    pub stepFinished: Option<unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2Status)>,
    /// Handed to the logger.
    pub componentEnvironment: fmi2ComponentEnvironment,
}
