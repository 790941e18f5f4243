//! Cleans up when the program is interrupted: SIGINT, SIGTERM or SIGHUP, Ctrl-C or Ctrl-Break on Windows.
//!
//! Temporary files and child processes are registered here while they exist. The handler stops the children and
//! removes the files. It keeps the register locked, so nothing new can appear while the process ends.

mod output;
mod signals;

use crate::file_error::FileError;
use shared_child::SharedChild;
use std::io;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use std::{fs, thread};
use tempfile::{Builder, NamedTempFile, TempDir};

pub use output::{output, output_within};

/// The exit status after an interruption: 128 plus the number of SIGINT, as in shells.
pub const INTERRUPTED: i32 = 130;

/// Number of attempts to remove a folder; grandchildren may still write to it.
const REMOVALS: u32 = 20;

/// Files and processes that must not outlive the process.
struct Register {
    paths: Vec<PathBuf>,
    children: Vec<Arc<SharedChild>>,
}

static REGISTER: Mutex<Register> = Mutex::new(Register { paths: Vec::new(), children: Vec::new() });

fn register() -> MutexGuard<'static, Register> {
    // a panic in another thread leaves both lists valid
    REGISTER.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Installs the handler. Without it, an interruption leaves temporary files, but does no other harm. Signals that the caller ignores,
/// as `nohup` does, stay ignored.
pub fn clean_up_when_interrupted() {
    #[cfg(unix)]
    let ignored = signals::ignored();
    let _ = ctrlc::set_handler(|| {
        let register = register();
        for child in &register.children {
            let _ = child.kill();
            let _ = child.wait();
        }
        for path in &register.paths {
            remove(path);
        }
        std::process::exit(INTERRUPTED);
    });
    #[cfg(unix)]
    signals::ignore(&ignored);
}

/// Removes a file or a folder, if possible.
fn remove(path: &Path) {
    for _ in 0..REMOVALS {
        if fs::remove_file(path).is_ok() || fs::remove_dir_all(path).is_ok() || fs::symlink_metadata(path).is_err() {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
}

/// A temporary folder. It is removed on drop and on interruption.
pub struct Folder {
    folder: Option<TempDir>,
    path: PathBuf,
}

impl Folder {
    /// Creates a folder in `parent` with the settings of `builder`.
    ///
    /// # Errors
    /// [`FileError`]
    pub fn new(builder: &Builder<'_, '_>, parent: &Path) -> Result<Folder, FileError> {
        let mut register = register();
        let folder = builder.tempdir_in(parent).map_err(FileError::at(parent))?;
        let path = folder.path().to_path_buf();
        register.paths.push(path.clone());
        Ok(Folder { folder: Some(folder), path })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let mut register = register();
        drop(self.folder.take());
        register.paths.retain(|path| *path != self.path);
    }
}

/// Creates a file in `parent` that `builder` names, and removes it.
///
/// # Errors
/// The error of the file system.
pub fn probe(builder: &Builder<'_, '_>, parent: &Path) -> io::Result<()> {
    // an interruption waits until the file is gone
    let _register = register();
    builder.tempfile_in(parent).map(drop)
}

/// Writes `bytes` to a temporary file in `parent` that `builder` names, then renames it to `goal`.
///
/// # Errors
/// The error of the file system; the temporary file is then removed.
pub fn write_and_rename(builder: &Builder<'_, '_>, parent: &Path, goal: &Path, bytes: &[u8]) -> io::Result<()> {
    let file = {
        let mut register = register();
        let file = builder.tempfile_in(parent)?;
        register.paths.push(file.path().to_path_buf());
        file
    };
    let path = file.path().to_path_buf();
    let result = fill_and_rename(file, goal, bytes);
    register().paths.retain(|registered| *registered != path);
    result
}

fn fill_and_rename(mut file: NamedTempFile, goal: &Path, bytes: &[u8]) -> io::Result<()> {
    io::Write::write_all(&mut file, bytes)?;
    // a replaced file keeps its permissions
    if let Ok(before) = fs::metadata(goal) {
        fs::set_permissions(file.path(), before.permissions())?;
    }
    file.persist(goal)?;
    Ok(())
}

/// A child process. An interruption stops it.
pub struct Child(Arc<SharedChild>);

impl Child {
    /// Starts `command`.
    ///
    /// # Errors
    /// [`io::Error`] if it can't be started.
    pub fn spawn(command: &mut Command) -> io::Result<Child> {
        let mut register = register();
        let child = Arc::new(SharedChild::spawn(command)?);
        register.children.push(Arc::clone(&child));
        Ok(Child(child))
    }
}

impl Deref for Child {
    type Target = SharedChild;

    fn deref(&self) -> &SharedChild {
        &self.0
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        register().children.retain(|other| !Arc::ptr_eq(other, &self.0));
    }
}
