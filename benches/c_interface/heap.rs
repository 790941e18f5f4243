//! Memory in use according to the C library.

/// The result of glibc's `mallinfo2` [bytes], in the order of `malloc.h`.
#[cfg(unix)]
#[repr(C)]
struct Info {
    arena: usize,
    free_chunks: usize,
    free_fast_chunks: usize,
    mapped_chunks: usize,
    mapped: usize,
    largest: usize,
    free_fast: usize,
    in_use: usize,
    free: usize,
    releasable: usize,
}

/// Memory allocated by malloc [bytes], including its overhead; `None` without glibc 2.33 or newer.
#[cfg(unix)]
pub fn in_use() -> Option<usize> {
    use libloading::os::unix::Library;
    // SAFETY: the type is that of glibc's header.
    let info = unsafe {
        let mallinfo = Library::this().get::<unsafe extern "C" fn() -> Info>(c"mallinfo2").ok()?;
        mallinfo()
    };
    Some(info.in_use + info.mapped)
}

/// Not available on this system.
#[cfg(not(unix))]
pub fn in_use() -> Option<usize> {
    None
}
