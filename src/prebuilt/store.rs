//! A folder of prebuilt libraries: for each target an archive, and a list of its contents.

use super::folder::{self, PrebuiltFolder};
use crate::files::{FileError, write_whole};
use crate::sources;
use brinell_exporter::layout::shown;
use brinell_exporter::platform::{Platform, Target};
use brinell_exporter::prebuilt::Library;
use brinell_exporter::prebuilt::archive::{self, ARCHIVE, ArchiveError, LIST, LibraryList, Written};
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
        let list = LibraryList::read(&text).map_err(|reason| StoreError::Damaged { path: path.clone(), reason })?;
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
        let archive = fs::read(&path).map_err(FileError::at(&path))?;
        list.library(&archive, library).map_err(|error| match error {
            ArchiveError::Damaged(reason) => StoreError::Damaged { path, reason },
            ArchiveError::Missing(name) => StoreError::NoLibrary { folder: self.folder(), name },
        })
    }
}

/// Writes the `libraries` for `target` to the folder at `path`.
///
/// # Errors
/// [`FileError`]
pub fn write(path: &Path, target: &Target, libraries: &[(&Library, Vec<u8>)]) -> Result<Written, FileError> {
    let (archive, list, written) = archive::write(target, sources::hash(), libraries);
    let folder = PrebuiltFolder { path: path.into() };
    write_whole(&folder.file(target, ARCHIVE), &archive)?;
    write_whole(&folder.file(target, LIST), list.as_bytes())?;
    Ok(written)
}
