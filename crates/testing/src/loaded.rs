//! Units loaded by an importer that knows variables by name: calls that must succeed, with the library's last message if
//! they don't.
#![allow(clippy::not_unsafe_ptr_arg_deref, reason = "states go from the library back to it")]

pub use super::importer::{ERROR, OK};

use super::face::Face;
use super::importer::{Importer, Message};
use super::unit;
use brinell_fmu::fmi2::abi::fmi2FMUstate;
use std::collections::HashMap;
use std::ffi::{c_char, c_int};
use std::ops::Deref;
use std::path::Path;

/// A library with the value references of its variables.
pub struct Unit {
    pub face: Face,
    pub references: HashMap<String, u32>,
}

/// An instance of an FMU; calls whose status a test judges are those of the importer.
pub struct Instance<'a> {
    unit: &'a Unit,
    importer: Importer<'a>,
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
        let face = Face::of(library, place);
        let references = face.variables.iter().map(|variable| (variable.name.clone(), variable.reference)).collect();
        Unit { face, references }
    }

    /// A new instance.
    pub fn instantiate(&self) -> Instance<'_> {
        self.try_to_instantiate().unwrap_or_else(|messages| panic!("no instance: {messages:?}"))
    }

    /// A new instance, if the library creates one.
    ///
    /// # Errors
    /// What the library says about why it doesn't.
    pub fn try_to_instantiate(&self) -> Result<Instance<'_>, Vec<Message>> {
        Ok(Instance { unit: self, importer: Importer::try_named(&self.face, "test", false)? })
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

impl<'a> Deref for Instance<'a> {
    type Target = Importer<'a>;

    fn deref(&self) -> &Importer<'a> {
        &self.importer
    }
}

impl Instance<'_> {
    /// The value reference of a variable.
    pub fn real_of(&self, name: &str) -> u32 {
        self.unit.references[name]
    }

    pub fn initialize(&mut self) {
        self.enter_initialization();
        assert_eq!(self.exit(), OK, "{}", self.message());
    }

    /// Outputs can be read from here on.
    pub fn enter_initialization(&mut self) {
        assert_eq!((self.setup(0.0, None), self.enter()), (OK, OK), "{}", self.message());
    }

    pub fn reset(&mut self) {
        assert_eq!(self.importer.reset(), OK, "{}", self.message());
    }

    /// The last message.
    pub fn message(&self) -> String {
        self.log.borrow().last().map(|message| message.text.clone()).unwrap_or_default()
    }

    /// The last message; all are removed.
    pub fn take_message(&self) -> String {
        self.messages().pop().map(|message| message.text).unwrap_or_default()
    }

    /// Enables all messages.
    pub fn log_everything(&mut self) {
        assert_eq!(self.importer.log(true, &[]), OK);
    }

    /// Sets derivatives of this order of the inputs.
    pub fn set_derivatives(&mut self, references: &[u32], order: c_int, values: &[f64]) -> c_int {
        assert_eq!(references.len(), values.len());
        let (set, orders) = (self.f().set_real_input_derivatives, vec![order; references.len()]);
        // SAFETY: the component lives, and the arrays have the given length
        unsafe { set(self.c, references.as_ptr(), references.len(), orders.as_ptr(), values.as_ptr()) }
    }

    /// Reads derivatives of this order of outputs with respect to time.
    pub fn output_derivatives(&self, references: &[u32], order: c_int, values: &mut [f64]) -> c_int {
        assert_eq!(references.len(), values.len());
        let (get, orders) = (self.f().get_real_output_derivatives, vec![order; references.len()]);
        // SAFETY: as above
        unsafe { get(self.c, references.as_ptr(), references.len(), orders.as_ptr(), values.as_mut_ptr()) }
    }

    /// Derivatives of the variables `unknown` in the direction 1 of `known`.
    pub fn directional(&self, unknown: &[u32], known: u32, values: &mut [f64]) -> c_int {
        assert_eq!(unknown.len(), values.len());
        let get = self.f().get_directional_derivative;
        // SAFETY: as above, with arrays of one element for the known variable
        unsafe { get(self.c, unknown.as_ptr(), unknown.len(), &raw const known, 1, &1.0, values.as_mut_ptr()) }
    }

    pub fn set_one(&mut self, name: &str, value: f64) {
        assert_eq!(self.set(&[self.real_of(name)], &[value]), OK, "{name}: {}", self.message());
    }

    pub fn real(&self, name: &str) -> f64 {
        self.importer.real(self.real_of(name))
    }

    pub fn integer(&self, name: &str) -> i32 {
        let mut value = [-1];
        assert_eq!(self.get_integers(&[self.real_of(name)], &mut value), OK, "{name}: {}", self.message());
        value[0]
    }

    pub fn restore(&mut self, state: fmi2FMUstate) {
        assert_eq!(self.importer.restore(state), OK, "{}", self.message());
    }

    /// A new state from bytes, if they are accepted.
    pub fn deserialize(&self, bytes: &[c_char]) -> Option<fmi2FMUstate> {
        let (status, state) = self.state_of(bytes);
        (status == OK).then_some(state)
    }
}
