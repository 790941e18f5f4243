//! The libraries for one target: an archive, and a list of its contents with hashes.
//!
//! All libraries are compressed as one stream, because most of their code is the same.

use super::Library;
use crate::platform::Target;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Ending of an archive, and of a list.
pub const ARCHIVE: &str = "br";
pub const LIST: &str = "json";

/// The list of the libraries for one target.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LibraryList {
    /// Version of the program.
    pub brinell: String,
    /// A hash of the sources that all libraries share.
    pub sources: String,
    /// The archive: its name, size and hash.
    archive: Listed,
    libraries: Vec<Listed>,
}

/// Data with their hash.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Listed {
    name: String,
    size: usize,
    sha256: String,
}

/// Why an archive does not give a library.
#[derive(Clone, Debug, thiserror::Error)]
pub enum ArchiveError {
    #[error("{0}")]
    Damaged(String),
    #[error("there is no prebuilt library `{0}`")]
    Missing(String),
}

/// The result for one target.
pub struct Written {
    pub libraries: usize,
    /// All libraries \[bytes\].
    pub unpacked: usize,
    /// The archive \[bytes\].
    pub packed: usize,
}

impl Listed {
    fn new(name: String, bytes: &[u8]) -> Listed {
        Listed { name, size: bytes.len(), sha256: sha256(bytes) }
    }

    fn is(&self, bytes: &[u8]) -> bool {
        self.size == bytes.len() && self.sha256 == sha256(bytes)
    }
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

impl LibraryList {
    /// Reads the `text` of a list.
    ///
    /// # Errors
    /// The mistake in words.
    pub fn read(text: &str) -> Result<LibraryList, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    /// The prebuilt `library` from `archive`, not filled in.
    ///
    /// # Errors
    /// [`ArchiveError`]
    pub fn library(&self, archive: &[u8], library: &Library) -> Result<Vec<u8>, ArchiveError> {
        let damaged = |reason: &str| ArchiveError::Damaged(reason.into());
        if !self.archive.is(archive) {
            return Err(damaged("it has another hash than its list says"));
        }
        let total = self.libraries.iter().map(|listed| listed.size).sum();
        let all = unpack(archive, total).ok_or_else(|| damaged("it can't be unpacked"))?;
        let mut begin = 0;
        for listed in &self.libraries {
            let end = begin + listed.size;
            if listed.name == library.name {
                let (bytes, name) = (&all[begin..end], library.name);
                let intact = listed.is(bytes);
                return if intact { Ok(bytes.into()) } else { Err(damaged(&format!("`{name}` has another hash"))) };
            }
            begin = end;
        }
        Err(ArchiveError::Missing(library.name.into()))
    }
}

/// The archive of the `libraries` for `target`, made from these `sources`, the text of its list, and their sizes.
pub fn write(target: &Target, sources: &str, libraries: &[(&Library, Vec<u8>)]) -> (Vec<u8>, String, Written) {
    let all: Vec<u8> = libraries.iter().flat_map(|(_, bytes)| bytes).copied().collect();
    let listed = libraries.iter().map(|(library, bytes)| Listed::new(library.name.into(), bytes));
    let (archive, listed) = (pack(&all), listed.collect());
    let list = LibraryList {
        brinell: env!("CARGO_PKG_VERSION").into(),
        sources: sources.into(),
        archive: Listed::new(format!("{}.{ARCHIVE}", target.triple), &archive),
        libraries: listed,
    };
    let text = serde_json::to_string_pretty(&list).expect("a list is plain data") + "\n";
    let written = Written { libraries: libraries.len(), unpacked: all.len(), packed: archive.len() };
    (archive, text, written)
}

/// Window of the compression [log2 of bytes].
const WINDOW: i32 = 24;

/// `bytes` at the highest compression.
fn pack(bytes: &[u8]) -> Vec<u8> {
    let parameters = brotli::enc::BrotliEncoderParams { quality: 11, lgwin: WINDOW, ..Default::default() };
    let mut packed = Vec::new();
    let mut bytes = bytes;
    brotli::BrotliCompress(&mut bytes, &mut packed, &parameters).expect("memory takes everything");
    packed
}

/// Unpacks this many bytes from the output of [`pack`]; `None` for other input.
fn unpack(packed: &[u8], size: usize) -> Option<Vec<u8>> {
    let mut unpacked = Vec::with_capacity(size);
    let mut packed = packed;
    brotli::BrotliDecompress(&mut packed, &mut unpacked).ok()?;
    (unpacked.len() == size).then_some(unpacked)
}
