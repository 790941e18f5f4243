//! Universal libraries of macOS: one file with a library for each processor.
//!
//! Reference: `mach-o/fat.h`. The libraries stay unchanged, which keeps their signatures valid.

use object::macho::FAT_MAGIC;

/// Alignment of each library, as a power of 2: the largest page size of macOS.
const ALIGNMENT: u32 = 14;

/// The next possible start of a library.
fn align(offset: usize) -> usize {
    offset.next_multiple_of(1 << ALIGNMENT)
}

/// One library from several: a single library stays as it is, several become a universal one.
pub fn join(slices: &[&[u8]]) -> Vec<u8> {
    if let [only] = slices {
        return only.to_vec();
    }
    let mut head: Vec<u32> = vec![FAT_MAGIC, slices.len() as u32];
    let mut offset = align(1);
    for slice in slices {
        // processor and its variant, as in the library itself
        let processor = [4, 8].map(|at| u32::from_le_bytes([slice[at], slice[at + 1], slice[at + 2], slice[at + 3]]));
        head.extend([processor[0], processor[1], offset as u32, slice.len() as u32, ALIGNMENT]);
        offset = align(offset + slice.len());
    }
    let mut file: Vec<u8> = head.into_iter().flat_map(u32::to_be_bytes).collect();
    for slice in slices {
        file.resize(align(file.len()), 0);
        file.extend_from_slice(slice);
    }
    file
}
