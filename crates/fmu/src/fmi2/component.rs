//! The object behind an `fmi2Component`, and the guard that every call passes.

use super::abi::fmi2ComponentEnvironment;
use super::abi::{fmi2CallbackFunctions, fmi2CallbackLogger, fmi2Component, fmi2Error, fmi2OK, fmi2Status, fmi2String};
use super::category::{Category, DEEP, FAST, GUARD, MISWIRED, UNSTABLE};
use super::order::{Function, PREFIX};
use super::report::{describe, describe_warning};
use crate::c::complaint::Complaint;
use crate::c::handle::Handle;
use crate::c::memory::Memory;
use crate::c::span::Free;
use crate::c::text::Text;
use crate::instance::{Checked, Instance, Warning};
use crate::scene::{Presence, Scene};
use core::ffi::c_char;

/// An instance with the data from its importer. Its arrays [outside](Instance::outside) and its name follow it in memory.
#[repr(C)]
pub struct Component<S: Scene> {
    /// The instance.
    pub instance: Instance<S>,
    /// The importer's logger.
    pub logger: Logger,
    /// The source of its memory.
    pub memory: Memory,
    /// The logged categories, and the warnings that have not been given yet. Errors are always logged.
    pub categories: u8,
}

impl<S: Scene> Handle for Component<S> {}

impl<S: Scene> Component<S> {
    /// Proof at compile time that a component of zeros is valid: the compiler rejects a constant that is not a value of its
    /// type. All fields that are not listed here are numbers, `bool`s, pointers that may be null, or arrays of them.
    ///
    /// Newly allocated memory consists of zeros. A component of 100,000 contacts would not fit on every stack.
    pub const ZEROS: (Checked<S>, Logger, Memory) =
        // SAFETY: the evaluation of the constant is the proof.
        unsafe {
            use core::mem::zeroed;
            (zeroed(), zeroed(), zeroed())
        };
}

/// How long the memory of an instance without an importer is, in words.
pub fn words_of_instance<S: Scene>() -> usize {
    (size_of::<Instance<S>>() + Instance::<S>::outside_with_models()).div_ceil(8)
}

/// An instance without an importer, before its start, at the beginning of this memory, which is filled with zeros. `None` if the memory has
/// fewer than [`words_of_instance`].
pub fn instance_in<S: Scene>(memory: &'static mut [u64]) -> Option<&'static mut Instance<S>> {
    const { assert!(align_of::<Instance<S>>() <= align_of::<u64>()) };
    let _ = Component::<S>::ZEROS;
    if memory.len() < words_of_instance::<S>() {
        return None;
    }
    memory.fill(0);
    let start = memory.as_mut_ptr();
    start.expose_provenance();
    // SAFETY: the memory is large enough for the instance and its arrays, aligned, and nothing else uses it. Zeros are a valid
    // instance, as `ZEROS` proves.
    let instance = unsafe { &mut *start.cast::<Instance<S>>() };
    // SAFETY: the bytes behind it are zeros of the same allocation, its provenance is exposed, and the instance is never moved.
    let free = unsafe { Free::behind(instance, Instance::<S>::outside_with_models()) };
    instance.place(free);
    Some(instance)
}

/// The recipient of messages.
#[derive(Clone, Copy)]
pub struct Logger {
    function: Option<fmi2CallbackLogger>,
    environment: fmi2ComponentEnvironment,
}

/// The beginning of a message about a function with this `name` after `fmi2`.
#[inline(never)]
fn begin<'a>(text: &'a mut Text, name: &str) -> &'a mut Text {
    text.string(PREFIX).string(name).string(": ")
}

impl Logger {
    /// The logger in the importer's callbacks.
    pub fn of(callbacks: &fmi2CallbackFunctions) -> Logger {
        Logger { function: callbacks.logger, environment: callbacks.componentEnvironment }
    }

    /// Passes the message `text` of this `category` to the importer. Without a logger it is lost.
    ///
    /// # Safety
    /// `instance_name` is a null-terminated string.
    #[inline(never)]
    unsafe fn send(&self, instance_name: fmi2String, text: &Text, category: Category) {
        let Some(function) = self.function else { return };
        let (status, category, text) = (category.status(), category.name().as_ptr(), text.as_ptr());
        // SAFETY: the importer's function gets null-terminated strings and a format without conversions.
        #[cfg(not(target_arch = "wasm32"))]
        unsafe {
            function(self.environment, instance_name, status, category, text);
        }
        // a module can't call the importer; what runs it knows both
        #[cfg(target_arch = "wasm32")]
        {
            #[link(wasm_import_module = "env")]
            unsafe extern "C" {
                fn brinell_log(instance_name: fmi2String, status: fmi2Status, category: fmi2String, text: fmi2String);
            }
            let _ = (function, self.environment);
            // SAFETY: null-terminated strings in the memory of this module.
            unsafe { brinell_log(instance_name, status, category, text) }
        }
    }

    /// Logs why a call is rejected. `name` is the name of the function after `fmi2`.
    ///
    /// # Safety
    /// `instance_name` is a null-terminated string.
    #[cold]
    #[inline(never)]
    pub unsafe fn log<S: Scene>(&self, instance_name: fmi2String, name: &str, complaint: &Complaint) {
        let mut text = Text::new();
        describe::<S>(begin(&mut text, name), complaint);
        // SAFETY: guaranteed by the caller.
        unsafe { self.send(instance_name, &text, Category::of(complaint)) };
    }
}

impl<S: Scene> Component<S> {
    /// The name of the instance, which follows the component and its arrays in memory.
    fn name(&self) -> fmi2String {
        // SAFETY: fmi2Instantiate allocates the component and the name after it in one piece.
        unsafe { core::ptr::from_ref(self).add(1).cast::<c_char>().add(Instance::<S>::outside_with_models()) }
    }

    /// Warns if a contact is deeper or closes faster than its law is valid.
    #[cold]
    #[inline(never)]
    pub fn warn_of_limits(&mut self, function: Function) {
        if let Some(warning) = self.instance.take_deep() {
            let bit = match warning {
                Warning::Unstable { .. } if S::Watch::IS_PRESENT => UNSTABLE,
                Warning::Late if S::Watch::IS_PRESENT => MISWIRED,
                _ => DEEP,
            };
            self.warn(function, bit, &warning);
        }
        if let Some(warning) = self.instance.find_fast() {
            self.warn(function, FAST, &warning);
        }
    }

    /// Warns if the importer applies the force in another order than the scene assumes.
    pub fn warn_of_wiring(&mut self, function: Function) {
        if let Some(warning) = self.instance.take_miswired() {
            self.warn(function, MISWIRED, &warning);
        }
    }

    /// Warns if the passivity guard acts, once.
    #[inline(never)]
    pub fn warn_of_guard(&mut self, function: Function) {
        if let Some(warning) = self.instance.take_guard() {
            self.warn(function, GUARD, &warning);
        }
    }

    /// Logs a warning once.
    #[inline(never)]
    fn warn(&mut self, function: Function, bit: u8, warning: &Warning) {
        if self.categories & bit != 0 {
            self.categories &= !bit;
            let mut text = Text::new();
            describe_warning::<S>(begin(&mut text, function.name()), warning);
            // SAFETY: the name is null-terminated.
            unsafe { self.logger.send(self.name(), &text, Category::Warning) };
        }
    }

    /// Logs what is wrong with a call of `function`, and returns the status. An error ends the simulation.
    #[cold]
    #[inline(never)]
    fn refuse(&mut self, function: Function, complaint: &Complaint) -> fmi2Status {
        let category = Category::of(complaint);
        if category == Category::Error {
            self.instance.fail();
        }
        if category.is_logged(self.categories) {
            // SAFETY: the name is null-terminated.
            unsafe { self.logger.log::<S>(self.name(), function.name(), complaint) };
        }
        category.result()
    }
}

/// The guard: rejects a null component and a call out of order, runs `body`, and converts a complaint to a status.
///
/// # Safety
/// `c` is null, or it comes from fmi2Instantiate, has not been freed, and no other call is using it.
///
/// Functions that are called in every step handle the plain case before they call the guard. All other cases are then processed
/// here, with every check and message.
pub unsafe fn call<S: Scene>(
    c: fmi2Component,
    function: Function,
    body: impl FnOnce(&mut Component<S>) -> Result<(), Complaint>,
) -> fmi2Status {
    // SAFETY: guaranteed by the caller.
    let Some(component) = (unsafe { opened::<S>(c, function) }) else { return fmi2Error };
    match body(component) {
        Ok(()) => fmi2OK,
        Err(complaint) => component.refuse(function, &complaint),
    }
}

/// The component, if there is one and the call is in order. Otherwise the reason is logged.
///
/// # Safety
/// As for [`call`].
#[inline(never)]
unsafe fn opened<'a, S: Scene>(c: fmi2Component, function: Function) -> Option<&'a mut Component<S>> {
    // SAFETY: guaranteed by the caller.
    let component = unsafe { Component::<S>::behind(c) }?;
    let phase = component.instance.phase();
    if function.is_allowed_in(phase) {
        return Some(component);
    }
    component.refuse(function, &Complaint::OutOfOrder { phase });
    None
}
