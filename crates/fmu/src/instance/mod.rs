//! Co-simulation as safe Rust: phase, time, variables, step, reset, save and load. Nothing here is particular to FMI 2.0.
//!
//! An [`Instance`] belongs to a [`Scene`], and is an ordinary value.

mod account;
mod clock;
mod coupling;
mod course;
mod derivatives;
mod fault;
mod friction;
mod saved;
mod stability;
mod start;
mod stepping;
mod together;
mod validity;
mod variables;
mod wiring;

pub use clock::{LATEST, Phase, SHORTEST};
pub use fault::{Cause, Fault, Warning};
pub use stepping::Plain;

use crate::c::span::{Free, Span};
use crate::scene::{Coupling, Parameter, Presence, Scene, Settable, Store};
use account::{Account, Ending};
use brinell_contact::behaviour::is_finite_at;
use brinell_contact::shared::Work;
use brinell_contact::{Contact, TooDeep};
use clock::Clock;
use core::borrow::Borrow;
use core::ops::Deref;
use coupling::{Curve, Momentum};
use stability::Watched;
use start::{Bodies, BodiesOf, model_of};
use wiring::{Evidence, Miswired, Suspect};

/// The largest absolute value of the rate of an input \[m/s\].
pub const FASTEST: f64 = 1e40;

/// The largest absolute value of an acceleration of an input \[m/s^2\], and of its derivative \[m/s^3\].
pub const SWIFTEST: f64 = 1e40;

/// One value for each contact of a scene, if `P` is present.
type IfPresent<P, S, T> = <P as Presence>::Of<T, <S as Scene>::Contacts<T>>;

/// One value for each row of its contacts.
type RowsIfPresent<P, S, T> = <P as Presence>::Of<T, <S as Scene>::Rows<T>>;

/// The data of the contacts. A plain step and a reading of the force use the first fields only.
#[repr(C)]
struct Contacts<S: Scene> {
    /// Rates \[m/s\].
    rates: S::Contacts<f64>,
    histories: S::Contacts<S::Contact>,
    /// Forces \[N\].
    forces: IfPresent<S::Forces, S, f64>,
    momenta: IfPresent<S::Momentum, S, Momentum>,
    curves: IfPresent<S::InputDerivatives, S, Curve>,
    /// Length of the last step \[s\], if a force is predicted from it.
    last_step: <S::Prediction as Presence>::Of<f64, [f64; 1]>,
    endings: RowsIfPresent<<S::Coupling as Coupling>::Ending, S, Ending>,
    accounts: RowsIfPresent<<S::Coupling as Coupling>::Account, S, Account>,
    /// Accelerations by all forces except the contact force \[m/s^2\].
    accelerations: RowsIfPresent<<S::Coupling as Coupling>::Acceleration, S, f64>,
    /// Effective masses \[kg\], if they are inputs.
    masses: IfPresent<<S::Coupling as Coupling>::Mass, S, f64>,
    /// The last examined steps, if the scene detects steps that are too long.
    watched: IfPresent<S::Watch, S, Watched>,
    /// Number of next steps to examine.
    looks: <S::Watch as Presence>::Of<u32, [u32; 1]>,
    miswired: <<S::Coupling as Coupling>::Ending as Presence>::Of<Miswired, [Miswired; 1]>,
    /// What the steps so far say of the importer.
    evidence: IfPresent<<S::Coupling as Coupling>::Ending, S, Evidence>,
    /// What is known of bodies that contacts share without the FMU's knowledge.
    suspects: IfPresent<<S::Coupling as Coupling>::Ending, S, Suspect>,
    /// Moments of the impulses of the last step, if contacts share bodies \[N.s^2\].
    moments: RowsIfPresent<S::Shared, S, f64>,
    /// Inverse effective masses that are inputs \[1/kg\].
    inverse_masses: S::InverseMasses,
    /// Working memory to check them, and whether they are right.
    scratch: S::InverseMasses,
    checked: bool,
    /// Working memory of a step of all contacts together.
    works: IfPresent<S::Shared, S, Work<S::Contact>>,
    /// The same, for each [number](together::Number) of rows.
    numbers: [RowsIfPresent<S::Shared, S, f64>; 4],
}

/// A model that an instance keeps, or that has been made for the moment.
enum Held<'a, M> {
    Kept(&'a M),
    Made(M),
}

impl<M> Deref for Held<'_, M> {
    type Target = M;

    #[inline(always)]
    fn deref(&self) -> &M {
        match self {
            Held::Kept(model) => model,
            Held::Made(model) => model,
        }
    }
}

impl<M> Borrow<M> for Held<'_, M> {
    #[inline(always)]
    fn borrow(&self) -> &M {
        self
    }
}

/// Values that follow from the parameters.
#[repr(C)]
struct Settings<S: Scene> {
    /// The largest absolute value of an input that needs no further check \[m/s\].
    largest_rate: f64,
    /// A hash of the scene and of all parameters: a saved state with the same hash is one of the same scene, whose parameters
    /// need not be copied.
    stamp: u64,
    /// The limit that contacts have not reached yet.
    limit: Limit,
    bodies: S::Groups<BodiesOf<S>>,
    values: S::Values,
    /// The models of the groups, if the instance keeps them. They lie outside of it, and a saved state has no room for them.
    prepared: KeptModels<S>,
}

/// The models that an instance keeps, if it does.
type KeptModels<S> =
    <<S as Scene>::Prepared as Presence>::Of<Option<<S as Scene>::Model>, Span<Option<<S as Scene>::Model>>>;

/// Calls `each` for every array of an instance whose length follows from the scene, with this length.
macro_rules! arrays {
    ($each:ident) => {
        $each!((contacts.rates) S::contacts());
        $each!((contacts.histories) S::contacts());
        $each!((contacts.forces) S::stored_forces());
        $each!((contacts.momenta) S::momenta());
        $each!((contacts.curves) S::curves());
        $each!((contacts.endings) S::moved_rows());
        $each!((contacts.accounts) S::accounts());
        $each!((contacts.accelerations) S::accelerations());
        $each!((contacts.masses) S::masses());
        $each!((contacts.watched) S::watched());
        $each!((contacts.evidence) S::moved_contacts());
        $each!((contacts.suspects) S::moved_contacts());
        $each!((contacts.moments) S::shared_rows());
        $each!((contacts.inverse_masses) S::inverse_mass_inputs());
        $each!((contacts.scratch) S::inverse_mass_inputs());
        $each!((contacts.works) S::shared_contacts());
        $each!((contacts.numbers[0]) S::shared_rows());
        $each!((contacts.numbers[1]) S::shared_rows());
        $each!((contacts.numbers[2]) S::shared_rows());
        $each!((contacts.numbers[3]) S::shared_rows());
        $each!((settings.bodies) S::groups());
        $each!((settings.values) S::values());
    };
}

/// The memory that `count` values of the array that `_of` gives take outside of it \[bytes\].
#[inline(always)]
fn outside<O, T, A: Store<T>>(_of: impl Fn(&O) -> &A, count: usize) -> usize {
    A::outside(count)
}

impl<S: Scene> Instance<S> {
    /// The memory of its arrays outside of the instance \[bytes\]: zero for a scene whose numbers the compiler knows.
    #[inline(always)]
    pub fn outside() -> usize {
        let mut sum = 0;
        macro_rules! add {
            (($($field:tt)+) $count:expr) => { sum += outside(|instance: &Instance<S>| &instance.$($field)+, $count) };
        }
        arrays!(add);
        sum
    }

    /// The same with the models that the instance keeps, for an instance that is to step: those of a state are never looked at.
    #[inline(always)]
    pub fn outside_with_models() -> usize {
        Self::outside() + outside(|instance: &Instance<S>| &instance.settings.prepared, S::prepared())
    }

    /// Places its arrays in `free` memory of this size, with or without its models.
    #[inline(always)]
    pub fn place(&mut self, mut free: Free) {
        macro_rules! place {
            (($($field:tt)+) $count:expr) => { self.$($field)+.place($count, &mut free) };
        }
        arrays!(place);
        self.settings.prepared.place(S::prepared(), &mut free);
    }
}

/// A contact whose indentation was beyond the validity of its law at some time in a step, kept until the warning is
/// logged; or a step that was too long to be [stable](stability).
#[derive(Clone, Copy)]
struct Deep {
    /// The contact, counted from 1; 0 for none.
    contact: u32,
    /// Its largest indentation \[m\], or the step \[s\].
    indentation: f64,
}

/// The fields of an instance for which zeros could be no value.
pub type Checked<S> = (<S as Scene>::Contact, Option<<S as Scene>::Model>, <S as Scene>::Values, Phase, Limit);

/// A limit of the width of contacts. Zero is the first one, as in memory full of zeros.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Limit {
    /// The law becomes [invalid](brinell_contact::validity): a warning.
    Valid = 0,
    /// A contact is as wide as its smaller body: no further step.
    Wide = 1,
    /// This contact has reached the last one.
    Reached(u32) = 2,
}

/// One instance of a scene: everything that a saved state contains.
///
/// Memory full of zeros is a valid instance, but must be [reset](Instance::reset) before use. An instance of many contacts is
/// too large to be moved.
#[repr(C)]
pub struct Instance<S: Scene> {
    clock: Clock,
    contacts: Contacts<S>,
    settings: Settings<S>,
    deep: Deep,
}

fn too_deep(contact: usize, TooDeep { indentation }: TooDeep) -> Fault {
    Fault::TooDeep { contact, indentation }
}

impl<S: Scene> Settings<S> {
    /// The bodies and laws of `group`. It is not inlined, to keep the code small where speed does not matter.
    #[inline(never)]
    fn model(&self, group: usize) -> Held<'_, S::Model> {
        self.model_at_once(group)
    }

    /// The same, inlined, for the steps of many contacts.
    #[inline(always)]
    fn model_at_once(&self, group: usize) -> Held<'_, S::Model> {
        match self.prepared.as_ref().get(group) {
            Some(Some(model)) => Held::Kept(model),
            _ => Held::Made(self.make_model(group)),
        }
    }

    #[inline(always)]
    fn make_model(&self, group: usize) -> S::Model {
        let none = Bodies::default();
        model_of::<S>(group, self.bodies.as_ref().get(group).unwrap_or(&none), &self.values)
    }

    /// Makes the models that the instance keeps anew, after a change of parameters. One whose bodies are the same takes over what is known of
    /// them.
    #[cold]
    #[inline(never)]
    fn prepare(&mut self, groups: core::ops::Range<usize>) {
        for group in groups {
            if let Some(before) = self.prepared.as_ref().get(group) {
                let model = S::Contact::prepared(self.make_model(group), before.as_ref());
                self.prepared.as_mut().get_mut(group).into_iter().for_each(|slot| *slot = Some(model));
            }
        }
    }

    /// The indentation at which `group` reaches the present limit \[m\].
    fn depth(&mut self, group: usize) -> f64 {
        let Some(bodies) = self.bodies.as_ref().get(group) else { return f64::NAN };
        if bodies.depth != 0.0 {
            return bodies.depth;
        }
        let size = validity::size::<S>(group, &self.values);
        let model = self.model(group);
        let [valid, possible] = S::Contact::widths(|| &*model, bodies.radius, size);
        let depth = S::Contact::depth_of(&model, if self.limit == Limit::Valid { valid } else { possible });
        self.bodies.as_mut().get_mut(group).into_iter().for_each(|bodies| bodies.depth = depth);
        depth
    }
}

impl<S: Scene> Instance<S> {
    /// Whether a step is plain if it takes only a few comparisons for each contact.
    #[inline(always)]
    fn is_plain() -> bool {
        !S::moves()
    }

    /// All steps are longer than this \[s\].
    #[inline(always)]
    fn shortest() -> f64 {
        let divides = S::has_momentum() || S::moves() || S::Contact::HAS_FRICTION;
        if divides { SHORTEST } else { 0.0 }
    }

    fn histories(&self) -> &[S::Contact] {
        self.contacts.histories.as_ref()
    }

    fn rates(&self) -> &[f64] {
        self.contacts.rates.as_ref()
    }

    /// The contact of a row, and its tangential direction; `None` for the normal.
    fn place_of(row: usize) -> (usize, Option<usize>) {
        let contacts = S::contacts();
        (row.checked_rem(contacts).unwrap_or(0), row.checked_div(contacts).unwrap_or(0).checked_sub(1))
    }

    /// The rate of a row that the importer has given \[m/s\].
    fn given_rate(&self, row: usize) -> f64 {
        let (contact, direction) = Self::place_of(row);
        let given = match direction {
            None => self.rates().get(contact).copied(),
            Some(direction) => self.histories().get(contact).map(|history| history.tangential_course(direction).rate),
        };
        given.unwrap_or(0.0)
    }

    /// Discards the derivatives of the inputs.
    fn straighten(&mut self) {
        self.clock.curved = false;
        self.contacts.curves.as_mut().fill(Curve::default());
        self.clock.release();
    }

    /// Stores the forces, if the scene keeps them.
    fn note_forces(&mut self) {
        let Contacts { histories, rates, forces, .. } = &mut self.contacts;
        let contacts = histories.as_ref().iter().zip(rates.as_ref());
        for (force, (history, &rate)) in forces.as_mut().iter_mut().zip(contacts) {
            *force = history.force(rate);
        }
    }

    /// The present phase.
    #[inline]
    pub fn phase(&self) -> Phase {
        self.clock.phase
    }

    fn set_phase(&mut self, phase: Phase) {
        self.clock.set_phase(phase, self.settings.largest_rate);
        if self.clock.curved {
            self.clock.hold();
        }
    }

    /// Enters the phase after a failed call, in which only reading, resetting and restoring are possible.
    pub fn fail(&mut self) {
        self.set_phase(Phase::Error);
    }

    /// End of the last step, or the start time \[s\].
    pub fn time(&self) -> f64 {
        self.clock.time
    }

    /// Sets start and stop time \[s\]. The last call before initialization counts.
    ///
    /// # Errors
    /// [`Fault::Experiment`] for a time that is not finite, a start beyond [`LATEST`], or a stop before the start.
    pub fn set_experiment(&mut self, start: f64, stop: Option<f64>) -> Result<(), Fault> {
        self.clock.set_experiment(start, stop)
    }

    /// # Errors
    /// [`Fault::NoExperiment`] without a start time.
    pub fn enter_initialization(&mut self) -> Result<(), Fault> {
        if !self.clock.experiment_defined {
            return Err(Fault::NoExperiment);
        }
        self.set_phase(Phase::Initialization);
        Ok(())
    }

    /// # Errors
    /// [`Fault::NoPointContact`] if the bodies do not fit together, [`Fault::TooFast`] if the input is too fast for the
    /// parameters.
    pub fn exit_initialization(&mut self) -> Result<(), Fault> {
        self.start()?;
        for (history, &rate) in self.histories().iter().zip(self.rates()) {
            check_rate::<S>(history, rate)?;
        }
        // moved bodies have their speed from the start
        for row in 0..S::rows() {
            let rate = self.given_rate(row);
            let ending = self.contacts.endings.as_mut().get_mut(row);
            ending.into_iter().for_each(|ending| (ending.speed, ending.free) = (rate, rate));
        }
        self.set_phase(Phase::StepComplete);
        // a contact may begin at any indentation
        self.look();
        Ok(())
    }

    /// Ends the simulation. An instance that was never initialized or has already ended does not change.
    pub fn terminate(&mut self) {
        if self.phase() == Phase::StepComplete {
            self.set_phase(Phase::Terminated);
        }
    }

    /// The bodies and laws of a contact.
    fn model(&self, contact: usize) -> Held<'_, S::Model> {
        let group = S::group(contact);
        self.settings.model(group)
    }
}

/// Whether a parameter may have this `value`.
fn allows(settable: &Settable, value: f64) -> bool {
    // written positively to reject NaN
    value >= settable.minimum && value <= settable.maximum
}

/// Range of effective masses \[kg\], and of their inverses \[1/kg\].
pub const MASSES: core::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// Whether an effective mass \[kg\] is in this range.
fn is_mass(mass: f64) -> bool {
    // a NaN is in no range
    MASSES.contains(&mass)
}

/// Checks an acceleration \[m/s^2\], or its derivative \[m/s^3\], as this `unit` says.
fn check_acceleration(name: &'static str, unit: &'static str, value: f64) -> Result<(), Fault> {
    match value.abs() {
        size if size <= SWIFTEST => Ok(()),
        size if size < f64::INFINITY => Err(Fault::AccelerationOutOfRange { name, unit, value }),
        _ => Err(Fault::NotFinite { name, value }),
    }
}

fn check_rate<S: Scene>(history: &S::Contact, rate: f64) -> Result<(), Fault> {
    if !S::follows_rate() || is_finite_at(history, rate) { Ok(()) } else { Err(Fault::TooFast { rate }) }
}
