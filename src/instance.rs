//! Co-simulation as safe Rust: phase, time, variables, step, reset, save and load. Nothing here is particular to FMI 2.0.

use crate::contact::{Body, Pair, Regime, TooDeep};
use crate::fault::Fault;
use crate::scene::{self, History};
use crate::variable::{Integer, Parameter, Real};

/// The phases in which an instance can be, as bits: a set of phases is their sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Phase {
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

/// The settable parameters of the scene, in the order of [`scene::SETTABLE`].
pub type Values = [f64; scene::SETTABLE.len()];

/// The start values of the settable parameters.
const START: Values = {
    let mut values = [0.0; scene::SETTABLE.len()];
    let mut index = 0;
    while index < values.len() {
        values[index] = scene::SETTABLE[index].start;
        index += 1;
    }
    values
};

/// One instance of the unit: everything that a saved state holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    history: History,
    rate: f64,
    time: f64,
    stop: f64,
    /// Where plain steps end [s]: at the stop time while stepping, and nowhere otherwise.
    limit: f64,
    phase: Phase,
    experiment_defined: bool,
    pair: Pair,
    values: Values,
}

/// Words of an instance besides its values and its history.
const OWN_WORDS: usize = 5;

/// Number of words that hold an instance.
pub const WORDS: usize = OWN_WORDS + scene::SETTABLE.len() + History::WORDS;

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

/// The pair of bodies that `values` describe.
fn pair_of(values: &Values) -> Result<Pair, Fault> {
    let value = |parameter| scene::parameter(parameter, values);
    let impactor = Body {
        radius: value(Parameter::ImpactorRadius),
        youngs_modulus: value(Parameter::ImpactorYoungsModulus),
        poissons_ratio: value(Parameter::ImpactorPoissonsRatio),
    };
    let target = Body {
        radius: value(Parameter::TargetRadius),
        youngs_modulus: value(Parameter::TargetYoungsModulus),
        poissons_ratio: value(Parameter::TargetPoissonsRatio),
    };
    Pair::new(&impactor, &target, value(Parameter::TargetYieldStrength))
        .ok_or(Fault::NoPointContact { impactor: impactor.radius, target: target.radius })
}

fn start_of(pair: Pair, values: &Values) -> Result<History, Fault> {
    Ok(History::start(&scene::model(pair, values), scene::parameter(Parameter::InitialGap, values))?)
}

/// Whether `value` is neither infinite nor NaN, in the fewest instructions.
#[inline(always)]
fn is_finite(value: f64) -> bool {
    // zero, or NaN for those two
    !core::ops::Sub::sub(value, value).is_nan()
}

/// Where plain steps end in this phase [s].
fn limit(phase: Phase, stop: f64) -> f64 {
    if phase == Phase::StepComplete { stop } else { NOWHERE }
}

impl From<TooDeep> for Fault {
    fn from(TooDeep { indentation }: TooDeep) -> Fault {
        Fault::TooDeep { indentation }
    }
}

impl Instance {
    /// An instance as it is before anything is set; reset gives the same, bit for bit.
    ///
    /// # Errors
    /// [`Fault::NoPointContact`] if the start values of the scene don't fit together.
    pub fn new() -> Result<Instance, Fault> {
        let pair = pair_of(&START)?;
        let history = start_of(pair, &START)?;
        Ok(Instance {
            history,
            rate: 0.0,
            time: 0.0,
            stop: f64::MAX,
            limit: NOWHERE,
            phase: Phase::Instantiated,
            experiment_defined: false,
            pair,
            values: START,
        })
    }

    /// The phase the instance is in.
    #[inline]
    pub fn phase(&self) -> Phase {
        self.phase
    }

    fn set_phase(&mut self, phase: Phase) {
        self.phase = phase;
        self.limit = limit(phase, self.stop);
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
        self.pair = pair_of(&self.values)?;
        self.history = start_of(self.pair, &self.values)?;
        self.check_rate(self.rate)?;
        self.set_phase(Phase::StepComplete);
        Ok(())
    }

    /// Ends the simulation. An instance that was never initialized, or has ended already, stays as it is.
    pub fn terminate(&mut self) {
        if self.phase == Phase::StepComplete {
            self.set_phase(Phase::Terminated);
        }
    }

    /// Moves the contact from `time` over `step` [s] with the rate held.
    ///
    /// # Errors
    /// [`Fault::StepSize`], [`Fault::CommunicationPoint`], [`Fault::BeyondStopTime`], [`Fault::TooDeep`]; the contact is
    /// then where it was.
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), Fault> {
        self.check_step(time, step)?;
        let (pair, values) = (self.pair, self.values);
        self.history.step(self.rate, step, || scene::model(pair, &values))?;
        self.time = time + step;
        Ok(())
    }

    /// The step that nearly every step is: plainly in order, and on the branch that the contact is on. It does what
    /// [`Instance::do_step`] does; if it isn't such a step nothing is done, and false.
    #[inline(always)]
    pub fn do_plain_step(&mut self, time: f64, step: f64) -> bool {
        let end = time + step;
        // a step that is zero, negative or NaN is not larger than any distance; without a stop time `stop` is the largest
        // number, so that an infinite step isn't plain
        let follows = (time - self.time).abs() * (1.0 / TIME_TOLERANCE) < step;
        let beyond = end > self.limit;
        let in_order = follows && !beyond;
        let done = in_order && self.history.plain_step(self.rate, step);
        if done {
            self.time = end;
        }
        done
    }

    /// Whether the passivity guard has shortened the path on which the load comes off, or came off.
    pub fn is_held_back(&self) -> bool {
        matches!(self.history.regime(), Regime::Unloaded | Regime::Apart)
            && scene::model(self.pair, &self.values).is_held_back_at(self.history.max_indentation())
    }

    fn check_step(&self, time: f64, step: f64) -> Result<(), Fault> {
        if !(step > 0.0 && step < f64::INFINITY) {
            return Err(Fault::StepSize { step });
        }
        let rounding = TIME_ROUNDING * (time.abs() + self.time.abs());
        let follows = time.is_finite() && (time - self.time).abs() <= TIME_TOLERANCE * step + rounding;
        if !follows {
            return Err(Fault::CommunicationPoint { given: time, expected: self.time });
        }
        let end = time + step;
        let in_time = end - self.stop <= STOP_TOLERANCE * step + rounding;
        if !in_time {
            return Err(Fault::BeyondStopTime { end, stop: self.stop });
        }
        Ok(())
    }

    /// Whether `variable` may be set to `value` now.
    ///
    /// # Errors
    /// [`Fault::NotFinite`], [`Fault::TooFast`], [`Fault::OutOfRange`], [`Fault::NotSettable`], [`Fault::FixedParameter`].
    pub fn check_real(&self, variable: Real, value: f64) -> Result<(), Fault> {
        match variable {
            Real::IndentationRate if value.is_finite() => self.check_rate(value),
            Real::IndentationRate => Err(Fault::NotFinite { name: "indentation_rate", value }),
            Real::Parameter(index) => self.check_parameter(index, value),
            _ => Err(Fault::NotSettable),
        }
    }

    fn check_rate(&self, rate: f64) -> Result<(), Fault> {
        if self.history.is_finite_at_rate(rate) { Ok(()) } else { Err(Fault::TooFast { rate }) }
    }

    fn check_parameter(&self, index: usize, value: f64) -> Result<(), Fault> {
        let Some(settable) = scene::SETTABLE.get(index) else { return Err(Fault::NotSettable) };
        if !matches!(self.phase, Phase::Instantiated | Phase::Initialization) {
            return Err(Fault::FixedParameter { name: settable.name });
        }
        // written positively, so that a NaN fails
        let allowed = value >= settable.minimum && value <= settable.maximum;
        if allowed { Ok(()) } else { Err(Fault::OutOfRange { settable, value }) }
    }

    /// Sets `variable` to a `value` that [`Instance::check_real`] has allowed.
    pub fn set_real(&mut self, variable: Real, value: f64) {
        match variable {
            Real::IndentationRate => self.rate = value,
            Real::Parameter(index) => self.set_parameter(index, value),
            _ => {}
        }
    }

    /// What is read before the first step follows the parameters set so far. Bodies that don't fit are noticed when
    /// initialization ends: another parameter may still come.
    fn set_parameter(&mut self, index: usize, value: f64) {
        let Some(slot) = self.values.get_mut(index) else { return };
        *slot = value;
        if let Ok(pair) = pair_of(&self.values)
            && let Ok(history) = start_of(pair, &self.values)
        {
            (self.pair, self.history) = (pair, history);
        }
    }

    /// Sets the input and reports true if that is all there is to do: the input may be set now, and `rate` is finite.
    #[inline(always)]
    pub fn set_plain_rate(&mut self, rate: f64) -> bool {
        let plain = self.phase == Phase::StepComplete && is_finite(rate) && self.history.is_finite_at_rate(rate);
        if plain {
            self.rate = rate;
        }
        plain
    }

    /// The force [N], if outputs are plainly there: during the simulation.
    #[inline(always)]
    pub fn plain_force(&self) -> Option<f64> {
        (self.phase == Phase::StepComplete).then(|| self.history.force_at_rate(self.rate))
    }

    /// The value of `variable` now.
    pub fn real(&self, variable: Real) -> f64 {
        let model = scene::model(self.pair, &self.values);
        match variable {
            Real::IndentationRate => self.rate,
            Real::Force => self.history.force_at_rate(self.rate),
            Real::Indentation => self.history.indentation(),
            Real::MaxIndentation => self.history.max_indentation(),
            Real::ResidualIndentation => self.history.residual_indentation(&model),
            Real::ContactRadius => self.history.contact_radius(&model),
            Real::MeanPressure => self.history.mean_pressure_at_rate(&model, self.rate),
            Real::Stiffness => self.history.stiffness_at_rate(self.rate),
            Real::Work => self.history.work(&model),
            Real::ElasticEnergy => self.history.elastic_energy(&model),
            Real::DissipatedEnergy => self.history.dissipated_energy(&model),
            Real::Parameter(index) => self.values.get(index).copied().unwrap_or(f64::NAN),
        }
    }

    /// The value of `variable` now.
    pub fn integer(&self, variable: Integer) -> i32 {
        match variable {
            Integer::Regime => self.history.regime() as i32,
        }
    }

    /// The instance as words, to be stored.
    pub fn to_words(&self) -> [u64; WORDS] {
        let own = [
            self.phase as u64,
            u64::from(self.experiment_defined),
            self.rate.to_bits(),
            self.time.to_bits(),
            self.stop.to_bits(),
        ];
        let values = self.values.iter().map(|value| value.to_bits());
        let mut words = [0; WORDS];
        let all = own.into_iter().chain(values).chain(self.history.to_words());
        for (word, stored) in words.iter_mut().zip(all) {
            *word = stored;
        }
        words
    }

    /// The instance that [`Instance::to_words`] stored; `None` if the words don't make one.
    pub fn from_words(words: &[u64; WORDS]) -> Option<Instance> {
        let (own, rest) = words.split_first_chunk::<OWN_WORDS>()?;
        let (stored_values, rest) = rest.split_first_chunk::<{ scene::SETTABLE.len() }>()?;
        let [phase, experiment_defined, rate, time, stop] = *own;
        let phase = [Phase::Instantiated, Phase::Initialization, Phase::StepComplete, Phase::Terminated, Phase::Error]
            .into_iter()
            .find(|&candidate| candidate as u64 == phase)?;
        let mut values = START;
        for ((value, &stored), settable) in values.iter_mut().zip(stored_values).zip(&scene::SETTABLE) {
            *value = f64::from_bits(stored);
            if !(*value >= settable.minimum && *value <= settable.maximum) {
                return None;
            }
        }
        let (rate, time, stop) = (f64::from_bits(rate), f64::from_bits(time), f64::from_bits(stop));
        if !rate.is_finite() || !time.is_finite() || !stop.is_finite() || experiment_defined > 1 {
            return None;
        }
        let pair = pair_of(&values).ok()?;
        Some(Instance {
            history: History::from_words(rest.first_chunk()?, &scene::model(pair, &values))?,
            rate,
            time,
            stop,
            limit: limit(phase, stop),
            phase,
            experiment_defined: experiment_defined == 1,
            pair,
            values,
        })
    }
}
