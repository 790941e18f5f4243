//! Temporary files and folders. A program that is killed leaves its own; the next one that makes one there removes them.
//!
//! Whoever uses one holds a lock on it, which ends with the process. One without a lock is left over, unless it was made just now: it
//! is locked after it is made. Where there are no locks, its age decides.

use crate::files::FileError;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;
use std::time::{Duration, SystemTime};
use tempfile::{NamedTempFile, TempDir};

/// From this age on it has its lock, if the file system has locks.
const LOCKED: Duration = Duration::from_secs(10);

/// From this age on it is left over where there are no locks.
const ABANDONED: Duration = Duration::from_secs(24 * 3600);

/// The names are a prefix, so many letters and digits, and an ending: nobody else's file is called so.
const LETTERS: usize = 12;
const ENDING: &str = ".tmp";

/// Prefix of a file that is written beside the user's file, and then gets its name.
const DRAFT: &str = ".brinell-";

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

#[cfg(all(test, unix))]
mod tests {
    use super::{ABANDONED, DRAFT, LOCKED, PrivateFolder, draft_in};
    use std::fs::{self, File};
    use std::path::Path;
    use std::time::{Duration, SystemTime};

    const FOLDER: &str = "brinell-check-";

    /// Makes a file or a folder as a killed program leaves it, last changed `age` ago.
    fn left(path: &Path, is_folder: bool, age: Duration) {
        if is_folder {
            fs::create_dir(path).unwrap();
            fs::write(path.join("library.so"), "x").unwrap();
        } else {
            fs::write(path, "half").unwrap();
        }
        File::open(path).unwrap().set_modified(SystemTime::now() - age).unwrap();
    }

    /// Whether the entry `name` is still there after another program has made its file and its folder.
    fn stays(name: &str, is_folder: bool, age: Duration, locked: bool) -> bool {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join(name);
        left(&path, is_folder, age);
        let lock = locked.then(|| File::open(&path).unwrap());
        lock.iter().for_each(|lock| lock.lock().unwrap());
        let draft = draft_in(place.path()).unwrap();
        let folder = PrivateFolder::new(FOLDER, place.path()).unwrap();
        assert!(draft.path().exists() && folder.path().exists(), "nobody removes its own");
        path.exists()
    }

    #[test]
    fn what_a_killed_program_left_is_removed_and_what_is_in_use_or_not_ours_stays() {
        let minute = Duration::from_secs(60);
        for (prefix, is_folder) in [(DRAFT, false), (FOLDER, true)] {
            let name = format!("{prefix}a1b2C3d4E5f6.tmp");
            assert!(!stays(&name, is_folder, minute, false), "{name}");
            assert!(stays(&name, is_folder, minute, true), "{name}: somebody writes it");
            assert!(stays(&name, is_folder, 3 * ABANDONED, true), "{name}: somebody has written it for days");
            assert!(stays(&name, is_folder, LOCKED / 2, false), "{name}: it may not have its lock yet");
            // a file for a folder, and the other way round
            assert!(stays(&name, !is_folder, minute, false), "{name}: another kind");
            for other in ["a1b2C3d4E5f6", "a1b2C3d4E5f.tmp", "a1b2C3d4E5f6.tmp.txt", "a1b2-3d4E5f6.tmp", "output", ""] {
                let name = format!("{prefix}{other}");
                assert!(stays(&name, is_folder, 3 * ABANDONED, false), "{name}: the user's own");
            }
        }
    }

    /// Nothing that a link leads to is removed, nor the link.
    #[test]
    fn a_link_with_the_name_of_a_temporary_folder_stays_with_its_target() {
        let place = tempfile::tempdir().unwrap();
        let target = place.path().join("results");
        left(&target, true, 3 * ABANDONED);
        let link = place.path().join(format!("{FOLDER}a1b2C3d4E5f6.tmp"));
        std::os::unix::fs::symlink(&target, &link).unwrap();
        drop(PrivateFolder::new(FOLDER, place.path()).unwrap());
        assert!(fs::symlink_metadata(&link).is_ok() && target.join("library.so").exists());
    }

    /// Programs that run at the same time write to one folder.
    #[test]
    fn writers_at_the_same_time_do_not_sweep_each_other() {
        let place = tempfile::tempdir().unwrap();
        let write = |number: usize| {
            for turn in 0..50 {
                let goal = place.path().join(format!("{number}-{turn}.csv"));
                crate::files::write_whole(&goal, b"whole").unwrap();
                assert_eq!(fs::read(&goal).unwrap(), b"whole");
            }
        };
        std::thread::scope(|scope| (0..4).for_each(|number| drop(scope.spawn(move || write(number)))));
        assert_eq!(fs::read_dir(place.path()).unwrap().count(), 200, "no draft stays");
    }
}
