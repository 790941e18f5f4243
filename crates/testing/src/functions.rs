//! The C functions of a library, with the types of the standard.

use brinell_fmu::fmi2::abi::*;
use libloading::Library;
use std::ffi::{c_char, c_int, c_void};
use std::path::Path;

/// Declares the table: the names of the functions are those of the standard without `fmi2`, in snake case.
macro_rules! functions {
    ($($field:ident = $name:literal ($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// All functions of FMI 2.0.
        pub struct Functions {
            $(pub $field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
            // keeps the functions valid
            _library: Library,
        }

        impl Functions {
            /// The functions of the library at `path`.
            pub fn load(path: &Path) -> Functions {
                // SAFETY: it was made by the program under test, and has no initializers
                let library = unsafe { Library::new(path) }.expect("a library that can be loaded");
                Functions {
                    // SAFETY: these are the types of the standard
                    $($field: *unsafe { library.get($name.as_bytes()) }.expect("every FMU has every function"),)*
                    _library: library,
                }
            }
        }
    };
}

type References = *const fmi2ValueReference;

functions! {
    get_types_platform = "fmi2GetTypesPlatform" () -> *const fmi2Char;
    get_version = "fmi2GetVersion" () -> *const fmi2Char;
    instantiate = "fmi2Instantiate" (
        fmi2String, fmi2Type, fmi2String, fmi2String, *const fmi2CallbackFunctions, fmi2Boolean, fmi2Boolean
    ) -> fmi2Component;
    free_instance = "fmi2FreeInstance" (fmi2Component);
    set_debug_logging = "fmi2SetDebugLogging" (fmi2Component, fmi2Boolean, usize, *const fmi2String) -> fmi2Status;
    setup_experiment = "fmi2SetupExperiment" (
        fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real
    ) -> fmi2Status;
    enter_initialization_mode = "fmi2EnterInitializationMode" (fmi2Component) -> fmi2Status;
    exit_initialization_mode = "fmi2ExitInitializationMode" (fmi2Component) -> fmi2Status;
    terminate = "fmi2Terminate" (fmi2Component) -> fmi2Status;
    reset = "fmi2Reset" (fmi2Component) -> fmi2Status;
    cancel_step = "fmi2CancelStep" (fmi2Component) -> fmi2Status;
    get_real = "fmi2GetReal" (fmi2Component, References, usize, *mut fmi2Real) -> fmi2Status;
    get_integer = "fmi2GetInteger" (fmi2Component, References, usize, *mut fmi2Integer) -> fmi2Status;
    get_boolean = "fmi2GetBoolean" (fmi2Component, References, usize, *mut fmi2Boolean) -> fmi2Status;
    get_string = "fmi2GetString" (fmi2Component, References, usize, *mut fmi2String) -> fmi2Status;
    set_real = "fmi2SetReal" (fmi2Component, References, usize, *const fmi2Real) -> fmi2Status;
    set_integer = "fmi2SetInteger" (fmi2Component, References, usize, *const fmi2Integer) -> fmi2Status;
    set_boolean = "fmi2SetBoolean" (fmi2Component, References, usize, *const fmi2Boolean) -> fmi2Status;
    set_string = "fmi2SetString" (fmi2Component, References, usize, *const fmi2String) -> fmi2Status;
    do_step = "fmi2DoStep" (fmi2Component, fmi2Real, fmi2Real, fmi2Boolean) -> fmi2Status;
    set_real_input_derivatives = "fmi2SetRealInputDerivatives" (
        fmi2Component, References, usize, *const fmi2Integer, *const fmi2Real
    ) -> fmi2Status;
    get_real_output_derivatives = "fmi2GetRealOutputDerivatives" (
        fmi2Component, References, usize, *const fmi2Integer, *mut fmi2Real
    ) -> fmi2Status;
    get_directional_derivative = "fmi2GetDirectionalDerivative" (
        fmi2Component, References, usize, References, usize, *const fmi2Real, *mut fmi2Real
    ) -> fmi2Status;
    get_fmu_state = "fmi2GetFMUstate" (fmi2Component, *mut fmi2FMUstate) -> fmi2Status;
    set_fmu_state = "fmi2SetFMUstate" (fmi2Component, fmi2FMUstate) -> fmi2Status;
    free_fmu_state = "fmi2FreeFMUstate" (fmi2Component, *mut fmi2FMUstate) -> fmi2Status;
    serialized_fmu_state_size = "fmi2SerializedFMUstateSize" (fmi2Component, fmi2FMUstate, *mut usize) -> fmi2Status;
    serialize_fmu_state = "fmi2SerializeFMUstate" (fmi2Component, fmi2FMUstate, *mut fmi2Byte, usize) -> fmi2Status;
    deserialize_fmu_state = "fmi2DeSerializeFMUstate" (
        fmi2Component, *const fmi2Byte, usize, *mut fmi2FMUstate
    ) -> fmi2Status;
    get_status = "fmi2GetStatus" (fmi2Component, fmi2StatusKind, *mut fmi2Status) -> fmi2Status;
    get_real_status = "fmi2GetRealStatus" (fmi2Component, fmi2StatusKind, *mut fmi2Real) -> fmi2Status;
    get_integer_status = "fmi2GetIntegerStatus" (fmi2Component, fmi2StatusKind, *mut fmi2Integer) -> fmi2Status;
    get_boolean_status = "fmi2GetBooleanStatus" (fmi2Component, fmi2StatusKind, *mut fmi2Boolean) -> fmi2Status;
    get_string_status = "fmi2GetStringStatus" (fmi2Component, fmi2StatusKind, *mut fmi2String) -> fmi2Status;
    enter_event_mode = "fmi2EnterEventMode" (fmi2Component) -> fmi2Status;
    new_discrete_states = "fmi2NewDiscreteStates" (fmi2Component, *mut fmi2EventInfo) -> fmi2Status;
    enter_continuous_time_mode = "fmi2EnterContinuousTimeMode" (fmi2Component) -> fmi2Status;
    completed_integrator_step = "fmi2CompletedIntegratorStep" (
        fmi2Component, fmi2Boolean, *mut fmi2Boolean, *mut fmi2Boolean
    ) -> fmi2Status;
    set_time = "fmi2SetTime" (fmi2Component, fmi2Real) -> fmi2Status;
    set_continuous_states = "fmi2SetContinuousStates" (fmi2Component, *const fmi2Real, usize) -> fmi2Status;
    get_derivatives = "fmi2GetDerivatives" (fmi2Component, *mut fmi2Real, usize) -> fmi2Status;
    get_event_indicators = "fmi2GetEventIndicators" (fmi2Component, *mut fmi2Real, usize) -> fmi2Status;
    get_continuous_states = "fmi2GetContinuousStates" (fmi2Component, *mut fmi2Real, usize) -> fmi2Status;
    get_nominals_of_continuous_states = "fmi2GetNominalsOfContinuousStates" (
        fmi2Component, *mut fmi2Real, usize
    ) -> fmi2Status;
}

unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
}

unsafe extern "C" fn no_allocation(_: usize, _: usize) -> *mut c_void {
    panic!("the FMU says that it doesn't use the memory of its importer");
}

unsafe extern "C" fn no_release(_: *mut c_void) {
    panic!("the FMU says that it doesn't use the memory of its importer");
}

/// The memory functions of an importer: for an FMU that says that it uses none, ones that must not be called.
pub fn memory(needs_none: bool) -> (Option<fmi2CallbackAllocateMemory>, Option<fmi2CallbackFreeMemory>) {
    if needs_none { (Some(no_allocation), Some(no_release)) } else { (Some(calloc), Some(free)) }
}

/// A logger with the type of the standard; it ignores further arguments.
pub fn variadic(
    function: unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char),
) -> fmi2CallbackLogger {
    // SAFETY: on the tested platforms, a function without further arguments has the same calling convention
    unsafe { std::mem::transmute(function) }
}
