//! Memory for instances and states.
//!
//! It is the memory of the process: from the C library, or from kernel32 where there is no C library to rely on. FMI 2.0.2
//! advises against the importer's memory functions; the model description declares that they are not used.
//!
//! A standalone FMU (feature `standalone`) needs nothing from the process. Its memory comes from `allocateMemory` and
//! `freeMemory` of its importer, as its model description declares.

use super::complaint::Complaint;
use core::ffi::c_void;

/// The importer's function to allocate memory: the number of objects, and the size of each \[bytes\]. The memory is zeroed.
pub type Allocate = unsafe extern "C" fn(usize, usize) -> *mut c_void;

/// The importer's function to free memory.
pub type Free = unsafe extern "C" fn(*mut c_void);

#[cfg(feature = "standalone")]
pub use importer::Memory;
#[cfg(not(feature = "standalone"))]
pub use process::Memory;

#[cfg(not(feature = "standalone"))]
mod process {
    use super::*;

    #[cfg(not(windows))]
    mod system {
        use core::ffi::c_void;
        #[cfg_attr(target_arch = "wasm32", link(wasm_import_module = "env"))]
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
            // SAFETY: a null result is passed on; the only caller requests one object, so the product cannot overflow.
            unsafe { HeapAlloc(GetProcessHeap(), HEAP_ZERO_MEMORY, count * size) }
        }
        pub unsafe fn free(memory: *mut c_void) {
            // SAFETY: the caller's memory comes from `calloc` above.
            unsafe { HeapFree(GetProcessHeap(), 0, memory) };
        }
    }

    /// The memory of the process.
    #[derive(Clone, Copy)]
    pub struct Memory;

    impl Memory {
        /// The memory for an instance; the functions are not used.
        ///
        /// # Errors
        /// None.
        pub fn of(_: Option<Allocate>, _: Option<Free>) -> Result<Memory, Complaint> {
            Ok(Memory)
        }

        /// `size` bytes of zeroed memory, aligned for any object; null if there is no memory.
        pub fn allocate(self, size: usize) -> *mut c_void {
            // SAFETY: calloc has no precondition.
            unsafe { system::calloc(1, size) }
        }

        /// Frees memory from [`Memory::allocate`].
        ///
        /// # Safety
        /// `memory` comes from [`Memory::allocate`] and is not used afterwards.
        pub unsafe fn release(self, memory: *mut c_void) {
            // SAFETY: guaranteed by the caller.
            unsafe { system::free(memory) }
        }
    }
}

#[cfg(feature = "standalone")]
mod importer {
    use super::*;

    /// The memory of the importer.
    #[derive(Clone, Copy)]
    pub struct Memory {
        allocate: Option<Allocate>,
        free: Option<Free>,
    }

    impl Memory {
        /// The memory for an instance with these functions.
        ///
        /// # Errors
        /// [`Complaint::NullPointer`] if one of the two functions is missing.
        pub fn of(allocate: Option<Allocate>, free: Option<Free>) -> Result<Memory, Complaint> {
            if allocate.is_none() || free.is_none() {
                let argument = if allocate.is_none() { "allocateMemory" } else { "freeMemory" };
                return Err(Complaint::NullPointer { argument });
            }
            Ok(Memory { allocate, free })
        }

        /// `size` bytes of zeroed memory, aligned for any object; null if there is no memory.
        pub fn allocate(self, size: usize) -> *mut c_void {
            // SAFETY: the importer's function; it has no precondition.
            self.allocate.map_or(core::ptr::null_mut(), |allocate| unsafe { allocate(1, size) })
        }

        /// Frees memory from [`Memory::allocate`].
        ///
        /// # Safety
        /// `memory` comes from [`Memory::allocate`] and is not used afterwards.
        pub unsafe fn release(self, memory: *mut c_void) {
            if let Some(free) = self.free {
                // SAFETY: guaranteed by the caller.
                unsafe { free(memory) }
            }
        }
    }
}
