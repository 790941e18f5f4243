//! The laws and the kinds of libraries. A compiled library names the laws of its scene; a prebuilt one takes every scene that needs no
//! more than it has.

use super::block::{Data, Flag, Loss};
use super::{Given, Kind, Laws, Sizes};
use crate::c::span::Span;
use crate::scene::{
    Absent, Acts, Coupled, Coupling, Parameter, Presence, Present, impactor_yields, two_bodies, with_friction,
};
use brinell_contact::damped::{AnyDamped, Damped};
use brinell_contact::loading::{AnyLoading, Elastic, Loading};
use brinell_contact::losses::{self, AnyLoss, Damper, HalfSpaceRadiation, Plate, RestitutionFitted, Solid};
use brinell_contact::motion::{self, Follow};
use brinell_contact::rate::{self, Slow};
use brinell_contact::shared::{self, InverseMasses, Outcome, Refused, SharedContact, Work};
use brinell_contact::tangential::{FrictionalContact, FrictionalModel, PlaneContact};
use brinell_contact::unloading::{AnyUnloading, Unloading};
use brinell_contact::{Contact, History, LawNumbers, Model, Numbered};
use core::borrow::Borrow;
use core::marker::PhantomData;

/// Number of segments in which the springs of a contact with friction remember its past.
pub const MEMORY: usize = 16;

/// Laws of contacts that yield.
pub struct Plastic<L, U>(PhantomData<(L, U)>);

/// The same with a loss below yield, or the spring of a rate-dependent law with its damping.
pub struct Lossy<L, U, X>(PhantomData<(L, U, X)>);

/// The same as the laws `X` with a strength that is found at the first touch of each impact.
pub struct Rated<X>(PhantomData<X>);

/// Contacts with friction, of the type `C`, and a loss below yield or `()`.
pub struct Frictional<C, L, U, X = ()>(PhantomData<(C, L, U, X)>);

/// The law with these numbers.
#[inline(always)]
fn law<L: Numbered>(numbers: &LawNumbers) -> L {
    L::from_numbers(numbers).unwrap_or(L::FIRST)
}

/// The elastoplastic model of a scene.
#[inline(always)]
fn plastic<L: Loading + Numbered, U: Numbered, X: OfScene>(
    data: &Data,
    given: &Given,
    value: impl Fn(Parameter) -> f64 + Copy,
) -> Model<L, U> {
    let Given { pair, surface, curve, .. } = *given;
    let unloading = law(&data.unloading);
    if let Some(loading) = X::spring(data, given, value).and_then(L::of_spring) {
        return Model { pair, loading, unloading, surface };
    }
    let loading = law::<L>(&data.loading).through(curve);
    let loading = match data.has(Flag::Paired) {
        true => {
            let bodies = two_bodies(value);
            loading.of_bodies(bodies).along_line(bodies, impactor_yields(value))
        }
        false => loading,
    };
    Model { pair, loading, unloading, surface }
}

/// A loss below yield, or none, whose numbers are parameters of a scene.
pub trait OfScene: Copy {
    /// The loss with the parameters that `value` gives.
    fn of_scene(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Self;

    /// The spring of a rate-dependent law, if it is the damping of one.
    #[inline(always)]
    fn spring(_data: &Data, _given: &Given, _value: impl Fn(Parameter) -> f64 + Copy) -> Option<Elastic> {
        None
    }
}

impl OfScene for () {
    #[inline(always)]
    fn of_scene(_data: &Data, _given: &Given, _value: impl Fn(Parameter) -> f64 + Copy) {}
}

impl OfScene for RestitutionFitted {
    #[inline(always)]
    fn of_scene(_data: &Data, _given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> RestitutionFitted {
        RestitutionFitted { restitution: value(Parameter::ElasticRestitution) }
    }
}

impl OfScene for HalfSpaceRadiation {
    #[inline(always)]
    fn of_scene(_data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> HalfSpaceRadiation {
        HalfSpaceRadiation { target: target(given, value) }
    }
}

impl OfScene for Plate {
    #[inline(always)]
    fn of_scene(_data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Plate {
        Plate { thickness: value(Parameter::TargetPlateThickness), target: target(given, value) }
    }
}

/// The spring of a rate-dependent law, and its damping.
#[inline(always)]
fn rate_dependent(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> (Elastic, Damper) {
    let law = law::<AnyDamped>(&data.loading);
    law.parts(&given.pair, value(Parameter::Restitution), value(Parameter::EffectiveMass))
}

impl OfScene for Damper {
    #[inline(always)]
    fn of_scene(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Damper {
        rate_dependent(data, given, value).1
    }

    #[inline(always)]
    fn spring(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Option<Elastic> {
        Some(rate_dependent(data, given, value).0)
    }
}

impl OfScene for AnyLoss {
    fn of_scene(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> AnyLoss {
        match data.loss {
            waves if waves == Loss::Waves as u64 => {
                AnyLoss::HalfSpaceRadiation(HalfSpaceRadiation::of_scene(data, given, value))
            }
            plate if plate == Loss::Plate as u64 => AnyLoss::Plate(Plate::of_scene(data, given, value)),
            damper if damper == Loss::Damper as u64 => AnyLoss::Damper(Damper::of_scene(data, given, value)),
            _ => AnyLoss::RestitutionFitted(RestitutionFitted::of_scene(data, given, value)),
        }
    }

    fn spring(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Option<Elastic> {
        if data.loss == Loss::Damper as u64 { Damper::spring(data, given, value) } else { None }
    }
}

/// The target as a body in which waves travel.
#[inline(always)]
fn target(given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Solid {
    Solid {
        density: given.density,
        youngs_modulus: value(Parameter::TargetYoungsModulus),
        poissons_ratio: value(Parameter::TargetPoissonsRatio),
    }
}

/// The functions of laws with a guard.
macro_rules! guarded {
    () => {
        fn guard() -> Option<Acts<Self::Contact, Self::Model>> {
            Some(Self::Contact::is_held_back)
        }
    };
}

/// The function of laws whose contacts may share bodies.
macro_rules! together {
    () => {
        #[inline(always)]
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

impl<L: Loading + Numbered, U: Unloading + Numbered> Laws for Plastic<L, U> {
    type Model = Model<L, U>;
    type Contact = History;
    guarded!();
    together!();

    fn follow() -> Option<Follow<History, Model<L, U>>> {
        Some(motion::follow)
    }

    #[inline(always)]
    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Model<L, U> {
        plastic::<L, U, ()>(data, given, value)
    }
}

impl<L: Loading + Numbered, U: Unloading + Numbered, X: losses::Loss + OfScene> Laws for Lossy<L, U, X> {
    type Model = losses::Model<L, U, X>;
    type Contact = losses::History<X>;
    guarded!();
    together!();

    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        Some(losses::follow)
    }

    #[inline(always)]
    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Self::Model {
        losses::Model { plastic: plastic::<L, U, X>(data, given, value), loss: X::of_scene(data, given, value) }
    }
}

impl<X: Laws> Laws for Rated<X>
where
    X::Model: Slow,
    X::Contact: SharedContact<X::Model>,
{
    type Model = rate::Model<X::Model>;
    type Contact = rate::History<X::Contact>;
    guarded!();
    together!();

    fn follow() -> Option<Follow<Self::Contact, Self::Model>> {
        Some(if X::Contact::HAS_CLOSED_FORM { motion::follow } else { losses::follow })
    }

    #[inline(always)]
    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Self::Model {
        let [target, impactor] = &data.rates;
        let (target, impactor) = (target.rate(), impactor.rate());
        let slow = X::model(data, given, value);
        match impactor_yields(value) {
            true => rate::Model { slow, rate: impactor, harder: target },
            false => rate::Model { slow, rate: target, harder: impactor },
        }
    }
}

impl<C, L: Loading + Numbered, U: Unloading + Numbered, X: OfScene> Laws for Frictional<C, L, U, X>
where
    C: Contact<FrictionalModel<L, U, X>> + SharedContact<FrictionalModel<L, U, X>>,
{
    type Model = FrictionalModel<L, U, X>;
    type Contact = C;
    together!();

    #[inline(always)]
    fn model(data: &Data, given: &Given, value: impl Fn(Parameter) -> f64 + Copy) -> Self::Model {
        with_friction(plastic::<L, U, X>(data, given, value), X::of_scene(data, given, value), value)
    }
}

/// The sizes of a scene whose numbers the compiler knows: of contacts, of rows, of groups, of values of parameters, and of inverse masses
/// that are inputs.
pub struct Fixed<
    const CONTACTS: usize,
    const ROWS: usize,
    const GROUPS: usize,
    const VALUES: usize,
    const ENTRIES: usize,
>;

impl<const CONTACTS: usize, const ROWS: usize, const GROUPS: usize, const VALUES: usize, const ENTRIES: usize> Sizes
    for Fixed<CONTACTS, ROWS, GROUPS, VALUES, ENTRIES>
{
    type Contacts<T: Copy> = [T; CONTACTS];
    type Rows<T: Copy> = [T; ROWS];
    type Groups<T: Copy> = [T; GROUPS];
    type Values = [f64; VALUES];
    type InverseMasses = [f64; ENTRIES];
}

/// The sizes of scenes with one contact.
pub struct One;

impl Sizes for One {
    type Contacts<T: Copy> = [T; 1];
    type Rows<T: Copy> = [T; 1];
    type Groups<T: Copy> = [T; 1];
    type Values = Span<f64>;
    type InverseMasses = Span<f64>;
}

/// The sizes of any scene, which its data say.
pub struct Spans;

impl Sizes for Spans {
    type Contacts<T: Copy> = Span<T>;
    type Rows<T: Copy> = Span<T>;
    type Groups<T: Copy> = Span<T>;
    type Values = Span<f64>;
    type InverseMasses = Span<f64>;
}

/// Laws as data.
type AnyLaws = Plastic<AnyLoading, AnyUnloading>;

/// The same with a loss below yield.
type AnyLossy = Lossy<AnyLoading, AnyUnloading, AnyLoss>;

/// The same as [`AnyLaws`] with friction.
type AnyFrictional<C> = Frictional<C, AnyLoading, AnyUnloading>;

/// The same with a loss below yield.
type AnyLossyFrictional<C> = Frictional<C, AnyLoading, AnyUnloading, AnyLoss>;

/// The state of a contact with a loss.
type LossyHistory = losses::History<AnyLoss>;

/// Any coupling.
type Any = Coupled<Present, Present, Present>;

/// The library `state`: one contact without its momentum.
pub struct State;

impl Kind for State {
    type Laws = AnyLaws;
    type Sizes = One;
    type Forces = Absent;
    type Momentum = Absent;
    type InputDerivatives = Present;
    type Prediction = Present;
    type Coupling = Absent;
    type Watch = Present;
    type Shared = Absent;
    type Prepared = Present;
}

/// A library of any contacts with these laws `L` and their momentum: with the coupling `C`, for scenes that watch their steps or not (`W`),
/// and for contacts that share bodies or not (`S`).
pub struct Contacts<L, C = Any, W = Present, S = Present>(PhantomData<(L, C, W, S)>);

impl<L: Laws, C: Coupling, W: Presence, S: Presence> Kind for Contacts<L, C, W, S> {
    type Laws = L;
    type Sizes = Spans;
    type Forces = Present;
    type Momentum = Present;
    type InputDerivatives = Present;
    type Prediction = Present;
    type Coupling = C;
    type Watch = W;
    type Shared = S;
    type Prepared = Present;
}

/// The library `momentum`: any contacts, with their momentum.
pub type Momentum = Contacts<AnyLaws, Absent, Present, Absent>;

/// The library `moved`: contacts that move their bodies, each for itself or together.
pub type Moved = Contacts<AnyLaws, Any, Absent>;

/// The library `lossy`: contacts with losses below yield or a rate-dependent law, which may move their bodies.
pub type Losses = Contacts<AnyLossy>;

/// The library `rate`: contacts that move their bodies, each for itself or together, and find their strength at the first touch of each
/// impact.
pub type Strengths = Contacts<Rated<AnyLaws>, Any, Absent>;

/// The library `lossy-rate`: the same as [`Strengths`] with losses below yield.
pub type LossyStrengths = Contacts<Rated<AnyLossy>, Any, Absent>;

/// The library `friction`: contacts with friction in one direction, which may move their bodies together.
pub type Friction = Contacts<AnyFrictional<FrictionalContact<MEMORY, true>>>;

/// The library `friction-2`: the same with friction in two directions.
pub type Friction2 = Contacts<AnyFrictional<PlaneContact<MEMORY, true>>>;

/// The library `lossy-friction`: the same as [`Friction`] with losses below yield.
pub type LossyFriction = Contacts<AnyLossyFrictional<FrictionalContact<MEMORY, true, LossyHistory>>>;

/// The library `lossy-friction-2`: the same as [`Friction2`] with losses below yield.
pub type LossyFriction2 = Contacts<AnyLossyFrictional<PlaneContact<MEMORY, true, LossyHistory>>>;

/// The function `$make::<SCENE>`, as a pointer, for the scene whose prebuilt library has this name and whose data are at `$place`; `None`
/// for another name.
#[macro_export]
macro_rules! for_library {
    ($name:expr, $place:ty, $make:ident) => {
        $crate::for_library!(@ $name, $place, $make, "state" State, "momentum" Momentum, "moved" Moved, "lossy" Losses,
            "rate" Strengths, "lossy-rate" LossyStrengths, "friction" Friction, "friction-2" Friction2,
            "lossy-friction" LossyFriction, "lossy-friction-2" LossyFriction2)
    };
    (@ $name:expr, $place:ty, $make:ident, $($known:literal $kind:ident),+) => {
        match $name {
            $($known => Some($make::<$crate::scene::library::LibraryScene<$crate::scene::library::kinds::$kind, $place>> as _),)+
            _ => None,
        }
    };
}
