//! Temporary files and folders. A program that is killed leaves its own; the next one that makes one there removes them.
//!
//! Whoever uses one holds a lock on it, which ends with the process. One without a lock is left over, unless it was made just now: it
//! is locked after it is made. Where there are no locks, its age decides.

use brinell_exporter::layout::shown;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use tempfile::{NamedTempFile, TempDir};

/// A file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {source}", path = shown(path))]
pub struct FileError {
    pub path: PathBuf,
    pub source: io::Error,
}

impl FileError {
    /// For `map_err`: the error at `path`.
    pub fn at(path: &Path) -> impl Fn(io::Error) -> FileError {
        move |source| FileError { path: path.into(), source }
    }
}

/// From this age on it has its lock, if the file system has locks.
pub const LOCKED: Duration = Duration::from_secs(10);

/// From this age on it is left over where there are no locks.
pub const ABANDONED: Duration = Duration::from_secs(24 * 3600);

/// The names are a prefix, so many letters and digits, and an ending: nobody else's file is called so.
const LETTERS: usize = 12;
const ENDING: &str = ".tmp";

/// Prefix of a file that is written beside the user's file, and then gets its name.
pub const DRAFT: &str = ".brinell-";

fn named(prefix: &str) -> tempfile::Builder<'_, '_> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix).rand_bytes(LETTERS).suffix(ENDING);
    builder
}

/// Whether a temporary file or folder with this `prefix` may have this name.
fn is_named(name: &str, prefix: &str) -> bool {
    let letters = name.strip_prefix(prefix).and_then(|rest| rest.strip_suffix(ENDING));
    letters.is_some_and(|letters| letters.len() == LETTERS && letters.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}

/// A new file in `folder`, with the permissions of the umask, that is removed when dropped.
///
/// # Errors
/// [`io::Error`]
pub fn draft_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = named(DRAFT);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let draft = builder.tempfile_in(folder)?;
    // without a lock its age decides
    let _ = draft.as_file().try_lock();
    sweep(folder, DRAFT, draft.path());
    Ok(draft)
}

/// A folder that only its owner can read or write, and that is removed when dropped.
pub struct PrivateFolder {
    folder: TempDir,
    // held as long as the folder
    _lock: Option<File>,
}

impl PrivateFolder {
    /// A new folder in `parent` whose name begins with `prefix`.
    ///
    /// # Errors
    /// [`FileError`]
    pub fn new(prefix: &str, parent: &Path) -> Result<PrivateFolder, FileError> {
        let mut builder = named(prefix);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
        let folder = builder.tempdir_in(parent).map_err(FileError::at(parent))?;
        // Windows opens no folder: there its age decides
        let lock = File::open(folder.path()).ok().filter(|lock| lock.try_lock().is_ok());
        sweep(parent, prefix, folder.path());
        Ok(PrivateFolder { folder, _lock: lock })
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// Removes what killed programs have left in `folder` under a name with this `prefix`: files if `own` is one, else folders, of the same
/// owner as `own`. What can't be removed only takes space.
fn sweep(folder: &Path, prefix: &str, own: &Path) {
    let (Ok(own), Ok(entries)) = (fs::symlink_metadata(own), fs::read_dir(folder)) else { return };
    for entry in entries.flatten() {
        let is_ours = entry.file_name().to_str().is_some_and(|name| is_named(name, prefix));
        // without following a link
        let Some(found) = is_ours.then(|| entry.metadata().ok()).flatten() else { continue };
        if found.file_type() != own.file_type() || !has_owner_of(&found, &own) || !is_left(&entry.path(), &found) {
            continue;
        }
        let _ = if found.is_dir() { fs::remove_dir_all(entry.path()) } else { fs::remove_file(entry.path()) };
    }
}

/// Whether nobody uses the temporary file or folder at `path` any more.
fn is_left(path: &Path, found: &fs::Metadata) -> bool {
    let age = found.modified().ok().and_then(|modified| SystemTime::now().duration_since(modified).ok());
    let Some(age) = age.filter(|age| *age > LOCKED) else { return false };
    match File::open(path).map(|file| file.try_lock()) {
        Ok(Ok(())) => true,
        Ok(Err(TryLockError::WouldBlock)) => false,
        Ok(Err(TryLockError::Error(_))) | Err(_) => age > ABANDONED,
    }
}

#[cfg(unix)]
fn has_owner_of(one: &fs::Metadata, other: &fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    one.uid() == other.uid()
}

/// The folders are those of the user alone.
#[cfg(not(unix))]
fn has_owner_of(_one: &fs::Metadata, _other: &fs::Metadata) -> bool {
    true
}
