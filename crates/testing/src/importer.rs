//! An importer: an instance with the messages that it logs, and calls with arguments of the right kind.
#![allow(clippy::not_unsafe_ptr_arg_deref, reason = "states go from the library back to it")]

use crate::face::Face;
use crate::functions::{Functions, memory, variadic};
use brinell_fmu::fmi2::abi::*;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicU64, Ordering};

pub const OK: c_int = 0;
pub const WARNING: c_int = 1;
pub const DISCARD: c_int = 2;
pub const ERROR: c_int = 3;

/// Number of calls of the C interface in this process.
pub static CALLS: AtomicU64 = AtomicU64::new(0);

/// Length of a step \[s\].
pub const STEP: f64 = 1e-6;

/// The name of instances: what is special to printf and to loggers, and not ASCII.
pub const NAME: &str = "100 %s%n # Größe";

/// A message of an instance.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    pub name: String,
    pub status: c_int,
    pub category: String,
    pub text: String,
}

/// The messages of an instance, behind the pointer that the logger gets.
pub type Log = RefCell<Vec<Message>>;

/// The states of an instance in the standard, without those of asynchronous steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    Instantiated,
    Initialization,
    StepComplete,
    Terminated,
    Error,
}

impl Phase {
    pub const ALL: [Phase; 5] =
        [Phase::Instantiated, Phase::Initialization, Phase::StepComplete, Phase::Terminated, Phase::Error];
}

/// What is at the pointer; nothing for null.
unsafe fn text_at(pointer: *const c_char) -> String {
    if pointer.is_null() {
        return "NULL".into();
    }
    // SAFETY: the caller's string ends with 0
    unsafe { CStr::from_ptr(pointer) }.to_str().expect("the library's texts are UTF-8").to_string()
}

unsafe extern "C" fn logger(
    environment: *mut c_void,
    name: *const c_char,
    status: c_int,
    category: *const c_char,
    text: *const c_char,
) {
    // SAFETY: the importers below pass a log, and the library passes strings that end with 0
    let (log, name, category, text) =
        unsafe { (environment.cast::<Log>().as_ref(), text_at(name), text_at(category), text_at(text)) };
    let log = log.expect("the environment is passed to the logger");
    log.borrow_mut().push(Message { name, status, category, text });
}

/// The callbacks of an importer with this log.
pub fn callbacks(face: &Face, log: &Log) -> fmi2CallbackFunctions {
    let (allocate, free) = memory(face.needs_no_memory());
    fmi2CallbackFunctions {
        logger: Some(variadic(logger)),
        allocateMemory: allocate,
        freeMemory: free,
        stepFinished: None,
        componentEnvironment: std::ptr::from_ref(log).cast_mut().cast(),
    }
}

/// An instance.
pub struct Importer<'a> {
    pub face: &'a Face,
    pub c: fmi2Component,
    pub log: Box<Log>,
    pub time: f64,
}

/// The functions; each use counts as a call.
pub fn functions(face: &Face) -> &Functions {
    CALLS.fetch_add(1, Ordering::Relaxed);
    &face.functions
}

impl<'a> Importer<'a> {
    pub fn new(face: &'a Face) -> Importer<'a> {
        Importer::named(face, NAME, true)
    }

    pub fn named(face: &'a Face, name: &str, logging: bool) -> Importer<'a> {
        Importer::try_named(face, name, logging).unwrap_or_else(|messages| panic!("no instance: {messages:?}"))
    }

    /// An instance, if the library creates one.
    ///
    /// # Errors
    /// What the library says about why it doesn't.
    pub fn try_named(face: &'a Face, name: &str, logging: bool) -> Result<Importer<'a>, Vec<Message>> {
        let log = Box::new(Log::default());
        let (callbacks, name) = (callbacks(face, &log), CString::new(name).expect("no zero"));
        // SAFETY: strings that end with 0, and callbacks that live
        let c = unsafe {
            (functions(face).instantiate)(
                name.as_ptr(),
                1,
                face.guid.as_ptr(),
                c"".as_ptr(),
                &raw const callbacks,
                0,
                c_int::from(logging),
            )
        };
        if c.is_null() { Err(log.take()) } else { Ok(Importer { face, c, log, time: 0.0 }) }
    }

    /// An instance in this phase; where it can be, after some steps.
    pub fn at(face: &'a Face, phase: Phase) -> Importer<'a> {
        let mut made = Importer::new(face);
        made.go(phase);
        made
    }

    /// Leads an instance that was just made to this phase.
    pub fn go(&mut self, phase: Phase) {
        if phase == Phase::Instantiated {
            return;
        }
        self.time = 0.0;
        assert_eq!((self.setup(0.0, None), self.enter()), (OK, OK), "{:?}", self.log);
        if phase == Phase::Initialization {
            return;
        }
        assert_eq!(self.exit(), OK, "{:?}", self.log);
        for _ in 0..5 {
            self.press(1.0);
        }
        match phase {
            Phase::Terminated => assert_eq!(self.terminate(), OK),
            Phase::Error => assert_eq!(self.step(self.time, -1.0), ERROR),
            _ => {}
        }
        // a unit that moves the bodies warns, since nothing here applies its force
        self.messages();
    }

    pub fn f(&self) -> &'a Functions {
        functions(self.face)
    }

    /// The messages since the last call of this.
    pub fn messages(&self) -> Vec<Message> {
        self.log.take()
    }

    /// Sets all rates to `rate` [m/s] and makes a step, which must succeed.
    #[track_caller]
    pub fn press(&mut self, rate: f64) {
        self.set_rates(rate);
        assert_eq!(self.step(self.time, STEP), OK, "{:?}", self.log);
        self.time += STEP;
    }

    /// Sets all rates to `rate` [m/s], and those along the surface to half of it in the other direction.
    #[track_caller]
    pub fn set_rates(&self, rate: f64) {
        for (references, rate) in [(&self.face.rates, rate), (&self.face.sideways, -0.5 * rate)] {
            assert_eq!(self.set(references, &vec![rate; references.len()]), OK, "{:?}", self.log);
        }
    }

    pub fn setup(&self, start: f64, stop: Option<f64>) -> c_int {
        let defined = c_int::from(stop.is_some());
        // SAFETY: the component lives, here and below
        unsafe { (self.f().setup_experiment)(self.c, 0, 0.0, start, defined, stop.unwrap_or(0.0)) }
    }

    pub fn enter(&self) -> c_int {
        unsafe { (self.f().enter_initialization_mode)(self.c) }
    }

    pub fn exit(&self) -> c_int {
        unsafe { (self.f().exit_initialization_mode)(self.c) }
    }

    pub fn terminate(&self) -> c_int {
        unsafe { (self.f().terminate)(self.c) }
    }

    pub fn reset(&self) -> c_int {
        unsafe { (self.f().reset)(self.c) }
    }

    pub fn step(&self, time: f64, step: f64) -> c_int {
        unsafe { (self.f().do_step)(self.c, time, step, 1) }
    }

    pub fn set(&self, references: &[u32], values: &[f64]) -> c_int {
        assert_eq!(references.len(), values.len());
        // SAFETY: arrays as long as announced, here and below
        unsafe { (self.f().set_real)(self.c, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    pub fn get(&self, references: &[u32], values: &mut [f64]) -> c_int {
        assert_eq!(references.len(), values.len());
        unsafe { (self.f().get_real)(self.c, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }

    pub fn get_integers(&self, references: &[u32], values: &mut [c_int]) -> c_int {
        assert_eq!(references.len(), values.len());
        unsafe { (self.f().get_integer)(self.c, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }

    /// The value of a Real variable, which must be readable.
    #[track_caller]
    pub fn real(&self, reference: u32) -> f64 {
        let mut value = [f64::NAN];
        assert_eq!(self.get(&[reference], &mut value), OK, "{reference}: {:?}", self.log);
        value[0]
    }

    /// The bits of every variable.
    #[track_caller]
    pub fn bits(&self) -> Vec<u64> {
        let mut reals = vec![f64::NAN; self.face.reals.len()];
        assert_eq!(self.get(&self.face.reals, &mut reals), OK, "{:?}", self.log);
        let mut integers = vec![-1; self.face.integers.len()];
        assert_eq!(self.get_integers(&self.face.integers, &mut integers), OK, "{:?}", self.log);
        assert!(reals.iter().all(|value| value.is_finite()), "{reals:?}");
        let enumerations = self.face.variables.iter().filter(|variable| !variable.is_real);
        for (variable, value) in enumerations.zip(&integers) {
            assert!(variable.items.contains(value), "{} is {value}", variable.name);
            if let Some(&number) = self.face.named.get(&format!("{}_number", variable.name)) {
                assert_eq!(self.real(number), f64::from(*value), "{}", variable.name);
            }
        }
        reals.iter().map(|value| value.to_bits()).chain(integers.iter().map(|value| *value as u64)).collect()
    }

    #[track_caller]
    pub fn save(&self) -> fmi2FMUstate {
        let mut state = null_mut();
        assert_eq!(unsafe { (self.f().get_fmu_state)(self.c, &raw mut state) }, OK, "{:?}", self.log);
        assert!(!state.is_null());
        state
    }

    pub fn restore(&self, state: fmi2FMUstate) -> c_int {
        // SAFETY: the callers' states live
        unsafe { (self.f().set_fmu_state)(self.c, state) }
    }

    #[track_caller]
    pub fn free(&self, mut state: fmi2FMUstate) {
        let status = unsafe { (self.f().free_fmu_state)(self.c, &raw mut state) };
        assert_eq!((status, state), (OK, null_mut()));
    }

    #[track_caller]
    pub fn bytes(&self, state: fmi2FMUstate) -> Vec<c_char> {
        let mut size = 0;
        assert_eq!(unsafe { (self.f().serialized_fmu_state_size)(self.c, state, &raw mut size) }, OK);
        let mut bytes = vec![0; size];
        assert_eq!(unsafe { (self.f().serialize_fmu_state)(self.c, state, bytes.as_mut_ptr(), size) }, OK);
        bytes
    }

    /// A state of these bytes: the status of the call and the state.
    pub fn state_of(&self, bytes: &[c_char]) -> (c_int, fmi2FMUstate) {
        let mut state = null_mut();
        let status = self.overwrite(&mut state, bytes);
        (status, state)
    }

    /// Makes `state` one of these bytes; a new one, if it is null.
    pub fn overwrite(&self, state: &mut fmi2FMUstate, bytes: &[c_char]) -> c_int {
        unsafe { (self.f().deserialize_fmu_state)(self.c, bytes.as_ptr(), bytes.len(), state) }
    }

    pub fn real_status(&self, kind: c_int) -> (c_int, f64) {
        let mut value = f64::NAN;
        (unsafe { (self.f().get_real_status)(self.c, kind, &raw mut value) }, value)
    }

    pub fn log(&self, on: bool, categories: &[&str]) -> c_int {
        let texts: Vec<_> = categories.iter().map(|text| CString::new(*text).expect("no zero")).collect();
        let pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
        let pointer = if pointers.is_empty() { null() } else { pointers.as_ptr() };
        unsafe { (self.f().set_debug_logging)(self.c, c_int::from(on), pointers.len(), pointer) }
    }
}

impl Drop for Importer<'_> {
    fn drop(&mut self) {
        // SAFETY: the component is not used again
        unsafe { (self.f().free_instance)(self.c) };
    }
}
