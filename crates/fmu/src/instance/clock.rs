//! Phase and time of an instance.

use super::fault::Fault;

/// The phases of an instance, as bits: a set of phases is their sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Phase {
    /// Memory that is not an instance yet.
    Blank = 0,
    /// Just created, or reset.
    Instantiated = 1,
    /// Between entering and leaving Initialization Mode.
    Initialization = 2,
    /// Ready for the next step.
    StepComplete = 4,
    /// Ended by the importer.
    Terminated = 8,
    /// A call failed. Only reading, resetting and restoring are possible.
    Error = 16,
}

impl Phase {
    /// All phases of an instance.
    pub const ALL: [Phase; 5] =
        [Phase::Instantiated, Phase::Initialization, Phase::StepComplete, Phase::Terminated, Phase::Error];
}

/// The latest time, and the negative of the earliest one \[s\]. As long as no rate exceeds [`FASTEST`](super::FASTEST), no
/// contact leaves the range of a law with segments up to this time.
pub const LATEST: f64 = 1e50;

/// The shortest step of an instance that divides impulses by the step \[s\]. Over a shorter one they would lose their digits; and
/// if a process takes small numbers as zero, even the step is zero.
pub const SHORTEST: f64 = 1e-50;

/// Largest difference between a communication point and the end of the last step, in steps. Importers compute `t += h` or
/// `start + i h`; both are within rounding of the last end. Half a step off is a mistake.
const TIME_TOLERANCE: f64 = 0.1;

/// How far a step may end beyond the stop time, in steps. This allows for the rounding of a few thousand sums, and is far below
/// a hundredth of a step, which would be a mistake.
const STOP_TOLERANCE: f64 = 1e-3;

/// A limit that is before every time \[s\].
const NOWHERE: f64 = f64::NEG_INFINITY;

/// The size of a number as a word: the words of two numbers are in the order of their absolute values. That of a NaN is larger
/// than all others.
#[inline(always)]
const fn size(number: f64) -> u64 {
    number.to_bits() << 1
}

/// Tolerance for rounding of a time far from zero, as a fraction of it.
const TIME_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Phase and time.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Clock {
    /// End of the last step, or the start time \[s\].
    pub time: f64,
    /// Latest end of a plain step \[s\]: the stop time while stepping, before every time otherwise.
    limit: f64,
    /// All sizes below it are those of rates to which an input may be set without further checks; none except between steps.
    rate_limit: u64,
    stop: f64,
    pub phase: Phase,
    pub experiment_defined: bool,
    /// Whether a derivative of an input is set or was set in the last step; no step is plain then.
    pub curved: bool,
    pub guard: Guarded,
}

/// What is known of the passivity guard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Guarded {
    /// It acts in no contact, or the contacts have not been looked at.
    Unseen = 0,
    /// It acts in a contact; that has not been told.
    Seen = 1,
    /// That has been told.
    Told = 2,
}

impl Clock {
    /// The clock before anything is set.
    pub const START: Clock = Clock {
        time: 0.0,
        limit: NOWHERE,
        rate_limit: 0,
        stop: f64::MAX,
        phase: Phase::Instantiated,
        experiment_defined: false,
        curved: false,
        guard: Guarded::Unseen,
    };

    /// Whether a step from `time` to `end`, of length `step` \[s\], needs no further checks. Steps that are not longer than
    /// `shortest` \[s\] need one.
    #[inline(always)]
    pub fn takes(&self, time: f64, end: f64, step: f64, shortest: f64) -> bool {
        // an infinite step ends beyond the limit
        let beyond = end > self.limit;
        self.follows(time, step - shortest) && !beyond
    }

    /// Whether an input may be set to `rate` \[m/s\] without further checks.
    #[inline(always)]
    pub fn takes_rate(&self, rate: f64) -> bool {
        size(rate) < self.rate_limit
    }

    /// Whether a step of length `step` \[s\] from `time` clearly follows the last one. It is false if the step is zero,
    /// negative or NaN, because no distance is smaller than such a step.
    #[inline(always)]
    fn follows(&self, time: f64, step: f64) -> bool {
        (time - self.time).abs() * (1.0 / TIME_TOLERANCE) < step
    }

    /// Checks a step, which must be longer than `shortest` \[s\].
    ///
    /// # Errors
    /// [`Fault::StepSize`], [`Fault::CommunicationPoint`], [`Fault::TooLate`], [`Fault::BeyondStopTime`].
    pub fn check(&self, time: f64, step: f64, shortest: f64) -> Result<(), Fault> {
        if !(step > shortest && step < f64::INFINITY) {
            return Err(Fault::StepSize { step, shortest });
        }
        let rounding = TIME_ROUNDING * (time.abs() + self.time.abs());
        let follows = time.is_finite() && (time - self.time).abs() <= TIME_TOLERANCE * step + rounding;
        if !follows {
            return Err(Fault::CommunicationPoint { given: time, expected: self.time });
        }
        let end = time + step;
        let in_range = end <= LATEST;
        if !in_range {
            return Err(Fault::TooLate { end });
        }
        let in_time = end - self.stop <= STOP_TOLERANCE * step + rounding;
        if !in_time {
            return Err(Fault::BeyondStopTime { end, stop: self.stop });
        }
        Ok(())
    }

    /// Sets start and stop time \[s\]. An infinite stop time is none.
    ///
    /// # Errors
    /// [`Fault::Experiment`] for a start beyond [`LATEST`], a stop that is NaN or before the start.
    pub fn set_experiment(&mut self, start: f64, stop: Option<f64>) -> Result<(), Fault> {
        let stop = stop.filter(|&stop| stop != f64::INFINITY);
        // false for NaN
        let stop_is_fine = stop.is_none_or(|stop| stop >= start);
        // a NaN is in no range
        let start_is_fine = (-LATEST..=LATEST).contains(&start);
        if !start_is_fine || !stop_is_fine {
            return Err(Fault::Experiment { start, stop: stop.unwrap_or(f64::MAX) });
        }
        self.time = start;
        self.stop = stop.unwrap_or(f64::MAX);
        self.experiment_defined = true;
        Ok(())
    }

    /// Sets the phase. Between steps, inputs up to `largest_rate` \[m/s\] need no further checks.
    pub fn set_phase(&mut self, phase: Phase, largest_rate: f64) {
        self.phase = phase;
        self.rate_limit = if phase == Phase::StepComplete { size(largest_rate) + 1 } else { 0 };
        self.hold();
        self.release();
    }

    /// Prevents plain steps from now on.
    pub fn hold(&mut self) {
        self.limit = NOWHERE;
    }

    /// Allows plain steps again.
    pub fn release(&mut self) {
        if self.phase == Phase::StepComplete {
            self.limit = if self.stop < LATEST { self.stop } else { LATEST };
        }
    }

    /// Stop time \[s\].
    pub fn stop(&self) -> f64 {
        self.stop
    }

    /// The clock with these times and flags; `None` if a time is out of range.
    pub fn of(time: f64, stop: f64, phase: Phase, experiment_defined: bool) -> Option<Clock> {
        // a NaN is in no range
        let in_range = (-LATEST..=LATEST).contains(&time) && stop.is_finite();
        let mut clock = Clock { time, stop, phase, experiment_defined, ..Clock::START };
        clock.release();
        in_range.then_some(clock)
    }
}
