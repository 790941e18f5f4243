//! What can go wrong in an instance, and what its user should know, with the data that a message needs.

use crate::instance::Phase;
use crate::variable::Settable;

/// A refused call; the last three are warnings, and nothing is refused.
#[derive(Clone, Copy, Debug)]
pub enum Fault {
    /// An instance can't be made.
    BadInstance {
        /// Why.
        reason: &'static str,
    },
    /// The call doesn't belong in this phase.
    OutOfOrder {
        /// The phase the instance is in.
        phase: Phase,
    },
    /// A pointer that must not be null is.
    NullPointer {
        /// Name of the argument.
        argument: &'static str,
    },
    /// No variable of this type has this reference.
    UnknownReference {
        /// Type of the call.
        kind: &'static str,
        /// The reference.
        reference: u32,
    },
    /// The variable is an output.
    NotSettable,
    /// A parameter after initialization.
    FixedParameter {
        /// Its name.
        name: &'static str,
    },
    /// NaN or infinite.
    NotFinite {
        /// Name of the variable.
        name: &'static str,
        /// The value.
        value: f64,
    },
    /// A rate at which the force of a rate-dependent law is beyond all numbers.
    TooFast {
        /// The rate \[m/s\].
        rate: f64,
    },
    /// Outside the limits of the parameter.
    OutOfRange {
        /// The parameter.
        settable: &'static Settable,
        /// The value.
        value: f64,
    },
    /// The impactor doesn't fit into the socket.
    NoPointContact {
        /// Radius of the impactor \[m\].
        impactor: f64,
        /// Radius of the target \[m\], negative.
        target: f64,
    },
    /// Times that are not finite, or a stop before the start.
    Experiment {
        /// Start time \[s\].
        start: f64,
        /// Stop time \[s\].
        stop: f64,
    },
    /// Initialization without start time.
    NoExperiment,
    /// A step that is not positive and finite.
    StepSize {
        /// The step \[s\].
        step: f64,
    },
    /// A step that doesn't begin where the last one ended.
    CommunicationPoint {
        /// Begin of the step \[s\].
        given: f64,
        /// End of the last one \[s\].
        expected: f64,
    },
    /// A step beyond the stop time.
    BeyondStopTime {
        /// End of the step \[s\].
        end: f64,
        /// Stop time \[s\].
        stop: f64,
    },
    /// An indentation for which the law can't be evaluated.
    TooDeep {
        /// Which contact, counted from 0.
        contact: usize,
        /// The indentation \[m\].
        indentation: f64,
    },
    /// A derivative of an order that there isn't.
    DerivativeOrder {
        /// The order asked for.
        order: i32,
        /// The largest there is.
        largest: i32,
    },
    /// A derivative of a variable that has none.
    NoDerivative {
        /// Of what there are derivatives.
        of: &'static str,
    },
    /// A step in which the bodies meet more often than can be followed.
    TooLong {
        /// The step \[s\].
        step: f64,
    },
    /// The unit doesn't have this capability.
    Unsupported,
    /// There is no such information.
    Unavailable,
    /// Logging of a category that isn't declared.
    UnknownCategory,
    /// A state that this unit didn't make, or a damaged one.
    BadState {
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The host gave no memory.
    NoMemory,
    /// The passivity guard acts.
    Guarded,
    /// A contact is too wide for its law.
    Deep {
        /// Which contact, counted from 0.
        contact: u32,
        /// Its largest indentation \[m\].
        indentation: f64,
        /// Up to which the law is valid \[m\].
        allowed: f64,
    },
    /// A contact closes so fast that waves take more energy than can be left out.
    Fast {
        /// Which contact, counted from 0.
        contact: u32,
        /// Its rate \[m/s\].
        rate: f64,
        /// Up to which the law is valid \[m/s\].
        allowed: f64,
    },
}
