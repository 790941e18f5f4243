//! The signature of a library for macOS that is signed ad hoc: it has a hash of each page of the file, but no name.
//! macOS does not load a page with another hash.
//!
//! Reference: `cs_blobs.h` of the kernel.

use object::macho::{CS_ADHOC, CS_HASHTYPE_SHA256, CSMAGIC_CODEDIRECTORY, LC_CODE_SIGNATURE, LinkeditDataCommand};
use object::read::macho::{CodeDirectory, MachOFile64};
use object::{BigEndian, Endianness};
use sha2::{Digest, Sha256};
use std::ops::Range;

/// Length of a hash \[bytes\].
const HASH: usize = 32;

/// An invalid signature.
#[derive(Debug, thiserror::Error)]
pub enum SignatureError {
    #[error("it can't be read: {0}")]
    Unreadable(#[from] object::Error),
    #[error("there is none, and macOS would not load the library")]
    None,
    #[error("it isn't built as expected: {0}")]
    Unknown(&'static str),
    #[error("page {0} of the library has another hash than the linker gave it")]
    Wrong(usize),
}

/// A page of a library, and the location of its hash, both as ranges of the file.
struct Page {
    bytes: Range<usize>,
    hash: Range<usize>,
}

impl Page {
    /// The hash of its bytes.
    fn found(&self, library: &[u8]) -> [u8; HASH] {
        Sha256::digest(&library[self.bytes.clone()]).into()
    }
}

/// The pages of a library, up to its signature.
fn pages(library: &[u8]) -> Result<Vec<Page>, SignatureError> {
    let file = MachOFile64::<Endianness>::parse(library)?;
    let endian = file.endian();
    let mut commands = file.macho_load_commands()?;
    let command = loop {
        let command = commands.next()?.ok_or(SignatureError::None)?;
        if command.cmd() == LC_CODE_SIGNATURE {
            break command.data::<LinkeditDataCommand<Endianness>>()?;
        }
    };
    let start = command.dataoff.get(endian) as usize;
    let mut blobs = command.code_signature(endian, library)?.blobs();
    let blob = loop {
        let blob = blobs.next()?.ok_or(SignatureError::Unknown("it has no hashes"))?;
        if blob.magic() == CSMAGIC_CODEDIRECTORY {
            break blob;
        }
    };
    let directory = CodeDirectory::parse(blob.data())?;
    let header = directory.header();
    if !header.flags.get(BigEndian).contains(CS_ADHOC) {
        return Err(SignatureError::Unknown("it is not ad hoc"));
    }
    let is_sha256 = header.hash_type == CS_HASHTYPE_SHA256 && usize::from(header.hash_size) == HASH;
    if !is_sha256 || !(9..=16).contains(&header.page_size) {
        return Err(SignatureError::Unknown("its hashes are of another kind than SHA-256 of a page"));
    }
    let (count, page_size) = (header.n_code_slots.get(BigEndian) as usize, 1 << header.page_size);
    if directory.code_limit() != start as u64 || start.div_ceil(page_size) != count {
        return Err(SignatureError::Unknown("it doesn't cover the whole library"));
    }
    let hashes = start + blob.offset() as usize + header.hash_offset.get(BigEndian) as usize;
    if hashes + HASH * count > library.len() {
        return Err(SignatureError::Unknown("it is cut off"));
    }
    let page = |index: usize| Page {
        bytes: index * page_size..((index + 1) * page_size).min(start),
        hash: hashes + HASH * index..hashes + HASH * (index + 1),
    };
    Ok((0..count).map(page).collect())
}

/// Checks that every page of a `library` has the hash of its signature.
///
/// # Errors
/// [`SignatureError`]
pub fn check(library: &[u8]) -> Result<(), SignatureError> {
    match pages(library)?.iter().position(|page| library[page.hash.clone()] != page.found(library)) {
        Some(page) => Err(SignatureError::Wrong(page)),
        None => Ok(()),
    }
}

/// Updates the hashes of all pages with `changed` bytes.
///
/// # Errors
/// [`SignatureError`]
pub fn renew(library: &mut [u8], changed: Range<usize>) -> Result<(), SignatureError> {
    let pages = pages(library)?;
    if pages.last().is_none_or(|last| last.bytes.end < changed.end) {
        return Err(SignatureError::Unknown("it doesn't cover what is written"));
    }
    for page in pages.iter().filter(|page| page.bytes.start < changed.end && changed.start < page.bytes.end) {
        let hash = page.found(library);
        library[page.hash.clone()].copy_from_slice(&hash);
    }
    Ok(())
}
