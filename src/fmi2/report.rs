//! A fault as status, log category and text: the one place where it becomes words.

use super::abi::{fmi2Discard, fmi2Error, fmi2OK, fmi2Status};
use super::text::Text;
use crate::contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO};
use crate::fault::Fault;
use crate::instance::Phase;
use crate::scene;
use crate::variable::Settable;
use core::ffi::CStr;

/// A category of log messages, as declared in the model description.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// `logStatusDiscard`
    Discard,
    /// `logStatusError`
    Error,
    /// `logStatusWarning`: what a user should know of a simulation that goes on all the same.
    Warning,
}

/// The bit of [`Category::Discard`] among those that are logged.
pub const DISCARD: u8 = 1;

/// That of [`Category::Error`], which has no effect.
const ERROR: u8 = 2;

/// The bit of [`Fault::Guarded`]. Each warning is told once: then its bit is off, until the importer switches its category on again.
pub const GUARD: u8 = 4;
/// The bit of [`Fault::Deep`].
pub const DEEP: u8 = 8;
/// The bit of [`Fault::Fast`].
pub const FAST: u8 = 16;

/// Those of [`Category::Warning`].
const WARNINGS: u8 = GUARD | DEEP | FAST;

impl Category {
    /// The name of the category in the model description.
    pub fn name(self) -> &'static CStr {
        match self {
            Category::Discard => c"logStatusDiscard",
            Category::Error => c"logStatusError",
            Category::Warning => c"logStatusWarning",
        }
    }

    /// Where the message about `fault` belongs.
    pub fn of(fault: &Fault) -> Category {
        match fault {
            Fault::Unavailable => Category::Discard,
            Fault::Guarded | Fault::Deep { .. } | Fault::Fast { .. } => Category::Warning,
            _ => Category::Error,
        }
    }

    /// What a call returns with such a message.
    pub fn status(self) -> fmi2Status {
        match self {
            Category::Discard => fmi2Discard,
            Category::Error => fmi2Error,
            // many an importer stops at any other status
            Category::Warning => fmi2OK,
        }
    }

    /// The bits that the declared category `name` stands for.
    pub fn bits(name: &CStr) -> Option<u8> {
        let name = name.to_bytes();
        let known = [
            (Category::Discard.name(), DISCARD),
            (Category::Error.name(), ERROR),
            (Category::Warning.name(), WARNINGS),
            (c"logAll", ALL_CATEGORIES),
        ];
        known.into_iter().find(|(own, _)| own.to_bytes() == name).map(|(_, bits)| bits)
    }
}

/// `logAll`
pub const ALL_CATEGORIES: u8 = DISCARD | ERROR | WARNINGS;

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

/// The text below says them.
const _: () = assert!(LARGEST_RADIUS_RATIO == 0.3 && LARGEST_SPEED_RATIO == 0.01);

/// Writes what `fault` is.
pub fn describe(text: &mut Text, fault: &Fault) {
    let (mut words, mut numbers) = ([""; 2], [0.0; 3]);
    let mut of = None;
    let template = match *fault {
        Fault::BadInstance { reason } => {
            words[0] = reason;
            "@"
        }
        Fault::OutOfOrder { phase } => {
            words[0] = phase_name(phase);
            "not allowed @"
        }
        Fault::NullPointer { argument } => {
            words[0] = argument;
            "the argument @ is null"
        }
        Fault::UnknownReference { kind, reference } => {
            // a number is written with nine digits, and this may have ten
            text.string("there is no variable of type ")
                .string(kind)
                .string(" with value reference ")
                .integer(reference);
            return;
        }
        Fault::NotSettable => "an output can't be set",
        Fault::FixedParameter { name } => {
            words[0] = name;
            "the parameter @ can't be set after initialization"
        }
        Fault::NotFinite { name, value } => {
            (words[0], numbers[0]) = (name, value);
            "@ = ~ is not finite"
        }
        Fault::TooFast { rate } => {
            numbers[0] = rate;
            "indentation_rate = ~ is too fast: the force would not be finite"
        }
        Fault::OutOfRange { settable, value } => {
            let Settable { name, unit, minimum, maximum, .. } = *settable;
            (words, numbers) = ([name, unit], [value, minimum, maximum]);
            if unit.is_empty() {
                "@ = ~ is out of range: allowed is ~ to ~"
            } else {
                "@ = ~ is out of range: allowed is ~ to ~ @"
            }
        }
        Fault::NoPointContact { impactor, target } => {
            (numbers[0], numbers[1]) = (impactor, target);
            "impactor.radius = ~ m does not fit target.radius = ~ m: a socket (negative) must be wider than the impactor, \
             and no radius is below 1e-12 m"
        }
        Fault::Experiment { start, stop } => {
            (numbers[0], numbers[1]) = (start, stop);
            "startTime = ~ s, stopTime = ~ s: allowed are finite times with stopTime not before startTime"
        }
        Fault::NoExperiment => "fmi2SetupExperiment must be called before",
        Fault::StepSize { step } => {
            numbers[0] = step;
            "communicationStepSize = ~ s is not allowed: it must be positive and finite"
        }
        Fault::CommunicationPoint { given, expected } => {
            (numbers[0], numbers[1]) = (given, expected);
            "currentCommunicationPoint = ~ s, but the last step ended at ~ s"
        }
        Fault::BeyondStopTime { end, stop } => {
            (numbers[0], numbers[1]) = (end, stop);
            "the step would end at ~ s, beyond the stop time ~ s"
        }
        Fault::TooDeep { contact, indentation } => {
            of = Some(contact);
            numbers[0] = indentation;
            "the indentation would become ~ m, for which the law can't be evaluated; is indentation_rate in m/s?"
        }
        Fault::DerivativeOrder { order, largest } => {
            numbers[0] = f64::from(order);
            if largest > 1 {
                "there is no derivative of order ~: allowed is 1 or 2"
            } else {
                "there is no derivative of order ~: allowed is 1"
            }
        }
        Fault::NoDerivative { of } => {
            words[0] = of;
            "there are derivatives of @ only"
        }
        Fault::TooLong { step } => {
            numbers[0] = step;
            "the bodies rebound too often to be followed within communicationStepSize = ~ s"
        }
        Fault::Unsupported => "this unit doesn't have this capability (see its model description)",
        Fault::Unavailable => "not available: every step is complete when its call returns",
        Fault::UnknownCategory => {
            "unknown log category: there are logStatusWarning, logStatusDiscard, logStatusError, logAll"
        }
        Fault::BadState { reason } => {
            words[0] = reason;
            "the FMU state can't be used: @"
        }
        Fault::NoMemory => "out of memory",
        Fault::Guarded => {
            words[0] = scene::GUARD.unwrap_or("");
            "@"
        }
        Fault::Deep { contact, indentation, allowed } => {
            of = Some(contact as usize);
            (numbers[0], numbers[1]) = (indentation, allowed);
            "at an indentation of ~ m the contact radius is above 0.3 effective radii: the law is valid up to ~ m"
        }
        Fault::Fast { contact, rate, allowed } => {
            of = Some(contact as usize);
            (numbers[0], numbers[1]) = (rate, allowed);
            "indentation_rate = ~ m/s is above 0.01 of the wave speed: the law is valid up to ~ m/s"
        }
    };
    if let Some(contact) = of {
        contact_name(text, contact);
    }
    fill(text, template, words, numbers);
}
