//! Cleans up when the program is interrupted: SIGINT, SIGTERM or SIGHUP, Ctrl-C or Ctrl-Break on Windows.
//!
//! Temporary files and child processes are registered here while they exist. The handler stops the children and
//! removes the files. It keeps the register locked, so nothing new can appear while the process ends.

use crate::file_error::FileError;
use shared_child::SharedChild;
use std::io::{self, Read};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, thread};
use tempfile::{Builder, NamedTempFile, TempDir};

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

/// Signals that have no effect.
#[cfg(unix)]
#[allow(unsafe_code, reason = "the standard library has no signals")]
mod signals {
    use std::ffi::c_int;

    /// SIGHUP, SIGINT and SIGTERM, which end the program.
    const ENDS: [c_int; 3] = [1, 2, 15];

    /// SIGXFSZ, of a file beyond the limit of the user: without it, writing gives an error, and temporary files are removed.
    const TOO_LARGE: c_int = 25;

    /// `SIG_IGN`.
    const IGNORE: usize = 1;

    unsafe extern "C" {
        fn signal(number: c_int, action: usize) -> usize;
    }

    /// Those of [`ENDS`] that the caller of the program ignores.
    pub fn ignored() -> Vec<c_int> {
        let is_ignored = |number: &c_int| {
            // SAFETY: no handler is installed yet; ignoring a signal and restoring its action is always allowed.
            unsafe {
                let before = signal(*number, IGNORE);
                if before != IGNORE {
                    signal(*number, before);
                }
                before == IGNORE
            }
        };
        ENDS.into_iter().filter(is_ignored).collect()
    }

    /// Ignores these signals, and the one of a file that becomes too large.
    pub fn ignore(numbers: &[c_int]) {
        for number in numbers.iter().chain(&[TOO_LARGE]) {
            // SAFETY: ignoring a signal is always allowed.
            unsafe { signal(*number, IGNORE) };
        }
    }
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

/// Runs `command` without input and returns its output; an interruption stops it.
///
/// # Errors
/// [`io::Error`] if it can't be started.
pub fn output(command: &mut Command) -> io::Result<Output> {
    Ok(output_within(command, None)?.expect("without a limit it ends by itself"))
}

/// The same; `None` if it took longer than `limit` and was stopped.
///
/// # Errors
/// [`io::Error`] if it can't be started.
pub fn output_within(command: &mut Command, limit: Option<Duration>) -> io::Result<Option<Output>> {
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = Child::spawn(command)?;
    let status = Heard::start(child.take_stdout()).and_then(|stdout| {
        let stderr = Heard::start(child.take_stderr())?;
        let status = match limit.and_then(|limit| Instant::now().checked_add(limit)) {
            None => child.wait().map(Some),
            Some(deadline) => child.wait_deadline(deadline),
        };
        Ok((status?, stdout, stderr))
    });
    if !matches!(status, Ok((Some(_), ..))) {
        let _ = child.kill();
        let _ = child.wait();
    }
    let (Some(status), stdout, stderr) = status? else { return Ok(None) };
    let patience = Instant::now() + PATIENCE;
    Ok(Some(Output { status, stdout: stdout.until(patience), stderr: stderr.until(patience) }))
}

/// How long an ended process may keep its pipes open: by then all is read, unless a process that it has left behind holds them.
const PATIENCE: Duration = Duration::from_secs(3);

/// The largest part of the begin and of the end of an output that is kept [bytes].
const KEPT: usize = 1 << 20;

/// What a thread reads from a pipe.
struct Heard {
    bytes: Arc<Mutex<Vec<u8>>>,
    end: Receiver<()>,
}

impl Heard {
    /// Begins to read `pipe`.
    ///
    /// # Errors
    /// [`io::Error`] if there can be no other thread.
    fn start(pipe: Option<impl Read + Send + 'static>) -> io::Result<Heard> {
        let bytes = Arc::new(Mutex::new(Vec::new()));
        let (ended, end) = mpsc::channel();
        let to = Arc::clone(&bytes);
        thread::Builder::new().spawn(move || {
            if let Some(pipe) = pipe {
                read(pipe, &to);
            }
            let _ = ended.send(());
        })?;
        Ok(Heard { bytes, end })
    }

    /// What was read up to the end of the pipe, or to this moment.
    fn until(self, moment: Instant) -> Vec<u8> {
        let _ = self.end.recv_timeout(moment.saturating_duration_since(Instant::now()));
        std::mem::take(&mut *self.bytes.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Reads a pipe to its end, without the middle of an endless output. An error keeps the bytes before it.
fn read(mut pipe: impl Read, to: &Mutex<Vec<u8>>) {
    let mut piece = vec![0; 1 << 16];
    loop {
        let count = match pipe.read(&mut piece) {
            Ok(0) => return,
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(_) => return,
        };
        let mut bytes = to.lock().unwrap_or_else(PoisonError::into_inner);
        bytes.extend_from_slice(&piece[..count]);
        if bytes.len() > 3 * KEPT {
            let end = bytes.len() - KEPT;
            bytes.drain(KEPT..end);
        }
    }
}
