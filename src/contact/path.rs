//! The indentation over time: a sum that loses nothing.

/// A sum of many small increments, carried to twice the precision of `f64`.
///
/// `value` is the sum as it would be without care, `rest` the sum of what the roundings lost. After 1e8 steps
/// [`Sum::total`] is off by no more than a few units in the last place of the largest sum on the way, however small an
/// increment is beside it: what an increment smaller than the sum loses is known exactly. One larger than the sum, near
/// zero, may lose half a unit in its own last place. No addition waits for the rest of the one before, so that a step takes
/// no longer than with a plain sum.
///
/// Reference: A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen", *ZAMM* 54 (1974)
/// 39-51; T. J. Dekker, *Numer. Math.* 18 (1971) 224-242, for the error of a sum whose larger term is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    /// The sum, with its roundings.
    pub value: f64,
    /// What is missing in `value`.
    pub rest: f64,
}

impl Sum {
    /// The sum that is `value` so far.
    pub const fn new(value: f64) -> Sum {
        Sum { value, rest: 0.0 }
    }

    /// The sum with `increment` added.
    #[inline(always)]
    pub fn plus(self, increment: f64) -> Sum {
        let value = self.value + increment;
        Sum { value, rest: self.rest + (increment - (value - self.value)) }
    }

    /// The sum, rounded once.
    #[inline(always)]
    pub fn total(self) -> f64 {
        self.value + self.rest
    }
}
