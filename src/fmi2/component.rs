//! What an `fmi2Component` points to, and the guard that every call passes.

use super::abi::fmi2ComponentEnvironment;
use super::abi::{fmi2CallbackFunctions, fmi2CallbackLogger, fmi2Component, fmi2Error, fmi2OK, fmi2Status, fmi2String};
use super::category::{Category, DEEP, DISCARD, FAST, GUARD, MISWIRED, UNSTABLE};
use super::complaint::Complaint;
use super::handle::Handle;
use super::memory::Memory;
use super::order::{Function, PREFIX};
use super::report::{describe, describe_warning};
use super::text::Text;
use crate::instance::{Instance, Phase, Warning};
use crate::scene::{Presence, Scene};
use core::ffi::c_char;

/// An instance with what its importer gave it. The name of the instance follows it in memory.
#[repr(C)]
pub struct Component<S: Scene> {
    /// The instance.
    pub instance: Instance<S>,
    /// The importer's logger.
    pub logger: Logger,
    /// Where it takes memory from.
    pub memory: Memory,
    /// Categories that are logged; errors always are.
    pub categories: u8,
}

impl<S: Scene> Handle for Component<S> {}

impl<S: Scene> Component<S> {
    /// Proof that a component of zeros is one, at compile time: the compiler refuses a constant that isn't a value of its type.
    /// What isn't listed here is a number, a `bool`, a pointer that may be null, or an array of such.
    ///
    /// Zeros are what the system's memory has; a component of 100,000 contacts would not fit on every stack.
    pub const ZEROS: (S::Contact, S::Values, Phase, Logger, Memory) =
        // SAFETY: that it is evaluated is the proof.
        unsafe {
            (core::mem::zeroed(), core::mem::zeroed(), core::mem::zeroed(), core::mem::zeroed(), core::mem::zeroed())
        };
}

/// Where messages go.
#[derive(Clone, Copy)]
pub struct Logger {
    function: Option<fmi2CallbackLogger>,
    environment: fmi2ComponentEnvironment,
}

/// The beginning of a message about the function that has this `name` behind `fmi2`.
#[inline(never)]
fn begin<'a>(text: &'a mut Text, name: &str) -> &'a mut Text {
    text.string(PREFIX).string(name).string(": ")
}

impl Logger {
    /// The logger among the importer's functions.
    pub fn of(callbacks: &fmi2CallbackFunctions) -> Logger {
        Logger { function: callbacks.logger, environment: callbacks.componentEnvironment }
    }

    /// Hands the message `text` of this `category` to the importer; without logger it is lost.
    ///
    /// # Safety
    /// `instance_name` is a string that ends with 0.
    #[inline(never)]
    unsafe fn send(&self, instance_name: fmi2String, text: &Text, category: Category) {
        let Some(function) = self.function else { return };
        // SAFETY: the importer's function, with strings that end with 0 and a format without commands.
        unsafe {
            function(self.environment, instance_name, category.status(), category.name().as_ptr(), text.as_ptr())
        };
    }

    /// Logs why the function refuses a call that has this `name` behind `fmi2`.
    ///
    /// # Safety
    /// `instance_name` is a string that ends with 0.
    #[cold]
    #[inline(never)]
    pub unsafe fn log<S: Scene>(&self, instance_name: fmi2String, name: &str, complaint: &Complaint) {
        let mut text = Text::new();
        describe::<S>(begin(&mut text, name), complaint);
        // SAFETY: as the caller promises.
        unsafe { self.send(instance_name, &text, Category::of(complaint)) };
    }
}

impl<S: Scene> Component<S> {
    /// The name of the instance, which lies behind the component.
    fn name(&self) -> fmi2String {
        // SAFETY: fmi2Instantiate allocates the component and the name behind it in one piece.
        unsafe { core::ptr::from_ref(self).add(1).cast::<c_char>() }
    }

    /// Warns of a contact that is deeper or closes faster than its law is valid for, if there is one.
    #[cold]
    #[inline(never)]
    pub fn warn_of_limits(&mut self, function: Function) {
        if let Some(warning) = self.instance.take_deep() {
            let long = S::Watch::IS_PRESENT && matches!(warning, Warning::Unstable { .. });
            self.warn(function, if long { UNSTABLE } else { DEEP }, &warning);
        }
        if let Some(warning) = self.instance.find_fast() {
            self.warn(function, FAST, &warning);
        }
    }

    /// Warns of a master that applies the force in another order than the scene is made for.
    pub fn warn_of_wiring(&mut self, function: Function) {
        if let Some(warning) = self.instance.take_miswired() {
            self.warn(function, MISWIRED, &warning);
        }
    }

    /// Warns that the passivity guard acts, if there is one and it does.
    pub fn warn_of_guard(&mut self, function: Function) {
        // a look at every contact, for nothing if there has been a warning
        if S::GUARD.is_some() && self.categories & GUARD != 0 && self.instance.is_held_back() {
            self.warn(function, GUARD, &Warning::Guarded);
        }
    }

    /// Logs a warning once.
    #[inline(never)]
    fn warn(&mut self, function: Function, bit: u8, warning: &Warning) {
        if self.categories & bit != 0 {
            self.categories &= !bit;
            let mut text = Text::new();
            describe_warning::<S>(begin(&mut text, function.name()), warning);
            // SAFETY: the name ends with 0.
            unsafe { self.logger.send(self.name(), &text, Category::Warning) };
        }
    }

    /// Logs why `function` refuses a call and gives the status to return; an error ends the simulation.
    #[cold]
    #[inline(never)]
    fn refuse(&mut self, function: Function, complaint: &Complaint) -> fmi2Status {
        let category = Category::of(complaint);
        if category == Category::Error {
            self.instance.fail();
        }
        if category != Category::Discard || self.categories & DISCARD != 0 {
            // SAFETY: the name ends with 0.
            unsafe { self.logger.log::<S>(self.name(), function.name(), complaint) };
        }
        category.status()
    }
}

/// The guard: refuses a null component and a call out of order, runs `body`, and turns a complaint into a status.
///
/// # Safety
/// `c` is null, or came from fmi2Instantiate, was not freed, and no other call is using it.
///
/// The functions that are called in every step look for the plain case before they come here; what they find to be
/// anything else is repeated here with every check and its message.
pub unsafe fn call<S: Scene>(
    c: fmi2Component,
    function: Function,
    body: impl FnOnce(&mut Component<S>) -> Result<(), Complaint>,
) -> fmi2Status {
    // SAFETY: as the caller promises.
    let Some(component) = (unsafe { opened::<S>(c, function) }) else { return fmi2Error };
    match body(component) {
        Ok(()) => fmi2OK,
        Err(complaint) => component.refuse(function, &complaint),
    }
}

/// The component, if it is there and the call is in order; otherwise that is logged.
///
/// # Safety
/// As for [`call`].
#[inline(never)]
unsafe fn opened<'a, S: Scene>(c: fmi2Component, function: Function) -> Option<&'a mut Component<S>> {
    // SAFETY: as the caller promises.
    let component = unsafe { Component::<S>::behind(c) }?;
    let phase = component.instance.phase();
    if function.is_allowed_in(phase) {
        return Some(component);
    }
    component.refuse(function, &Complaint::OutOfOrder { phase });
    None
}

/// The array of `length` elements at `pointer`.
///
/// # Errors
/// [`Complaint::NullPointer`] if it is null and not empty.
///
/// # Safety
/// A pointer that isn't null points to `length` initialized elements that nothing writes to meanwhile.
#[inline]
pub unsafe fn array<'a, T>(pointer: *const T, length: usize, argument: &'static str) -> Result<&'a [T], Complaint> {
    if length == 0 {
        Ok(&[])
    } else if pointer.is_null() {
        Err(Complaint::NullPointer { argument })
    } else {
        // SAFETY: as the caller promises.
        Ok(unsafe { core::slice::from_raw_parts(pointer, length) })
    }
}

/// The array of `length` elements at `pointer`, to be written to.
///
/// # Errors
/// As for [`fn@array`].
///
/// # Safety
/// As for [`fn@array`], and nothing else uses the elements meanwhile.
#[inline]
pub unsafe fn array_mut<'a, T>(
    pointer: *mut T,
    length: usize,
    argument: &'static str,
) -> Result<&'a mut [T], Complaint> {
    if length == 0 {
        Ok(&mut [])
    } else if pointer.is_null() {
        Err(Complaint::NullPointer { argument })
    } else {
        // SAFETY: as the caller promises.
        Ok(unsafe { core::slice::from_raw_parts_mut(pointer, length) })
    }
}

/// The object at `pointer`, to be written to.
///
/// # Errors
/// [`Complaint::NullPointer`] if it is null.
///
/// # Safety
/// A pointer that isn't null points to an object that nothing else uses meanwhile.
#[inline]
pub unsafe fn object<'a, T>(pointer: *mut T, argument: &'static str) -> Result<&'a mut T, Complaint> {
    // SAFETY: as the caller promises.
    unsafe { pointer.as_mut() }.ok_or(Complaint::NullPointer { argument })
}
