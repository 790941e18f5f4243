//! An importer of FMI 2.0 co-simulation units: it knows of a unit what the archive and the C interface say, no more.
//!
//! `unsafe` as any importer needs it: the library is trusted to keep the standard's signatures, which `check` is there
//! to try out.

use quick_xml::events::{BytesStart, Event};
use std::collections::{BTreeSet, HashMap};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;
use std::{fs, io};

/// A unit that can't be loaded, or a call that failed.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    #[error("{0}")]
    Unreadable(io::Error),
    #[error("{name} is missing or can't be read: {source}")]
    Part { name: &'static str, source: io::Error },
    #[error("it can't be unpacked: {0}")]
    Unpack(io::Error),
    #[error("it is no zip archive: {0}")]
    Zip(#[from] zip::result::ZipError),
    #[error("modelDescription.xml can't be read: {0}")]
    Xml(String),
    #[error("there is no binary for this platform ({wanted}), {present}")]
    Platform { wanted: String, present: String },
    #[error("the library can't be loaded: {}", chain(.0))]
    Library(libloading::Error),
    #[error("the library has no function {name}: {}", chain(.source))]
    Function { name: &'static str, source: libloading::Error },
    #[error("fmi2Instantiate gave no instance: {0}")]
    Instantiate(String),
    #[error("{function} returned status {status}: {message}")]
    Call { function: &'static str, status: c_int, message: String },
    #[error("there is no variable {0}")]
    Variable(String),
}

/// An error with what caused it.
fn chain(error: &dyn std::error::Error) -> String {
    match error.source() {
        Some(source) => format!("{error}: {}", chain(source)),
        None => error.to_string(),
    }
}

/// A variable as the model description has it.
#[derive(Clone, Debug)]
pub struct Variable {
    pub reference: u32,
    pub is_real: bool,
    /// Of a Real variable.
    pub start: Option<f64>,
}

/// The model description.
#[derive(Debug, Default)]
pub struct Description {
    pub identifier: String,
    pub guid: String,
    /// Variables by name.
    pub variables: HashMap<String, Variable>,
}

/// An archive, unpacked.
pub struct Archive {
    folder: tempfile::TempDir,
    pub description: Description,
    /// Platforms with a binary.
    pub platforms: BTreeSet<String>,
    /// The scene that the unit was made from, if it is one of ours.
    pub scene: Option<String>,
}

impl Archive {
    /// Unpacks the unit at `path`.
    pub fn open(path: &Path) -> Result<Archive, ImportError> {
        let mut archive = zip::ZipArchive::new(fs::File::open(path).map_err(ImportError::Unreadable)?)?;
        let folder = tempfile::Builder::new().prefix("brinell-check-").tempdir().map_err(ImportError::Unpack)?;
        archive.extract(folder.path())?;
        let names = archive.file_names().map(|name| Ok(name?.into_owned())).collect::<Result<Vec<_>, ImportError>>()?;
        let platform = |name: &String| Some(name.strip_prefix("binaries/")?.split('/').next()?.to_string());
        let description_path = folder.path().join("modelDescription.xml");
        let xml_error = |source| ImportError::Part { name: "modelDescription.xml", source };
        let description = Description::parse(&fs::read_to_string(description_path).map_err(xml_error)?)?;
        let scene = fs::read_to_string(folder.path().join("resources/scene.toml")).ok();
        Ok(Archive { description, platforms: names.iter().filter_map(platform).collect(), scene, folder })
    }

    /// Loads the binary for this machine.
    pub fn load(&self) -> Result<Unit, ImportError> {
        let (folder, extension) = crate::package::platform().map_err(|error| ImportError::Xml(error.to_string()))?;
        let name = format!("{}.{extension}", self.description.identifier);
        let path = self.folder.path().join("binaries").join(folder).join(name);
        if !path.exists() {
            let present = match self.platforms.iter().cloned().collect::<Vec<_>>().join(", ") {
                none if none.is_empty() => "nor for any other".into(),
                some => format!("only for {some}"),
            };
            return Err(ImportError::Platform { wanted: folder.into(), present });
        }
        // SAFETY: loading runs the library's initializers; a unit of FMI has none that could harm.
        Ok(Unit { library: unsafe { libloading::Library::new(path) }.map_err(ImportError::Library)? })
    }
}

impl Description {
    fn parse(text: &str) -> Result<Description, ImportError> {
        let mut reader = quick_xml::Reader::from_str(text);
        let mut description = Description::default();
        let mut current = None;
        let wrong = |error: &dyn std::fmt::Display| ImportError::Xml(error.to_string());
        loop {
            match reader.read_event().map_err(|error| wrong(&error))? {
                Event::Eof => return Ok(description),
                Event::Start(element) | Event::Empty(element) => {
                    let attributes = attributes(&element)?;
                    let get = |name: &str| attributes.get(name).cloned().unwrap_or_default();
                    match element.name().as_ref() {
                        "fmiModelDescription" => description.guid = get("guid"),
                        "CoSimulation" => description.identifier = get("modelIdentifier"),
                        "ScalarVariable" => {
                            let reference = get("valueReference").parse().map_err(|error| wrong(&error))?;
                            current = Some((get("name"), reference));
                        }
                        kind @ ("Real" | "Integer") => {
                            if let Some((name, reference)) = current.take() {
                                let start = attributes.get("start").map(|start| start.parse());
                                let start = start.transpose().map_err(|error| wrong(&error))?;
                                let variable = Variable { reference, is_real: kind == "Real", start };
                                description.variables.insert(name, variable);
                            }
                        }
                        _ => {}
                    }
                }
                _ => {}
            }
        }
    }

    /// The value reference of the Real variable `name`.
    pub fn real(&self, name: &str) -> Result<u32, ImportError> {
        let variable = self.variables.get(name).filter(|variable| variable.is_real);
        variable.map(|variable| variable.reference).ok_or_else(|| ImportError::Variable(name.into()))
    }
}

fn attributes(element: &BytesStart) -> Result<HashMap<String, String>, ImportError> {
    let mut map = HashMap::new();
    for attribute in element.attributes() {
        let attribute = attribute.map_err(|error| ImportError::Xml(error.to_string()))?;
        let name = attribute.key.as_ref().to_string();
        let value = attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0);
        map.insert(name, value.map_err(|error| ImportError::Xml(error.to_string()))?.into_owned());
    }
    Ok(map)
}

/// A loaded library.
pub struct Unit {
    library: libloading::Library,
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

/// Keeps the last message. The unit's messages are complete texts, so that the variable arguments aren't needed.
unsafe extern "C" fn keep_message(
    environment: *mut c_void,
    _instance: *const c_char,
    _status: c_int,
    _category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is the String below, which outlives the instance; the message ends with 0.
    unsafe {
        if let Some(kept) = environment.cast::<String>().as_mut()
            && !message.is_null()
        {
            *kept = CStr::from_ptr(message).to_string_lossy().replace("%%", "%").replace("##", "#");
        }
    }
}

type SetDerivatives = unsafe extern "C" fn(Component, *const u32, usize, *const c_int, *const f64) -> c_int;
type GetDerivatives = unsafe extern "C" fn(Component, *const u32, usize, *const c_int, *mut f64) -> c_int;

/// The functions that stepping needs, looked up once.
struct Functions<'a> {
    get_real: libloading::Symbol<'a, unsafe extern "C" fn(Component, *const u32, usize, *mut f64) -> c_int>,
    set_real: libloading::Symbol<'a, unsafe extern "C" fn(Component, *const u32, usize, *const f64) -> c_int>,
    do_step: libloading::Symbol<'a, unsafe extern "C" fn(Component, f64, f64, c_int) -> c_int>,
    simple: HashMap<&'static str, libloading::Symbol<'a, unsafe extern "C" fn(Component) -> c_int>>,
    set_input_derivatives: libloading::Symbol<'a, SetDerivatives>,
    output_derivatives: libloading::Symbol<'a, GetDerivatives>,
    setup: libloading::Symbol<'a, unsafe extern "C" fn(Component, c_int, f64, f64, c_int, f64) -> c_int>,
    free: libloading::Symbol<'a, unsafe extern "C" fn(Component)>,
}

/// An instance of a unit.
pub struct Instance<'a> {
    functions: Functions<'a>,
    component: Component,
    message: *mut String,
    // the unit may keep the pointer instead of a copy
    _callbacks: Box<Callbacks>,
}

impl Unit {
    /// The function `name`.
    ///
    /// # Safety
    /// `T` is its type.
    unsafe fn get<T>(&self, name: &'static str) -> Result<libloading::Symbol<'_, T>, ImportError> {
        // SAFETY: as the caller promises.
        unsafe { self.library.get(name.as_bytes()) }.map_err(|source| ImportError::Function { name, source })
    }

    /// Makes an instance.
    pub fn instantiate(&self, guid: &str) -> Result<Instance<'_>, ImportError> {
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
        let guid = CString::new(guid).map_err(|error| ImportError::Xml(error.to_string()))?;
        let message = Box::into_raw(Box::<String>::default());
        let callbacks = Box::new(Callbacks {
            logger: keep_message,
            allocate: None,
            free: None,
            step_finished: std::ptr::null(),
            environment: message.cast(),
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
                free: self.get("fmi2FreeInstance")?,
            };
            let location = c"file:///resources";
            let component =
                instantiate(c"check".as_ptr(), 1, guid.as_ptr(), location.as_ptr(), &raw const *callbacks, 0, 0);
            let instance = Instance { functions, component, message, _callbacks: callbacks };
            if component.is_null() { Err(ImportError::Instantiate((*message).clone())) } else { Ok(instance) }
        }
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: both were made in `instantiate` and are not used afterwards; the standard allows freeing null.
        unsafe {
            if !self.component.is_null() {
                (self.functions.free)(self.component);
            }
            drop(Box::from_raw(self.message));
        }
    }
}

impl Instance<'_> {
    fn check(&self, function: &'static str, status: c_int) -> Result<(), ImportError> {
        if status == 0 {
            return Ok(());
        }
        // SAFETY: the String lives as long as the instance, and the unit writes to it during calls only.
        let message = unsafe { (*self.message).clone() };
        Err(ImportError::Call { function, status, message })
    }

    /// A call without arguments.
    pub fn call(&mut self, function: &'static str) -> Result<(), ImportError> {
        // SAFETY: the component is live.
        let status = unsafe { (self.functions.simple[function])(self.component) };
        self.check(function, status)
    }

    /// Sets the start time [s], without stop time.
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

    /// One step from `time` [s] over `step` [s].
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), ImportError> {
        // SAFETY: the component is live.
        let status = unsafe { (self.functions.do_step)(self.component, time, step, 1) };
        self.check("fmi2DoStep", status)
    }

    /// Sets derivatives of an input for the next step: the first, and the second if it is there.
    pub fn set_input_derivatives(&mut self, reference: u32, values: &[f64]) -> Result<(), ImportError> {
        let (references, orders) = ([reference; 2], [1, 2]);
        let count = values.len().min(orders.len());
        let set = &self.functions.set_input_derivatives;
        // SAFETY: the component is live; as many references and orders as values, or more.
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
