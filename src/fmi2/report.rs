//! A fault as status, log category and text: the one place where it becomes words.

use super::abi::{fmi2Discard, fmi2Error, fmi2Status};
use super::text::Text;
use crate::fault::Fault;
use crate::instance::Phase;
use crate::scene;
use crate::variable::Settable;
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

/// Writes `template` with the next of `words` in place of each `@`, and the next of `numbers` in place of each `~`.
#[inline(never)]
fn fill(text: &mut Text, template: &str, words: [&str; 2], numbers: [f64; 3]) {
    let (mut words, mut numbers) = (words.iter(), numbers.iter());
    for &byte in template.as_bytes() {
        match byte {
            b'@' => text.string(words.next().copied().unwrap_or("")),
            b'~' => text.number(numbers.next().copied().unwrap_or(f64::NAN)),
            plain => text.byte(plain),
        };
    }
}

fn describe(text: &mut Text, fault: &Fault) {
    const NO_WORDS: [&str; 2] = [""; 2];
    const NO_NUMBERS: [f64; 3] = [0.0; 3];
    let (template, words, numbers) = match *fault {
        Fault::BadInstance { reason } => ("@", [reason, ""], NO_NUMBERS),
        Fault::OutOfOrder { phase } => ("not allowed @", [phase_name(phase), ""], NO_NUMBERS),
        Fault::NullPointer { argument } => ("the argument @ is null", [argument, ""], NO_NUMBERS),
        Fault::UnknownReference { kind, reference } => {
            // a number of up to ten digits
            text.string("there is no variable of type ")
                .string(kind)
                .string(" with value reference ")
                .integer(reference);
            return;
        }
        Fault::NotSettable => ("an output can't be set", NO_WORDS, NO_NUMBERS),
        Fault::FixedParameter { name } => ("the parameter @ can't be set after initialization", [name, ""], NO_NUMBERS),
        Fault::NotFinite { name, value } => ("@ = ~ is not finite", [name, ""], [value, 0.0, 0.0]),
        Fault::TooFast { rate } => {
            ("indentation_rate = ~ is too fast: the force would not be finite", NO_WORDS, [rate, 0.0, 0.0])
        }
        Fault::OutOfRange { settable, value } => {
            let Settable { name, unit, minimum, maximum, .. } = *settable;
            let template = if unit.is_empty() {
                "@ = ~ is out of range: allowed is ~ to ~"
            } else {
                "@ = ~ is out of range: allowed is ~ to ~ @"
            };
            (template, [name, unit], [value, minimum, maximum])
        }
        Fault::NoPointContact { impactor, target } => (
            "impactor.radius = ~ m does not fit target.radius = ~ m: a socket (negative) must be wider than the impactor, \
             and no radius is below 1e-12 m",
            NO_WORDS,
            [impactor, target, 0.0],
        ),
        Fault::Experiment { start, stop } => (
            "startTime = ~ s, stopTime = ~ s: allowed are finite times with stopTime not before startTime",
            NO_WORDS,
            [start, stop, 0.0],
        ),
        Fault::NoExperiment => ("fmi2SetupExperiment must be called before", NO_WORDS, NO_NUMBERS),
        Fault::StepSize { step } => {
            ("communicationStepSize = ~ s is not allowed: it must be positive and finite", NO_WORDS, [step, 0.0, 0.0])
        }
        Fault::CommunicationPoint { given, expected } => {
            ("currentCommunicationPoint = ~ s, but the last step ended at ~ s", NO_WORDS, [given, expected, 0.0])
        }
        Fault::BeyondStopTime { end, stop } => {
            ("the step would end at ~ s, beyond the stop time ~ s", NO_WORDS, [end, stop, 0.0])
        }
        Fault::TooDeep { contact, indentation } => {
            contact_name(text, contact);
            (
                "the indentation would become ~ m, for which the law can't be evaluated; is indentation_rate in m/s?",
                NO_WORDS,
                [indentation, 0.0, 0.0],
            )
        }
        Fault::Unsupported => {
            ("this unit doesn't have this capability (see its model description)", NO_WORDS, NO_NUMBERS)
        }
        Fault::Unavailable => ("not available: every step is complete when its call returns", NO_WORDS, NO_NUMBERS),
        Fault::UnknownCategory => (
            match scene::GUARD {
                None => "unknown log category: there are logStatusDiscard, logStatusError, logAll",
                Some(_) => "unknown log category: there are logStatusWarning, logStatusDiscard, logStatusError, logAll",
            },
            NO_WORDS,
            NO_NUMBERS,
        ),
        Fault::BadState { reason } => ("the FMU state can't be used: @", [reason, ""], NO_NUMBERS),
        Fault::NoMemory => ("out of memory", NO_WORDS, NO_NUMBERS),
    };
    fill(text, template, words, numbers);
}
