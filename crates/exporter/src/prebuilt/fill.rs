//! Writing the data of a scene into a prebuilt library.

use crate::signature::{self, SignatureError};
use brinell_fmu::scene::library::block::{Block, MAGIC, VERSION};
use object::{BinaryFormat, Object, ObjectSection};
use std::ops::Range;

/// Name of the section with the block, in Mach-O and in other formats.
const SECTIONS: [&str; 2] = ["__brinell", ".brinell"];

/// An error of filling in a library.
#[derive(Debug, thiserror::Error)]
pub enum FillError {
    #[error("it can't be read as a library: {0}")]
    Unreadable(#[from] object::Error),
    #[error("it has no section {} for the data of a scene", SECTIONS[1])]
    NoSection,
    #[error(
        "its section for the data of a scene has {found} bytes instead of {expected}: it was made by another version"
    )]
    Size { found: usize, expected: usize },
    #[error("its section for the data of a scene begins with other numbers than an empty one of this version")]
    NotEmpty,
    #[error("it is no C source of this version")]
    NoSource,
    #[error("its signature can't be renewed: {0}")]
    Signature(#[from] SignatureError),
}

/// Writes the `block` of a scene to `library`.
///
/// # Errors
/// [`FillError`]; part of the data may then be written.
pub fn fill(library: &mut [u8], block: &Block) -> Result<(), FillError> {
    let empty: Vec<u8> = Block::unfilled(block.library).words().flat_map(u64::to_le_bytes).collect();
    let block: Vec<u8> = block.words().flat_map(u64::to_le_bytes).collect();
    debug_assert_eq!([block.len(), empty.len()], [size_of::<Block>(); 2]);
    let (format, section) = section(library)?;
    let room = &library[section.clone()];
    if room.len() != block.len() {
        return Err(FillError::Size { found: room.len(), expected: block.len() });
    }
    // numbers that identify it; the rest of an empty block is not defined
    if room[..HEAD] != empty[..HEAD] {
        return Err(FillError::NotEmpty);
    }
    if format == BinaryFormat::MachO {
        signature::check(library)?;
    }
    library[section.clone()].copy_from_slice(&block);
    if format == BinaryFormat::MachO {
        signature::renew(library, section)?;
    }
    Ok(())
}

/// Magic, version, library and length.
const HEAD: usize = 8 * 4;
const _: () = assert!(MAGIC != 0 && VERSION != 0);

/// The format of a library, and the position of its block.
fn section(library: &[u8]) -> Result<(BinaryFormat, Range<usize>), FillError> {
    let file = object::File::parse(library)?;
    let section = SECTIONS.iter().find_map(|name| file.section_by_name(name)).ok_or(FillError::NoSection)?;
    let (offset, size) = section.file_range().ok_or(FillError::NoSection)?;
    let offset = offset as usize;
    // the sections of a DLL are padded to the file alignment
    let size = if file.format() == BinaryFormat::Pe { section.size() } else { size } as usize;
    if library.len() < offset + size {
        return Err(FillError::NoSection);
    }
    Ok((file.format(), offset..offset + size))
}
