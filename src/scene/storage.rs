//! Memory whose size the scene determines: arrays of a length that it specifies, and values that may be absent.

/// An array of [`Store::LENGTH`] values.
pub trait Store<T>: AsRef<[T]> + AsMut<[T]> {
    /// How many there are.
    const LENGTH: usize;

    /// The array with `value` everywhere.
    fn filled(value: T) -> Self
    where
        T: Copy;
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

/// Whether something is there: [`Present`] or [`Absent`].
pub trait Presence {
    /// Whether it is.
    const IS_PRESENT: bool;

    /// What takes the place of `S`, an array of `T`: itself, or an empty one.
    type Of<T, S: Store<T>>: Store<T>;
}

/// It is there.
pub struct Present;

/// It isn't, and takes no memory.
pub struct Absent;

impl Presence for Present {
    const IS_PRESENT: bool = true;
    type Of<T, S: Store<T>> = S;
}

impl Presence for Absent {
    const IS_PRESENT: bool = false;
    type Of<T, S: Store<T>> = [T; 0];
}
