//! Parts of a test program that may crash or hang, in processes of their own with a time limit.

use crate::places::WORKER;
use std::fmt;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, ExitStatus};
use std::thread;
use std::time::{Duration, Instant};

/// How a process failed.
pub enum Failure {
    Hang { limit: Duration },
    Ended { status: ExitStatus, said: String },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Hang { limit } => write!(f, "no end within {limit:?}"),
            Failure::Ended { status, said } => write!(f, "{status}\n{said}"),
        }
    }
}

/// `program`, a test program, told to run its ignored test `worker` alone.
pub fn worker(program: &Path) -> Command {
    let mut command = Command::new(program);
    command.args(["worker", "--exact", "--ignored", "--nocapture"]).env("RUST_BACKTRACE", "0").env(WORKER, "1");
    // a thread of glibc otherwise keeps some freed pieces, which then count as in use
    command.env("GLIBC_TUNABLES", "glibc.malloc.tcache_count=0");
    command
}

/// Runs `command`, for at most `limit`. What it says is written to the file `log`.
///
/// # Errors
/// [`Failure`] if it doesn't succeed.
pub fn run(command: &mut Command, log: &Path, limit: Duration) -> Result<(), Failure> {
    let file = File::create(log).expect("the folder of a log can be written to");
    command.stdout(file.try_clone().expect("a file")).stderr(file);
    let mut child = command.spawn().unwrap_or_else(|error| panic!("{command:?} can't be started: {error}"));
    let begin = Instant::now();
    loop {
        match child.try_wait().expect("a child") {
            Some(status) if status.success() => return Ok(()),
            Some(status) => {
                let said = fs::read(log).map(|text| String::from_utf8_lossy(&text).into_owned());
                return Err(Failure::Ended { status, said: said.unwrap_or_default() });
            }
            None if begin.elapsed() > limit => {
                let _ = child.kill();
                let _ = child.wait();
                return Err(Failure::Hang { limit });
            }
            None => thread::sleep(Duration::from_millis(2)),
        }
    }
}
