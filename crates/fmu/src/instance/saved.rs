//! Saving and restoring: as a copy, and as words.

use super::start::pair_of;
use super::*;
use crate::scene::Real;
use brinell_contact::numerics::words::{count, load_kept, load_numbers, store_kept, store_numbers};

impl<S: Scene> Instance<S> {
    /// Which of time, stop time and last step are stored: the last step only if a force is predicted from it.
    fn kept_times() -> [bool; 3] {
        [true, true, S::predicts()]
    }

    /// Which numbers of a [`Curve`] are stored: the derivatives that its input may have, and the end of the last step.
    fn kept_of_curve() -> [bool; 4] {
        let has_course = S::has_course();
        let has_slope = has_course && !S::has_input(Real::ExternalAcceleration);
        [has_slope, has_slope && Self::input_order() > 1, has_course, has_course]
    }

    /// Which numbers of a [`Momentum`] are stored. The mean force of bodies that the FMU moves is that of their [`Ending`].
    fn kept_of_momentum() -> [bool; 3] {
        let has_momentum = S::has_momentum();
        [has_momentum, has_momentum, has_momentum && !S::moves()]
    }

    /// Number of words of a contact.
    fn contact_words() -> usize {
        1 + S::Contact::WORDS
            + count(Self::kept_of_curve())
            + count(Self::kept_of_momentum())
            + usize::from(S::has_input(Real::EffectiveMass))
    }

    /// Number of words of a row.
    fn row_words() -> usize {
        usize::from(S::moves()) * Ending::WORDS
            + usize::from(S::is_parallel()) * Account::WORDS
            + usize::from(S::has_input(Real::ExternalAcceleration))
            + usize::from(S::is_shared())
    }

    /// Number of words that hold an instance.
    #[inline(always)]
    pub fn words() -> usize {
        2 + count(Self::kept_times())
            + S::values()
            + S::inverse_mass_inputs()
            + 2 * S::groups()
            + Self::contact_words() * S::contacts()
            + Self::row_words() * S::rows()
    }

    /// Makes this instance equal to `other` and returns true. If the parameters differ, or `other` is in fact of another scene, it
    /// changes nothing and returns false.
    #[inline(always)]
    pub fn copy_alike(&mut self, other: &Instance<S>) -> bool {
        if self.settings.stamp != other.settings.stamp {
            return false;
        }
        let (own, given) = (&mut self.contacts, &other.contacts);
        put_all(own.rates.as_mut(), given.rates.as_ref());
        if S::contacts() == 1 {
            let histories = own.histories.as_mut().iter_mut().zip(given.histories.as_ref());
            histories.for_each(|(own, history)| own.copy_from(history));
        } else {
            put_all(own.histories.as_mut(), given.histories.as_ref());
        }
        put_all(own.forces.as_mut(), given.forces.as_ref());
        put_all(own.momenta.as_mut(), given.momenta.as_ref());
        put_all(own.last_step.as_mut(), given.last_step.as_ref());
        put_all(own.endings.as_mut(), given.endings.as_ref());
        put_all(own.accounts.as_mut(), given.accounts.as_ref());
        put_all(own.accelerations.as_mut(), given.accelerations.as_ref());
        put_all(own.masses.as_mut(), given.masses.as_ref());
        put_all(own.moments.as_mut(), given.moments.as_ref());
        put_all(own.inverse_masses.as_mut(), given.inverse_masses.as_ref());
        own.checked = given.checked;
        // without derivatives, the stored curves are meaningless
        if other.clock.curved {
            put_all(own.curves.as_mut(), given.curves.as_ref());
        }
        self.clock = other.clock;
        // what has been told remains told
        let [present, restored] =
            [self.settings.limit, other.settings.limit].map(|limit| matches!(limit, Limit::Reached(_)));
        if present || restored {
            self.settings.set_limit(Limit::Wide);
        }
        if restored {
            self.settings.limit = other.settings.limit;
        }
        self.forget_importer();
        if S::guard().is_some() {
            // what has been told of the other contacts is not known here
            self.look();
        }
        true
    }

    /// Makes this instance equal to `other`, whatever its parameters are.
    #[inline(never)]
    pub fn copy(&mut self, other: &Instance<S>) {
        let (own, given) = (&mut self.settings, &other.settings);
        own.limit = given.limit;
        put_all(own.bodies.as_mut(), given.bodies.as_ref());
        put_all(own.values.as_mut(), given.values.as_ref());
        (own.largest_rate, own.stamp) = (given.largest_rate, given.stamp);
        own.prepare(0..S::prepared());
        self.copy_alike(other);
    }

    /// Passes the [`Instance::words`] words of the instance to `store`. Equal instances have equal words.
    pub fn save(&self, mut store: impl FnMut(u64)) {
        let last_step = self.contacts.last_step.as_ref().first().copied().unwrap_or(0.0);
        // a contact that has become too wide, counted from 1, lies above the flags
        let wide = if let Limit::Reached(contact) = self.settings.limit { u64::from(contact) + 1 } else { 0 };
        let flags = u64::from(self.clock.experiment_defined) | u64::from(self.clock.curved) << 1 | wide << 2;
        store(self.clock.phase as u64);
        store(flags);
        store_kept([self.clock.time, self.clock.stop(), last_step], Self::kept_times(), &mut store);
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
                curve.save(Self::kept_of_curve(), &mut store);
            }
            if let Some(momentum) = momenta.get(contact) {
                momentum.save(Self::kept_of_momentum(), &mut store);
            }
            self.contacts.masses.as_ref().get(contact).into_iter().for_each(|mass| store(mass.to_bits()));
        }
        for row in 0..S::rows() {
            self.save_row(row, &mut store);
        }
    }

    /// Makes this the instance that [`Instance::save`] has stored, with each word as little-endian bytes, and returns true. If
    /// the words are not valid, it returns false; part of them may then have been taken, and the instance must be reset or loaded
    /// before use.
    pub fn load(&mut self, words: &[[u8; 8]]) -> bool {
        words.len() == Self::words() && self.read(words).is_some()
    }

    /// Reads all words; `None` if they are not a valid instance.
    #[inline(never)]
    fn read(&mut self, words: &[[u8; 8]]) -> Option<()> {
        let mut words = words.iter().map(|word| u64::from_le_bytes(*word));
        let (phase, flags) = (words.next()?, words.next().filter(|&flags| flags >> 2 <= S::contacts() as u64)?);
        let phase = Phase::ALL.into_iter().find(|&known| known as u64 == phase)?;
        let [time, stop, last_step] = load_kept(Self::kept_times(), &mut words)?;
        let clock = Clock::of(time, stop, phase, flags & 1 != 0)?;
        let Settings { bodies, values, stamp, .. } = &mut self.settings;
        // that of no scene, until all is known
        *stamp = 0;
        S::set_start_values(values);
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
        for entry in self.contacts.inverse_masses.as_mut() {
            [*entry] = load_numbers(&mut words)?;
        }
        let unfit = !matches!(phase, Phase::StepComplete | Phase::Terminated);
        for (group, bodies) in bodies.as_mut().iter_mut().enumerate() {
            let [radius, modulus] = load_numbers(&mut words)?;
            (bodies.radius, bodies.modulus) = match pair_of::<S>(group, values) {
                Ok(pair) => (pair.radius, pair.modulus),
                // with parameters that do not fit together, the previous bodies stay
                Err(_) if unfit && radius > 0.0 && modulus > 0.0 => (radius, modulus),
                Err(_) => return None,
            };
        }
        let Contacts { histories, rates, curves, momenta, endings, accounts, accelerations, masses, moments, .. } =
            &mut self.contacts;
        let mut masses = masses.as_mut().iter_mut();
        let (mut curves, mut momenta) = (curves.as_mut().iter_mut(), momenta.as_mut().iter_mut());
        let slots = histories.as_mut().iter_mut().zip(rates.as_mut());
        for (contact, (history, rate)) in slots.enumerate() {
            let group = S::group(contact);
            let model = model_of::<S>(group, self.settings.bodies.as_ref().get(group)?, &self.settings.values);
            [*rate] = load_numbers(&mut words)?;
            if f64::abs(*rate) > FASTEST {
                return None;
            }
            *history = S::Contact::load(&mut words, &model)?;
            for direction in 0..S::Contact::DIRECTIONS {
                if f64::abs(history.tangential_course(direction).rate) > FASTEST {
                    return None;
                }
            }
            let curve = Curve::load(Self::kept_of_curve(), &mut words)?;
            curves.next().into_iter().for_each(|slot| *slot = curve);
            let momentum = Momentum::load(Self::kept_of_momentum(), &mut words)?;
            momenta.next().into_iter().for_each(|slot| *slot = momentum);
            put(masses.next(), || {
                let [mass] = load_numbers(&mut words)?;
                // before the first step it may not be known yet
                (is_mass(mass) || mass == 0.0).then_some(mass)
            })?;
        }
        for row in 0..S::rows() {
            put(endings.as_mut().get_mut(row), || Ending::load(&mut words))?;
            put(accounts.as_mut().get_mut(row), || Account::load(&mut words))?;
            put(accelerations.as_mut().get_mut(row), || load_numbers(&mut words).map(|[value]| value))?;
            put(moments.as_mut().get_mut(row), || load_numbers(&mut words).map(|[moment]| moment))?;
        }
        self.contacts.checked = false;
        self.stamp_parameters();
        self.clock = clock;
        self.clock.set_phase(phase, self.settings.largest_rate);
        self.clock.curved = flags & 2 != 0;
        self.contacts.last_step.as_mut().fill(last_step);
        // the earlier warnings are not known here
        self.settings.set_limit(Limit::Valid);
        if let Some(contact) = (flags >> 2).checked_sub(1) {
            self.settings.limit = Limit::Reached(contact as u32);
        }
        self.look();
        self.forget_importer();
        self.note_forces();
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

/// Copies `values` to as many slots.
#[inline(always)]
fn put_all<T: Copy>(slots: &mut [T], values: &[T]) {
    if slots.len() == values.len() {
        slots.copy_from_slice(values);
    }
}

/// Writes the result of `load` to its slot, if the scene has one; `None` if `load` fails.
fn put<T>(slot: Option<&mut T>, load: impl FnOnce() -> Option<T>) -> Option<()> {
    if let Some(slot) = slot {
        *slot = load()?;
    }
    Some(())
}
