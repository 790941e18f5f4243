//! A fault as status, log category and text: the one place where it becomes words.

use super::abi::{fmi2Discard, fmi2Error, fmi2Status};
use super::text::Text;
use crate::fault::Fault;
use crate::instance::Phase;
use crate::scene;
use core::ffi::CStr;

/// A category of log messages, as declared in the model description.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// `logStatusDiscard`
    Discard = 1,
    /// `logStatusError`
    Error = 2,
}

impl Category {
    /// The name of the category in the model description.
    pub fn name(self) -> &'static CStr {
        match self {
            Category::Discard => c"logStatusDiscard",
            Category::Error => c"logStatusError",
        }
    }

    /// The bits that the declared category `name` stands for.
    pub fn bits(name: &CStr) -> Option<u8> {
        match name.to_bytes() {
            b"logStatusDiscard" => Some(Category::Discard as u8),
            b"logStatusError" => Some(Category::Error as u8),
            b"logStatusWarning" if scene::GUARD.is_some() => Some(WARNING),
            b"logAll" => Some(ALL_CATEGORIES),
            _ => None,
        }
    }
}

/// `logStatusWarning`: what a unit with a passivity guard tells. It belongs to no fault, and units without guard haven't got it.
pub const WARNING: u8 = 4;

/// Its name in the model description.
pub const WARNING_NAME: &CStr = c"logStatusWarning";

/// `logAll`
pub const ALL_CATEGORIES: u8 =
    Category::Discard as u8 | Category::Error as u8 | if scene::GUARD.is_some() { WARNING } else { 0 };

/// How a fault is reported.
pub struct Report {
    /// What the call returns.
    pub status: fmi2Status,
    /// Where the message belongs.
    pub category: Category,
    /// The message.
    pub text: Text,
}

impl Report {
    /// The report of `fault` in the function `name`.
    pub fn new(name: &str, fault: &Fault) -> Report {
        let (status, category) = match fault {
            Fault::Unavailable => (fmi2Discard, Category::Discard),
            _ => (fmi2Error, Category::Error),
        };
        let mut text = Text::new();
        describe(text.string(name).string(": "), fault);
        Report { status, category, text }
    }
}

fn phase_name(phase: Phase) -> &'static str {
    match phase {
        Phase::Blank => "",
        Phase::Instantiated => "before initialization",
        Phase::Initialization => "in Initialization Mode",
        Phase::StepComplete => "after initialization",
        Phase::Terminated => "after fmi2Terminate",
        Phase::Error => "after an error; fmi2Reset, fmi2SetFMUstate and fmi2FreeInstance are",
    }
}

/// Names a contact, if there are several.
fn contact_name(text: &mut Text, contact: usize) -> &mut Text {
    if scene::CONTACTS == 1 {
        return text;
    }
    let group = scene::group(contact);
    let (name, counted) = scene::GROUP_NAMES.get(group).copied().unwrap_or(("contact", true));
    text.string(name);
    if counted {
        let first = group.checked_sub(1).map_or(0, scene::end);
        text.string("[").integer((contact + 1 - first) as u32).string("]");
    }
    text.string(": ")
}

fn describe(text: &mut Text, fault: &Fault) {
    match *fault {
        Fault::BadInstance { reason } => text.string(reason),
        Fault::OutOfOrder { phase } => text.string("not allowed ").string(phase_name(phase)),
        Fault::NullPointer { argument } => text.string("the argument ").string(argument).string(" is null"),
        Fault::UnknownReference { kind, reference } => text
            .string("there is no variable of type ")
            .string(kind)
            .string(" with value reference ")
            .integer(reference),
        Fault::NotSettable => text.string("an output can't be set"),
        Fault::FixedParameter { name } => {
            text.string("the parameter ").string(name).string(" can't be set after initialization")
        }
        Fault::NotFinite { name, value } => text.string(name).string(" = ").number(value).string(" is not finite"),
        Fault::TooFast { rate } => {
            text.string("indentation_rate = ").number(rate).string(" is too fast: the force would not be finite")
        }
        Fault::OutOfRange { settable, value } => text
            .string(settable.name)
            .string(" = ")
            .number(value)
            .string(" is out of range: allowed is ")
            .number(settable.minimum)
            .string(" to ")
            .number(settable.maximum)
            .string(if settable.unit.is_empty() { "" } else { " " })
            .string(settable.unit),
        Fault::NoPointContact { impactor, target } => text
            .string("impactor.radius = ")
            .number(impactor)
            .string(" m does not fit target.radius = ")
            .number(target)
            .string(" m: a socket (negative) must be wider than the impactor, and no radius is below 1e-12 m"),
        Fault::Experiment { start, stop } => text
            .string("startTime = ")
            .number(start)
            .string(" s, stopTime = ")
            .number(stop)
            .string(" s: allowed are finite times with stopTime not before startTime"),
        Fault::NoExperiment => text.string("fmi2SetupExperiment must be called before"),
        Fault::StepSize { step } => text
            .string("communicationStepSize = ")
            .number(step)
            .string(" s is not allowed: it must be positive and finite"),
        Fault::CommunicationPoint { given, expected } => text
            .string("currentCommunicationPoint = ")
            .number(given)
            .string(" s, but the last step ended at ")
            .number(expected)
            .string(" s"),
        Fault::BeyondStopTime { end, stop } => text
            .string("the step would end at ")
            .number(end)
            .string(" s, beyond the stop time ")
            .number(stop)
            .string(" s"),
        Fault::TooDeep { contact, indentation } => contact_name(text, contact)
            .string("the indentation would become ")
            .number(indentation)
            .string(" m, for which the law can't be evaluated; is indentation_rate in m/s?"),
        Fault::Unsupported => text.string("this unit doesn't have this capability (see its model description)"),
        Fault::Unavailable => text.string("not available: every step is complete when its call returns"),
        Fault::UnknownCategory => text.string(match scene::GUARD {
            None => "unknown log category: there are logStatusDiscard, logStatusError, logAll",
            Some(_) => "unknown log category: there are logStatusWarning, logStatusDiscard, logStatusError, logAll",
        }),
        Fault::BadState { reason } => text.string("the FMU state can't be used: ").string(reason),
        Fault::NoMemory => text.string("out of memory"),
    };
}
