//! Reasons to reject a call, and warnings for the user.

use crate::scene::Real;
use brinell_contact::shared::NotInverseMasses;

/// The reason why an instance rejects a call. The instance does not change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The variable is an output.
    NotSettable,
    /// A parameter cannot be set after initialization.
    FixedParameter {
        /// Its index among the settable values.
        index: usize,
    },
    /// NaN or infinite.
    NotFinite {
        /// Name of the variable.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A rate with an absolute value above [`FASTEST`](super::FASTEST).
    RateOutOfRange {
        /// The rate \[m/s\].
        rate: f64,
    },
    /// An acceleration, or a derivative of a rate, with an absolute value above [`SWIFTEST`](super::SWIFTEST).
    AccelerationOutOfRange {
        /// Name of the variable.
        name: &'static str,
        /// Its unit.
        unit: &'static str,
        /// Its value.
        value: f64,
    },
    /// A rate at which the force of a rate-dependent law would not be finite.
    TooFast {
        /// The rate \[m/s\].
        rate: f64,
    },
    /// A value outside the limits of its parameter.
    OutOfRange {
        /// Its index among the settable values.
        index: usize,
        /// The value.
        value: f64,
    },
    /// An input that not every scene has, outside its range: an effective mass outside of [`MASSES`](super::MASSES), or a
    /// tangential rate with an absolute value above [`FASTEST`](super::FASTEST), possibly within a step with derivatives.
    InputOutOfRange {
        /// The input.
        input: Real,
        /// Its value.
        value: f64,
    },
    /// A step of bodies whose effective mass was set to zero during initialization: it is not known yet.
    UnknownMass {
        /// The contact, counted from 0.
        contact: usize,
    },
    /// The impactor does not fit into the socket.
    NoPointContact {
        /// The contact, counted from 0.
        contact: usize,
        /// Radius of the impactor \[m\].
        impactor: f64,
        /// Radius of the target \[m\], negative.
        target: f64,
    },
    /// Times out of range, or a stop time before the start time.
    Experiment {
        /// Start time \[s\].
        start: f64,
        /// Stop time \[s\].
        stop: f64,
    },
    /// Initialization without a start time.
    NoExperiment,
    /// A step size that is not finite, or too small.
    StepSize {
        /// The step size \[s\].
        step: f64,
        /// All steps must be longer: zero, or [`SHORTEST`](super::SHORTEST) \[s\].
        shortest: f64,
    },
    /// A step that does not begin where the last one ended.
    CommunicationPoint {
        /// Start of the step \[s\].
        given: f64,
        /// End of the last step \[s\].
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
    /// An indentation at which the law cannot be evaluated.
    TooDeep {
        /// The contact, counted from 0.
        contact: usize,
        /// The indentation \[m\].
        indentation: f64,
    },
    /// A step after a contact has become as wide as its smaller body, where no law holds.
    TooWide {
        /// The contact, counted from 0.
        contact: usize,
        /// Radius of the smaller body \[m\].
        size: f64,
    },
    /// A step in which the bodies touch more often than can be computed.
    TooLong {
        /// The contact, counted from 0.
        contact: usize,
        /// The step size \[s\].
        step: f64,
    },
    /// A step in which contacts that share bodies touch, part and turn more often than can be computed.
    TooLongTogether {
        /// The step size \[s\].
        step: f64,
        /// A step that could have been computed \[s\].
        possible: f64,
    },
    /// Inputs that are the inverse masses of no bodies.
    InverseMasses(NotInverseMasses),
    /// A derivative of an order that does not exist.
    DerivativeOrder {
        /// The requested order.
        order: i32,
        /// The highest order that exists.
        largest: i32,
    },
    /// A derivative with respect to time of a variable that is not an output, or of an input that is not an input.
    NoDerivative {
        /// The variables that have derivatives.
        of: &'static str,
    },
    /// A derivative of an output that is not finite.
    DerivativeNotFinite,
    /// A derivative with respect to a variable that is not the input.
    NotAnInput,
    /// Inputs of this scene have no derivatives: its law depends on the rate, the acceleration is a separate input, or the scene
    /// doesn't want them.
    NoInputDerivatives,
}

/// Something that the user should know. The simulation continues.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Warning {
    /// The passivity guard acts.
    Guarded,
    /// A contact is too wide for its law.
    Deep {
        /// The contact, counted from 0.
        contact: usize,
        /// Its largest indentation \[m\].
        indentation: f64,
        /// The indentation up to which the law is valid \[m\].
        allowed: f64,
    },
    /// The importer does not move the bodies as the scene assumes.
    Miswired {
        /// The contact, counted from 0.
        contact: usize,
        /// Its rate \[m/s\].
        rate: f64,
        /// The expected rate \[m/s\].
        expected: f64,
        /// How it moves them.
        cause: Cause,
    },
    /// A step beyond the stability limit of a mass that responds to the force.
    Unstable {
        /// The step \[s\].
        step: f64,
        /// The mass of the scene's impact \[kg\].
        mass: f64,
    },
    /// A mass follows the force of the step before, which makes its rebound less accurate.
    Late,
    /// A contact closes so fast that elastic waves are not negligible.
    Fast {
        /// The contact, counted from 0.
        contact: usize,
        /// Its rate \[m/s\].
        rate: f64,
        /// The rate up to which the law is valid \[m/s\].
        allowed: f64,
    },
}

/// What an importer does otherwise than the scene assumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// It applies the force in the other order of execution.
    Order {
        /// Whether the scene is for an importer that steps all FMUs at once.
        parallel: bool,
    },
    /// It applies no contact force.
    Unmoved,
    /// It moves another mass, or other contacts push the body, too.
    Mass {
        /// The mass that it moves \[kg\].
        moved: f64,
        /// The mass that the FMU moves \[kg\].
        known: f64,
    },
    /// The force of another contact moves a body of this one.
    Shared {
        /// The other contact, counted from 0.
        with: usize,
    },
}
