//! Saving and restoring: as a copy, and as words.

use super::start::pair_of;
use super::*;
use brinell_contact::words::{count, load_kept, load_numbers, store_kept, store_numbers};

impl<S: Scene> Instance<S> {
    /// Which of time, stop time and last step are stored: the last step only if a force is predicted from it.
    const TIMES: [bool; 3] = [true, true, S::Prediction::IS_PRESENT];

    /// Which numbers of a [`Curve`] are stored: the derivatives that its input may have, and the end of the last step.
    const CURVE: [bool; 4] = {
        let has_course = S::Course::IS_PRESENT;
        let has_slope = has_course && !<S::Coupling as Coupling>::Acceleration::IS_PRESENT;
        [has_slope, has_slope && Self::INPUT_ORDER > 1, has_course, has_course]
    };

    /// Which numbers of a [`Momentum`] are stored. The mean force of bodies that the FMU moves is that of their [`Ending`].
    const MOMENTUM: [bool; 3] = {
        let has_momentum = S::Momentum::IS_PRESENT;
        [has_momentum, has_momentum, has_momentum && !Self::MOVES]
    };

    /// Number of words of a contact.
    const CONTACT_WORDS: usize = 1
        + S::Contact::WORDS
        + count(Self::CURVE)
        + count(Self::MOMENTUM)
        + <S::Coupling as Coupling>::Mass::IS_PRESENT as usize;

    /// Number of words of a row.
    const ROW_WORDS: usize = if <S::Coupling as Coupling>::Ending::IS_PRESENT { Ending::WORDS } else { 0 }
        + if <S::Coupling as Coupling>::Account::IS_PRESENT { Account::WORDS } else { 0 }
        + <S::Coupling as Coupling>::Acceleration::IS_PRESENT as usize
        + S::Shared::IS_PRESENT as usize;

    /// Number of words that hold an instance.
    pub const WORDS: usize = 2
        + count(Self::TIMES)
        + <S::Values as Store<f64>>::LENGTH
        + S::InverseMasses::LENGTH
        + 2 * S::GROUPS
        + Self::CONTACT_WORDS * S::CONTACTS
        + Self::ROW_WORDS * S::ROWS;

    /// Makes this instance equal to `other` and returns true. If the parameters differ, or `other` is in fact of another scene, it
    /// changes nothing and returns false.
    #[inline(always)]
    pub fn copy_alike(&mut self, other: &Instance<S>) -> bool {
        if self.settings.stamp != other.settings.stamp {
            return false;
        }
        let (own, given) = (&mut self.contacts, &other.contacts);
        own.rates.as_mut().copy_from_slice(given.rates.as_ref());
        if S::CONTACTS == 1 {
            let histories = own.histories.as_mut().iter_mut().zip(given.histories.as_ref());
            histories.for_each(|(own, history)| own.copy_from(history));
        } else {
            own.histories.as_mut().copy_from_slice(given.histories.as_ref());
        }
        own.forces.as_mut().copy_from_slice(given.forces.as_ref());
        own.momenta.as_mut().copy_from_slice(given.momenta.as_ref());
        own.last_step.as_mut().copy_from_slice(given.last_step.as_ref());
        own.endings.as_mut().copy_from_slice(given.endings.as_ref());
        own.accounts.as_mut().copy_from_slice(given.accounts.as_ref());
        own.accelerations.as_mut().copy_from_slice(given.accelerations.as_ref());
        own.masses.as_mut().copy_from_slice(given.masses.as_ref());
        own.moments.as_mut().copy_from_slice(given.moments.as_ref());
        own.inverse_masses.as_mut().copy_from_slice(given.inverse_masses.as_ref());
        own.checked = given.checked;
        // without derivatives, the stored curves are meaningless
        if other.clock.curved {
            own.curves.as_mut().copy_from_slice(given.curves.as_ref());
        }
        self.clock = other.clock;
        if S::GUARD.is_some() {
            // what has been told of the other contacts is not known here
            self.look();
        }
        true
    }

    /// Makes this instance equal to `other`, whatever its parameters are.
    #[inline(never)]
    pub fn copy(&mut self, other: &Instance<S>) {
        let (own, given) = (&mut self.settings, &other.settings);
        own.bodies.as_mut().copy_from_slice(given.bodies.as_ref());
        own.values = given.values;
        (own.largest_rate, own.stamp) = (given.largest_rate, given.stamp);
        self.copy_alike(other);
    }

    /// Passes the [`Instance::WORDS`] words of the instance to `store`. Equal instances have equal words.
    pub fn save(&self, mut store: impl FnMut(u64)) {
        let last_step = self.contacts.last_step.as_ref().first().copied().unwrap_or(0.0);
        let flags = u64::from(self.clock.experiment_defined) | u64::from(self.clock.curved) << 1;
        store(self.clock.phase as u64);
        store(flags);
        store_kept([self.clock.time, self.clock.stop(), last_step], Self::TIMES, &mut store);
        store_numbers(self.settings.values.as_ref(), &mut store);
        store_numbers(self.contacts.inverse_masses.as_ref(), &mut store);
        for bodies in self.settings.bodies.as_ref() {
            store_numbers(&[bodies.radius, bodies.modulus], &mut store);
        }
        let (curves, momenta) = (self.contacts.curves.as_ref(), self.contacts.momenta.as_ref());
        for (contact, (history, rate)) in self.histories().iter().zip(self.rates()).enumerate() {
            store(rate.to_bits());
            history.save(&mut store);
            // the slice is empty if the contacts have neither derivatives nor mass
            if let Some(curve) = curves.get(contact) {
                // without derivatives, the stored curves are meaningless
                let curve = if self.clock.curved { *curve } else { Curve::default() };
                curve.save(Self::CURVE, &mut store);
            }
            if let Some(momentum) = momenta.get(contact) {
                momentum.save(Self::MOMENTUM, &mut store);
            }
            self.contacts.masses.as_ref().get(contact).into_iter().for_each(|mass| store(mass.to_bits()));
        }
        for row in 0..S::ROWS {
            self.save_row(row, &mut store);
        }
    }

    /// Makes this the instance that [`Instance::save`] has stored, with each word as little-endian bytes, and returns true. If
    /// the words are not valid, it changes nothing and returns false.
    pub fn load(&mut self, words: &[[u8; 8]]) -> bool {
        // the first pass checks everything, the second pass writes
        words.len() == Self::WORDS && self.read(words, false).is_some() && self.read(words, true).is_some()
    }

    /// Reads all words, and writes the values if `in_earnest`; `None` if the words are not a valid instance.
    #[inline(never)]
    fn read(&mut self, words: &[[u8; 8]], in_earnest: bool) -> Option<()> {
        let mut words = words.iter().map(|word| u64::from_le_bytes(*word));
        let (phase, flags) = (words.next()?, words.next().filter(|&flags| flags <= 3)?);
        let phase = Phase::ALL.into_iter().find(|&known| known as u64 == phase)?;
        let [time, stop, last_step] = load_kept(Self::TIMES, &mut words)?;
        let clock = Clock::of(time, stop, phase, flags & 1 != 0)?;
        let mut values = S::start_values();
        for (index, value) in values.as_mut().iter_mut().enumerate() {
            let Some((settable, _)) = S::settable(index) else {
                // a constant of the scene, which may be infinite
                if words.next()? != value.to_bits() {
                    return None;
                }
                continue;
            };
            [*value] = load_numbers(&mut words)?;
            if !allows(&settable, *value) {
                return None;
            }
        }
        for place in 0..S::InverseMasses::LENGTH {
            let [entry] = load_numbers(&mut words)?;
            if in_earnest && let Some(slot) = self.contacts.inverse_masses.as_mut().get_mut(place) {
                *slot = entry;
            }
        }
        let unfit = !matches!(phase, Phase::StepComplete | Phase::Terminated);
        let sizes = words.clone();
        for (group, bodies) in self.settings.bodies.as_mut().iter_mut().enumerate() {
            let [radius, modulus] = load_numbers(&mut words)?;
            let (radius, modulus) = match pair_of::<S>(group, &values) {
                Ok(pair) => (pair.radius, pair.modulus),
                // with parameters that do not fit together, the previous bodies stay
                Err(_) if unfit && radius > 0.0 && modulus > 0.0 => (radius, modulus),
                Err(_) => return None,
            };
            if in_earnest {
                (bodies.radius, bodies.modulus) = (radius, modulus);
            }
        }
        let Contacts { histories, rates, curves, momenta, endings, accounts, accelerations, masses, moments, .. } =
            &mut self.contacts;
        let mut masses = masses.as_mut().iter_mut();
        let (mut curves, mut momenta) = (curves.as_mut().iter_mut(), momenta.as_mut().iter_mut());
        let slots = histories.as_mut().iter_mut().zip(rates.as_mut());
        for (contact, (history_slot, rate_slot)) in slots.enumerate() {
            let group = S::group(contact);
            // in the first pass, these may be the bodies of a blank instance, for which no law can be evaluated; contacts with
            // friction or a loss evaluate theirs
            let asks = S::Contact::HAS_FRICTION || S::Contact::FOLLOWS_RATE;
            let read = match in_earnest || !asks {
                true => None,
                false => Some(bodies_of::<S>(group, &values, sizes.clone())?),
            };
            let bodies = read.as_ref().or(self.settings.bodies.as_ref().get(group))?;
            let model = model_of::<S>(group, bodies, &values);
            let [rate] = load_numbers(&mut words)?;
            if f64::abs(rate) > FASTEST {
                return None;
            }
            let history = S::Contact::load(&mut words, &model)?;
            for direction in 0..S::Contact::DIRECTIONS {
                if f64::abs(history.tangential_course(direction).rate) > FASTEST {
                    return None;
                }
            }
            let curve = Curve::load(Self::CURVE, &mut words)?;
            let momentum = Momentum::load(Self::MOMENTUM, &mut words)?;
            if in_earnest {
                (*history_slot, *rate_slot) = (history, rate);
                curves.next().into_iter().for_each(|slot| *slot = curve);
                momenta.next().into_iter().for_each(|slot| *slot = momentum);
            }
            put(masses.next(), in_earnest, || {
                let [mass] = load_numbers(&mut words)?;
                is_mass(mass).then_some(mass)
            })?;
        }
        for row in 0..S::ROWS {
            put(endings.as_mut().get_mut(row), in_earnest, || Ending::load(&mut words))?;
            put(accounts.as_mut().get_mut(row), in_earnest, || Account::load(&mut words))?;
            put(accelerations.as_mut().get_mut(row), in_earnest, || load_numbers(&mut words).map(|[value]| value))?;
            put(moments.as_mut().get_mut(row), in_earnest, || load_numbers(&mut words).map(|[moment]| moment))?;
        }
        if in_earnest {
            self.contacts.checked = false;
            self.settings.values = values;
            self.stamp_parameters();
            self.clock = clock;
            self.clock.set_phase(phase, self.settings.largest_rate);
            self.clock.curved = flags & 2 != 0;
            self.contacts.last_step.as_mut().fill(last_step);
            // the earlier warnings are not known here
            self.look();
            self.note_forces();
        }
        Some(())
    }

    /// Passes the data that a row keeps for its importer to `store`.
    fn save_row(&self, row: usize, store: &mut impl FnMut(u64)) {
        let Contacts { endings, accounts, accelerations, moments, .. } = &self.contacts;
        if let Some(ending) = endings.as_ref().get(row) {
            ending.save(store);
        }
        if let Some(account) = accounts.as_ref().get(row) {
            account.save(store);
        }
        let numbers = [accelerations.as_ref(), moments.as_ref()].map(|all| all.get(row));
        numbers.into_iter().flatten().for_each(|input| store(input.to_bits()));
    }
}

/// The bodies of `group` with these parameters; where they do not fit together, of the radius and the modulus in `sizes`, the
/// words of all groups.
fn bodies_of<S: Scene>(group: usize, values: &S::Values, sizes: impl Iterator<Item = u64>) -> Option<BodiesOf<S>> {
    let [radius, modulus] = match pair_of::<S>(group, values) {
        Ok(pair) => [pair.radius, pair.modulus],
        Err(_) => load_numbers(&mut sizes.skip(2 * group))?,
    };
    Some(Bodies { radius, modulus, ..Bodies::default() })
}

/// Writes the result of `load` to its slot, if the scene has one and this is `in_earnest`; `None` if `load` fails.
fn put<T>(slot: Option<&mut T>, in_earnest: bool, load: impl FnOnce() -> Option<T>) -> Option<()> {
    if let Some(slot) = slot {
        let value = load()?;
        if in_earnest {
            *slot = value;
        }
    }
    Some(())
}
