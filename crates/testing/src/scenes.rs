//! Scenes for instances in plain Rust, without an export: bodies and laws are read from memory when an instance is created.
//!
//! [`Chosen`] is one contact or several, each in its own group, of any [`Kind`]: elastoplastic, rate-dependent, or moved by its
//! mass. Bodies and laws are those that the thread has selected with [`choose`].

mod kinds;

pub use kinds::{
    Damped, DampedMassive, Elastoplastic, Frictional, FrictionalPlane, Guarded, Held, Kind, Lossy, LossyMassive,
    Massive, Rated,
};

use brinell_contact::damped::AnyDamped;
use brinell_contact::loading::AnyLoading;
use brinell_contact::losses::{self, AnyLoss};
use brinell_contact::motion::Follow;
use brinell_contact::rate::Rate;
use brinell_contact::unloading::AnyUnloading;
use brinell_contact::{Contact, Pair, Surface};
use brinell_fmu::instance::Instance;
use brinell_fmu::scene::{Absent, Guard, Integer, Parameter, Presence, Real, Scene, Settable, identity_of};
use std::cell::RefCell;
use std::marker::PhantomData;

/// The properties of an instance.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    pub loading: AnyLoading,
    pub unloading: AnyUnloading,
    pub surface: Surface,
    pub damped: AnyDamped,
    /// Young's modulus of the target of the first contact \[Pa\]; that of each following one is a tenth larger.
    pub youngs_modulus: f64,
    pub poissons_ratio: f64,
    pub yield_strength: f64,
    /// Radius of the impactor \[m\].
    pub radius: f64,
    /// Radius of the target \[m\]: a wide socket, so that a parameter can be set to a value that does not fit.
    pub target_radius: f64,
    pub restitution: f64,
    pub effective_mass: f64,
    pub initial_gap: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// The strength over the strain rate, of [`Rated`] contacts.
    pub rate: Rate,
    /// The loss below yield, of [`Lossy`] contacts.
    pub loss: AnyLoss,
}

impl Choice {
    /// The default scene's bodies with these laws.
    pub fn of(loading: AnyLoading, unloading: AnyUnloading) -> Choice {
        Choice {
            loading,
            unloading,
            surface: Surface::Dented,
            damped: AnyDamped::ALL[0].1,
            youngs_modulus: 206e9,
            poissons_ratio: 0.3,
            yield_strength: 300e6,
            radius: 5e-3,
            target_radius: -1e3,
            restitution: 0.6,
            effective_mass: 4.11e-3,
            initial_gap: 0.0,
            friction: 0.3,
            rate: Rate::CowperSymonds { d: 40.4, q: 5.0 },
            loss: AnyLoss::RestitutionFitted(losses::RestitutionFitted { restitution: 0.9 }),
        }
    }
}

thread_local! {
    static CHOICE: RefCell<Option<Choice>> = const { RefCell::new(None) };
}

/// Selects the properties of new instances in this thread.
pub fn choose(choice: Choice) {
    CHOICE.with(|slot| *slot.borrow_mut() = Some(choice));
}

fn chosen() -> Choice {
    CHOICE.with(|slot| slot.borrow().expect("a test chooses before it makes an instance"))
}

/// `N` contacts of a kind with the momentum `M`, each in its own group.
pub struct Chosen<K, const N: usize, M = Absent>(PhantomData<(K, M)>);

/// Whether forces are stored: there are many scenes in which they are.
type Kept = Absent;

static SETTABLE: [Settable; 3] = [
    Settable { name: b"impactor.radius", unit: b"m", minimum: 1e-12, maximum: 1e9 },
    Settable { name: b"target.yield_strength", unit: b"Pa", minimum: 1e-9, maximum: 1e18 },
    Settable { name: b"initial_gap", unit: b"m", minimum: -1e6, maximum: 1e6 },
];

/// Every Real output, in the order of their references.
pub const OUTPUTS: [Real; 13] = [
    Real::Force,
    Real::Indentation,
    Real::MaxIndentation,
    Real::ResidualIndentation,
    Real::ContactRadius,
    Real::MeanPressure,
    Real::Stiffness,
    Real::Work,
    Real::ElasticEnergy,
    Real::DissipatedEnergy,
    Real::Impulse,
    Real::MeanForce,
    Real::PredictedForce,
];

/// The Real outputs of contacts with friction. They have no references.
pub const FRICTIONS: [Real; 7] = [
    Real::TangentialForce,
    Real::MeanTangentialForce,
    Real::TangentialImpulse,
    Real::PredictedTangentialForce,
    Real::TangentialEnergy,
    Real::FrictionWork,
    Real::StickRadius,
];

impl<K: Kind, const N: usize, M: Presence> Scene for Chosen<K, N, M> {
    type Model = K::Model;
    type Contact = K::Contact;
    type Rows<T: Copy> = Self::Contacts<T>;
    type Contacts<T: Copy> = [T; N];
    type Groups<T: Copy> = [T; N];
    type Values = [f64; 3];
    type Forces = Kept;
    type Momentum = M;
    type InputDerivatives = K::InputDerivatives;
    type Prediction = M;
    type Coupling = K::Coupling;
    type Watch = K::Watch;
    type Shared = Absent;
    type InverseMasses = [f64; 0];
    type Prepared = Absent;

    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        K::FOLLOW
    }

    fn guard() -> Option<Guard<Self>> {
        K::GUARD.map(|acts| Guard { words: b"", acts })
    }

    fn guid() -> &'static [u8] {
        b"a scene of the tests"
    }

    fn identity() -> u64 {
        identity_of(std::any::type_name::<Self>())
    }

    fn group(contact: usize) -> usize {
        contact
    }

    fn end(group: usize) -> usize {
        group + 1
    }

    fn contact_name(contact: usize) -> (&'static [u8], usize) {
        (b"contact", contact + 1)
    }

    fn settable(index: usize) -> Option<(Settable, Option<usize>)> {
        SETTABLE.get(index).copied().map(|settable| (settable, None))
    }

    fn impact_mass() -> f64 {
        chosen().effective_mass
    }

    fn set_start_values(values: &mut [f64; 3]) {
        let choice = chosen();
        *values = [choice.radius, choice.yield_strength, choice.initial_gap];
    }

    fn parameter(parameter: Parameter, group: usize, values: &[f64; 3]) -> f64 {
        let choice = chosen();
        match parameter {
            Parameter::ImpactorRadius => values[0],
            Parameter::ImpactorYoungsModulus => f64::INFINITY,
            Parameter::ImpactorPoissonsRatio => 0.0,
            Parameter::TargetRadius => choice.target_radius,
            Parameter::TargetYoungsModulus => choice.youngs_modulus * 1.1f64.powi(group as i32),
            Parameter::TargetPoissonsRatio => choice.poissons_ratio,
            Parameter::ImpactorYieldStrength => f64::INFINITY,
            Parameter::ImpactorHardeningModulus => 0.0,
            Parameter::TargetYieldStrength => values[1],
            Parameter::TargetHardeningModulus => 0.0,
            Parameter::Restitution => choice.restitution,
            Parameter::EffectiveMass => choice.effective_mass,
            Parameter::InitialGap => values[2],
            Parameter::ElasticRestitution => 1.0,
            Parameter::TargetPlateThickness => f64::INFINITY,
            Parameter::FrictionCoefficient => choice.friction,
        }
    }

    fn model(pair: Pair, group: usize, values: &[f64; 3]) -> K::Model {
        let value = |which| Self::parameter(which, group, values);
        K::model(pair, value(Parameter::Restitution), value(Parameter::EffectiveMass))
    }

    fn density(_group: usize) -> Option<f64> {
        None
    }

    fn real(value_reference: u32) -> Option<(Real, usize)> {
        let (kind, contact) = (value_reference as usize / N, value_reference as usize % N);
        match kind {
            0 => Some((Real::IndentationRate, contact)),
            kind if kind <= OUTPUTS.len() => Some((OUTPUTS[kind - 1], contact)),
            kind => {
                let index = value_reference as usize - (OUTPUTS.len() + 2) * N;
                let _ = kind;
                (kind > OUTPUTS.len() + 1 && index < SETTABLE.len()).then_some((Real::Parameter(index), 0))
            }
        }
    }

    fn integer(value_reference: u32) -> Option<(Integer, usize)> {
        let (kind, contact) = (value_reference as usize / N, value_reference as usize % N);
        (kind == OUTPUTS.len() + 1).then_some((Integer::Regime, contact))
    }
}

/// An instance that is ready for its first step.
pub fn ready<S: Scene>() -> Instance<S> {
    let mut instance = Instance::<S>::new().expect("the bodies fit");
    instance.set_experiment(0.0, None).expect("zero is a time");
    instance.enter_initialization().expect("there is a start time");
    instance.exit_initialization().expect("the bodies fit");
    instance
}

/// Sets the rate of `contact` \[m/s\], which must be accepted.
pub fn set_rate<S: Scene>(instance: &mut Instance<S>, contact: usize, rate: f64) {
    let variable = (Real::IndentationRate, contact);
    instance.check_real(variable, rate).expect("the rate is allowed");
    instance.set_real(variable, rate);
}

/// Sets the tangential rate of `contact` \[m/s\], which must be accepted; with two directions, another one in the second.
pub fn set_tangential_rate<S: Scene>(instance: &mut Instance<S>, contact: usize, rate: f64) {
    let both = [(Real::TangentialRate, rate), (Real::SecondTangentialRate, 0.7 * (rate * rate - 0.5))];
    for (input, rate) in both.into_iter().take(S::Contact::DIRECTIONS) {
        instance.check_real((input, contact), rate).expect("the rate is allowed");
        instance.set_real((input, contact), rate);
    }
}

/// The outputs of friction that a contact has.
pub fn frictions<S: Scene>() -> impl Iterator<Item = Real> {
    let second = [
        Real::SecondTangentialForce,
        Real::SecondMeanTangentialForce,
        Real::SecondTangentialImpulse,
        Real::SecondPredictedTangentialForce,
    ];
    let first = FRICTIONS.into_iter().filter(|_| S::Contact::DIRECTIONS > 0);
    first.chain(second.into_iter().filter(|_| S::Contact::DIRECTIONS > 1))
}

/// Every Real output of every contact, and the regimes.
pub fn outputs<S: Scene>(instance: &Instance<S>) -> Vec<f64> {
    let contacts = 0..S::contacts();
    let reals = contacts.clone().flat_map(|contact| OUTPUTS.map(|output| (output, contact)));
    let shown = |output: Real| {
        let momentum = matches!(output, Real::Impulse | Real::MeanForce | Real::PredictedForce)
            || output.predicted_direction().is_some();
        S::Momentum::IS_PRESENT || !momentum
    };
    let mut all: Vec<f64> =
        reals.filter(|(output, _)| shown(*output)).map(|variable| instance.real(variable)).collect();
    if S::Contact::HAS_FRICTION {
        let frictions = contacts.clone().flat_map(|contact| frictions::<S>().map(move |output| (output, contact)));
        all.extend(frictions.filter(|(output, _)| shown(*output)).map(|variable| instance.real(variable)));
        all.extend(contacts.clone().map(|contact| f64::from(instance.integer((Integer::Sliding, contact)))));
    }
    all.extend(contacts.map(|contact| f64::from(instance.integer((Integer::Regime, contact)))));
    all
}

/// The words of an instance.
pub fn words<S: Scene>(instance: &Instance<S>) -> Vec<u64> {
    let mut words = Vec::new();
    instance.save(|word| words.push(word));
    assert_eq!(words.len(), Instance::<S>::words());
    words
}
