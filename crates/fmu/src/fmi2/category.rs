//! The categories of log messages, and the bits for the categories that are logged.

use super::abi::{fmi2Discard, fmi2Error, fmi2OK, fmi2Status, fmi2String, fmi2Warning};
use crate::c::complaint::Complaint;
use crate::c::text::is_same;
use core::ffi::CStr;

/// A category of log messages, as declared in the model description.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// `logStatusDiscard`
    Discard,
    /// `logStatusError`
    Error,
    /// `logStatusWarning`: something that the user should know; the call succeeds.
    Warning,
}

/// The bit of [`Category::Discard`] in the set of logged categories.
pub const DISCARD: u8 = 1;

/// The bit of [`Category::Error`], which has no effect because errors are always logged.
const ERROR: u8 = 2;

/// The bit of [`Warning::Guarded`](crate::instance::Warning::Guarded). Each warning is given once: its bit is then cleared
/// until the importer resets the instance or enables its category again.
pub const GUARD: u8 = 4;
/// The bit of [`Warning::Deep`](crate::instance::Warning::Deep).
pub const DEEP: u8 = 8;
/// The bit of [`Warning::Fast`](crate::instance::Warning::Fast).
pub const FAST: u8 = 16;

/// The bit of [`Warning::Miswired`](crate::instance::Warning::Miswired) and, in a scene that does not move its bodies, of
/// [`Warning::Late`](crate::instance::Warning::Late).
pub const MISWIRED: u8 = 32;
/// The bit of [`Warning::Unstable`](crate::instance::Warning::Unstable).
pub const UNSTABLE: u8 = 64;

/// The bit of warnings as such, which remains when one has been given.
pub const WARNING: u8 = 128;

/// The bits of [`Category::Warning`].
pub const WARNINGS: u8 = WARNING | GUARD | DEEP | FAST | MISWIRED | UNSTABLE;

impl Category {
    /// The name of the category in the model description.
    pub fn name(self) -> &'static CStr {
        match self {
            Category::Discard => c"logStatusDiscard",
            Category::Error => c"logStatusError",
            Category::Warning => c"logStatusWarning",
        }
    }

    /// The category of the message about a rejected call.
    pub fn of(complaint: &Complaint) -> Category {
        match complaint {
            Complaint::Unavailable => Category::Discard,
            Complaint::UnknownCategory => Category::Warning,
            _ => Category::Error,
        }
    }

    /// The status that the logger gets with such a message.
    pub fn status(self) -> fmi2Status {
        match self {
            Category::Discard => fmi2Discard,
            Category::Error => fmi2Error,
            Category::Warning => fmi2Warning,
        }
    }

    /// The status that a call with such a message returns.
    pub fn result(self) -> fmi2Status {
        match self {
            // many importers stop at any other status
            Category::Warning => fmi2OK,
            _ => self.status(),
        }
    }

    /// Whether messages of this category are logged if those with these `bits` are.
    pub fn is_logged(self, bits: u8) -> bool {
        match self {
            Category::Discard => bits & DISCARD != 0,
            Category::Error => true,
            Category::Warning => bits & WARNING != 0,
        }
    }

    /// The bits of the declared category `name`.
    ///
    /// # Safety
    /// `name` is null-terminated.
    pub unsafe fn bits(name: fmi2String) -> Option<u8> {
        // SAFETY: guaranteed by the caller.
        let is = |own: &str| unsafe { is_same(name, own.as_bytes()) };
        if is("logStatusDiscard") {
            Some(DISCARD)
        } else if is("logStatusError") {
            Some(ERROR)
        } else if is("logStatusWarning") {
            Some(WARNINGS)
        } else {
            is("logAll").then_some(ALL_CATEGORIES)
        }
    }
}

/// `logAll`
pub const ALL_CATEGORIES: u8 = DISCARD | ERROR | WARNINGS;
