//! The variables that a scene can have; `modelDescription/variables.toml` is their table.

/// A parameter that a scene can have; each scene has a value or a variable for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// `impactor.radius` \[m\].
    ImpactorRadius,
    /// `impactor.youngs_modulus` \[Pa\]; infinite for a rigid impactor.
    ImpactorYoungsModulus,
    /// `impactor.poissons_ratio`.
    ImpactorPoissonsRatio,
    /// `target.radius` \[m\]; infinite for a flat target.
    TargetRadius,
    /// `target.youngs_modulus` \[Pa\].
    TargetYoungsModulus,
    /// `target.poissons_ratio`.
    TargetPoissonsRatio,
    /// `target.yield_strength` \[Pa\]; infinite for an elastic contact.
    TargetYieldStrength,
    /// `restitution`, which the damping of a rate-dependent law is made for.
    Restitution,
    /// `effective_mass` \[kg\].
    EffectiveMass,
    /// `initial_gap` \[m\].
    InitialGap,
}

impl Parameter {
    /// How many there are.
    pub const COUNT: usize = Parameter::InitialGap as usize + 1;
}

/// A parameter of the scene that can be set, with its limits.
#[derive(Clone, Copy, Debug)]
pub struct Settable {
    /// Name of the variable.
    pub name: &'static str,
    /// Unit, or "".
    pub unit: &'static str,
    /// Smallest value allowed.
    pub minimum: f64,
    /// Largest value allowed.
    pub maximum: f64,
}

/// Where a parameter has its value from, if groups of contacts differ.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// From the parameter with this index among [`Scene::Values`](super::Scene::Values).
    Settable(usize),
    /// From the scene.
    Constant(f64),
}

impl Source {
    /// The value that a parameter has from `source`; NaN without one.
    pub fn value(source: Option<&Source>, settable: &[f64]) -> f64 {
        match source {
            Some(Source::Constant(value)) => *value,
            Some(Source::Settable(index)) => settable.get(*index).copied().unwrap_or(f64::NAN),
            None => f64::NAN,
        }
    }
}

/// A variable of type Real.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Real {
    /// The input \[m/s\].
    IndentationRate,
    /// \[N\]
    Force,
    /// \[m\]
    Indentation,
    /// \[m\]
    MaxIndentation,
    /// \[m\]
    ResidualIndentation,
    /// \[m\]
    ContactRadius,
    /// \[Pa\]
    MeanPressure,
    /// \[N/m\]
    Stiffness,
    /// \[J\]
    Work,
    /// \[J\]
    ElasticEnergy,
    /// \[J\]
    DissipatedEnergy,
    /// \[N.s\]
    Impulse,
    /// \[N\]
    MeanForce,
    /// \[N\]
    PredictedForce,
    /// Closing speed at the end of a step \[m/s\].
    ClosingSpeed,
    /// The acceleration by all other forces, an input \[m/s^2\].
    ExternalAcceleration,
    /// The effective mass as an input \[kg\].
    EffectiveMass,
    /// The settable parameter with this index among [`Scene::Values`](super::Scene::Values).
    Parameter(usize),
}

impl Real {
    /// Whether it is an output.
    pub fn is_output(self) -> bool {
        !matches!(self, Real::Parameter(_)) && !self.is_input()
    }

    /// Whether it is an input.
    pub fn is_input(self) -> bool {
        matches!(self, Real::IndentationRate | Real::ExternalAcceleration | Real::EffectiveMass)
    }
}

/// A variable of type Integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integer {
    /// Number of the [`Regime`](crate::contact::Regime).
    Regime,
}

/// Which kind of variable a value reference means, and of which contact: those of a kind follow each other.
#[inline(always)]
pub fn kind_and_contact(value_reference: u32, contacts: usize) -> (u32, usize) {
    let contacts = contacts as u32;
    let kind = value_reference.checked_div(contacts).unwrap_or(0);
    (kind, (value_reference - kind * contacts) as usize)
}
