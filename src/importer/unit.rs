//! An FMU library behind its C interface.
//!
//! It uses `unsafe` like any importer: it relies on the library to have the standard's signatures, which is what `check` tests.

use super::error::ImportError;
use std::collections::HashMap;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;

/// A loaded library.
pub struct Unit {
    library: libloading::Library,
    guid: CString,
    /// Location of its resources.
    resources: CString,
}

type Component = *mut c_void;
type Logger = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);

#[repr(C)]
struct Callbacks {
    logger: Logger,
    allocate: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    free: Option<unsafe extern "C" fn(*mut c_void)>,
    step_finished: *const c_void,
    environment: *mut c_void,
}

// The functions that an FMU written in C may get from its importer.
unsafe extern "C" {
    fn calloc(count: usize, size: usize) -> *mut c_void;
    fn free(memory: *mut c_void);
}

/// A path as a URI: `file:///tmp/a%20b`.
fn address(path: &Path) -> String {
    let path = path.to_string_lossy().replace('\\', "/");
    let byte = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b':' | b'-' | b'.' | b'_' | b'~' => {
            char::from(byte).to_string()
        }
        other => format!("%{other:02X}"),
    };
    format!("file:///{}", path.trim_start_matches('/').bytes().map(byte).collect::<String>())
}

/// The category of warnings.
const WARNING: &CStr = c"logStatusWarning";

/// The messages of an FMU.
#[derive(Default)]
struct Said {
    last: String,
    /// Those in the category `logStatusWarning`.
    warnings: Vec<String>,
}

/// Stores the last message and all warnings. The FMU's messages are complete texts, so the variable arguments are not needed.
unsafe extern "C" fn keep_message(
    environment: *mut c_void,
    _instance: *const c_char,
    _status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is the object created below, which outlives the instance; the strings are null-terminated.
    unsafe {
        if let Some(said) = environment.cast::<Said>().as_mut()
            && !message.is_null()
        {
            said.last = CStr::from_ptr(message).to_string_lossy().replace("%%", "%").replace("##", "#");
            if !category.is_null() && CStr::from_ptr(category) == WARNING {
                said.warnings.push(said.last.clone());
            }
        }
    }
}

type SetDerivatives = unsafe extern "C" fn(Component, *const u32, usize, *const c_int, *const f64) -> c_int;
type GetDerivatives = unsafe extern "C" fn(Component, *const u32, usize, *const c_int, *mut f64) -> c_int;

/// The functions needed for stepping, looked up once.
struct Functions<'a> {
    get_real: libloading::Symbol<'a, unsafe extern "C" fn(Component, *const u32, usize, *mut f64) -> c_int>,
    set_real: libloading::Symbol<'a, unsafe extern "C" fn(Component, *const u32, usize, *const f64) -> c_int>,
    do_step: libloading::Symbol<'a, unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int>,
    simple: HashMap<&'static str, libloading::Symbol<'a, unsafe extern "C" fn(Component) -> c_int>>,
    set_input_derivatives: libloading::Symbol<'a, SetDerivatives>,
    output_derivatives: libloading::Symbol<'a, GetDerivatives>,
    setup: libloading::Symbol<'a, unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> c_int>,
    set_logging: libloading::Symbol<'a, unsafe extern "C" fn(Component, c_int, usize, *const *const c_char) -> c_int>,
    free: libloading::Symbol<'a, unsafe extern "C" fn(Component)>,
}

/// An instance of an FMU.
pub struct Instance<'a> {
    functions: Functions<'a>,
    component: Component,
    said: *mut Said,
    // the FMU may keep the pointer instead of a copy
    _callbacks: Box<Callbacks>,
}

impl Unit {
    /// The function `name`.
    ///
    /// # Safety
    /// `T` is its type.
    unsafe fn get<T>(&self, name: &'static str) -> Result<libloading::Symbol<'_, T>, ImportError> {
        // SAFETY: guaranteed by the caller.
        unsafe { self.library.get(name.as_bytes()) }.map_err(|source| ImportError::Function { name, source })
    }

    /// Loads the library at `path` of the FMU with this GUID, unpacked into `folder`.
    pub fn load(path: &Path, folder: &Path, guid: &str) -> Result<Unit, ImportError> {
        let text = |text: String| CString::new(text).map_err(|error| ImportError::Xml(error.to_string()));
        let (guid, resources) = (text(guid.into())?, text(address(&folder.join("resources")))?);
        // SAFETY: loading runs the library's initializers; an FMU has none that could do harm.
        let library = unsafe { libloading::Library::new(path) }.map_err(|source| {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into();
            ImportError::Library { name, source }
        })?;
        Ok(Unit { library, guid, resources })
    }

    /// Creates an instance.
    pub fn instantiate(&self) -> Result<Instance<'_>, ImportError> {
        type Instantiate = unsafe extern "C" fn(
            *const c_char,
            c_int,
            *const c_char,
            *const c_char,
            *const Callbacks,
            c_int,
            c_int,
        ) -> Component;
        let simple = ["fmi2EnterInitializationMode", "fmi2ExitInitializationMode", "fmi2Terminate", "fmi2Reset"];
        let said = Box::into_raw(Box::<Said>::default());
        let callbacks = Box::new(Callbacks {
            logger: keep_message,
            allocate: Some(calloc),
            free: Some(free),
            step_finished: std::ptr::null(),
            environment: said.cast(),
        });
        // SAFETY: the functions have the standard's signatures; strings and callbacks live long enough.
        unsafe {
            let instantiate = self.get::<Instantiate>("fmi2Instantiate")?;
            let mut by_name = HashMap::new();
            for name in simple {
                by_name.insert(name, self.get(name)?);
            }
            let functions = Functions {
                get_real: self.get("fmi2GetReal")?,
                set_real: self.get("fmi2SetReal")?,
                do_step: self.get("fmi2DoStep")?,
                simple: by_name,
                set_input_derivatives: self.get("fmi2SetRealInputDerivatives")?,
                output_derivatives: self.get("fmi2GetRealOutputDerivatives")?,
                setup: self.get("fmi2SetupExperiment")?,
                set_logging: self.get("fmi2SetDebugLogging")?,
                free: self.get("fmi2FreeInstance")?,
            };
            let (guid, resources) = (self.guid.as_ptr(), self.resources.as_ptr());
            let component = instantiate(c"check".as_ptr(), 1, guid, resources, &raw const *callbacks, 0, 0);
            let instance = Instance { functions, component, said, _callbacks: callbacks };
            if component.is_null() { Err(ImportError::Instantiate((*said).last.clone())) } else { Ok(instance) }
        }
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: both come from `instantiate` and are not used afterwards; the standard allows freeing null.
        unsafe {
            if !self.component.is_null() {
                (self.functions.free)(self.component);
            }
            drop(Box::from_raw(self.said));
        }
    }
}

impl Instance<'_> {
    fn check(&self, function: &'static str, status: c_int) -> Result<(), ImportError> {
        // fmi2OK or fmi2Warning: the computation can continue
        if matches!(status, 0 | 1) {
            return Ok(());
        }
        // SAFETY: it lives as long as the instance, and the FMU writes to it only during calls.
        let message = unsafe { (*self.said).last.clone() };
        Err(ImportError::Call { function, status, message })
    }

    /// Enables warnings. Warnings that were given once are given again.
    pub fn ask_for_warnings(&mut self) -> Result<(), ImportError> {
        let set = &self.functions.set_logging;
        // SAFETY: the component is live; one category.
        let status = unsafe { set(self.component, 1, 1, &WARNING.as_ptr()) };
        self.check("fmi2SetDebugLogging", status)
    }

    /// The warnings since the last call.
    pub fn take_warnings(&mut self) -> Vec<String> {
        // SAFETY: it lives as long as the instance, and the FMU writes to it only during calls.
        unsafe { std::mem::take(&mut (*self.said).warnings) }
    }

    /// A call without arguments.
    pub fn call(&mut self, function: &'static str) -> Result<(), ImportError> {
        // SAFETY: the component is live.
        let status = unsafe { (self.functions.simple[function])(self.component) };
        self.check(function, status)
    }

    /// Sets the start time [s], without a stop time.
    pub fn setup_experiment(&mut self, start: f64) -> Result<(), ImportError> {
        // SAFETY: the component is live.
        let status = unsafe { (self.functions.setup)(self.component, 0, 0.0, start, 0, 0.0) };
        self.check("fmi2SetupExperiment", status)
    }

    /// Reads one Real variable.
    pub fn real(&mut self, reference: u32) -> Result<f64, ImportError> {
        let mut value = f64::NAN;
        // SAFETY: the component is live; one reference and one value.
        let status = unsafe { (self.functions.get_real)(self.component, &reference, 1, &mut value) };
        self.check("fmi2GetReal", status)?;
        Ok(value)
    }

    /// Sets one Real variable.
    pub fn set_real(&mut self, reference: u32, value: f64) -> Result<(), ImportError> {
        // SAFETY: the component is live; one reference and one value.
        let status = unsafe { (self.functions.set_real)(self.component, &reference, 1, &value) };
        self.check("fmi2SetReal", status)
    }

    /// Makes a step of `step` [s] from `time` [s].
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), ImportError> {
        // SAFETY: the component is live.
        let status = unsafe { (self.functions.do_step)(self.component, time, step, 1) };
        self.check("fmi2DoStep", status)
    }

    /// Sets derivatives of an input for the next step: the first, and the second if given.
    pub fn set_input_derivatives(&mut self, reference: u32, values: &[f64]) -> Result<(), ImportError> {
        let (references, orders) = ([reference; 2], [1, 2]);
        let count = values.len().min(orders.len());
        let set = &self.functions.set_input_derivatives;
        // SAFETY: the component is live; there are at least as many references and orders as values.
        let status = unsafe { set(self.component, references.as_ptr(), count, orders.as_ptr(), values.as_ptr()) };
        self.check("fmi2SetRealInputDerivatives", status)
    }

    /// Reads the first derivative of an output at the end of the last step.
    pub fn output_derivative(&mut self, reference: u32) -> Result<f64, ImportError> {
        let mut value = f64::NAN;
        // SAFETY: the component is live; one reference, order and value.
        let status = unsafe { (self.functions.output_derivatives)(self.component, &reference, 1, &1, &mut value) };
        self.check("fmi2GetRealOutputDerivatives", status)?;
        Ok(value)
    }
}
