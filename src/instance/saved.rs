//! Saving and restoring: as a copy, and as words.

use super::*;

impl Instance {
    /// Makes this instance the same as `other` and reports true; if their parameters differ nothing is done, and false.
    #[inline(always)]
    pub fn copy_alike(&mut self, other: &Instance) -> bool {
        if self.stamp != other.stamp {
            return false;
        }
        self.rates.copy_from_slice(&other.rates);
        if scene::CONTACTS == 1 {
            self.histories.iter_mut().zip(&other.histories).for_each(|(own, history)| own.copy_from(history));
        } else {
            self.histories.copy_from_slice(&other.histories);
        }
        self.forces.copy_from_slice(&other.forces);
        (self.time, self.stop, self.limit) = (other.time, other.stop, other.limit);
        (self.phase, self.experiment_defined, self.fast) = (other.phase, other.experiment_defined, other.fast);
        self.momenta.copy_from_slice(&other.momenta);
        self.last_step.copy_from_slice(&other.last_step);
        // what isn't curved has curves of no meaning
        if other.curved {
            self.curves.copy_from_slice(&other.curves);
        }
        self.curved = other.curved;
        true
    }

    /// Makes this instance the same as `other`, whatever its parameters are.
    #[inline(never)]
    pub fn copy(&mut self, other: &Instance) {
        self.pairs.copy_from_slice(&other.pairs);
        self.values.copy_from_slice(&other.values);
        (self.lowest_rate, self.stamp) = (other.lowest_rate, other.stamp);
        self.copy_alike(other);
    }

    /// The instance as [`WORDS`] words, to be stored.
    pub fn to_words(&self, mut store: impl FnMut(u64)) {
        let last_step = self.last_step.first().copied().unwrap_or(0.0);
        let flags = u64::from(self.experiment_defined) | u64::from(self.curved) << 1;
        for word in [self.phase as u64, flags, self.time.to_bits(), self.stop.to_bits(), last_step.to_bits()] {
            store(word);
        }
        for value in &self.values {
            store(value.to_bits());
        }
        for (contact, (history, rate)) in self.histories.iter().zip(&self.rates).enumerate() {
            store(rate.to_bits());
            for word in history.to_words() {
                store(word);
            }
            // of contacts with neither there are none
            for word in self.curves.get(contact).into_iter().flat_map(|curve| curve.to_words()) {
                store(word);
            }
            for word in self.momenta.get(contact).into_iter().flat_map(|momentum| momentum.to_words()) {
                store(word);
            }
        }
    }

    /// Makes this the instance that [`Instance::to_words`] stored, each word as little-endian bytes, and reports true. If the words
    /// don't make one nothing is done.
    pub fn restore(&mut self, words: &[[u8; 8]]) -> bool {
        let number = |place| f64::from_bits(word(words, place));
        let mut values = START;
        let mut bad = word(words, 1) > 3 || [2, 3, 4].into_iter().any(|place| !number(place).is_finite());
        for ((value, settable), place) in values.iter_mut().zip(&scene::SETTABLE).zip(OWN_WORDS..) {
            *value = number(place);
            bad |= !allows(settable, *value);
        }
        let Some(phase) = Phase::ALL.into_iter().find(|&phase| phase as u64 == word(words, 0)) else { return false };
        // first a look at all that there is, and then the same again in earnest
        if bad || !self.restore_contacts(words, &values, false) {
            return false;
        }
        self.fast = false;
        self.restore_contacts(words, &values, true);
        self.values = values;
        self.stamp_parameters();
        (self.time, self.stop) = (number(2), number(3));
        self.experiment_defined = word(words, 1) & 1 != 0;
        self.curved = word(words, 1) & 2 != 0;
        self.last_step.fill(number(4));
        self.set_phase(phase);
        // what came before is not known here
        self.look();
        self.note_forces();
        true
    }

    /// Reads all contacts, and puts them in place if it is `in_earnest`; false if the words don't make contacts.
    #[inline(never)]
    fn restore_contacts(&mut self, words: &[[u8; 8]], values: &Values, in_earnest: bool) -> bool {
        let mut place = OWN_WORDS + scene::SETTABLE.len();
        let mut contacts = self.histories.iter_mut().zip(&mut self.rates);
        let (mut curves, mut momenta) = (self.curves.iter_mut(), self.momenta.iter_mut());
        let mut first = 0;
        for (group, bodies) in self.pairs.iter_mut().enumerate() {
            let Ok(pair) = pair_of(group, values) else { return false };
            let model = scene::model(pair, group, values);
            if in_earnest {
                bodies.take(&pair);
            }
            let end = scene::end(group);
            for (own, slot) in contacts.by_ref().take(end - first) {
                let rate = f64::from_bits(word(words, place));
                let stored = read(words, place + 1);
                let curve = if CURVES > 0 { Curve::from_words(read(words, place + CURVE_AT)) } else { None };
                let momentum =
                    if scene::MOMENTUM { Momentum::from_words(read(words, place + MOMENTUM_AT)) } else { None };
                if CURVES > 0 && curve.is_none() || scene::MOMENTUM && momentum.is_none() {
                    return false;
                }
                let Some(history) = History::from_words(&stored, &model).filter(|_| rate.is_finite()) else {
                    return false;
                };
                if in_earnest {
                    self.fast |= rate.abs() > FAST || history.indentation().abs() > FAR;
                    (*own, *slot) = (history, rate);
                    if let (Some(slot), Some(curve)) = (curves.next(), curve) {
                        *slot = curve;
                    }
                    if let (Some(slot), Some(momentum)) = (momenta.next(), momentum) {
                        *slot = momentum;
                    }
                }
                place += CONTACT_WORDS;
            }
            first = end;
        }
        true
    }
}

/// So many words from `place` on.
fn read<const COUNT: usize>(words: &[[u8; 8]], place: usize) -> [u64; COUNT] {
    let mut read = [0; COUNT];
    for (index, slot) in read.iter_mut().enumerate() {
        *slot = word(words, place + index);
    }
    read
}

/// A word of those that [`Instance::to_words`] stored.
#[inline(never)]
fn word(words: &[[u8; 8]], place: usize) -> u64 {
    words.get(place).map_or(0, |word| u64::from_le_bytes(*word))
}
