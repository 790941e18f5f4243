//! A history as a copy, and as words to be stored.

use super::{History, Regime, Sum};
use crate::contact::Model;
use crate::contact::segment::Segment;

impl History {
    /// Makes this history the same as `other`, number by number: a compiler that looks for the smallest code would otherwise
    /// take the slowest instruction for it.
    #[inline(always)]
    pub fn copy_from(&mut self, other: &History) {
        let Sum { value, rest } = other.indentation;
        let Segment { lower, upper, origin, constant, linear, power, square } = other.segment;
        let (max_indentation, least_increment) = (other.max_indentation, other.least_increment);
        let (regime, left_behind) = (other.regime, other.left_behind);
        self.indentation = Sum { value, rest };
        self.segment = Segment { lower, upper, origin, constant, linear, power, square };
        (self.max_indentation, self.least_increment) = (max_indentation, least_increment);
        (self.regime, self.left_behind) = (regime, left_behind);
    }

    /// The history as words, to be stored.
    pub fn to_words(&self) -> [u64; History::WORDS] {
        let Segment { lower, upper, origin, constant, linear, power, square } = self.segment;
        let Sum { value, rest } = self.indentation;
        let state = [value, rest, self.max_indentation, self.left_behind, self.least_increment].map(f64::to_bits);
        let segment = [lower, upper, origin, constant, linear, power, square].map(f64::to_bits);
        let [value, rest, largest, left_behind, least] = state;
        let [lower, upper, origin, constant, linear, power, square] = segment;
        let regime = self.regime as u64;
        [value, rest, largest, left_behind, least, lower, upper, origin, constant, linear, power, square, regime]
    }

    /// The history of a contact by `model` that [`History::to_words`] stored; `None` if a word is not a finite number or not a regime.
    pub fn from_words<L, U>(words: &[u64; History::WORDS], _model: &Model<L, U>) -> Option<History> {
        let [numbers @ .., regime] = words.map(f64::from_bits);
        if numbers.iter().any(|number| !number.is_finite()) {
            return None;
        }
        let [value, rest, max_indentation, left_behind, least_increment, segment @ ..] = numbers;
        let [lower, upper, origin, constant, linear, power, square] = segment;
        let regime = Regime::ALL.into_iter().find(|&candidate| candidate as u64 == regime.to_bits())?;
        Some(History {
            indentation: Sum { value, rest },
            max_indentation,
            segment: Segment { lower, upper, origin, constant, linear, power, square },
            least_increment,
            regime,
            left_behind,
        })
    }
}
