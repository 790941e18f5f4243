//! Runs a script: makes the calls and checks the results.

mod states;
mod values;

use crate::arithmetic::{control, set_control};
use crate::call::{Call, INSTANCES, STATES, Simple, Wrong};
use crate::face::Face;
use crate::importer::{ERROR, Log, Message, OK, Phase, WARNING, callbacks};
use crate::judge::{Seen, check_values};
use brinell_fmu::fmi2::abi::*;
use std::ffi::{CString, c_char, c_int};
use std::ptr::null;
use values::finite;

/// What an importer knows about an instance, and about a state that it saved.
#[derive(Clone)]
struct Known {
    phase: Phase,
    has_experiment: bool,
    time: f64,
    /// Whether an input has a derivative in the next step. The derivative ends with that step; parts of the step then
    /// differ from the whole.
    has_course: bool,
    seen: Seen,
}

struct Instance {
    component: fmi2Component,
    known: Known,
}

struct State {
    pointer: fmi2FMUstate,
    known: Known,
}

/// A running script. Dropping it frees its instances and states.
pub struct Runner<'a> {
    face: &'a Face,
    instances: [Option<Instance>; INSTANCES],
    states: [Option<State>; STATES],
    /// The last serialized state, and what is known about it.
    bytes: Option<(Vec<c_char>, Known)>,
    /// The messages of the last call.
    log: Box<Log>,
    /// The arithmetic of a new process.
    control: u32,
    /// Number of calls of the C interface.
    pub calls: u64,
}

/// Checks the messages of the last call; the log is empty afterwards.
fn check_messages(log: &Log) -> Result<(), String> {
    for message in log.take() {
        let Message { name, status, category, text } = &message;
        if [name, category, text].into_iter().any(|text| text == "NULL") || !(0..=4).contains(status) {
            return Err(format!("{message:?} is incomplete"));
        }
        // messages are format strings: every % is doubled
        if text.replace("%%", "").contains('%') {
            return Err(format!("{text:?} has a format of printf"));
        }
    }
    Ok(())
}

impl<'a> Runner<'a> {
    pub fn new(face: &'a Face) -> Runner<'a> {
        let (instances, states, log) = ([None, None], [None, None, None], Box::new(Log::default()));
        Runner { face, instances, states, bytes: None, log, control: control(), calls: 0 }
    }

    /// Runs all calls; the error names the call and the failure.
    pub fn run(&mut self, script: &[Call]) -> Result<(), String> {
        for (number, call) in script.iter().enumerate() {
            let result = self.make(call).and_then(|()| check_messages(&self.log));
            result.map_err(|wrong| format!("call {number}, {call:?}: {wrong}"))?;
        }
        Ok(())
    }

    fn make(&mut self, call: &Call) -> Result<(), String> {
        match call {
            Call::Instantiate { at, wrong, logging } => self.instantiate(*at, *wrong, *logging),
            Call::Free { at } => {
                self.free(*at);
                Ok(())
            }
            Call::Save { at, state } => self.save(*at, *state),
            Call::Restore { at, state } => self.restore(*at, *state),
            Call::FreeState { at, state } => self.free_state(*at, *state),
            Call::Serialize { at, state, short_by } => self.serialize(*at, *state, *short_by),
            Call::Deserialize { at, state, flip, length } => self.deserialize(*at, *state, *flip, *length),
            Call::Split { at, step, parts } => self.split(*at, *step, *parts),
            Call::Arithmetic { mode } => {
                set_control(self.control | mode);
                Ok(())
            }
            Call::Setup { at, .. }
            | Call::Simple { at, .. }
            | Call::Get { at, .. }
            | Call::Set { at, .. }
            | Call::InputDerivatives { at, .. }
            | Call::OutputDerivatives { at, .. }
            | Call::Directional { at, .. }
            | Call::Step { at, .. }
            | Call::Status { at, .. }
            | Call::Log { at, .. } => {
                let Some(mut instance) = self.instances[*at].take() else { return Ok(()) };
                let result = self.call(&mut instance, call);
                self.instances[*at] = Some(instance);
                result
            }
        }
    }

    fn instantiate(&mut self, at: usize, wrong: Option<Wrong>, logging: bool) -> Result<(), String> {
        if self.instances[at].is_some() {
            return Ok(());
        }
        let functions = &self.face.functions;
        let (empty, name) = (CString::default(), CString::new("100 %s # Größe").expect("no zero"));
        let other = CString::new("{another}").expect("no zero");
        let (mut name_pointer, mut guid, mut kind) = (name.as_ptr(), self.face.guid.as_ptr(), 1);
        let callbacks = callbacks(self.face, &self.log);
        let mut callbacks_pointer = &raw const callbacks;
        match wrong {
            None => {}
            Some(Wrong::NoName) => name_pointer = null(),
            Some(Wrong::EmptyName) => name_pointer = empty.as_ptr(),
            Some(Wrong::NoGuid) => guid = null(),
            Some(Wrong::Guid) => guid = other.as_ptr(),
            Some(Wrong::Type) => kind = 0,
            Some(Wrong::NoCallbacks) => callbacks_pointer = null(),
        }
        self.calls += 1;
        // SAFETY: strings that end with 0 or null, callbacks that live or null
        let component = unsafe {
            (functions.instantiate)(name_pointer, kind, guid, null(), callbacks_pointer, 0, c_int::from(logging))
        };
        match (component.is_null(), wrong) {
            (true, None) => Err("no instance".into()),
            (false, Some(_)) => Err("an instance in spite of a wrong argument".into()),
            (true, Some(_)) => Ok(()),
            (false, None) => {
                let (phase, seen) = (Phase::Instantiated, Seen::default());
                let known = Known { phase, has_experiment: false, time: 0.0, has_course: false, seen };
                self.instances[at] = Some(Instance { component, known });
                Ok(())
            }
        }
    }

    fn free(&mut self, at: usize) {
        if let Some(instance) = self.instances[at].take() {
            self.calls += 1;
            // SAFETY: it isn't used again
            unsafe { (self.face.functions.free_instance)(instance.component) };
        }
    }

    /// Any call on one instance.
    fn call(&mut self, instance: &mut Instance, call: &Call) -> Result<(), String> {
        self.calls += 1;
        let functions = &self.face.functions;
        let c = instance.component;
        let before = instance.known.phase;
        let (status, allowed) = match call {
            Call::Setup { start, stop, tolerance, .. } => {
                let (defined, stop_time) = (c_int::from(stop.is_some()), stop.unwrap_or(0.0));
                let tolerance_defined = c_int::from(tolerance.is_some());
                // SAFETY: the component lives, here and below
                let status = unsafe {
                    (functions.setup_experiment)(
                        c,
                        tolerance_defined,
                        tolerance.unwrap_or(0.0),
                        *start,
                        defined,
                        stop_time,
                    )
                };
                if status == OK {
                    (instance.known.has_experiment, instance.known.time) = (true, *start);
                }
                (status, before == Phase::Instantiated)
            }
            Call::Simple { which, .. } => simple(self.face, instance, *which),
            Call::Get { kind, references, null, .. } => {
                let status = self.get(c, *kind, references, *null)?;
                (status, !matches!(before, Phase::Instantiated))
            }
            Call::Set { kind, references, values, null, .. } => {
                let status = self.set(c, *kind, references, values, *null);
                (status, matches!(before, Phase::Instantiated | Phase::Initialization | Phase::StepComplete))
            }
            Call::InputDerivatives { references, orders, values, .. } => {
                // SAFETY: arrays as long as announced
                let status = unsafe {
                    let (references, count) = (references.as_ptr(), references.len());
                    (functions.set_real_input_derivatives)(c, references, count, orders.as_ptr(), values.as_ptr())
                };
                instance.known.has_course = true;
                (status, matches!(before, Phase::Instantiated | Phase::Initialization | Phase::StepComplete))
            }
            Call::OutputDerivatives { references, orders, .. } => {
                let mut values = vec![f64::NAN; references.len()];
                // SAFETY: arrays as long as announced
                let status = unsafe {
                    let (references, count) = (references.as_ptr(), references.len());
                    (functions.get_real_output_derivatives)(c, references, count, orders.as_ptr(), values.as_mut_ptr())
                };
                finite(status, &values)?;
                (status, !matches!(before, Phase::Instantiated))
            }
            Call::Directional { unknowns, knowns, direction, .. } => {
                let (directions, mut values) = (vec![*direction; knowns.len()], vec![f64::NAN; unknowns.len()]);
                // SAFETY: arrays as long as announced
                let status = unsafe {
                    (functions.get_directional_derivative)(
                        c,
                        unknowns.as_ptr(),
                        unknowns.len(),
                        knowns.as_ptr(),
                        knowns.len(),
                        directions.as_ptr(),
                        values.as_mut_ptr(),
                    )
                };
                if direction.is_finite() && direction.abs() < 1e100 {
                    finite(status, &values)?;
                }
                (status, !matches!(before, Phase::Instantiated))
            }
            Call::Step { late, step, .. } => {
                // SAFETY: the component lives
                let status = unsafe { (functions.do_step)(c, instance.known.time + late, *step, 1) };
                if status <= WARNING {
                    if !(*step > 0.0 && step.is_finite() && (instance.known.time + late).is_finite()) {
                        return Err(format!("a step of {step:e} s from {:e} s succeeds", instance.known.time + late));
                    }
                    instance.known.time += late + step;
                    instance.known.has_course = false;
                }
                (status, before == Phase::StepComplete)
            }
            Call::Status { which, kind, .. } => (ask(self.face, c, *which, *kind), true),
            Call::Log { on, categories, .. } => {
                let texts: Vec<CString> = categories.iter().map(|text| CString::new(*text).expect("no zero")).collect();
                let pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
                // SAFETY: strings that live during the call
                let status =
                    unsafe { (functions.set_debug_logging)(c, c_int::from(*on), pointers.len(), pointers.as_ptr()) };
                (status, true)
            }
            _ => unreachable!("calls on states are made elsewhere"),
        };
        if !(OK..=ERROR).contains(&status) {
            return Err(format!("status {status}"));
        }
        if !allowed && status <= WARNING {
            return Err(format!("status {status} in the phase {before:?}, where it isn't allowed"));
        }
        if status == ERROR {
            instance.known.phase = Phase::Error;
        }
        self.judge(instance, call, status)
    }

    /// Checks the values after a call, if they can be read.
    fn judge(&mut self, instance: &mut Instance, call: &Call, status: c_int) -> Result<(), String> {
        if instance.known.phase == Phase::Instantiated {
            instance.known.seen = Seen::default();
            return Ok(());
        }
        let values = self.values(instance)?;
        let steps = matches!(call, Call::Step { .. });
        // parameters may change until the first step, and some between steps
        let before = if steps && status <= WARNING { instance.known.seen.clone() } else { Seen::default() };
        instance.known.seen = check_values(self.face, &values, &before)?;
        Ok(())
    }

    /// All Real outputs.
    fn values(&mut self, instance: &Instance) -> Result<Vec<f64>, String> {
        self.calls += 1;
        let references = &self.face.outputs;
        let mut values = vec![f64::NAN; references.len()];
        // SAFETY: arrays as long as announced
        let status = unsafe {
            (self.face.functions.get_real)(instance.component, references.as_ptr(), values.len(), values.as_mut_ptr())
        };
        if status != OK {
            return Err(format!("status {status} of fmi2GetReal in the phase {:?}", instance.known.phase));
        }
        Ok(values)
    }
}

/// A call with the component as its only argument: its status, and whether it is allowed.
fn simple(face: &Face, instance: &mut Instance, which: Simple) -> (c_int, bool) {
    let functions = &face.functions;
    let (function, allowed, then) = match which {
        Simple::Enter => (
            functions.enter_initialization_mode,
            instance.known.phase == Phase::Instantiated && instance.known.has_experiment,
            Phase::Initialization,
        ),
        Simple::Exit => {
            (functions.exit_initialization_mode, instance.known.phase == Phase::Initialization, Phase::StepComplete)
        }
        Simple::Terminate => (
            functions.terminate,
            // more than the standard allows, as importers need it
            matches!(instance.known.phase, Phase::Instantiated | Phase::StepComplete | Phase::Terminated),
            // an instance that was never initialized has nothing to terminate
            if instance.known.phase == Phase::StepComplete { Phase::Terminated } else { instance.known.phase },
        ),
        Simple::Reset => (functions.reset, true, Phase::Instantiated),
        // there is no asynchronous step to cancel
        Simple::Cancel => (functions.cancel_step, false, instance.known.phase),
    };
    // SAFETY: the component lives
    let status = unsafe { function(instance.component) };
    if status <= WARNING {
        instance.known.phase = then;
        if which == Simple::Reset {
            (instance.known.has_experiment, instance.known.has_course) = (false, false);
        }
    }
    (status, allowed)
}

/// Requests a status of this kind.
fn ask(face: &Face, c: fmi2Component, which: u8, kind: c_int) -> c_int {
    let functions = &face.functions;
    let (mut integer, mut real, mut text) = (0, 0.0, null());
    // SAFETY: component and values live
    unsafe {
        match which {
            0 => (functions.get_status)(c, kind, &raw mut integer),
            1 => (functions.get_real_status)(c, kind, &raw mut real),
            2 => (functions.get_integer_status)(c, kind, &raw mut integer),
            3 => (functions.get_boolean_status)(c, kind, &raw mut integer),
            _ => (functions.get_string_status)(c, kind, &raw mut text),
        }
    }
}

impl Drop for Runner<'_> {
    fn drop(&mut self) {
        // states first: freeing one needs an instance
        let states = self.states.iter_mut().filter_map(Option::take).map(|state| state.pointer).collect::<Vec<_>>();
        if !states.is_empty() && self.instances.iter().all(Option::is_none) {
            let _ = self.instantiate(0, None, false);
        }
        if let Some(instance) = self.instances.iter().flatten().next() {
            for mut state in states {
                // SAFETY: it isn't used again
                unsafe { (self.face.functions.free_fmu_state)(instance.component, &raw mut state) };
            }
        }
        (0..INSTANCES).for_each(|at| self.free(at));
        set_control(self.control);
    }
}
