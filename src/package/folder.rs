//! The build folder. Compiler and linker run there. Whoever can write to it controls their results; it is therefore
//! below a folder that only the user can write to.

use super::error::{ExportError, FolderError};
use crate::files::FileError;
use crate::files::{CACHE, user_folder};
use crate::temporary::PrivateFolder;
use brinell_exporter::package::Hash;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use std::{env, fs, io};

/// The user's cache folder.
pub struct Cache {
    pub folder: PathBuf,
}

/// Prefix of the name of a build folder.
const BUILD: &str = "build-";

/// A build folder older than this belongs to an interrupted export of an older program.
const ABANDONED: Duration = Duration::from_secs(24 * 3600);

/// Prefix of the name of the library of an FMU.
pub const LIBRARY: &str = "library-";

/// Largest number of libraries that are kept, each of some tens of kilobytes: those that were used last.
const MOST_LIBRARIES: usize = 200;

/// A compiled part that no export has used for this time belongs to another version of the exporter or the compiler.
const OUTDATED: Duration = Duration::from_secs(30 * 24 * 3600);

impl Cache {
    /// The folder, created for its owner alone if it is missing.
    ///
    /// # Errors
    /// [`FolderError`] if others can write to it, or if it can't be created or written to.
    pub fn open() -> Result<Cache, ExportError> {
        let folder = cache_folder(|name| env::var_os(name), env::consts::OS)?;
        match make(&folder).and_then(|()| not_ours(&folder)) {
            Ok(None) => Ok(Cache { folder }),
            Ok(Some(reason)) => Err(FolderError::NotOurs { folder, reason }.into()),
            Err(source) => Err(FolderError::Unusable { folder, source }.into()),
        }
    }

    /// A new build folder, removed on drop.
    ///
    /// # Errors
    /// [`FileError`]
    pub fn build_folder(&self) -> Result<PrivateFolder, FileError> {
        self.sweep();
        PrivateFolder::new(BUILD, &self.folder)
    }

    /// The compiled part with this `name` and `ending`, if it is there as it was made. It is then kept for another while. A part that
    /// was damaged, as a file is whose disk lost power, is removed.
    pub fn part(&self, name: &str, ending: &str) -> Option<(PathBuf, Vec<u8>)> {
        let begin = format!("{name}-");
        for entry in fs::read_dir(&self.folder).ok()?.flatten() {
            let file = entry.file_name();
            let Some(sum) = file.to_str().and_then(|file| file.strip_prefix(&begin)?.strip_suffix(ending)) else {
                continue;
            };
            let path = entry.path();
            // neither a folder nor a pipe
            if !entry.file_type().is_ok_and(|kind| kind.is_file()) {
                continue;
            }
            match fs::read(&path) {
                Ok(bytes) if sum_of(&bytes) == sum => {
                    let file = fs::OpenOptions::new().append(true).open(&path);
                    // a part that can't be marked is only removed too early, and made again
                    let _ = file.and_then(|file| file.set_modified(SystemTime::now()));
                    return Some((path, bytes));
                }
                _ => drop(fs::remove_file(&path)),
            }
        }
        None
    }

    /// Keeps the `file` with these `bytes` as the compiled part with this `name` and `ending`.
    pub fn keep(&self, file: &Path, bytes: &[u8], name: &str, ending: &str) {
        // atomic; without it the next export compiles again. Harmless on a file system without links, and if another export was faster
        let _ = fs::hard_link(file, self.folder.join(format!("{name}-{}{ending}", sum_of(bytes))));
    }

    /// Removes the build folders of interrupted exports, outdated parts, and the oldest libraries. What can't be removed only takes
    /// space.
    fn sweep(&self) {
        let Ok(entries) = fs::read_dir(&self.folder) else { return };
        let mut libraries = Vec::new();
        for entry in entries.flatten() {
            let (path, name) = (entry.path(), entry.file_name());
            let modified = entry.metadata().and_then(|metadata| metadata.modified());
            let age = modified.ok().and_then(|modified| SystemTime::now().duration_since(modified).ok());
            let older = |than: Duration| age.is_some_and(|age| age > than);
            if name.to_string_lossy().starts_with(LIBRARY) {
                libraries.push((age.unwrap_or_default(), path));
            } else if name.to_string_lossy().starts_with(BUILD) {
                let _ = if older(ABANDONED) { fs::remove_dir_all(path) } else { Ok(()) };
            } else if path.extension().is_some_and(|extension| extension == "rlib" || extension == "obj") {
                let _ = if older(OUTDATED) { fs::remove_file(path) } else { Ok(()) };
            }
        }
        libraries.sort();
        let too_many = |place: usize, age: Duration| place >= MOST_LIBRARIES || age > OUTDATED;
        for (place, (age, path)) in libraries.into_iter().enumerate() {
            let _ = if too_many(place, age) { fs::remove_file(path) } else { Ok(()) };
        }
    }
}

/// The hash of a part's contents.
fn sum_of(bytes: &[u8]) -> String {
    Hash::default().with_bytes(bytes).digits()
}

/// `BRINELL_CACHE`, or the folder of this name in the user's cache on the operating system `os`.
pub fn cache_folder(variable: impl Fn(&str) -> Option<OsString>, os: &str) -> Result<PathBuf, FolderError> {
    let path = |name: &str| variable(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    if let Some(chosen) = path("BRINELL_CACHE") {
        // the compiler runs in another folder than the program
        return Ok(std::path::absolute(&chosen).unwrap_or(chosen));
    }
    user_folder(variable, os, &CACHE).map_err(FolderError::None)
}

/// Creates `folder` and its parents, for their owner alone.
fn make(folder: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.recursive(true).create(folder)
}

/// The reason why others can write to `folder`, if they can.
#[cfg(unix)]
fn not_ours(folder: &Path) -> io::Result<Option<&'static str>> {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    // a new folder belongs to the user of the process
    let probe = tempfile::tempfile_in(folder)?.metadata()?;
    let owner = |metadata: fs::Metadata| metadata.uid() == probe.uid();
    // a link in another user's folder could lead to any of the user's folders
    if !owner(fs::symlink_metadata(folder)?) || !owner(fs::metadata(folder)?) {
        return Ok(Some("belongs to somebody else"));
    }
    let others_write = fs::metadata(folder)?.permissions().mode() & 0o022 != 0;
    Ok(others_write.then_some("others can write to (`chmod go-w` ends that)"))
}

/// The folder of local application data belongs to the user alone.
#[cfg(not(unix))]
fn not_ours(_folder: &Path) -> io::Result<Option<&'static str>> {
    Ok(None)
}
