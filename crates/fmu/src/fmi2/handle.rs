//! The pointers that this library returns, each with its single type.

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
