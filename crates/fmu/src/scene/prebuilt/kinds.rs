//! The kinds of prebuilt libraries: what costs in a step or in an instance. Each takes every scene that needs no more than it has.

use super::block::{Data, Flag, Loss};
use super::{Given, Kind};
use crate::c::span::Span;
use crate::scene::described::LossOfScene;
use crate::scene::{Absent, Acts, Coupled, Parameter, Present, impactor_yields, two_bodies, with_friction};
use brinell_contact::damped::{self, AnyDamped};
use brinell_contact::loading::{AnyLoading, Hertz};
use brinell_contact::losses::{self, AnyLoss, Fitted, Plate, Waves};
use brinell_contact::motion::{self, Follow};
use brinell_contact::rate;
use brinell_contact::shared::{self, InverseMasses, Outcome, Refused, Work};
use brinell_contact::tangential::{PlaneContact, RoughContact, RoughModel};
use brinell_contact::unloading::{AnyUnloading, ContactRadius};
use brinell_contact::{History, Model};
use core::borrow::Borrow;

/// Number of segments in which the springs of a contact with friction remember its past.
pub const MEMORY: usize = 16;

/// An elastoplastic model.
type Plain = Model<AnyLoading, AnyUnloading>;

/// A model with a loss below yield.
type WithLoss = losses::Model<AnyLoading, AnyUnloading, AnyLoss>;

/// The state of a contact with a loss.
type LossyHistory = losses::History<AnyLoss>;

/// One contact without its momentum.
pub struct State;

/// Any contacts, with their momentum.
pub struct Momentum;

/// Contacts that move their bodies, each for itself or together.
pub struct Moved;

/// Contacts with losses below yield, which may move their bodies.
pub struct Lossy;

/// Contacts that move their bodies and find their strength at the first touch of each impact.
pub struct Rated;

/// Contacts with a rate-dependent law, which may move their bodies.
pub struct Damped;

/// Contacts with friction in one direction, which may move their bodies together.
pub struct Rough;

/// The same with friction in two directions.
pub struct Plane;

/// The same as [`Rough`] with losses below yield.
pub struct LossyRough;

/// The same as [`Plane`] with losses below yield.
pub struct LossyPlane;

/// Any coupling.
type Any = Coupled<Present, Present, Present>;

/// The elastoplastic model of a scene.
fn plain(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Plain {
    let loading = AnyLoading::from_numbers(&data.loading).unwrap_or(AnyLoading::Hertz(Hertz));
    let unloading = AnyUnloading::from_numbers(&data.unloading).unwrap_or(AnyUnloading::ContactRadius(ContactRadius));
    let (pair, surface) = (given.pair, given.surface);
    if !data.has(Flag::Paired) {
        return Model { pair, loading, unloading, surface };
    }
    Model { pair, loading: loading.paired(two_bodies(&value)).unwrap_or(loading), unloading, surface }
}

/// The loss of a scene.
fn loss(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> AnyLoss {
    match data.loss {
        waves if waves == Loss::Waves as u64 => AnyLoss::Waves(Waves::given(value, given.density)),
        plate if plate == Loss::Plate as u64 => AnyLoss::Plate(Plate::given(value, given.density)),
        _ => AnyLoss::Fitted(Fitted::given(value, given.density)),
    }
}

/// The parts of a kind that moves several contacts together.
macro_rules! together {
    () => {
        type Shared = Present;

        fn follow_together<B: Borrow<Self::Model>>(
            contacts: &mut [Self::Contact],
            model: impl Fn(usize) -> B,
            masses: &InverseMasses,
            accelerations: &[f64],
            rates: &mut [f64],
            work: &mut [Work<Self::Contact>],
            step: f64,
        ) -> Result<Outcome, Refused> {
            shared::follow(contacts, model, masses, accelerations, rates, work, step)
        }
    };
}

/// The parts of a kind that has a guard.
macro_rules! guarded {
    () => {
        fn guard() -> Option<Acts<Self::Contact, Self::Model>> {
            Some(Self::Contact::is_held_back)
        }
    };
}

impl Kind for State {
    type Model = Plain;
    type Contact = History;
    type Contacts<T: Copy> = [T; 1];
    type Forces = Absent;
    type Momentum = Absent;
    type Coupling = Absent;
    type Watch = Present;
    type Shared = Absent;
    guarded!();

    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Plain {
        plain(data, given, value)
    }
}

impl Kind for Momentum {
    type Model = Plain;
    type Contact = History;
    type Contacts<T: Copy> = Span<T>;
    type Forces = Present;
    type Momentum = Present;
    type Coupling = Absent;
    type Watch = Present;
    type Shared = Absent;
    guarded!();

    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Plain {
        plain(data, given, value)
    }
}

impl Kind for Moved {
    type Model = Plain;
    type Contact = History;
    type Contacts<T: Copy> = Span<T>;
    type Forces = Present;
    type Momentum = Present;
    type Coupling = Any;
    type Watch = Absent;
    guarded!();
    together!();

    fn follow() -> Option<Follow<History, Plain>> {
        Some(motion::follow)
    }

    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Plain {
        plain(data, given, value)
    }
}

impl Kind for Lossy {
    type Model = WithLoss;
    type Contact = LossyHistory;
    type Contacts<T: Copy> = Span<T>;
    type Forces = Present;
    type Momentum = Present;
    type Coupling = Any;
    type Watch = Present;
    guarded!();
    together!();

    fn follow() -> Option<Follow<LossyHistory, WithLoss>> {
        Some(losses::follow)
    }

    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> WithLoss {
        losses::Model { plastic: plain(data, given, &value), loss: loss(data, given, value) }
    }
}

impl Kind for Rated {
    type Model = rate::Model<AnyLoading, AnyUnloading>;
    type Contact = rate::History;
    type Contacts<T: Copy> = Span<T>;
    type Forces = Present;
    type Momentum = Present;
    type Coupling = Any;
    type Watch = Absent;
    type Shared = Absent;
    guarded!();

    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        Some(rate::follow)
    }

    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Self::Model {
        let [target, impactor] = data.rates.map(|rate| rate.rate());
        let slow = plain(data, given, &value);
        match impactor_yields(value) {
            true => rate::Model { slow, rate: impactor, harder: target },
            false => rate::Model { slow, rate: target, harder: impactor },
        }
    }
}

impl Kind for Damped {
    type Model = damped::Model<AnyDamped>;
    type Contact = damped::History<AnyDamped>;
    type Contacts<T: Copy> = Span<T>;
    type Forces = Present;
    type Momentum = Present;
    type Coupling = Any;
    type Watch = Present;
    type Shared = Absent;

    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        Some(damped::follow)
    }

    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Self::Model {
        let law = AnyDamped::from_numbers(&data.loading).unwrap_or(AnyDamped::ALL[0].1);
        let [restitution, mass] = [Parameter::Restitution, Parameter::EffectiveMass].map(value);
        damped::Model { pair: given.pair, law, restitution, mass }
    }
}

/// A kind with friction.
macro_rules! rough {
    ($kind:ident: $contact:ty, $loss:ty, $follows:expr) => {
        impl Kind for $kind {
            type Model = RoughModel<AnyLoading, AnyUnloading, $loss>;
            type Contact = $contact;
            type Contacts<T: Copy> = Span<T>;
            type Forces = Present;
            type Momentum = Present;
            type Coupling = Any;
            type Watch = Present;
            together!();

            fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64) -> Self::Model {
                let loss: fn(&Data, &Given, &dyn Fn(Parameter) -> f64) -> $loss = $follows;
                with_friction(plain(data, given, &value), loss(data, given, &value), value)
            }
        }
    };
}

rough!(Rough: RoughContact<MEMORY, true>, (), |_, _, _| ());
rough!(Plane: PlaneContact<MEMORY, true>, (), |_, _, _| ());
rough!(LossyRough: RoughContact<MEMORY, true, LossyHistory>, AnyLoss, |data, given, value| loss(data, given, value));
rough!(LossyPlane: PlaneContact<MEMORY, true, LossyHistory>, AnyLoss, |data, given, value| loss(data, given, value));
