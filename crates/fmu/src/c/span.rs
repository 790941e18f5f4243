//! Arrays in the memory behind an object, for scenes whose numbers of contacts and parameters are known only when a library is loaded.

use crate::scene::Store;
use core::marker::PhantomData;

/// An array of values in the memory behind the object that the span is a field of. It is empty before it is [placed](Store::place), and
/// so is a span of zeros.
///
/// A placed span must stay where it is: it knows the distance of its values from itself.
#[repr(C)]
pub struct Span<T> {
    /// Distance of the first value from the span \[bytes\].
    distance: u32,
    length: u32,
    values: PhantomData<T>,
}

/// Memory behind an object that no span has taken yet. It consists of zeros, which are valid values of every type that spans hold.
pub struct Free {
    next: usize,
    end: usize,
}

/// Values are placed at multiples of this \[bytes\].
const ALIGNMENT: usize = 8;

/// The bytes that `count` values of `T` take.
const fn size_of_values<T>(count: usize) -> usize {
    assert!(align_of::<T>() <= ALIGNMENT);
    (count * size_of::<T>()).next_multiple_of(ALIGNMENT)
}

impl Free {
    /// The `size` bytes behind `object`.
    ///
    /// # Safety
    /// They belong to the same allocation as the object, are zeroed, and nothing else uses them while the object exists. The provenance
    /// of the allocation is exposed. The object is never moved.
    pub unsafe fn behind<O>(object: &mut O, size: usize) -> Free {
        let next = core::ptr::from_mut(object).addr() + size_of::<O>();
        Free { next, end: next + size }
    }
}

impl<T> AsRef<[T]> for Span<T> {
    #[inline(always)]
    fn as_ref(&self) -> &[T] {
        if self.length == 0 {
            return &[];
        }
        let start = core::ptr::from_ref(self).addr() + self.distance as usize;
        // SAFETY: `place` has found as many values there. They are borrowed as long as the span is.
        unsafe { core::slice::from_raw_parts(core::ptr::with_exposed_provenance(start), self.length as usize) }
    }
}

impl<T> AsMut<[T]> for Span<T> {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [T] {
        if self.length == 0 {
            return &mut [];
        }
        let start = core::ptr::from_ref(self).addr() + self.distance as usize;
        // SAFETY: as above; no two spans share a value.
        unsafe { core::slice::from_raw_parts_mut(core::ptr::with_exposed_provenance_mut(start), self.length as usize) }
    }
}

impl<T> Store<T> for Span<T> {
    const LENGTH: usize = 0;

    fn filled(_value: T) -> Span<T>
    where
        T: Copy,
    {
        Span { distance: 0, length: 0, values: PhantomData }
    }

    fn outside(count: usize) -> usize {
        size_of_values::<T>(count)
    }

    fn place(&mut self, count: usize, free: &mut Free) {
        let (size, own) = (size_of_values::<T>(count), core::ptr::from_ref(self).addr());
        let end = free.next + size;
        if end <= free.end {
            (self.distance, self.length) = ((free.next - own) as u32, count as u32);
            free.next = end;
        }
    }
}
