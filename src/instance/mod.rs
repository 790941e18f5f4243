//! Co-simulation as safe Rust: phase, time, variables, step, reset, save and load. Nothing here is particular to FMI 2.0.

mod saved;
mod start;
mod stepping;
mod validity;
mod variables;

use crate::contact::motion::{Drive, NoMotion};
use crate::contact::path::Course;
use crate::contact::{Body, Pair, Regime, TooDeep};
use crate::coupling::{CURVE_WORDS, Curve, MOMENTUM_WORDS, Momentum};
use crate::fault::Fault;
use crate::scene::{self, History, Model};
use crate::variable::{Integer, Parameter, Real, Settable};
use start::{Bodies, NO_BODIES, START, model_of, pair_of};

/// The phases in which an instance can be, as bits: a set of phases is their sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Phase {
    /// Memory that isn't an instance yet.
    Blank = 0,
    /// Just made, or reset.
    Instantiated = 1,
    /// Between entering and leaving Initialization Mode.
    Initialization = 2,
    /// Ready for a step.
    StepComplete = 4,
    /// Ended by the importer.
    Terminated = 8,
    /// A call failed; only reading, resetting and restoring are left.
    Error = 16,
}

impl Phase {
    /// Every phase that an instance can be in.
    const ALL: [Phase; 5] =
        [Phase::Instantiated, Phase::Initialization, Phase::StepComplete, Phase::Terminated, Phase::Error];
}

/// The settable parameters of the scene, in the order of [`scene::SETTABLE`].
pub type Values = [f64; scene::SETTABLE.len()];

/// How many contacts have their force in memory. One contact computes it when it is asked for, and so do those whose
/// force follows the rate; of many the step has it at hand.
const FORCES: usize = if scene::CONTACTS == 1 || History::FOLLOWS_RATE { 0 } else { scene::CONTACTS };

/// How many contacts have a course of their input: all whose history can follow one.
const CURVES: usize = if History::FOLLOWS_RATE { 0 } else { scene::CONTACTS };

/// How many contacts have a momentum: all, if an output tells it.
const MOMENTA: usize = if scene::MOMENTUM { scene::CONTACTS } else { 0 };

/// Whether every step is plain that keeps the contact on its branch.
const PLAIN: bool = scene::FOLLOW.is_none();

/// One instance of the unit: everything that a saved state holds. Memory full of zeros is one too, of no use before it is
/// [reset](Instance::reset): an instance of many contacts is too large to be moved.
#[derive(Debug)]
pub struct Instance {
    rates: [f64; scene::CONTACTS],
    histories: [History; scene::CONTACTS],
    forces: [f64; FORCES],
    time: f64,
    stop: f64,
    /// Where plain steps end [s]: at the stop time while stepping, and nowhere otherwise.
    limit: f64,
    pairs: [Bodies; scene::GROUPS],
    values: Values,
    /// From here to its opposite [m/s] an input needs no further look. Negative, so that the comparison has its second number in
    /// memory; it follows from the parameters.
    lowest_rate: f64,
    /// A hash of all that: states with the same one have the same parameters, and needn't copy them.
    stamp: u64,
    curves: [Curve; CURVES],
    momenta: [Momentum; MOMENTA],
    /// Length of the last step [s], where a force is predicted from it.
    last_step: [f64; scene::PREDICTS as usize],
    /// The contact that a step has left deeper than its law is valid for, or had there on the way, until it is told; counted
    /// from 1, and 0 is none.
    deep: u32,
    /// Its largest indentation [m].
    deepest: f64,
    phase: Phase,
    experiment_defined: bool,
    /// A derivative of an input is set, or was in the last step: no step is plain then.
    curved: bool,
    /// Many contacts move together or not at all. Unless this is set that needs no look ahead: see [`FAST`].
    fast: bool,
}

/// The words of an instance that don't belong to a contact or a parameter.
const OWN_WORDS: usize = 5;

/// Where the words of a contact begin that are there in some scenes only: behind its rate and its history.
const CURVE_AT: usize = 1 + History::WORDS;
const MOMENTUM_AT: usize = CURVE_AT + if CURVES > 0 { CURVE_WORDS } else { 0 };

/// The words of a contact.
const CONTACT_WORDS: usize = MOMENTUM_AT + if scene::MOMENTUM { MOMENTUM_WORDS } else { 0 };

/// Number of words that hold an instance.
pub const WORDS: usize = OWN_WORDS + scene::SETTABLE.len() + CONTACT_WORDS * scene::CONTACTS;

/// How far a communication point may be from the end of the last step, in steps. Masters count `t += h` or `start + i h`;
/// either is within rounding of the last end, and half a step off is a mistake.
const TIME_TOLERANCE: f64 = 0.1;

/// How far a step may end behind the stop time, in steps: room for the rounding of some thousand sums, far below the
/// hundredth of a step that would be a mistake.
const STOP_TOLERANCE: f64 = 1e-3;

/// A limit before every time [s].
const NOWHERE: f64 = -f64::MAX;

/// Room for rounding of a time far from zero, as a fraction of it.
const TIME_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// The rate up to which no contact can come near the end of its range [m/s] while times are below [`LATE`].
const FAST: f64 = 1e40;

/// See [`FAST`] [m].
const FAR: f64 = 1e90;

/// See [`FAST`] [s].
const LATE: f64 = 1e50;

/// Where plain steps end in this phase [s].
fn limit(phase: Phase, stop: f64) -> f64 {
    if phase == Phase::StepComplete { stop } else { NOWHERE }
}

fn too_deep(contact: usize, TooDeep { indentation }: TooDeep) -> Fault {
    Fault::TooDeep { contact, indentation }
}

impl Instance {
    /// Forgets the derivatives of inputs.
    fn straighten(&mut self) {
        self.curved = false;
        self.curves.fill(Curve::default());
        self.set_limit();
    }

    /// Writes down the forces, where they are kept.
    fn note_forces(&mut self) {
        for ((force, history), &rate) in self.forces.iter_mut().zip(&self.histories).zip(&self.rates) {
            *force = history.plain_force(rate, Model::SQUARES);
        }
    }

    /// The phase the instance is in.
    #[inline]
    pub fn phase(&self) -> Phase {
        self.phase
    }

    fn set_phase(&mut self, phase: Phase) {
        self.phase = phase;
        self.set_limit();
    }

    fn set_limit(&mut self) {
        self.limit = if self.curved { NOWHERE } else { limit(self.phase, self.stop) };
    }

    /// After a failed call: nothing but reading, resetting and restoring is left.
    pub fn fail(&mut self) {
        self.set_phase(Phase::Error);
    }

    /// End of the last step [s], or the start time.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Sets start and stop time [s]; the last call before initialization counts.
    ///
    /// # Errors
    /// [`Fault::Experiment`] for a time that is not finite and for a stop before the start.
    pub fn set_experiment(&mut self, start: f64, stop: Option<f64>) -> Result<(), Fault> {
        let stop_is_fine = stop.is_none_or(|stop| stop.is_finite() && stop >= start);
        if !start.is_finite() || !stop_is_fine {
            return Err(Fault::Experiment { start, stop: stop.unwrap_or(f64::MAX) });
        }
        self.time = start;
        self.stop = stop.unwrap_or(f64::MAX);
        self.experiment_defined = true;
        Ok(())
    }

    /// # Errors
    /// [`Fault::NoExperiment`] without start time.
    pub fn enter_initialization(&mut self) -> Result<(), Fault> {
        if !self.experiment_defined {
            return Err(Fault::NoExperiment);
        }
        self.set_phase(Phase::Initialization);
        Ok(())
    }

    /// # Errors
    /// [`Fault::NoPointContact`] if the parameters don't fit together, [`Fault::TooFast`] if they don't fit the input.
    pub fn exit_initialization(&mut self) -> Result<(), Fault> {
        self.start()?;
        for (history, &rate) in self.histories.iter().zip(&self.rates) {
            check_rate(history, rate)?;
        }
        self.set_phase(Phase::StepComplete);
        // a contact may begin anywhere
        self.look();
        Ok(())
    }

    /// Ends the simulation. An instance that was never initialized, or has ended already, stays as it is.
    pub fn terminate(&mut self) {
        if self.phase == Phase::StepComplete {
            self.set_phase(Phase::Terminated);
        }
    }

    /// Whether the passivity guard has shortened the path on which the load comes off, or came off.
    pub fn is_held_back(&self) -> bool {
        self.histories.iter().enumerate().any(|(contact, history)| {
            matches!(history.regime(), Regime::Unloaded | Regime::Apart)
                && self.model(contact).is_held_back_at(history.max_indentation())
        })
    }

    /// What is in contact, and by which laws.
    fn model(&self, contact: usize) -> Model {
        let group = scene::group(contact);
        model_of(group, self.pairs.get(group).copied().unwrap_or(NO_BODIES), &self.values)
    }
}

/// Whether a parameter may have this `value`.
fn allows(settable: &Settable, value: f64) -> bool {
    // written positively, so that a NaN fails
    value >= settable.minimum && value <= settable.maximum
}

fn check_rate(history: &History, rate: f64) -> Result<(), Fault> {
    if history.is_finite_at_rate(rate) { Ok(()) } else { Err(Fault::TooFast { rate }) }
}
