//! Memory whose size the scene determines: arrays of a length that it specifies, and values that may be absent.

use crate::c::span::Free;

/// An array of [`Store::LENGTH`] values.
pub trait Store<T>: AsRef<[T]> + AsMut<[T]> {
    /// The number of values that lie in the array itself.
    const LENGTH: usize;

    /// The array with every element equal to `value`.
    fn filled(value: T) -> Self
    where
        T: Copy;

    /// The memory that `count` values take outside of the array \[bytes\].
    #[inline(always)]
    fn outside(_count: usize) -> usize {
        0
    }

    /// Places `count` values in memory outside of the array, if it has a length of its own only there.
    #[inline(always)]
    fn place(&mut self, _count: usize, _free: &mut Free) {}
}

impl<T, const LENGTH: usize> Store<T> for [T; LENGTH] {
    const LENGTH: usize = LENGTH;

    fn filled(value: T) -> [T; LENGTH]
    where
        T: Copy,
    {
        [value; LENGTH]
    }
}

/// Whether a feature is present: [`Present`] or [`Absent`].
pub trait Presence {
    /// Whether it is present.
    const IS_PRESENT: bool;

    /// The type in place of `S`, an array of `T`: `S` itself, or an empty array.
    type Of<T, S: Store<T>>: Store<T>;
}

/// The feature is present.
pub struct Present;

/// The feature is absent, and takes no memory.
pub struct Absent;

impl Presence for Present {
    const IS_PRESENT: bool = true;
    type Of<T, S: Store<T>> = S;
}

impl Presence for Absent {
    const IS_PRESENT: bool = false;
    type Of<T, S: Store<T>> = [T; 0];
}
