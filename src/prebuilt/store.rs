//! A folder of prebuilt libraries: for each target an archive, and a list of its contents with hashes.
//!
//! All libraries are compressed as one stream, because most of their code is the same.

use super::folder::{self, LIST, PrebuiltFolder};
use crate::files::{FileError, write_whole};
use crate::sources;
use brinell_exporter::layout::shown;
use brinell_exporter::platform::{Platform, Target};
use brinell_exporter::prebuilt::Library;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs;
use std::path::{Path, PathBuf};

/// An error of reading a prebuilt library.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    #[error(
        "there are no prebuilt libraries installed with this program: the wheel of a release has them, `brinell prebuild` makes them where there is a compiler, and BRINELL_PREBUILT names their folder"
    )]
    NoFolder,
    #[error("there are no prebuilt libraries in {folder}: BRINELL_PREBUILT names the folder where they are", folder = shown(folder))]
    Empty { folder: PathBuf },
    #[error("there are no prebuilt libraries for {target} in {folder}, only for {known}", folder = shown(folder))]
    NoTarget { folder: PathBuf, target: &'static str, known: String },
    #[error("the prebuilt libraries in {folder} are from another version of Brinell ({version}): make them anew by `brinell prebuild`", folder = shown(folder))]
    OtherVersion { folder: PathBuf, version: String },
    #[error("there is no prebuilt library `{name}` in {folder}", folder = shown(folder))]
    NoLibrary { folder: PathBuf, name: String },
    #[error("{path} is damaged: {reason}", path = shown(path))]
    Damaged { path: PathBuf, reason: String },
    #[error("{0}")]
    File(#[from] FileError),
}

/// The list of the libraries for one target.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LibraryList {
    /// Version of the program.
    brinell: String,
    /// A hash of the sources that all libraries share.
    sources: String,
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

/// Ending of an archive.
const ARCHIVE: &str = "br";

/// A folder of prebuilt libraries.
pub struct Store {
    folder: PrebuiltFolder,
    platforms: Vec<Platform>,
}

impl Store {
    /// The folder named by the user, otherwise the installed one.
    ///
    /// # Errors
    /// [`StoreError::NoFolder`]
    pub fn find() -> Result<Store, StoreError> {
        let found = folder::find().ok_or(StoreError::NoFolder)?;
        let platforms = found.platforms();
        if platforms.is_empty() {
            return Err(StoreError::Empty { folder: found.path });
        }
        Ok(Store { folder: found, platforms })
    }

    /// The platforms with libraries.
    pub fn platforms(&self) -> &[Platform] {
        &self.platforms
    }

    /// Its path.
    fn folder(&self) -> PathBuf {
        self.folder.path.clone()
    }

    /// The list for `target`, for this version.
    fn list(&self, target: &Target) -> Result<LibraryList, StoreError> {
        let path = self.folder.file(target, LIST);
        if !path.is_file() {
            let known = self.platforms.iter().map(|platform| platform.folder).collect::<Vec<_>>().join(", ");
            return Err(StoreError::NoTarget { folder: self.folder(), target: target.triple, known });
        }
        let text = fs::read_to_string(&path).map_err(FileError::at(&path))?;
        let list: LibraryList = serde_json::from_str(&text)
            .map_err(|error| StoreError::Damaged { path: path.clone(), reason: error.to_string() })?;
        if list.sources != sources::hash() {
            return Err(StoreError::OtherVersion { folder: self.folder(), version: list.brinell });
        }
        Ok(list)
    }

    /// The prebuilt `library` for `target`, not filled in.
    ///
    /// # Errors
    /// [`StoreError`]
    pub fn library(&self, library: &Library, target: &Target) -> Result<Vec<u8>, StoreError> {
        let list = self.list(target)?;
        let path = self.folder.file(target, ARCHIVE);
        let damaged = |reason: &str| StoreError::Damaged { path: path.clone(), reason: reason.into() };
        let archive = fs::read(&path).map_err(FileError::at(&path))?;
        if !list.archive.is(&archive) {
            return Err(damaged("it has another hash than its list says"));
        }
        let total = list.libraries.iter().map(|listed| listed.size).sum();
        let all = unpack(&archive, total).ok_or_else(|| damaged("it can't be unpacked"))?;
        let mut begin = 0;
        for listed in &list.libraries {
            let end = begin + listed.size;
            if listed.name == library.name {
                let (bytes, name) = (&all[begin..end], library.name);
                let intact = listed.is(bytes);
                return if intact { Ok(bytes.into()) } else { Err(damaged(&format!("`{name}` has another hash"))) };
            }
            begin = end;
        }
        Err(StoreError::NoLibrary { folder: self.folder(), name: library.name.into() })
    }
}

/// The result for one target.
pub struct Written {
    pub libraries: usize,
    /// All libraries [bytes].
    pub unpacked: usize,
    /// The archive [bytes].
    pub packed: usize,
}

/// Writes the `libraries` for `target` to the folder at `path`.
///
/// # Errors
/// [`FileError`]
pub fn write(path: &Path, target: &Target, libraries: &[(&Library, Vec<u8>)]) -> Result<Written, FileError> {
    let all: Vec<u8> = libraries.iter().flat_map(|(_, bytes)| bytes).copied().collect();
    let listed = libraries.iter().map(|(library, bytes)| Listed::new(library.name.into(), bytes));
    let (archive, listed) = (pack(&all), listed.collect());
    let folder = PrebuiltFolder { path: path.into() };
    let name = format!("{}.{ARCHIVE}", target.triple);
    let list = LibraryList {
        brinell: env!("CARGO_PKG_VERSION").into(),
        sources: sources::hash().into(),
        archive: Listed::new(name, &archive),
        libraries: listed,
    };
    let mut text = serde_json::to_string_pretty(&list).expect("a list is plain data");
    text.push('\n');
    write_whole(&folder.file(target, ARCHIVE), &archive)?;
    write_whole(&folder.file(target, LIST), text.as_bytes())?;
    Ok(Written { libraries: libraries.len(), unpacked: all.len(), packed: archive.len() })
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
