//! The variables that a scene can have; `modelDescription/variables.toml` is their table.

use brinell_contact::tangential::Quantity;

/// Makes an enum of variables, each with its name in FMUs: the table of variables has an entry of this name. `or` adds a variant
/// that is not in the table.
macro_rules! variables {
    (
        $(#[$says:meta])*
        pub enum $kind:ident { $($(#[$means:meta])* $variant:ident = $name:literal),+ $(,)? }
        $(or { $(#[$other_means:meta])* $other:ident($held:ty) })?
    ) => {
        $(#[$says])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $kind {
            // it is the first: if the numbers of a scene's variables were those of their kinds, the compiler would take the kind for a
            // variable, and could leave out no variable
            $($(#[$other_means])* $other($held),)?
            $($(#[$means])* $variant,)+
        }

        impl $kind {
            /// All that the table has, with their names.
            pub const ALL: [(&'static str, $kind); [$($name),+].len()] = [$(($name, $kind::$variant)),+];

            /// The variable with this place among all of them.
            pub fn of_number(place: u8) -> Option<$kind> {
                const KINDS: [$kind; [$($name),+].len()] = [$($kind::$variant),+];
                KINDS.get(usize::from(place)).copied()
            }

            /// The first variable whose place among all of them is the one. Where the compiler knows for which it is, it leaves out the
            /// others.
            #[inline(always)]
            pub fn found(is: impl Fn(u8) -> bool) -> Option<$kind> {
                enum Place { $($variant),+ }
                $(if is(Place::$variant as u8) {
                    return Some($kind::$variant);
                })+
                None
            }
        }
    };
}

variables! {
    /// A parameter of contacts. Each scene has either a constant or a variable for it.
    pub enum Parameter {
        /// `impactor.radius` \[m\].
        ImpactorRadius = "impactor.radius",
        /// `impactor.youngs_modulus` \[Pa\]; infinite for a rigid impactor.
        ImpactorYoungsModulus = "impactor.youngs_modulus",
        /// `impactor.poissons_ratio` \[-\].
        ImpactorPoissonsRatio = "impactor.poissons_ratio",
        /// `impactor.yield_strength` \[Pa\]; infinite for an impactor that doesn't yield.
        ImpactorYieldStrength = "impactor.yield_strength",
        /// `impactor.hardening_modulus` \[Pa\]; zero for an impactor that doesn't harden.
        ImpactorHardeningModulus = "impactor.hardening_modulus",
        /// `target.radius` \[m\]; infinite for a flat target.
        TargetRadius = "target.radius",
        /// `target.youngs_modulus` \[Pa\].
        TargetYoungsModulus = "target.youngs_modulus",
        /// `target.poissons_ratio` \[-\].
        TargetPoissonsRatio = "target.poissons_ratio",
        /// `target.yield_strength` \[Pa\]; infinite for a target that doesn't yield.
        TargetYieldStrength = "target.yield_strength",
        /// `target.hardening_modulus` \[Pa\]; zero for a target that doesn't harden.
        TargetHardeningModulus = "target.hardening_modulus",
        /// `restitution`, which the damping of a rate-dependent law is made for.
        Restitution = "restitution",
        /// `effective_mass` \[kg\].
        EffectiveMass = "effective_mass",
        /// `initial_gap` \[m\].
        InitialGap = "initial_gap",
        /// `elastic_restitution`, of a loss below yield; 1 without a loss.
        ElasticRestitution = "elastic_restitution",
        /// `target.plate_thickness` \[m\]; infinite for a thick target.
        TargetPlateThickness = "target.plate_thickness",
        /// `friction.coefficient`; zero without friction.
        FrictionCoefficient = "friction.coefficient",
    }
}

impl Parameter {
    /// The value in a scene that does not have the parameter: a rigid impactor, a flat and thick target, bodies that never yield
    /// or do not harden, no damping, no loss below yield, no friction. NaN for a parameter that every scene has.
    #[inline(always)]
    pub const fn without_effect(self) -> f64 {
        match self {
            Parameter::ImpactorYoungsModulus
            | Parameter::ImpactorYieldStrength
            | Parameter::TargetRadius
            | Parameter::TargetYieldStrength
            | Parameter::EffectiveMass
            | Parameter::TargetPlateThickness => f64::INFINITY,
            Parameter::ImpactorPoissonsRatio
            | Parameter::ImpactorHardeningModulus
            | Parameter::TargetHardeningModulus
            | Parameter::FrictionCoefficient => 0.0,
            Parameter::Restitution | Parameter::ElasticRestitution => 1.0,
            Parameter::ImpactorRadius
            | Parameter::TargetYoungsModulus
            | Parameter::TargetPoissonsRatio
            | Parameter::InitialGap => f64::NAN,
        }
    }
}

/// A parameter of the scene that can be set, with its limits.
#[derive(Clone, Copy, Debug)]
pub struct Settable {
    /// Name of the variable, in UTF-8.
    pub name: &'static [u8],
    /// Unit, in UTF-8; empty if there is none.
    pub unit: &'static [u8],
    /// Smallest value allowed.
    pub minimum: f64,
    /// Largest value allowed.
    pub maximum: f64,
}

/// The origin of the value of a parameter.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    /// The parameter with this index among [`Scene::Values`](super::Scene::Values).
    Settable(usize),
    /// A settable parameter with one value for each contact: contact 0 would have this index, which may be below zero.
    PerContact(isize),
    /// A constant of the scene.
    Constant(f64),
}

impl Source {
    /// The value of a parameter of `contact` with this `source`; NaN without a source.
    pub fn value(source: Option<&Source>, contact: usize, settable: &[f64]) -> f64 {
        let index = match source {
            Some(Source::Constant(value)) => return *value,
            Some(Source::Settable(index)) => *index,
            // the first contact of a group with such values may come after the contact of the first value
            Some(Source::PerContact(index)) => contact.wrapping_add_signed(*index),
            None => return f64::NAN,
        };
        settable.get(index).copied().unwrap_or(f64::NAN)
    }
}

variables! {
    /// A variable of type Real.
    pub enum Real {
        /// Indentation rate, the input \[m/s\].
        IndentationRate = "indentation_rate",
        /// Force \[N\].
        Force = "force",
        /// Indentation \[m\].
        Indentation = "indentation",
        /// Largest indentation \[m\].
        MaxIndentation = "max_indentation",
        /// Residual indentation \[m\].
        ResidualIndentation = "residual_indentation",
        /// Contact radius \[m\].
        ContactRadius = "contact_radius",
        /// Contact area \[m^2\].
        ContactArea = "contact_area",
        /// Mean pressure \[Pa\].
        MeanPressure = "mean_pressure",
        /// Stiffness \[N/m\].
        Stiffness = "stiffness",
        /// Work done on the contact \[J\].
        Work = "work",
        /// Elastic energy \[J\].
        ElasticEnergy = "elastic_energy",
        /// Dissipated energy \[J\].
        DissipatedEnergy = "dissipated_energy",
        /// Impulse since the start \[N.s\].
        Impulse = "impulse",
        /// Mean force of the last step \[N\].
        MeanForce = "mean_force",
        /// Predicted force at the end of the next step \[N\].
        PredictedForce = "predicted_force",
        /// Closing speed at the end of a step \[m/s\].
        ClosingSpeed = "closing_speed",
        /// Moment of the impulse of the last step \[N.s^2\].
        ImpulseMoment = "impulse_moment",
        /// Acceleration by all forces except the contact force, an input \[m/s^2\].
        ExternalAcceleration = "external_acceleration",
        /// Tangential acceleration by all forces except those of the contacts, an input \[m/s^2\].
        ExternalTangentialAcceleration = "external_tangential_acceleration",
        /// The same in the second direction.
        SecondExternalTangentialAcceleration = "external_tangential_acceleration[2]",
        /// An inverse mass of contacts that share bodies, an input \[1/kg\]. Instead of a contact, it has the place of the entry in the
        /// upper triangle of the matrix.
        InverseMass = "inverse_mass",
        /// Number of the regime.
        RegimeNumber = "regime_number",
        /// Tangential rate, an input \[m/s\].
        TangentialRate = "tangential_rate",
        /// Tangential rate in the second direction, an input \[m/s\].
        SecondTangentialRate = "tangential_rate[2]",
        /// Tangential force \[N\].
        TangentialForce = "tangential_force",
        /// Tangential force in the second direction \[N\].
        SecondTangentialForce = "tangential_force[2]",
        /// Mean tangential force of the last step \[N\].
        MeanTangentialForce = "mean_tangential_force",
        /// Mean tangential force of the last step in the second direction \[N\].
        SecondMeanTangentialForce = "mean_tangential_force[2]",
        /// Integral of the tangential force since the start \[N.s\].
        TangentialImpulse = "tangential_impulse",
        /// Integral of the tangential force in the second direction since the start \[N.s\].
        SecondTangentialImpulse = "tangential_impulse[2]",
        /// Moment of the tangential impulse of the last step \[N.s^2\].
        TangentialImpulseMoment = "tangential_impulse_moment",
        /// The same in the second direction.
        SecondTangentialImpulseMoment = "tangential_impulse_moment[2]",
        /// Tangential speed at the end of a step \[m/s\].
        TangentialSpeed = "tangential_speed",
        /// The same in the second direction.
        SecondTangentialSpeed = "tangential_speed[2]",
        /// Predicted tangential force at the end of the next step \[N\].
        PredictedTangentialForce = "predicted_tangential_force",
        /// Predicted tangential force in the second direction at the end of the next step \[N\].
        SecondPredictedTangentialForce = "predicted_tangential_force[2]",
        /// Elastic energy of the tangential strain \[J\].
        TangentialEnergy = "tangential_energy",
        /// Energy lost by slip \[J\].
        FrictionWork = "friction_work",
        /// Radius of the stick area \[m\].
        StickRadius = "stick_radius",
        /// Number of the state of sliding.
        SlidingNumber = "sliding_number",
        /// Effective mass, as an input \[kg\].
        EffectiveMass = "effective_mass",
    } or {
        /// The settable parameter with this index among [`Scene::Values`](super::Scene::Values).
        Parameter(usize)
    }
}

impl Real {
    /// Whether it is an output.
    pub fn is_output(self) -> bool {
        !matches!(self, Real::Parameter(_)) && !self.is_input()
    }

    /// Whether it is an input.
    pub fn is_input(self) -> bool {
        matches!(self, Real::IndentationRate | Real::EffectiveMass | Real::InverseMass)
            || self.tangential_rate().is_some()
            || self.external_acceleration().is_some()
    }

    /// The row of a contact of which it is the external acceleration: 0 for the normal, then the tangential directions.
    #[inline(always)]
    pub fn external_acceleration(self) -> Option<usize> {
        match self {
            Real::ExternalAcceleration => Some(0),
            Real::ExternalTangentialAcceleration => Some(1),
            Real::SecondExternalTangentialAcceleration => Some(2),
            _ => None,
        }
    }

    /// Whether it is the number of a state, and jumps.
    pub fn is_number(self) -> bool {
        matches!(self, Real::RegimeNumber | Real::SlidingNumber)
    }

    /// The direction of which it is the tangential rate, counted from 0.
    #[inline(always)]
    pub fn tangential_rate(self) -> Option<usize> {
        match self {
            Real::TangentialRate => Some(0),
            Real::SecondTangentialRate => Some(1),
            _ => None,
        }
    }

    /// The direction of which it is the predicted tangential force, counted from 0.
    #[inline(always)]
    pub fn predicted_direction(self) -> Option<usize> {
        match self {
            Real::PredictedTangentialForce => Some(0),
            Real::SecondPredictedTangentialForce => Some(1),
            _ => None,
        }
    }

    /// The quantity of the friction that it is, if its present value is one.
    pub fn quantity(self) -> Option<Quantity> {
        Some(match self {
            Real::TangentialForce => Quantity::Force(0),
            Real::SecondTangentialForce => Quantity::Force(1),
            Real::MeanTangentialForce => Quantity::MeanForce(0),
            Real::SecondMeanTangentialForce => Quantity::MeanForce(1),
            Real::TangentialImpulse => Quantity::Impulse(0),
            Real::SecondTangentialImpulse => Quantity::Impulse(1),
            Real::TangentialEnergy => Quantity::Energy,
            Real::FrictionWork => Quantity::FrictionWork,
            Real::StickRadius => Quantity::StickRadius,
            _ => return None,
        })
    }
}

variables! {
    /// A variable of type Integer.
    pub enum Integer {
        /// Number of the [`Regime`](brinell_contact::Regime).
        Regime = "regime",
        /// Number of the state of [`Sliding`](brinell_contact::tangential::Sliding).
        Sliding = "sliding",
    }
}
