//! The ad-hoc signature of a Mach-O library: a hash of each page of the file, which the linker has made.
//!
//! macOS on arm64 loads no library whose pages don't have the hashes of its signature. It asks for no certificate: whoever
//! changes a page may write the new hash.
//!
//! Reference: `osfmk/kern/cs_blobs.h` of XNU (the layout of the signature; all its numbers are big-endian).

use object::LittleEndian;
use object::macho::{LC_CODE_SIGNATURE, LinkeditDataCommand, MachHeader64};
use object::read::macho::MachHeader;
use sha2::{Digest, Sha256};
use std::ops::Range;

/// Several blobs in one; the first four bytes of a signature.
const EMBEDDED_SIGNATURE: u32 = 0xfade_0cc0;

/// First four bytes of the blob that has the hashes.
const CODE_DIRECTORY: u32 = 0xfade_0c02;

/// The hash of a page is that of SHA-256.
const SHA256: u8 = 2;

/// Length of such a hash [bytes].
const HASH: usize = 32;

/// A signature that can't be renewed.
#[derive(Debug, thiserror::Error)]
pub enum SignatureError {
    #[error("it can't be read as a library: {0}")]
    Unreadable(#[from] object::Error),
    #[error("there is none, and macOS would not load the library")]
    None,
    #[error("it isn't built as expected: {0}")]
    Unknown(&'static str),
    #[error("page {0} of the library doesn't have the hash that the linker gave it: the file is damaged")]
    Wrong(usize),
}

/// The hashes of the pages, as far as they are needed.
struct Directory {
    /// Where the first hash is in the file.
    hashes: usize,
    pages: usize,
    page_size: usize,
    /// Where the signed part of the file ends.
    end: usize,
}

impl Directory {
    fn of(library: &[u8]) -> Result<Directory, SignatureError> {
        let start = signature(library)?;
        let number = |at: usize| read(library, start + at);
        if number(0)? != EMBEDDED_SIGNATURE {
            return Err(SignatureError::Unknown("it doesn't begin as one"));
        }
        // type and place of each blob follow each other
        let places = (0..number(8)? as usize).map(|index| number(12 + 8 * index + 4));
        let mut found = None;
        for place in places {
            let place = place? as usize;
            if number(place)? == CODE_DIRECTORY {
                found = Some(start + place);
            }
        }
        let at = found.ok_or(SignatureError::Unknown("it has no hashes"))?;
        let [hashes, pages, end] = [16, 28, 32].map(|field| read(library, at + field));
        let kind = library.get(at + 36..at + 40).ok_or(SignatureError::Unknown("it is cut off"))?;
        let &[size, algorithm, _, page_bits] = kind else { unreachable!("four bytes") };
        if (usize::from(size), algorithm) != (HASH, SHA256) || !(9..=16).contains(&page_bits) {
            return Err(SignatureError::Unknown("its hashes are of another kind than SHA-256 of a page"));
        }
        let directory = Directory {
            hashes: at + hashes? as usize,
            pages: pages? as usize,
            page_size: 1 << page_bits,
            end: end? as usize,
        };
        let whole = directory.end <= library.len()
            && directory.hashes + HASH * directory.pages <= library.len()
            && directory.pages == directory.end.div_ceil(directory.page_size);
        if whole { Ok(directory) } else { Err(SignatureError::Unknown("it is cut off")) }
    }

    /// Where the hash of a page is, and what it is now.
    fn page(&self, library: &[u8], page: usize) -> (Range<usize>, [u8; HASH]) {
        let from = page * self.page_size;
        let to = (from + self.page_size).min(self.end);
        let place = self.hashes + HASH * page;
        (place..place + HASH, Sha256::digest(&library[from..to]).into())
    }
}

/// Where the signature is in the file.
fn signature(library: &[u8]) -> Result<usize, SignatureError> {
    let header = MachHeader64::<LittleEndian>::parse(library, 0)?;
    let endian = header.endian()?;
    let mut commands = header.load_commands(endian, library, 0)?;
    while let Some(command) = commands.next()? {
        if command.cmd() == LC_CODE_SIGNATURE {
            let command: &LinkeditDataCommand<LittleEndian> = command.data()?;
            return Ok(command.dataoff.get(endian) as usize);
        }
    }
    Err(SignatureError::None)
}

/// The number at a place of the file.
fn read(library: &[u8], at: usize) -> Result<u32, SignatureError> {
    let bytes = library.get(at..).and_then(|rest| rest.first_chunk());
    bytes.map(|bytes| u32::from_be_bytes(*bytes)).ok_or(SignatureError::Unknown("it is cut off"))
}

/// Looks whether every page of a `library` has the hash of its signature.
///
/// # Errors
/// [`SignatureError`]
pub fn check(library: &[u8]) -> Result<(), SignatureError> {
    let directory = Directory::of(library)?;
    let is_wrong = |page: &usize| {
        let (place, hash) = directory.page(library, *page);
        library[place] != hash
    };
    match (0..directory.pages).find(is_wrong) {
        Some(page) => Err(SignatureError::Wrong(page)),
        None => Ok(()),
    }
}

/// Writes the hashes of the pages in which bytes have `changed`.
///
/// # Errors
/// [`SignatureError`]
pub fn renew(library: &mut [u8], changed: Range<usize>) -> Result<(), SignatureError> {
    let directory = Directory::of(library)?;
    if changed.is_empty() || changed.end > directory.end {
        return Err(SignatureError::Unknown("it doesn't cover what is written"));
    }
    for page in changed.start / directory.page_size..=(changed.end - 1) / directory.page_size {
        let (place, hash) = directory.page(library, page);
        library[place].copy_from_slice(&hash);
    }
    Ok(())
}
