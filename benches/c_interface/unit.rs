//! The library of an FMU, loaded like in an importer.

use libloading::Library;
use std::ffi::{CStr, CString, c_char, c_int, c_uint, c_void};
use std::path::Path;
use std::ptr::{null, null_mut};

/// Reference of the input of the first contact.
pub const INPUT: c_uint = 0;

/// Reference of the force of an FMU with one contact.
pub const FORCE: c_uint = 1;

pub type State = *mut c_void;
pub type Status = c_int;
type Component = *mut c_void;

/// The importer's callbacks: none of the FMUs needs any.
#[repr(C)]
struct Callbacks {
    functions: [*const c_void; 4],
    environment: *mut c_void,
}

/// Function pointers, copied to a table like in an importer.
struct Functions {
    instantiate: unsafe extern "C" fn(
        *const c_char,
        c_int,
        *const c_char,
        *const c_char,
        *const Callbacks,
        c_int,
        c_int,
    ) -> Component,
    free: unsafe extern "C" fn(Component),
    setup_experiment: unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> Status,
    enter_initialization: unsafe extern "C" fn(Component) -> Status,
    exit_initialization: unsafe extern "C" fn(Component) -> Status,
    terminate: unsafe extern "C" fn(Component) -> Status,
    set_real: unsafe extern "C" fn(Component, *const c_uint, usize, *const f64) -> Status,
    get_real: unsafe extern "C" fn(Component, *const c_uint, usize, *mut f64) -> Status,
    do_step: unsafe extern "C" fn(Component, f64, f64, c_int) -> Status,
    get_state: unsafe extern "C" fn(Component, *mut State) -> Status,
    set_state: unsafe extern "C" fn(Component, State) -> Status,
    free_state: unsafe extern "C" fn(Component, *mut State) -> Status,
    // the FMUs in C have only the functions that are compared
    get_integer: Option<unsafe extern "C" fn(Component, *const c_uint, usize, *mut c_int) -> Status>,
    set_derivatives: Option<SetDerivatives>,
}

type SetDerivatives = unsafe extern "C" fn(Component, *const c_uint, usize, *const c_int, *const f64) -> Status;

impl Functions {
    fn of(library: &Library) -> Functions {
        /// # Safety
        /// `T` is the type of the function with this name.
        unsafe fn get<T: Copy>(library: &Library, name: &CStr) -> T {
            // SAFETY: guaranteed by the caller.
            unsafe { *library.get(name).unwrap_or_else(|error| panic!("{error}")) }
        }
        /// # Safety
        /// As for `get`.
        unsafe fn find<T: Copy>(library: &Library, name: &CStr) -> Option<T> {
            // SAFETY: guaranteed by the caller.
            unsafe { library.get(name).ok().map(|function| *function) }
        }
        // SAFETY: the types are those of the standard.
        unsafe {
            Functions {
                instantiate: get(library, c"fmi2Instantiate"),
                free: get(library, c"fmi2FreeInstance"),
                setup_experiment: get(library, c"fmi2SetupExperiment"),
                enter_initialization: get(library, c"fmi2EnterInitializationMode"),
                exit_initialization: get(library, c"fmi2ExitInitializationMode"),
                terminate: get(library, c"fmi2Terminate"),
                set_real: get(library, c"fmi2SetReal"),
                get_real: get(library, c"fmi2GetReal"),
                do_step: get(library, c"fmi2DoStep"),
                get_state: get(library, c"fmi2GetFMUstate"),
                set_state: get(library, c"fmi2SetFMUstate"),
                free_state: get(library, c"fmi2FreeFMUstate"),
                get_integer: find(library, c"fmi2GetInteger"),
                set_derivatives: find(library, c"fmi2SetRealInputDerivatives"),
            }
        }
    }
}

/// An FMU with an open library.
pub struct Unit {
    functions: Functions,
    guid: CString,
    _library: Library,
}

impl Unit {
    pub fn open(library: &Path, guid: &CStr) -> Unit {
        // SAFETY: the libraries built here run no code when loaded.
        let open = unsafe { Library::new(library) }.unwrap_or_else(|error| panic!("{}: {error}", library.display()));
        Unit { functions: Functions::of(&open), guid: guid.to_owned(), _library: open }
    }

    /// An instance ready for its first step.
    pub fn instance(&self) -> Instance<'_> {
        self.instance_with(&[])
    }

    /// An instance with these parameters, by reference, ready for its first step.
    pub fn instance_with(&self, parameters: &[(c_uint, f64)]) -> Instance<'_> {
        const CO_SIMULATION: c_int = 1;
        let functions = &self.functions;
        let (name, guid) = (c"bench".as_ptr(), self.guid.as_ptr());
        let callbacks = Callbacks { functions: [null(); 4], environment: null_mut() };
        // SAFETY: the strings are null-terminated, and the FMU copies the callbacks.
        let component = unsafe { (functions.instantiate)(name, CO_SIMULATION, guid, null(), &callbacks, 0, 0) };
        assert!(!component.is_null(), "no instance");
        let instance = Instance { functions, component };
        for &(reference, value) in parameters {
            ok(instance.set(reference, value));
        }
        // SAFETY: a component of this library; the calls are in the order of the standard.
        unsafe {
            ok((functions.setup_experiment)(component, 0, 0.0, 0.0, 0, 0.0));
            ok((functions.enter_initialization)(component));
            ok((functions.exit_initialization)(component));
        }
        instance
    }
}

/// An initialized instance of an FMU.
pub struct Instance<'unit> {
    functions: &'unit Functions,
    component: Component,
}

impl Instance<'_> {
    /// Sets one variable.
    pub fn set(&self, reference: c_uint, value: f64) -> Status {
        // SAFETY: the FMU's component, and arrays of one element.
        unsafe { (self.functions.set_real)(self.component, &reference, 1, &value) }
    }

    /// Reads one variable.
    pub fn get(&self, reference: c_uint, value: &mut f64) -> Status {
        // SAFETY: the FMU's component, and arrays of one element.
        unsafe { (self.functions.get_real)(self.component, &reference, 1, value) }
    }

    /// Reads one Integer variable.
    pub fn integer(&self, reference: c_uint) -> c_int {
        let get = self.functions.get_integer.expect("a unit with Integer variables");
        let mut value = -1;
        // SAFETY: the FMU's component, and arrays of one element.
        ok(unsafe { get(self.component, &reference, 1, &mut value) });
        value
    }

    /// Reads one variable that must exist.
    pub fn value(&self, reference: c_uint) -> f64 {
        let mut value = f64::NAN;
        ok(self.get(reference, &mut value));
        value
    }

    /// Sets the first two derivatives of an input.
    #[inline]
    pub fn set_derivatives(&self, reference: c_uint, derivatives: &[f64; 2]) -> Status {
        let Some(set) = self.functions.set_derivatives else { return -1 };
        // SAFETY: the FMU's component, and arrays of two elements.
        unsafe { set(self.component, [reference; 2].as_ptr(), 2, [1, 2].as_ptr(), derivatives.as_ptr()) }
    }

    /// Sets all of these variables.
    pub fn set_all(&self, references: &[c_uint], values: &[f64]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: the FMU's component, and arrays of equal length.
        unsafe { (self.functions.set_real)(self.component, references.as_ptr(), values.len(), values.as_ptr()) }
    }

    /// Reads all of these variables.
    pub fn get_all(&self, references: &[c_uint], values: &mut [f64]) -> Status {
        assert_eq!(references.len(), values.len());
        // SAFETY: the FMU's component, and arrays of equal length.
        unsafe { (self.functions.get_real)(self.component, references.as_ptr(), values.len(), values.as_mut_ptr()) }
    }

    pub fn step(&self, time: f64, step: f64) -> Status {
        // SAFETY: the FMU's component.
        unsafe { (self.functions.do_step)(self.component, time, step, 1) }
    }

    /// Saves the state over an older one, or to a new one if the pointer is null.
    pub fn save(&self, state: &mut State) -> Status {
        // SAFETY: the FMU's component, and one of its states or null.
        unsafe { (self.functions.get_state)(self.component, state) }
    }

    /// Restores a state, which may come from another instance of the FMU.
    pub fn restore(&self, state: State) -> Status {
        // SAFETY: the FMU's component and state.
        unsafe { (self.functions.set_state)(self.component, state) }
    }

    pub fn free(&self, state: &mut State) {
        // SAFETY: the FMU's component and state, which are not used afterwards.
        ok(unsafe { (self.functions.free_state)(self.component, state) });
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: the FMU's component, which is not used afterwards.
        unsafe {
            ok((self.functions.terminate)(self.component));
            (self.functions.free)(self.component);
        }
    }
}

#[track_caller]
pub fn ok(status: Status) {
    assert_eq!(status, 0, "a call was refused");
}
