//! A history as words for a saved state.

use super::{History, LARGEST_INDENTATION, Regime, Sum};
use crate::numerics::words::{load_numbers, store_numbers};
use crate::segment::Segment;

impl History {
    /// Passes thirteen words to `store`, in memory order, so that they are copied in pairs.
    pub(super) fn save_words(&self, store: &mut impl FnMut(u64)) {
        let Sum { value, rest } = self.indentation;
        let Segment { lower, upper, origin, constant, linear, power, square } = self.segment;
        let (max, least, left) = (self.max_indentation, self.least_increment, self.left_behind);
        let numbers = [value, rest, max, lower, upper, origin, constant, linear, power, square, least, left];
        store_numbers(&numbers, store);
        store(self.regime as u64);
    }

    /// The history that [`History::save_words`] has stored; `None` if a word is not a finite number or not a regime, or if the
    /// contact is, was or may come deeper than the loading curve goes, along which the work would be summed for ever.
    pub(super) fn of_words(words: &mut impl Iterator<Item = u64>) -> Option<History> {
        let [value, rest, max, lower, upper, origin, constant, linear, power, square, least, left] =
            load_numbers(words)?;
        let indentation = Sum { value, rest };
        let deepest = indentation.total().max(upper);
        if !(0.0..=LARGEST_INDENTATION).contains(&max) || deepest > LARGEST_INDENTATION {
            return None;
        }
        let segment = Segment { lower, upper, origin, constant, linear, power, square };
        let (max_indentation, least_increment, left_behind) = (max, least, left);
        let regime = words.next()?;
        let regime = Regime::ALL.into_iter().find(|&candidate| candidate as u64 == regime)?;
        Some(History { indentation, max_indentation, segment, least_increment, regime, left_behind })
    }
}
