//! The pointers that this library returns, each with the one type that it points to.

use core::ffi::c_void;

/// What a pointer points to that this library has handed out as `void *`.
///
/// All casts between the two are here.
pub trait Handle: Sized {
    /// The pointer as C sees it.
    fn handle(object: *mut Self) -> *mut c_void {
        object.cast()
    }

    /// The memory behind the pointer, as an object of this type.
    fn pointer(handle: *mut c_void) -> *mut Self {
        handle.cast()
    }

    /// The object behind the pointer; none if that is null.
    ///
    /// # Safety
    /// A pointer that isn't null came from [`Handle::handle`] of an object of this type that lives, and that nothing else uses
    /// meanwhile.
    #[inline(always)]
    unsafe fn behind<'a>(handle: *mut c_void) -> Option<&'a mut Self> {
        // SAFETY: as the caller promises.
        unsafe { Self::pointer(handle).as_mut() }
    }
}
