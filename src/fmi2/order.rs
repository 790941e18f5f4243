//! Which function may be called in which phase: the table of section 4.2.4 of FMI 2.0.5, as data.
//!
//! The states of an asynchronous step don't occur here: every step is complete when its call returns.

use crate::instance::Phase;

/// A function with its place in the order of calls.
pub struct Function {
    /// Its name, for messages.
    pub name: &'static str,
    phases: u8,
}

const INSTANTIATED: u8 = Phase::Instantiated as u8;
const INITIALIZATION: u8 = Phase::Initialization as u8;
const STEP: u8 = Phase::StepComplete as u8;
const TERMINATED: u8 = Phase::Terminated as u8;
const ERROR: u8 = Phase::Error as u8;

const ANY: u8 = INSTANTIATED | INITIALIZATION | STEP | TERMINATED | ERROR;
const READING: u8 = INITIALIZATION | STEP | TERMINATED | ERROR;
const WRITING: u8 = INSTANTIATED | INITIALIZATION | STEP;

impl Function {
    const fn new(name: &'static str, phases: u8) -> Function {
        Function { name, phases }
    }

    /// Whether it may be called in `phase`.
    #[inline]
    pub fn is_allowed_in(&self, phase: Phase) -> bool {
        self.phases & phase as u8 != 0
    }
}

pub(super) static SET_DEBUG_LOGGING: Function = Function::new("fmi2SetDebugLogging", ANY);
pub(super) static SETUP_EXPERIMENT: Function = Function::new("fmi2SetupExperiment", INSTANTIATED);
pub(super) static ENTER_INITIALIZATION_MODE: Function = Function::new("fmi2EnterInitializationMode", INSTANTIATED);
pub(super) static EXIT_INITIALIZATION_MODE: Function = Function::new("fmi2ExitInitializationMode", INITIALIZATION);
// wider than the table: importers terminate twice, or without having initialized, and nothing is lost by it
pub(super) static TERMINATE: Function = Function::new("fmi2Terminate", INSTANTIATED | STEP | TERMINATED);
pub(super) static RESET: Function = Function::new("fmi2Reset", ANY);
pub(super) static GET_REAL: Function = Function::new("fmi2GetReal", READING);
pub(super) static GET_INTEGER: Function = Function::new("fmi2GetInteger", READING);
pub(super) static GET_BOOLEAN: Function = Function::new("fmi2GetBoolean", READING);
pub(super) static GET_STRING: Function = Function::new("fmi2GetString", READING);
pub(super) static SET_REAL: Function = Function::new("fmi2SetReal", WRITING);
pub(super) static SET_INTEGER: Function = Function::new("fmi2SetInteger", WRITING);
pub(super) static SET_BOOLEAN: Function = Function::new("fmi2SetBoolean", WRITING);
pub(super) static SET_STRING: Function = Function::new("fmi2SetString", WRITING);
pub(super) static GET_FMU_STATE: Function = Function::new("fmi2GetFMUstate", ANY);
pub(super) static SET_FMU_STATE: Function = Function::new("fmi2SetFMUstate", ANY);
pub(super) static FREE_FMU_STATE: Function = Function::new("fmi2FreeFMUstate", ANY);
pub(super) static SERIALIZED_FMU_STATE_SIZE: Function = Function::new("fmi2SerializedFMUstateSize", ANY);
pub(super) static SERIALIZE_FMU_STATE: Function = Function::new("fmi2SerializeFMUstate", ANY);
pub(super) static DESERIALIZE_FMU_STATE: Function = Function::new("fmi2DeSerializeFMUstate", ANY);
pub(super) static GET_DIRECTIONAL_DERIVATIVE: Function = Function::new("fmi2GetDirectionalDerivative", READING);
pub(super) static SET_REAL_INPUT_DERIVATIVES: Function = Function::new("fmi2SetRealInputDerivatives", WRITING);
pub(super) static GET_REAL_OUTPUT_DERIVATIVES: Function =
    Function::new("fmi2GetRealOutputDerivatives", STEP | TERMINATED | ERROR);
pub(super) static DO_STEP: Function = Function::new("fmi2DoStep", STEP);
// no step is ever in progress
pub(super) static CANCEL_STEP: Function = Function::new("fmi2CancelStep", 0);
pub(super) static GET_STATUS: Function = Function::new("fmi2GetStatus", STEP | TERMINATED | ERROR);
pub(super) static GET_REAL_STATUS: Function = Function::new("fmi2GetRealStatus", STEP | TERMINATED | ERROR);
pub(super) static GET_INTEGER_STATUS: Function = Function::new("fmi2GetIntegerStatus", STEP | TERMINATED | ERROR);
pub(super) static GET_BOOLEAN_STATUS: Function = Function::new("fmi2GetBooleanStatus", STEP | TERMINATED | ERROR);
pub(super) static GET_STRING_STATUS: Function = Function::new("fmi2GetStringStatus", STEP | TERMINATED | ERROR);
