//! The output of a child process, which may be endless, and held by processes that the child leaves behind.

use std::io::{self, Read};
use std::process::{Command, Output, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use wait_timeout::ChildExt;

/// Runs `command` without input and returns its output; `None` if it took longer than `limit` and was stopped.
///
/// # Errors
/// [`io::Error`] if it can't be started.
pub fn output_within(command: &mut Command, limit: Duration) -> io::Result<Option<Output>> {
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
    let heard = Heard::start(child.stdout.take()).and_then(|stdout| Ok((stdout, Heard::start(child.stderr.take())?)));
    let ended = heard.and_then(|heard| Ok((child.wait_timeout(limit)?, heard)));
    if !matches!(ended, Ok((Some(_), _))) {
        let _ = child.kill();
        let _ = child.wait();
    }
    let (Some(status), (stdout, stderr)) = ended? else { return Ok(None) };
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
