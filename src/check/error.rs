//! Why an FMU could not be checked.

use crate::files::FileError;
use crate::importer::ImportError;
use brinell_exporter::layout::shown;
use brinell_exporter::mistake::SceneError;
use std::io;
use std::path::PathBuf;
use std::process::ExitStatus;

/// An FMU that could not be checked.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    #[error("{}: {source}", shown(path))]
    Import { path: PathBuf, source: ImportError },
    #[error("{}: there is no resources/scene.toml: brinell has not made this FMU, and there is no impact to run", shown(.0))]
    NoScene(PathBuf),
    #[error("{}: its scene can't be read: {source}", shown(path))]
    Scene { path: PathBuf, source: SceneError },
    #[error("{0}")]
    File(#[from] FileError),
    #[error("the process that loads FMUs can't be started: {0}")]
    NoProcess(io::Error),
    #[error("{}: the FMU ended the process that loaded it ({status}){said}", shown(path))]
    Ended { path: PathBuf, status: ExitStatus, said: String },
    #[error("{}: no answer within {limit} s (--time-limit)", shown(path))]
    Hangs { path: PathBuf, limit: u64 },
    #[error("{0}")]
    Said(String),
}
