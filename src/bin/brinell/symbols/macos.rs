//! What macOS asks of a library.
//!
//! Reference: `cs_blobs.h` of the kernel, for the signature. A library that is signed ad hoc has a hash of each of its pages,
//! and nobody's name.

use super::SymbolError;
use crate::platform::Target;
use object::macho::{CS_ADHOC, CS_HASHTYPE_SHA256, CSMAGIC_CODEDIRECTORY, Version};
use object::read::macho::{LoadCommandVariant, MachOFile64};
use object::{BigEndian, Endianness};
use sha2::{Digest, Sha256};
use std::ops::Range;

/// A page of a signed library, and where the hash of its bytes (SHA-256) is; both as bytes of the file.
pub struct Page {
    pub bytes: Range<usize>,
    pub hash: Range<usize>,
}

/// It runs on the oldest macOS that units are for, can be found from any folder, and its signature is right.
pub fn check(library: &[u8], target: &Target) -> Result<(), SymbolError> {
    let file = MachOFile64::<Endianness>::parse(library)?;
    let endian = file.endian();
    let mut commands = file.macho_load_commands()?;
    let (mut oldest, mut is_relative) = (None, false);
    while let Some(command) = commands.next()? {
        match command.variant()? {
            LoadCommandVariant::BuildVersion(version, _) => oldest = Some(version.minos.get(endian)),
            LoadCommandVariant::VersionMin(version) => oldest = Some(version.version.get(endian)),
            LoadCommandVariant::IdDylib(name) => {
                is_relative = command.string(endian, name.dylib.name)?.starts_with(b"@rpath/");
            }
            _ => {}
        }
    }
    let (major, minor) = target.oldest_macos();
    if oldest != Some(Version::new(major, minor, 0)) {
        let found = oldest.map_or("of no version".into(), |oldest| format!("{}.{}", oldest.major(), oldest.minor()));
        return Err(SymbolError::MacOs { found, wanted: format!("{major}.{minor}") });
    }
    if !is_relative {
        return Err(SymbolError::Library("by the path of the machine that built it".into()));
    }
    for Page { bytes, hash } in pages(library)? {
        if Sha256::digest(&library[bytes]).as_slice() != &library[hash] {
            return Err(SymbolError::Signature("the hash of a page is another"));
        }
    }
    Ok(())
}

/// The pages of a library that is signed ad hoc, up to its signature.
///
/// # Errors
/// [`SymbolError::Signature`] if it isn't signed, or in another way.
pub fn pages(library: &[u8]) -> Result<Vec<Page>, SymbolError> {
    let file = MachOFile64::<Endianness>::parse(library)?;
    let endian = file.endian();
    let mut commands = file.macho_load_commands()?;
    let command = loop {
        let command = commands.next()?.ok_or(SymbolError::Signature("there is none"))?;
        if command.cmd() == object::macho::LC_CODE_SIGNATURE {
            break command;
        }
    };
    let command = command.data::<object::macho::LinkeditDataCommand<Endianness>>()?;
    let start = command.dataoff.get(endian) as usize;
    let mut blobs = command.code_signature(endian, library)?.blobs();
    let blob = loop {
        let blob = blobs.next()?.ok_or(SymbolError::Signature("it has no list of pages"))?;
        if blob.magic() == CSMAGIC_CODEDIRECTORY {
            break blob;
        }
    };
    let directory = object::read::macho::CodeDirectory::parse(blob.data())?;
    let header = directory.header();
    let (size, count) = (usize::from(header.hash_size), header.n_code_slots.get(BigEndian));
    if !header.flags.get(BigEndian).contains(CS_ADHOC) {
        return Err(SymbolError::Signature("it is not ad hoc"));
    }
    if header.hash_type != CS_HASHTYPE_SHA256 || size != 32 {
        return Err(SymbolError::Signature("its hashes are not of SHA-256"));
    }
    let page = 1 << header.page_size;
    if directory.code_limit() != start as u64 || start.div_ceil(page) != count as usize {
        return Err(SymbolError::Signature("it doesn't cover the whole library"));
    }
    let hashes = start + blob.offset() as usize + header.hash_offset.get(BigEndian) as usize;
    if hashes + size * count as usize > library.len() {
        return Err(SymbolError::Signature("it ends too early"));
    }
    let page = |index: usize| Page {
        bytes: index * page..((index + 1) * page).min(start),
        hash: hashes + size * index..hashes + size * (index + 1),
    };
    Ok((0..count as usize).map(page).collect())
}
