//! Reasons to refuse a call, and warnings for the user.

/// Why an instance refuses something. It is then as it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The variable is an output.
    NotSettable,
    /// A parameter after initialization.
    FixedParameter {
        /// Its place among those that can be set.
        index: usize,
    },
    /// NaN or infinite.
    NotFinite {
        /// What it is.
        name: &'static str,
        /// The value.
        value: f64,
    },
    /// A rate beyond [`FASTEST`](super::FASTEST).
    RateOutOfRange {
        /// The rate \[m/s\].
        rate: f64,
    },
    /// A rate at which the force of a rate-dependent law is beyond all numbers.
    TooFast {
        /// The rate \[m/s\].
        rate: f64,
    },
    /// Outside the limits of the parameter.
    OutOfRange {
        /// Its place among those that can be set.
        index: usize,
        /// The value.
        value: f64,
    },
    /// An effective mass out of its range.
    MassOutOfRange {
        /// The mass \[kg\].
        mass: f64,
    },
    /// The impactor doesn't fit into the socket.
    NoPointContact {
        /// Which contact, counted from 0.
        contact: usize,
        /// Radius of the impactor \[m\].
        impactor: f64,
        /// Radius of the target \[m\], negative.
        target: f64,
    },
    /// Times that are out of range, or a stop before the start.
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
    /// A step that ends after [`LATEST`](super::LATEST).
    TooLate {
        /// End of the step \[s\].
        end: f64,
    },
    /// An indentation for which the law can't be evaluated.
    TooDeep {
        /// Which contact, counted from 0.
        contact: usize,
        /// The indentation \[m\].
        indentation: f64,
    },
    /// A step in which the bodies meet more often than can be followed.
    TooLong {
        /// Which contact, counted from 0.
        contact: usize,
        /// The step \[s\].
        step: f64,
    },
    /// A derivative of an order that there isn't.
    DerivativeOrder {
        /// The order asked for.
        order: i32,
        /// The largest there is.
        largest: i32,
    },
    /// A derivative by time of a variable that is not an output, or of an input that is none.
    NoDerivative {
        /// Of what there are derivatives.
        of: &'static str,
    },
    /// A derivative of an output that is beyond all numbers.
    DerivativeNotFinite,
    /// A derivative by a variable that is not the input.
    NotAnInput,
    /// Inputs of this scene have no derivatives: its law follows the rate, or the acceleration is an input of its own.
    NoInputDerivatives,
}

/// What a user should know of a simulation that goes on all the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Warning {
    /// The passivity guard acts.
    Guarded,
    /// A contact is too wide for its law.
    Deep {
        /// Which contact, counted from 0.
        contact: usize,
        /// Its largest indentation \[m\].
        indentation: f64,
        /// Up to which the law is valid \[m\].
        allowed: f64,
    },
    /// The master applies the force in another order than the scene is made for.
    Miswired {
        /// Which contact, counted from 0.
        contact: usize,
        /// Its rate \[m/s\].
        rate: f64,
        /// What its rate had to be \[m/s\].
        expected: f64,
        /// Whether the scene is made for a master that steps all units at once.
        parallel: bool,
    },
    /// A mass that answers the force is stepped further than is stable.
    Unstable {
        /// The step \[s\].
        step: f64,
        /// The mass of the scene's impact \[kg\].
        mass: f64,
    },
    /// A contact closes so fast that waves take more energy than can be left out.
    Fast {
        /// Which contact, counted from 0.
        contact: usize,
        /// Its rate \[m/s\].
        rate: f64,
        /// Up to which the law is valid \[m/s\].
        allowed: f64,
    },
}
