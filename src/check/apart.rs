//! The process that loads the library of an FMU. If it crashes, hangs or exits, the check fails.

use super::bounded_output::output_within;
use super::error::CheckError;
use crate::files::write_whole;
use crate::temporary::PrivateFolder;
use brinell_exporter::layout::without_middle;
use serde::{Deserialize, Serialize};
use std::io;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;
use std::{env, fs};

/// The findings of the process.
#[derive(Debug, Serialize, Deserialize)]
pub enum Found {
    /// The printed outcome.
    Outcome { text: String, passed: bool },
    /// The reason why the FMU couldn't be checked.
    Error(String),
}

/// The file with the findings.
const FOUND: &str = "found.json";

/// Checks the FMU at `path` in a separate process with the time `limit`.
///
/// # Errors
/// [`CheckError`]
pub fn check(path: &Path, as_json: bool, limit: Duration) -> Result<Found, CheckError> {
    // keeps the temporary files of a process that crashes
    let folder = PrivateFolder::new("brinell-check-", &env::temp_dir())?;
    let file = folder.path().join(FOUND);
    let mut command = Command::new(env::current_exe().map_err(CheckError::NoProcess)?);
    command.arg("check").arg(path).arg("--found").arg(&file);
    for name in ["TMPDIR", "TEMP", "TMP"] {
        command.env(name, folder.path());
    }
    if as_json {
        command.arg("--json");
    }
    let Some(output) = output_within(&mut command, limit).map_err(CheckError::NoProcess)? else {
        return Err(CheckError::Hangs { path: path.into(), limit: limit.as_secs() });
    };
    let found = fs::read(&file).and_then(|text| serde_json::from_slice(&text).map_err(io::Error::other));
    // a library may also crash after the findings, while the process ends
    found.ok().filter(|_| output.status.success()).ok_or_else(|| ended(path, &output))
}

/// The process ended without findings.
fn ended(path: &Path, output: &Output) -> CheckError {
    let said = String::from_utf8_lossy(&output.stderr);
    let last = said.lines().rev().find(|line| !line.trim().is_empty());
    let said = last.map(|line| format!("; its last line was: {}", without_middle(line.trim()))).unwrap_or_default();
    CheckError::Ended { path: path.into(), status: output.status, said }
}

impl Found {
    /// Writes the findings to `file`.
    ///
    /// # Errors
    /// [`CheckError::File`]
    pub fn write(&self, file: &Path) -> Result<(), CheckError> {
        let text = serde_json::to_string(self).expect("two strings and a truth value");
        Ok(write_whole(file, text.as_bytes())?)
    }
}
