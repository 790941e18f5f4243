//! The table of allowed calls of section 4.2.4 of FMI 2.0, as data: all functions in every state of an instance.
//!
//! SAFETY of all calls: the component lives, and arrays have as many elements as announced.

use crate::importer::{ERROR, Importer, OK, Phase, STEP, callbacks, functions};
use brinell_fmu::fmi2::abi::*;
use std::ffi::{CStr, c_int};
use std::ptr::{null, null_mut};

/// The answer to a call that is correct except for its order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// fmi2OK, and no message.
    Accepted,
    /// fmi2Discard, and a message of that category: the information doesn't exist.
    Discarded,
    /// fmi2Error, a message, and the state after an error.
    Refused,
}

/// A function.
pub struct Row {
    pub function: &'static str,
    /// The answers in the states instantiated, Initialization Mode, step complete, terminated, error: `+` accepted, `d`
    /// discarded, `-` refused.
    answers: &'static str,
    /// The state after an accepted call, if it differs.
    pub then: Option<Phase>,
    /// A call with good arguments.
    pub call: fn(&mut Importer) -> c_int,
}

impl Row {
    pub fn answer_in(&self, phase: Phase) -> Answer {
        match self.answers.as_bytes()[phase as usize] {
            b'+' => Answer::Accepted,
            b'd' => Answer::Discarded,
            b'-' => Answer::Refused,
            other => panic!("{} has no answer {other}", self.function),
        }
    }
}

const fn row(function: &'static str, answers: &'static str, call: fn(&mut Importer) -> c_int) -> Row {
    Row { function, answers, then: None, call }
}

const fn leading(function: &'static str, answers: &'static str, then: Phase, call: fn(&mut Importer) -> c_int) -> Row {
    Row { function, answers, then: Some(then), call }
}

/// Not in the table of the standard, and accepted here, as importers do it and it does no harm: fmi2Terminate of an
/// instance that was never initialized, and a second one.
pub const ROWS: [Row; 44] = [
    row("fmi2GetTypesPlatform", "+++++", |i| text(unsafe { (i.f().get_types_platform)() }, "default")),
    row("fmi2GetVersion", "+++++", |i| text(unsafe { (i.f().get_version)() }, "2.0")),
    row("fmi2SetDebugLogging", "+++++", |i| i.log(true, &[])),
    row("fmi2Instantiate", "+++++", another),
    leading("fmi2FreeInstance", "+++++", Phase::Instantiated, renew),
    row("fmi2SetupExperiment", "+----", |i| i.setup(0.0, Some(1.0))),
    leading("fmi2EnterInitializationMode", "+----", Phase::Initialization, enter),
    leading("fmi2ExitInitializationMode", "-+---", Phase::StepComplete, |i| i.exit()),
    row("fmi2Terminate", "+-++-", |i| i.terminate()),
    leading("fmi2Reset", "+++++", Phase::Instantiated, |i| i.reset()),
    row("fmi2GetReal", "-++++", |i| i.get(&[i.face.outputs[0]], &mut [0.0])),
    row("fmi2GetInteger", "-++++", |i| {
        let references: Vec<u32> = i.face.integers.iter().copied().take(1).collect();
        i.get_integers(&references, &mut vec![0; references.len()])
    }),
    // there are no Boolean and String variables, and no Integer that can be set: the empty array is right
    row("fmi2GetBoolean", "-++++", |i| unsafe { (i.f().get_boolean)(i.c, null(), 0, null_mut()) }),
    row("fmi2GetString", "-++++", |i| unsafe { (i.f().get_string)(i.c, null(), 0, null_mut()) }),
    row("fmi2SetReal", "+++--", |i| i.set(&[i.face.inputs[0]], &[1e-3])),
    row("fmi2SetInteger", "+++--", |i| unsafe { (i.f().set_integer)(i.c, null(), 0, null()) }),
    row("fmi2SetBoolean", "+++--", |i| unsafe { (i.f().set_boolean)(i.c, null(), 0, null()) }),
    row("fmi2SetString", "+++--", |i| unsafe { (i.f().set_string)(i.c, null(), 0, null()) }),
    row("fmi2GetFMUstate", "+++++", |i| with_state(i, |_, _| OK)),
    row("fmi2SetFMUstate", "+++++", |i| with_state(i, |i, state| i.restore(state))),
    row("fmi2FreeFMUstate", "+++++", |i| unsafe { (i.f().free_fmu_state)(i.c, &mut null_mut()) }),
    row("fmi2SerializedFMUstateSize", "+++++", |i| {
        with_state(i, |i, state| unsafe { (i.f().serialized_fmu_state_size)(i.c, state, &mut 0) })
    }),
    row("fmi2SerializeFMUstate", "+++++", |i| {
        with_state(i, |i, state| if i.bytes(state).is_empty() { ERROR } else { OK })
    }),
    row("fmi2DeSerializeFMUstate", "+++++", |i| {
        with_state(i, |i, state| {
            let (status, state) = i.state_of(&i.bytes(state));
            i.free(state);
            status
        })
    }),
    row("fmi2GetDirectionalDerivative", "-++++", |i| {
        let (unknown, known) = (i.face.outputs[0], i.face.inputs[0]);
        unsafe { (i.f().get_directional_derivative)(i.c, &unknown, 1, &known, 1, &1.0, &mut 0.0) }
    }),
    // the FMUs whose inputs have no derivatives accept the empty array
    row("fmi2SetRealInputDerivatives", "+++--", |i| {
        let count = usize::from(i.face.capability("canInterpolateInputs") == "true");
        let input = i.face.inputs[0];
        unsafe { (i.f().set_real_input_derivatives)(i.c, &input, count, &1, &1.0) }
    }),
    row("fmi2GetRealOutputDerivatives", "--+++", |i| {
        let output = i.face.outputs[0];
        unsafe { (i.f().get_real_output_derivatives)(i.c, &output, 1, &1, &mut 0.0) }
    }),
    row("fmi2DoStep", "--+--", |i| i.step(i.time, STEP)),
    // no step is ever in progress
    row("fmi2CancelStep", "-----", |i| unsafe { (i.f().cancel_step)(i.c) }),
    row("fmi2GetStatus", "--+++", |i| {
        let mut answer = ERROR;
        unsafe { (i.f().get_status)(i.c, 0, &mut answer) }.max(answer)
    }),
    row("fmi2GetRealStatus", "--+++", |i| i.real_status(2).0),
    row("fmi2GetIntegerStatus", "--ddd", |i| unsafe { (i.f().get_integer_status)(i.c, 2, &mut 0) }),
    row("fmi2GetBooleanStatus", "--+++", |i| unsafe { (i.f().get_boolean_status)(i.c, 3, &mut 0) }),
    row("fmi2GetStringStatus", "--ddd", |i| unsafe { (i.f().get_string_status)(i.c, 1, &mut null()) }),
    // there is no Model Exchange
    row("fmi2EnterEventMode", "-----", |i| unsafe { (i.f().enter_event_mode)(i.c) }),
    row("fmi2NewDiscreteStates", "-----", |i| unsafe { (i.f().new_discrete_states)(i.c, null_mut()) }),
    row("fmi2EnterContinuousTimeMode", "-----", |i| unsafe { (i.f().enter_continuous_time_mode)(i.c) }),
    row("fmi2CompletedIntegratorStep", "-----", |i| unsafe {
        (i.f().completed_integrator_step)(i.c, 1, &mut 0, &mut 0)
    }),
    row("fmi2SetTime", "-----", |i| unsafe { (i.f().set_time)(i.c, i.time) }),
    row("fmi2SetContinuousStates", "-----", |i| unsafe { (i.f().set_continuous_states)(i.c, null(), 0) }),
    row("fmi2GetDerivatives", "-----", |i| unsafe { (i.f().get_derivatives)(i.c, null_mut(), 0) }),
    row("fmi2GetEventIndicators", "-----", |i| unsafe { (i.f().get_event_indicators)(i.c, null_mut(), 0) }),
    row("fmi2GetContinuousStates", "-----", |i| unsafe { (i.f().get_continuous_states)(i.c, null_mut(), 0) }),
    row("fmi2GetNominalsOfContinuousStates", "-----", |i| unsafe {
        (i.f().get_nominals_of_continuous_states)(i.c, null_mut(), 0)
    }),
];

fn text(pointer: *const fmi2Char, expected: &str) -> c_int {
    // SAFETY: a constant of the library, which ends with 0
    if unsafe { CStr::from_ptr(pointer) }.to_bytes() == expected.as_bytes() { OK } else { ERROR }
}

/// A second instance beside the first.
fn another(i: &mut Importer) -> c_int {
    drop(Importer::new(i.face));
    OK
}

/// The instance is freed, and another takes its place.
fn renew(i: &mut Importer) -> c_int {
    let callbacks = callbacks(i.face, &i.log);
    // SAFETY: the old component is not used again
    unsafe {
        (i.f().free_instance)(i.c);
        i.c = (functions(i.face).instantiate)(
            c"again".as_ptr(),
            1,
            i.face.guid.as_ptr(),
            null(),
            &raw const callbacks,
            0,
            1,
        );
    }
    if i.c.is_null() { ERROR } else { OK }
}

/// Initialization needs an experiment; in other states than instantiated, fmi2EnterInitializationMode is called alone.
fn enter(i: &mut Importer) -> c_int {
    let is_new = i.get(&[i.face.outputs[0]], &mut [0.0]) == ERROR;
    if !is_new {
        return i.enter();
    }
    // the question above was an error
    assert_eq!(i.reset(), OK);
    i.messages();
    assert_eq!(i.setup(0.0, None), OK);
    i.enter()
}

/// A call with a state of the instance, which is freed afterwards.
fn with_state(i: &mut Importer, call: impl FnOnce(&Importer, fmi2FMUstate) -> c_int) -> c_int {
    let state = i.save();
    let status = call(i, state);
    i.free(state);
    status
}
