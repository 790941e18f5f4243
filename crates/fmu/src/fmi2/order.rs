//! The phases in which each function may be called: the table of section 4.2.4 of FMI 2.0.5, as data.
//!
//! The states of an asynchronous step are missing here: every step is complete when its call returns.

use crate::instance::Phase;

/// A function and the phases in which it may be called.
///
/// Its name is a part of `NAMES`. A pointer to each name would be an address that the loader has to relocate.
#[derive(Clone, Copy)]
pub struct Function {
    begin: u16,
    length: u8,
    phases: u8,
}

/// The common beginning of the names of all functions.
pub const PREFIX: &str = "fmi2";

/// The rest of the names of all functions that pass the guard. Some names are the beginning or the end of others, such as
/// `GetReal` of `GetRealStatus`.
const NAMES: &str = "\
    SetDebugLoggingSetupExperimentEnterInitializationModeExitInitializationModeTerminateResetSetInteger\
    SetBooleanSetStringGetFMUstateSetFMUstateFreeFMUstateSerializedFMUstateSizeDeSerializeFMUstate\
    GetDirectionalDerivativeSetRealInputDerivativesGetRealOutputDerivativesDoStepCancelStepGetStatus\
    GetRealStatusGetIntegerStatusGetBooleanStatusGetStringStatusEnterEventModeNewDiscreteStates\
    EnterContinuousTimeModeCompletedIntegratorStepSetTimeSetContinuousStatesGetDerivativesGetEventIndicators\
    GetContinuousStatesGetNominalsOfContinuousStates";

const INSTANTIATED: u8 = Phase::Instantiated as u8;
const INITIALIZATION: u8 = Phase::Initialization as u8;
const STEP: u8 = Phase::StepComplete as u8;
const TERMINATED: u8 = Phase::Terminated as u8;
const ERROR: u8 = Phase::Error as u8;

const ANY: u8 = INSTANTIATED | INITIALIZATION | STEP | TERMINATED | ERROR;
const READING: u8 = INITIALIZATION | STEP | TERMINATED | ERROR;
const WRITING: u8 = INSTANTIATED | INITIALIZATION | STEP;

impl Function {
    const fn new(name: &str, phases: u8) -> Function {
        let (name, names) = (name.as_bytes(), NAMES.as_bytes());
        let mut begin = 0;
        // a name that is not in the list causes a compile error here
        loop {
            let mut length = PREFIX.len();
            while length < name.len() && names[begin + length - PREFIX.len()] == name[length] {
                length += 1;
            }
            if length == name.len() {
                return Function { begin: begin as u16, length: (length - PREFIX.len()) as u8, phases };
            }
            begin += 1;
        }
    }

    /// The function of Model Exchange with this `name`. It is rejected in every phase, with a message of its own.
    pub const fn of_model_exchange(name: &str) -> Function {
        Function::new(name, ANY)
    }

    /// Its name after [`PREFIX`], for messages.
    pub fn name(self) -> &'static str {
        let begin = usize::from(self.begin);
        NAMES.get(begin..begin + usize::from(self.length)).unwrap_or("")
    }

    /// Whether it may be called in `phase`.
    #[inline]
    pub fn is_allowed_in(self, phase: Phase) -> bool {
        self.phases & phase as u8 != 0
    }
}

pub(super) const SET_DEBUG_LOGGING: Function = Function::new("fmi2SetDebugLogging", ANY);
pub(super) const SETUP_EXPERIMENT: Function = Function::new("fmi2SetupExperiment", INSTANTIATED);
pub(super) const ENTER_INITIALIZATION_MODE: Function = Function::new("fmi2EnterInitializationMode", INSTANTIATED);
pub(super) const EXIT_INITIALIZATION_MODE: Function = Function::new("fmi2ExitInitializationMode", INITIALIZATION);
// more permissive than the table: importers terminate twice, or without initialization, and it does no harm
pub(super) const TERMINATE: Function = Function::new("fmi2Terminate", INSTANTIATED | STEP | TERMINATED);
pub(super) const RESET: Function = Function::new("fmi2Reset", ANY);
pub(super) const GET_REAL: Function = Function::new("fmi2GetReal", READING);
pub(super) const GET_INTEGER: Function = Function::new("fmi2GetInteger", READING);
pub(super) const GET_BOOLEAN: Function = Function::new("fmi2GetBoolean", READING);
pub(super) const GET_STRING: Function = Function::new("fmi2GetString", READING);
pub(super) const SET_REAL: Function = Function::new("fmi2SetReal", WRITING);
pub(super) const SET_INTEGER: Function = Function::new("fmi2SetInteger", WRITING);
pub(super) const SET_BOOLEAN: Function = Function::new("fmi2SetBoolean", WRITING);
pub(super) const SET_STRING: Function = Function::new("fmi2SetString", WRITING);
pub(super) const GET_FMU_STATE: Function = Function::new("fmi2GetFMUstate", ANY);
pub(super) const SET_FMU_STATE: Function = Function::new("fmi2SetFMUstate", ANY);
pub(super) const FREE_FMU_STATE: Function = Function::new("fmi2FreeFMUstate", ANY);
pub(super) const SERIALIZED_FMU_STATE_SIZE: Function = Function::new("fmi2SerializedFMUstateSize", ANY);
pub(super) const SERIALIZE_FMU_STATE: Function = Function::new("fmi2SerializeFMUstate", ANY);
pub(super) const DESERIALIZE_FMU_STATE: Function = Function::new("fmi2DeSerializeFMUstate", ANY);
pub(super) const GET_DIRECTIONAL_DERIVATIVE: Function = Function::new("fmi2GetDirectionalDerivative", READING);
pub(super) const SET_REAL_INPUT_DERIVATIVES: Function = Function::new("fmi2SetRealInputDerivatives", WRITING);
pub(super) const GET_REAL_OUTPUT_DERIVATIVES: Function =
    Function::new("fmi2GetRealOutputDerivatives", STEP | TERMINATED | ERROR);
pub(super) const DO_STEP: Function = Function::new("fmi2DoStep", STEP);
// no step is ever in progress
pub(super) const CANCEL_STEP: Function = Function::new("fmi2CancelStep", 0);
pub(super) const GET_STATUS: Function = Function::new("fmi2GetStatus", STEP | TERMINATED | ERROR);
pub(super) const GET_REAL_STATUS: Function = Function::new("fmi2GetRealStatus", STEP | TERMINATED | ERROR);
pub(super) const GET_INTEGER_STATUS: Function = Function::new("fmi2GetIntegerStatus", STEP | TERMINATED | ERROR);
pub(super) const GET_BOOLEAN_STATUS: Function = Function::new("fmi2GetBooleanStatus", STEP | TERMINATED | ERROR);
pub(super) const GET_STRING_STATUS: Function = Function::new("fmi2GetStringStatus", STEP | TERMINATED | ERROR);
