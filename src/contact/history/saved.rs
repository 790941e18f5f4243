//! A history as words to be stored.

use super::{History, Regime, Sum};
use crate::contact::segment::Segment;

impl History {
    /// Hands thirteen words to `store`.
    pub(super) fn save_words(&self, store: &mut impl FnMut(u64)) {
        let Segment { lower, upper, origin, constant, linear, power, square } = self.segment;
        let Sum { value, rest } = self.indentation;
        let state = [value, rest, self.max_indentation, self.left_behind, self.least_increment];
        let segment = [lower, upper, origin, constant, linear, power, square];
        for number in state.into_iter().chain(segment) {
            store(number.to_bits());
        }
        store(self.regime as u64);
    }

    /// The history that [`History::save_words`] has stored; `None` if a word is not a finite number or not a regime.
    pub(super) fn of_words(words: &mut impl Iterator<Item = u64>) -> Option<History> {
        let mut number = || words.next().map(f64::from_bits).filter(|number| number.is_finite());
        let indentation = Sum { value: number()?, rest: number()? };
        let (max_indentation, left_behind, least_increment) = (number()?, number()?, number()?);
        let segment = Segment {
            lower: number()?,
            upper: number()?,
            origin: number()?,
            constant: number()?,
            linear: number()?,
            power: number()?,
            square: number()?,
        };
        let regime = words.next()?;
        let regime = Regime::ALL.into_iter().find(|&candidate| candidate as u64 == regime)?;
        Some(History { indentation, max_indentation, segment, least_increment, regime, left_behind })
    }
}
