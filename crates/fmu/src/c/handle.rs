//! Pointers that cross the interface: those that this library returns, each with its single type, and those of its callers.

use super::complaint::Complaint;
use core::ffi::c_void;

/// The object behind a pointer that this library has returned as `void *`.
///
/// All casts between the two are here.
pub trait Handle: Sized {
    /// The pointer as `void *`.
    fn handle(object: *mut Self) -> *mut c_void {
        object.cast()
    }

    /// The pointer as a pointer to this type.
    fn pointer(handle: *mut c_void) -> *mut Self {
        handle.cast()
    }

    /// The object behind the pointer; `None` for a null pointer.
    ///
    /// # Safety
    /// A pointer that is not null comes from [`Handle::handle`] of an object of this type. The object still exists, and nothing
    /// else uses it meanwhile.
    #[inline(always)]
    unsafe fn behind<'a>(handle: *mut c_void) -> Option<&'a mut Self> {
        // SAFETY: guaranteed by the caller.
        unsafe { Self::pointer(handle).as_mut() }
    }
}

/// Whether surely none of some pointers is null, in one comparison. `common` are the bits that all their addresses have. If there
/// are none, one may be null; then another check decides.
#[inline(always)]
pub fn are_given(common: usize) -> bool {
    common != 0
}

/// The array of `length` elements at `pointer`.
///
/// # Errors
/// [`Complaint::NullPointer`] if it is null and the array is not empty.
///
/// # Safety
/// A pointer that is not null points to `length` initialized elements, which nothing modifies meanwhile.
#[inline]
pub unsafe fn array<'a, T>(pointer: *const T, length: usize, argument: &'static str) -> Result<&'a [T], Complaint> {
    if length == 0 {
        Ok(&[])
    } else if pointer.is_null() {
        Err(Complaint::NullPointer { argument })
    } else {
        // SAFETY: guaranteed by the caller.
        Ok(unsafe { core::slice::from_raw_parts(pointer, length) })
    }
}

/// The array of `length` elements at `pointer`, for writing.
///
/// # Errors
/// As for [`fn@array`].
///
/// # Safety
/// As for [`fn@array`], and nothing else uses the elements meanwhile.
#[inline]
pub unsafe fn array_mut<'a, T>(
    pointer: *mut T,
    length: usize,
    argument: &'static str,
) -> Result<&'a mut [T], Complaint> {
    if length == 0 {
        Ok(&mut [])
    } else if pointer.is_null() {
        Err(Complaint::NullPointer { argument })
    } else {
        // SAFETY: guaranteed by the caller.
        Ok(unsafe { core::slice::from_raw_parts_mut(pointer, length) })
    }
}

/// The object at `pointer`, for writing.
///
/// # Errors
/// [`Complaint::NullPointer`] if it is null.
///
/// # Safety
/// A pointer that is not null points to an object that nothing else uses meanwhile.
#[inline]
pub unsafe fn object<'a, T>(pointer: *mut T, argument: &'static str) -> Result<&'a mut T, Complaint> {
    // SAFETY: guaranteed by the caller.
    unsafe { pointer.as_mut() }.ok_or(Complaint::NullPointer { argument })
}
