//! `brinell unpack`: unpacks an FMU for a program that loads it, such as the Python module, which so refuses what this one does.

use crate::importer::{Archive, ImportError};
use brinell_exporter::layout::{json_line, shown};
use serde_json::json;
use std::path::{Path, PathBuf};

/// An FMU that isn't unpacked.
#[derive(Debug, thiserror::Error)]
#[error("{}: {reason}", shown(path))]
pub struct UnpackError {
    path: PathBuf,
    reason: ImportError,
}

/// The command: unpacks `fmu` into the folder `to`, and prints what is loaded there as JSON.
///
/// # Errors
/// [`UnpackError`] if the archive, its description or the library of this machine breaks a rule.
pub fn run(fmu: &Path, to: &Path) -> Result<(), UnpackError> {
    let refused = |reason| UnpackError { path: fmu.into(), reason };
    let archive = Archive::open_in(fmu, to).map_err(refused)?;
    let library = archive.library().map_err(refused)?;
    let library = library.strip_prefix(to).expect("it is in the folder");
    let identifier = &archive.description.identifier;
    print!("{}", json_line(&json!({ "library": library.to_string_lossy(), "identifier": identifier })));
    Ok(())
}
