//! What an `fmi2Component` points to, and the guard that every call passes.

use super::abi::fmi2ComponentEnvironment;
use super::abi::{fmi2CallbackFunctions, fmi2CallbackLogger, fmi2Component, fmi2Error, fmi2OK, fmi2Status, fmi2String};
use super::order::Function;
use super::report::{Category, DEEP, DISCARD, FAST, GUARD, describe};
use super::text::Text;
use crate::fault::Fault;
use crate::instance::Instance;
use crate::scene;
use core::ffi::c_char;

/// An instance with what its importer gave it. The name of the instance follows it in memory.
#[repr(C)]
pub struct Component {
    /// The instance.
    pub instance: Instance,
    /// The importer's logger.
    pub logger: Logger,
    /// Categories that are logged; errors always are.
    pub categories: u8,
}

/// Where messages go.
#[derive(Clone, Copy)]
pub struct Logger {
    function: Option<fmi2CallbackLogger>,
    environment: fmi2ComponentEnvironment,
}

impl Logger {
    /// The logger among the importer's functions.
    pub fn of(callbacks: &fmi2CallbackFunctions) -> Logger {
        Logger { function: callbacks.logger, environment: callbacks.componentEnvironment }
    }

    /// Hands the message about `fault` in the function `name` to the importer; without logger it is lost.
    ///
    /// # Safety
    /// `instance_name` is a string that ends with 0.
    #[cold]
    #[inline(never)]
    pub unsafe fn log(&self, instance_name: fmi2String, name: &str, fault: &Fault, category: Category) {
        let Some(function) = self.function else { return };
        let mut text = Text::new();
        describe(text.string(name).string(": "), fault);
        // SAFETY: the importer's function, with strings that end with 0 and a format without commands.
        unsafe {
            function(self.environment, instance_name, category.status(), category.name().as_ptr(), text.as_ptr())
        };
    }
}

impl Component {
    /// The name of the instance, which lies behind the component.
    fn name(&self) -> fmi2String {
        // SAFETY: fmi2Instantiate allocates the component and the name behind it in one piece.
        unsafe { core::ptr::from_ref(self).add(1).cast::<c_char>() }
    }

    /// Tells that a contact is deeper or closes faster than its law is valid for, if one does.
    #[cold]
    #[inline(never)]
    pub fn warn_of_limits(&mut self, function: Function) {
        if let Some(warning) = self.instance.take_deep() {
            self.warn(function, DEEP, &warning);
        }
        if let Some(warning) = self.instance.find_fast() {
            self.warn(function, FAST, &warning);
        }
    }

    /// Tells that the passivity guard acts, if there is one and it does.
    pub fn warn_of_guard(&mut self, function: Function) {
        // a look at every contact, for nothing if it has been told
        if scene::GUARD.is_some() && self.categories & GUARD != 0 && self.instance.is_held_back() {
            self.warn(function, GUARD, &Fault::Guarded);
        }
    }

    /// Tells a warning once.
    #[inline(never)]
    fn warn(&mut self, function: Function, bit: u8, warning: &Fault) {
        if self.categories & bit != 0 {
            self.categories &= !bit;
            self.tell(function, warning);
        }
    }

    /// Logs `fault` of `function` and gives the status to return; an error ends the simulation.
    #[cold]
    #[inline(never)]
    fn tell(&mut self, function: Function, fault: &Fault) -> fmi2Status {
        let category = Category::of(fault);
        if category == Category::Error {
            self.instance.fail();
        }
        if category != Category::Discard || self.categories & DISCARD != 0 {
            // SAFETY: the name ends with 0.
            unsafe { self.logger.log(self.name(), function.name(), fault, category) };
        }
        category.status()
    }
}

/// The component behind the importer's pointer; none if that is null.
///
/// # Safety
/// As for [`call`].
#[inline(always)]
pub unsafe fn component<'a>(component: fmi2Component) -> Option<&'a mut Component> {
    // SAFETY: as the caller promises.
    unsafe { component.cast::<Component>().as_mut() }
}

/// The guard: refuses a null component and a call out of order, runs `body`, and turns a fault into a status.
///
/// # Safety
/// `c` is null, or came from fmi2Instantiate, was not freed, and no other call is using it.
///
/// The functions that are called in every step look for the plain case before they come here; what they find to be
/// anything else is repeated here with every check and its message.
pub unsafe fn call(
    c: fmi2Component,
    function: Function,
    body: impl FnOnce(&mut Component) -> Result<(), Fault>,
) -> fmi2Status {
    // SAFETY: as the caller promises.
    let Some(component) = (unsafe { opened(c, function) }) else { return fmi2Error };
    match body(component) {
        Ok(()) => fmi2OK,
        Err(fault) => component.tell(function, &fault),
    }
}

/// The component, if it is there and the call is in order; otherwise that is logged.
///
/// # Safety
/// As for [`call`].
#[inline(never)]
unsafe fn opened<'a>(c: fmi2Component, function: Function) -> Option<&'a mut Component> {
    // SAFETY: as the caller promises.
    let component = unsafe { component(c) }?;
    let phase = component.instance.phase();
    if function.is_allowed_in(phase) {
        return Some(component);
    }
    component.tell(function, &Fault::OutOfOrder { phase });
    None
}

/// The array of `length` elements at `pointer`.
///
/// # Errors
/// [`Fault::NullPointer`] if it is null and not empty.
///
/// # Safety
/// A pointer that isn't null points to `length` initialized elements that nothing writes to meanwhile.
#[inline]
pub unsafe fn array<'a, T>(pointer: *const T, length: usize, argument: &'static str) -> Result<&'a [T], Fault> {
    if length == 0 {
        Ok(&[])
    } else if pointer.is_null() {
        Err(Fault::NullPointer { argument })
    } else {
        // SAFETY: as the caller promises.
        Ok(unsafe { core::slice::from_raw_parts(pointer, length) })
    }
}

/// The array of `length` elements at `pointer`, to be written to.
///
/// # Errors
/// As for [`array`].
///
/// # Safety
/// As for [`array`], and nothing else uses the elements meanwhile.
#[inline]
pub unsafe fn array_mut<'a, T>(pointer: *mut T, length: usize, argument: &'static str) -> Result<&'a mut [T], Fault> {
    if length == 0 {
        Ok(&mut [])
    } else if pointer.is_null() {
        Err(Fault::NullPointer { argument })
    } else {
        // SAFETY: as the caller promises.
        Ok(unsafe { core::slice::from_raw_parts_mut(pointer, length) })
    }
}

/// The object at `pointer`, to be written to.
///
/// # Errors
/// [`Fault::NullPointer`] if it is null.
///
/// # Safety
/// A pointer that isn't null points to an object that nothing else uses meanwhile.
#[inline]
pub unsafe fn object<'a, T>(pointer: *mut T, argument: &'static str) -> Result<&'a mut T, Fault> {
    // SAFETY: as the caller promises.
    unsafe { pointer.as_mut() }.ok_or(Fault::NullPointer { argument })
}
