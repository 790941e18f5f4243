//! The indentation over time: a sum that loses nothing.

/// A sum of many small increments, carried to twice the precision of `f64`.
///
/// `value` is the sum rounded to `f64`, `rest` what the rounding left. After 1e8 steps the value is off by no more than a
/// few units in the last place of the largest sum on the way, however small an increment is beside it.
///
/// Reference: D. E. Knuth, *The Art of Computer Programming*, vol. 2, section 4.2.2, theorem B (the exact error of a sum).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum {
    /// The sum, rounded.
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
    #[inline]
    pub fn plus(self, increment: f64) -> Sum {
        let increment = increment + self.rest;
        let value = self.value + increment;
        let added = value - self.value;
        Sum { value, rest: (self.value - (value - added)) + (increment - added) }
    }
}
