//! Phase and time of an instance.

use super::fault::Fault;

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
    pub const ALL: [Phase; 5] =
        [Phase::Instantiated, Phase::Initialization, Phase::StepComplete, Phase::Terminated, Phase::Error];
}

/// The latest time, and the opposite of the earliest one \[s\]. While no rate is above [`FASTEST`](super::FASTEST) no contact
/// leaves the range of a law that is made of segments before.
pub const LATEST: f64 = 1e50;

/// How far a communication point may be from the end of the last step, in steps. Masters count `t += h` or `start + i h`;
/// either is within rounding of the last end, and half a step off is a mistake.
const TIME_TOLERANCE: f64 = 0.1;

/// How far a step may end behind the stop time, in steps: room for the rounding of some thousand sums, far below the
/// hundredth of a step that would be a mistake.
const STOP_TOLERANCE: f64 = 1e-3;

/// A limit before every time \[s\].
const NOWHERE: f64 = f64::NEG_INFINITY;

/// A [`Clock::lowest_rate`] that no rate is above.
const NO_RATE: f64 = f64::INFINITY;

/// Room for rounding of a time far from zero, as a fraction of it.
const TIME_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Phase and time.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Clock {
    /// End of the last step \[s\], or the start time.
    pub time: f64,
    /// Where plain steps end \[s\]: at the stop time while stepping, and nowhere otherwise.
    limit: f64,
    /// From here to its opposite \[m/s\] an input may be set without a further look: between steps, and beyond all otherwise.
    /// Negative, so that the comparison has its second number in memory.
    lowest_rate: f64,
    stop: f64,
    pub phase: Phase,
    pub experiment_defined: bool,
    /// A derivative of an input is set, or was in the last step: no step is plain then.
    pub curved: bool,
}

impl Clock {
    /// Before anything is set.
    pub const START: Clock = Clock {
        time: 0.0,
        limit: NOWHERE,
        lowest_rate: NO_RATE,
        stop: f64::MAX,
        phase: Phase::Instantiated,
        experiment_defined: false,
        curved: false,
    };

    /// Whether a step from `time` to `end`, `step` \[s\] long, is plainly in order.
    #[inline(always)]
    pub fn takes(&self, time: f64, end: f64, step: f64) -> bool {
        // an infinite step ends beyond the limit
        let beyond = end > self.limit;
        self.follows(time, step) && !beyond
    }

    /// The same for a step while [held](Clock::hold), if it is one in which [inputs may be set](Clock::takes_rate).
    #[inline(always)]
    pub fn takes_held(&self, time: f64, end: f64, step: f64) -> bool {
        self.follows(time, step) && end <= self.stop && end <= LATEST
    }

    /// Whether an input may be set to `rate` \[m/s\] without a further look.
    #[inline(always)]
    pub fn takes_rate(&self, rate: f64) -> bool {
        // a NaN is not
        -rate.abs() >= self.lowest_rate
    }

    /// Whether a step from `time` that is `step` \[s\] long plainly follows the last one: one that is zero, negative or NaN is not
    /// larger than any distance.
    #[inline(always)]
    fn follows(&self, time: f64, step: f64) -> bool {
        (time - self.time).abs() * (1.0 / TIME_TOLERANCE) < step
    }

    /// Whether such a step is in order.
    ///
    /// # Errors
    /// [`Fault::StepSize`], [`Fault::CommunicationPoint`], [`Fault::TooLate`], [`Fault::BeyondStopTime`].
    pub fn check(&self, time: f64, step: f64) -> Result<(), Fault> {
        if !(step > 0.0 && step < f64::INFINITY) {
            return Err(Fault::StepSize { step });
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

    /// Sets start and stop time \[s\].
    ///
    /// # Errors
    /// [`Fault::Experiment`] for a start beyond [`LATEST`], a stop that is not finite or before the start.
    pub fn set_experiment(&mut self, start: f64, stop: Option<f64>) -> Result<(), Fault> {
        let stop_is_fine = stop.is_none_or(|stop| stop.is_finite() && stop >= start);
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

    /// Sets the phase; `lowest_rate` \[m/s\] holds where inputs may be set.
    pub fn set_phase(&mut self, phase: Phase, lowest_rate: f64) {
        self.phase = phase;
        self.lowest_rate = if phase == Phase::StepComplete { lowest_rate } else { NO_RATE };
        self.hold();
        self.release();
    }

    /// From here on no step is plain.
    pub fn hold(&mut self) {
        self.limit = NOWHERE;
    }

    /// Steps may be plain again.
    pub fn release(&mut self) {
        if self.phase == Phase::StepComplete {
            self.limit = if self.stop < LATEST { self.stop } else { LATEST };
        }
    }

    /// Stop time \[s\].
    pub fn stop(&self) -> f64 {
        self.stop
    }

    /// The clock with these times and flags; `None` if a time isn't in range.
    pub fn of(time: f64, stop: f64, phase: Phase, experiment_defined: bool) -> Option<Clock> {
        // a NaN is in no range
        let in_range = (-LATEST..=LATEST).contains(&time) && stop.is_finite();
        let mut clock = Clock { time, stop, phase, experiment_defined, ..Clock::START };
        clock.release();
        in_range.then_some(clock)
    }
}
