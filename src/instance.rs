//! Co-simulation as safe Rust: phase, time, variables, step, reset, save and load. Nothing here is particular to FMI 2.0.

use crate::contact::motion::{Drive, NoMotion};
use crate::contact::path::Course;
use crate::contact::{Body, Pair, Regime, TooDeep};
use crate::coupling::{CURVE_WORDS, Curve, MOMENTUM_WORDS, Momentum};
use crate::fault::Fault;
use crate::scene::{self, History, Model};
use crate::variable::{Integer, Parameter, Real, Settable};

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
    /// A hash of the last two: states with the same one have the same parameters, and needn't copy them.
    stamp: u64,
    curves: [Curve; CURVES],
    momenta: [Momentum; MOMENTA],
    /// Length of the last step [s], where a force is predicted from it.
    last_step: [f64; scene::PREDICTS as usize],
    phase: Phase,
    experiment_defined: bool,
    /// A derivative of an input is set, or was in the last step: no step is plain then.
    curved: bool,
    /// Many contacts move together or not at all. Unless this is set that needs no look ahead: see [`FAST`].
    fast: bool,
}

/// What of a pair is worth keeping; the rest are parameters.
#[derive(Clone, Copy, Debug)]
struct Bodies {
    /// Effective radius [m].
    radius: f64,
    /// Effective modulus [Pa].
    modulus: f64,
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

/// 2^64 over the golden ratio, odd: what hashes are mixed with.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// Room for rounding of a time far from zero, as a fraction of it.
const TIME_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// The rate up to which no contact can come near the end of its range [m/s] while times are below [`LATE`].
const FAST: f64 = 1e40;

/// See [`FAST`] [m].
const FAR: f64 = 1e90;

/// See [`FAST`] [s].
const LATE: f64 = 1e50;

/// The pair of bodies of `group` that `values` describe.
fn pair_of(group: usize, values: &Values) -> Result<Pair, Fault> {
    let value = |parameter| scene::parameter(parameter, group, values);
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

/// What is in contact in `group`, whose `bodies` are those of `values`.
fn model_of(group: usize, bodies: Bodies, values: &Values) -> Model {
    let value = |parameter| scene::parameter(parameter, group, values);
    let pair = Pair {
        radius: bodies.radius,
        modulus: bodies.modulus,
        yield_strength: value(Parameter::TargetYieldStrength),
        youngs_modulus: value(Parameter::TargetYoungsModulus),
        poissons_ratio: value(Parameter::TargetPoissonsRatio),
    };
    scene::model(pair, group, values)
}

/// A contact of `group` before any motion.
#[inline(never)]
fn start_of(group: usize, values: &Values) -> Result<(Bodies, History), Fault> {
    let pair = pair_of(group, values)?;
    let history =
        History::start(&scene::model(pair, group, values), scene::parameter(Parameter::InitialGap, group, values));
    Ok((Bodies { radius: pair.radius, modulus: pair.modulus }, history.map_err(|deep| too_deep(0, deep))?))
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

fn too_deep(contact: usize, TooDeep { indentation }: TooDeep) -> Fault {
    Fault::TooDeep { contact, indentation }
}

impl Instance {
    /// Makes the instance as it is before anything is set, the same bit for bit each time.
    ///
    /// # Errors
    /// [`Fault::NoPointContact`] if the start values of the scene don't fit together.
    pub fn reset(&mut self) -> Result<(), Fault> {
        self.values = START;
        self.rates.fill(0.0);
        self.time = 0.0;
        self.stop = f64::MAX;
        self.experiment_defined = false;
        self.fast = false;
        self.last_step.fill(0.0);
        self.straighten();
        self.set_phase(Phase::Instantiated);
        self.start()
    }

    /// Puts all contacts where they are before any motion; if one can't be there nothing is done.
    fn start(&mut self) -> Result<(), Fault> {
        let started = self.start_contacts();
        self.stamp_parameters();
        started
    }

    /// Makes the [`Instance::stamp`] that of the parameters and of the bodies that follow from them.
    #[inline(never)]
    fn stamp_parameters(&mut self) {
        let bodies = self.pairs.iter().flat_map(|bodies| [bodies.radius, bodies.modulus]);
        let mix = |sum: u64, value: f64| {
            let mixed = (sum ^ value.to_bits()).wrapping_mul(GOLDEN);
            mixed ^ mixed >> 32
        };
        // blank memory has the stamp zero
        self.stamp = self.values.iter().copied().chain(bodies).fold(GOLDEN, mix) | 1;
    }

    fn start_contacts(&mut self) -> Result<(), Fault> {
        if scene::GROUPS > 1 {
            for group in 0..scene::GROUPS {
                start_of(group, &self.values)?;
            }
        }
        let mut histories = self.histories.iter_mut();
        let mut first = 0;
        for (group, bodies) in self.pairs.iter_mut().enumerate() {
            let (own, history) = start_of(group, &self.values)?;
            *bodies = own;
            let end = scene::end(group);
            for slot in histories.by_ref().take(end - first) {
                *slot = history;
            }
            first = end;
        }
        for (momentum, history) in self.momenta.iter_mut().zip(&self.histories) {
            *momentum = Momentum::start(history.force_at_rate(0.0));
        }
        self.note_forces();
        Ok(())
    }

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
        Ok(())
    }

    /// Ends the simulation. An instance that was never initialized, or has ended already, stays as it is.
    pub fn terminate(&mut self) {
        if self.phase == Phase::StepComplete {
            self.set_phase(Phase::Terminated);
        }
    }

    /// Moves the contacts from `time` over `step` [s] with the rates held.
    ///
    /// # Errors
    /// [`Fault::StepSize`], [`Fault::CommunicationPoint`], [`Fault::BeyondStopTime`], [`Fault::TooDeep`]; every contact
    /// is then where it was.
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), Fault> {
        self.check_step(time, step)?;
        self.advance(time + step, step)
    }

    /// The step that nearly every step is: plainly in order, and of one contact on the branch that it is on. It does what
    /// [`Instance::do_step`] does; if it isn't such a step nothing is done, and false.
    #[inline(always)]
    pub fn do_plain_step(&mut self, time: f64, step: f64) -> bool {
        let end = time + step;
        // a step that is zero, negative or NaN is not larger than any distance; without a stop time `stop` is the largest
        // number, so that an infinite step isn't plain
        let follows = (time - self.time).abs() * (1.0 / TIME_TOLERANCE) < step;
        let beyond = end > self.limit;
        let in_order = follows && !beyond;
        if scene::CONTACTS > 1 {
            // what the passivity guard does must be told
            return in_order && scene::GUARD.is_none() && self.advance(end, step).is_ok();
        }
        let (Some(history), Some(&rate)) = (self.histories.first_mut(), self.rates.first()) else { return false };
        let from = if scene::MOMENTUM { history.indentation() } else { 0.0 };
        let done = PLAIN && in_order && history.plain_step(rate, step);
        if done {
            for momentum in &mut self.momenta {
                momentum.add(history.mean_force_since(from), step);
            }
            self.last_step.fill(step);
            self.time = end;
        }
        done
    }

    /// Moves all contacts over `step` [s], to the time `end` [s], or none of them.
    #[inline]
    fn advance(&mut self, end: f64, step: f64) -> Result<(), Fault> {
        let ahead = History::FOLLOWS_RATE || self.curved || self.fast || end.abs() > LATE || !PLAIN;
        if scene::CONTACTS > 1 && ahead {
            for contact in 0..scene::CONTACTS {
                self.moved(contact, step)?;
            }
        }
        if self.curved || !PLAIN || History::FOLLOWS_RATE && scene::MOMENTUM {
            self.advance_any(step)?;
        } else {
            self.advance_held(step)?;
        }
        self.last_step.fill(step);
        self.time = end;
        Ok(())
    }

    /// Moves all contacts with their rates held.
    #[inline]
    fn advance_held(&mut self, step: f64) -> Result<(), Fault> {
        let (pairs, values) = (&self.pairs, &self.values);
        for (contact, (history, &rate)) in self.histories.iter_mut().zip(&self.rates).enumerate() {
            let from = if scene::MOMENTUM { history.indentation() } else { 0.0 };
            let before = *history;
            // one contact has been tried before
            let plain = scene::CONTACTS > 1 && history.plain_step(rate, step);
            let group = scene::group(contact);
            let model = || model_of(group, pairs.get(group).copied().unwrap_or(NO_BODIES), values);
            if !plain {
                history.step(rate, step, model).map_err(|deep| too_deep(contact, deep))?;
            }
            if let Some(force) = self.forces.get_mut(contact) {
                *force = history.plain_force(rate, Model::SQUARES);
            }
            if let Some(momentum) = self.momenta.get_mut(contact) {
                let mean = match plain {
                    true => history.mean_force_since(from),
                    false => before
                        .mean_force_along(&Course::held(rate), step, &model())
                        .map_err(|deep| too_deep(contact, deep))?,
                };
                momentum.add(mean, step);
            }
        }
        Ok(())
    }

    /// Moves all contacts, each on the course of its input, or by its mass.
    #[cold]
    fn advance_any(&mut self, step: f64) -> Result<(), Fault> {
        let curved = !PLAIN || self.curves.iter().any(|curve| curve.slope != 0.0 || curve.bend != 0.0);
        self.curved |= !PLAIN;
        for contact in 0..scene::CONTACTS {
            let Moved { history, course, mean_force } = self.moved(contact, step)?;
            if let Some(momentum) = self.momenta.get_mut(contact) {
                momentum.add(mean_force, step);
            }
            if let Some(slot) = self.histories.get_mut(contact) {
                *slot = history;
            }
            if let Some(curve) = self.curves.get_mut(contact) {
                curve.end_of(&course, step);
            }
            if let Some(force) = self.forces.get_mut(contact) {
                *force = history.force_at_rate(course.rate);
            }
        }
        // how the step ended is known until the next one, which isn't plain for that reason
        if !curved {
            self.straighten();
        }
        Ok(())
    }

    /// Where `contact` will be after `step` [s].
    fn moved(&self, contact: usize, step: f64) -> Result<Moved, Fault> {
        let (Some(history), Some(&rate)) = (self.histories.get(contact), self.rates.get(contact)) else {
            return Err(Fault::Unavailable);
        };
        let mut history = *history;
        let mut course = self.curves.get(contact).copied().unwrap_or_default().course(rate);
        let model = self.model(contact);
        let failed = |deep| too_deep(contact, deep);
        if let Some(follow) = scene::FOLLOW {
            let mass = scene::parameter(Parameter::EffectiveMass, scene::group(contact), &self.values);
            let drive = Drive { mass, acceleration: course.slope };
            let outcome = follow(&mut history, &model, &drive, rate, step).map_err(|reason| match reason {
                NoMotion::TooDeep(deep) => failed(deep),
                NoMotion::TooLong => Fault::TooLong { step },
            })?;
            let mean_force = mass * outcome.taken / step;
            // as if the rate had gone there in a straight line
            let slope = course.slope - history.force_at_rate(outcome.speed) / mass;
            course = Course { rate: outcome.speed - slope * step, slope, bend: 0.0 };
            return Ok(Moved { history, course, mean_force });
        }
        let mean_force = match scene::MOMENTUM {
            true => history.mean_force_along(&course, step, &model).map_err(failed)?,
            false => 0.0,
        };
        history.step_along(&course, step, || model).map_err(failed)?;
        Ok(Moved { history, course, mean_force })
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

    /// Whether `variable` of `contact` may be set to `value` now.
    ///
    /// # Errors
    /// [`Fault::NotFinite`], [`Fault::TooFast`], [`Fault::OutOfRange`], [`Fault::NotSettable`], [`Fault::FixedParameter`].
    pub fn check_real(&self, (variable, contact): (Real, usize), value: f64) -> Result<(), Fault> {
        match variable {
            Real::IndentationRate if value.is_finite() => {
                self.histories.get(contact).map_or(Ok(()), |history| check_rate(history, value))
            }
            Real::IndentationRate => Err(Fault::NotFinite { name: "indentation_rate", value }),
            Real::Parameter(index) => self.check_parameter(index, value),
            _ => Err(Fault::NotSettable),
        }
    }

    fn check_parameter(&self, index: usize, value: f64) -> Result<(), Fault> {
        let Some(settable) = scene::SETTABLE.get(index) else { return Err(Fault::NotSettable) };
        if !matches!(self.phase, Phase::Instantiated | Phase::Initialization) {
            return Err(Fault::FixedParameter { name: settable.name });
        }
        if allows(settable, value) { Ok(()) } else { Err(Fault::OutOfRange { settable, value }) }
    }

    /// Sets a variable to a `value` that [`Instance::check_real`] has allowed; true for a parameter, which takes effect
    /// when [`Instance::parameters_are_set`] is called.
    pub fn set_real(&mut self, (variable, contact): (Real, usize), value: f64) -> bool {
        match variable {
            Real::IndentationRate => {
                self.fast |= value.abs() > FAST;
                if let Some(rate) = self.rates.get_mut(contact) {
                    *rate = value;
                }
            }
            Real::Parameter(index) => {
                if let Some(slot) = self.values.get_mut(index) {
                    *slot = value;
                }
            }
            _ => {}
        }
        matches!(variable, Real::Parameter(_))
    }

    /// What is read before the first step follows the parameters set so far. Bodies that don't fit are noticed when
    /// initialization ends: another parameter may still come.
    pub fn parameters_are_set(&mut self) {
        let _ = self.start();
    }

    /// Sets the input of `contact` and reports true if that is all there is to do: the input may be set now, and `rate`
    /// is plain.
    #[inline(always)]
    pub fn set_plain_rate(&mut self, contact: usize, rate: f64) -> bool {
        let (Some(history), Some(slot)) = (self.histories.get(contact), self.rates.get_mut(contact)) else {
            return false;
        };
        let plain = self.phase == Phase::StepComplete && is_plain(rate) && history.is_finite_at_rate(rate);
        if plain {
            *slot = rate;
        }
        plain
    }

    /// Sets the inputs of the contacts from `first` on and reports true, as [`Instance::set_plain_rate`] does; or sets none.
    pub fn set_plain_rates(&mut self, first: usize, rates: &[f64]) -> bool {
        let end = first.wrapping_add(rates.len());
        let (Some(histories), Some(slots)) = (self.histories.get(first..end), self.rates.get_mut(first..end)) else {
            return false;
        };
        let mut plain = self.phase == Phase::StepComplete;
        for (history, &rate) in histories.iter().zip(rates) {
            plain &= is_plain(rate) && (!History::FOLLOWS_RATE || history.is_finite_at_rate(rate));
        }
        if plain {
            for (slot, &rate) in slots.iter_mut().zip(rates) {
                *slot = rate;
            }
        }
        plain
    }

    /// The force of `contact` [N], if outputs are plainly there: during the simulation.
    #[inline(always)]
    pub fn plain_force(&self, contact: usize) -> Option<f64> {
        let force = match self.forces.get(contact) {
            Some(&force) => force,
            None => self.histories.get(contact)?.plain_force(*self.rates.get(contact)?, Model::SQUARES),
        };
        (self.phase == Phase::StepComplete).then_some(force)
    }

    /// Copies the forces [N] of the contacts from `first` on and reports true, if they are there.
    pub fn copy_plain_forces(&self, first: usize, forces: &mut [f64]) -> bool {
        let end = first.wrapping_add(forces.len());
        let (Some(histories), Some(rates)) = (self.histories.get(first..end), self.rates.get(first..end)) else {
            return false;
        };
        if self.phase != Phase::StepComplete {
            return false;
        }
        match self.forces.get(first..end) {
            Some(known) => forces.iter_mut().zip(known).for_each(|(force, &known)| *force = known),
            None => {
                for ((force, history), &rate) in forces.iter_mut().zip(histories).zip(rates) {
                    *force = history.plain_force(rate, Model::SQUARES);
                }
            }
        }
        true
    }

    /// The value of a variable now.
    pub fn real(&self, (variable, contact): (Real, usize)) -> f64 {
        let (Some(history), Some(&rate)) = (self.histories.get(contact), self.rates.get(contact)) else {
            return f64::NAN;
        };
        let model = self.model(contact);
        match variable {
            Real::IndentationRate => rate,
            Real::Force => history.force_at_rate(rate),
            Real::Indentation => history.indentation(),
            Real::MaxIndentation => history.max_indentation(),
            Real::ResidualIndentation => history.residual_indentation(&model),
            Real::ContactRadius => history.contact_radius(&model),
            Real::MeanPressure => history.mean_pressure_at_rate(&model, rate),
            Real::Stiffness => history.stiffness_at_rate(rate),
            Real::Work => history.work(&model),
            Real::ElasticEnergy => history.elastic_energy(&model),
            Real::DissipatedEnergy => history.dissipated_energy(&model),
            Real::Impulse => self.momenta.get(contact).map_or(f64::NAN, Momentum::impulse),
            Real::MeanForce => self.momenta.get(contact).map_or(f64::NAN, |momentum| momentum.mean_force),
            Real::PredictedForce => {
                let mut next = *history;
                let step = self.last_step.first().copied().unwrap_or(0.0);
                let moved = next.step(self.end_of(contact).0, step, || model);
                // where the law ends there is no other force than the present one
                if moved.is_ok() { next.force_at_rate(rate) } else { history.force_at_rate(rate) }
            }
            Real::Parameter(index) => self.values.get(index).copied().unwrap_or(f64::NAN),
        }
    }

    /// Rate [m/s] and its derivative [m/s^2] of `contact` at this moment: how the last step ended, or the input.
    fn end_of(&self, contact: usize) -> (f64, f64) {
        match self.curves.get(contact) {
            Some(curve) if self.curved => (curve.end_rate, curve.end_slope),
            _ => (self.rates.get(contact).copied().unwrap_or(0.0), 0.0),
        }
    }

    /// The derivative of this `order` of the force by time [N/s or N/s^2], at the end of the last step.
    ///
    /// # Errors
    /// [`Fault::NoDerivative`] for another variable, [`Fault::DerivativeOrder`].
    pub fn output_derivative(&self, (variable, contact): (Real, usize), order: i32) -> Result<f64, Fault> {
        if variable != Real::Force {
            return Err(Fault::NoDerivative { of: "force" });
        }
        check_order(order, History::DERIVATIVES)?;
        let (rate, slope) = self.end_of(contact);
        let model = self.model(contact);
        Ok(self.histories.get(contact).map_or(f64::NAN, |history| history.force_derivative(order, rate, slope, &model)))
    }

    /// Whether the derivative of this `order` of an input may be set to `value` now.
    ///
    /// # Errors
    /// [`Fault::NoDerivative`] for another variable, [`Fault::DerivativeOrder`], [`Fault::NotFinite`],
    /// [`Fault::Unsupported`] for a law that follows the rate.
    pub fn check_input_derivative(&self, (variable, _): (Real, usize), order: i32, value: f64) -> Result<(), Fault> {
        if CURVES == 0 {
            return Err(Fault::Unsupported);
        }
        if variable != Real::IndentationRate {
            return Err(Fault::NoDerivative { of: "indentation_rate" });
        }
        check_order(order, INPUT_DERIVATIVES)?;
        if value.is_finite() {
            Ok(())
        } else {
            Err(Fault::NotFinite { name: "a derivative of indentation_rate", value })
        }
    }

    /// Sets a derivative that [`Instance::check_input_derivative`] has allowed; it holds for the next step.
    pub fn set_input_derivative(&mut self, contact: usize, order: i32, value: f64) {
        if let Some(curve) = self.curves.get_mut(contact) {
            *(if order == 1 { &mut curve.slope } else { &mut curve.bend }) = value;
            if value != 0.0 && !self.curved {
                // the ends of contacts that had none
                for (curve, &rate) in self.curves.iter_mut().zip(&self.rates) {
                    (curve.end_rate, curve.end_slope) = (rate, 0.0);
                }
                self.curved = true;
                self.set_limit();
            }
        }
    }

    /// The value of a variable now.
    pub fn integer(&self, (variable, contact): (Integer, usize)) -> i32 {
        match variable {
            Integer::Regime => self.histories.get(contact).map_or(0, |history| history.regime() as i32),
        }
    }

    /// Makes this instance the same as `other`.
    #[inline(always)]
    pub fn copy_from(&mut self, other: &Instance) {
        self.rates.copy_from_slice(&other.rates);
        if scene::CONTACTS == 1 {
            self.histories.iter_mut().zip(&other.histories).for_each(|(own, history)| own.copy_from(history));
        } else {
            self.histories.copy_from_slice(&other.histories);
        }
        self.forces.copy_from_slice(&other.forces);
        if self.stamp != other.stamp {
            self.pairs.copy_from_slice(&other.pairs);
            self.values.copy_from_slice(&other.values);
            self.stamp = other.stamp;
        }
        (self.time, self.stop, self.limit) = (other.time, other.stop, other.limit);
        (self.phase, self.experiment_defined, self.fast) = (other.phase, other.experiment_defined, other.fast);
        self.momenta.copy_from_slice(&other.momenta);
        self.last_step.copy_from_slice(&other.last_step);
        // what isn't curved has curves of no meaning
        if other.curved {
            self.curves.copy_from_slice(&other.curves);
        }
        self.curved = other.curved;
    }

    /// The same where it needn't be quick.
    #[inline(never)]
    pub fn copy(&mut self, other: &Instance) {
        self.copy_from(other);
    }

    /// The instance as [`WORDS`] words, to be stored.
    pub fn to_words(&self, mut store: impl FnMut(u64)) {
        let last_step = self.last_step.first().copied().unwrap_or(0.0);
        let flags = u64::from(self.experiment_defined) | u64::from(self.curved) << 1;
        for word in [self.phase as u64, flags, self.time.to_bits(), self.stop.to_bits(), last_step.to_bits()] {
            store(word);
        }
        for value in &self.values {
            store(value.to_bits());
        }
        for (contact, (history, rate)) in self.histories.iter().zip(&self.rates).enumerate() {
            store(rate.to_bits());
            for word in history.to_words() {
                store(word);
            }
            // of contacts with neither there are none
            for word in self.curves.get(contact).into_iter().flat_map(|curve| curve.to_words()) {
                store(word);
            }
            for word in self.momenta.get(contact).into_iter().flat_map(|momentum| momentum.to_words()) {
                store(word);
            }
        }
    }

    /// Makes this the instance that [`Instance::to_words`] stored, each word as little-endian bytes, and reports true. If the words
    /// don't make one nothing is done.
    pub fn restore(&mut self, words: &[[u8; 8]]) -> bool {
        let number = |place| f64::from_bits(word(words, place));
        let mut values = START;
        let mut bad = word(words, 1) > 3 || [2, 3, 4].into_iter().any(|place| !number(place).is_finite());
        for ((value, settable), place) in values.iter_mut().zip(&scene::SETTABLE).zip(OWN_WORDS..) {
            *value = number(place);
            bad |= !allows(settable, *value);
        }
        let Some(phase) = Phase::ALL.into_iter().find(|&phase| phase as u64 == word(words, 0)) else { return false };
        // first a look at all that there is, and then the same again in earnest
        if bad || !self.restore_contacts(words, &values, false) {
            return false;
        }
        self.fast = false;
        self.restore_contacts(words, &values, true);
        self.values = values;
        self.stamp_parameters();
        (self.time, self.stop) = (number(2), number(3));
        self.experiment_defined = word(words, 1) & 1 != 0;
        self.curved = word(words, 1) & 2 != 0;
        self.last_step.fill(number(4));
        self.set_phase(phase);
        self.note_forces();
        true
    }

    /// Reads all contacts, and puts them in place if it is `in_earnest`; false if the words don't make contacts.
    #[inline(never)]
    fn restore_contacts(&mut self, words: &[[u8; 8]], values: &Values, in_earnest: bool) -> bool {
        let mut place = OWN_WORDS + scene::SETTABLE.len();
        let mut contacts = self.histories.iter_mut().zip(&mut self.rates);
        let (mut curves, mut momenta) = (self.curves.iter_mut(), self.momenta.iter_mut());
        let mut first = 0;
        for (group, bodies) in self.pairs.iter_mut().enumerate() {
            let Ok(pair) = pair_of(group, values) else { return false };
            let model = scene::model(pair, group, values);
            if in_earnest {
                *bodies = Bodies { radius: pair.radius, modulus: pair.modulus };
            }
            let end = scene::end(group);
            for (own, slot) in contacts.by_ref().take(end - first) {
                let rate = f64::from_bits(word(words, place));
                let stored = read(words, place + 1);
                let curve = if CURVES > 0 { Curve::from_words(read(words, place + CURVE_AT)) } else { None };
                let momentum =
                    if scene::MOMENTUM { Momentum::from_words(read(words, place + MOMENTUM_AT)) } else { None };
                if CURVES > 0 && curve.is_none() || scene::MOMENTUM && momentum.is_none() {
                    return false;
                }
                let Some(history) = History::from_words(&stored, &model).filter(|_| rate.is_finite()) else {
                    return false;
                };
                if in_earnest {
                    self.fast |= rate.abs() > FAST || history.indentation().abs() > FAR;
                    (*own, *slot) = (history, rate);
                    if let (Some(slot), Some(curve)) = (curves.next(), curve) {
                        *slot = curve;
                    }
                    if let (Some(slot), Some(momentum)) = (momenta.next(), momentum) {
                        *slot = momentum;
                    }
                }
                place += CONTACT_WORDS;
            }
            first = end;
        }
        true
    }
}

/// So many words from `place` on.
fn read<const COUNT: usize>(words: &[[u8; 8]], place: usize) -> [u64; COUNT] {
    let mut read = [0; COUNT];
    for (index, slot) in read.iter_mut().enumerate() {
        *slot = word(words, place + index);
    }
    read
}

/// A word of those that [`Instance::to_words`] stored.
#[inline(never)]
fn word(words: &[[u8; 8]], place: usize) -> u64 {
    words.get(place).map_or(0, |word| u64::from_le_bytes(*word))
}

/// Up to which order the derivatives of inputs go.
const INPUT_DERIVATIVES: i32 = if scene::FOLLOW.is_some() { 1 } else { 2 };

fn check_order(order: i32, largest: i32) -> Result<(), Fault> {
    if order >= 1 && order <= largest { Ok(()) } else { Err(Fault::DerivativeOrder { order, largest }) }
}

/// A contact after a step that it has yet to make.
struct Moved {
    history: History,
    /// The course that ends as the step did.
    course: Course,
    mean_force: f64,
}

/// What stands where there is no group.
const NO_BODIES: Bodies = Bodies { radius: f64::NAN, modulus: f64::NAN };

/// Whether an input needs no further look: finite, and of many contacts not [fast](FAST).
#[inline(always)]
fn is_plain(rate: f64) -> bool {
    if scene::CONTACTS > 1 { rate.abs() <= FAST } else { is_finite(rate) }
}

/// Whether a parameter may have this `value`.
fn allows(settable: &Settable, value: f64) -> bool {
    // written positively, so that a NaN fails
    value >= settable.minimum && value <= settable.maximum
}

fn check_rate(history: &History, rate: f64) -> Result<(), Fault> {
    if history.is_finite_at_rate(rate) { Ok(()) } else { Err(Fault::TooFast { rate }) }
}
