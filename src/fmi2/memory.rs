//! Memory from the process itself: from the C library, or from kernel32 where there is no C library to rely on.
//!
//! FMI 2.0.2 advises against the importer's memory functions; the model description says that they are not used.

use core::ffi::c_void;

#[cfg(not(windows))]
mod system {
    use core::ffi::c_void;
    unsafe extern "C" {
        pub fn calloc(count: usize, size: usize) -> *mut c_void;
        pub fn free(memory: *mut c_void);
    }
}

#[cfg(windows)]
mod system {
    use core::ffi::c_void;
    const HEAP_ZERO_MEMORY: u32 = 8;
    #[link(name = "kernel32", kind = "raw-dylib")]
    unsafe extern "system" {
        fn GetProcessHeap() -> *mut c_void;
        fn HeapAlloc(heap: *mut c_void, flags: u32, size: usize) -> *mut c_void;
        fn HeapFree(heap: *mut c_void, flags: u32, memory: *mut c_void) -> i32;
    }
    pub unsafe fn calloc(count: usize, size: usize) -> *mut c_void {
        // SAFETY: a null result is passed on; the only caller asks for one object, so that the product can't overflow.
        unsafe { HeapAlloc(GetProcessHeap(), HEAP_ZERO_MEMORY, count * size) }
    }
    pub unsafe fn free(memory: *mut c_void) {
        // SAFETY: the caller's memory came from `calloc` above.
        unsafe { HeapFree(GetProcessHeap(), 0, memory) };
    }
}

/// `size` bytes, all zero, aligned for any object; null if there is no memory.
pub fn allocate(size: usize) -> *mut c_void {
    // SAFETY: calloc has no precondition.
    unsafe { system::calloc(1, size) }
}

/// Gives back what [`allocate`] gave.
///
/// # Safety
/// `memory` came from [`allocate`] and is not used afterwards.
pub unsafe fn release(memory: *mut c_void) {
    // SAFETY: as the caller promises.
    unsafe { system::free(memory) }
}
