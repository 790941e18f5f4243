//! The texts of rejected calls and warnings; all of them are here.

use crate::c::complaint::Complaint;
use crate::c::text::Text;
use crate::instance::{Cause, FASTEST, Fault, LATEST, MASSES, Phase, SWIFTEST, Warning};
use crate::scene::{Coupling, Presence, Real, Scene, Settable};
use brinell_contact::Contact;
use brinell_contact::shared::NotInverseMasses;
use brinell_contact::validity::{LARGEST_RADIUS_RATIO, LARGEST_SPEED_RATIO};

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

/// Writes the name of a contact, if there are several.
fn contact_name<S: Scene>(text: &mut Text, contact: usize) -> &mut Text {
    if S::contacts() == 1 {
        return text;
    }
    let (name, number) = S::contact_name(contact);
    text.bytes(name);
    if number != 0 {
        text.string("[").integer(number as u32).string("]");
    }
    text.string(": ")
}

/// Writes `template`, replacing each `@` by the next of `words` and each `~` by the next of `numbers`.
#[inline(never)]
fn fill(text: &mut Text, template: &str, words: [&[u8]; 2], numbers: [f64; 3]) {
    let (mut words, mut numbers) = (words.iter(), numbers.iter());
    for &byte in template.as_bytes() {
        match byte {
            b'@' => text.bytes(words.next().copied().unwrap_or_default()),
            b'~' => text.number(numbers.next().copied().unwrap_or(f64::NAN)),
            plain => text.byte(plain),
        };
    }
}

/// The texts below contain these numbers.
const _: () = assert!(LARGEST_RADIUS_RATIO == 0.3 && LARGEST_SPEED_RATIO == 0.01);
const _: () = assert!(*MASSES.start() == 1e-30 && *MASSES.end() == 1e30);

/// The parts of a message: a template with words and numbers, and the contact that it is about.
///
/// It is filled field by field. A complete value for each case would double the code size.
struct Message {
    template: &'static str,
    words: [&'static [u8]; 2],
    numbers: [f64; 3],
    contact: Option<usize>,
}

impl Message {
    const BLANK: Message = Message { template: "", words: [b""; 2], numbers: [0.0; 3], contact: None };

    fn write<S: Scene>(&self, text: &mut Text) {
        if let Some(contact) = self.contact {
            contact_name::<S>(text, contact);
        }
        fill(text, self.template, self.words, self.numbers);
    }
}

/// The contact that a fault concerns; `None` if it concerns all.
fn contact_of<S: Scene>(fault: Fault) -> Option<usize> {
    match fault {
        Fault::NoPointContact { contact, .. }
        | Fault::TooDeep { contact, .. }
        | Fault::TooLong { contact, .. }
        | Fault::TooWide { contact, .. }
        | Fault::UnknownMass { contact } => Some(contact),
        Fault::FixedParameter { index } | Fault::OutOfRange { index, .. } => S::settable(index)?.1,
        _ => None,
    }
}

/// Writes why a call is rejected.
pub fn describe<S: Scene>(text: &mut Text, complaint: &Complaint) {
    let mut message = Message::BLANK;
    message.template = match *complaint {
        Complaint::Instance(fault) => {
            if S::contacts() > 1 {
                message.contact = contact_of::<S>(fault);
            }
            describe_fault::<S>(&mut message, fault)
        }
        Complaint::BadInstance { reason } => reason,
        Complaint::OutOfOrder { phase } => {
            message.words[0] = phase_name(phase).as_bytes();
            "not allowed @"
        }
        Complaint::NullPointer { argument } => {
            message.words[0] = argument.as_bytes();
            "the argument @ is null"
        }
        Complaint::UnknownReference { kind, reference } => {
            // numbers are written with nine digits, and a reference may have ten
            text.string("there is no variable of type ")
                .string(kind)
                .string(" with value reference ")
                .integer(reference);
            return;
        }
        Complaint::Unsupported => "this FMU doesn't have this capability (see its model description)",
        Complaint::Unavailable => "not available: every step is complete when its call returns",
        Complaint::UnknownCategory => {
            "unknown log category: there are logStatusWarning, logStatusDiscard, logStatusError, logAll"
        }
        Complaint::BadState { reason } => {
            message.words[0] = reason.as_bytes();
            "the FMU state can't be used: @"
        }
        Complaint::NoMemory => "out of memory",
    };
    message.write::<S>(text);
}

/// The template for `fault`. Its words and numbers are stored in `message`.
#[inline]
fn describe_fault<S: Scene>(message: &mut Message, fault: Fault) -> &'static str {
    let Message { words, numbers, .. } = message;
    match fault {
        Fault::NotSettable => "an output can't be set",
        Fault::FixedParameter { index } => {
            words[0] = S::settable(index).map_or(b"", |(settable, _)| settable.name);
            "the parameter @ can't be set after initialization"
        }
        Fault::NotFinite { name, value } => {
            (words[0], numbers[0]) = (name.as_bytes(), value);
            "@ = ~ is not finite"
        }
        Fault::RateOutOfRange { rate } => {
            *numbers = [rate, -FASTEST, FASTEST];
            "indentation_rate = ~ is out of range: allowed is ~ to ~ m/s"
        }
        Fault::AccelerationOutOfRange { name, unit, value } => {
            (*words, *numbers) = ([name.as_bytes(), unit.as_bytes()], [value, -SWIFTEST, SWIFTEST]);
            "@ = ~ is out of range: allowed is ~ to ~ @"
        }
        Fault::UnknownMass { .. } if !<S::Coupling as Coupling>::Mass::IS_PRESENT => "",
        Fault::UnknownMass { .. } => {
            "effective_mass = 0 kg: it isn't known yet; set it to a value from 1e-30 to 1e30 kg before the first step"
        }
        Fault::TooFast { rate } => {
            numbers[0] = rate;
            "indentation_rate = ~ is too fast: the force would not be finite"
        }
        Fault::OutOfRange { index, value } => {
            let Some((settable, _)) = S::settable(index) else { return "" };
            let Settable { name, unit, minimum, maximum } = settable;
            (*words, *numbers) = ([name, unit], [value, minimum, maximum]);
            if unit.is_empty() {
                "@ = ~ is out of range: allowed is ~ to ~"
            } else {
                "@ = ~ is out of range: allowed is ~ to ~ @"
            }
        }
        // a library contains no text for features that its scene lacks
        Fault::InputOutOfRange { .. } if !(<S::Coupling as Coupling>::Mass::IS_PRESENT || S::Contact::HAS_FRICTION) => {
            ""
        }
        Fault::InputOutOfRange { input, value } if S::Contact::HAS_FRICTION && input.tangential_rate().is_some() => {
            *numbers = [value, -FASTEST, FASTEST];
            "tangential_rate = ~ is out of range: allowed is ~ to ~ m/s, also within a step with input derivatives"
        }
        Fault::InputOutOfRange { value, .. } => {
            *numbers = [value, *MASSES.start(), *MASSES.end()];
            "effective_mass = ~ is out of range: allowed is ~ to ~ kg"
        }
        Fault::NoPointContact { impactor, target, .. } => {
            (numbers[0], numbers[1]) = (impactor, target);
            "impactor.radius = ~ m does not fit target.radius = ~ m: a socket (negative) must be wider than the impactor, \
             and no radius is below 1e-12 m"
        }
        Fault::Experiment { start, stop } => {
            *numbers = [start, stop, LATEST];
            "startTime = ~ s, stopTime = ~ s: allowed are finite times, a startTime up to ~ s, and a stopTime not before it"
        }
        Fault::NoExperiment => "fmi2SetupExperiment must be called before",
        Fault::StepSize { step, shortest } => {
            (numbers[0], numbers[1]) = (step, shortest);
            "communicationStepSize = ~ s is not allowed: it must be finite and above ~ s"
        }
        Fault::CommunicationPoint { given, expected } => {
            (numbers[0], numbers[1]) = (given, expected);
            "currentCommunicationPoint = ~ s, but the last step ended at ~ s"
        }
        Fault::BeyondStopTime { end, stop } => {
            (numbers[0], numbers[1]) = (end, stop);
            "the step would end at ~ s, beyond the stop time ~ s"
        }
        Fault::TooLate { end } => {
            (numbers[0], numbers[1]) = (end, LATEST);
            "the step would end at ~ s: allowed are times up to ~ s"
        }
        Fault::TooDeep { indentation, .. } => {
            numbers[0] = indentation;
            "the indentation would become ~ m, for which the law can't be evaluated; is indentation_rate in m/s?"
        }
        Fault::TooWide { size, .. } => {
            numbers[0] = size;
            "the contact radius has reached ~ m, the size of the smaller body: no contact law holds; is indentation_rate in m/s, and the step \
             short enough for the mass?"
        }
        Fault::TooLong { step, .. } => {
            numbers[0] = step;
            "the bodies rebound too often to be followed within communicationStepSize = ~ s"
        }
        Fault::TooLongTogether { .. } if !S::is_shared() => "",
        Fault::InverseMasses(_) if S::inverse_mass_inputs() == 0 => "",
        Fault::TooLongTogether { step, possible } => {
            (numbers[0], numbers[1]) = (step, possible);
            "the contacts touch, part and turn too often to be followed within communicationStepSize = ~ s: a step of ~ s is possible"
        }
        Fault::InverseMasses(NotInverseMasses::Entry { row, column, value }) => {
            *numbers = [row as f64 + 1.0, column as f64 + 1.0, value];
            if value == 0.0 {
                "inverse_mass[~,~] = ~ 1/kg: it isn't known yet; set all inputs inverse_mass before the first step"
            } else {
                "inverse_mass[~,~] = ~ is out of range: allowed is 1e-30 to 1e30 1/kg if both indices are the same, otherwise -1e30 to \
                 1e30 1/kg; set all of them before the step"
            }
        }
        // there is one for every two contacts
        Fault::InverseMasses(NotInverseMasses::Count { .. }) => "",
        Fault::InverseMasses(NotInverseMasses::Indefinite { contact, with, .. }) => {
            (numbers[0], numbers[1]) = (contact as f64 + 1.0, with as f64 + 1.0);
            "the inputs inverse_mass are those of no bodies: contact number ~ is coupled too strongly, above all with number ~, for \
             their inverse masses (the matrix must be positive semidefinite)"
        }
        Fault::DerivativeOrder { order, largest } => {
            numbers[0] = f64::from(order);
            if S::derivatives() == 0 && largest == 0 {
                "outputs of this FMU have no derivatives: the indentation on a plate is not the distance of the bodies"
            } else if largest > 1 {
                "there is no derivative of order ~: allowed is 1 or 2"
            } else {
                "there is no derivative of order ~: allowed is 1"
            }
        }
        Fault::NoDerivative { of } => {
            words[0] = of.as_bytes();
            "only derivatives of @ exist"
        }
        Fault::DerivativeNotFinite => "the derivative is not finite",
        Fault::NotAnInput if S::Contact::HAS_FRICTION => {
            "only derivatives by indentation_rate and tangential_rate exist"
        }
        Fault::NotAnInput => "only derivatives by indentation_rate exist",
        Fault::NoInputDerivatives if S::has_input(Real::ExternalAcceleration) => {
            "inputs of this FMU have no derivatives: external_acceleration is the input for the acceleration"
        }
        Fault::NoInputDerivatives if S::follows_rate() => {
            "inputs of this FMU have no derivatives: its law depends on the rate"
        }
        Fault::NoInputDerivatives => "inputs of this FMU have no derivatives: its scene has input_derivatives = false",
    }
}

/// Writes a warning.
pub fn describe_warning<S: Scene>(text: &mut Text, warning: &Warning) {
    let mut message = Message::BLANK;
    message.words[0] = S::guard().map_or(&[][..], |guard| guard.words);
    message.template = match *warning {
        Warning::Deep { contact, indentation, allowed } => {
            message.contact = Some(contact);
            (message.numbers[0], message.numbers[1]) = (indentation, allowed);
            "at an indentation of ~ m the contact radius is above 0.3 effective radii, or 0.3 of the smaller body: the law is valid up to ~ m"
        }
        Warning::Fast { contact, rate, allowed } => {
            message.contact = Some(contact);
            (message.numbers[0], message.numbers[1]) = (rate, allowed);
            "indentation_rate = ~ m/s is above 0.01 of the wave speed: the law is valid up to ~ m/s"
        }
        Warning::Unstable { step, mass } if S::Watch::IS_PRESENT => {
            (message.numbers[0], message.numbers[1]) = (step, mass);
            "steps of ~ s are unstable with a mass of ~ kg: make them shorter, or let the unit move it by [coupling]"
        }
        Warning::Late if S::Watch::IS_PRESENT => {
            "the master applies the force one step late: connect predicted_force, or step the contact first and connect force"
        }
        // a library contains no text for features that its scene lacks
        _ if <S::Coupling as Coupling>::Ending::IS_PRESENT => miswired::<S>(&mut message, *warning),
        _ => GUARD,
    };
    message.write::<S>(text);
}

/// The template for what the passivity guard does.
const GUARD: &str = "@";

/// The template for an importer that does not move the bodies as the scene assumes, otherwise that of the passivity guard.
fn miswired<S: Scene>(message: &mut Message, warning: Warning) -> &'static str {
    let Warning::Miswired { contact, rate, expected, cause } = warning else { return GUARD };
    message.contact = Some(contact);
    (message.numbers[0], message.numbers[1]) = (rate, expected);
    match cause {
        Cause::Order { parallel: true } => {
            "indentation_rate = ~ m/s, expected ~ m/s: the master applies mean_force over the same step already; leave out \
             master = \"parallel\" under [coupling] in the scene"
        }
        Cause::Order { parallel: false } => {
            "indentation_rate = ~ m/s, expected ~ m/s: the master applies mean_force one step late; write \
             master = \"parallel\" under [coupling] in the scene"
        }
        Cause::Unmoved => {
            "indentation_rate = ~ m/s, expected ~ m/s: the rate does not follow mean_force at all; apply it to the bodies, or, for a \
             prescribed motion, leave out [coupling] in the scene"
        }
        Cause::Mass { moved, known } => {
            (message.numbers[0], message.numbers[1], message.numbers[2]) = (known / moved, moved, known);
            "the rate follows ~ times mean_force: the master moves a mass of ~ kg, the FMU one of ~ kg; give the same to both, or, if other \
             contacts push the body too, tables [[body]] in the scene"
        }
        // there is no other one
        Cause::Shared { .. } if S::contacts() == 1 => "",
        Cause::Shared { with } => {
            message.numbers[2] = with as f64 + 1.0;
            match () {
                () if S::inverse_mass_inputs() > 0 => {
                    "indentation_rate = ~ m/s, expected ~ m/s: the force of contact number ~ moves a body of this one otherwise than the \
                     inputs inverse_mass say; set them from the masses of the bodies"
                }
                () if S::is_shared() => {
                    "indentation_rate = ~ m/s, expected ~ m/s: the force of contact number ~ moves a body of this one otherwise than the \
                     tables [[body]] of the scene say"
                }
                () => {
                    "indentation_rate = ~ m/s, expected ~ m/s: the force of contact number ~ moves a body of this one, too, and this FMU \
                     moves the bodies of each contact alone; give tables [[body]] in the scene, and `between` in each [[contact]]"
                }
            }
        }
    }
}
