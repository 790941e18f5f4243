//! An FMU loaded like by an importer, and its instances.
#![allow(clippy::not_unsafe_ptr_arg_deref, reason = "states go from the library back to it")]

use super::unit;
use libloading::Library;
use std::cell::RefCell;
use std::collections::HashMap;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fs;
use std::path::Path;
use std::ptr::null_mut;

pub const OK: c_int = 0;
pub const ERROR: c_int = 3;

thread_local! {
    /// The last message; the logger has no other place for it.
    static MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// A logger that ignores its variable arguments: there are none after the format.
unsafe extern "C" fn logger(_: *mut c_void, _: *const c_char, _: c_int, _: *const c_char, message: *const c_char) {
    // SAFETY: messages are null-terminated
    let text = unsafe { CStr::from_ptr(message) }.to_string_lossy().into_owned();
    MESSAGE.with(|last| *last.borrow_mut() = text);
}

/// The last message in this thread; it is removed.
pub fn take_message() -> String {
    MESSAGE.take()
}

/// The importer's callbacks.
#[repr(C)]
struct Callbacks {
    logger: unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char),
    unused: [usize; 4],
}

/// A library with the value references of its variables.
pub struct Unit {
    library: Library,
    guid: CString,
    references: HashMap<String, u32>,
}

/// An instance of an FMU.
pub struct Instance<'a> {
    unit: &'a Unit,
    component: *mut c_void,
}

/// The text of an attribute; its name is unique before the next `>`.
fn attribute<'a>(element: &'a str, name: &str) -> &'a str {
    let (_, rest) = element.split_once(&format!(" {name}=\"")).expect("the attribute is there");
    rest.split('"').next().expect("text has a first part")
}

impl Unit {
    /// Exports and loads the FMU of `scene`.
    pub fn load(scene: &Path) -> Unit {
        Unit::open(&unit::export(scene))
    }

    /// Loads the FMU `fmu`.
    pub fn open(fmu: &Path) -> Unit {
        let library = unit::library(fmu);
        Unit::open_library(&library, &library)
    }

    /// Loads `library` instead of the one that was unpacked at `place`.
    pub fn open_library(library: &Path, place: &Path) -> Unit {
        let root = place.ancestors().nth(3).expect("binaries/PLATFORM/LIBRARY");
        let description = fs::read_to_string(root.join("modelDescription.xml")).expect("unpacked beside the library");
        let elements = description.split("<ScalarVariable").skip(1);
        let reference = |element| {
            let number = attribute(element, "valueReference").parse().expect("a number");
            (attribute(element, "name").to_string(), number)
        };
        Unit {
            // SAFETY: the FMU was made by the program under test, and has no initializers
            library: unsafe { Library::new(library) }.expect("a library that can be loaded"),
            guid: CString::new(attribute(&description, "guid")).expect("plain characters"),
            references: elements.map(reference).collect(),
        }
    }

    /// A function of the library.
    fn function<T: Copy>(&self, name: &str) -> T {
        // SAFETY: the callers use the types of the standard
        *unsafe { self.library.get::<T>(name) }.expect("every unit has every function")
    }

    /// A new instance.
    pub fn instantiate(&self) -> Instance<'_> {
        self.try_to_instantiate().expect("an instance")
    }

    /// A new instance, if the library creates one.
    pub fn try_to_instantiate(&self) -> Option<Instance<'_>> {
        type Instantiate = unsafe extern "C" fn(
            *const c_char,
            c_int,
            *const c_char,
            *const c_char,
            *const Callbacks,
            c_int,
            c_int,
        ) -> *mut c_void;
        let callbacks = Callbacks { logger, unused: [0; 4] };
        let instantiate = self.function::<Instantiate>("fmi2Instantiate");
        // SAFETY: null-terminated strings, and callbacks that are copied
        let component =
            unsafe { instantiate(c"test".as_ptr(), 1, self.guid.as_ptr(), c"".as_ptr(), &raw const callbacks, 0, 0) };
        (!component.is_null()).then_some(Instance { unit: self, component })
    }

    /// An instance ready for a step from 0 s.
    pub fn ready(&self) -> Instance<'_> {
        self.ready_with(&[])
    }

    /// The same with `parameters`.
    pub fn ready_with(&self, parameters: &[(&str, f64)]) -> Instance<'_> {
        let mut instance = self.instantiate();
        for (name, value) in parameters {
            instance.set_one(name, *value);
        }
        instance.initialize();
        instance
    }
}

impl Instance<'_> {
    /// Calls a function that takes only the component.
    fn call(&self, name: &str) {
        assert_eq!(self.try_call(name), OK, "{name}: {}", self.message());
    }

    /// The status of such a function.
    pub fn try_call(&self, name: &str) -> c_int {
        let function = self.unit.function::<unsafe extern "C" fn(*mut c_void) -> c_int>(name);
        // SAFETY: the component lives
        unsafe { function(self.component) }
    }

    /// The value reference of a variable.
    pub fn real_of(&self, name: &str) -> u32 {
        self.unit.references[name]
    }

    pub fn initialize(&mut self) {
        self.enter_initialization();
        self.call("fmi2ExitInitializationMode");
    }

    /// Outputs can be read from here on.
    pub fn enter_initialization(&mut self) {
        type Setup = unsafe extern "C" fn(*mut c_void, c_int, f64, f64, c_int, f64) -> c_int;
        // SAFETY: the component lives
        let status = unsafe { self.unit.function::<Setup>("fmi2SetupExperiment")(self.component, 0, 0.0, 0.0, 0, 0.0) };
        assert_eq!(status, OK);
        self.call("fmi2EnterInitializationMode");
    }

    pub fn reset(&mut self) {
        self.call("fmi2Reset");
    }

    /// The last message in this thread.
    pub fn message(&self) -> String {
        MESSAGE.with(|last| last.borrow().clone())
    }

    pub fn set(&mut self, references: &[u32], values: &[f64]) -> c_int {
        type Set = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const f64) -> c_int;
        assert_eq!(references.len(), values.len());
        let set = self.unit.function::<Set>("fmi2SetReal");
        // SAFETY: the component lives, and the arrays have the given length
        unsafe { set(self.component, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    pub fn get(&self, references: &[u32], values: &mut [f64]) -> c_int {
        type Get = unsafe extern "C" fn(*mut c_void, *const u32, usize, *mut f64) -> c_int;
        assert_eq!(references.len(), values.len());
        let get = self.unit.function::<Get>("fmi2GetReal");
        // SAFETY: as above
        unsafe { get(self.component, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }

    /// Enables all messages.
    pub fn log_everything(&mut self) {
        type Log = unsafe extern "C" fn(*mut c_void, c_int, usize, *const *const c_char) -> c_int;
        let log = self.unit.function::<Log>("fmi2SetDebugLogging");
        // SAFETY: the component lives, and no category is named
        assert_eq!(unsafe { log(self.component, 1, 0, std::ptr::null()) }, OK);
    }

    /// Sets derivatives of this order of the inputs.
    pub fn set_derivatives(&mut self, references: &[u32], order: c_int, values: &[f64]) -> c_int {
        type Set = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const c_int, *const f64) -> c_int;
        assert_eq!(references.len(), values.len());
        let orders = vec![order; references.len()];
        let set = self.unit.function::<Set>("fmi2SetRealInputDerivatives");
        // SAFETY: the component lives, and the arrays have the given length
        unsafe { set(self.component, references.as_ptr(), references.len(), orders.as_ptr(), values.as_ptr()) }
    }

    /// Reads derivatives of this order of outputs with respect to time.
    pub fn output_derivatives(&self, references: &[u32], order: c_int, values: &mut [f64]) -> c_int {
        type Get = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const c_int, *mut f64) -> c_int;
        assert_eq!(references.len(), values.len());
        let orders = vec![order; references.len()];
        let get = self.unit.function::<Get>("fmi2GetRealOutputDerivatives");
        // SAFETY: as above
        unsafe { get(self.component, references.as_ptr(), references.len(), orders.as_ptr(), values.as_mut_ptr()) }
    }

    /// Derivatives of the variables `unknown` in the direction 1 of `known`.
    pub fn directional(&self, unknown: &[u32], known: u32, values: &mut [f64]) -> c_int {
        type Get =
            unsafe extern "C" fn(*mut c_void, *const u32, usize, *const u32, usize, *const f64, *mut f64) -> c_int;
        assert_eq!(unknown.len(), values.len());
        let get = self.unit.function::<Get>("fmi2GetDirectionalDerivative");
        let (knowns, directions) = ([known], [1.0]);
        // SAFETY: as above
        unsafe {
            get(
                self.component,
                unknown.as_ptr(),
                unknown.len(),
                knowns.as_ptr(),
                1,
                directions.as_ptr(),
                values.as_mut_ptr(),
            )
        }
    }

    pub fn set_one(&mut self, name: &str, value: f64) {
        assert_eq!(self.set(&[self.unit.references[name]], &[value]), OK, "{name}: {}", self.message());
    }

    pub fn real(&self, name: &str) -> f64 {
        let mut value = [f64::NAN];
        assert_eq!(self.get(&[self.unit.references[name]], &mut value), OK, "{name}");
        value[0]
    }

    /// The status of the call `name`, which takes only the component.
    pub fn status_of(&self, name: &str) -> c_int {
        let function = self.unit.function::<unsafe extern "C" fn(*mut c_void) -> c_int>(name);
        // SAFETY: the component lives
        unsafe { function(self.component) }
    }

    pub fn integer(&self, name: &str) -> i32 {
        type Get = unsafe extern "C" fn(*mut c_void, *const u32, usize, *mut c_int) -> c_int;
        let (reference, mut value) = (self.unit.references[name], -1);
        let get = self.unit.function::<Get>("fmi2GetInteger");
        // SAFETY: as above, for one element
        assert_eq!(unsafe { get(self.component, &raw const reference, 1, &raw mut value) }, OK, "{name}");
        value
    }

    pub fn step(&mut self, time: f64, step: f64) -> c_int {
        type Step = unsafe extern "C" fn(*mut c_void, f64, f64, c_int) -> c_int;
        // SAFETY: the component lives
        unsafe { self.unit.function::<Step>("fmi2DoStep")(self.component, time, step, 1) }
    }

    /// A new state.
    pub fn save(&self) -> *mut c_void {
        type Get = unsafe extern "C" fn(*mut c_void, *mut *mut c_void) -> c_int;
        let mut state = null_mut();
        // SAFETY: the component and the pointer live
        let status = unsafe { self.unit.function::<Get>("fmi2GetFMUstate")(self.component, &raw mut state) };
        assert_eq!(status, OK);
        state
    }

    pub fn restore(&mut self, state: *mut c_void) {
        type Set = unsafe extern "C" fn(*mut c_void, *mut c_void) -> c_int;
        // SAFETY: the component and the state live
        assert_eq!(unsafe { self.unit.function::<Set>("fmi2SetFMUstate")(self.component, state) }, OK);
    }

    pub fn free(&self, mut state: *mut c_void) {
        type Free = unsafe extern "C" fn(*mut c_void, *mut *mut c_void) -> c_int;
        // SAFETY: the state is not used again
        let status = unsafe { self.unit.function::<Free>("fmi2FreeFMUstate")(self.component, &raw mut state) };
        assert_eq!((status, state), (OK, null_mut()));
    }

    pub fn serialize(&self, state: *mut c_void) -> Vec<u8> {
        type Size = unsafe extern "C" fn(*mut c_void, *mut c_void, *mut usize) -> c_int;
        type Serialize = unsafe extern "C" fn(*mut c_void, *mut c_void, *mut u8, usize) -> c_int;
        let mut size = 0;
        let (measure, write) = (
            self.unit.function::<Size>("fmi2SerializedFMUstateSize"),
            self.unit.function::<Serialize>("fmi2SerializeFMUstate"),
        );
        // SAFETY: component, state and size live
        assert_eq!(unsafe { measure(self.component, state, &raw mut size) }, OK);
        let mut bytes = vec![0; size];
        // SAFETY: the same, and the buffer has the given length
        assert_eq!(unsafe { write(self.component, state, bytes.as_mut_ptr(), size) }, OK);
        bytes
    }

    /// A new state from bytes, if they are accepted.
    pub fn deserialize(&self, bytes: &[u8]) -> Option<*mut c_void> {
        let mut state = null_mut();
        self.read(&mut state, bytes).then_some(state)
    }

    /// Creates `state` from bytes; false if they are rejected.
    pub fn deserialize_into(&self, mut state: *mut c_void, bytes: &[u8]) -> bool {
        self.read(&mut state, bytes)
    }

    fn read(&self, state: &mut *mut c_void, bytes: &[u8]) -> bool {
        type Read = unsafe extern "C" fn(*mut c_void, *const u8, usize, *mut *mut c_void) -> c_int;
        let read = self.unit.function::<Read>("fmi2DeSerializeFMUstate");
        // SAFETY: everything lives, and the bytes have the given length
        unsafe { read(self.component, bytes.as_ptr(), bytes.len(), state) == OK }
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        let free = self.unit.function::<unsafe extern "C" fn(*mut c_void)>("fmi2FreeInstance");
        // SAFETY: the component is not used again
        unsafe { free(self.component) };
    }
}
