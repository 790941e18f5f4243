//! The kinds of contacts: the law, friction, losses, and whether a mass moves them.

use super::{Choice, chosen};
use brinell_contact::damped::Damped as _;
use brinell_contact::loading::{AnyLoading, Elastic};
use brinell_contact::losses::{self, AnyLoss, Damper};
use brinell_contact::motion::{Follow, follow};
use brinell_contact::rate;
use brinell_contact::tangential::{Friction, FrictionalContact, FrictionalModel, PlaneContact};
use brinell_contact::unloading::{AnyUnloading, ContactRadius};
use brinell_contact::{Body, Contact, History, Model, Pair};
use brinell_fmu::scene::{Absent, Coupled, Coupling, Presence, Present};
use std::marker::PhantomData;

/// Whether the passivity guard acts in a contact of a model.
pub type Acts<C, M> = fn(&C, &M) -> bool;

/// A kind of contact.
pub trait Kind {
    type Model: Copy;
    type Contact: Contact<Self::Model>;
    type InputDerivatives: Presence;
    type Coupling: Coupling;
    type Watch: Presence;
    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = None;
    /// Whether the passivity guard acts.
    const GUARD: Option<Acts<Self::Contact, Self::Model>> = None;
    fn model(pair: Pair, restitution: f64, mass: f64) -> Self::Model;
}

/// A law that depends on the indentation and the largest indentation.
pub struct Elastoplastic;

/// The same, moved by its mass, with the coupling `C`.
pub struct Massive<C = Coupled>(PhantomData<C>);

/// The same, with the strength of each impact.
pub struct Rated<C = Coupled>(PhantomData<C>);

/// The same with friction; the mean tangential force is an output if `MEAN`.
pub struct Frictional<const MEAN: bool = true>;

/// The same with friction in two directions.
pub struct FrictionalPlane<const MEAN: bool = true>;

/// A rate-dependent law.
pub struct Damped;

fn elastoplastic(pair: Pair) -> Model<AnyLoading, AnyUnloading> {
    let Choice { loading, unloading, surface, .. } = chosen();
    Model { pair, loading, unloading, surface }
}

impl Kind for Elastoplastic {
    type Model = Model<AnyLoading, AnyUnloading>;
    type Contact = History;
    type InputDerivatives = Present;
    type Coupling = Absent;
    type Watch = Present;
    fn model(pair: Pair, _restitution: f64, _mass: f64) -> Self::Model {
        elastoplastic(pair)
    }
}

impl<C: Coupling> Kind for Massive<C> {
    type Model = Model<AnyLoading, AnyUnloading>;
    type Contact = History;
    type InputDerivatives = Present;
    type Coupling = C;
    type Watch = Absent;
    const FOLLOW: Option<Follow<History, Self::Model>> = Some(follow);
    fn model(pair: Pair, _restitution: f64, _mass: f64) -> Self::Model {
        elastoplastic(pair)
    }
}

impl<C: Coupling> Kind for Rated<C> {
    type Model = rate::Model<Model<AnyLoading, AnyUnloading>>;
    type Contact = rate::History;
    type InputDerivatives = Present;
    type Coupling = C;
    type Watch = Absent;
    const FOLLOW: Option<Follow<rate::History, Self::Model>> = Some(follow);
    fn model(pair: Pair, _restitution: f64, _mass: f64) -> Self::Model {
        rate::Model { slow: elastoplastic(pair), rate: chosen().rate, harder: rate::Rate::NONE }
    }
}

impl<const MEAN: bool> Kind for Frictional<MEAN> {
    type Model = FrictionalModel<AnyLoading, AnyUnloading>;
    type Contact = FrictionalContact<16, MEAN>;
    type InputDerivatives = Present;
    type Coupling = Absent;
    type Watch = Present;
    fn model(pair: Pair, _restitution: f64, _mass: f64) -> Self::Model {
        let rigid = Body { radius: 1.0, youngs_modulus: f64::INFINITY, poissons_ratio: 0.0 };
        let target = Body { youngs_modulus: pair.youngs_modulus, poissons_ratio: pair.poissons_ratio, ..rigid };
        let friction = Friction::between(&rigid, &target, pair.modulus, chosen().friction);
        FrictionalModel { normal: elastoplastic(pair), friction, loss: () }
    }
}

impl<const MEAN: bool> Kind for FrictionalPlane<MEAN> {
    type Model = <Frictional as Kind>::Model;
    type Contact = PlaneContact<16, MEAN>;
    type InputDerivatives = Present;
    type Coupling = Absent;
    type Watch = Present;
    fn model(pair: Pair, restitution: f64, mass: f64) -> Self::Model {
        <Frictional>::model(pair, restitution, mass)
    }
}

impl Kind for Damped {
    type Model = losses::Model<Elastic, ContactRadius, Damper>;
    type Contact = losses::History<Damper>;
    type InputDerivatives = Absent;
    type Coupling = Absent;
    type Watch = Absent;
    fn model(pair: Pair, restitution: f64, mass: f64) -> Self::Model {
        chosen().damped.model(pair, restitution, mass)
    }
}

/// The same, moved by its mass.
pub struct DampedMassive<C = Coupled>(PhantomData<C>);

impl<C: Coupling> Kind for DampedMassive<C> {
    type Model = losses::Model<Elastic, ContactRadius, Damper>;
    type Contact = losses::History<Damper>;
    type InputDerivatives = Present;
    type Coupling = C;
    type Watch = Absent;
    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = Some(losses::follow);
    fn model(pair: Pair, restitution: f64, mass: f64) -> Self::Model {
        Damped::model(pair, restitution, mass)
    }
}

/// A law with a loss below yield.
pub struct Lossy;

/// The same, moved by its mass.
pub struct LossyMassive<C = Coupled>(PhantomData<C>);

type LossyModel = losses::Model<AnyLoading, AnyUnloading, AnyLoss>;

impl Kind for Lossy {
    type Model = LossyModel;
    type Contact = losses::History<AnyLoss>;
    type InputDerivatives = Absent;
    type Coupling = Absent;
    type Watch = Absent;
    fn model(pair: Pair, _restitution: f64, _mass: f64) -> Self::Model {
        losses::Model { plastic: elastoplastic(pair), loss: chosen().loss }
    }
}

impl<C: Coupling> Kind for LossyMassive<C> {
    type Model = LossyModel;
    type Contact = losses::History<AnyLoss>;
    type InputDerivatives = Present;
    type Coupling = C;
    type Watch = Absent;
    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = Some(losses::follow);
    fn model(pair: Pair, restitution: f64, mass: f64) -> Self::Model {
        Lossy::model(pair, restitution, mass)
    }
}

/// A law with the passivity guard, which an unloading law must have.
pub struct Guarded;

impl Kind for Guarded {
    type Model = Model<AnyLoading, AnyUnloading>;
    type Contact = History;
    type InputDerivatives = Absent;
    type Coupling = Absent;
    type Watch = Absent;
    const GUARD: Option<Acts<History, Self::Model>> = Some(History::is_held_back);
    fn model(pair: Pair, _restitution: f64, _mass: f64) -> Self::Model {
        elastoplastic(pair)
    }
}

/// Any kind without derivatives of its inputs.
pub struct Held<K>(PhantomData<K>);

impl<K: Kind> Kind for Held<K> {
    type Model = K::Model;
    type Contact = K::Contact;
    type InputDerivatives = Absent;
    type Coupling = K::Coupling;
    type Watch = K::Watch;
    const FOLLOW: Option<Follow<Self::Contact, Self::Model>> = K::FOLLOW;
    fn model(pair: Pair, restitution: f64, mass: f64) -> Self::Model {
        K::model(pair, restitution, mass)
    }
}
