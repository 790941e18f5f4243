//! An instance before any motion: its bodies, as the parameters describe them, and their positions.

use super::*;
use brinell_contact::{Body, Pair};

/// The bodies of a group, as far as their properties are worth caching.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub(super) struct Bodies<K> {
    /// Values needed by steps that leave their branch.
    pub kept: K,
    /// Effective radius \[m\].
    pub radius: f64,
    /// Effective modulus \[Pa\].
    pub modulus: f64,
    /// Indentation up to which the law is valid \[m\]. It is zero until a contact closes, because computing it is slow.
    pub depth: f64,
}

/// The type of the bodies of a scene.
pub(super) type BodiesOf<S> = Bodies<<<S as Scene>::Contact as Contact<<S as Scene>::Model>>::Kept>;

impl<K> Bodies<K> {
    /// Caches the properties of `pair`. The rest is computed once all parameters are known.
    pub fn take(&mut self, pair: &Pair) {
        (self.radius, self.modulus) = (pair.radius, pair.modulus);
    }
}

/// 2^64 over the golden ratio, odd: the multiplier of the hash.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The first contact of a group.
fn first_of<S: Scene>(group: usize) -> usize {
    // without several groups there is nothing to search
    group.checked_sub(1).filter(|_| S::groups() > 1).map_or(0, S::end)
}

/// The pair of bodies of `group` for these `values`.
pub(super) fn pair_of<S: Scene>(group: usize, values: &S::Values) -> Result<Pair, Fault> {
    let value = |parameter| S::parameter(parameter, group, values);
    let impactor = Body {
        radius: value(Parameter::ImpactorRadius),
        youngs_modulus: value(Parameter::ImpactorYoungsModulus),
        poissons_ratio: value(Parameter::ImpactorPoissonsRatio),
    };
    let target = Body {
        radius: value(Parameter::TargetRadius),
        youngs_modulus: value(Parameter::TargetYoungsModulus),
        poissons_ratio: value(Parameter::TargetPoissonsRatio),
    };
    let pair = Pair::new(&impactor, &target, value(Parameter::TargetYieldStrength));
    let (first, second) = (impactor.radius, target.radius);
    let pair = pair.ok_or(Fault::NoPointContact { contact: first_of::<S>(group), impactor: first, target: second })?;
    Ok(match S::impactor_yields(group, values) {
        true => pair.yielding_in(&impactor, value(Parameter::ImpactorYieldStrength)),
        false => pair,
    })
}

/// The bodies and laws of `group`; its `bodies` are those of `values`.
pub(super) fn model_of<S: Scene>(group: usize, bodies: &BodiesOf<S>, values: &S::Values) -> S::Model {
    // asked for by its name, a parameter that is a constant costs nothing
    let (yield_strength, youngs_modulus, poissons_ratio) = match S::impactor_yields(group, values) {
        true => (
            S::parameter(Parameter::ImpactorYieldStrength, group, values),
            S::parameter(Parameter::ImpactorYoungsModulus, group, values),
            S::parameter(Parameter::ImpactorPoissonsRatio, group, values),
        ),
        false => (
            S::parameter(Parameter::TargetYieldStrength, group, values),
            S::parameter(Parameter::TargetYoungsModulus, group, values),
            S::parameter(Parameter::TargetPoissonsRatio, group, values),
        ),
    };
    let pair = Pair { radius: bodies.radius, modulus: bodies.modulus, yield_strength, youngs_modulus, poissons_ratio };
    S::model(pair, group, values)
}

/// A contact of `group` before any motion.
#[inline(never)]
fn start_of<S: Scene>(group: usize, values: &S::Values) -> Result<(Pair, S::Contact), Fault> {
    let pair = pair_of::<S>(group, values)?;
    let model = S::model(pair, group, values);
    let history = S::Contact::start(&model, S::parameter(Parameter::InitialGap, group, values));
    Ok((pair, history.map_err(|deep| too_deep(first_of::<S>(group), deep))?))
}

impl<S: Scene> Contacts<S> {
    /// Puts `contact` at its start, which is `history`.
    fn place(&mut self, contact: usize, history: S::Contact) {
        let Some(slot) = self.histories.as_mut().get_mut(contact) else { return };
        let before = *slot;
        *slot = history;
        // inputs survive
        for direction in 0..S::Contact::DIRECTIONS {
            slot.set_tangential_course(direction, &before.tangential_course(direction));
        }
        let force = history.force(0.0);
        self.momenta.as_mut().get_mut(contact).into_iter().for_each(|momentum| *momentum = Momentum::start(force));
        let endings = self.endings.as_mut().iter_mut().skip(contact).step_by(S::contacts().max(1));
        // the springs start without tangential displacement
        endings.zip([force, 0.0, 0.0]).for_each(|(ending, force)| *ending = Ending::start(force));
    }
}

impl<S: Scene> Instance<S> {
    /// An instance before anything is set. With many contacts it is large: [`Instance::reset`] initializes one in place.
    ///
    /// # Errors
    /// As for [`Instance::reset`].
    pub fn new() -> Result<Instance<S>, Fault> {
        let mut values = <S::Values as Store<f64>>::filled(0.0);
        S::set_start_values(&mut values);
        let (_, history) = start_of::<S>(0, &values)?;
        let mut instance = Instance {
            clock: Clock::START,
            contacts: Contacts {
                histories: Store::filled(history),
                rates: Store::filled(0.0),
                forces: Store::filled(0.0),
                momenta: Store::filled(Momentum::default()),
                curves: Store::filled(Curve::default()),
                last_step: Store::filled(0.0),
                endings: Store::filled(Ending::default()),
                accounts: Store::filled(Account::default()),
                accelerations: Store::filled(0.0),
                masses: Store::filled(f64::NAN),
                miswired: Store::filled(Miswired::default()),
                evidence: Store::filled(Evidence::default()),
                suspects: Store::filled(Suspect::default()),
                watched: Store::filled(Watched::default()),
                looks: Store::filled(0),
                moments: Store::filled(0.0),
                inverse_masses: Store::filled(0.0),
                scratch: Store::filled(0.0),
                checked: false,
                works: Store::filled(Work::new(history)),
                numbers: core::array::from_fn(|_| Store::filled(0.0)),
            },
            settings: Settings {
                largest_rate: 0.0,
                stamp: 0,
                limit: Limit::Valid,
                bodies: Store::filled(Bodies::default()),
                values,
                prepared: Store::filled(None),
            },
            deep: Deep { contact: 0, indentation: 0.0 },
        };
        instance.reset()?;
        Ok(instance)
    }

    /// Sets the instance to its state before anything is set, bit for bit the same each time.
    ///
    /// # Errors
    /// [`Fault::NoPointContact`] if the start values of the scene do not fit together.
    pub fn reset(&mut self) -> Result<(), Fault> {
        S::set_start_values(&mut self.settings.values);
        self.contacts.rates.as_mut().fill(0.0);
        self.forget_tangential_rates();
        self.contacts.last_step.as_mut().fill(0.0);
        self.contacts.accelerations.as_mut().fill(0.0);
        let slots = self.contacts.inverse_masses.as_mut().iter_mut();
        slots.zip(S::inverse_masses()).for_each(|(slot, start)| *slot = *start);
        self.contacts.checked = false;
        for (contact, mass) in self.contacts.masses.as_mut().iter_mut().enumerate() {
            *mass = S::parameter(Parameter::EffectiveMass, S::group(contact), &self.settings.values);
        }
        self.clock = Clock::START;
        self.deep.contact = 0;
        self.settings.set_limit(Limit::Valid);
        self.straighten();
        self.start()
    }

    /// Puts all contacts at their initial positions. If one of them cannot be there, it changes nothing.
    pub(super) fn start(&mut self) -> Result<(), Fault> {
        let started = self.start_contacts();
        self.stamp_parameters();
        started
    }

    /// Updates the hash of the parameters and of the bodies, and the other values that follow from them.
    #[cold]
    #[inline(never)]
    pub(super) fn stamp_parameters(&mut self) {
        let Settings { largest_rate, stamp, bodies, values, .. } = &mut self.settings;
        let sizes = bodies.as_ref().iter().flat_map(|bodies| [bodies.radius, bodies.modulus]);
        let mix = |sum: u64, value: f64| {
            let mixed = (sum ^ value.to_bits()).wrapping_mul(GOLDEN);
            mixed ^ mixed >> 32
        };
        // no other scene has this hash either; that of zeroed memory is zero
        let present = values.as_ref().iter().copied().chain(sizes).fold(S::identity(), mix) | 1;
        if present != *stamp {
            *stamp = present;
            *largest_rate = validity::largest_rate::<S>(values);
            for (group, bodies) in bodies.as_mut().iter_mut().enumerate() {
                bodies.kept = S::Contact::kept(&model_of::<S>(group, bodies, values));
                bodies.depth = 0.0;
            }
            self.settings.prepare(0..S::prepared());
        }
    }

    fn start_contacts(&mut self) -> Result<(), Fault> {
        let Settings { bodies, values, .. } = &mut self.settings;
        if S::groups() > 1 {
            for group in 0..S::groups() {
                start_of::<S>(group, values)?;
            }
        }
        let mut first = 0;
        for (group, bodies) in bodies.as_mut().iter_mut().enumerate() {
            let (pair, history) = start_of::<S>(group, values)?;
            bodies.take(&pair);
            let end = S::end(group);
            for contact in first..end {
                self.contacts.place(contact, history);
            }
            first = end;
        }
        let Contacts { accounts, miswired, suspects, watched, looks, moments, .. } = &mut self.contacts;
        moments.as_mut().fill(0.0);
        accounts.as_mut().fill(Account::default());
        miswired.as_mut().fill(Miswired::default());
        suspects.as_mut().fill(Suspect::default());
        watched.as_mut().fill(Watched::default());
        looks.as_mut().fill(0);
        self.forget_importer();
        self.note_forces();
        Ok(())
    }

    /// Puts `contact` alone where it starts if the parameter with this `index` has this `value`, whatever its limits. Returns
    /// false where the bodies then do not fit together. It serves to differentiate outputs, and must be undone.
    pub fn try_parameter(&mut self, contact: usize, index: usize, value: f64) -> bool {
        let (group, Settings { bodies, values, .. }) = (S::group(contact), &mut self.settings);
        values.as_mut().get_mut(index).into_iter().for_each(|slot| *slot = value);
        let Ok((pair, history)) = start_of::<S>(group, values) else { return false };
        bodies.as_mut().get_mut(group).into_iter().for_each(|bodies| bodies.take(&pair));
        self.settings.prepare(group..group + 1);
        self.contacts.place(contact, history);
        true
    }
}
